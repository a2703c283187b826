/* merge_main.c - qlux-merge: add up parts of one picture, bit for bit */
/* SPDX-License-Identifier: MIT */

#define _XOPEN_SOURCE     700 /* fileno() */
#define _FILE_OFFSET_BITS 64

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "lib/files/kind.h"
#include "lib/program/options.h"
#include "lib/render/develop.h"
#include "lib/render/fields.h"
#include "lib/render/render_options.h"

typedef struct {
    const char *picture;
    const char *save;
    ql_format_t format;
    double exposure;
    ql_curve_t curve;
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
        {"--exposure S", OPTION_REAL, AT(exposure), .min = -64, .max = 64,
                .words = render_words_exposure,
                .help = "stops brighter than the scene's own exposure; auto "
                        "is what the parts were metered at"},
        {"--curve C", OPTION_WORD, AT(curve), .words = render_words_curve,
                .help = "how bright light is shown; filmic and reinhard let "
                        "it roll off to white"},
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
                 "them. Rows pass a few at a time, so a picture may be larger "
                 "than memory.",
        .example = "qlux-sim box.qlb --rows 0:64 --save-sums top.qls\n"
                   "qlux-sim box.qlb --rows 64:128 --save-sums low.qls\n"
                   "qlux-merge top.qls low.qls -o box.png"};

static void check_options(const options_t *o)
{
    if (o->picture == NULL && o->save == NULL) {
        options_fail("missing -o FILE or --save-sums FILE");
    }
    if (o->picture == NULL || image_kind(o->picture) == IMAGE_PFM) {
        render_options_display();
    }
}

/* Rows are added up in batches of at most so many bytes, if more than one. */
#define BATCH_BYTES (16u << 20)

/* A part is open only while it is read. */
typedef struct {
    sums_file_t file;
    ino_t inode; /* of the file, to know it again; 0: it is in the spool */
    off_t size;
    uint32_t range_end; /* its ranges, in the list of all, end before this */
} part_t;

typedef struct {
    sums_t whole; /* fields and ranges; no pixels */
    part_t *parts;
    unsigned part_count;
    FILE *spool; /* copies of all parts that cannot seek, or NULL */
    uint32_t batch_rows;
    uint32_t batch_first;
    ql_sum_t *batch; /* sums of so many rows from there on; height: none yet */
    ql_sum_t *row;   /* of one part */
} merge_t;

static void fail_to_read(const char *path)
{
    cli_fail(CLI_IO, "cannot read %s: %s", path, strerror(errno));
}

/* What cannot seek goes behind what is in the spool. */
static void spool_part(merge_t *m, part_t *part, FILE *from)
{
    char bytes[BUFSIZ];
    size_t n;

    if (m->spool == NULL) {
        m->spool = tmpfile();
    }
    if (m->spool == NULL) {
        cli_fail(CLI_IO, "cannot write a temporary file: %s", strerror(errno));
    }
    part->file.base = (uint64_t)ftello(m->spool);
    while ((n = fread(bytes, 1, BUFSIZ, from)) > 0) {
        fwrite(bytes, 1, n, m->spool);
    }
    if (ferror(from)) {
        fail_to_read(part->file.path);
    }
    if (fflush(m->spool) != 0) {
        cli_fail(CLI_IO, "cannot write a temporary file: %s", strerror(errno));
    }
    part->file.fd = fileno(m->spool);
    part->file.size = (uint64_t)ftello(m->spool) - part->file.base;
}

/* Find a part's bytes for the first time. */
static void begin_part(merge_t *m, part_t *part)
{
    const char *path = part->file.path;
    FILE *file = strcmp(path, "-") == 0 ? stdin : fopen(path, "rb");
    struct stat info;

    if (file == NULL || fstat(fileno(file), &info) != 0) {
        fail_to_read(path);
    } else if (file == stdin || !S_ISREG(info.st_mode)) {
        spool_part(m, part, file);
    } else {
        part->inode = info.st_ino;
        part->size = info.st_size;
        part->file.size = (uint64_t)info.st_size;
    }
    if (file != NULL && file != stdin) {
        fclose(file);
    }
}

static void open_part(part_t *part)
{
    struct stat info;

    if (part->inode == 0) {
        return;
    }
    part->file.fd = open(part->file.path, O_RDONLY);
    if (part->file.fd < 0 || fstat(part->file.fd, &info) != 0) {
        fail_to_read(part->file.path);
    }
    if (info.st_ino != part->inode || info.st_size != part->size) {
        cli_fail(CLI_IO, "cannot read %s: it was replaced meanwhile",
                part->file.path);
    }
}

static void close_part(const part_t *part)
{
    if (part->inode != 0) {
        close(part->file.fd);
    }
}

/* The part must be of the same picture as the first one. */
static void check_fit(const merge_t *m, const part_t *part)
{
    const sums_t *head = &part->file.head;
    const unsigned field = sums_compare(&m->whole, head);
    char text[2][FIELDS_TEXT_BYTES];

    if (field != SUMS_FIELD_COUNT) {
        cli_fail(CLI_INPUT, "%s: its %s is %s, but %s in %s", part->file.path,
                fields_name(field), fields_text(text[0], head, field),
                fields_text(text[1], &m->whole, field), m->parts[0].file.path);
    }
}

