/* world.c - a scene as its files describe it: reals, any size */
/* SPDX-License-Identifier: MIT */

#include "scene/world/world.h"

#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"
#include "lib/program/alloc.h"

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

size_t world_add_normal(world_t *world, const double normal[3])
{
    if (world->normal_count >= UINT32_MAX - 1) {
        cli_fail(CLI_INPUT, "more than 2^32 normals");
    }
    world->normals = alloc_grow(world->normals, world->normal_count,
            &world->normal_capacity, sizeof *world->normals);
    memcpy(world->normals[world->normal_count], normal, sizeof *world->normals);
    return world->normal_count++;
}

size_t world_add_material(world_t *world, const char *name, size_t name_length)
{
    world_material_t *material;

    world->materials = alloc_grow(world->materials, world->material_count,
            &world->material_capacity, sizeof *world->materials);
    material = world->materials + world->material_count;
    memset(material, 0, sizeof *material);
    material->name = alloc_text(name, name_length);
    material->ni = 1;
    for (int k = 0; k < 3; k++) {
        material->kd[k] = 0.5; /* grey, until a Kd says otherwise */
        material->filter[k] = 1;
    }
    return world->material_count++;
}

void world_add_mesh(world_t *world, const char *path)
{
    world_mesh_t *mesh;

    world->meshes = alloc_grow(world->meshes, world->mesh_count,
            &world->mesh_capacity, sizeof *world->meshes);
    mesh = world->meshes + world->mesh_count++;
    mesh->path = alloc_text(path, strlen(path));
    mesh->first_face = world->face_count;
    mesh->has_groups = false;
}

void world_add_face(world_t *world, const world_face_t *face)
{
    world->faces = alloc_grow(world->faces, world->face_count,
            &world->face_capacity, sizeof *world->faces);
    world->faces[world->face_count++] = *face;
}

world_sphere_t *world_add_sphere(world_t *world)
{
    world->spheres = alloc_grow(world->spheres, world->sphere_count,
            &world->sphere_capacity, sizeof *world->spheres);
    memset(world->spheres + world->sphere_count, 0, sizeof *world->spheres);
    return world->spheres + world->sphere_count++;
}

world_table_t *world_add_table(world_t *world)
{
    world->tables = alloc_grow(world->tables, world->table_count,
            &world->table_capacity, sizeof *world->tables);
    memset(world->tables + world->table_count, 0, sizeof *world->tables);
    return world->tables + world->table_count++;
}

static void turn_up(double p[3])
{
    const double y = p[1];

    p[1] = p[2];
    p[2] = 0 - y; /* 0 stays 0 */
}

void world_turn_up(world_t *world)
{
    world->is_up_z = true;
    for (size_t v = 0; v < world->vertex_count; v++) {
        turn_up(world->vertices[v]);
    }
    for (size_t n = 0; n < world->normal_count; n++) {
        turn_up(world->normals[n]);
    }
    for (size_t i = 0; i < world->sphere_count; i++) {
        turn_up(world->spheres[i].centre);
    }
    turn_up(world->camera.eye);
    turn_up(world->camera.look);
    turn_up(world->camera.up);
}

static bool is_same_point(const world_t *world, uint32_t a, uint32_t b)
{
    const double *p = world->vertices[a], *q = world->vertices[b];

    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
}

bool world_is_flat(const world_t *world, const world_face_t *face)
{
    const uint32_t *v = face->vertex;

    return is_same_point(world, v[0], v[1]) ||
           is_same_point(world, v[1], v[2]) || is_same_point(world, v[2], v[0]);
}

bool world_emits(const world_t *world, uint32_t material)
{
    const double *ke = world->materials[material].ke;

    return ke[0] > 0 || ke[1] > 0 || ke[2] > 0;
}

void world_free(world_t *world)
{
    for (size_t i = 0; i < world->table_count; i++) {
        free(world->tables[i].weights);
    }
    for (size_t i = 0; i < world->mesh_count; i++) {
        free(world->meshes[i].path);
    }
    for (size_t i = 0; i < world->material_count; i++) {
        free(world->materials[i].name);
    }
    free(world->sky.map);
    free(world->spheres);
    free(world->tables);
    free(world->vertices);
    free(world->normals);
    free(world->faces);
    free(world->materials);
    free(world->meshes);
    memset(world, 0, sizeof *world);
}
