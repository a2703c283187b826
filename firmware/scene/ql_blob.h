/* ql_blob.h - the scene blob as it lies in memory */
/* SPDX-License-Identifier: MIT */

/* The layout is specified in BLOB.md. Every field is little-endian: read it
 * through QL_LE16 or QL_LE32. Fields are naturally aligned to at most 4 bytes,
 * so the structs below have no padding on any supported compiler. */

#ifndef QL_BLOB_H
#define QL_BLOB_H

#include "base/ql_base.h"

#define QL_BLOB_MAGIC    0x58554c51u /* the bytes "QLUX" */
#define QL_BLOB_VERSION  2u
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
#define QL_LIGHT_SKY    65535u /* "triangle" of the light that is the sky */
#define QL_CONTACT_EDGE 4u     /* grid units from an edge: its inside */

/* Features: what a scene needs of a build. Bit, name. */
#define QL_FEATURE_LIST(X)                                                     \
    X(QL_FEATURE_NODE16, 0, "node16")                                          \
    X(QL_FEATURE_NODE8, 1, "node8")                                            \
    X(QL_FEATURE_LIGHTS, 2, "lights")                                          \
    X(QL_FEATURE_TWO_SIDED, 3, "two-sided")                                    \
    X(QL_FEATURE_PAGES, 4, "pages")                                            \
    X(QL_FEATURE_SMOOTH, 5, "smooth")                                          \
    X(QL_FEATURE_PHONG, 6, "phong")                                            \
    X(QL_FEATURE_MIRROR, 7, "mirror")                                          \
    X(QL_FEATURE_GLASS, 8, "glass")                                            \
    X(QL_FEATURE_SPHERES, 9, "spheres")                                        \
    X(QL_FEATURE_SKY, 10, "sky")                                               \
    X(QL_FEATURE_SKY_MAP, 11, "sky-map")                                       \
    X(QL_FEATURE_TABLES, 12, "tables")                                         \
    X(QL_FEATURE_LENS, 13, "lens")                                             \
    X(QL_FEATURE_CONTACT, 14, "contact")                                       \
    X(QL_FEATURE_ORDER, 15, "order")                                           \
    X(QL_FEATURE_HULL, 16, "hull")

/* They are no enum, because an int may have 16 bits. */
#define QL_FEATURE_NODE16    ((uint32_t)1 << 0)
#define QL_FEATURE_NODE8     ((uint32_t)1 << 1)
#define QL_FEATURE_LIGHTS    ((uint32_t)1 << 2)
#define QL_FEATURE_TWO_SIDED ((uint32_t)1 << 3)
#define QL_FEATURE_PAGES     ((uint32_t)1 << 4)
#define QL_FEATURE_SMOOTH    ((uint32_t)1 << 5)
#define QL_FEATURE_PHONG     ((uint32_t)1 << 6)
#define QL_FEATURE_MIRROR    ((uint32_t)1 << 7)
#define QL_FEATURE_GLASS     ((uint32_t)1 << 8)
#define QL_FEATURE_SPHERES   ((uint32_t)1 << 9)
#define QL_FEATURE_SKY       ((uint32_t)1 << 10)
#define QL_FEATURE_SKY_MAP   ((uint32_t)1 << 11)
#define QL_FEATURE_TABLES    ((uint32_t)1 << 12)
#define QL_FEATURE_LENS      ((uint32_t)1 << 13)
#define QL_FEATURE_CONTACT   ((uint32_t)1 << 14)
#define QL_FEATURE_ORDER     ((uint32_t)1 << 15)
#define QL_FEATURE_HULL      ((uint32_t)1 << 16)

/* The ways of finding light that qlux-scene chooses from, in the order of
 * trials. A trial is 16 log2 of variance times instructions over the best's. */
