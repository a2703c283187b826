/* film_add.h - add to one channel of a pixel, as ql_film_add() does to three */
/* SPDX-License-Identifier: MIT */

#ifndef FILM_ADD_H
#define FILM_ADD_H

#include "film/ql_film.h"

static inline void film_add(uint64_t *sum, ql_uq31_t value, ql_real_t scale,
        uint32_t key, ql_diag_t *diag)
{
    const ql_uq31_t values[3] = {value, 0, 0};
    ql_sum_t rgb = {{0, 0, 0}};

    rgb.rgb[0] = *sum;
    ql_film_add(&rgb, values, scale, key, diag);
    *sum = rgb.rgb[0];
}

#endif
