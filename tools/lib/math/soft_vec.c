/* soft_vec.c - vectors of real numbers, the same on every host */
/* SPDX-License-Identifier: MIT */

#include "lib/math/soft_vec.h"

soft_vec_t soft_vec_from(const double a[3])
{
    soft_vec_t v;

    for (int k = 0; k < 3; k++) {
        v.k[k] = soft_from(a[k]);
    }
    return v;
}

soft_vec_t soft_vec_add(soft_vec_t a, soft_vec_t b)
{
    for (int k = 0; k < 3; k++) {
        a.k[k] = soft_add(a.k[k], b.k[k]);
    }
    return a;
}

soft_vec_t soft_vec_sub(soft_vec_t a, soft_vec_t b)
{
    for (int k = 0; k < 3; k++) {
        a.k[k] = soft_sub(a.k[k], b.k[k]);
    }
    return a;
}

soft_vec_t soft_vec_scale(soft_vec_t a, soft_t by)
{
    for (int k = 0; k < 3; k++) {
        a.k[k] = soft_mul(a.k[k], by);
    }
    return a;
}

soft_t soft_vec_dot(soft_vec_t a, soft_vec_t b)
{
    const soft_t xy =
            soft_add(soft_mul(a.k[0], b.k[0]), soft_mul(a.k[1], b.k[1]));

    return soft_add(xy, soft_mul(a.k[2], b.k[2]));
}

soft_vec_t soft_vec_cross(soft_vec_t a, soft_vec_t b)
{
    soft_vec_t c;

    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;

        c.k[k] = soft_sub(soft_mul(a.k[i], b.k[j]), soft_mul(a.k[j], b.k[i]));
    }
    return c;
}

soft_vec_t soft_vec_unit(soft_vec_t a)
{
    return soft_vec_scale(
            a, soft_div(soft_int(1, 0), soft_sqrt(soft_vec_dot(a, a))));
}
