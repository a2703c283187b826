/* ref_main.c - qlux-ref: a scene in double precision, as the core renders it */
/* SPDX-License-Identifier: MIT */

#include <inttypes.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "qlux.h"
#include "ref/ref.h"
#include "lib/render/render_options.h"

#define STEP_SAMPLES 4096u /* between two looks at Ctrl-C */

static const char help[] =
        "qlux-ref: a scene in double precision, with the random numbers of\n"
        "qlux-sim: what differs is the rounding of the core's integers\n"
        "\n"
        "  qlux-ref SCENE.qlb -o OUT.{pfm,ppm,png} [options]\n"
        "\n"
        "Options are those of qlux-sim (see qlux-sim --help), but there are\n"
        "no exact sums to save:\n"
        "  -o FILE            .pfm linear radiance in the units of Ke; .ppm\n"
        "                     and .png as a display shows it\n"
        "  --size WxH  --spp N  --seed N  --sampler S  --direct D\n"
        "  --indirect I  --bounces N  --lights L  --light-samples N\n"
        "  --roulette  --format F  --rows A:B  --samples A:B  --threads N\n"
        "  --stats  --quiet  --version\n"
        "\n"
        "Exit: 0 done, 1 usage, 2 bad scene, 3 cannot read or write, stopped\n"
        "\n"
        "Example:\n"
        "  qlux-sim cornell.qlb -o a.pfm --spp 64\n"
        "  qlux-ref cornell.qlb -o b.pfm --spp 64\n"
        "  qlux-diff a.pfm b.pfm\n";

/* What the threads share. Rows are handed out one by one. */
typedef struct {
    pthread_mutex_t lock;
    const ref_scene_t *scene;
    const render_options_t *options;
    double *rgb; /* sums in radiance units */
    uint32_t next_row;
    uint64_t done, total; /* samples */
    ref_stats_t stats;
} job_t;

static void options_of_its_own(int argc, char **argv)
{
    bool has_picture = false;

    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
            fputs(help, stdout);
            exit(CLI_DONE);
        }
        if (strcmp(argv[i], "--version") == 0) {
            puts("qlux-ref " QLUX_VERSION);
            exit(CLI_DONE);
        }
        if (strcmp(argv[i], "--error") == 0 ||
                strcmp(argv[i], "--samples-map") == 0) {
            cli_fail(CLI_USAGE, "'%s': every pixel takes all samples here",
                    argv[i]);
        }
        if (strcmp(argv[i], "--save-sums") == 0) {
            cli_fail(CLI_USAGE, "'--save-sums': sums of doubles are not exact; "
                                "use -o with a .pfm name");
        }
        has_picture = has_picture || strcmp(argv[i], "-o") == 0;
    }
    if (argc > 1 && !has_picture) {
        cli_fail(CLI_USAGE, "give -o (see --help)");
    }
}

/* Where in a blob a status was found, as far as it tells. */
static long blob_offset(ql_status_t status)
{
    static const struct {
        ql_status_t status;
        long offset;
    } places[] = {{QL_ERR_MAGIC, offsetof(ql_blob_header_t, magic)},
            {QL_ERR_VERSION, offsetof(ql_blob_header_t, version)},
            {QL_ERR_TRUNCATED, offsetof(ql_blob_header_t, size_bytes)},
            {QL_ERR_CHECKSUM, offsetof(ql_blob_header_t, crc32)},
            {QL_ERR_FEATURE, offsetof(ql_blob_header_t, features)},
            {QL_ERR_CAPACITY, offsetof(ql_blob_header_t, depth)}};

    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        if (places[i].status == status) {
            return places[i].offset;
        }
    }
    return -1;
}

/* The blob is returned to be freed after use. */
static void *open_scene(ql_scene_t *scene, const char *path)
{
    size_t size;
    void *blob = cli_read(path, &size);
    const ql_status_t status = ql_blob_open(scene, blob, size);
    const long offset = blob_offset(status);
    char where[32] = "";

    if (offset >= 0) {
        snprintf(where, sizeof where, "byte %ld: ", offset);
    }
    if (status != QL_OK) {
        cli_fail(CLI_INPUT, "%s: %s%s%s%s", path, where, ql_status_text(status),
                status == QL_ERR_FEATURE ? ": " : "",
                status == QL_ERR_FEATURE ? ql_blob_missing(blob) : "");
    }
    return blob;
}

static uint32_t take_row(job_t *job)
{
    const uint32_t end = job->options->rows.end;
    uint32_t row;

    pthread_mutex_lock(&job->lock);
    row = cli_interrupted() ? end : job->next_row;
    job->next_row += row < end;
    pthread_mutex_unlock(&job->lock);
    return row;
}

static void report(job_t *job, ref_stats_t *stats, uint64_t *samples)
{
    pthread_mutex_lock(&job->lock);
    job->stats.paths += stats->paths;
    job->stats.closest_rays += stats->closest_rays;
    job->stats.shadow_rays += stats->shadow_rays;
    job->done += *samples;
    cli_progress("reference", job->done, job->total, job->options->quiet);
    pthread_mutex_unlock(&job->lock);
    memset(stats, 0, sizeof *stats);
    *samples = 0;
}

