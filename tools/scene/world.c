/* world.c - a scene as its files describe it: reals, any size */
/* SPDX-License-Identifier: MIT */

#include "world.h"

#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "alloc.h"

size_t world_add_vertex(world_t *world, const double position[3])
{
    if (world->vertex_count >= UINT32_MAX) {
        cli_fail(CLI_INPUT, "more than 2^32 vertices");
    }
    world->vertices = alloc_grow(world->vertices, world->vertex_count,
            &world->vertex_capacity, sizeof *world->vertices);
    memcpy(world->vertices[world->vertex_count], position,
            sizeof *world->vertices);
    return world->vertex_count++;
}

size_t world_add_material(world_t *world, const char *name, size_t name_length)
{
    world_material_t *material;

    world->materials = alloc_grow(world->materials, world->material_count,
            &world->material_capacity, sizeof *world->materials);
    material = world->materials + world->material_count;
    material->name = alloc_text(name, name_length);
    for (int k = 0; k < 3; k++) {
        material->kd[k] = 0.5; /* grey, until a Kd says otherwise */
        material->ke[k] = 0;
    }
    return world->material_count++;
}

void world_add_face(world_t *world, const world_face_t *face)
{
    world->faces = alloc_grow(world->faces, world->face_count,
            &world->face_capacity, sizeof *world->faces);
    world->faces[world->face_count++] = *face;
}

void world_free(world_t *world)
{
    for (size_t i = 0; i < world->material_count; i++) {
        free(world->materials[i].name);
    }
    free(world->vertices);
    free(world->faces);
    free(world->materials);
    memset(world, 0, sizeof *world);
}
