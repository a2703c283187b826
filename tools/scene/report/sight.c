/* sight.c - a camera that sees nothing, or is inside an object */
/* SPDX-License-Identifier: MIT */

#include "scene/report/sight.h"

#include <stdlib.h>

#include "lib/math/soft.h"
#include "lib/program/cli.h"
#include "scene/ql_camera.h"
#include "scene/report/probe.h"
#include "trace/ql_bvh.h"

enum { COARSE = 32, DENSE = 256 }; /* pixels of the longer side */

/* ---- does the picture show anything? ---- */

/* Does the ray through the middle of any pixel meet something? */
static bool is_seen(const ql_scene_t *scene, const world_t *world, int side)
{
    static const ql_uniform2_t middle = {0x80000000u, 0x80000000u};
    const int64_t w = world->width, h = world->height, most = w > h ? w : h;
    const uint16_t width = (uint16_t)((w * side + most - 1) / most);
    const uint16_t height = (uint16_t)((h * side + most - 1) / most);
    ql_camera_pixel_t pixel;
    ql_camera_t camera;
    ql_ray_t ray;
    ql_hit_t hit;

    if (!ql_camera_init(&camera, scene, width, height)) {
        return true; /* whoever renders it is told why not */
    }
    for (uint32_t i = 0; i < (uint32_t)width * height; i++) {
        ql_camera_pixel(
                &pixel, &camera, (uint16_t)(i % width), (uint16_t)(i / width));
        if (ql_camera_ray(&pixel, middle, middle, &ray) &&
                ql_bvh_closest_hit(scene, &ray, &hit)) {
            return true;
        }
    }
    return false;
}

/* A coordinate of the scene, as its .scene has it, at the middle of its box. */
static double find_middle(const world_t *world, const grid_t *grid, int axis)
{
    const int k = world->is_up_z && axis > 0 ? 3 - axis : axis;
    const soft_t middle = soft_int(grid->low[k] + grid->high[k], -1);
    const soft_t cells = soft_sub(middle, soft_int(GRID_LOW, 0));
    const double x =
            soft_double(soft_add(grid->origin[k], soft_mul(cells, grid->unit)));

    return world->is_up_z && axis == 1 ? -x : x;
}

static void report_nothing(const world_t *world, const grid_t *grid)
{
    int most = 0;

    for (int k = 0; k < 3; k++) {
        const int side = grid->high[k] - grid->low[k];

        most = side > most ? side : most;
    }
    cli_warn("%s:%u: the camera sees nothing: the scene is around %.4g %.4g "
             "%.4g and %.4g wide",
            world->path, world->camera_line, find_middle(world, grid, 0),
            find_middle(world, grid, 1), find_middle(world, grid, 2),
            most * soft_double(grid->unit));
}

/* ---- is it inside something? ---- */

/* What is seen all around. */
typedef struct {
    unsigned rays, fronts, backs;
    uint16_t low[3], high[3]; /* of all faces whose backs were met */
    unsigned *materials;      /* how often each was */
} around_t;

static void count(around_t *around, const grid_t *grid, const grid_face_t *face,
        bool front)
{
    uint16_t low[3], high[3];

    grid_box(grid, face, low, high);
    for (int k = 0; k < 3 && !front; k++) {
        around->low[k] = low[k] < around->low[k] ? low[k] : around->low[k];
        around->high[k] = high[k] > around->high[k] ? high[k] : around->high[k];
    }
    around->fronts += front;
    around->backs += !front;
    around->materials[face->material]++;
}

/* Look to 7 by 7 places of each side of a cube. */
static void look_around(around_t *around, const ql_scene_t *scene,
        const grid_t *grid, const bvh_t *bvh, const double eye[3])
{
    enum { STEPS = 7 };

    for (int i = 0; i < 6 * STEPS * STEPS; i++) {
        const int axis = i / (2 * STEPS * STEPS);
        const double side = i / (STEPS * STEPS) % 2 * 2 - 1;
        double direction[3];
        probe_t probe;

        direction[axis] = side;
        direction[(axis + 1) % 3] = (2 * (i % STEPS) + 1) / (double)STEPS - 1;
        direction[(axis + 2) % 3] =
                (2 * (i / STEPS % STEPS) + 1) / (double)STEPS - 1;
        around->rays++;
        if (probe_cast(&probe, scene, eye, direction)) {
            count(around, grid, grid->faces + bvh->order[probe.index],
                    probe.front);
        }
    }
}

/* Does it look as a room does: as large as all of the scene? */
static bool is_room(const around_t *around, const grid_t *grid)
{
    bool large = true;

    for (int k = 0; k < 3; k++) {
        const int side = around->high[k] - around->low[k];

        large = large && 10 * side >= 9 * (grid->high[k] - grid->low[k]);
    }
    return large;
}

static void report_inside(const world_t *world, const around_t *around)
{
    size_t most = 0;

    for (size_t m = 1; m < world->material_count; m++) {
        most = around->materials[m] > around->materials[most] ? m : most;
    }
    if (world->materials[most].kind != QL_GLOSS_GLASS) {
        cli_warn("%s:%u: the camera is inside an object of material '%s' and "
                 "sees the backs of its faces",
                world->path, world->camera_line, world->materials[most].name);
    }
}

void sight_report(const ql_scene_t *scene, const world_t *world,
        const grid_t *grid, const bvh_t *bvh)
{
    around_t around = {.low = {UINT16_MAX, UINT16_MAX, UINT16_MAX}};
    double eye[3];

    if (grid->face_count == 0) {
        return;
    }
    if (world->sky.map == NULL && !is_seen(scene, world, COARSE) &&
            !is_seen(scene, world, DENSE)) {
        report_nothing(world, grid);
    }
    if (!probe_eye(eye, world, grid)) {
        return;
    }
    around.materials =
            cli_alloc(world->material_count, sizeof *around.materials);
    look_around(&around, scene, grid, bvh, eye);
    if (20 * (around.fronts + around.backs) >= 19 * around.rays &&
            around.backs > 3 * around.fronts && !is_room(&around, grid)) {
        report_inside(world, &around);
    }
    free(around.materials);
}
