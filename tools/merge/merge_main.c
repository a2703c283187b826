/* merge_main.c - qlux-merge: add up parts of one picture, bit for bit */
/* SPDX-License-Identifier: MIT */

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "lib/program/options.h"
#include "lib/render/develop.h"
#include "merge/fields.h"

typedef struct {
    const char *picture;
    const char *save;
    ql_format_t format;
    bool quiet;
    option_list_t parts;
} options_t;

#define AT(field) OPTION_FIELD(options_t, field)

static const char *const pictures[] = {".ppm", ".pfm", ".png", NULL};

static const option_t merging[] = {
        {"A.qls", OPTION_LIST, AT(parts), .required = true},
        {"-o FILE", OPTION_FILE, AT(picture), .words = pictures,
                .help = "the picture: .ppm and .png as a display shows it, "
                        ".pfm linear radiance in the units of Ke"},
        {"--save-sums FILE", OPTION_FILE, AT(save),
                .help = "the sum of the parts, itself a part (.qls)"},
        {"--format F", OPTION_WORD, AT(format), .words = develop_formats,
                .help = "of the display, widened to 8-bit RGB"},
        {"--quiet", OPTION_FLAG, AT(quiet),
                .help = "do not warn of missing rows or samples"},
        OPTION_END};

static const option_section_t sections[] = {{NULL, merging}, {NULL, NULL}};

static const program_t program = {.name = "qlux-merge",
        .about = "add up parts of one picture, bit for bit",
        .usage = "A.qls B.qls ... -o OUT.{ppm,pfm,png} [options]",
        .sections = sections,
        .notes = "Parts come from qlux-sim --save-sums. They must be of one "
                 "scene and have the same settings; no sample may be in two of "
                 "them.",
        .example = "qlux-sim box.qlb --rows 0:64 --save-sums top.qls\n"
                   "qlux-sim box.qlb --rows 64:128 --save-sums low.qls\n"
                   "qlux-merge top.qls low.qls -o box.png"};

static void check_options(const options_t *o)
{
    if (o->picture == NULL && o->save == NULL) {
        options_fail("missing -o FILE or --save-sums FILE");
    }
    if (options_given("--format") &&
            (o->picture == NULL || image_kind(o->picture) == IMAGE_PFM)) {
        options_fail("'--format' needs '-o' with a .ppm or .png name");
    }
}

/* The part must be of the same picture as the first one. */
static void check_fit(const sums_t *whole, const sums_t *part,
        const option_list_t *parts, unsigned i)
{
    const unsigned field = sums_compare(whole, part);
    char text[2][FIELDS_TEXT_BYTES];

    if (field != SUMS_FIELD_COUNT) {
        cli_fail(CLI_INPUT, "%s: its %s is %s, but %s in %s", parts->items[i],
                fields_name(field), fields_text(text[0], part, field),
                fields_text(text[1], whole, field), parts->items[0]);
    }
}

/* Add a part. Sums stay at their maximum as they do while rendering, so any
 * order of adding gives the same bits. */
static void add_part(sums_t *whole, const sums_t *part, const char *path)
{
    const size_t pixels =
            (size_t)whole->field[SUMS_WIDTH] * whole->field[SUMS_HEIGHT];

    for (uint32_t i = 0; i < part->range_count; i++) {
        sums_range_t clash;
        if (!sums_claim(whole, part->ranges + i, &clash)) {
            cli_fail(CLI_INPUT,
                    "%s: rows %u:%u samples %u:%u were counted before", path,
                    (unsigned)clash.row_first, (unsigned)clash.row_end,
                    (unsigned)clash.sample_first, (unsigned)clash.sample_end);
        }
    }
    for (size_t i = 0; i < 3 * pixels; i++) {
        uint64_t *sum = whole->pixels[i / 3].rgb + i % 3;
        const uint64_t add = part->pixels[i / 3].rgb[i % 3];
        *sum = add > UINT64_MAX - *sum ? UINT64_MAX : *sum + add;
    }
}

static void warn_of_gaps(const sums_t *sums)
{
    const uint32_t height = sums->field[SUMS_HEIGHT];
    uint32_t missing = 0, first = 0, least = UINT32_MAX, most = 0;

    for (uint32_t y = height; y-- > 0;) {
        const uint32_t count = sums_row_count(sums, y);
        if (count == 0) {
            missing++;
            first = y;
        } else {
            least = count < least ? count : least;
            most = count > most ? count : most;
        }
    }
    if (missing > 0) {
        cli_warn("%u of %u rows are missing, the first is row %u",
                (unsigned)missing, (unsigned)height, (unsigned)first);
    }
    if (most > least) {
        cli_warn("rows have from %u to %u samples a pixel", (unsigned)least,
                (unsigned)most);
    }
}

int main(int argc, char **argv)
{
    options_t o = {.quiet = false};
    sums_t whole, part;
    cli_out_t picture, save;

    options_parse(&program, argc, argv, &o);
    check_options(&o);
    sums_read(&whole, o.parts.items[0]);
    for (unsigned i = 1; i < o.parts.count; i++) {
        sums_read(&part, o.parts.items[i]);
        check_fit(&whole, &part, &o.parts, i);
        add_part(&whole, &part, o.parts.items[i]);
        sums_free(&part);
    }
    if (!o.quiet) {
        warn_of_gaps(&whole);
    }
    if (o.picture != NULL) {
        cli_out_open(&picture, o.picture);
        develop_write(&whole, image_kind(o.picture), o.format, &picture);
    }
    if (o.save != NULL) {
        cli_out_open(&save, o.save);
        sums_write(&whole, &save);
        cli_out_commit(&save);
    }
    if (o.picture != NULL) {
        cli_out_commit(&picture);
    }
    sums_free(&whole);
    return CLI_DONE;
}
