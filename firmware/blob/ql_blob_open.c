/* ql_blob_open.c - check a blob completely, once */
/* SPDX-License-Identifier: MIT */

#include "blob/ql_blob_open.h"

#include "base/ql_crc.h"
#include "sample/ql_table.h"

/* Features of this build. */
#define BUILT                                                                  \
    ((uint32_t)(QL_CFG_NODE16 ? QL_FEATURE_NODE16 : 0) |                       \
            (uint32_t)(QL_CFG_NODE8 ? QL_FEATURE_NODE8 : 0) |                  \
            (uint32_t)(QL_CFG_PAGES ? QL_FEATURE_PAGES : 0) |                  \
            (uint32_t)(QL_CFG_LIGHTS ? QL_FEATURE_LIGHTS : 0) |                \
            (uint32_t)(QL_CFG_TWO_SIDED ? QL_FEATURE_TWO_SIDED : 0) |          \
            (uint32_t)(QL_CFG_SMOOTH ? QL_FEATURE_SMOOTH : 0) |                \
            (uint32_t)(QL_CFG_PHONG ? QL_FEATURE_PHONG : 0) |                  \
            (uint32_t)(QL_CFG_MIRROR ? QL_FEATURE_MIRROR : 0) |                \
            (uint32_t)(QL_CFG_GLASS ? QL_FEATURE_GLASS : 0) |                  \
            (uint32_t)(QL_CFG_SPHERES ? QL_FEATURE_SPHERES : 0) |              \
            (uint32_t)(QL_CFG_SKY ? QL_FEATURE_SKY : 0) |                      \
            (uint32_t)(QL_CFG_SKY_MAP ? QL_FEATURE_SKY_MAP : 0) |              \
            (uint32_t)(QL_CFG_TABLES ? QL_FEATURE_TABLES : 0) |                \
            (uint32_t)(QL_CFG_LENS ? QL_FEATURE_LENS : 0))

/* Are there tables beyond those of every blob? */
#define MORE                                                                   \
    (QL_CFG_SMOOTH || QL_GLOSS || QL_CFG_SPHERES || QL_CFG_SKY ||              \
            QL_CFG_SKY_MAP || QL_CFG_TABLES || QL_CFG_LENS)

/* Bytes of a header with these features, all of them built in. */
static uint32_t header_bytes_of(uint32_t features)
{
    uint32_t bytes = sizeof(ql_blob_header_t);

#define ADD_TABLE(name, entry, needs)                                          \
    if (features & BUILT & (uint32_t)(needs)) {                                \
        bytes += (uint32_t)sizeof(ql_blob_table_t);                            \
    }
    QL_BLOB_MORE_LIST(ADD_TABLE)
#undef ADD_TABLE
    return bytes;
}

/* Find a table: aligned, after the header, entirely inside the blob. Entries of
 * a blob below 4 GB: entry_bytes * count_max fits 32 bits. */
static const void *table_at(const ql_blob_header_t *header,
        const ql_blob_table_t *table, uint32_t entry_bytes, uint32_t count_max,
        uint32_t *count)
{
    const uint32_t offset = QL_LE32(table->offset);
    const uint32_t size = QL_LE32(header->size_bytes);

    *count = QL_LE32(table->count);
    if (offset % 4 != 0 ||
            offset < header_bytes_of(QL_LE32(header->features)) ||
            offset > size || *count > count_max ||
            *count * entry_bytes > size - offset) {
        return NULL;
    }
    return (const uint8_t *)header + offset;
}

