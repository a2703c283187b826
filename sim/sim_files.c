/* sim_files.c - what qlux-sim reads and writes beside the scene */
/* SPDX-License-Identifier: MIT */

#define _XOPEN_SOURCE     700 /* fileno() */
#define _FILE_OFFSET_BITS 64

#include "sim/sim_files.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "film/ql_curve.h"
#include "lib/files/kind.h"
#include "lib/render/fields.h"

void sim_files_open(sim_files_t *files, const render_options_t *options)
{
    memset(files, 0, sizeof *files);
    files->options = options;
    if (options->picture != NULL) {
        cli_out_open(&files->picture, options->picture);
    }
    if (options->save != NULL) {
        cli_out_open(&files->save, options->save);
    }
    if (options->map != NULL) {
        cli_out_open(&files->map, options->map);
    }
}

double sim_files_mean_count(const sums_t *sums)
{
    const uint32_t width = sums->field[SUMS_WIDTH];
    double sum = 0;

    for (uint32_t y = sums->row_first; y < sums->row_end; y++) {
        for (uint32_t x = 0; x < width; x++) {
            sum += sums_count(sums, x, y);
        }
    }
    return sum / ((double)width * (sums->row_end - sums->row_first));
}

/* As a display shows it. */
static develop_t display_of(const render_options_t *o)
{
    const develop_t how = {.kind = o->kind,
            .format = o->format,
            .curve = ql_curve_of(&o->settings),
            .exposure_q8 = o->settings.exposure_q8};

    return how;
}

static void write_picture(sim_files_t *files, const sums_t *sums)
{
    const develop_t how = display_of(files->options);

    develop_write(sums, &how, &files->picture);
    cli_out_commit(&files->picture);
}

/* How many samples each pixel took. */
static void write_map(sim_files_t *files, const sums_t *sums)
{
    image_writer_t writer;
    image_t line;

    image_new_floats(&line, sums->field[SUMS_WIDTH], 1);
    image_begin(&writer, IMAGE_PFM, line.width, sums->field[SUMS_HEIGHT],
            &files->map);
    for (uint32_t i = 0; i < sums->field[SUMS_HEIGHT]; i++) {
        for (uint32_t k = 0; k < 3 * line.width; k++) {
            line.floats[k] = (float)sums_count(/* exact: <= 2^24 */
                    sums, k / 3, image_row_at(&writer, i));
        }
        image_row(&writer, &line);
    }
    image_end(&writer);
    image_free(&line);
    cli_out_commit(&files->map);
}

/* In the terminal. */
static void show(sim_files_t *files, const sums_t *sums)
{
    const develop_t how = display_of(files->options);
    image_t line;

    if (!files->options->show) {
        return;
    }
    if (files->blocks.sums == NULL) {
        blocks_begin(&files->blocks, sums->field[SUMS_WIDTH],
                sums->field[SUMS_HEIGHT]);
    }
    image_new_bytes(&line, sums->field[SUMS_WIDTH], 1);
    for (uint32_t y = sums->row_first; y < sums->row_end; y++) {
        develop_row(&line, sums, sums_pixels(sums, y), y, &how);
        blocks_row(&files->blocks, y, line.bytes);
    }
    blocks_draw(&files->blocks, stderr);
    image_free(&line);
}

static void write_sums(cli_out_t *save, const sums_t *sums)
{
    sums_write(sums, save);
    cli_out_commit(save);
}

void sim_files_write(sim_files_t *files, const sums_t *sums)
{
    const render_options_t *o = files->options;

    show(files, sums);
    blocks_free(&files->blocks);
    if (o->save != NULL) {
        write_sums(&files->save, sums);
    }
    if (o->picture != NULL) {
        write_picture(files, sums);
    }
    if (o->map != NULL) {
        write_map(files, sums);
    }
}

void sim_files_renew(void *files, const sums_t *sums)
{
    sim_files_t *f = files;

    show(f, sums);
    if (f->options->progressive) {
        write_picture(f, sums);
        cli_out_open(&f->picture, f->options->picture);
    }
}

