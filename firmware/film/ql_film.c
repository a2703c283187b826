/* ql_film.c - add up contributions, take the mean */
/* SPDX-License-Identifier: MIT */

#include "film/ql_film.h"

#include "sample/ql_hash.h"

/* value m / 2^down: half up, or if it is faint up with the chance of what is
 * cut off, so that its mean is the number itself. Above QL_CONTRIBUTION_MAX
 * where it does not fit. */
static QL_NOINLINE uint64_t rounded(
        uint32_t value, uint32_t m, int32_t down, uint32_t key, ql_diag_t *diag)
{
    const uint64_t exact = ql_product_u32(value, m); /* < 2^64 - 2^33 */
    uint64_t fixed = 0;
    uint32_t more = 0x80000000u;

    if (down <= 0) {
        return down > -40 && exact <= QL_CONTRIBUTION_MAX >> -down
                       ? exact << -down
                       : QL_CONTRIBUTION_MAX + 1;
    }
    if (down < 32) { /* value or more, which was rounded as coarsely */
        return ((exact >> (down - 1)) + 1) >> 1;
    }
    if (down < 96) {
        fixed = exact >> (down - 32); /* 32 fraction bits */
    }
    if (fixed >> 32 < QL_FAINT) {
        more = ql_hash32(key + (uint32_t)exact);
        if ((uint32_t)fixed != 0 || fixed == 0) {
            QL_DIAG_COUNT(diag, faint);
        }
    }
    return (fixed + more) >> 32;
}

static void add_channel(uint64_t *sum, uint32_t value, uint32_t m, int32_t down,
        uint32_t key, ql_diag_t *diag)
{
    uint64_t add = 0;

    /* Most contributions are below 2^31: the product's high word decides. */
    if (!QL_CFG_SMALL && down > 32 && down < 64) {
        const uint32_t twice = ql_mulhi_u32(value, m) >> (down - 33);

        add = (twice >> 1) + (twice & 1u);
        add = twice >> 1 < QL_FAINT ? 0 : add;
    }
    if (add == 0) {
        add = rounded(value, m, down, key, diag);
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

void ql_film_add(ql_sum_t *sum, const ql_uq31_t value[3], ql_real_t scale,
        uint32_t key, ql_diag_t *diag)
{
    /* value m 2^(e - 31 + 24) */
    const int32_t down = (int32_t)7 - scale.e;

    for (unsigned i = 0; i < 3; i++) {
        if (value[i] != 0 && scale.m != 0) { /* most surfaces emit nothing */
            add_channel(&sum->rgb[i], value[i], scale.m, down, key, diag);
        }
    }
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

ql_real_t ql_film_exposure(int16_t radiance_exp, int32_t exposure_q8)
{
    /* 2^(1/2), 2^(1/4), ... 2^(1/256), u1.31 */
    static const uint32_t root[8] = {0xb504f334u, 0x9837f052u, 0x8b95c1e4u,
            0x85aac368u, 0x82cd8699u, 0x8164d1f4u, 0x80b1ed50u, 0x8058d7d3u};
    const int32_t whole = ql_asr32(exposure_q8, 8);
    const uint32_t fraction = (uint32_t)(exposure_q8 - whole * 256);
    ql_real_t r = ql_real_scale(QL_REAL_ONE, radiance_exp + whole);

    for (unsigned i = 0; i < 8; i++) {
        if (fraction >> (7 - i) & 1u) {
            r = ql_real_mul(r, QL_REAL(root[i], -31));
        }
    }
    return r;
}
