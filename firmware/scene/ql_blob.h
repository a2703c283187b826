/* ql_blob.h - the scene blob as it lies in memory, and how to open it */
/* SPDX-License-Identifier: MIT */

/* The layout is specified in BLOB.md. Every field is little-endian: read it
 * through QL_LE16 or QL_LE32. Fields are naturally aligned to at most 4 bytes,
 * so the structs below have no padding on any supported compiler. */

#ifndef QL_BLOB_H
#define QL_BLOB_H

#include "base/ql_base.h"

#define QL_BLOB_MAGIC    0x58554c51u /* the bytes "QLUX" */
#define QL_BLOB_VERSION  1u
#define QL_BLOB_CRC_FROM 16u /* the CRC covers [16, size_bytes) */

/* Limits of the format. */
#define QL_GRID_MAX     32767 /* largest coordinate of a position */
#define QL_GRID_MARGIN  8     /* vertices lie in [8, 32759] */
#define QL_TRI_MAX      65535u
#define QL_VERTEX_MAX   262140u /* four pages of 65535 */
#define QL_MATERIAL_MAX 16384u
#define QL_LIGHT_MAX    65535u
#define QL_LEAF_MAX     13u    /* triangles in one leaf */
#define QL_DEPTH_MAX    32u    /* what qlux-scene builds at most */
#define QL_IMAGE_MAX    16384u /* pixels a side */

/* Features: what a scene needs of a build. Bit, name. */
#define QL_FEATURE_LIST(X)                                                     \
    X(QL_FEATURE_NODE16, 0, "node16")                                          \
    X(QL_FEATURE_NODE8, 1, "node8")                                            \
    X(QL_FEATURE_LIGHTS, 2, "lights")                                          \
    X(QL_FEATURE_TWO_SIDED, 3, "two-sided")                                    \
    X(QL_FEATURE_PAGES, 4, "pages")

enum {
#define QL_FEATURE_ENUM(name, bit, text) name = 1 << (bit),
    QL_FEATURE_LIST(QL_FEATURE_ENUM)
#undef QL_FEATURE_ENUM
};

/* Where one table lies: bytes from the start of the blob, and entries. */
typedef struct {
    uint32_t offset;
    uint32_t count;
} ql_blob_table_t;

typedef struct {
    uint32_t magic;
    uint16_t version;
    uint16_t header_bytes; /* sizeof(ql_blob_header_t) */
    uint32_t size_bytes;   /* of the whole blob, a multiple of 4 */
    uint32_t crc32;        /* of bytes [16, size_bytes) */
    uint32_t features;     /* QL_FEATURE_ bits */
    uint16_t depth;        /* levels of the BVH below the root, 0..64 */
    uint16_t root_meta;    /* 0..2 split axis, 3 + n a leaf of n */
    uint16_t root_link;    /* first pair, or first triangle of the leaf */
    int16_t radiance_exp;  /* one radiance unit is 2^this, -64..64 */
    int16_t exposure_q8;   /* stops, s7.8: picture = radiance * 2^this */
    uint16_t image_width;  /* pixels, 1..16384 */
    uint16_t image_height;
    int16_t unit_exp;       /* one grid unit is unit_m * 2^unit_exp of a */
    uint32_t unit_m;        /*   scene unit; for people, not the core */
    ql_blob_table_t camera; /* count is 1 */
    ql_blob_table_t vertices;
    ql_blob_table_t triangles;
    ql_blob_table_t pairs; /* BVH: two children each */
    ql_blob_table_t materials;
    ql_blob_table_t lights;
} ql_blob_header_t;

/* A pinhole camera: origin and direction are affine in the picture's plane.
 * A point (x, y) of the plane, y up, |y| <= 1 and |x| <= width/height, has
 *     origin    p + x pr + y pu    grid units, s31.32 as {low, high} words
 *     direction d + x dr + y du    any length, s1.30; each sum below 2^30
 * For an eye inside the scene p is the eye and pr, pu are 0; for one outside,
 * p lies on the plane through the scene's nearest corner. */
typedef struct {
    uint32_t p[3][2];
    uint32_t pr[3][2];
    uint32_t pu[3][2];
    uint32_t d[3];
    uint32_t dr[3];
    uint32_t du[3];
} ql_blob_camera_t;

typedef struct {
    uint16_t xyz[3]; /* grid units, 8..32759 */
} ql_blob_vertex_t;

/* Counter-clockwise from the front. material holds its index in bits 0..13 and
 * the page of all three vertices in 14..15: vertex i is entry
 * page * 65536 + vertex[i]. Pages above 0 need QL_FEATURE_PAGES. inv_n holds
 * 1/|e1 x e2| = (inv_n & ~31) 2^-32 2^(1 - (inv_n & 31)), its top bit set. */
