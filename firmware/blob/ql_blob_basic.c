/* ql_blob_basic.c - where tables lie, and those that every blob has */
/* SPDX-License-Identifier: MIT */

#include "blob/ql_blob_parts.h"

#include "math/vec/ql_vec_unit.h"

/* Find a table: aligned, after the header, entirely inside the blob. Entries of
 * a blob below 4 GB: entry_bytes * count_max fits 32 bits. */
static const void *table_at(const ql_blob_header_t *header,
        const ql_blob_table_t *table, uint32_t entry_bytes, uint32_t count_max,
        uint32_t *count)
{
    const uint32_t offset = QL_LE32(table->offset);
    const uint32_t size = QL_LE32(header->size_bytes);

    *count = QL_LE32(table->count);
    if (offset % 4 != 0 || offset < QL_LE16(header->header_bytes) ||
            offset > size || *count > count_max ||
            *count * entry_bytes > size - offset) {
        return NULL;
    }
    return (const uint8_t *)header + offset;
}

const void *ql_blob_optional(ql_blob_parts_t *parts, uint32_t needs,
        uint32_t entry_bytes, uint32_t count_max)
{
    const void *table = NULL;

    parts->count = 0;
    parts->sound = true;
    if (QL_LE32(parts->header->features) & needs) {
        table = table_at(parts->header, parts->next++, entry_bytes, count_max,
                &parts->count);
        if (table == NULL) {
            parts->count = 0;
            parts->sound = false;
        }
    }
    return table;
}

/* The tables of every blob, in the order of the header. */
enum { CAMERA, VERTICES, TRIANGLES, PAIRS, MATERIALS, LIGHTS, BASIC_TABLES };

/* Most entries (at most QL_VERTEX_MAX, below 2^18) and bytes of one (below
 * 2^8) of each, in a word. */
#define BASIC(count_max, entry_bytes)                                          \
    ((uint32_t)(count_max) << 8 | (uint32_t)(entry_bytes))
static const uint32_t basic[BASIC_TABLES] = {BASIC(1, sizeof(ql_blob_camera_t)),
        BASIC(QL_VERTEX_MAX, sizeof(ql_blob_vertex_t)),
        BASIC(QL_TRI_MAX, sizeof(ql_blob_tri_t)),
        BASIC(QL_TRI_MAX, 2 * sizeof(ql_blob_node16_t)),
        BASIC(QL_MATERIAL_MAX, sizeof(ql_blob_material_t)),
        BASIC(QL_LIGHT_MAX, sizeof(ql_blob_light_t))};

bool ql_blob_basic_open(ql_blob_parts_t *parts, ql_scene_t *scene)
{
    const ql_blob_header_t *h = parts->header;
    const uint32_t features = QL_LE32(h->features);
    const void *at[BASIC_TABLES];
    uint32_t count[BASIC_TABLES];

    scene->header = h;
    scene->node_bits =
            !QL_CFG_NODE8 || (features & QL_FEATURE_NODE16) != 0 ? 16 : 8;
    scene->two_sided = (features & QL_FEATURE_TWO_SIDED) != 0;
    scene->root_link = QL_LE16(h->root_link);
    scene->root_meta = (uint8_t)QL_LE16(h->root_meta); /* <= 16 */
    for (unsigned i = 0; i < BASIC_TABLES; i++) {
        at[i] = table_at(h, &h->camera + i,
                i == PAIRS && scene->node_bits == 8 ? sizeof(ql_blob_pair8_t)
                                                    : basic[i] & 0xffu,
                basic[i] >> 8, &count[i]);
        if (at[i] == NULL) {
            return false;
        }
    }
    scene->camera = at[CAMERA];
    scene->vertices = at[VERTICES];
    scene->triangles = at[TRIANGLES];
    scene->pairs = at[PAIRS];
    scene->materials = at[MATERIALS];
    scene->lights = at[LIGHTS];
    scene->light_count = (uint16_t)count[LIGHTS]; /* <= QL_LIGHT_MAX */
    parts->vertex_count = count[VERTICES];
    parts->triangle_count = count[TRIANGLES];
    parts->pair_count = count[PAIRS];
    parts->material_count = count[MATERIALS];
    return count[CAMERA] == 1 &&
           (count[LIGHTS] > 0) == ((features & QL_FEATURE_LIGHTS) != 0);
}

static bool vertices_valid(const ql_blob_vertex_t *vertices, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        for (unsigned k = 0; k < 3; k++) {
            const uint32_t c = QL_LE16(vertices[i].xyz[k]);

            if (c < QL_GRID_MARGIN || c > QL_GRID_MAX - QL_GRID_MARGIN) {
                return false;
            }
        }
    }
    return true;
}

/* Is a triangle's unit normal no longer than 1, but for rounding? The warps
 * rely on that. */
