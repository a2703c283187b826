/* bench_main.c - instructions per ray, warp and path on an emulated board */
/* SPDX-License-Identifier: MIT */

/* Linked in the place of hal/ql_main.c and firmware/ql_app.c. Where the board's
 * counter counts instructions (README.md), every figure is a mean number of
 * instructions, calls included, the loop around them taken off. With
 * QL_BENCH_FLOAT 1 it measures float_pt.c too. */

#include "bench_rays.h"
#include "board.h"
#include "ql_hal.h"
#include "trace/ql_bvh.h"

/* QL_BENCH_CORE: name of the CPU in the rows. QL_BENCH_FLOAT: 0 or 1.
 * QL_BENCH_SIZE: px, the picture is square. QL_BENCH_SPP: samples a pixel.
 * QL_BENCH_BATCH: rays held in memory. QL_BENCH_FLOAT_BYTES: of its scene. */
#ifndef QL_BENCH_CORE
#define QL_BENCH_CORE "unknown"
#endif
#ifndef QL_BENCH_FLOAT
#define QL_BENCH_FLOAT 0
#endif
#ifndef QL_BENCH_SIZE
#define QL_BENCH_SIZE 16
#endif
#ifndef QL_BENCH_SPP
#define QL_BENCH_SPP 4
#endif
#ifndef QL_BENCH_BATCH
#define QL_BENCH_BATCH 64
#endif
#ifndef QL_BENCH_FLOAT_BYTES
#define QL_BENCH_FLOAT_BYTES 4096
#endif

#if QL_BENCH_FLOAT
#include "float_pt.h"
#endif

/* Runs of a batch between two looks at the counter: a tick is up to 80
 * instructions, a batch of warps a few thousand. */
#define REPEAT 4

/* Make the compiler work a result out and forget what it knows of memory. */
#define KEEP(pointer) __asm__ volatile("" : : "r"(pointer) : "memory")

#define PRECISION (QL_CFG_PRECISION == 0 ? "draft" : "fine")

/* Ticks and how many calls they were spent on. */
typedef struct {
    uint64_t ticks;
    uint32_t calls;
} total_t;

static void print(const char *text)
{
    uint16_t size = 0;

    while (text[size] != '\0') {
        size++;
    }
    if (ql_hal_serial_write((const uint8_t *)text, size) != QL_OK) {
        ql_hal_exit(QL_ERR_SERIAL);
    }
}

static void print_number(uint32_t number)
{
    char text[11];
    unsigned i = sizeof text - 1;

    text[i] = '\0';
    do {
        text[--i] = (char)('0' + number % 10);
        number /= 10;
    } while (number > 0);
    print(text + i);
}

/* Nanoseconds of the board's time, which are instructions, a call. */
static uint32_t mean_of(const total_t *total)
{
    const uint64_t ns = total->ticks * 1000000000u / QL_PORT_TICK_HZ;

    return total->calls == 0
                   ? 0
                   : (uint32_t)((ns + total->calls / 2) / total->calls);
}

/* "CORE PRECISION WHAT: N" */
static void print_row(const char *precision, const char *what,
        const total_t *work, const total_t *empty)
{
    const uint32_t loop = empty == NULL ? 0 : mean_of(empty);

    print(QL_BENCH_CORE " ");
    print(precision);
    print(" ");
    print(what);
    print(": ");
    print_number(mean_of(work) - loop);
    print("\n");
}

/* "# WHAT: N.NN" */
static void print_ratio(const char *what, uint32_t number, uint32_t of)
{
    const uint32_t hundredths = of == 0 ? 0 : (number * 100 + of / 2) / of;

    print("# ");
    print(what);
    print(": ");
    print_number(hundredths / 100);
    print(hundredths % 100 < 10 ? ".0" : ".");
    print_number(hundredths % 100);
    print("\n");
}

/* Time count calls, REPEAT times: work(i) is an expression of i. */
#define MEASURE(total, count, work)                                            \
    do {                                                                       \
        const uint32_t begin_ = ql_hal_ticks();                                \
                                                                               \
        for (unsigned r_ = 0; r_ < REPEAT; r_++) {                             \
            for (uint32_t i = 0; i < (count); i++) {                           \
                work;                                                          \
            }                                                                  \
        }                                                                      \
        (total)->ticks += (uint32_t)(ql_hal_ticks() - begin_);                 \
        (total)->calls += REPEAT * (count);                                    \
    } while (0)

static ql_ray_t closest[QL_BENCH_BATCH], shadow[QL_BENCH_BATCH];
static bench_warp_t warps[QL_BENCH_BATCH];

typedef struct {
    total_t empty, closest, shadow, warp, path;
    uint32_t blocked; /* keeps results alive */
} figures_t;

static void measure_batch(
        figures_t *f, const ql_scene_t *scene, const bench_batch_t *b)
{
    ql_hit_t hit;
    ql_vec3_t d;

    MEASURE(&f->empty, b->closest_count, KEEP(closest + i));
    MEASURE(&f->closest, b->closest_count, {
        f->blocked += ql_bvh_closest_hit(scene, closest + i, &hit);
        KEEP(&hit);
    });
    MEASURE(&f->shadow, b->shadow_count,
            f->blocked += ql_bvh_occluded(scene, shadow + i));
    MEASURE(&f->warp, b->warp_count, {
        d = bench_direction(warps + i);
        KEEP(&d);
    });
}

