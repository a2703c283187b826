/* probe.c - what a ray of the core meets in a scene, for reports */
/* SPDX-License-Identifier: MIT */

#include "scene/report/probe.h"

#include <math.h>

#include "math/vec/ql_vec_unit.h"
#include "trace/ql_bvh.h"

#define LONGEST ((double)(1 << 29)) /* component of a direction */

bool probe_cast(probe_t *probe, const ql_scene_t *scene, const double from[3],
        const double direction[3])
{
    const double unit = 1 << QL_POS_BITS;
    const double most = fmax(
            fabs(direction[0]), fmax(fabs(direction[1]), fabs(direction[2])));
    ql_vec3_t way;
    ql_ray_t ray;
    ql_hit_t hit;
    double x, y, z;

    way.x = (int32_t)(direction[0] / most * LONGEST);
    way.y = (int32_t)(direction[1] / most * LONGEST);
    way.z = (int32_t)(direction[2] / most * LONGEST);
    ray.direction = ql_vec_to_dir(way);
    ray.origin.x = (ql_pos_t)(from[0] * unit);
    ray.origin.y = (ql_pos_t)(from[1] * unit);
    ray.origin.z = (ql_pos_t)(from[2] * unit);
    if (!ql_bvh_closest_hit(scene, &ray, &hit)) {
        return false;
    }
    x = ray.direction.x;
    y = ray.direction.y;
    z = ray.direction.z;
    probe->front = hit.front;
    probe->index = hit.tri_idx;
    probe->distance = ldexp(hit.t, -30) * sqrt(x * x + y * y + z * z) / unit;
    return true;
}

bool probe_eye(double eye[3], const world_t *world, const grid_t *grid)
{
    bool inside = true;

    for (int k = 0; k < 3; k++) {
        const soft_t x =
                soft_sub(soft_from(world->camera.eye[k]), grid->origin[k]);

        eye[k] = soft_double(soft_div(x, grid->unit)) + GRID_LOW;
        inside = inside && eye[k] >= grid->low[k] && eye[k] <= grid->high[k];
    }
    return inside;
}
