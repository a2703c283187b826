/* bench_pc.c - qlux against the float tracer on this PC, on the same rays */
/* SPDX-License-Identifier: MIT */

/* Each repetition times one tracer and then the other, so what slows the PC
 * down slows both; a ratio is the median over the repetitions. CPU time, so
 * other programs count little. */

#include "bench/rays/bench_rays.h"
#include "bench/rays/float_pt.h"
#include "qlux.h"
#include "trace/ql_bvh.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define EXIT_USAGE 1
#define EXIT_INPUT 2
#define EXIT_FILE  3

#define PICTURE_SIZE 64 /* px, square */
#define PICTURE_SPP  4
#define COMPARE_SPP  64    /* to compare the pictures' means */
#define REPETITIONS  31    /* unless the command line has fewer */
#define AGREE_MIN    0.999 /* same triangle by both tracers */
#define MEAN_MAX     0.01  /* relative difference of the pictures' means */

#define PRECISION (QL_CFG_PRECISION == 0 ? "draft" : "fine")

/* Rays of one scene as each tracer wants them, and their figures. */
typedef struct {
    void *blob, *memory;
    ql_scene_t scene;
    ql_render_t render;
    fp_scene_t fp;
    bench_batch_t rays;
    fp_ray_t *fp_closest, *fp_shadow;
    uint32_t spp;
    size_t repetitions; /* 1 .. REPETITIONS */
} case_t;

/* What one tracer does to a whole case; returns a number that depends on it. */
typedef double (*work_t)(case_t *);

typedef struct {
    double ratio;             /* median of qlux / float */
    double qlux_ns, float_ns; /* medians, per call */
} figure_t;

static void *allocate(size_t count, size_t size)
{
    void *memory = calloc(count > 0 ? count : 1, size);

    if (memory == NULL) {
        fprintf(stderr, "bench-pc: out of memory\n");
        exit(EXIT_FILE);
    }
    return memory;
}

static void *read_file(const char *name, size_t *size)
{
    FILE *file = fopen(name, "rb");
    void *bytes = NULL;
    long end;

    if (file != NULL && fseek(file, 0, SEEK_END) == 0 &&
            (end = ftell(file)) >= 0 && fseek(file, 0, SEEK_SET) == 0) {
        *size = (size_t)end;
        bytes = allocate(*size, 1);
        if (fread(bytes, 1, *size, file) != *size) {
            free(bytes);
            bytes = NULL;
        }
    }
    if (file != NULL) {
        fclose(file);
    }
    if (bytes == NULL) {
        fprintf(stderr, "bench-pc: cannot read %s\n", name);
        exit(EXIT_FILE);
    }
    return bytes;
}

static void case_open(case_t *c, const char *name)
{
    const uint32_t paths = PICTURE_SIZE * PICTURE_SIZE * PICTURE_SPP;
    ql_settings_t settings = QL_SETTINGS_DEFAULT;
    bench_batch_t *b = &c->rays;
    ql_status_t status;
    uint32_t next = 0;
    size_t size;

    settings.width = PICTURE_SIZE;
    settings.height = PICTURE_SIZE;
    settings.spp = PICTURE_SPP;
    c->spp = PICTURE_SPP;
    settings.bounces = BENCH_BOUNCES;
    settings.direct = QL_DIRECT_AREA;
    settings.lights = QL_LIGHTS_POWER;
    c->blob = read_file(name, &size);
    status = ql_blob_open(&c->scene, c->blob, size);
    if (status == QL_OK) {
        status = ql_render_init(&c->render, &c->scene, &settings);
    }
    if (status != QL_OK) {
        fprintf(stderr, "bench-pc: %s: %s\n", name, ql_status_text(status));
        exit(EXIT_INPUT);
    }
    c->memory = allocate(fp_bytes(&c->scene), 1);
    fp_open(&c->fp, &c->scene, c->memory);

    b->capacity = paths * BENCH_PATH_RAYS;
    b->closest = allocate(b->capacity, sizeof *b->closest);
    b->shadow = allocate(b->capacity, sizeof *b->shadow);
    b->warps = allocate(b->capacity, sizeof *b->warps);
    (void)bench_rays_fill(b, &c->render, &next);
    c->fp_closest = allocate(b->closest_count, sizeof *c->fp_closest);
    c->fp_shadow = allocate(b->shadow_count, sizeof *c->fp_shadow);
    for (uint32_t i = 0; i < b->closest_count; i++) {
        c->fp_closest[i] = fp_ray(b->closest + i, false);
    }
    for (uint32_t i = 0; i < b->shadow_count; i++) {
        c->fp_shadow[i] = fp_ray(b->shadow + i, true);
    }
}

static void case_close(case_t *c)
{
    free(c->blob);
    free(c->memory);
    free(c->rays.closest);
    free(c->rays.shadow);
    free(c->rays.warps);
    free(c->fp_closest);
    free(c->fp_shadow);
}

/* ---- the work ---- */