static void measure_paths(figures_t *f, ql_render_t *render)
{
    for (uint16_t y = 0; y < QL_BENCH_SIZE; y++) {
        const uint32_t begin = ql_hal_ticks();

        for (uint16_t x = 0; x < QL_BENCH_SIZE; x++) {
            ql_sum_t sum = {{0, 0, 0}};

            ql_render_pixel(render, x, y, 0, QL_BENCH_SPP, &sum);
            KEEP(&sum);
        }
        f->path.ticks += (uint32_t)(ql_hal_ticks() - begin);
        f->path.calls += QL_BENCH_SIZE * QL_BENCH_SPP;
    }
}

#if QL_BENCH_FLOAT
static void measure_float_batch(
        figures_t *f, const fp_scene_t *fp, const bench_batch_t *b)
{
    static fp_ray_t rays[QL_BENCH_BATCH];
    fp_hit_t hit;
    fp_vec_t n = {0.6f, 0.0f, 0.8f}, d;

    for (uint32_t i = 0; i < b->closest_count; i++) {
        rays[i] = fp_ray(closest + i, false);
    }
    MEASURE(&f->empty, b->closest_count, KEEP(rays + i));
    MEASURE(&f->closest, b->closest_count, {
        f->blocked += fp_closest(fp, rays + i, &hit);
        KEEP(&hit);
    });
    for (uint32_t i = 0; i < b->shadow_count; i++) {
        rays[i] = fp_ray(shadow + i, true);
    }
    MEASURE(&f->shadow, b->shadow_count,
            f->blocked += fp_occluded(fp, rays + i));
    for (uint32_t i = 0; i < b->warp_count; i++) {
        rays[i].t_min = (float)(warps[i].u.u1 >> 8) * 0x1p-24f;
        rays[i].t_max = (float)(warps[i].u.u2 >> 8) * 0x1p-24f;
    }
    MEASURE(&f->warp, b->warp_count, {
        d = fp_cosine_hemisphere(n, rays[i].t_min, rays[i].t_max);
        KEEP(&d);
    });
}

static void measure_float_paths(figures_t *f, const fp_scene_t *fp)
{
    for (unsigned y = 0; y < QL_BENCH_SIZE; y++) {
        const uint32_t begin = ql_hal_ticks();

        for (unsigned x = 0; x < QL_BENCH_SIZE; x++) {
            float rgb[3] = {0.0f, 0.0f, 0.0f};

            fp_pixel(fp, x, y, QL_BENCH_SIZE, QL_BENCH_SIZE, 0, QL_BENCH_SPP,
                    BENCH_BOUNCES, rgb);
            KEEP(rgb);
        }
        f->path.ticks += (uint32_t)(ql_hal_ticks() - begin);
        f->path.calls += QL_BENCH_SIZE * QL_BENCH_SPP;
    }
}
#endif

static void print_figures(const char *precision, const figures_t *f)
{
    print_row(precision, "closest", &f->closest, &f->empty);
    print_row(precision, "shadow", &f->shadow, &f->empty);
    print_row(precision, "warp", &f->warp, &f->empty);
    print_row(precision, "path", &f->path, NULL);
}

/* Not part of main(), which runs before the FPU is on. */
static QL_NOINLINE ql_status_t run(ql_render_t *render)
{
    static figures_t f;
    bench_batch_t b = {closest, shadow, warps, QL_BENCH_BATCH, 0, 0, 0, 0};
    uint32_t next = 0, rays = 0, segments = 0;
#if QL_BENCH_FLOAT
    static uint32_t memory[QL_BENCH_FLOAT_BYTES / 4];
    static figures_t g;
    fp_scene_t fp;

    if (fp_bytes(render->scene) > sizeof memory) {
        print("# QL_BENCH_FLOAT_BYTES is too small\n");
        return QL_ERR_CAPACITY;
    }
    fp_open(&fp, render->scene, memory);
#endif
    while (bench_rays_fill(&b, render, &next)) {
        rays += b.closest_count;
        segments += b.shadow_count;
        measure_batch(&f, render->scene, &b);
#if QL_BENCH_FLOAT
        measure_float_batch(&g, &fp, &b);
#endif
    }
    measure_paths(&f, render);
    print_figures(PRECISION, &f);
    print_ratio("closest rays a path", rays, next);
    print_ratio("shadow rays a path", segments, next);
#if QL_BENCH_FLOAT
    measure_float_paths(&g, &fp);
    print_figures("float", &g);
#endif
    if (rays != render->diag.closest_rays ||
            segments != render->diag.shadow_rays) {
        print("# these are not the rays of ql_render_pixel()\n");
        return QL_ERR_RANGE;
    }
    return QL_OK;
}

static ql_status_t prepare(ql_scene_t *scene, ql_render_t *render)
{
    ql_settings_t settings = QL_SETTINGS_DEFAULT;
    const void *blob;
    size_t size;
    ql_status_t status;

    settings.width = QL_BENCH_SIZE;
    settings.height = QL_BENCH_SIZE;
    settings.spp = QL_BENCH_SPP;
    settings.bounces = BENCH_BOUNCES;
    ql_hal_scene_blob(&blob, &size);
    status = ql_blob_open(scene, blob, size);
    return status == QL_OK ? ql_render_init(render, scene, &settings) : status;
}

int main(void)
{
    static ql_scene_t scene;
    static ql_render_t render;
    ql_status_t status = ql_hal_init();

#if QL_BENCH_FLOAT && defined(__arm__) && defined(__ARM_FP)
    /* Coprocessors 10 and 11 of a Cortex-M: full access. */
    *(volatile uint32_t *)0xe000ed88u |= 0xfu << 20;
    __asm__ volatile("dsb\n\tisb");
#endif
    if (status == QL_OK) {
        status = prepare(&scene, &render);
    }
    if (status == QL_OK) {
        status = run(&render);
    }
    ql_hal_exit(status);
    return 0;
}
