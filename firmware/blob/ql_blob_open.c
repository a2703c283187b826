/* ql_blob_open.c - check a blob completely, once */
/* SPDX-License-Identifier: MIT */

#include "blob/ql_blob_open.h"

#include "base/ql_crc.h"
#include "base/ql_settings.h"
#include "blob/ql_blob_parts.h"

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
            (uint32_t)(QL_CFG_LENS ? QL_FEATURE_LENS : 0) |                    \
            (uint32_t)(QL_CFG_CONTACT ? QL_FEATURE_CONTACT : 0) |              \
            (uint32_t)(QL_CFG_ORDER ? QL_FEATURE_ORDER : 0) |                  \
            (uint32_t)(QL_CFG_HULL ? QL_FEATURE_HULL : 0))

/* Bytes of a header with these features, all of them built in. */
static uint32_t header_bytes_of(uint32_t features)
{
    uint32_t bytes = sizeof(ql_blob_header_t);

#define ADD_TABLE(name, entry, needs)                                          \
    if (features & BUILT & (uint32_t)(needs)) {                                \
        bytes += (uint32_t)sizeof(ql_blob_table_t);                            \
    }
    QL_BLOB_OPTIONAL_LIST(ADD_TABLE)
#undef ADD_TABLE
    return bytes;
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
    if (QL_BLOB_HAS_OPTIONAL &&
            QL_LE16(h->header_bytes) > QL_LE32(h->size_bytes)) {
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
           QL_LE16(h->root_meta) <= 3 + QL_LEAF_MAX &&
           h->auto_direct <= QL_DIRECT_MIS &&
           h->auto_lights <= QL_LIGHTS_UNIFORM;
}

/* The optional tables, in the order of QL_BLOB_OPTIONAL_LIST. */
static bool optional_open(ql_blob_parts_t *parts, ql_scene_t *scene)
{
    return ql_blob_smooth_open(parts, scene) &&
           ql_blob_gloss_open(parts, scene) &&
           ql_blob_spheres_open(parts, scene) &&
           ql_blob_sky_open(parts, scene) &&
           ql_blob_sky_map_open(parts, scene) &&
           ql_blob_distributions_open(parts, scene) &&
           ql_blob_lens_open(parts, scene) &&
           ql_blob_contacts_open(parts, scene) &&
           ql_blob_ranks_open(parts, scene) &&
           ql_blob_hull_open(parts, scene) && ql_blob_sky_check(parts, scene);
}

static ql_status_t parts_open(ql_scene_t *scene, const ql_blob_header_t *h)
{
    ql_blob_parts_t parts = {0};

    parts.header = h;
    parts.next = (const ql_blob_table_t *)(h + 1);
    if (!ql_blob_basic_open(&parts, scene)) {
        return QL_ERR_RANGE;
    }
    if (QL_LE16(h->depth) > QL_CFG_BVH_STACK) {
        return QL_ERR_CAPACITY;
    }
    return optional_open(&parts, scene) && ql_blob_basic_check(&parts, scene) &&
                           ql_blob_tree_check(&parts, scene)
                   ? QL_OK
                   : QL_ERR_RANGE;
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
        status = parts_open(scene, blob);
    }
    if (status != QL_OK) {
        *scene = (ql_scene_t){0};
    }
    return status;
}

#define QL_FEATURE_BIT(name, bit, text)                                        \
    QL_STATIC_ASSERT(name == (uint32_t)1 << (bit), name##_has_its_bit);
QL_FEATURE_LIST(QL_FEATURE_BIT)
#undef QL_FEATURE_BIT

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
