/* nodes.h - boxes of the BVH as the blob stores them */
/* SPDX-License-Identifier: MIT */

#ifndef NODES_H
#define NODES_H

#include "scene/mesh/bvh.h"
#include "scene/ql_blob.h"

/* One child with an absolute box: the exact one, or a grid unit more on one
 * side where its length is odd. */
void nodes_encode16(ql_blob_node16_t *out, const bvh_node_t *node);

/* Two children on a power-of-two grid of their own: the finest that reaches,
 * then the tightest boxes on it. Each contains the exact one. */
void nodes_encode8(ql_blob_pair8_t *out, const bvh_node_t pair[2]);

#endif