/* Where the sums of a run go that has no file for them: beside a picture that
 * has a name. Sums of pixels that end by themselves are not kept. */
static char *name_sums(const sim_files_t *files, const sums_t *sums)
{
    const char *picture = files->options->picture;
    size_t size;
    char *name;

    if (files->picture.temporary == NULL || sums->counts != NULL) {
        return NULL;
    }
    size = strlen(picture) + sizeof ".qls";
    name = cli_alloc(size, 1);
    snprintf(name, size, "%s.qls", picture);
    return name;
}

void sim_files_write_part(sim_files_t *files, const sums_t *sums)
{
    const render_options_t *o = files->options;
    const double count = sim_files_mean_count(sums);
    char *beside = o->save == NULL ? name_sums(files, sums) : NULL;
    const char *name = o->save == NULL ? beside : o->save;

    if (count == 0) {
        cli_fail(CLI_IO, "interrupted; nothing was written");
    }
    if (beside != NULL) {
        cli_out_t save;

        cli_out_open(&save, beside);
        write_sums(&save, sums);
    }
    sim_files_write(files, sums);
    if (name == NULL) {
        cli_fail(CLI_IO,
                "interrupted after %.4g of %" PRIu32 " samples a pixel", count,
                o->samples.end - o->samples.first);
    }
    cli_fail(CLI_IO,
            "interrupted after %.4g of %" PRIu32 " samples a pixel; "
            "go on with --resume %s",
            count, o->samples.end - o->samples.first, name);
}

/* ---- Go on ---- */

/* All of its samples must be of this run. */
static void check_range(
        const char *path, const sums_range_t *range, const sums_range_t *whole)
{
    if (range->row_first < whole->row_first ||
            range->row_end > whole->row_end ||
            range->sample_first < whole->sample_first ||
            range->sample_end > whole->sample_end) {
        cli_fail(CLI_INPUT,
                "%s: rows %" PRIu32 ":%" PRIu32 " samples %" PRIu32 ":%" PRIu32
                " are not of this run",
                path, range->row_first, range->row_end, range->sample_first,
                range->sample_end);
    }
}

static void check_settings(
        const char *path, const sums_t *of_file, const sums_t *here)
{
    const unsigned field = sums_compare(of_file, here);
    char text[2][FIELDS_TEXT_BYTES];

    if (field != SUMS_FIELD_COUNT) {
        cli_fail(CLI_INPUT, "%s: its %s is %s, but %s here", path,
                fields_name(field), fields_text(text[0], of_file, field),
                fields_text(text[1], here, field));
    }
}

void sim_files_resume(sums_t *sums, const char *path, const sums_range_t *whole)
{
    FILE *from = fopen(path, "rb");
    sums_file_t file = {.path = path};
    const char *error;
    struct stat info;
    uint64_t where;
    uint32_t clash[2];

    if (from == NULL || fstat(fileno(from), &info) != 0) {
        cli_fail(CLI_IO, "cannot read %s: %s", path, strerror(errno));
    }
    if (!S_ISREG(info.st_mode)) {
        cli_fail(CLI_IO, "cannot read %s: --resume needs a file", path);
    }
    file.fd = fileno(from);
    file.size = (uint64_t)info.st_size;
    error = sums_open(&file, &where);
    if (error != NULL) {
        kind_refuse_file(path, KIND_SUMS);
        cli_fail(CLI_INPUT, "%s: byte %" PRIu64 ": %s", path, where, error);
    }
    check_settings(path, &file.head, sums);
    sums_add_pixels(&sums->cut, &file.head.cut, 1);
    for (uint32_t i = 0; i < file.head.ranges.count; i++) {
        check_range(path, file.head.ranges.items + i, whole);
        ranges_add(&sums->ranges, file.head.ranges.items + i);
    }
    (void)sums_settle(sums, clash); /* they did not overlap in the file */
    for (uint32_t y = whole->row_first; y < whole->row_end; y++) {
        (void)sums_row(&file, y, sums_pixels(sums, y));
    }
    sums_close(&file);
    fclose(from);
}
