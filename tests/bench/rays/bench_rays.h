/* bench_rays.h - the rays of real paths, in batches that fit a small board */
/* SPDX-License-Identifier: MIT */

#ifndef BENCH_RAYS_H
#define BENCH_RAYS_H

#include "render/ql_line.h"
#include "sample/ql_sampler.h"

/* A path of the benchmark: 1 light sample a hit, at most 4 closest-hit rays. */
#define BENCH_BOUNCES   3
#define BENCH_PATH_RAYS (BENCH_BOUNCES + 1)

/* What a cosine-distributed direction is made from. */
typedef struct {
    ql_vec3_t n;    /* e1 x e2, on the side that was seen */
    uint32_t inv_n; /* as in ql_blob_tri_t */
    ql_uniform2_t u;
} bench_warp_t;

/* Rays of some whole paths. The arrays are the caller's. */
typedef struct {
    ql_ray_t *closest;
    ql_ray_t *shadow; /* segments, from surface to emitter */
    bench_warp_t *warps;
    uint32_t capacity; /* of each array; BENCH_PATH_RAYS or more */
    uint32_t closest_count, shadow_count, warp_count, path_count;
} bench_batch_t;

/* Fill a batch with the rays of the next paths of a picture.
 *
 *   batch   -  arrays and capacity set; counts are written
 *   render  -  from ql_render_init(), with at most BENCH_BOUNCES bounces; its
 *              paths are counted by pixel, line by line, then by sample
 *   next    -  in, out: number of the next path; 0 to begin
 *   return  true if there was a path left
 *
 * Exact: the very rays that ql_render_pixel() traces, in their order.
 */
bool bench_rays_fill(
        bench_batch_t *batch, const ql_render_t *render, uint32_t *next);

/* The direction that a path takes next: what `warp` measures.
 *
 *   warp    -      surface and numbers
 *   return  dir_t  cosine-distributed, ready to trace
 */
ql_vec3_t bench_direction(const bench_warp_t *warp);

#endif
