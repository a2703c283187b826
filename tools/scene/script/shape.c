/* shape.c - the faces of boxes and quadrilaterals */
/* SPDX-License-Identifier: MIT */

#include "scene/script/shape.h"

#include "scene/fill/fill.h"

/* A mesh that is flat whatever `smooth` says. */
static void begin_mesh(world_t *world, const char *name)
{
    world_add_mesh(world, name);
    world->meshes[world->mesh_count - 1].has_groups = true;
}

/* Add both triangles of a quadrilateral; returns the first. */
static size_t add_fan(
        world_t *world, const size_t corners[4], uint32_t material)
{
    const size_t first = world->face_count;

    for (int i = 1; i < 3; i++) {
        world_face_t face = {.material = material, .goes_on = i == 2};

        face.vertex[0] = (uint32_t)corners[0];
        face.vertex[1] = (uint32_t)corners[i];
        face.vertex[2] = (uint32_t)corners[i + 1];
        world_add_face(world, &face);
    }
    return first;
}

void shape_box(world_t *world, const double low[3], const double high[3],
        shape_front_t front, uint32_t material, const char *name)
{
    /* corner i is high along axis k where bit k is set */
    static const unsigned char sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5},
            {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    size_t corners[8];

    begin_mesh(world, name);
    for (int i = 0; i < 8; i++) {
        double p[3];

        for (int k = 0; k < 3; k++) {
            p[k] = i >> k & 1 ? high[k] : low[k];
        }
        corners[i] = world_add_vertex(world, p);
    }
    for (int s = 0; s < 6; s++) {
        const bool inside = front == SHAPE_INSIDE;
        const size_t side[4] = {corners[sides[s][0]],
                corners[sides[s][inside ? 3 : 1]], corners[sides[s][2]],
                corners[sides[s][inside ? 1 : 3]]};

        (void)add_fan(world, side, material);
    }
}

bool shape_quad(world_t *world, double (*corners)[3], uint32_t material,
        const char *name)
{
    fill_faults_t faults;
    size_t placed[4], first, count;

    begin_mesh(world, name);
    for (int i = 0; i < 4; i++) {
        placed[i] = world_add_vertex(world, corners[i]);
    }
    first = add_fan(world, placed, material);
    count = fill_face(&faults, world, world->faces + first, 2);
    world->face_count = first + count;
    return count > 0 && !faults.crosses;
}