#define QL_TRIAL_MOST 254u /* that or more */
#define QL_TRIAL_NONE 255u /* not tried */
#define QL_BLOB_TRIALS(TRIAL)                                                  \
    TRIAL(QL_DIRECT_AREA, QL_LIGHTS_POWER)                                     \
    TRIAL(QL_DIRECT_AREA, QL_LIGHTS_ALL)                                       \
    TRIAL(QL_DIRECT_SOLID_ANGLE, QL_LIGHTS_POWER)                              \
    TRIAL(QL_DIRECT_SOLID_ANGLE, QL_LIGHTS_ALL)                                \
    TRIAL(QL_DIRECT_MIS, QL_LIGHTS_POWER)                                      \
    TRIAL(QL_DIRECT_MIS, QL_LIGHTS_ALL)

/* Where one table lies: bytes from the start of the blob, and entries. */
typedef struct {
    uint32_t offset;
    uint32_t count;
} ql_blob_table_t;

typedef struct {
    uint32_t magic;
    uint16_t version;
    uint16_t header_bytes; /* of this and the optional tables below */
    uint32_t size_bytes;   /* of the whole blob, a multiple of 4 */
    uint32_t crc32;        /* of bytes [16, size_bytes) */
    uint32_t features;     /* QL_FEATURE_ bits */
    uint16_t depth;        /* levels of the BVH below the root, 0..64 */
    uint16_t root_meta;    /* 0..2 split axis, 3 + n a leaf of n */
    uint16_t root_link;    /* first pair, or first triangle of the leaf */
    int16_t radiance_exp;  /* one radiance unit is 2^this, -64..64 */
    int16_t exposure_q8;   /* stops, s7.8: picture = radiance * 2^this */
    uint8_t auto_direct;   /* ql_direct_t: what QL_DIRECT_AUTO is here */
    uint8_t auto_lights;   /* ql_light_choice_t: what QL_LIGHTS_AUTO is */
    uint16_t image_width;  /* pixels, 1..16384 */
    uint16_t image_height;
    /* for people, not the core */
    int16_t unit_exp;       /* one grid unit is unit_m * 2^unit_exp of a */
    uint8_t trials[6];      /* QL_BLOB_TRIALS */
    uint32_t unit_m;        /* scene unit */
    ql_blob_table_t camera; /* count is 1 */
    ql_blob_table_t vertices;
    ql_blob_table_t triangles;
    ql_blob_table_t pairs; /* BVH: two children each */
    ql_blob_table_t materials;
    ql_blob_table_t lights;
} ql_blob_header_t;

/* Optional tables follow the header in this order, each if the scene needs any
 * of its features: name, entry, features. header_bytes counts them. */
#define QL_BLOB_OPTIONAL_LIST(X)                                               \
    X(normals, ql_blob_normal_t, QL_FEATURE_SMOOTH)                            \
    X(gloss, ql_blob_gloss_t,                                                  \
            QL_FEATURE_PHONG | QL_FEATURE_MIRROR | QL_FEATURE_GLASS)           \
    X(spheres, ql_blob_sphere_t, QL_FEATURE_SPHERES)                           \
    X(sky, ql_blob_sky_t, QL_FEATURE_SKY)                                      \
    X(texels, ql_blob_texel_t, QL_FEATURE_SKY_MAP)                             \
    X(tables, ql_blob_distribution_t, QL_FEATURE_TABLES)                       \
    X(words, uint16_t, QL_FEATURE_TABLES)                                      \
    X(lens, ql_blob_lens_t, QL_FEATURE_LENS)                                   \
    X(contacts, uint16_t, QL_FEATURE_CONTACT)                                  \
    X(ranks, uint16_t, QL_FEATURE_ORDER)                                       \
    X(hull, ql_blob_hull_t, QL_FEATURE_HULL)                                   \
    X(sides, ql_blob_side_t, QL_FEATURE_HULL)

enum { QL_BLOB_OPTIONAL_MAX = 12 }; /* entries of that list */