/* A link and its meta lead to a leaf of real triangles, or to a real pair. */
QL_FAST_INLINE bool link_valid(
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

#if QL_UNIT_NORMALS
/* Is a triangle's unit normal no longer than 1, but for rounding? The warps
 * rely on that. */
static bool normal_valid(const ql_scene_t *scene, const ql_blob_tri_t *tri)
{
    const ql_edges_t e = ql_scene_edges(scene, tri);
    const ql_vec3_t n =
            ql_vec_unit(ql_vec_cross(e.e1, e.e2), QL_LE32(tri->inv_n));
    const uint32_t x = ql_abs32(n.x), y = ql_abs32(n.y), z = ql_abs32(n.z);

    /* 3 2^62 fits; 2^38 is room for a length off by 2^-21 */
    return ql_product_u32(x, x) + ql_product_u32(y, y) + ql_product_u32(z, z) <=
           ((uint64_t)1 << 58) + ((uint64_t)1 << 38);
}
#endif

/* Does an entry without a normal stand for a sphere there is? */
static bool sphere_entry_valid(const ql_blob_tri_t *tri, uint32_t sphere_count)
{
    return QL_LE16(tri->vertex[0]) < sphere_count &&
           (tri->vertex[1] | tri->vertex[2]) == 0 &&
           QL_LE16(tri->material) >> 14 == 0;
}

static bool triangles_valid(const ql_scene_t *scene, uint32_t count,
        uint32_t vertex_count, uint32_t material_count, uint32_t sphere_count)
{
    const ql_blob_tri_t *tris = scene->triangles;

    for (uint32_t i = 0; i < count; i++) {
        const uint32_t packed = QL_LE16(tris[i].material);
        const uint32_t page = packed >> 14 << 16;

        if ((packed & 0x3fffu) >= material_count || (page && !QL_CFG_PAGES)) {
            return false;
        }
        if (QL_CFG_SPHERES && tris[i].inv_n == 0 &&
                sphere_entry_valid(tris + i, sphere_count)) {
            continue;
        }
        if ((QL_LE32(tris[i].inv_n) & 0x80000000u) == 0) {
            return false;
        }
        for (unsigned k = 0; k < 3; k++) {
            if (page + QL_LE16(tris[i].vertex[k]) >= vertex_count) {
                return false;
            }
        }
#if QL_UNIT_NORMALS
        if (!normal_valid(scene, tris + i)) {
            return false;
        }
#endif
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

    if (MORE || QL_CFG_STRATEGIES) {
        if (i > 0 && triangle <= QL_LE16(lights[i - 1].triangle)) {
            return false;
        }
        if (sky && i == count - 1) {
            return triangle == QL_LIGHT_SKY;
        }
    }
    return triangle < tri_count; /* <= 65535, so never the sky */
}

static bool lights_valid(const ql_blob_light_t *lights, uint32_t count,
        uint32_t tri_count, bool sky)
{
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t cum = QL_LE32(lights[i].cum);
        const int16_t e = ql_i16(QL_LE16((uint16_t)lights[i].weight_exp));

        if (!emitter_valid(lights, i, count, tri_count, sky) || e < -128 ||
                e > 128 || (QL_LE32(lights[i].weight_m) & 0x80000000u) == 0 ||
                (i == 0 ? cum != 0 : cum <= QL_LE32(lights[i - 1].cum))) {
            return false;
        }
    }
    return count > 0 || !sky;
}

/* Is the number in a word, or the high word of a wide one, -2^30..2^30? */
static bool reach_valid(uint32_t word)
{
    return QL_LE32(word) + 0x40000000u <= 0x80000000u;
}

static bool camera_valid(const ql_blob_camera_t *camera)
{
    for (unsigned k = 0; k < 3; k++) {
        if (!reach_valid(camera->p[k][1]) || !reach_valid(camera->d[k]) ||
                !reach_valid(camera->dr[k]) || !reach_valid(camera->du[k])) {
            return false;
        }
    }
    return true;
}

/* ---- Tables of features ------------------------------------------------- */

#if MORE
/* The next of them, in the order of QL_BLOB_MORE_LIST. */
typedef struct {
    const ql_blob_header_t *header;
    const ql_blob_table_t *next;
    uint32_t count; /* entries of the last one found; 0 without it */
    bool sound;     /* nothing was wrong so far */
} more_t;

static const void *more_table(
        more_t *more, unsigned needs, uint32_t entry_bytes, uint32_t count_max)
{
    const void *table = NULL;

    more->count = 0;
    if (QL_LE32(more->header->features) & needs) {
        table = table_at(more->header, more->next++, entry_bytes, count_max,
                &more->count);
        if (table == NULL) {
            more->count = 0;
            more->sound = false;
        }
    }
    return table;
}
#endif

#if QL_GLOSS
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
        const uint32_t albedo = QL_LE32(material->albedo[k]); /* <= 2^31 */

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
#endif

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
#endif

#if QL_CFG_TABLES
static bool distribution_valid(const ql_scene_t *scene,
        const ql_blob_distribution_t *d, uint32_t word_count)
{
    const uint32_t first = QL_LE32(d->first);
    uint16_t count[QL_TABLE_DIMS_MAX];
    ql_table_t table;

    for (unsigned k = 0; k < QL_TABLE_DIMS_MAX; k++) {
        count[k] = QL_LE16(d->count[k]);
        if (k >= QL_LE16(d->dims) && count[k] != 1) {
            return false;
        }
    }
    return first <= word_count &&
           ql_table_open(&table, scene->words + first, word_count - first,
                   QL_LE16(d->dims), count) == QL_OK;
}
#endif

#if QL_CFG_SKY_MAP
/* A map has all its texels, and a distribution of its size. */
static bool sky_map_valid(const ql_scene_t *scene, uint32_t texel_count)
{
    const ql_blob_sky_t *sky = scene->sky;
    const uint32_t width = QL_LE16(sky->width), height = QL_LE16(sky->height);
    const ql_blob_distribution_t *d = scene->tables + QL_LE16(sky->table);

    if (width == 0 || height == 0 || texel_count != width * height ||
            QL_LE16(sky->table) >= scene->table_count ||
            QL_LE16(d->dims) != 2 || d->count[0] != sky->width ||
            d->count[1] != sky->height) {
        return false;
    }
    for (uint32_t i = 0; i < texel_count; i++) {
        if (QL_LE32(scene->texels[i].rgb9e5) >> 27 > 23) {
            return false;
        }
    }
    return true;
}
#endif

#if QL_CFG_LENS
static bool lens_valid(const ql_blob_lens_t *lens)
{
    for (unsigned i = 0; i < 6; i++) {
        if (!reach_valid(lens->p[i / 3][i % 3][1]) ||
                !reach_valid(lens->d[i / 3][i % 3])) {
            return false;
        }
    }
    return true;
}
#endif

/* Open and check them; vertices and materials were found before. */
static bool more_open(ql_scene_t *scene, const ql_blob_header_t *h,
        uint32_t vertices, uint32_t materials, uint32_t *spheres)
{
#if MORE
    more_t more = {h, (const ql_blob_table_t *)(h + 1), 0, true};
#if QL_CFG_SKY_MAP
    uint32_t texels;
#endif

    (void)vertices;
    (void)materials;
    (void)spheres;
#if QL_CFG_SMOOTH
    scene->normals = more_table(
            &more, QL_FEATURE_SMOOTH, sizeof(ql_blob_normal_t), QL_VERTEX_MAX);
    more.sound =
            more.sound && (scene->normals == NULL || more.count == vertices);
#endif
#if QL_GLOSS
    scene->gloss = more_table(&more,
            QL_FEATURE_PHONG | QL_FEATURE_MIRROR | QL_FEATURE_GLASS,
            sizeof(ql_blob_gloss_t), materials);
    scene->gloss_count = (uint16_t)more.count; /* <= QL_MATERIAL_MAX */
    for (uint32_t i = 0; more.sound && i < more.count; i++) {
        more.sound = gloss_valid(
                scene->gloss + i, scene->materials + i, QL_LE32(h->features));
    }
#endif
#if QL_CFG_SPHERES
    scene->spheres = more_table(
            &more, QL_FEATURE_SPHERES, sizeof(ql_blob_sphere_t), QL_TRI_MAX);
    *spheres = more.count;
    for (uint32_t i = 0; more.sound && i < more.count; i++) {
        more.sound = sphere_valid(scene->spheres + i);
    }
#endif
#if QL_CFG_SKY
    scene->sky = more_table(&more, QL_FEATURE_SKY, sizeof(ql_blob_sky_t), 1);
    more.sound = more.sound && (scene->sky == NULL || more.count == 1);
#endif
#if QL_CFG_SKY_MAP
    scene->texels = more_table(
            &more, QL_FEATURE_SKY_MAP, sizeof(ql_blob_texel_t), UINT32_MAX / 4);
    texels = more.count;
#endif
#if QL_CFG_TABLES
    scene->tables = more_table(&more, QL_FEATURE_TABLES,
            sizeof(ql_blob_distribution_t), UINT16_MAX);
    scene->table_count = (uint16_t)more.count; /* <= UINT16_MAX */
    scene->words = more_table(
            &more, QL_FEATURE_TABLES, sizeof(uint16_t), UINT32_MAX / 2);
    for (uint16_t i = 0; more.sound && i < scene->table_count; i++) {
        more.sound = distribution_valid(scene, scene->tables + i, more.count);
    }
#endif
#if QL_CFG_LENS
    scene->lens = more_table(&more, QL_FEATURE_LENS, sizeof(ql_blob_lens_t), 1);
    more.sound =
            more.sound && (scene->lens == NULL ||
                                  (more.count == 1 && lens_valid(scene->lens)));
#endif
#if QL_CFG_SKY_MAP
    if (more.sound && scene->texels != NULL) {
        return scene->sky != NULL && scene->tables != NULL &&
               sky_map_valid(scene, texels);
    }
#endif
#if QL_CFG_SKY
    if (more.sound && scene->sky != NULL) {
        return (scene->sky->width | scene->sky->height) == 0;
    }
#endif
    return more.sound;
#else
    (void)scene;
    (void)h;
    (void)vertices;
    (void)materials;
    (void)spheres;
    return true;
#endif
}

/* ---- The tree ----------------------------------------------------------- */

/* One child of a pair, whatever the width. */
typedef struct {
    uint32_t link;
    unsigned meta;
    bool box_valid;
} child_t;

static child_t child_of(const void *pairs, unsigned bits, uint32_t node)
{
    child_t c = {0, 0, true};

    if (!QL_CFG_NODE8 || (QL_CFG_NODE16 && bits == 16)) {
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
    if (size < 4) {
        return QL_ERR_TRUNCATED;
    }
    if (QL_LE32(h->magic) != QL_BLOB_MAGIC) {
        return QL_ERR_MAGIC;
    }
    if (size < sizeof *h) {
        return QL_ERR_TRUNCATED;
    }
    if (QL_LE16(h->version) != QL_BLOB_VERSION) {
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
    if ((QL_LE32(h->features) & ~BUILT) != 0) {
        return QL_ERR_FEATURE;
    }
    /* the tables of a feature are known only where it is built in */
    if (QL_LE16(h->header_bytes) != header_bytes_of(QL_LE32(h->features))) {
        return QL_ERR_VERSION;
    }
    if (MORE && QL_LE16(h->header_bytes) > QL_LE32(h->size_bytes)) {
        return QL_ERR_RANGE;
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

static ql_status_t tables_open(ql_scene_t *scene, const ql_blob_header_t *h)
{
    const uint32_t features = QL_LE32(h->features);
    const void *at[BASIC_TABLES];
    uint32_t count[BASIC_TABLES], spheres = 0;
    bool sky = false;

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
            return QL_ERR_RANGE;
        }
    }
    scene->camera = at[CAMERA];
    scene->vertices = at[VERTICES];
    scene->triangles = at[TRIANGLES];
    scene->pairs = at[PAIRS];
    scene->materials = at[MATERIALS];
    scene->lights = at[LIGHTS];
    if (count[CAMERA] != 1 ||
            (count[LIGHTS] > 0) != ((features & QL_FEATURE_LIGHTS) != 0)) {
        return QL_ERR_RANGE;
    }
    scene->light_count = (uint16_t)count[LIGHTS]; /* <= QL_LIGHT_MAX */
    if (QL_LE16(h->depth) > QL_CFG_BVH_STACK) {
        return QL_ERR_CAPACITY;
    }
    if (!camera_valid(scene->camera) ||
            !vertices_valid(scene->vertices, count[VERTICES]) ||
            !materials_valid(scene->materials, count[MATERIALS]) ||
            !more_open(scene, h, count[VERTICES], count[MATERIALS], &spheres) ||
            !triangles_valid(scene, count[TRIANGLES], count[VERTICES],
                    count[MATERIALS], spheres)) {
        return QL_ERR_RANGE;
    }
#if QL_CFG_SKY
    sky = scene->sky != NULL;
#endif
    if (!lights_valid(scene->lights, count[LIGHTS], count[TRIANGLES], sky)) {
        return QL_ERR_RANGE;
    }
    return tree_valid(scene, count[PAIRS], count[TRIANGLES], QL_LE16(h->depth));
}

ql_status_t ql_blob_open(ql_scene_t *scene, const void *blob, size_t size)
{
    ql_status_t status;

    *scene = (ql_scene_t){0};
    status = header_valid(blob, size);
    if (status == QL_OK && !header_in_range(blob)) {
        status = QL_ERR_RANGE;
    }
    if (status == QL_OK) {
        status = tables_open(scene, blob);
    }
    if (status != QL_OK) {
        *scene = (ql_scene_t){0};
    }
    return status;
}

const char *ql_blob_missing(const void *blob)
{
    /* one after the other, each ended by a 0, in the order of their bits */
#define FEATURE_NAME(name, bit, text) text "\0"
    static const char names[] = QL_FEATURE_LIST(FEATURE_NAME);
#undef FEATURE_NAME
    const char *name = names;
    uint32_t missing =
            QL_LE32(((const ql_blob_header_t *)blob)->features) & ~BUILT;

    if (missing == 0) {
        return "";
    }
    for (; *name != '\0'; missing >>= 1) {
        if (missing & 1u) {
            return name;
        }
        while (*name++ != '\0') {
        }
    }
    return "unknown";
}