/* Check a part, and move its ranges into the list of all. */
static void take_part(merge_t *m, part_t *part)
{
    ranges_t *ranges = &part->file.head.ranges;
    const char *error;
    uint64_t where;

    begin_part(m, part);
    open_part(part);
    error = sums_open(&part->file, &where);
    close_part(part);
    if (error != NULL) {
        kind_refuse_file(part->file.path, KIND_SUMS);
        cli_fail(CLI_INPUT, "%s: byte %" PRIu64 ": %s", part->file.path, where,
                error);
    }
    if (part == m->parts) {
        memcpy(m->whole.field, part->file.head.field, sizeof m->whole.field);
    }
    check_fit(m, part);
    for (uint32_t i = 0; i < ranges->count; i++) {
        ranges_add(&m->whole.ranges, ranges->items + i);
    }
    sums_add_pixels(&m->whole.cut, &part->file.head.cut, 1);
    part->range_end = m->whole.ranges.count;
    ranges_free(ranges);
}

/* Which part has a range of the list of all. */
static const char *holder(const merge_t *m, uint32_t range)
{
    const part_t *part = m->parts;

    while (part->range_end <= range) {
        part++;
    }
    return part->file.path;
}

/* No sample may be in two parts. */
static void settle(merge_t *m)
{
    const sums_range_t *r;
    uint32_t clash[2];

    if (sums_settle(&m->whole, clash)) {
        return;
    }
    r = m->whole.ranges.items + clash[0];
    cli_fail(CLI_INPUT,
            "%s: rows %u:%u samples %u:%u were counted before, in %s",
            holder(m, clash[1]), (unsigned)r->row_first, (unsigned)r->row_end,
            (unsigned)r->sample_first, (unsigned)r->sample_end,
            holder(m, clash[0]));
}

static void begin_merge(merge_t *m, const option_list_t *names)
{
    uint32_t width, height;

    memset(m, 0, sizeof *m);
    m->part_count = names->count;
    m->parts = cli_alloc(names->count, sizeof *m->parts);
    for (unsigned i = 0; i < names->count; i++) {
        m->parts[i].file.path = names->items[i];
        take_part(m, m->parts + i);
    }
    width = m->whole.field[SUMS_WIDTH];
    height = m->whole.field[SUMS_HEIGHT];
    sums_new(&m->whole, 0, 0);
    settle(m);
    m->batch_rows = BATCH_BYTES / sizeof *m->batch / width; /* width <= 2^14 */
    if (m->batch_rows > height) {
        m->batch_rows = height;
    }
    m->batch_first = height;
    m->batch = cli_alloc(m->batch_rows, width * sizeof *m->batch);
    m->row = cli_alloc(width, sizeof *m->row);
}

static void end_merge(merge_t *m)
{
    for (unsigned i = 0; i < m->part_count; i++) {
        sums_close(&m->parts[i].file);
    }
    sums_free(&m->whole);
    if (m->spool != NULL) {
        fclose(m->spool);
    }
    free(m->parts);
    free(m->batch);
    free(m->row);
}

static void add_batch(merge_t *m, uint32_t first)
{
    const uint32_t width = m->whole.field[SUMS_WIDTH];
    const uint32_t height = m->whole.field[SUMS_HEIGHT];
    const uint32_t end =
            height - first < m->batch_rows ? height : first + m->batch_rows;

    m->batch_first = first;
    memset(m->batch, 0, (size_t)width * m->batch_rows * sizeof *m->batch);
    for (unsigned i = 0; i < m->part_count; i++) {
        part_t *part = m->parts + i;

        if (!sums_holds(&part->file, first, end)) {
            continue;
        }
        open_part(part);
        for (uint32_t y = first; y < end; y++) {
            if (sums_row(&part->file, y, m->row)) {
                sums_add_pixels(
                        m->batch + (size_t)width * (y - first), m->row, width);
            }
        }
        close_part(part);
    }
}

/* Row y of the whole. */
static const ql_sum_t *merged_row(void *from, uint32_t y)
{
    merge_t *m = from;
    const uint32_t first = y / m->batch_rows * m->batch_rows;

    if (first != m->batch_first) {
        add_batch(m, first);
    }
    return m->batch + (size_t)m->whole.field[SUMS_WIDTH] * (y - first);
}

static void write_sums(merge_t *m, cli_out_t *out)
{
    sums_writer_t to;

    sums_write_head(&to, &m->whole, out);
    for (uint32_t y = 0; y < m->whole.field[SUMS_HEIGHT]; y++) {
        if (sums_row_count(&m->whole, y) != 0) {
            sums_write_row(&to, merged_row(m, y), m->whole.field[SUMS_WIDTH]);
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
    develop_t how = {.row = merged_row, .from = &m};
    cli_out_t picture, save;
    bool metered;

    options_parse(&program, argc, argv, &o);
    check_options(&o);
    begin_merge(&m, &o.parts);
    if (!o.quiet) {
        warn_of_gaps(&m.whole);
    }
    if (o.picture != NULL) {
        how.kind = image_kind(o.picture);
        how.format = o.format;
        how.curve = o.curve;
        render_options_expose(o.exposure, &how.exposure_q8, &metered);
        if (metered) {
            how.exposure_q8 =
                    (int16_t)sums_field_value(&m.whole, SUMS_METERED_Q8);
        }
        cli_out_open(&picture, o.picture);
        develop_write(&m.whole, &how, &picture);
    }
    if (o.save != NULL) {
        cli_out_open(&save, o.save);
        write_sums(&m, &save);
        cli_out_commit(&save);
    }
    if (o.picture != NULL) {
        cli_out_commit(&picture);
    }
    end_merge(&m);
    return CLI_DONE;
}