/* A pinhole camera: origin and direction are affine in the picture's plane.
 * A point (x, y) of the plane, y up, |y| <= 1 and |x| <= width/height, has
 *     origin     at[BASE] + x at[RIGHT] + y at[UP]
 *     direction  towards[BASE] + x towards[RIGHT] + y towards[UP]
 * For an eye inside the scene at[BASE] is the eye and the other two are 0; for
 * one outside it lies on the plane through the scene's nearest corner. */
typedef struct {
    uint32_t at[3][3][2];   /* x, y, z: grid units, s31.32, {low, high} words */
    uint32_t towards[3][3]; /* any length, s1.30; each sum is below 2^30 */
} ql_blob_camera_t;

/* The first index of both. */
enum { QL_CAMERA_BASE, QL_CAMERA_RIGHT, QL_CAMERA_UP, QL_CAMERA_AFFINE };

typedef struct {
    uint16_t xyz[3]; /* grid units, 8..32759 */
} ql_blob_vertex_t;

/* Counter-clockwise from the front. material holds its index in bits 0..13 and
 * the page of all three vertices in 14..15: vertex i is entry
 * page * 65536 + vertex[i]. Pages above 0 need QL_FEATURE_PAGES. inv_n holds
 * 1/|e1 x e2| = (inv_n & ~31) 2^-32 2^(1 - (inv_n & 31)), its top bit set.
 * An inv_n of 0 makes the entry a sphere: vertex[0] is its index in the table
 * of spheres, vertex[1], vertex[2] and the page are 0. */
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

/* Corner normals, one for each vertex; all 0 where a surface is flat. */
typedef struct {
    int16_t xyz[3]; /* s0.15; any length but for 0 */
} ql_blob_normal_t;

typedef enum {
    QL_GLOSS_PHONG = 1, /* Kd, and Ks about the mirror direction */
    QL_GLOSS_MIRROR,    /* Kd, and Ks exactly there */
    QL_GLOSS_GLASS      /* refracts sqrt Tf, reflects by Fresnel; Kd is 0 */
} ql_gloss_kind_t;

/* What material i of the first count ones is beyond diffuse. Those after them
 * are diffuse only. Kd + Ks <= 1 in each channel. */
typedef struct {
    uint32_t specular[3]; /* Ks, of glass sqrt Tf; u1.31, 0..2^31 */
    uint32_t parameter;   /* Phong: Ns, u16.16; glass: Ni, u16.16, in
                                   2^12..2^22 (1/16..64); mirror: 0 */
    uint32_t chance;      /* u1.31: of the specular lobe when one is drawn by
                                   BRDF; 0..2^31; glass: 2^31 */
    uint16_t kind;        /* ql_gloss_kind_t */
    uint16_t zero;
} ql_blob_gloss_t;

/* Lies within [8, 32759] grid units on each axis. */
typedef struct {
    uint32_t centre[3]; /* 1/256 grid units */
    uint32_t radius;    /* 1/256 grid units, 256 or more */
} ql_blob_sphere_t;

/* Light from all around; one entry. The last light stands for it. */
typedef struct {
    uint32_t emission[3]; /* u0.32 radiance units; of a map 0 */
    uint32_t rotate;      /* turn32: azimuth at which the map begins */
    uint16_t width;       /* texels; of a constant sky 0 */
    uint16_t height;
    uint16_t table; /* index of its distribution, width by height */
    uint16_t zero;
} ql_blob_sky_t;

/* A radiance of the map: m << e in u0.32 radiance units, red in bits 0..8,
 * green 9..17, blue 18..26, e in 27..31, at most 23. Row 0 is around +y, column
 * 0 begins at azimuth rotate, counted from +z to +x. */
typedef struct {
    uint32_t rgb9e5;
} ql_blob_texel_t;

/* A tabulated distribution (sample/ql_table.h): its rows lie among words. */
typedef struct {
    uint32_t first;    /* index of its first word */
    uint16_t count[3]; /* cells: nx, ny, nz; 1 beyond dims */
    uint16_t dims;     /* 1..3 */
} ql_blob_distribution_t;

/* A thin lens: for a point (a, b) of the unit disk add a p[0] + b p[1] to the
 * origin and a d[0] + b d[1] to the direction, in the formats of the camera. */
