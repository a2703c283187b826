/* world.h - a scene as its files describe it: reals, any size */
/* SPDX-License-Identifier: MIT */

#ifndef WORLD_H
#define WORLD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct {
    char *name;       /* for messages */
    bool defined;     /* by a library, not only named by a mesh */
    unsigned kind;    /* a ql_gloss_kind_t; 0: diffuse only */
    double kd[3];     /* diffuse reflectance, 0..1 */
    double ke[3];     /* emitted radiance, >= 0 */
    double ks[3];     /* specular reflectance, >= 0; unless glass */
    double ns;        /* exponent of the Phong lobe, 0..65535 */
    double ni;        /* index of refraction of glass, 1/16..64 */
    double filter[3]; /* Tf, what glass lets through, 0..1 */
} world_material_t;

/* Counter-clockwise from the front. */
typedef struct {
    uint32_t vertex[3];
    uint32_t material;
    uint32_t normal[3]; /* 1 + index of each corner's; 0: none */
    uint32_t group;     /* that a file says is smooth, by s; 0: none */
    bool goes_on; /* the triangle before is of the same face in the file */
} world_face_t;

/* Its faces go to the first one of the next mesh. */
typedef struct {
    char *path;
    size_t first_face;
    bool has_groups; /* its file says what is smooth, by s */
} world_mesh_t;

typedef struct {
    double centre[3];
    double radius; /* above 0 */
    uint32_t material;
} world_sphere_t;

/* Light from all around; none if the colour is black and there is no map. */
typedef struct {
    double colour[3]; /* radiance, >= 0; without a map */
    float *map;       /* RGB rows from the top, >= 0; or NULL */
    uint32_t width, height;
    double rotate; /* degrees about +y */
} world_sky_t;

/* Weights for the firmware's own use, x fastest. */
typedef struct {
    unsigned dims;
    uint16_t count[3];
    double *weights;
} world_table_t;

typedef struct {
    double eye[3];
    double look[3];
    double up[3];
    double fov; /* vertical, degrees, 0 < fov < 180 */
} world_camera_t;

typedef struct {
    double radius; /* 0: a pinhole */
    double focus;  /* distance of the plane in focus, above 0 */
} world_lens_t;

typedef struct {
    const char *path;     /* of the .scene, for messages */
    unsigned camera_line; /* its line there */
    unsigned lens_line;
    double (*vertices)[3];
    double (*normals)[3]; /* any length; 0 stands for none */
    world_face_t *faces;
    world_mesh_t *meshes;
    world_material_t *materials;
    world_sphere_t *spheres;
    world_table_t *tables;
    size_t vertex_count, vertex_capacity;
    size_t normal_count, normal_capacity;
    size_t face_count, face_capacity;
    size_t mesh_count, mesh_capacity;
    size_t material_count, material_capacity;
    size_t sphere_count, sphere_capacity;
    size_t table_count, table_capacity;
    world_camera_t camera;
    world_lens_t lens;
    world_sky_t sky;
    int64_t width, height; /* pixels */
    double exposure;       /* stops */
    double smooth; /* degrees between faces that are, where files say nothing;
                    * 0: none are */
    size_t own_count; /* the first materials: those the .scene defines, which
                       * stand for all of their names */
    bool two_sided;   /* lights shine to both sides */
    bool is_up_z;     /* its files said so; here y is up */
    bool quiet;       /* readers say nothing of what they leave out */
} world_t;

/* Add one; return its index. */
size_t world_add_vertex(world_t *world, const double position[3]);
size_t world_add_material(world_t *world, const char *name, size_t name_length);
size_t world_add_normal(world_t *world, const double normal[3]);
void world_add_mesh(world_t *world, const char *path);
void world_add_face(world_t *world, const world_face_t *face);
world_sphere_t *world_add_sphere(world_t *world); /* all zero; until the next */
world_table_t *world_add_table(world_t *world);

/* Turn all of a world, camera included, so that z, which was up, becomes y:
 * x, y, z become x, z, -y. */
void world_turn_up(world_t *world);

/* Are two corners of a face in one place? */
bool world_is_flat(const world_t *world, const world_face_t *face);

/* Does a material shine? */
bool world_emits(const world_t *world, uint32_t material);

/* Free everything; the world is empty again. */
void world_free(world_t *world);

#endif
