/* item.h - lines of a scene that are surfaces: mesh, box, quad, sphere */
/* SPDX-License-Identifier: MIT */

#ifndef ITEM_H
#define ITEM_H

#include "scene/read/text.h"
#include "scene/script/place.h"
#include "scene/script/shape.h"
#include "scene/world/world.h"

typedef enum { ITEM_MESH, ITEM_BOX, ITEM_QUAD, ITEM_SPHERE } item_kind_t;

/* A surface as its line says. */
typedef struct {
    item_kind_t kind;
    char *path;           /* of a mesh */
    double corners[4][3]; /* of a quad; two of a box; a sphere's centre */
    double radius;        /* of a sphere */
    shape_front_t front;  /* of a box */
    bool is_placed;       /* it has a place of its own */
    place_t place;
    char *material;        /* its name; NULL: none is given */
    unsigned line;         /* in the .scene */
    size_t mesh;           /* its index in the world, */
    place_mark_t from, to; /* and what it has there */
} item_t;

/* In the order of their lines. All zero is none. */
typedef struct {
    item_t *items;
    size_t count, capacity;
} items_t;

/* Take down a line whose key was read. A mesh must be there.
 *
 * Fails: exit 2 with what was expected; exit 3 for a mesh that cannot be read.
 */
void item_read_mesh(items_t *items, text_t *text);
void item_read_box(items_t *items, text_t *text);
void item_read_quad(items_t *items, text_t *text);
void item_read_sphere(items_t *items, text_t *text);

/* Add them all to a world: read the files of meshes, each once, give everything
 * its material, put it in its place.
 *
 *   items  -  in, out
 *   world  -  in, out: the materials of the .scene are there
 *   text   -  the .scene, for messages
 *
 * Fails: exit 2 for what a file or a line has wrong.
 */
void item_build(items_t *items, world_t *world, text_t *text);

void item_free(items_t *items);

#endif
