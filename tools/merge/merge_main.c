/* merge_main.c - qlux-merge: add up parts of one picture, bit for bit */
/* SPDX-License-Identifier: MIT */

#define _XOPEN_SOURCE     700 /* fileno() */
#define _FILE_OFFSET_BITS 64

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "lib/image/pnm.h"
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
                 "them. Rows pass one by one, so a picture may be larger than "
                 "memory, but for a .png, which is put together there.",
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

/* What is merged, a row at a time. */
typedef struct {
    sums_t whole; /* fields and ranges; no pixels */
    sums_file_t *parts;
    const option_list_t *names;
    ql_sum_t *sum, *add; /* rows */
} merge_t;

/* A file that can seek: what cannot is copied into a temporary one. */
static FILE *open_part(const char *path, uint64_t *size)
{
    FILE *file = strcmp(path, "-") == 0 ? stdin : fopen(path, "rb"), *copy;
    char bytes[BUFSIZ];
    struct stat info;
    size_t n;

    if (file == NULL || fstat(fileno(file), &info) != 0) {
        cli_fail(CLI_IO, "cannot read %s: %s", path, strerror(errno));
    }
    if (!S_ISREG(info.st_mode)) {
        copy = tmpfile();
        while (copy != NULL && (n = fread(bytes, 1, BUFSIZ, file)) > 0) {
            fwrite(bytes, 1, n, copy);
        }
        if (ferror(file) || copy == NULL || fflush(copy) != 0 ||
                fstat(fileno(copy), &info) != 0) {
            cli_fail(CLI_IO, "cannot read %s: %s", path, strerror(errno));
        }
        file = copy;
    }
    *size = (uint64_t)info.st_size;
    return file;
}

/* The part must be of the same picture as the first one. */
static void check_fit(const merge_t *m, unsigned i)
{
    const sums_t *part = &m->parts[i].head;
    const unsigned field = sums_compare(&m->whole, part);
    char text[2][FIELDS_TEXT_BYTES];

    if (field != SUMS_FIELD_COUNT) {
        cli_fail(CLI_INPUT, "%s: its %s is %s, but %s in %s",
                m->names->items[i], fields_name(field),
                fields_text(text[0], part, field),
                fields_text(text[1], &m->whole, field), m->names->items[0]);
    }
}

static void claim_ranges(merge_t *m, unsigned i)
{
    const sums_t *part = &m->parts[i].head;
    sums_range_t clash;

    for (uint32_t k = 0; k < part->range_count; k++) {
        if (!sums_claim(&m->whole, part->ranges + k, &clash)) {
            cli_fail(CLI_INPUT,
                    "%s: rows %u:%u samples %u:%u were counted before",
                    m->names->items[i], (unsigned)clash.row_first,
                    (unsigned)clash.row_end, (unsigned)clash.sample_first,
                    (unsigned)clash.sample_end);
        }
    }
}

/* Open all parts; they stay open, however many they are. */
static void begin_merge(merge_t *m, const option_list_t *names)
{
    struct rlimit files;
    uint64_t size, where;
    const char *error;
    FILE *file;

    if (getrlimit(RLIMIT_NOFILE, &files) == 0) {
        files.rlim_cur = files.rlim_max;
        (void)setrlimit(RLIMIT_NOFILE, &files);
    }
    memset(m, 0, sizeof *m);
    m->names = names;
    m->parts = cli_alloc(names->count, sizeof *m->parts);
    for (unsigned i = 0; i < names->count; i++) {
        file = open_part(names->items[i], &size);
        error = sums_open(m->parts + i, fileno(file), size, &where);
        if (error != NULL) {
            cli_fail(CLI_INPUT, "%s: byte %" PRIu64 ": %s", names->items[i],
                    where, error);
        }
        if (i == 0) {
            memcpy(m->whole.field, m->parts[0].head.field,
                    sizeof m->whole.field);
        }
        check_fit(m, i);
        claim_ranges(m, i);
    }
    m->sum = cli_alloc(m->whole.field[SUMS_WIDTH], sizeof *m->sum);
    m->add = cli_alloc(m->whole.field[SUMS_WIDTH], sizeof *m->add);
}

/* Row y of the whole in m->sum. Sums stay at their maximum as they do while
 * rendering, so any order of adding gives the same bits. */
static void add_rows(merge_t *m, uint32_t y)
{
    const size_t n = 3 * (size_t)m->whole.field[SUMS_WIDTH];

    memset(m->sum, 0, n / 3 * sizeof *m->sum);
    for (unsigned i = 0; i < m->names->count; i++) {
        if (!sums_row(m->parts + i, y, m->add)) {
            continue;
        }
        for (size_t k = 0; k < n; k++) {
            uint64_t *sum = m->sum[k / 3].rgb + k % 3;
            const uint64_t add = m->add[k / 3].rgb[k % 3];
            *sum = add > UINT64_MAX - *sum ? UINT64_MAX : *sum + add;
        }
    }
}

/* Row by row, but for a PNG, whose bytes are compressed as one. */
static void write_picture(merge_t *m, const options_t *o, cli_out_t *out)
{
    const image_kind_t kind = image_kind(o->picture);
    const uint32_t height = m->whole.field[SUMS_HEIGHT];
    const uint32_t rows = kind == IMAGE_PNG ? height : 1;
    image_t image,
            size = {.width = m->whole.field[SUMS_WIDTH], .height = height};

    if (kind == IMAGE_PFM) {
        image_new_floats(&image, size.width, rows);
    } else {
        image_new_bytes(&image, size.width, rows);
    }
    if (kind != IMAGE_PNG) {
        pnm_write_head(kind == IMAGE_PFM ? "PF" : "P6", &size, out->file);
    }
    for (uint32_t i = 0; i < height; i++) {
        const uint32_t y = kind == IMAGE_PFM ? height - 1 - i : i;

        add_rows(m, y);
        develop_row(&image, &m->whole, m->sum, y, o->format);
        if (kind != IMAGE_PNG) {
            pnm_write_row(&image, out->file);
        }
    }
    if (kind == IMAGE_PNG) {
        image_write(&image, kind, out);
    }
    image_free(&image);
}

static void write_sums(merge_t *m, cli_out_t *out)
{
    sums_writer_t to;

    sums_write_head(&to, &m->whole, out);
    for (uint32_t y = 0; y < m->whole.field[SUMS_HEIGHT]; y++) {
        if (sums_row_count(&m->whole, y) != 0) {
            add_rows(m, y);
            sums_write_row(&to, m->sum, m->whole.field[SUMS_WIDTH]);
        }
    }
    sums_write_end(&to);
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
    merge_t m;
    cli_out_t picture, save;

    options_parse(&program, argc, argv, &o);
    check_options(&o);
    begin_merge(&m, &o.parts);
    if (!o.quiet) {
        warn_of_gaps(&m.whole);
    }
    if (o.picture != NULL) {
        cli_out_open(&picture, o.picture);
        write_picture(&m, &o, &picture);
    }
    if (o.save != NULL) {
        cli_out_open(&save, o.save);
        write_sums(&m, &save);
        cli_out_commit(&save);
    }
    if (o.picture != NULL) {
        cli_out_commit(&picture);
    }
    for (unsigned i = 0; i < o.parts.count; i++) {
        sums_free(&m.parts[i].head);
    }
    sums_free(&m.whole);
    free(m.parts);
    free(m.sum);
    free(m.add);
    return CLI_DONE;
}
