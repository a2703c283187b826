/* ql_blob_sky_map.c - the map of the sky: its texels and its distribution */
/* SPDX-License-Identifier: MIT */

#include "blob/ql_blob_parts.h"

#if QL_CFG_SKY_MAP

bool ql_blob_sky_map_open(ql_blob_parts_t *parts, ql_scene_t *scene)
{
    scene->texels = ql_blob_optional(
            parts, QL_FEATURE_SKY_MAP, sizeof *scene->texels, UINT32_MAX / 4);
    parts->texel_count = parts->count;
    return parts->sound;
}

/* A map has a sky, all its texels, and a distribution of its size. */
bool ql_blob_sky_map_check(
        const ql_blob_parts_t *parts, const ql_scene_t *scene)
{
    const ql_blob_sky_t *sky = scene->sky;
    const ql_blob_distribution_t *d;
    uint32_t width, height;

    if (sky == NULL || QL_LE16(sky->table) >= scene->table_count) {
        return false;
    }
    width = QL_LE16(sky->width);
    height = QL_LE16(sky->height);
    d = scene->tables + QL_LE16(sky->table);
    if (width == 0 || height == 0 || parts->texel_count != width * height ||
            QL_LE16(d->dims) != 2 || d->count[0] != sky->width ||
            d->count[1] != sky->height) {
        return false;
    }
    for (uint32_t i = 0; i < parts->texel_count; i++) {
        if (QL_LE32(scene->texels[i].rgb9e5) >> 27 > 23) {
            return false;
        }
    }
    return true;
}

#endif
