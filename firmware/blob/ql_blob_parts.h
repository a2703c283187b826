/* ql_blob_parts.h - the parts of a blob, each checked in a file of its own */
/* SPDX-License-Identifier: MIT */

/* ql_blob_open() calls the parts one after the other. Each of them finds its
 * tables, in the order of the header, checks what is in them and puts them into
 * the scene; it returns false if something is out of range. A part that is not
 * built in is a stub with nothing to find: a blob that needs it was refused
 * before. */

#ifndef QL_BLOB_PARTS_H
#define QL_BLOB_PARTS_H

#include "scene/ql_scene.h"

/* Is there a part that not every blob has? */
#define QL_BLOB_HAS_OPTIONAL                                                   \
    (QL_CFG_SMOOTH || QL_GLOSS || QL_CFG_SPHERES || QL_CFG_SKY ||              \
            QL_CFG_SKY_MAP || QL_CFG_TABLES || QL_CFG_LENS ||                  \
            QL_CFG_CONTACT || QL_CFG_ORDER || QL_CFG_HULL)

/* What one part finds out for another, of a blob that is being opened. */
typedef struct {
    const ql_blob_header_t *header; /* its version and features were checked */
    const ql_blob_table_t *next;    /* the next optional table */
    uint32_t count;                 /* entries of the last one; 0 without it */
    bool sound;                     /* the last one lies inside the blob */
    uint32_t vertex_count;
    uint32_t triangle_count;
    uint32_t pair_count;
    uint32_t material_count;
    uint32_t sphere_count;
    uint32_t texel_count;
} ql_blob_parts_t;

/* Find an optional table: the next one of QL_BLOB_OPTIONAL_LIST that is built.
 *
 *   parts        -      its count and sound are set
 *   needs        -      QL_FEATURE_ bits: the blob has the table if it has any
 *   entry_bytes  bytes  of one entry
 *   count_max    -      most entries; entry_bytes * count_max fits 32 bits
 *   return       the table; NULL if there is none, or it is not sound
 */
const void *ql_blob_optional(ql_blob_parts_t *parts, uint32_t needs,
        uint32_t entry_bytes, uint32_t count_max);

/* Is the number in a word of the blob, or the high word of a wide one, within
 * -2^30..2^30? */
QL_INLINE bool ql_blob_reach_valid(uint32_t word)
{
    return QL_LE32(word) + 0x40000000u <= 0x80000000u;
}

/* Find the tables that every blob has.
 *
 *   parts  -  the header; out: the counts
 *   scene  -  out: the tables, and the root of the tree
 */
bool ql_blob_basic_open(ql_blob_parts_t *parts, ql_scene_t *scene);

/* Look into them.
 *
 *   parts  -  every count
 *   scene  -  with the optional tables, which triangles and lights refer to
 */
bool ql_blob_basic_check(const ql_blob_parts_t *parts, const ql_scene_t *scene);

/* Walk the whole tree as a ray would, with a stack no larger than a ray's.
 *
 *   parts  -  the counts; depth of the header is at most QL_CFG_BVH_STACK
 *   scene  -  the tree
 */
bool ql_blob_tree_check(const ql_blob_parts_t *parts, const ql_scene_t *scene);

/* Optional parts: each finds its tables and checks them.
 *
 *   parts  -  the header and the counts of the parts before
 *   scene  -  out: the tables of the part
 */

/* Corner normals; parts, scene as above. */
#if QL_CFG_SMOOTH
bool ql_blob_smooth_open(ql_blob_parts_t *parts, ql_scene_t *scene);
#else
QL_INLINE bool ql_blob_smooth_open(ql_blob_parts_t *parts, ql_scene_t *scene)
{
    return (void)parts, (void)scene, true;
}
#endif

/* Materials that are more than diffuse; parts, scene as above. */
#if QL_GLOSS
bool ql_blob_gloss_open(ql_blob_parts_t *parts, ql_scene_t *scene);
#else
QL_INLINE bool ql_blob_gloss_open(ql_blob_parts_t *parts, ql_scene_t *scene)
{
    return (void)parts, (void)scene, true;
}
#endif

/* Spheres; parts, scene as above. */
#if QL_CFG_SPHERES
bool ql_blob_spheres_open(ql_blob_parts_t *parts, ql_scene_t *scene);
#else
QL_INLINE bool ql_blob_spheres_open(ql_blob_parts_t *parts, ql_scene_t *scene)
{
    return (void)parts, (void)scene, true;
}
#endif

/* The sky; parts, scene as above. ql_blob_sky_check() comes after the others,
 * as it needs the map and its distribution. */
#if QL_CFG_SKY
bool ql_blob_sky_open(ql_blob_parts_t *parts, ql_scene_t *scene);

/* Is the sky constant, or its map sound? parts, scene: with every table. */
bool ql_blob_sky_check(const ql_blob_parts_t *parts, const ql_scene_t *scene);
#else
QL_INLINE bool ql_blob_sky_open(ql_blob_parts_t *parts, ql_scene_t *scene)
{
    return (void)parts, (void)scene, true;
}

