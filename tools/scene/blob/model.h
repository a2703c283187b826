/* model.h - everything a blob says, in the numbers of this machine */
/* SPDX-License-Identifier: MIT */

/* The structs are those of ql_blob.h, but every field holds its value in the
 * host's byte order: write_blob() and read_blob() convert. */

#ifndef MODEL_H
#define MODEL_H

#include "scene/mesh/build_bvh.h"
#include "scene/mesh/quantise.h"
#include "scene/ql_blob.h"
#include "scene/world.h"

typedef struct {
    ql_blob_header_t header; /* table offsets, sizes and CRC unused: */
    uint32_t vertex_count;   /*   these say how many there are */
    uint32_t triangle_count;
    uint32_t pair_count;
    uint32_t material_count;
    uint32_t light_count;
    ql_blob_camera_t camera;
    ql_blob_vertex_t *vertices;
    ql_blob_tri_t *triangles;
    ql_blob_node16_t *nodes16; /* two a pair; NULL with 8-bit nodes */
    ql_blob_pair8_t *pairs8;   /* NULL with 16-bit nodes */
    ql_blob_material_t *materials;
    ql_blob_light_t *lights;
    /* the tables of features: name and name_count of each, NULL if not there */
#define MODEL_MORE(name, type, bits)                                           \
    type *name;                                                                \
    uint32_t name##_count;
    QL_BLOB_MORE_LIST(MODEL_MORE)
#undef MODEL_MORE
} model_t;

#define MODEL_LEAF8_MAX 12 /* 3 + n must fit the nibble of an 8-bit node */

/* Bits of a node's box: 8 or 16. */
unsigned model_node_bits(const model_t *model);

/* Compile a scene.
 *
 *   model      -        out; model_free() it
 *   world      -        the scene
 *   grid       -        the same, on its grid
 *   bvh        -        tree over the grid
 *   node_bits  8 or 16
 *
 * Fails: exit 2 for a camera too far away, a lens too wide, too many materials,
 *        lights or table words, or a sky too dim beside its lights.
 */
void model_build(model_t *model, const world_t *world, const grid_t *grid,
        const bvh_t *bvh, unsigned node_bits);

void model_free(model_t *model);

#endif
