/* ql_scene.h - a checked blob: read-only access to its tables */
/* SPDX-License-Identifier: MIT */

#ifndef QL_SCENE_H
#define QL_SCENE_H

#include "math/vec/ql_vec.h"
#include "scene/ql_blob.h"

/* A checked, read-only view of a blob. Only ql_blob_open() may fill one. */
typedef struct ql_scene {
    const ql_blob_header_t *header;
    const ql_blob_camera_t *camera;
    const ql_blob_vertex_t *vertices;
    const ql_blob_tri_t *triangles;
    const void *pairs; /* ql_blob_node16_t[2] or ql_blob_pair8_t */
    const ql_blob_material_t *materials;
    const ql_blob_light_t *lights;
    uint16_t light_count;
    uint16_t root_link;
    uint8_t root_meta;
    uint8_t node_bits; /* 8 or 16 */
    bool two_sided;    /* emitters shine from both sides */
    /* optional tables; a pointer is NULL where the scene has none */
    QL_IF_BUILT(QL_CFG_SMOOTH, const ql_blob_normal_t *normals;)
    QL_IF_BUILT(QL_GLOSS, const ql_blob_gloss_t *gloss;)
    QL_IF_BUILT(QL_GLOSS, uint16_t gloss_count;) /* 0..materials */
    QL_IF_BUILT(QL_CFG_SPHERES, const ql_blob_sphere_t *spheres;)
    QL_IF_BUILT(QL_CFG_SKY, const ql_blob_sky_t *sky;)
    QL_IF_BUILT(QL_CFG_SKY_MAP, const ql_blob_texel_t *texels;)
    QL_IF_BUILT(QL_CFG_TABLES, const ql_blob_distribution_t *tables;)
    QL_IF_BUILT(QL_CFG_TABLES, const uint16_t *words;)
    QL_IF_BUILT(QL_CFG_TABLES, uint16_t table_count;)
    QL_IF_BUILT(QL_CFG_LENS, const ql_blob_lens_t *lens;)
    QL_IF_BUILT(QL_CFG_CONTACT, const uint16_t *contacts;)
    QL_IF_BUILT(QL_CFG_ORDER, const uint16_t *ranks;)
    QL_IF_BUILT(QL_CFG_HULL, const ql_blob_hull_t *hull;)
    QL_IF_BUILT(QL_CFG_HULL, const ql_blob_side_t *sides;)
    QL_IF_BUILT(QL_CFG_HULL, uint16_t side_count;)
    QL_IF_BUILT(QL_CFG_HULL, uint16_t hull_first;) /* triangle; 0: no hull */
} ql_scene_t;

/* Corner i of a triangle, grid units. */
QL_INLINE ql_vec3_t ql_scene_corner(
        const ql_scene_t *scene, const ql_blob_tri_t *tri, unsigned i)
{
    const ql_blob_vertex_t *v = scene->vertices + QL_LE16(tri->vertex[i]);
    ql_vec3_t p;

    if (QL_CFG_PAGES) {
        v += (uint32_t)(QL_LE16(tri->material) >> 14) << 16;
    }
    p.x = (int32_t)QL_LE16(v->xyz[0]);
    p.y = (int32_t)QL_LE16(v->xyz[1]);
    p.z = (int32_t)QL_LE16(v->xyz[2]);
    return p;
}

/* A triangle's corner 0 and its edges from there, grid units. */
typedef struct {
    ql_vec3_t v0, e1, e2;
} ql_edges_t;

QL_FAST_INLINE ql_edges_t ql_scene_edges(
        const ql_scene_t *scene, const ql_blob_tri_t *tri)
{
    ql_edges_t e;

    e.v0 = ql_scene_corner(scene, tri, 0);
    e.e1 = ql_vec_sub(ql_scene_corner(scene, tri, 1), e.v0);
    e.e2 = ql_vec_sub(ql_scene_corner(scene, tri, 2), e.v0);
    return e;
}

/* Do emitters shine from both sides? */
QL_INLINE bool ql_scene_two_sided(const ql_scene_t *scene)
{
    return QL_CFG_TWO_SIDED && scene->two_sided;
}

