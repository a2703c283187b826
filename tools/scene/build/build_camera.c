/* build_camera.c - the camera as affine functions of the picture's plane */
/* SPDX-License-Identifier: MIT */

#include "scene/build/build_camera.h"

#include <stdlib.h>

#include "lib/math/soft_vec.h"
#include "lib/program/cli.h"

#define DIRECTION_BITS 30
#define EYE_MAX        ((int64_t)1 << 20) /* grid units, beside the box */
#define REACH_MAX      ((int64_t)1 << 30) /* grid units, of an origin */
#define ASPECT_LEAST   4
#define LENS_MOST      256 /* radius over focus */

/* Forward; right and up already times tan(fov / 2). A lens is two half axes of
 * its rim in grid units, and what each takes from directions; 0 if none. */
typedef struct {
    soft_vec_t forward, right, up;
    soft_vec_t rim[2], tilt[2];
} frame_t;

static frame_t make_frame(const world_t *world, const grid_t *grid)
{
    const world_camera_t *camera = &world->camera;
    const soft_t tangent = soft_tan_half(soft_from(camera->fov));
    const soft_t radius = soft_from(world->lens.radius);
    soft_vec_t view = soft_vec_from(camera->look);
    frame_t frame;

    for (int k = 0; k < 3; k++) {
        view.k[k] = soft_sub(view.k[k], soft_from(camera->eye[k]));
    }
    frame.forward = soft_vec_unit(view);
    frame.right = soft_vec_unit(
            soft_vec_cross(frame.forward, soft_vec_from(camera->up)));
    frame.up = soft_vec_cross(frame.right, frame.forward);
    for (int i = 0; i < 2; i++) {
        const soft_vec_t axis = i == 0 ? frame.right : frame.up;
        const soft_t zero = soft_int(0, 0);

        frame.rim[i] = soft_vec_scale(axis, soft_div(radius, grid->unit));
        frame.tilt[i] = soft_vec_scale(
                axis, radius.m == 0 ? zero
                                    : soft_negate(soft_div(radius,
                                              soft_from(world->lens.focus))));
    }
    frame.up = soft_vec_scale(frame.up, tangent);
    frame.right = soft_vec_scale(frame.right, tangent);
    return frame;
}

/* The widest picture to allow for, as a multiple of its height. */
static int64_t choose_aspect(const world_t *world)
{
    const int64_t aspect = (world->width + world->height - 1) / world->height;

    return aspect > ASPECT_LEAST ? aspect : ASPECT_LEAST;
}

/* Round the directions at 2^bits; true if their sums stay in bounds. */
static bool round_directions(ql_blob_camera_t *camera, ql_blob_lens_t *lens,
        const frame_t *frame, int bits, int64_t aspect)
{
    bool fits = true;

    for (int k = 0; k < 3; k++) {
        const int64_t d = soft_round(frame->forward.k[k], bits);
        const int64_t dr = soft_round(frame->right.k[k], bits);
        const int64_t du = soft_round(frame->up.k[k], bits);
        const int64_t da = soft_round(frame->tilt[0].k[k], bits);
        const int64_t db = soft_round(frame->tilt[1].k[k], bits);
        const int64_t limit = (int64_t)1 << DIRECTION_BITS;

        /* each below 2^46 by the range of bits tried and of tan */
        fits = fits && llabs(dr) < limit && llabs(du) < limit &&
               llabs(d) + aspect * llabs(dr) + llabs(du) + llabs(da) +
                               llabs(db) <
                       limit;
        camera->towards[QL_CAMERA_BASE][k] = (uint32_t)(uint64_t)d;
        camera->towards[QL_CAMERA_RIGHT][k] = (uint32_t)(uint64_t)dr;
        camera->towards[QL_CAMERA_UP][k] = (uint32_t)(uint64_t)du;
        lens->d[0][k] = (uint32_t)(uint64_t)da;
        lens->d[1][k] = (uint32_t)(uint64_t)db;
    }
    return fits;
}

static void put_wide(uint32_t words[2], int64_t value)
{
    words[0] = (uint32_t)((uint64_t)value & 0xffffffffu);
    words[1] = (uint32_t)((uint64_t)value >> 32);
}

/* The eye in grid units. */
static soft_vec_t find_eye(const world_t *world, const grid_t *grid)
{
    soft_vec_t eye;

    for (int k = 0; k < 3; k++) {
        const soft_t x =
                soft_sub(soft_from(world->camera.eye[k]), grid->origin[k]);

        eye.k[k] = soft_add(soft_div(x, grid->unit), soft_int(GRID_LOW, 0));
    }
    return eye;
}

/* Depth of the nearest corner of the box and its margin; 0 if none is before
 * the eye or the scene is empty. */
