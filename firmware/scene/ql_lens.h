/* ql_lens.h - depth of field: a thin lens moves the rays of a camera */
/* SPDX-License-Identifier: MIT */

/* Every ray of one point of the picture passes through the same point in focus,
 * whichever point (a, b) of the lens it begins at: a p[0] + b p[1] is added to
 * its origin and a d[0] + b d[1] to its direction (ql_blob_lens_t). Without a
 * lens all of this is nothing. */

#ifndef QL_LENS_H
#define QL_LENS_H

#include "sample/ql_sampler.h"
#include "scene/ql_scene.h"

QL_C_BEGIN

/* The lens of a camera. */
typedef struct {
    const ql_blob_lens_t *lens; /* NULL: a pinhole */
    uint8_t down;               /* the camera's directions are over 2^down */
} ql_lens_t;

#if QL_CFG_LENS
/* How much a lens adds to an axis of the origin or of the direction at most,
 * what ql_warp_plane_disk() may err by included.
 *
 *   scene   -  open
 *   axis    -  0..2
 *   return  2^-32 grid units, 2^-46 of a direction; at most 2^63 + 2^49; 0
 *           without a lens
 */
uint64_t ql_lens_origin_reach(const ql_scene_t *scene, unsigned axis);

/* The same of the direction: scene, axis as above. */
uint64_t ql_lens_direction_reach(const ql_scene_t *scene, unsigned axis);

/* Move a ray to a point of the lens.
 *
 *   of      -     the camera's lens
 *   u       uq32  where on the lens, by ql_warp_plane_disk()
 *   at      -     moved: x, y, z of the origin, s31.16, and of the direction,
 *                 s1.30
 *
 * Error: cut to 2^-15 grid units and 2^-29 of a direction.
 */
void ql_lens_move(const ql_lens_t *of, ql_uniform2_t u, int64_t at[6]);
#else
QL_INLINE uint64_t ql_lens_origin_reach(const ql_scene_t *scene, unsigned axis)
{
    return (void)scene, (void)axis, 0;
}

QL_INLINE uint64_t ql_lens_direction_reach(
        const ql_scene_t *scene, unsigned axis)
{
    return (void)scene, (void)axis, 0;
}

QL_INLINE void ql_lens_move(const ql_lens_t *of, ql_uniform2_t u, int64_t at[6])
{
    (void)of, (void)u, (void)at;
}
#endif

QL_C_END

#endif
