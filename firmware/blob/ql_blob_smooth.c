/* ql_blob_smooth.c - corner normals: one for each vertex */
/* SPDX-License-Identifier: MIT */

#include "blob/ql_blob_parts.h"

#if QL_CFG_SMOOTH

bool ql_blob_smooth_open(ql_blob_parts_t *parts, ql_scene_t *scene)
{
    scene->normals = ql_blob_optional(
            parts, QL_FEATURE_SMOOTH, sizeof *scene->normals, QL_VERTEX_MAX);
    return parts->sound &&
           (scene->normals == NULL || parts->count == parts->vertex_count);
}

#endif
