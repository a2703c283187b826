/* frame.c - a camera that has all of a mesh in its picture */
/* SPDX-License-Identifier: MIT */

#include "scene/bare/frame.h"

#include "lib/math/soft_vec.h"

#define MARGIN_SIXTEENTHS 1 /* of half a picture, at each side */

bool frame_box(const world_t *world, double low[3], double high[3])
{
    bool any = false;

    for (size_t f = 0; f < world->face_count; f++) {
        for (int i = 0; i < 3 && !world_is_flat(world, world->faces + f); i++) {
            const double *p = world->vertices[world->faces[f].vertex[i]];

            for (int k = 0; k < 3; k++) {
                low[k] = !any || p[k] < low[k] ? p[k] : low[k];
                high[k] = !any || p[k] > high[k] ? p[k] : high[k];
            }
            any = true;
        }
    }
    return any;
}

/* The most that lies to each side: right, left, above, below, of the way that
 * one goes forwards meanwhile. A point at x, z is seen from e, f if
 * |x - e| <= k (z - f): that is, x - k z <= e - k f and -x - k z <= -e - k f.
 */
typedef struct {
    soft_t most[4], nearest, farthest;
} reach_t;

static soft_t larger(soft_t a, soft_t b)
{
    return soft_compare(a, b) > 0 ? a : b;
}

static reach_t find_reach(
        const world_t *world, const soft_vec_t axes[3], soft_t k)
{
    reach_t reach;
    bool any = false;

    for (size_t f = 0; f < world->face_count; f++) {
        for (int i = 0; i < 3 && !world_is_flat(world, world->faces + f); i++) {
            const soft_vec_t p =
                    soft_vec_from(world->vertices[world->faces[f].vertex[i]]);
            const soft_t z = soft_vec_dot(p, axes[2]);
            const soft_t back = soft_mul(k, z);

            for (int side = 0; side < 4; side++) {
                const soft_t x = soft_vec_dot(p, axes[side / 2]);
                const soft_t at =
                        soft_sub(side % 2 == 0 ? x : soft_negate(x), back);

                reach.most[side] = any ? larger(reach.most[side], at) : at;
            }
            reach.nearest = !any || soft_compare(z, reach.nearest) < 0
                                    ? z
                                    : reach.nearest;
            reach.farthest = any ? larger(reach.farthest, z) : z;
            any = true;
        }
    }
    return reach;
}

static void put(double to[3], soft_vec_t p)
{
    for (int k = 0; k < 3; k++) {
        to[k] = soft_double(p.k[k]);
    }
}

void frame_beside(double p[3], const double from[3], const int direction[3],
        const double way[3], double unit)
{
    const soft_t a = soft_int(direction[0], 0), c = soft_int(direction[2], 0);
    const soft_t zero = soft_int(0, 0);
    const soft_vec_t axes[3] = {
            soft_vec_unit((soft_vec_t){{c, zero, soft_negate(a)}}),
            {{zero, soft_int(1, 0), zero}},
            soft_vec_unit((soft_vec_t){{a, zero, c}})};
    soft_vec_t at = soft_vec_from(from);

    for (int k = 0; k < 3; k++) {
        at = soft_vec_add(
                at, soft_vec_scale(axes[k],
                            soft_mul(soft_from(way[k]), soft_from(unit))));
    }
    put(p, at);
}

static soft_t halve(soft_t a)
{
    return soft_mul(a, soft_int(1, -1));
}

void frame_all(
        world_camera_t *camera, const world_t *world, const int direction[3])
{
    const soft_t a = soft_int(direction[0], 0), c = soft_int(direction[2], 0);
    const soft_vec_t forward = soft_vec_unit((soft_vec_t){
            {soft_negate(a), soft_int(-direction[1], 0), soft_negate(c)}});
    const soft_vec_t right =
            soft_vec_unit((soft_vec_t){{c, soft_int(0, 0), soft_negate(a)}});
    const soft_vec_t axes[3] = {right, soft_vec_cross(right, forward), forward};
    const soft_t k = soft_mul(soft_tan_half(soft_from(camera->fov)),
            soft_int(16 - MARGIN_SIXTEENTHS, -4));
    const reach_t reach = find_reach(world, axes, k);
    soft_vec_t eye = {{soft_int(0, 0), soft_int(0, 0), soft_int(0, 0)}};
    soft_t way, far;

    /* the eye is back as far as the wider of both sides has it */
    for (int i = 0; i < 2; i++) {
        const soft_t *most = reach.most + 2 * i;

        eye = soft_vec_add(eye,
                soft_vec_scale(axes[i], halve(soft_sub(most[0], most[1]))));
    }
    far = larger(soft_add(reach.most[0], reach.most[1]),
            soft_add(reach.most[2], reach.most[3]));
    way = soft_negate(halve(soft_div(far, k)));
    eye = soft_vec_add(eye, soft_vec_scale(forward, way));
    put(camera->eye, eye);
    way = soft_sub(halve(soft_add(reach.nearest, reach.farthest)), way);
    put(camera->look, soft_vec_add(eye, soft_vec_scale(forward, way)));
}
