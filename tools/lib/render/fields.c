/* fields.c - what a sum file's settings are called, in the words of options */
/* SPDX-License-Identifier: MIT */

#include "lib/render/fields.h"

#include <inttypes.h>

#include "lib/render/render_options.h"

static const char *const no_yes[] = {"no", "yes", NULL};

/* The words of a field whose value is an index of them. */
static const char *const *words_of(unsigned field)
{
    switch (field) {
    case SUMS_SAMPLER:
        return render_words_sampler;
    case SUMS_DIRECT:
        return render_words_direct;
    case SUMS_INDIRECT:
        return render_words_indirect;
    case SUMS_LIGHTS:
        return render_words_lights;
    case SUMS_ROULETTE:
    case SUMS_TABLE_LERP:
        return no_yes;
    default:
        return NULL;
    }
}

/* Bits of positions and of directions (ql_config.h): they differ together. */
static const char *precision_of(const sums_t *sums)
{
    const uint32_t position = sums->field[SUMS_POS_BITS],
                   direction = sums->field[SUMS_DIR_BITS];

    return position == 0 && direction == 15   ? "draft"
           : position == 8 && direction == 22 ? "fine"
                                              : NULL;
}

static bool is_precision(unsigned field)
{
    return field == SUMS_POS_BITS || field == SUMS_DIR_BITS;
}

const char *fields_name(unsigned field)
{
    return is_precision(field) ? "precision" : sums_field_name(field);
}

const char *fields_text(char *text, const sums_t *sums, unsigned field)
{
    const int64_t value = sums_field_value(sums, field);
    const char *const *words = words_of(field);
    const char *word = is_precision(field) ? precision_of(sums) : NULL;

    for (int64_t i = 0; words != NULL && words[i] != NULL && i <= value; i++) {
        word = i == value ? words[i] : NULL;
    }
    if (word != NULL) {
        snprintf(text, FIELDS_TEXT_BYTES, "%s", word);
    } else if (is_precision(field)) {
        snprintf(text, FIELDS_TEXT_BYTES, "%u and %u bits",
                (unsigned)sums->field[SUMS_POS_BITS],
                (unsigned)sums->field[SUMS_DIR_BITS]);
    } else if (field == SUMS_BLOB_CRC) {
        snprintf(text, FIELDS_TEXT_BYTES, "%08" PRIx64, value);
    } else if (field == SUMS_EXPOSURE_Q8 || field == SUMS_METERED_Q8) {
        snprintf(text, FIELDS_TEXT_BYTES, "%g", (double)value / 256);
    } else if (field == SUMS_CLAMP_Q16) {
        snprintf(text, FIELDS_TEXT_BYTES, "%.8g", (double)value / 65536);
    } else {
        snprintf(text, FIELDS_TEXT_BYTES, "%" PRId64, value);
    }
    return text;
}