static void render_row(job_t *job, uint32_t y, ref_stats_t *stats)
{
    const render_options_t *o = job->options;
    const uint32_t width = o->settings.width;
    uint64_t fresh = 0;

    for (uint32_t x = 0; x < width; x++) {
        double *rgb = job->rgb + 3 * ((size_t)width * y + x);
        uint32_t at = o->samples.first;

        while (at < o->samples.end && !cli_interrupted()) {
            const uint32_t left = o->samples.end - at;
            const uint32_t n = left < STEP_SAMPLES ? left : STEP_SAMPLES;

            ref_pixel(job->scene, &o->settings, (uint16_t)x, (uint16_t)y, at, n,
                    rgb, stats);
            at += n;
            fresh += n;
            if (fresh >= STEP_SAMPLES) {
                report(job, stats, &fresh);
            }
        }
    }
    report(job, stats, &fresh);
}

static void *work(void *shared)
{
    job_t *job = shared;
    ref_stats_t stats = {0, 0, 0};
    uint32_t y;

    while ((y = take_row(job)) < job->options->rows.end) {
        render_row(job, y, &stats);
    }
    return NULL;
}

/* This thread and others; fewer if the system has no more. */
static void render(job_t *job)
{
    const unsigned count = job->options->threads;
    pthread_t *threads = cli_alloc(count, sizeof *threads);
    unsigned started = 0;

    pthread_mutex_init(&job->lock, NULL);
    while (started + 1 < count &&
            pthread_create(threads + started, NULL, work, job) == 0) {
        started++;
    }
    work(job);
    while (started > 0) {
        pthread_join(threads[--started], NULL);
    }
    pthread_mutex_destroy(&job->lock);
    free(threads);
    if (job->done != job->total) {
        cli_fail(CLI_IO, "interrupted; nothing was written");
    }
}

/* Means as a picture of floats. */
static void write_linear(const job_t *job, cli_out_t *out)
{
    const render_options_t *o = job->options;
    const double scale = job->scene->unit / (o->samples.end - o->samples.first);
    image_t image;

    image_new(&image, o->settings.width, o->settings.height, true);
    for (size_t i = 0; i < 3 * (size_t)image.width * image.height; i++) {
        image.floats[i] = (float)(job->rgb[i] * scale);
    }
    image_write(&image, IMAGE_PFM, out);
    image_free(&image);
}

/* As a display shows it, by way of the core's sums. */
static void write_display(const job_t *job, cli_out_t *out)
{
    const render_options_t *o = job->options;
    const ql_blob_header_t *h = job->scene->blob->header;
    const sums_range_t range = {
            o->rows.first, o->rows.end, o->samples.first, o->samples.end};
    sums_range_t clash;
    sums_t sums;

    memset(&sums, 0, sizeof sums);
    sums.field[SUMS_WIDTH] = o->settings.width;
    sums.field[SUMS_HEIGHT] = o->settings.height;
    sums.field[SUMS_RADIANCE_EXP] =
            (uint32_t)(int32_t)ql_i16(QL_LE16((uint16_t)h->radiance_exp));
    sums.field[SUMS_EXPOSURE_Q8] =
            (uint32_t)(int32_t)ql_i16(QL_LE16((uint16_t)h->exposure_q8));
    sums_new(&sums);
    (void)sums_claim(&sums, &range, &clash);
    for (size_t i = 0; i < 3 * (size_t)o->settings.width * o->settings.height;
            i++) {
        const double sum = ldexp(job->rgb[i], QL_SUM_BITS) + 0.5;

        sums.pixels[i / 3].rgb[i % 3] =
                sum < ldexp(1, 63) ? (uint64_t)sum : UINT64_MAX;
    }
    develop_write(&sums, o->kind, o->format, out);
    sums_free(&sums);
}

static void print_stats(const ref_stats_t *s, double seconds)
{
    const double rays = (double)s->closest_rays + (double)s->shadow_rays;

    printf("paths: %" PRIu64 "\n", s->paths);
    printf("closest-rays: %" PRIu64 "\n", s->closest_rays);
    printf("shadow-rays: %" PRIu64 "\n", s->shadow_rays);
    printf("rays-per-path: %.3f\n",
            s->paths != 0 ? rays / (double)s->paths : 0);
    printf("seconds: %.3f\n", seconds);
    printf("precision: double\n");
}

/* Width and height as they will be; rows within them. */
static void resolve(render_options_t *o, const ql_scene_t *scene)
{
    const ql_blob_header_t *h = scene->header;

    if (o->settings.width == 0) {
        o->settings.width = QL_LE16(h->image_width);
        o->settings.height = QL_LE16(h->image_height);
    }
    render_options_rows(o, o->settings.height);
}

int main(int argc, char **argv)
{
    const double begun = cli_seconds();
    render_options_t options;
    ref_scene_t scene;
    ql_scene_t blob;
    cli_out_t out;
    job_t job;
    void *bytes;

    cli_begin("qlux-ref");
    options_of_its_own(argc, argv);
    render_options_parse(&options, argc, argv);
    bytes = open_scene(&blob, options.scene);
    resolve(&options, &blob);
    ref_scene_init(&scene, &blob);
    memset(&job, 0, sizeof job);
    job.scene = &scene;
    job.options = &options;
    job.next_row = options.rows.first;
    job.total = (uint64_t)(options.rows.end - options.rows.first) *
                options.settings.width *
                (options.samples.end - options.samples.first);
    job.rgb =
            cli_alloc((size_t)options.settings.width * options.settings.height,
                    3 * sizeof *job.rgb);
    cli_out_open(&out, options.picture);
    render(&job);
    if (options.kind == IMAGE_PFM) {
        write_linear(&job, &out);
    } else {
        write_display(&job, &out);
    }
    cli_out_commit(&out);
    if (options.stats) {
        print_stats(&job.stats, cli_seconds() - begun);
    }
    free(job.rgb);
    ref_scene_free(&scene);
    free(bytes);
    return CLI_DONE;
}
