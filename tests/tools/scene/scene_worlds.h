/* scene_worlds.h - random numbers and small worlds that tests compile */
/* SPDX-License-Identifier: MIT */

#ifndef SCENE_WORLDS_H
#define SCENE_WORLDS_H

#include <stdlib.h>
#include <string.h>

#include "blob/ql_blob_open.h"
#include "scene/blob/write_blob.h"
#include "scene/build/compile.h"
#include "scene/mesh/gain.h"
#include "scene/mesh/smooth.h"
#include "support/ql_test.h"

/* SplitMix64. */
static inline uint64_t next(void)
{
    static uint64_t state = 1;
    uint64_t z = (state += 0x9e3779b97f4a7c15u);

    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

/* Uniform in [0, 1). */
static inline double uniform(void)
{
    return (double)(next() >> 11) * 0x1p-53;
}

/* A camera before the unit cube, one material, nothing else. */
static inline void open_world(world_t *world)
{
    static const world_camera_t camera = {
            {0.5, 0.5, 3}, {0.5, 0.5, 0}, {0, 1, 0}, 40};

    memset(world, 0, sizeof *world);
    world->path = "test";
    world->camera = camera;
    world->width = world->height = 64;
    (void)world_add_material(world, "m", 1);
}

/* A triangle; normals unless NULL. */
static inline void add_triangle(
        world_t *world, const double corners[3][3], const double normals[3][3])
{
    world_face_t face = {{0, 0, 0}, 0, {0, 0, 0}, 0, false};

    for (int i = 0; i < 3; i++) {
        face.vertex[i] = (uint32_t)world_add_vertex(world, corners[i]);
        if (normals != NULL) {
            face.normal[i] = (uint32_t)world_add_normal(world, normals[i]) + 1;
        }
    }
    world_add_face(world, &face);
}

/* As compile_scene(), with the grid and the tree for who looks at them. */
static inline void build_with(
        model_t *model, grid_t *grid, const world_t *world, bvh_t *bvh)
{
    static const bvh_cost_t cost = {100, 80};

    grid_round(grid, world);
    (void)gain_faces(grid, world);
    smooth_corners(grid, world);
    bvh_build(bvh, grid, 4, &cost, true);
    compile_model(model, world, grid, bvh, NULL, 16);
}

static inline void build(model_t *model, grid_t *grid, const world_t *world)
{
    bvh_t bvh;

    build_with(model, grid, world, &bvh);
    bvh_free(&bvh);
}

/* The core accepts the blob. */
static inline void check_opens(const model_t *model)
{
    size_t size;
    uint8_t *blob = write_blob(model, &size);
    ql_scene_t scene;
    const ql_status_t status = ql_blob_open(&scene, blob, size);

    CHECK(status == QL_OK, "ql_blob_open: %s", ql_status_text(status));
    free(blob);
}

static inline void close_all(model_t *model, grid_t *grid, world_t *world)
{
    model_free(model);
    grid_free(grid);
    world_free(world);
}

#endif
