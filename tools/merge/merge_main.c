/* merge_main.c - qlux-merge: add up parts of one picture, bit for bit */
/* SPDX-License-Identifier: MIT */

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "lib/render/develop.h"

static const char help[] =
        "qlux-merge: add up parts of one picture, bit for bit\n"
        "\n"
        "  qlux-merge A.qls B.qls ... -o OUT.{ppm,pfm,png} [options]\n"
        "\n"
        "  -o FILE          the picture: display values, or linear as .pfm\n"
        "  --save-sums FILE the sum of the parts, itself a part\n"
        "  --format F       rgb888, rgb565le, rgb565be, gray8 or gray4\n"
        "  --quiet          do not warn of missing rows or samples\n"
        "\n"
        "Parts come from qlux-sim --save-sums. They must be of one scene and\n"
        "have the same settings; no sample may be in two of them.\n"
        "Exit: 0 done, 1 usage, 2 parts that do not fit, 3 cannot read, write\n"
        "\n"
        "Example:\n"
        "  qlux-sim box.qlb --rows 0:64 --save-sums top.qls\n"
        "  qlux-sim box.qlb --rows 64:128 --save-sums low.qls\n"
        "  qlux-merge top.qls low.qls -o box.png\n";

typedef struct {
    const char *picture;
    const char *save;
    ql_format_t format;
    bool quiet;
    const char **parts;
    int part_count;
} options_t;

static void parse(options_t *o, int argc, char **argv)
{
    bool has_format = false;

    memset(o, 0, sizeof *o);
    o->parts = cli_alloc((size_t)argc, sizeof *o->parts);
    for (int i = 1; i < argc; i++) {
        const char *a = argv[i];
        if (strcmp(a, "--help") == 0 || strcmp(a, "-h") == 0) {
            fputs(help, stdout);
            exit(CLI_DONE);
        } else if (strcmp(a, "-o") == 0) {
            o->picture = cli_text(a, argv[++i]);
        } else if (strcmp(a, "--save-sums") == 0) {
            o->save = cli_text(a, argv[++i]);
        } else if (strcmp(a, "--format") == 0) {
            o->format = (ql_format_t)cli_choice(a, argv[++i], develop_formats);
            has_format = true;
        } else if (strcmp(a, "--quiet") == 0) {
            o->quiet = true;
        } else if (a[0] == '-' && a[1] != '\0') {
            cli_fail(CLI_USAGE, "unknown option '%s' (see --help)", a);
        } else {
            o->parts[o->part_count++] = a;
        }
    }
    if (o->part_count == 0) {
        cli_fail(CLI_USAGE, "name at least one .qls file (see --help)");
    }
    if (o->picture == NULL && o->save == NULL) {
        cli_fail(CLI_USAGE, "give -o, --save-sums, or both (see --help)");
    }
    if (has_format &&
            (o->picture == NULL || image_kind("-o", o->picture) == IMAGE_PFM)) {
        cli_fail(CLI_USAGE, "'--format' needs '-o' with a .ppm or .png name");
    }
}

/* The part must be of the same picture as the first one. */
static void check_fit(
        const sums_t *whole, const sums_t *part, const options_t *o, int i)
{
    const unsigned field = sums_compare(whole, part);

    if (field != SUMS_FIELD_COUNT) {
        cli_fail(CLI_INPUT, "%s: its %s is %" PRId64 ", but %" PRId64 " in %s",
                o->parts[i], sums_field_name(field),
                sums_field_value(part, field), sums_field_value(whole, field),
                o->parts[0]);
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
    options_t o;
    sums_t whole, part;
    cli_out_t picture, save;

    cli_begin("qlux-merge");
    parse(&o, argc, argv);
    if (o.picture != NULL) {
        (void)image_kind("-o", o.picture); /* before the work */
    }
    sums_read(&whole, o.parts[0]);
    for (int i = 1; i < o.part_count; i++) {
        sums_read(&part, o.parts[i]);
        check_fit(&whole, &part, &o, i);
        add_part(&whole, &part, o.parts[i]);
        sums_free(&part);
    }
    if (!o.quiet) {
        warn_of_gaps(&whole);
    }
    if (o.picture != NULL) {
        cli_out_open(&picture, o.picture);
        develop_write(&whole, image_kind("-o", o.picture), o.format, &picture);
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
    free(o.parts);
    return CLI_DONE;
}
