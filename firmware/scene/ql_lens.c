/* ql_lens.c - what a lens adds to the rays of a camera */
/* SPDX-License-Identifier: MIT */

#include "scene/ql_lens.h"

#include "warp/ql_warp_plane.h"

#if QL_CFG_LENS

/* Both halves, each below 2^62 in size, and what ql_warp_plane_disk() may err
 * by. */
static uint64_t disk_reach(int64_t first, int64_t second)
{
    const uint64_t sum = ql_abs64(first) + ql_abs64(second);

    return sum + (sum >> 14);
}

uint64_t ql_lens_origin_reach(const ql_scene_t *scene, unsigned axis)
{
    const ql_blob_lens_t *lens = scene->lens;

    return lens == NULL ? 0
                        : disk_reach(ql_blob_wide(lens->p[0][axis]),
                                  ql_blob_wide(lens->p[1][axis]));
}

uint64_t ql_lens_direction_reach(const ql_scene_t *scene, unsigned axis)
{
    const ql_blob_lens_t *lens = scene->lens;

    return lens == NULL ? 0
                        : disk_reach(ql_blob_narrow(lens->d[0][axis]),
                                  ql_blob_narrow(lens->d[1][axis]));
}

void ql_lens_move(const ql_lens_t *of, ql_uniform2_t u, int64_t at[6])
{
    const ql_blob_lens_t *lens = of->lens;
    ql_q29_t a[2];

    if (lens == NULL) {
        return;
    }
    ql_warp_plane_disk(u.u1, u.u2, &a[0], &a[1]);
    for (unsigned i = 0; i < 6; i++) {
        /* p in s31.16 = high 2^16 + low: products below 2^60 */
        const unsigned k = i >> 1;
        const int64_t p = ql_asr64(ql_blob_wide(lens->p[i & 1u][k]), 16);
        const int64_t high = ql_asr64(p, 16), low = p & 0xffff;
        const int64_t d = ql_i32(QL_LE32(lens->d[i & 1u][k]));

        at[k] += ql_asr64(high * a[i & 1u], 13) + ql_asr64(low * a[i & 1u], 29);
        at[3 + k] += ql_asr64(d * a[i & 1u], 29u + of->down);
    }
}

#endif