/* How many sides the hull has. */
#if QL_CFG_HULL
QL_INLINE unsigned ql_scene_sides(const ql_scene_t *scene)
{
    return scene->side_count;
}
#else
QL_INLINE unsigned ql_scene_sides(const ql_scene_t *scene)
{
    return (void)scene, 0;
}
#endif

/* The material of a triangle. */
QL_INLINE const ql_blob_material_t *ql_scene_material(
        const ql_scene_t *scene, const ql_blob_tri_t *tri)
{
    return scene->materials + (QL_LE16(tri->material) & 0x3fffu);
}

/* What is optional in a scene. Each of these is NULL for nothing, and always
 * where the feature is not built in:
 *   ql_scene_normals  the corner normals, one for each vertex
 *   ql_scene_gloss    what a material is beyond diffuse
 *   ql_scene_sphere   the sphere that an entry of the table of triangles is
 *   ql_scene_sky      light from all around; black without
 *   ql_scene_texels   the map of the sky, which is constant without
 *   ql_scene_lens     the lens of the camera, a pinhole without
 *   ql_scene_contacts what touches; nothing does without
 *   ql_scene_ranks    which counts of surfaces in one place */
#if QL_CFG_SMOOTH
QL_INLINE const ql_blob_normal_t *ql_scene_normals(const ql_scene_t *scene)
{
    return scene->normals;
}
#else
QL_INLINE const ql_blob_normal_t *ql_scene_normals(const ql_scene_t *scene)
{
    (void)scene;
    return NULL;
}
#endif

#if QL_GLOSS
QL_INLINE const ql_blob_gloss_t *ql_scene_gloss(
        const ql_scene_t *scene, const ql_blob_material_t *material)
{
    const size_t index = (size_t)(material - scene->materials);

    return index < scene->gloss_count ? scene->gloss + index : NULL;
}
#else
QL_INLINE const ql_blob_gloss_t *ql_scene_gloss(
        const ql_scene_t *scene, const ql_blob_material_t *material)
{
    (void)scene;
    (void)material;
    return NULL;
}
#endif

#if QL_CFG_SPHERES
QL_INLINE const ql_blob_sphere_t *ql_scene_sphere(
        const ql_scene_t *scene, const ql_blob_tri_t *tri)
{
    return tri->inv_n == 0 ? scene->spheres + QL_LE16(tri->vertex[0]) : NULL;
}
#else
QL_INLINE const ql_blob_sphere_t *ql_scene_sphere(
        const ql_scene_t *scene, const ql_blob_tri_t *tri)
{
    (void)scene;
    (void)tri;
    return NULL;
}
#endif

#if QL_CFG_SKY
QL_INLINE const ql_blob_sky_t *ql_scene_sky(const ql_scene_t *scene)
{
    return scene->sky;
}
#else
QL_INLINE const ql_blob_sky_t *ql_scene_sky(const ql_scene_t *scene)
{
    (void)scene;
    return NULL;
}
#endif

#if QL_CFG_SKY_MAP
QL_INLINE const ql_blob_texel_t *ql_scene_texels(const ql_scene_t *scene)
{
    return scene->texels;
}
#else
QL_INLINE const ql_blob_texel_t *ql_scene_texels(const ql_scene_t *scene)
{
    (void)scene;
    return NULL;
}
#endif

#if QL_CFG_CONTACT
QL_INLINE const uint16_t *ql_scene_contacts(const ql_scene_t *scene)
{
    return scene->contacts;
}
#else
QL_INLINE const uint16_t *ql_scene_contacts(const ql_scene_t *scene)
{
    (void)scene;
    return NULL;
}
#endif

#if QL_CFG_ORDER
QL_INLINE const uint16_t *ql_scene_ranks(const ql_scene_t *scene)
{
    return scene->ranks;
}
#else
QL_INLINE const uint16_t *ql_scene_ranks(const ql_scene_t *scene)
{
    (void)scene;
    return NULL;
}
#endif

#if QL_CFG_LENS
QL_INLINE const ql_blob_lens_t *ql_scene_lens(const ql_scene_t *scene)
{
    return scene->lens;
}
#else
QL_INLINE const ql_blob_lens_t *ql_scene_lens(const ql_scene_t *scene)
{
    (void)scene;
    return NULL;
}
#endif

#endif
