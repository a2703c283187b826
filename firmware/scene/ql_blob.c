/* ql_blob.c - check a blob completely, once */
/* SPDX-License-Identifier: MIT */

#include "scene/ql_blob.h"

#include "base/ql_crc.h"
#include "scene/ql_scene.h"

/* Features of this build. */
#define BUILT                                                                  \
    ((QL_CFG_NODE16 ? QL_FEATURE_NODE16 : 0) |                                 \
            (QL_CFG_NODE8 ? QL_FEATURE_NODE8 : 0) |                            \
            (QL_CFG_PAGES ? QL_FEATURE_PAGES : 0) |                            \
            (QL_CFG_LIGHTS ? QL_FEATURE_LIGHTS : 0) |                          \
            (QL_CFG_TWO_SIDED ? QL_FEATURE_TWO_SIDED : 0))

/* Find a table: aligned, after the header, entirely inside the blob. */
static const void *table_at(const ql_blob_header_t *header,
        const ql_blob_table_t *table, uint32_t entry_bytes, uint32_t count_max,
        uint32_t *count)
{
    const uint32_t offset = QL_LE32(table->offset);
    const uint32_t size = QL_LE32(header->size_bytes);

    *count = QL_LE32(table->count);
    if (offset % 4 != 0 || offset < sizeof *header || offset > size ||
            *count > count_max || *count > (size - offset) / entry_bytes) {
        return NULL;
    }
    return (const uint8_t *)header + offset;
}

/* A link and its meta lead to a leaf of real triangles, or to a real pair. */
static bool link_valid(
        unsigned meta, uint32_t link, uint32_t pair_count, uint32_t tri_count)
{
    if (meta < 3) {
        return link < pair_count;
    }
    return meta - 3 <= QL_LEAF_MAX && link <= tri_count &&
           meta - 3 <= tri_count - link;
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
    const ql_vec3_t v0 = ql_scene_corner(scene, tri, 0);
    const ql_vec3_t e1 = ql_vec_sub(ql_scene_corner(scene, tri, 1), v0);
    const ql_vec3_t e2 = ql_vec_sub(ql_scene_corner(scene, tri, 2), v0);
    const ql_vec3_t n = ql_vec_unit(ql_vec_cross(e1, e2), QL_LE32(tri->inv_n));
    const uint64_t x = ql_abs32(n.x), y = ql_abs32(n.y), z = ql_abs32(n.z);

    /* 3 2^62 fits; 2^38 is room for a length off by 2^-21 */
    return x * x + y * y + z * z <= ((uint64_t)1 << 58) + ((uint64_t)1 << 38);
}

