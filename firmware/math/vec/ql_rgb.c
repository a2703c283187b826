/* ql_rgb.c - three channels with one exponent: scale, add */
/* SPDX-License-Identifier: MIT */

#include "math/vec/ql_rgb.h"

/* Largest channel in [2^31, 2^32), or all zero. Exact. */
static void normalise(ql_rgb_t *a)
{
    const unsigned zeros = ql_clz32(ql_rgb_most(a));

    if (zeros == 32) {
        a->e = 0;
        return;
    }
    for (unsigned i = 0; i < 3; i++) {
        a->c[i] <<= zeros;
    }
    a->e = ql_real_exponent(a->e - (int32_t)zeros);
}

/* Set an exponent; a colour below 2^QL_RGB_EXP_MIN becomes zero. */
static void set_exponent(ql_rgb_t *a, int32_t e)
{
    if (e < QL_RGB_EXP_MIN) {
        a->c[0] = a->c[1] = a->c[2] = 0;
        e = 0;
    }
    a->e = ql_real_exponent(e);
}

bool ql_rgb_load(ql_rgb_t *a, const uint32_t from[3])
{
    for (unsigned i = 0; i < 3; i++) {
        a->c[i] = QL_LE32(from[i]);
    }
    a->e = 0;
    return (a->c[0] | a->c[1] | a->c[2]) != 0;
}

/* a b 2^-32 half up: the product is at most 2^64 - 2^33 + 1, so this fits; of
 * two that are at least 2^31 it is at least 2^30. */
static uint32_t half_product(uint32_t a, uint32_t b)
{
    return ql_mulhi_u32(a, b) + (a * b >> 31);
}

void ql_rgb_scale(ql_rgb_t *a, ql_real_t by)
{
    normalise(a);
    for (unsigned i = 0; i < 3; i++) {
        a->c[i] = half_product(a->c[i], by.m);
    }
    set_exponent(a, (int32_t)a->e + by.e + 32);
}

void ql_rgb_mul(ql_rgb_t *a, const ql_rgb_t *b)
{
    ql_rgb_t other = *b;

    normalise(a);
    normalise(&other);
    for (unsigned i = 0; i < 3; i++) {
        a->c[i] = half_product(a->c[i], other.c[i]);
    }
    set_exponent(a, (int32_t)a->e + other.e + 1);
}

/* c / 2^shift to nearest, for shift above 0; below 2^31, so that two add up:
 * only 2^32 - 1 would be rounded to 2^31, and stays half an ulp below. */
static uint32_t shift_round(uint32_t c, unsigned shift)
{
    const uint32_t twice = shift > 32 ? 0 : c >> (shift - 1);

    return twice == 0xffffffffu ? twice >> 1 : (twice >> 1) + (twice & 1u);
}

void ql_rgb_add(ql_rgb_t *a, const ql_rgb_t *b)
{
    ql_rgb_t other = *b;
    int16_t e;

    normalise(a);
    normalise(&other);
    if (ql_rgb_most(&other) == 0) {
        return;
    }
    if (ql_rgb_most(a) == 0) {
        *a = other;
        return;
    }
    /* The larger exponent and a bit for the carry: each is rounded once. */
    e = ql_real_exponent((a->e > other.e ? a->e : other.e) + 1);
    for (unsigned i = 0; i < 3; i++) {
        a->c[i] = shift_round(a->c[i], (unsigned)(e - a->e)) +
                  shift_round(other.c[i], (unsigned)(e - other.e));
    }
    a->e = e;
}
