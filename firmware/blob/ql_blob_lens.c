/* ql_blob_lens.c - the lens of the camera: its reach */
/* SPDX-License-Identifier: MIT */

#include "blob/ql_blob_parts.h"

#if QL_CFG_LENS

/* Does no point of the lens reach further than 2^30? */
static bool lens_valid(const ql_blob_lens_t *lens)
{
    for (unsigned i = 0; i < 6; i++) {
        if (!ql_blob_reach_valid(lens->p[i / 3][i % 3][1]) ||
                !ql_blob_reach_valid(lens->d[i / 3][i % 3])) {
            return false;
        }
    }
    return true;
}

bool ql_blob_lens_open(ql_blob_parts_t *parts, ql_scene_t *scene)
{
    scene->lens =
            ql_blob_optional(parts, QL_FEATURE_LENS, sizeof *scene->lens, 1);
    return parts->sound &&
           (scene->lens == NULL ||
                   (parts->count == 1 && lens_valid(scene->lens)));
}

#endif
