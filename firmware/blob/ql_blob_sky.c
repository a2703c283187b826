/* ql_blob_sky.c - light from all around: a constant, or a map */
/* SPDX-License-Identifier: MIT */

#include "blob/ql_blob_parts.h"

#if QL_CFG_SKY

bool ql_blob_sky_open(ql_blob_parts_t *parts, ql_scene_t *scene)
{
    scene->sky = ql_blob_optional(parts, QL_FEATURE_SKY, sizeof *scene->sky, 1);
    return parts->sound && (scene->sky == NULL || parts->count == 1);
}

bool ql_blob_sky_check(const ql_blob_parts_t *parts, const ql_scene_t *scene)
{
    if (ql_scene_texels(scene) != NULL) {
        return ql_blob_sky_map_check(parts, scene);
    }
    return scene->sky == NULL || (scene->sky->width | scene->sky->height) == 0;
}

#endif