static double qlux_closest(case_t *c)
{
    uint32_t sum = 0;

    for (uint32_t i = 0; i < c->rays.closest_count; i++) {
        ql_hit_t hit;

        if (ql_bvh_closest_hit(&c->scene, c->rays.closest + i, &hit)) {
            sum += hit.tri_idx;
        }
    }
    return sum;
}

static double float_closest(case_t *c)
{
    uint32_t sum = 0;

    for (uint32_t i = 0; i < c->rays.closest_count; i++) {
        fp_hit_t hit;

        if (fp_closest(&c->fp, c->fp_closest + i, &hit)) {
            sum += hit.triangle;
        }
    }
    return sum;
}

static double qlux_shadow(case_t *c)
{
    uint32_t sum = 0;

    for (uint32_t i = 0; i < c->rays.shadow_count; i++) {
        sum += ql_bvh_occluded(&c->scene, c->rays.shadow + i);
    }
    return sum;
}

static double float_shadow(case_t *c)
{
    uint32_t sum = 0;

    for (uint32_t i = 0; i < c->rays.shadow_count; i++) {
        sum += fp_occluded(&c->fp, c->fp_shadow + i);
    }
    return sum;
}

/* Sum of the picture, radiance units. */
static double qlux_path(case_t *c)
{
    double total = 0;

    for (uint16_t y = 0; y < PICTURE_SIZE; y++) {
        for (uint16_t x = 0; x < PICTURE_SIZE; x++) {
            ql_sum_t sum = {{0, 0, 0}};

            ql_render_pixel(&c->render, x, y, 0, c->spp, &sum);
            total += ldexp((double)(sum.rgb[0] + sum.rgb[1] + sum.rgb[2]),
                    -QL_SUM_BITS);
        }
    }
    return total;
}

static double float_path(case_t *c)
{
    double total = 0;

    for (unsigned y = 0; y < PICTURE_SIZE; y++) {
        for (unsigned x = 0; x < PICTURE_SIZE; x++) {
            float rgb[3] = {0, 0, 0};

            fp_pixel(&c->fp, x, y, PICTURE_SIZE, PICTURE_SIZE, 0, c->spp,
                    BENCH_BOUNCES, rgb);
            total += (double)rgb[0] + (double)rgb[1] + (double)rgb[2];
        }
    }
    return total;
}

/* ---- timing ---- */

static volatile double sink;

static double time_ns(work_t work, case_t *c)
{
    struct timespec begin, end;

    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &begin);
    sink = work(c);
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &end);
    return (double)(end.tv_sec - begin.tv_sec) * 1e9 +
           (double)(end.tv_nsec - begin.tv_nsec);
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;

    return (x > y) - (x < y);
}

static double median(double *values, size_t count)
{
    qsort(values, count, sizeof *values, compare);
    return values[count / 2];
}

static figure_t measure(
        case_t *c, work_t qlux_work, work_t float_work, uint32_t calls)
{
    double q[REPETITIONS], f[REPETITIONS], r[REPETITIONS];
    const double per_call = calls > 0 ? 1.0 / calls : 0;
    figure_t figure;

    (void)time_ns(qlux_work, c); /* fill the caches */
    (void)time_ns(float_work, c);
    for (size_t i = 0; i < c->repetitions; i++) {
        q[i] = time_ns(qlux_work, c);
        f[i] = time_ns(float_work, c);
        r[i] = q[i] / f[i];
    }
    figure.ratio = median(r, c->repetitions);
    figure.qlux_ns = median(q, c->repetitions) * per_call;
    figure.float_ns = median(f, c->repetitions) * per_call;
    return figure;
}

static void print_figure(
        const char *prefix, const char *what, const figure_t *f)
{
    printf("pc %s %s%s-ratio: %.3f\n", PRECISION, prefix, what, f->ratio);
    printf("# %s%s: qlux %.1f ns, float %.1f ns\n", prefix, what, f->qlux_ns,
            f->float_ns);
}

/* ---- agreement ---- */

static bool closest_agrees(const case_t *c, const char *prefix)
{
    const uint32_t count = c->rays.closest_count;
    uint32_t same = 0;
    double share;

    for (uint32_t i = 0; i < count; i++) {
        fp_hit_t f;
        ql_hit_t q;
        const bool hit_f = fp_closest(&c->fp, c->fp_closest + i, &f);
        const bool hit_q =
                ql_bvh_closest_hit(&c->scene, c->rays.closest + i, &q);

        same += hit_f == hit_q &&
                (!hit_f || (f.triangle == q.tri_idx && f.front == q.front));
    }
    share = count > 0 ? (double)same / count : 1;
    printf("# %sclosest: same triangle for %.4f %% of %lu rays\n", prefix,
            100 * share, (unsigned long)count);
    return share > AGREE_MIN;
}

