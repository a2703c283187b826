/* box_scene.c - a small scene for tests: an open box with a lamp */
/* SPDX-License-Identifier: MIT */

#include "support/picture/box_scene.h"

#include "support/picture/mini_scene.h"

/* Corners counter-clockwise seen from inside, grid units. */
enum { LOW = 1000, HIGH = 31000, LAMP_LOW = 12000, LAMP_HIGH = 20000 };

static const int32_t floor_quad[4][3] = {
        {LOW, LOW, LOW}, {LOW, LOW, HIGH}, {HIGH, LOW, HIGH}, {HIGH, LOW, LOW}};
static const int32_t back_quad[4][3] = {{LOW, LOW, HIGH}, {LOW, HIGH, HIGH},
        {HIGH, HIGH, HIGH}, {HIGH, LOW, HIGH}};
static const int32_t left_quad[4][3] = {
        {LOW, LOW, LOW}, {LOW, HIGH, LOW}, {LOW, HIGH, HIGH}, {LOW, LOW, HIGH}};
static const int32_t right_quad[4][3] = {{HIGH, LOW, LOW}, {HIGH, LOW, HIGH},
        {HIGH, HIGH, HIGH}, {HIGH, HIGH, LOW}};
static const int32_t lamp_quad[4][3] = {{LAMP_LOW, HIGH, LAMP_LOW},
        {LAMP_HIGH, HIGH, LAMP_LOW}, {LAMP_HIGH, HIGH, LAMP_HIGH},
        {LAMP_LOW, HIGH, LAMP_HIGH}};

static void add(mini_scene_t *m, const int32_t quad[4][3], double albedo,
        double emission)
{
    mini_quad(m, quad[0], quad[1], quad[2], quad[3],
            mini_material(m, albedo, emission));
}

void *box_scene(size_t *size)
{
    static const double right[3] = {0.6, 0, 0}, up[3] = {0, 0.45, 0};
    static mini_scene_t m;
    ql_scene_t scene;

    mini_begin(&m);
    m.width = 64;
    m.height = 48;
    m.radiance_exp = 4;
    add(&m, floor_quad, 0.8, 0);
    add(&m, back_quad, 0.7, 0);
    add(&m, left_quad, 0.6, 0);
    add(&m, right_quad, 0.2, 0);
    add(&m, lamp_quad, 0.5, 12);
    mini_eye(&m, 16000, 16000, 1200);
    mini_look(&m, 0, 0, 1);
    mini_field(&m, right, up);
    mini_open(&m, &scene);
    *size = m.size_bytes;
    return m.blob;
}