static bool normal_valid(const ql_scene_t *scene, const ql_blob_tri_t *tri)
{
    const ql_edges_t e = ql_scene_edges(scene, tri);
    const ql_vec3_t n = ql_vec_unit_q29_of_inv_n(
            ql_vec_cross(e.e1, e.e2), QL_LE32(tri->inv_n));
    const uint32_t x = ql_abs32(n.x), y = ql_abs32(n.y), z = ql_abs32(n.z);

    /* 3 2^62 fits; 2^38 is room for a length off by 2^-21 */
    return ql_product_u32(x, x) + ql_product_u32(y, y) + ql_product_u32(z, z) <=
           ((uint64_t)1 << 58) + ((uint64_t)1 << 38);
}

/* Does an entry without a normal stand for a sphere there is? */
static bool sphere_entry_valid(const ql_blob_tri_t *tri, uint32_t sphere_count)
{
    return QL_LE16(tri->vertex[0]) < sphere_count &&
           (tri->vertex[1] | tri->vertex[2]) == 0 &&
           QL_LE16(tri->material) >> 14 == 0;
}

static bool triangles_valid(
        const ql_blob_parts_t *parts, const ql_scene_t *scene)
{
    const ql_blob_tri_t *tris = scene->triangles;

    for (uint32_t i = 0; i < parts->triangle_count; i++) {
        const uint32_t packed = QL_LE16(tris[i].material);
        const uint32_t page = packed >> 14 << 16;

        if ((packed & 0x3fffu) >= parts->material_count ||
                (page && !QL_CFG_PAGES)) {
            return false;
        }
        if (QL_CFG_SPHERES && tris[i].inv_n == 0 &&
                sphere_entry_valid(tris + i, parts->sphere_count)) {
            continue;
        }
        if ((QL_LE32(tris[i].inv_n) & 0x80000000u) == 0) {
            return false;
        }
        for (unsigned k = 0; k < 3; k++) {
            if (page + QL_LE16(tris[i].vertex[k]) >= parts->vertex_count) {
                return false;
            }
        }
        if (QL_UNIT_NORMALS && !normal_valid(scene, tris + i)) {
            return false;
        }
    }
    return true;
}

static bool materials_valid(const ql_blob_material_t *materials, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        for (unsigned k = 0; k < 3; k++) {
            if (QL_LE32(materials[i].albedo[k]) > 0x80000000u) {
                return false;
            }
        }
    }
    return true;
}

/* Which emitter a light is: in order, and the last one the sky if there is. */
static bool emitter_valid(const ql_blob_light_t *lights, uint32_t i,
        uint32_t count, uint32_t tri_count, bool sky)
{
    const uint32_t triangle = QL_LE16(lights[i].triangle);

    if (QL_BLOB_HAS_OPTIONAL || QL_MIS) {
        if (i > 0 && triangle <= QL_LE16(lights[i - 1].triangle)) {
            return false;
        }
        if (sky && i == count - 1) {
            return triangle == QL_LIGHT_SKY;
        }
    }
    return triangle < tri_count; /* <= 65535, so never the sky */
}

static bool lights_valid(const ql_blob_parts_t *parts, const ql_scene_t *scene)
{
    const ql_blob_light_t *lights = scene->lights;
    const uint32_t count = scene->light_count;
    const bool sky = ql_scene_sky(scene) != NULL;

    for (uint32_t i = 0; i < count; i++) {
        const uint32_t cum = QL_LE32(lights[i].cum);
        const int16_t e = ql_i16(QL_LE16((uint16_t)lights[i].weight_exp));

        if (!emitter_valid(lights, i, count, parts->triangle_count, sky) ||
                e < -128 || e > 128 ||
                (QL_LE32(lights[i].weight_m) & 0x80000000u) == 0 ||
                (i == 0 ? cum != 0 : cum <= QL_LE32(lights[i - 1].cum))) {
            return false;
        }
    }
    return count > 0 || !sky;
}

static bool camera_valid(const ql_blob_camera_t *camera)
{
    for (unsigned k = 0; k < 3; k++) {
        if (!ql_blob_reach_valid(camera->at[QL_CAMERA_BASE][k][1]) ||
                !ql_blob_reach_valid(camera->towards[QL_CAMERA_BASE][k]) ||
                !ql_blob_reach_valid(camera->towards[QL_CAMERA_RIGHT][k]) ||
                !ql_blob_reach_valid(camera->towards[QL_CAMERA_UP][k])) {
            return false;
        }
    }
    return true;
}

bool ql_blob_basic_check(const ql_blob_parts_t *parts, const ql_scene_t *scene)
{
    return camera_valid(scene->camera) &&
           vertices_valid(scene->vertices, parts->vertex_count) &&
           materials_valid(scene->materials, parts->material_count) &&
           triangles_valid(parts, scene) && lights_valid(parts, scene);
}
