/* ql_adaptive.c - sums of squares, the stopping rule, the mean of two halves */
/* SPDX-License-Identifier: MIT */

#include "film/ql_adaptive.h"

#if QL_CFG_ADAPTIVE

/* A number below 2^128. */
typedef struct {
    uint64_t high, low;
} wide_t;

static wide_t multiply(uint64_t a, uint64_t b)
{
    const uint64_t al = (uint32_t)a, ah = a >> 32;
    const uint64_t bl = (uint32_t)b, bh = b >> 32;
    const uint64_t low = al * bl;
    /* (2^32 - 1)^2 + 2 (2^32 - 1) < 2^64 */
    const uint64_t one = ah * bl + (low >> 32);
    const uint64_t two = al * bh + (uint32_t)one;
    wide_t r;

    r.high = ah * bh + (one >> 32) + (two >> 32);
    r.low = two << 32 | (uint32_t)low;
    return r;
}

/* Cut to the 32 highest bits. */
static ql_real_t real_from_wide(wide_t n)
{
    const unsigned zeros = ql_clz64(n.high); /* 16 or more, see below */

    if (n.high == 0) {
        return ql_real_from_u64(n.low);
    }
    return ql_real_scale(
            ql_real_from_u64(n.high << zeros | n.low >> (64 - zeros)),
            64 - (int32_t)zeros);
}

void ql_spread_add(ql_spread_t *spread, uint32_t value)
{
    const uint64_t square = (uint64_t)value * value;

    spread->count++;
    spread->sum += value;
    spread->square_low += square;
    spread->square_high += spread->square_low < square;
}

bool ql_spread_enough(const ql_spread_t *spread, uint16_t error_q16)
{
    const uint32_t h = spread->count;
    /* sums below 2^88 and 2^56, h <= 2^24: both below 2^112 */
    wide_t squares = multiply(spread->square_low, h);
    const wide_t square = multiply(spread->sum, spread->sum);
    const ql_real_t sum = ql_real_from_u64(spread->sum);
    ql_real_t right;

    if (h < 2 || (spread->sum == 0 && h < QL_ADAPTIVE_BLACK / 2)) {
        return false;
    }
    /* h S2 >= S^2, whatever the values (Cauchy and Schwarz) */
    squares.high += (uint64_t)spread->square_high * h;
    squares.high -= square.high + (squares.low < square.low);
    squares.low -= square.low;
    /* E^2 (h - 1) < 2^56 of 2^-32, twice */
    right = ql_real_from_u64(
            (uint64_t)((uint32_t)error_q16 * error_q16) * (h - 1));
    right = ql_real_mul_call(
            ql_real_scale(right, -31), ql_real_mul_call(sum, sum));
    return ql_real_sub(real_from_wide(squares), right).m == 0;
}

static uint64_t saturating_sum(uint64_t a, uint64_t b)
{
    return a > UINT64_MAX - b ? UINT64_MAX : a + b;
}

void ql_half_add(ql_half_t *half, const ql_sum_t *sample)
{
    const uint64_t *rgb = sample->rgb;
    /* below 2^30 each: R + 2G + B < 2^32 */
    const uint32_t value = (rgb[0] | rgb[1] | rgb[2]) >> 30 != 0
                                   ? 0xffffffffu
                                   : (uint32_t)(rgb[0] + 2 * rgb[1] + rgb[2]);

    ql_spread_add(&half->spread, value);
    for (unsigned i = 0; i < 3; i++) {
        half->sum.rgb[i] = saturating_sum(half->sum.rgb[i], rgb[i]);
    }
}

bool ql_half_decide(ql_half_t half[2], uint16_t error_q16, bool last)
{
    for (unsigned i = 0; i < 2; i++) {
        ql_half_t *other = half + (1 - i);

        if (other->used_count == 0 &&
                (last || ql_spread_enough(&half[i].spread, error_q16))) {
            other->used = other->sum;
            other->used_count = other->spread.count;
        }
    }
    return half[0].used_count != 0 && half[1].used_count != 0;
}

/* sum * factor / 2^shift, rounded half up; saturates. factor < 2^24. */
static uint64_t scale_sum(uint64_t sum, uint32_t factor, unsigned shift)
{
    const wide_t exact = multiply(sum, factor);
    const uint64_t half = (uint64_t)1 << shift >> 1;
    const uint64_t low = exact.low + half;
    const uint64_t high = exact.high + (low < half); /* < 2^24 + 1 */

    if (high >> shift != 0) {
        return UINT64_MAX;
    }
    return shift == 0 ? low : high << (64 - shift) | low >> shift;
}

uint32_t ql_half_join(const ql_half_t half[2], ql_sum_t *sum)
{
    const uint32_t count = half[0].spread.count;

    for (unsigned i = 0; i < 3; i++) {
        sum->rgb[i] = 0;
        for (unsigned k = 0; k < 2; k++) {
            const uint32_t used = half[k].used_count;
            /* used is count, or less and a power of two */
            sum->rgb[i] = saturating_sum(sum->rgb[i],
                    used == count ? half[k].used.rgb[i]
                                  : scale_sum(half[k].used.rgb[i], count,
                                            31 - ql_clz32(used)));
        }
    }
    return 2 * count;
}

#endif
