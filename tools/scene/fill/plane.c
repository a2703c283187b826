/* plane.c - the corners of a face as integers, seen along its normal */
/* SPDX-License-Identifier: MIT */

#include "scene/fill/plane.h"

#include "lib/math/soft_vec.h"

enum {
    COORDINATE_BITS = 53,
    DIRECTION_MOST = 127, /* largest component of the direction */
    NOISE_BITS = 30 /* a normal that much smaller than its terms is none */
};

/* ---- products ---- */

static int sign(int64_t x)
{
    return (x > 0) - (x < 0);
}

static uint64_t size_of(int64_t x)
{
    return x < 0 ? 0 - (uint64_t)x : (uint64_t)x;
}

/* The sign of a b - c d. */
static int compare_products(int64_t a, int64_t b, int64_t c, int64_t d)
{
    const int left = sign(a) * sign(b), right = sign(c) * sign(d);

    if (left != right || left == 0) {
        return sign(left - right);
    }
    return left * u128_compare(u128_mul(size_of(a), size_of(b)),
                          u128_mul(size_of(c), size_of(d)));
}

/* Differences of coordinates are below 2^62. */
int plane_side(
        const plane_point_t *a, const plane_point_t *b, const plane_point_t *c)
{
    return compare_products(b->x - a->x, c->y - a->y, b->y - a->y, c->x - a->x);
}

bool plane_turns_back(
        const plane_point_t *a, const plane_point_t *b, const plane_point_t *c)
{
    /* on a line the signs of both coordinates agree, where they are not 0 */
    return sign(b->x - a->x) * sign(c->x - b->x) +
                   sign(b->y - a->y) * sign(c->y - b->y) <=
           0;
}

/* ---- the way the face is seen ---- */

static soft_t largest(soft_vec_t v)
{
    soft_t most = soft_int(0, 0);

    for (int k = 0; k < 3; k++) {
        v.k[k].negative = false;
        most = soft_compare(v.k[k], most) > 0 ? v.k[k] : most;
    }
    return most;
}

/* Where a corner is, as seen from the first one. */
static soft_vec_t find_corner(
        const world_t *world, const uint32_t *vertices, size_t i)
{
    return soft_vec_sub(soft_vec_from(world->vertices[vertices[i]]),
            soft_vec_from(world->vertices[vertices[0]]));
}

/* The direction of the normal as integers; false if there is none. Also the
 * largest coordinate of a corner. */
static bool find_direction(int64_t direction[3], soft_t *width,
        const world_t *world, const uint32_t *vertices, size_t count)
{
    soft_vec_t last = find_corner(world, vertices, 1);
    soft_vec_t normal = soft_vec_cross(last, last), part = normal; /* 0 */
    soft_t most = soft_int(0, 0), sizes = most;

    *width = largest(last);
    for (size_t i = 2; i < count; i++) {
        const soft_vec_t corner = find_corner(world, vertices, i);
        const soft_vec_t cross = soft_vec_cross(last, corner);
        const soft_t far = largest(corner), size = largest(cross);

        normal = soft_vec_add(normal, cross);
        sizes = soft_add(sizes, size);
        part = soft_compare(size, most) > 0 ? cross : part;
        most = soft_compare(size, most) > 0 ? size : most;
        *width = soft_compare(far, *width) > 0 ? far : *width;
        last = corner;
    }
    sizes.e -= NOISE_BITS;
    if (soft_compare(largest(normal), sizes) <= 0) {
        normal = part; /* as much forwards as backwards */
    }
    most = largest(normal);
    for (int k = 0; k < 3 && most.m != 0; k++) {
        const soft_t scaled =
                soft_mul(normal.k[k], soft_int(DIRECTION_MOST, 0));

        direction[k] = soft_round(soft_div(scaled, most), 0);
    }
    return most.m != 0;
}

/* Along (u, v, w), with w the largest, (x, y, z) is seen where (x w - z u,
 * y w - z v) is; from behind if w < 0, so then x and y change places. */
bool plane_project(plane_point_t *points, const world_t *world,
        const uint32_t *vertices, size_t count)
{
    int64_t direction[3];
    soft_t width;
    int x, y, z = 0, bits;

    if (!find_direction(direction, &width, world, vertices, count)) {
        return false;
    }
    while (size_of(direction[z]) != DIRECTION_MOST) {
        z++;
    }
    x = direction[z] > 0 ? (z + 1) % 3 : (z + 2) % 3;
    y = 3 - z - x;
    bits = COORDINATE_BITS - (width.e + 64); /* width < 2^(e + 64) */
    for (size_t i = 0; i < count; i++) {
        const soft_vec_t corner = find_corner(world, vertices, i);
        int64_t at[3];

        for (int k = 0; k < 3; k++) {
            at[k] = soft_round(corner.k[k], bits); /* <= 2^53 in size */
        }
        /* <= 2^53 2 127 in size */
        points[i].x = at[x] * direction[z] - at[z] * direction[x];
        points[i].y = at[y] * direction[z] - at[z] * direction[y];
    }
    return true;
}
