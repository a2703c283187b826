/* ql_blob_spheres.c - spheres: inside the box, of a unit or more */
/* SPDX-License-Identifier: MIT */

#include "blob/ql_blob_parts.h"

#if QL_CFG_SPHERES

/* From 8 to 32759 grid units on each axis, and a unit of radius or more. */
static bool sphere_valid(const ql_blob_sphere_t *sphere)
{
    const uint32_t low = (uint32_t)QL_GRID_MARGIN << 8;
    const uint32_t high = (uint32_t)(QL_GRID_MAX - QL_GRID_MARGIN) << 8;
    const uint32_t r = QL_LE32(sphere->radius);

    if (r < 256 || r > high) {
        return false;
    }
    for (unsigned k = 0; k < 3; k++) {
        const uint32_t c = QL_LE32(sphere->centre[k]);

        if (c < low + r || c > high - r) {
            return false;
        }
    }
    return true;
}
bool ql_blob_spheres_open(ql_blob_parts_t *parts, ql_scene_t *scene)
{
    scene->spheres = ql_blob_optional(
            parts, QL_FEATURE_SPHERES, sizeof *scene->spheres, QL_TRI_MAX);
    parts->sphere_count = parts->count;
    for (uint32_t i = 0; i < parts->count; i++) {
        if (!sphere_valid(scene->spheres + i)) {
            return false;
        }
    }
    return parts->sound;
}

#endif
