/* ql_film.c - add up contributions, take the mean */
/* SPDX-License-Identifier: MIT */

#include "render/ql_film.h"

void ql_film_add(
        uint64_t *sum, ql_uq31_t value, ql_real_t scale, ql_diag_t *diag)
{
    /* value m 2^(e - 31 + 24); the product is below 2^64 - 2^33 */
    const uint64_t exact = ql_product_u32(value, scale.m);
    const int shift = scale.e - 7;
    uint64_t add = 0;

    if (value == 0) {
        return; /* most surfaces emit nothing */
    }
    if (shift < 0 && shift >= -64) {
        add = ((exact >> (-shift - 1)) + 1) >> 1;
    } else if (shift >= 0 && exact != 0) {
        add = shift < 40 && exact <= QL_CONTRIBUTION_MAX >> shift
                      ? exact << shift
                      : QL_CONTRIBUTION_MAX + 1;
    }
    if (add > QL_CONTRIBUTION_MAX) {
        add = QL_CONTRIBUTION_MAX;
        QL_DIAG_COUNT(diag, saturated);
    }
    if (*sum > UINT64_MAX - add) {
        *sum = UINT64_MAX;
        QL_DIAG_COUNT(diag, saturated);
        return;
    }
    *sum += add;
}

void ql_film_display(const ql_sum_t *sum, uint32_t samples, ql_real_t exposure,
        ql_uq16_t linear[3])
{
    const ql_real_t scale =
            ql_real_mul(exposure, ql_real_recip(ql_real_from_u64(samples)));

    for (unsigned i = 0; i < 3; i++) {
        const ql_real_t mean =
                ql_real_mul(ql_real_from_u64(sum->rgb[i]), scale);
        /* sum 2^-24 scale 2^16 = m 2^(e - 8) */
        const int shift = 8 - mean.e;

        if (mean.m == 0 || shift > 32) {
            linear[i] = 0;
        } else if (shift <= 0) {
            linear[i] = shift == 0 ? mean.m : 0xffffffffu;
        } else {
            const uint32_t twice = mean.m >> (shift - 1);

            linear[i] = (twice >> 1) + (twice & 1u);
        }
    }
}

ql_real_t ql_film_exposure(int16_t radiance_exp, int16_t exposure_q8)
{
    /* 2^(1/2), 2^(1/4), ... 2^(1/256), u1.31 */
    static const uint32_t root[8] = {0xb504f334u, 0x9837f052u, 0x8b95c1e4u,
            0x85aac368u, 0x82cd8699u, 0x8164d1f4u, 0x80b1ed50u, 0x8058d7d3u};
    const int32_t whole = ql_asr32(exposure_q8, 8);
    const uint32_t fraction = (uint32_t)(exposure_q8 - whole * 256);
    ql_real_t r = {0x80000000u, 0};

    r.e = (int16_t)(radiance_exp + whole - 31);
    for (unsigned i = 0; i < 8; i++) {
        if (fraction >> (7 - i) & 1u) {
            const ql_real_t factor = {root[i], -31};

            r = ql_real_mul(r, factor);
        }
    }
    return r;
}