typedef struct {
    uint16_t vertex[3];
    uint16_t material; /* index 0..16383, page << 14 */
    uint32_t inv_n;
} ql_blob_tri_t;

/* One child of a 16-bit node: the box centre +- half, inclusive. meta and
 * link as in the header. Pair j is children 2j and 2j + 1; the first lies on
 * the lower side of the parent's split axis. Pairs lie in the order of a walk
 * from the root, the first child's pairs before the second's. */
typedef struct {
    uint16_t centre[3]; /* grid units, 0..32767 */
    uint16_t half[3];   /* grid units, 0..16384 */
    uint16_t link;
    uint16_t meta; /* 0..2 split axis, 3 + n a leaf of n, n 1..13 */
} ql_blob_node16_t;

/* A pair of 8-bit nodes on the parent's power-of-two grid: box of child i is
 * base + (centre[i] << shift) +- (half[i] << shift), inclusive. */
typedef struct {
    uint16_t base[3]; /* grid units, 0..32767 */
    uint8_t shift;    /* 0..8 */
    uint8_t meta;     /* child 0 low nibble, 1 high: as above */
    uint8_t centre[2][3];
    uint8_t half[2][3];
    uint16_t link[2];
} ql_blob_pair8_t;

/* Diffuse reflectance and emitted radiance, linear RGB. */
typedef struct {
    uint32_t albedo[3];   /* Kd, u1.31, 0..2^31 (exactly 1) */
    uint32_t emission[3]; /* Ke, u0.32 radiance units; 0: not a light */
} ql_blob_material_t;

/* An emitting triangle. Light i is chosen for u0.32 numbers in
 * [cum[i], cum[i+1]); past the last the bound is 2^32. */
typedef struct {
    uint32_t cum;       /* u0.32; strictly increasing, the first 0 */
    uint32_t weight_m;  /* 1/(2 pi P) = weight_m * 2^weight_exp, */
    int16_t weight_exp; /*   P the chance above; top bit of _m set */
    uint16_t triangle;
} ql_blob_light_t;

QL_STATIC_ASSERT(sizeof(ql_blob_header_t) == 88, ql_blob_header_size);
QL_STATIC_ASSERT(sizeof(ql_blob_camera_t) == 108, ql_blob_camera_size);
QL_STATIC_ASSERT(sizeof(ql_blob_vertex_t) == 6, ql_blob_vertex_size);
QL_STATIC_ASSERT(sizeof(ql_blob_tri_t) == 12, ql_blob_tri_size);
QL_STATIC_ASSERT(sizeof(ql_blob_node16_t) == 16, ql_blob_node16_size);
QL_STATIC_ASSERT(sizeof(ql_blob_pair8_t) == 24, ql_blob_pair8_size);
QL_STATIC_ASSERT(sizeof(ql_blob_material_t) == 24, ql_blob_material_size);
QL_STATIC_ASSERT(sizeof(ql_blob_light_t) == 12, ql_blob_light_size);

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
} ql_scene_t;

/* Check a scene blob and open a read-only view of it, in place.
 *
 *   scene   -      out: the view; all zero if this fails
 *   blob    -      start of the blob, 4-byte aligned; flash is fine
 *   size    bytes  bytes readable at blob
 *   return  QL_OK, or the first reason found:
 *           QL_ERR_ALIGN      blob is not 4-byte aligned
 *           QL_ERR_MAGIC      not a qlux blob
 *           QL_ERR_VERSION    another version of the format (see BLOB.md)
 *           QL_ERR_TRUNCATED  the blob says it is longer than size
 *           QL_ERR_CHECKSUM   contents changed since qlux-scene wrote them
 *           QL_ERR_FEATURE    needs a feature this build lacks, see
 *                             ql_blob_missing()
 *           QL_ERR_RANGE      an offset, index, count or value is outside its
 *                             table or limit
 *           QL_ERR_CAPACITY   deeper than QL_CFG_BVH_STACK
 *
 * Every offset, index, count and enum is checked here, once. Code in trace/ and
 * render/ relies on that and checks nothing again.
 *
 * Memory: copies nothing; the blob must stay mapped and unchanged while in use.
 * Cost:   one pass over the blob.
 */
QL_MUST_CHECK ql_status_t ql_blob_open(
        ql_scene_t *scene, const void *blob, size_t size);

/* Name the first feature that a blob needs and this build lacks.
 *
 *   blob    -      as for ql_blob_open(), which returned QL_ERR_FEATURE
 *   return  the feature's name, "unknown" for a bit without one; "" if none
 */
const char *ql_blob_missing(const void *blob);

#endif
