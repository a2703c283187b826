/* ql_sampler.h - named random dimensions of one camera path */
/* SPDX-License-Identifier: MIT */

/* A path is a point in a cube of many dimensions; each decision takes a named
 * pair of them. A number depends on (seed, pixel, sample index, dimension) and
 * on nothing else, so any part of a picture can be rendered anywhere. */

#ifndef QL_SAMPLER_H
#define QL_SAMPLER_H

#include "base/ql_settings.h"
#include "math/ql_fx.h"

QL_C_BEGIN

/* Pairs of dimensions. Those of bounce k are QL_DIM_BOUNCE(k) + the name, and
 * those of the next samples of emitters, points or directions, are
 * QL_DIMS_A_SAMPLE apart (modulo 2^32). */
enum {
    QL_DIM_PIXEL = 0,       /* where in the pixel */
    QL_DIM_LENS = 1,        /* where on the lens */
    QL_DIM_LIGHT_POINT = 0, /* where on the emitter */
    QL_DIM_DIRECTION = 1,   /* which way to go on */
    QL_DIM_LIGHT_PICK = 2,  /* which emitter */
    QL_DIMS_A_BOUNCE = 3,
    QL_DIM_CHOICE = 256,     /* which lobe; whether to go on */
    QL_DIM_LOOK = 257,       /* which way to look for emitters */
    QL_DIM_LOOK_CHOICE = 258 /* by which lobe */
};
#define QL_DIMS_A_SAMPLE 512u
#define QL_DIM_BOUNCE(k) (2u + QL_DIMS_A_BOUNCE * (uint32_t)(k))

typedef struct {
    uint32_t key;   /* hash of seed and pixel */
    uint32_t index; /* sample index, bit-reversed for Sobol */
    bool sobol;
} ql_sampler_t;

/* Two uniform numbers, midpoints of 2^32 intervals. */
typedef struct {
    ql_uq32_t u1, u2;
} ql_uniform2_t;

/* Begin a pixel.
 *
 *   sampler  -   out
 *   kind     -   ql_sampler_kind_t, one of QL_CFG_SAMPLERS
 *   seed     -   any; seeds that differ in one bit give unrelated numbers
 *   x, y     px  position in the picture
 */
void ql_sampler_begin(ql_sampler_t *sampler, uint8_t kind, uint32_t seed,
        uint16_t x, uint16_t y);

/* Begin sample index of the pixel.
 *
 *   sampler  -  from ql_sampler_begin()
 *   index    -  any; Sobol points are best balanced over 0..2^k-1
 */
void ql_sampler_start(ql_sampler_t *sampler, uint32_t index);

/* Draw one pair of dimensions.
 *
 *   sampler  -  after ql_sampler_start()
 *   dim      -  a QL_DIM_ name, plus QL_DIM_BOUNCE(k)
 *   return   both numbers; the same arguments give the same numbers
 *
 * Sobol: every pair is a (0, m, 2)-net in base 2, Owen-scrambled and shuffled
 * by its own seeds, so pairs are independent of each other.
 * Cost: 18 multiplications (Sobol), 8 (random).
 */
ql_uniform2_t ql_sampler_2d(const ql_sampler_t *sampler, uint32_t dim);

/* A number that differs from sample to sample and pixel to pixel, for decisions
 * not worth a Sobol dimension: hash it. */
QL_INLINE uint32_t ql_sampler_key(const ql_sampler_t *sampler)
{
    return sampler->key + sampler->index;
}

/* Draw one number: u1 of the same pair, for less.
 *
 *   sampler, dim  -     as for ql_sampler_2d()
 *   return        uq32  ql_sampler_2d(sampler, dim).u1
 */
ql_uq32_t ql_sampler_1d(const ql_sampler_t *sampler, uint32_t dim);

QL_C_END

#endif
