/* gain.c - what a lamp lost of its area on the grid, and gets back */
/* SPDX-License-Identifier: MIT */

#include "scene/mesh/gain.h"

#include <stdlib.h>

#include "lib/math/soft_vec.h"
#include "lib/program/cli.h"
#include "scene/lamp/lamp_parts.h"

/* A gain is 2^GAIN_BITS + its low bits, times 2 to its other bits less
 * GAIN_BIAS. */
enum { GAIN_BITS = 8, GAIN_BIAS = 32, GAIN_LEAST = -16, GAIN_MOST = 4 };

soft_t gain_value(uint32_t gain)
{
    const int64_t m = (1 << GAIN_BITS) | (gain & ((1u << GAIN_BITS) - 1));

    return gain == GAIN_NONE
                   ? soft_int(1, 0)
                   : soft_int(m, (int)(gain >> GAIN_BITS) - GAIN_BIAS);
}

static uint32_t pack(int64_t m, int e)
{
    return (uint32_t)(e + GAIN_BIAS) << GAIN_BITS |
           (uint32_t)(m - (1 << GAIN_BITS));
}

/* To nearest, of nine bits; within the limits. */
static uint32_t round_gain(soft_t ratio)
{
    int e = -GAIN_BITS;
    int64_t m;

    if (soft_compare(ratio, soft_int(1, GAIN_LEAST)) < 0) {
        return pack(1 << GAIN_BITS, GAIN_LEAST - GAIN_BITS);
    }
    if (soft_compare(ratio, soft_int(1, GAIN_MOST)) > 0) {
        return pack(1 << GAIN_BITS, GAIN_MOST - GAIN_BITS);
    }
    while (soft_round(ratio, -e) >= 2 << GAIN_BITS) {
        e++;
    }
    while ((m = soft_round(ratio, -e)) < 1 << GAIN_BITS) {
        e--;
    }
    return m == 1 << GAIN_BITS && e == -GAIN_BITS ? GAIN_NONE : pack(m, e);
}

/* |e1 x e2|^2 of a triangle as written. */
static soft_t square_written(const world_t *world, const world_face_t *face)
{
    const soft_vec_t p = soft_vec_from(world->vertices[face->vertex[0]]);
    const soft_vec_t n = soft_vec_cross(
            soft_vec_sub(soft_vec_from(world->vertices[face->vertex[1]]), p),
            soft_vec_sub(soft_vec_from(world->vertices[face->vertex[2]]), p));

    return soft_vec_dot(n, n);
}

static soft_t find_ratio(
        const grid_t *grid, const world_t *world, const grid_face_t *face)
{
    const soft_t unit2 = soft_mul(grid->unit, grid->unit);
    int64_t n[3];
    soft_t grid2, written2;

    if (face->sphere != 0) {
        const soft_t r = soft_from(world->spheres[face->source].radius);
        const uint64_t rounded = grid->spheres[face->sphere - 1].radius;

        /* radius in 1/256 units */
        return soft_div(soft_mul(r, r),
                soft_mul(unit2, soft_int((int64_t)(rounded * rounded), -16)));
    }
    grid_normal(grid, face, n);
    /* below 3 2^60 */
    grid2 = soft_int(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 0);
    written2 = square_written(world, world->faces + face->source);
    return soft_sqrt(
            soft_div(written2, soft_mul(grid2, soft_mul(unit2, unit2))));
}

/* For each face of the world how much brighter its lamp shines for faces that
 * are not on the grid; NULL if all that emit are. */
static soft_t *find_factors(grid_t *grid, const world_t *world)
{
    bool *kept = cli_alloc(world->face_count, sizeof *kept), all = true;
    soft_t *factors = NULL;

    for (size_t f = 0; f < world->face_count; f++) {
        kept[f] = false;
    }
    for (uint32_t i = 0; i < grid->face_count; i++) {
        if (grid->faces[i].sphere == 0) {
            kept[grid->faces[i].source] = true;
        }
    }
    for (size_t f = 0; f < world->face_count && all; f++) {
        all = kept[f] || !world_emits(world, world->faces[f].material);
    }
    grid->lost_count = 0;
    if (!all) {
        factors = lamp_parts_find(world, kept, &grid->lost_count);
    }
    free(kept);
    return factors;
}

soft_t gain_faces(grid_t *grid, const world_t *world)
{
    const soft_t one = soft_int(1, 0);
    soft_t *factors = find_factors(grid, world);
    soft_t most = one;

    for (uint32_t i = 0; i < grid->face_count; i++) {
        grid_face_t *face = grid->faces + i;

        face->gain = GAIN_NONE;
        if (world_emits(world, face->material)) {
            const soft_t own = find_ratio(grid, world, face);
            const soft_t ratio = factors != NULL && face->sphere == 0
                                         ? soft_mul(own, factors[face->source])
                                         : own;
            const soft_t off = soft_compare(ratio, one) >= 0 || ratio.m == 0
                                       ? ratio
                                       : soft_div(one, ratio);

            face->gain = round_gain(ratio);
            most = soft_compare(off, most) > 0 ? off : most;
        }
    }
    free(factors);
    return most;
}
