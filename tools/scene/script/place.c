/* place.c - surfaces scaled, turned and moved to where a scene has them */
/* SPDX-License-Identifier: MIT */

#include "scene/script/place.h"

#include <math.h>

#include "lib/math/soft_vec.h"

#define FAR 1e300

/* The sine and cosine of an angle. */
typedef struct {
    soft_t sine, cosine;
} angle_t;

place_mark_t place_mark(const world_t *world)
{
    const place_mark_t mark = {
            world->vertex_count, world->normal_count, world->face_count};

    return mark;
}

/* Of 0 <= degrees < 90. */
static angle_t find_acute(double degrees)
{
    const soft_t half_turn = soft_int(180, 0);
    const soft_t x = soft_from(degrees);
    angle_t angle = {soft_int(0, 0), soft_int(1, 0)};

    if (degrees > 0) {
        angle.sine = soft_sin_pi(soft_div(x, half_turn));
        angle.cosine =
                soft_sin_pi(soft_div(soft_sub(soft_int(90, 0), x), half_turn));
    }
    return angle;
}

static angle_t find_angle(double degrees)
{
    double left = fmod(fabs(degrees), 360); /* exact, as differences below */
    int quarters = 0;
    angle_t angle;

    while (left >= 90) {
        left -= 90;
        quarters++;
    }
    angle = find_acute(left);
    while (quarters-- > 0) {
        const soft_t sine = angle.sine;

        angle.sine = angle.cosine;
        angle.cosine = soft_negate(sine);
    }
    if (degrees < 0) {
        angle.sine = soft_negate(angle.sine);
    }
    return angle;
}

static soft_vec_t turn(soft_vec_t p, const angle_t angles[3])
{
    for (int axis = 0; axis < 3; axis++) {
        const int i = (axis + 1) % 3, k = (axis + 2) % 3;
        const angle_t angle = angles[axis];
        const soft_t along = p.k[i];

        p.k[i] = soft_sub(
                soft_mul(along, angle.cosine), soft_mul(p.k[k], angle.sine));
        p.k[k] = soft_add(
                soft_mul(along, angle.sine), soft_mul(p.k[k], angle.cosine));
    }
    return p;
}

static bool put(double to[3], soft_vec_t p)
{
    bool near = true;

    for (int k = 0; k < 3; k++) {
        to[k] = soft_double(p.k[k]);
        near = near && fabs(to[k]) <= FAR;
    }
    return near;
}

static bool place_vertex(
        double vertex[3], const place_t *place, const angle_t angles[3])
{
    soft_vec_t p = soft_vec_from(vertex);

    for (int k = 0; k < 3; k++) {
        p.k[k] = soft_mul(p.k[k], soft_from(place->scale[k]));
    }
    return put(vertex, soft_vec_add(turn(p, angles), soft_vec_from(place->at)));
}

static void place_normal(
        double normal[3], const place_t *place, const angle_t angles[3])
{
    soft_vec_t n = soft_vec_from(normal);

    for (int k = 0; k < 3; k++) {
        n.k[k] = soft_div(n.k[k], soft_from(place->scale[k]));
    }
    if (soft_vec_dot(n, n).m != 0) {
        (void)put(normal, soft_vec_unit(turn(n, angles)));
    }
}

/* Wind a face the other way around. */
static void turn_over(world_face_t *face)
{
    const uint32_t vertex = face->vertex[1], normal = face->normal[1];

    face->vertex[1] = face->vertex[2];
    face->normal[1] = face->normal[2];
    face->vertex[2] = vertex;
    face->normal[2] = normal;
}

bool place_part(world_t *world, const place_t *place, place_mark_t from,
        place_mark_t to)
{
    const double *scale = place->scale;
    const bool mirrors =
            ((scale[0] < 0) ^ (scale[1] < 0) ^ (scale[2] < 0)) != 0;
    angle_t angles[3];
    bool near = true;

    for (int axis = 0; axis < 3; axis++) {
        angles[axis] = find_angle(place->turn[axis]);
    }
    for (size_t v = from.vertex; v < to.vertex; v++) {
        near = place_vertex(world->vertices[v], place, angles) && near;
    }
    for (size_t n = from.normal; n < to.normal; n++) {
        place_normal(world->normals[n], place, angles);
    }
    for (size_t f = from.face; f < to.face && mirrors; f++) {
        turn_over(world->faces + f);
    }
    return near;
}