static bool shadow_agrees(const case_t *c, const char *prefix)
{
    const uint32_t count = c->rays.shadow_count;
    uint32_t same = 0, blocked = 0;
    double share;

    for (uint32_t i = 0; i < count; i++) {
        const bool q = ql_bvh_occluded(&c->scene, c->rays.shadow + i);

        same += q == fp_occluded(&c->fp, c->fp_shadow + i);
        blocked += q;
    }
    share = count > 0 ? (double)same / count : 1;
    printf("# %sshadow: same answer for %.4f %% of %lu segments, %.1f %% "
           "blocked\n",
            prefix, 100 * share, (unsigned long)count,
            count > 0 ? 100.0 * blocked / count : 0.0);
    return share > AGREE_MIN;
}

/* The rays are those of the paths. */
static bool rays_agree(case_t *c, const char *prefix)
{
    const ql_diag_t before = c->render.diag;
    const ql_diag_t *now = &c->render.diag;

    (void)qlux_path(c);
    printf("# %spath: %.2f closest-hit and %.2f shadow rays\n", prefix,
            (double)c->rays.closest_count / c->rays.path_count,
            (double)c->rays.shadow_count / c->rays.path_count);
    return now->closest_rays - before.closest_rays == c->rays.closest_count &&
           now->shadow_rays - before.shadow_rays == c->rays.shadow_count;
}

/* Both render the same picture but for noise, most of it from pixels that see
 * the light. */
static bool pictures_agree(case_t *c, const char *prefix)
{
    double q, difference;

    c->spp = COMPARE_SPP;
    q = qlux_path(c);
    difference = q > 0 ? fabs(float_path(c) / q - 1) : 0;
    c->spp = PICTURE_SPP;
    printf("# %spath: the pictures' means differ by %.2f %%\n", prefix,
            100 * difference);
    return difference < MEAN_MAX;
}

/* ---- the program ---- */

static bool run(const char *name, const char *prefix, size_t repetitions,
        figure_t *closest)
{
    static const case_t zero;
    case_t c = zero;
    figure_t f;
    bool agree;

    case_open(&c, name);
    c.repetitions = repetitions;
    agree = closest_agrees(&c, prefix);
    agree = shadow_agrees(&c, prefix) && agree;
    agree = rays_agree(&c, prefix) && agree;
    agree = pictures_agree(&c, prefix) && agree;
    *closest = measure(&c, qlux_closest, float_closest, c.rays.closest_count);
    print_figure(prefix, "closest", closest);
    f = measure(&c, qlux_shadow, float_shadow, c.rays.shadow_count);
    print_figure(prefix, "shadow", &f);
    f = measure(&c, qlux_path, float_path, c.rays.path_count);
    print_figure(prefix, "path", &f);
    case_close(&c);
    if (!agree) {
        fprintf(stderr, "bench-pc: %s: the tracers do not agree\n", name);
    }
    return agree;
}

/* For instruction counters: every ray once in each tracer. qlux has found the
 * closest hits to make the rays. */
static void run_once(const char *name)
{
    static const case_t zero;
    case_t c = zero;

    case_open(&c, name);
    printf("# sums: %.0f %.0f %.0f\n", qlux_shadow(&c), float_closest(&c),
            float_shadow(&c));
    printf("closest: %lu\nshadow: %lu\n", (unsigned long)c.rays.closest_count,
            (unsigned long)c.rays.shadow_count);
    case_close(&c);
}

static int usage(FILE *to)
{
    fprintf(to,
            "usage: bench-pc [--repetitions N] SCENE.qlb [MESH.qlb]\n"
            "       bench-pc --once SCENE.qlb\n"
            "Time qlux against a float path tracer on the same rays: below 1, "
            "qlux is faster.\nA second scene shows how the time of a ray grows "
            "with the triangles. Times are medians of N, 31 unless told.\n"
            "--once traces each ray once and prints how many, for count_pc.sh."
            "\n"
            "Exit 2 if the two tracers do not see the same scene.\n"
            "\nExample: build/bench-pc build/cornell.qlb build/mesh.qlb\n");
    return to == stdout ? 0 : EXIT_USAGE;
}

int main(int argc, char **argv)
{
    size_t repetitions = REPETITIONS;
    figure_t small, large;
    bool agree;

    if (argc == 2 && strcmp(argv[1], "--help") == 0) {
        return usage(stdout);
    }
    if (argc == 3 && strcmp(argv[1], "--once") == 0) {
        run_once(argv[2]);
        return 0;
    }
    if (argc > 2 && strcmp(argv[1], "--repetitions") == 0) {
        const long n = strtol(argv[2], NULL, 10);

        if (n < 1 || n > REPETITIONS) {
            return usage(stderr);
        }
        repetitions = (size_t)n;
        argv += 2;
        argc -= 2;
    }
    if (argc < 2 || argc > 3 || argv[1][0] == '-') {
        return usage(stderr);
    }
    agree = run(argv[1], "", repetitions, &small);
    if (argc == 3) {
        agree = run(argv[2], "mesh-", repetitions, &large) && agree;
        printf("pc %s closest-growth: %.2f\n", PRECISION,
                large.qlux_ns / small.qlux_ns);
        printf("# closest-growth of float: %.2f\n",
                large.float_ns / small.float_ns);
    }
    return agree ? 0 : EXIT_INPUT;
}
