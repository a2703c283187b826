/* bench_main.c - instructions per ray, warp and path on an emulated board */
/* SPDX-License-Identifier: MIT */

/* Linked in the place of hal/ql_main.c and firmware/app/ql_app.c. Where the
 * board's counter counts instructions (README.md), every figure is a mean
 * number of instructions, calls included, the loop around them taken off. With
 * QL_BENCH_FLOAT 1 it measures float_pt.c too. */

#include "bench/bench_board.h"
#include "trace/ql_bvh.h"

/* QL_BENCH_FLOAT: 0 or 1. QL_BENCH_BATCH: rays held in memory.
 * QL_BENCH_FLOAT_BYTES: of the float tracer's scene. */
#ifndef QL_BENCH_FLOAT
#define QL_BENCH_FLOAT 0
#endif
#ifndef QL_BENCH_BATCH
#define QL_BENCH_BATCH 64
#endif
#ifndef QL_BENCH_FLOAT_BYTES
#define QL_BENCH_FLOAT_BYTES 4096
#endif

#if QL_BENCH_FLOAT
#include "bench/rays/float_pt.h"
#endif

static ql_ray_t closest[QL_BENCH_BATCH], shadow[QL_BENCH_BATCH];
static bench_warp_t warps[QL_BENCH_BATCH];

typedef struct {
    bench_total_t empty, closest, shadow, warp, path;
    uint32_t blocked; /* keeps results alive */
} figures_t;

static void measure_batch(
        figures_t *f, const ql_scene_t *scene, const bench_batch_t *b)
{
    ql_hit_t hit;
    ql_vec3_t d;

    BENCH_MEASURE(&f->empty, b->closest_count, BENCH_KEEP(closest + i));
    BENCH_MEASURE(&f->closest, b->closest_count, {
        f->blocked += ql_bvh_closest_hit(scene, closest + i, &hit);
        BENCH_KEEP(&hit);
    });
    BENCH_MEASURE(&f->shadow, b->shadow_count,
            f->blocked += ql_bvh_occluded(scene, shadow + i));
    BENCH_MEASURE(&f->warp, b->warp_count, {
        d = bench_direction(warps + i);
        BENCH_KEEP(&d);
    });
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
    BENCH_MEASURE(&f->empty, b->closest_count, BENCH_KEEP(rays + i));
    BENCH_MEASURE(&f->closest, b->closest_count, {
        f->blocked += fp_closest(fp, rays + i, &hit);
        BENCH_KEEP(&hit);
    });
    for (uint32_t i = 0; i < b->shadow_count; i++) {
        rays[i] = fp_ray(shadow + i, true);
    }
    BENCH_MEASURE(&f->shadow, b->shadow_count,
            f->blocked += fp_occluded(fp, rays + i));
    for (uint32_t i = 0; i < b->warp_count; i++) {
        rays[i].t_min = (float)(warps[i].u.u1 >> 8) * 0x1p-24f;
        rays[i].t_max = (float)(warps[i].u.u2 >> 8) * 0x1p-24f;
    }
    BENCH_MEASURE(&f->warp, b->warp_count, {
        d = fp_cosine_hemisphere(n, rays[i].t_min, rays[i].t_max);
        BENCH_KEEP(&d);
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
            BENCH_KEEP(rgb);
        }
        f->path.ticks += (uint32_t)(ql_hal_ticks() - begin);
        f->path.calls += QL_BENCH_SIZE * QL_BENCH_SPP;
    }
}
#endif

static void print_figures(const char *precision, const figures_t *f)
{
    bench_print_row(precision, "", "closest", &f->closest, &f->empty);
    bench_print_row(precision, "", "shadow", &f->shadow, &f->empty);
    bench_print_row(precision, "", "warp", &f->warp, &f->empty);
    bench_print_row(precision, "", "path", &f->path, NULL);
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
        bench_print("# QL_BENCH_FLOAT_BYTES is too small\n");
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
    bench_measure_paths(&f.path, render);
    print_figures(BENCH_PRECISION, &f);
    bench_print_mean("closest rays a path", rays, next);
    bench_print_mean("shadow rays a path", segments, next);
#if QL_BENCH_FLOAT
    measure_float_paths(&g, &fp);
    print_figures("float", &g);
#endif
    if (rays != render->diag.closest_rays ||
            segments != render->diag.shadow_rays) {
        bench_print("# these are not the rays of ql_render_pixel()\n");
        return QL_ERR_RANGE;
    }
    return QL_OK;
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
        status = bench_open(&scene, &render, QL_DIRECT_AREA);
    }
    if (status == QL_OK) {
        status = run(&render);
    }
    ql_hal_exit(status);
    return 0;
}
