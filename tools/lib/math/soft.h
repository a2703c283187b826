/* soft.h - real numbers of 64 bits precision, the same on every host */
/* SPDX-License-Identifier: MIT */

/* A blob must not depend on the machine that compiled the scene, and double
 * arithmetic does: the x87 keeps 64 bits, tan() differs between C libraries.
 * So reals are computed with these, which are integers all the way. A double
 * becomes one without loss; the exponent cannot overflow. */

#ifndef SOFT_H
#define SOFT_H

#include <stdbool.h>
#include <stdint.h>

/* ---- 128-bit unsigned integers ---- */

typedef struct {
    uint64_t high;
    uint64_t low;
} u128_t;

u128_t u128_mul(uint64_t a, uint64_t b);
u128_t u128_add(u128_t a, u128_t b);
u128_t u128_sub(u128_t a, u128_t b);
int u128_compare(u128_t a, u128_t b);
u128_t u128_shift_right(u128_t a, unsigned bits);

/* floor(a / b); the remainder too if rest is not NULL. b > 0. */
u128_t u128_div(u128_t a, uint64_t b, uint64_t *rest);

/* Bits needed to write a: 0 for 0, 128 at most. */
unsigned u128_bits(u128_t a);

/* floor(sqrt(a)) */
uint64_t u128_sqrt(u128_t a);

/* ---- real numbers ---- */

/* (-1)^negative * m * 2^e; m is 0 or has its top bit set. */
typedef struct {
    bool negative;
    int32_t e;
    uint64_t m;
} soft_t;

/* x, exactly; x is finite. */
soft_t soft_from(double x);

/* x * 2^e, exactly. */
soft_t soft_int(int64_t x, int e);

/* Rounded to nearest, but for add and sub of operands whose exponents differ by
 * 64 or more, which return the larger. */
soft_t soft_add(soft_t a, soft_t b);
soft_t soft_sub(soft_t a, soft_t b);
soft_t soft_mul(soft_t a, soft_t b);
soft_t soft_div(soft_t a, soft_t b);
soft_t soft_sqrt(soft_t a);
soft_t soft_negate(soft_t a);

/* Below 0, 0 or above 0 as a is below, equal to or above b. */
int soft_compare(soft_t a, soft_t b);

/* tan of half an angle of 0 < degrees < 180; error below 2^-60 / cos. */
soft_t soft_tan_half(soft_t degrees);

/* The nearest number to pi. */
soft_t soft_pi(void);

/* sin(pi x) of 0 < x < 1; error below 2^-60. */
soft_t soft_sin_pi(soft_t x);

/* The angle whose tangent is x >= 0; error below 2^-44. */
soft_t soft_atan(soft_t x);

/* floor(a) of 0 <= a < 2^128. */
u128_t soft_floor(soft_t a);

/* The integer nearest to a * 2^bits, halves away from 0; saturates. */
int64_t soft_round(soft_t a, int bits);

/* The nearest double, halves away from 0; 0 or infinity where there is none. */
double soft_double(soft_t a);

#endif