typedef struct {
    uint32_t p[2][3][2];
    uint32_t d[2][3];
} ql_blob_lens_t;

/* What has nothing of the scene behind it; one entry. The triangles from first
 * on are the sides' and lie below the root's second child. */
typedef struct {
    uint16_t box[3][2]; /* x, y, z: grid units, {low, high}, inclusive: what is
                           in it is in front of all sides; low > high: empty */
    uint16_t first;     /* triangle of the first side */
    uint16_t zero;
} ql_blob_hull_t;

/* A side of the hull: triangles of one plane, all that is below a node. Those
 * of the next side have higher numbers. */
typedef struct {
    int16_t n[3];      /* of the plane, inwards, to nearest; the largest
                          component in 2^13..2^14 */
    uint16_t node;     /* 2 j or 2 j + 1: child of pair j */
    uint16_t triangle; /* one of them */
} ql_blob_side_t;

/* An emitter: a triangle or sphere, or the sky. Light i is chosen for u0.32
 * numbers in [cum[i], cum[i+1]); past the last the bound is 2^32. */
typedef struct {
    uint32_t cum;       /* u0.32; strictly increasing, the first 0 */
    uint32_t weight_m;  /* 1/(2 pi P) = weight_m * 2^weight_exp, */
    int16_t weight_exp; /*   P the chance above; top bit of _m set */
    uint16_t triangle;  /* strictly increasing; QL_LIGHT_SKY for the sky */
} ql_blob_light_t;

QL_STATIC_ASSERT(sizeof(ql_blob_header_t) == 96, ql_blob_header_size);
QL_STATIC_ASSERT(sizeof(ql_blob_camera_t) == 108, ql_blob_camera_size);
QL_STATIC_ASSERT(sizeof(ql_blob_vertex_t) == 6, ql_blob_vertex_size);
QL_STATIC_ASSERT(sizeof(ql_blob_tri_t) == 12, ql_blob_tri_size);
QL_STATIC_ASSERT(sizeof(ql_blob_node16_t) == 16, ql_blob_node16_size);
QL_STATIC_ASSERT(sizeof(ql_blob_pair8_t) == 24, ql_blob_pair8_size);
QL_STATIC_ASSERT(sizeof(ql_blob_material_t) == 24, ql_blob_material_size);
QL_STATIC_ASSERT(sizeof(ql_blob_light_t) == 12, ql_blob_light_size);
QL_STATIC_ASSERT(sizeof(ql_blob_normal_t) == 6, ql_blob_normal_size);
QL_STATIC_ASSERT(sizeof(ql_blob_gloss_t) == 24, ql_blob_gloss_size);
QL_STATIC_ASSERT(sizeof(ql_blob_sphere_t) == 16, ql_blob_sphere_size);
QL_STATIC_ASSERT(sizeof(ql_blob_sky_t) == 24, ql_blob_sky_size);
QL_STATIC_ASSERT(sizeof(ql_blob_texel_t) == 4, ql_blob_texel_size);
QL_STATIC_ASSERT(sizeof(ql_blob_distribution_t) == 12, ql_blob_dist_size);
QL_STATIC_ASSERT(sizeof(ql_blob_lens_t) == 72, ql_blob_lens_size);
QL_STATIC_ASSERT(sizeof(ql_blob_hull_t) == 16, ql_blob_hull_size);
QL_STATIC_ASSERT(sizeof(ql_blob_side_t) == 10, ql_blob_side_size);

/* A number as the blob has it: two words of s31.32, or a word of s1.30 with 16
 * fraction bits more. */
QL_INLINE int64_t ql_blob_wide(const uint32_t words[2])
{
    return ql_i64((uint64_t)QL_LE32(words[1]) << 32 | QL_LE32(words[0]));
}

QL_INLINE int64_t ql_blob_narrow(uint32_t word)
{
    return (int64_t)ql_i32(QL_LE32(word)) * 65536;
}

#endif
