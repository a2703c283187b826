/* build_cdf.c - quantised distributions over the lights of a scene */
/* SPDX-License-Identifier: MIT */

#include "lib/math/build_cdf.h"

#include <stdlib.h>

#include "lib/math/remainder.h"
#include "lib/program/cli.h"

/* Scale weights to 64 bits, none to 0; return their sum, below 2^64. */
static uint64_t scale_weights(
        uint64_t *scaled, const u128_t *weights, uint32_t count)
{
    u128_t sum = {0, 0};
    uint64_t total = 0;
    unsigned bits;

    for (uint32_t i = 0; i < count; i++) {
        sum = u128_add(sum, weights[i]);
    }
    /* a sum below 2^63 leaves room for 65,535 weights raised to 1 */
    bits = u128_bits(sum) > 63 ? u128_bits(sum) - 63 : 0;
    for (uint32_t i = 0; i < count; i++) {
        const uint64_t w = u128_shift_right(weights[i], bits).low;

        scaled[i] = w > 0 ? w : 1;
        total += scaled[i];
    }
    return total;
}

void cdf_shares(uint64_t *shares, const u128_t *weights, uint32_t count)
{
    remainder_t *rests = cli_alloc(count, sizeof *rests);
    uint64_t *scaled = cli_alloc(count, sizeof *scaled);
    const uint64_t total = scale_weights(scaled, weights, count);
    const uint64_t whole = (uint64_t)1 << 32;
    uint64_t given = 0;
    uint32_t largest = 0;

    for (uint32_t i = 0; i < count; i++) {
        u128_t w;

        w.high = scaled[i] >> 32;
        w.low = scaled[i] << 32;
        shares[i] = u128_div(w, total, &rests[i].rest).low;
        rests[i].index = i;
        if (shares[i] == 0) {
            shares[i] = 1;
            rests[i].rest = 0;
        }
        given += shares[i];
        largest = shares[i] > shares[largest] ? i : largest;
    }
    qsort(rests, count, sizeof *rests, remainder_compare);
    /* each share lost less than 1, so fewer than count are left to give */
    for (uint32_t i = 0; i < count && given < whole; i++, given++) {
        shares[rests[i].index]++;
    }
    /* shares raised to 1 took fewer than count from the largest, which has at
     * least 2^32 / count > 65,536 */
    shares[largest] -= given - whole;
    free(scaled);
    free(rests);
}

void cdf_weight(uint64_t share, uint32_t *m, int16_t *e)
{
    /* 1/pi = 0.517cc1b727220a94fe13abe8fa9a6ee0... in base 16: 2^-128 each.
     * 1/(2 pi P) = 2^31 / (pi share) */
    static const u128_t inverse_pi = {0x517cc1b727220a94u, 0xfe13abe8fa9a6ee0u};
    const u128_t q = u128_div(inverse_pi, share, NULL);
    const unsigned bits = u128_bits(q); /* 94 or more */
    uint64_t rounded = u128_shift_right(q, bits - 33).low + 1;

    *e = (int16_t)((int)bits - 32 - 128 + 31);
    if (rounded >> 33 != 0) {
        rounded >>= 1;
        (*e)++;
    }
    *m = (uint32_t)(rounded >> 1);
}
