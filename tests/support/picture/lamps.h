/* lamps.h - a scene of lamps, each of another area */
/* SPDX-License-Identifier: MIT */

#ifndef LAMPS_H
#define LAMPS_H

#include "support/picture/mini_scene.h"

static mini_scene_t mini;
static ql_scene_t scene;

/* Lamps of areas 1 : 2 : 4 : ..., the brightest 8 times the dimmest, among
 * triangles that emit nothing. */
static inline void build_lamps(unsigned lamps)
{
    uint16_t dark, light;

    mini_begin(&mini);
    dark = mini_material(&mini, 0.5, 0);
    light = mini_material(&mini, 0, 0.5);
    for (int32_t i = 0; i < (int32_t)lamps; i++) {
        const int32_t size = 100 << i / 2, high = size << i % 2;
        const int32_t at = 500 + 2100 * i;
        const int32_t a[3] = {at, 9000 + i, 8}, b[3] = {at + size, 9000, 32759};
        const int32_t c[3] = {at, 9000 + high, 8 + 2700 * i};

        mini_triangle(&mini, a, b, c, dark);
        mini_triangle(&mini, a, c, b, light);
    }
    mini_open(&mini, &scene);
}

#endif
