/* ql_blob_gloss.c - what materials are beyond diffuse */
/* SPDX-License-Identifier: MIT */

#include "blob/ql_blob_parts.h"

#if QL_GLOSS

/* Is an entry in range, and of a kind that the blob says it needs? */
static bool gloss_valid(const ql_blob_gloss_t *gloss,
        const ql_blob_material_t *material, uint32_t features)
{
    const uint32_t kind = QL_LE16(gloss->kind);
    const uint32_t chance = QL_LE32(gloss->chance);
    const uint32_t parameter = QL_LE32(gloss->parameter);
    const bool glass = kind == QL_GLOSS_GLASS;
    const uint32_t needs = kind == QL_GLOSS_PHONG    ? QL_FEATURE_PHONG
                           : kind == QL_GLOSS_MIRROR ? QL_FEATURE_MIRROR
                           : glass                   ? QL_FEATURE_GLASS
                                                     : 0;

    for (unsigned k = 0; k < 3; k++) {
        const uint32_t albedo = QL_LE32(material->albedo[k]);

        /* wraps for an albedo above 1, which is refused with its material */
        if (QL_LE32(gloss->specular[k]) > QL_UQ31_ONE - albedo ||
                (glass && albedo != 0)) {
            return false;
        }
    }
    return (features & needs) != 0 && gloss->zero == 0 &&
           (glass ? chance == QL_UQ31_ONE && parameter >= 1ul << 12 &&
                                   parameter <= 1ul << 22
                  : chance <= QL_UQ31_ONE) &&
           (kind != QL_GLOSS_MIRROR || parameter == 0);
}
bool ql_blob_gloss_open(ql_blob_parts_t *parts, ql_scene_t *scene)
{
    scene->gloss = ql_blob_optional(parts,
            QL_FEATURE_PHONG | QL_FEATURE_MIRROR | QL_FEATURE_GLASS,
            sizeof *scene->gloss, parts->material_count);
    scene->gloss_count = (uint16_t)parts->count; /* <= QL_MATERIAL_MAX */
    for (uint32_t i = 0; i < parts->count; i++) {
        if (!gloss_valid(scene->gloss + i, scene->materials + i,
                    QL_LE32(parts->header->features))) {
            return false;
        }
    }
    return parts->sound;
}

#endif