static bool triangles_valid(const ql_scene_t *scene, uint32_t count,
        uint32_t vertex_count, uint32_t material_count)
{
    const ql_blob_tri_t *tris = scene->triangles;

    for (uint32_t i = 0; i < count; i++) {
        const uint32_t packed = QL_LE16(tris[i].material);
        const uint32_t page = packed >> 14 << 16;

        if ((packed & 0x3fffu) >= material_count || (page && !QL_CFG_PAGES) ||
                (QL_LE32(tris[i].inv_n) & 0x80000000u) == 0) {
            return false;
        }
        for (unsigned k = 0; k < 3; k++) {
            if (page + QL_LE16(tris[i].vertex[k]) >= vertex_count) {
                return false;
            }
        }
        if (!normal_valid(scene, tris + i)) {
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

static bool lights_valid(
        const ql_blob_light_t *lights, uint32_t count, uint32_t tri_count)
{
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t cum = QL_LE32(lights[i].cum);
        const int16_t e = ql_i16(QL_LE16((uint16_t)lights[i].weight_exp));

        if (QL_LE16(lights[i].triangle) >= tri_count || e < -128 || e > 128 ||
                (QL_LE32(lights[i].weight_m) & 0x80000000u) == 0 ||
                (i == 0 ? cum != 0 : cum <= QL_LE32(lights[i - 1].cum))) {
            return false;
        }
    }
    return true;
}

static bool camera_valid(const ql_blob_camera_t *camera)
{
    for (unsigned k = 0; k < 3; k++) {
        const int64_t p = ql_i64((uint64_t)QL_LE32(camera->p[k][1]) << 32);
        const int64_t d = ql_i32(QL_LE32(camera->d[k]));
        const int64_t dr = ql_i32(QL_LE32(camera->dr[k]));
        const int64_t du = ql_i32(QL_LE32(camera->du[k]));
        const int64_t limit = (int64_t)1 << 30;

        if (p < -(limit << 32) || p > limit << 32 || d < -limit || d > limit ||
                dr < -limit || dr > limit || du < -limit || du > limit) {
            return false;
        }
    }
    return true;
}

/* One child of a pair, whatever the width. */
typedef struct {
    uint32_t link;
    unsigned meta;
    bool box_valid;
} child_t;

static child_t child_of(const void *pairs, unsigned bits, uint32_t node)
{
    child_t c = {0, 0, true};

    if (bits == 16) {
        const ql_blob_node16_t *n = (const ql_blob_node16_t *)pairs + node;

        c.link = QL_LE16(n->link);
        c.meta = QL_LE16(n->meta);
        for (unsigned k = 0; k < 3; k++) {
            c.box_valid = c.box_valid && QL_LE16(n->centre[k]) <= QL_GRID_MAX &&
                          QL_LE16(n->half[k]) <= 16384;
        }
    } else {
        const ql_blob_pair8_t *n = (const ql_blob_pair8_t *)pairs + (node >> 1);
        const unsigned i = node & 1u;

        c.link = QL_LE16(n->link[i]);
        c.meta = i ? n->meta >> 4 : n->meta & 15u;
        c.box_valid = n->shift <= 8;
        for (unsigned k = 0; k < 3 && c.box_valid; k++) {
            c.box_valid = QL_LE16(n->base[k]) + ((uint32_t)n->centre[i][k]
                                                        << n->shift) <=
                                  QL_GRID_MAX &&
                          (uint32_t)n->half[i][k] << n->shift <= 16384;
        }
    }
    return c;
}

/* Walk the whole tree as a ray would, with a stack no larger than a ray's.
 * Pairs lie in the order of this walk: each is reached once, the walk ends. */
static ql_status_t tree_valid(const ql_scene_t *scene, uint32_t pair_count,
        uint32_t tri_count, unsigned depth_max)
{
    uint32_t stack[QL_CFG_BVH_STACK];
    uint8_t level[QL_CFG_BVH_STACK];
    unsigned depth = 0, at = 0;
    uint32_t visits = 0, node;
    child_t c = {scene->root_link, scene->root_meta, true};

    if (!link_valid(c.meta, c.link, pair_count, tri_count)) {
        return QL_ERR_RANGE;
    }
    for (;;) {
        if (c.meta < 3) {
            if (c.link != visits++ || ++at > depth_max) {
                return QL_ERR_RANGE;
            }
            node = 2 * c.link;
            stack[depth] = node + 1;
            level[depth++] = (uint8_t)at;
        } else {
            if (depth == 0) {
                return visits == pair_count ? QL_OK : QL_ERR_RANGE;
            }
            node = stack[--depth];
            at = level[depth];
        }
        c = child_of(scene->pairs, scene->node_bits, node);
        if (!c.box_valid ||
                !link_valid(c.meta, c.link, pair_count, tri_count)) {
            return QL_ERR_RANGE;
        }
    }
}

static ql_status_t header_valid(const void *blob, size_t size)
{
    const ql_blob_header_t *h = blob;

    if (((uintptr_t)blob & 3u) != 0) {
        return QL_ERR_ALIGN;
    }
    if (size < sizeof *h) {
        return size >= 4 && QL_LE32(h->magic) != QL_BLOB_MAGIC
                       ? QL_ERR_MAGIC
                       : QL_ERR_TRUNCATED;
    }
    if (QL_LE32(h->magic) != QL_BLOB_MAGIC) {
        return QL_ERR_MAGIC;
    }
    if (QL_LE16(h->version) != QL_BLOB_VERSION ||
            QL_LE16(h->header_bytes) != sizeof *h) {
        return QL_ERR_VERSION;
    }
    if (QL_LE32(h->size_bytes) > size) {
        return QL_ERR_TRUNCATED;
    }
    if (QL_LE32(h->size_bytes) < sizeof *h || QL_LE32(h->size_bytes) % 4) {
        return QL_ERR_RANGE;
    }
    if (ql_crc32(0, (const uint8_t *)blob + QL_BLOB_CRC_FROM,
                (size_t)(QL_LE32(h->size_bytes) - QL_BLOB_CRC_FROM)) !=
            QL_LE32(h->crc32)) {
        return QL_ERR_CHECKSUM;
    }
    if (*ql_blob_missing(blob) != '\0') {
        return QL_ERR_FEATURE;
    }
    return QL_OK;
}

/* Numbers of the header that stand for themselves. */
static bool header_in_range(const ql_blob_header_t *h)
{
    const uint32_t features = QL_LE32(h->features);
    const int16_t radiance = ql_i16(QL_LE16((uint16_t)h->radiance_exp));
    const uint32_t width = QL_LE16(h->image_width);
    const uint32_t height = QL_LE16(h->image_height);
    const bool node16 = (features & QL_FEATURE_NODE16) != 0;
    const bool node8 = (features & QL_FEATURE_NODE8) != 0;

    return node16 != node8 && radiance >= -64 && radiance <= 64 && width >= 1 &&
           width <= QL_IMAGE_MAX && height >= 1 && height <= QL_IMAGE_MAX &&
           QL_LE16(h->root_meta) <= 3 + QL_LEAF_MAX;
}

static ql_status_t tables_open(ql_scene_t *scene, const ql_blob_header_t *h)
{
    const uint32_t features = QL_LE32(h->features);
    uint32_t cameras, vertices, tris, pairs, materials, lights;

    scene->header = h;
    scene->node_bits = features & QL_FEATURE_NODE16 ? 16 : 8;
    scene->two_sided = (features & QL_FEATURE_TWO_SIDED) != 0;
    scene->root_link = QL_LE16(h->root_link);
    scene->root_meta = (uint8_t)QL_LE16(h->root_meta); /* <= 16 */
    scene->camera =
            table_at(h, &h->camera, sizeof(ql_blob_camera_t), 1, &cameras);
    scene->vertices = table_at(h, &h->vertices, sizeof(ql_blob_vertex_t),
            QL_VERTEX_MAX, &vertices);
    scene->triangles = table_at(
            h, &h->triangles, sizeof(ql_blob_tri_t), QL_TRI_MAX, &tris);
    scene->pairs = table_at(h, &h->pairs,
            scene->node_bits == 16 ? 2 * sizeof(ql_blob_node16_t)
                                   : sizeof(ql_blob_pair8_t),
            QL_TRI_MAX, &pairs);
    scene->materials = table_at(h, &h->materials, sizeof(ql_blob_material_t),
            QL_MATERIAL_MAX, &materials);
    scene->lights = table_at(
            h, &h->lights, sizeof(ql_blob_light_t), QL_LIGHT_MAX, &lights);
    if (!scene->camera || cameras != 1 || !scene->vertices ||
            !scene->triangles || !scene->pairs || !scene->materials ||
            !scene->lights ||
            (lights > 0) != ((features & QL_FEATURE_LIGHTS) != 0)) {
        return QL_ERR_RANGE;
    }
    scene->light_count = (uint16_t)lights; /* <= QL_LIGHT_MAX */
    if (QL_LE16(h->depth) > QL_CFG_BVH_STACK) {
        return QL_ERR_CAPACITY;
    }
    if (!camera_valid(scene->camera) ||
            !vertices_valid(scene->vertices, vertices) ||
            !triangles_valid(scene, tris, vertices, materials) ||
            !materials_valid(scene->materials, materials) ||
            !lights_valid(scene->lights, lights, tris)) {
        return QL_ERR_RANGE;
    }
    return tree_valid(scene, pairs, tris, QL_LE16(h->depth));
}

ql_status_t ql_blob_open(ql_scene_t *scene, const void *blob, size_t size)
{
    static const ql_scene_t zero;
    ql_status_t status;

    *scene = zero;
    status = header_valid(blob, size);
    if (status == QL_OK && !header_in_range(blob)) {
        status = QL_ERR_RANGE;
    }
    if (status == QL_OK) {
        status = tables_open(scene, blob);
    }
    if (status != QL_OK) {
        *scene = zero;
    }
    return status;
}

const char *ql_blob_missing(const void *blob)
{
    const uint32_t missing =
            QL_LE32(((const ql_blob_header_t *)blob)->features) &
            ~(uint32_t)BUILT;

    if (missing == 0) {
        return "";
    }
#define NAME_FEATURE(name, bit, text)                                          \
    if (missing & (uint32_t)name) {                                            \
        return text;                                                           \
    }
    QL_FEATURE_LIST(NAME_FEATURE)
#undef NAME_FEATURE
    return "unknown";
}
