/* world.h - a scene as its files describe it: reals, any size */
/* SPDX-License-Identifier: MIT */

#ifndef WORLD_H
#define WORLD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct {
    char *name;   /* for messages */
    double kd[3]; /* diffuse reflectance, 0..1 */
    double ke[3]; /* emitted radiance, >= 0 */
} world_material_t;

/* Counter-clockwise from the front. */
typedef struct {
    uint32_t vertex[3];
    uint32_t material;
} world_face_t;

typedef struct {
    double eye[3];
    double look[3];
    double up[3];
    double fov; /* vertical, degrees, 0 < fov < 180 */
} world_camera_t;

typedef struct {
    const char *path;     /* of the .scene, for messages */
    unsigned camera_line; /* its line there */
    double (*vertices)[3];
    world_face_t *faces;
    world_material_t *materials;
    size_t vertex_count, vertex_capacity;
    size_t face_count, face_capacity;
    size_t material_count, material_capacity;
    world_camera_t camera;
    int64_t width, height; /* pixels */
    double exposure;       /* stops */
    bool two_sided;        /* lights shine to both sides */
} world_t;

/* Add one; return its index. */
size_t world_add_vertex(world_t *world, const double position[3]);
size_t world_add_material(world_t *world, const char *name, size_t name_length);
void world_add_face(world_t *world, const world_face_t *face);

/* Free everything; the world is empty again. */
void world_free(world_t *world);

#endif