static soft_t find_depth(const grid_t *grid, soft_vec_t eye, soft_vec_t forward)
{
    soft_t nearest = soft_int(0, 0);

    for (int corner = 0; corner < 8 && grid->face_count > 0; corner++) {
        soft_vec_t way;
        soft_t depth;

        for (int k = 0; k < 3; k++) {
            const int at = corner >> k & 1 ? grid->high[k] + GRID_LOW
                                           : grid->low[k] - GRID_LOW;

            way.k[k] = soft_sub(soft_int(at, 0), eye.k[k]);
        }
        depth = soft_vec_dot(way, forward);
        if (depth.m == 0 || depth.negative) {
            return soft_int(0, 0);
        }
        if (corner == 0 || soft_compare(depth, nearest) < 0) {
            nearest = depth;
        }
    }
    return nearest;
}

#if defined(__GNUC__)
__attribute__((noreturn))
#endif
static void
camera_fail(const world_t *world, const char *expected)
{
    cli_fail(CLI_INPUT, "%s:%u: expected %s", world->path, world->camera_line,
            expected);
}

static soft_t drop_sign(soft_t a)
{
    a.negative = false;
    return a;
}

/* Where rays begin, in grid units. */
typedef struct {
    soft_vec_t p, pr, pu, rim[2];
} origins_t;

static void check_reach(
        const world_t *world, const origins_t *o, int64_t aspect)
{
    const soft_t limit = soft_int(REACH_MAX, 0);

    for (int k = 0; k < 3; k++) {
        soft_t reach = soft_mul(drop_sign(o->pr.k[k]), soft_int(aspect, 0));

        reach = soft_add(reach, drop_sign(o->pu.k[k]));
        reach = soft_add(reach, drop_sign(o->p.k[k]));
        reach = soft_add(reach, drop_sign(o->rim[0].k[k]));
        reach = soft_add(reach, drop_sign(o->rim[1].k[k]));
        if (soft_compare(reach, limit) >= 0) {
            camera_fail(world, "a picture at most 2^15 times as large as "
                               "the scene in it: move the camera nearer");
        }
    }
}

/* The eye and the lens around it, if the box is not all before them. */
static void check_eye(const world_t *world, const origins_t *o)
{
    for (int k = 0; k < 3; k++) {
        const soft_t rim =
                soft_add(drop_sign(o->rim[0].k[k]), drop_sign(o->rim[1].k[k]));

        if (soft_round(soft_add(drop_sign(o->p.k[k]), rim), 0) > EYE_MAX) {
            camera_fail(world, "an eye beside the scene at most 32 times its "
                               "size away: move it nearer");
        }
    }
}

static void check_lens(const world_t *world)
{
    const soft_t most =
            soft_mul(soft_from(world->lens.focus), soft_int(LENS_MOST, 0));

    if (world->lens.radius > 0 &&
            soft_compare(soft_from(world->lens.radius), most) > 0) {
        cli_fail(CLI_INPUT,
                "%s:%u: expected a lens at most %d times as wide "
                "as its focus is far",
                world->path, world->lens_line, LENS_MOST);
    }
}

/* On the plane at depth, on which every ray begins: the point of the pinhole's
 * ray, moved by the lens as much as is left there of where it is at the eye. */
static origins_t find_origins(const world_t *world, const grid_t *grid,
        const frame_t *frame, soft_vec_t eye, soft_t depth)
{
    const soft_t far = soft_div(
            depth, world->lens.radius > 0
                           ? soft_div(soft_from(world->lens.focus), grid->unit)
                           : soft_int(1, 0));
    const soft_t left = soft_sub(soft_int(1, 0), far);
    origins_t o;

    o.p = soft_vec_add(eye, soft_vec_scale(frame->forward, depth));
    o.pr = soft_vec_scale(frame->right, depth);
    o.pu = soft_vec_scale(frame->up, depth);
    o.rim[0] = soft_vec_scale(frame->rim[0], left);
    o.rim[1] = soft_vec_scale(frame->rim[1], left);
    return o;
}

void build_camera(ql_blob_camera_t *camera, ql_blob_lens_t *lens,
        const world_t *world, const grid_t *grid)
{
    const frame_t frame = make_frame(world, grid);
    const int64_t aspect = choose_aspect(world);
    const soft_vec_t eye = find_eye(world, grid);
    const soft_t depth = find_depth(grid, eye, frame.forward);
    const origins_t o = find_origins(world, grid, &frame, eye, depth);
    int bits = DIRECTION_BITS;

    check_lens(world);
    while (!round_directions(camera, lens, &frame, bits, aspect)) {
        bits--;
    }
    if (depth.m == 0) {
        check_eye(world, &o);
    }
    check_reach(world, &o, aspect);
    for (int k = 0; k < 3; k++) {
        put_wide(camera->at[QL_CAMERA_BASE][k], soft_round(o.p.k[k], 32));
        put_wide(camera->at[QL_CAMERA_RIGHT][k], soft_round(o.pr.k[k], 32));
        put_wide(camera->at[QL_CAMERA_UP][k], soft_round(o.pu.k[k], 32));
        put_wide(lens->p[0][k], soft_round(o.rim[0].k[k], 32));
        put_wide(lens->p[1][k], soft_round(o.rim[1].k[k], 32));
    }
}