QL_INLINE bool ql_blob_sky_check(
        const ql_blob_parts_t *parts, const ql_scene_t *scene)
{
    return (void)parts, (void)scene, true;
}
#endif

/* The map of the sky; parts, scene as above. */
#if QL_CFG_SKY_MAP
bool ql_blob_sky_map_open(ql_blob_parts_t *parts, ql_scene_t *scene);

/* Is it sound? parts, scene: with every table. */
bool ql_blob_sky_map_check(
        const ql_blob_parts_t *parts, const ql_scene_t *scene);
#else
QL_INLINE bool ql_blob_sky_map_open(ql_blob_parts_t *parts, ql_scene_t *scene)
{
    return (void)parts, (void)scene, true;
}

QL_INLINE bool ql_blob_sky_map_check(
        const ql_blob_parts_t *parts, const ql_scene_t *scene)
{
    return (void)parts, (void)scene, true;
}
#endif

/* Tabulated distributions; parts, scene as above. */
#if QL_CFG_TABLES
bool ql_blob_distributions_open(ql_blob_parts_t *parts, ql_scene_t *scene);
#else
QL_INLINE bool ql_blob_distributions_open(
        ql_blob_parts_t *parts, ql_scene_t *scene)
{
    return (void)parts, (void)scene, true;
}
#endif

/* The lens; parts, scene as above. */
#if QL_CFG_LENS
bool ql_blob_lens_open(ql_blob_parts_t *parts, ql_scene_t *scene);
#else
QL_INLINE bool ql_blob_lens_open(ql_blob_parts_t *parts, ql_scene_t *scene)
{
    return (void)parts, (void)scene, true;
}
#endif

/* What touches, a bit for each triangle; parts, scene as above. */
#if QL_CFG_CONTACT
QL_INLINE bool ql_blob_contacts_open(ql_blob_parts_t *parts, ql_scene_t *scene)
{
    scene->contacts = ql_blob_optional(parts, QL_FEATURE_CONTACT,
            sizeof *scene->contacts, (QL_TRI_MAX + 15) / 16);
    return parts->sound &&
           (scene->contacts == NULL ||
                   parts->count == (parts->triangle_count + 15) / 16);
}
#else
QL_INLINE bool ql_blob_contacts_open(ql_blob_parts_t *parts, ql_scene_t *scene)
{
    return (void)parts, (void)scene, true;
}
#endif

/* Which counts where surfaces are in one place; parts, scene as above. */
#if QL_CFG_ORDER
QL_INLINE bool ql_blob_ranks_open(ql_blob_parts_t *parts, ql_scene_t *scene)
{
    scene->ranks = ql_blob_optional(
            parts, QL_FEATURE_ORDER, sizeof *scene->ranks, QL_TRI_MAX);
    return parts->sound &&
           (scene->ranks == NULL || parts->count == parts->triangle_count);
}
#else
QL_INLINE bool ql_blob_ranks_open(ql_blob_parts_t *parts, ql_scene_t *scene)
{
    return (void)parts, (void)scene, true;
}
#endif

/* The sides of a hull, which lead to triangles and nodes there are; parts,
 * scene as above. A small build never reads them. */
#if QL_CFG_HULL && !QL_CFG_SMALL
QL_INLINE bool ql_blob_sides_open(ql_blob_parts_t *parts, ql_scene_t *scene)
{
    bool valid;

    scene->sides = ql_blob_optional(
            parts, QL_FEATURE_HULL, sizeof *scene->sides, QL_TRI_MAX);
    scene->side_count = (uint16_t)parts->count; /* <= QL_TRI_MAX */
    /* the root has two children */
    valid = scene->root_meta < 3 && scene->side_count > 0;
    for (unsigned i = 0; i < scene->side_count; i++) {
        valid = valid &&
                QL_LE16(scene->sides[i].node) < 2 * parts->pair_count &&
                (!QL_CFG_SLANTED || QL_LE16(scene->sides[i].triangle) <
                                            parts->triangle_count);
    }
    return valid && parts->sound;
}
#else
QL_INLINE bool ql_blob_sides_open(ql_blob_parts_t *parts, ql_scene_t *scene)
{
    return (void)parts, (void)scene, true;
}
#endif

/* The hull and its sides; parts, scene as above. */
#if QL_CFG_HULL
QL_INLINE bool ql_blob_hull_open(ql_blob_parts_t *parts, ql_scene_t *scene)
{
    scene->hull =
            ql_blob_optional(parts, QL_FEATURE_HULL, sizeof *scene->hull, 1);
    if (parts->count == 0) {
        return (QL_LE32(parts->header->features) & QL_FEATURE_HULL) == 0;
    }
    scene->hull_first = QL_LE16(scene->hull->first);
    return ql_blob_sides_open(parts, scene);
}
#else
QL_INLINE bool ql_blob_hull_open(ql_blob_parts_t *parts, ql_scene_t *scene)
{
    return (void)parts, (void)scene, true;
}
#endif

#endif
