/* ql_clamp.c - bright contributions are cut, and what is cut off is added up */
/* SPDX-License-Identifier: MIT */

#include "film/ql_clamp.h"

#if QL_CFG_CLAMP

void ql_clamp_begin(ql_clamp_t *clamp, uint32_t clamp_q16, int16_t radiance_exp)
{
    static const ql_clamp_t nothing;

    *clamp = nothing;
    if (clamp_q16 != 0) {
        clamp->limit = ql_real_scale(
                ql_real_from_u64(clamp_q16), -16 - (int32_t)radiance_exp);
    }
}

static void add_up(uint64_t *sum, uint64_t more)
{
    *sum = more > UINT64_MAX - *sum ? UINT64_MAX : *sum + more;
}

static uint32_t brightest(const ql_uq31_t value[3])
{
    uint32_t most = value[0];

    most = value[1] > most ? value[1] : most;
    return value[2] > most ? value[2] : most;
}

void ql_clamp_add(ql_sum_t *sum, ql_clamp_t *clamp, const ql_uq31_t value[3],
        ql_real_t scale, uint32_t key, ql_diag_t *diag)
{
    /* value is u1.31 */
    const ql_real_t most =
            ql_real_scale(ql_real_from_u64(brightest(value)), -31);
    ql_sum_t whole = {{0, 0, 0}}, kept = {{0, 0, 0}};
    ql_diag_t not_counted = {0};

    if (clamp == NULL || clamp->limit.m == 0 || most.m == 0 ||
            ql_real_sub(ql_real_mul(most, scale), clamp->limit).m == 0) {
        ql_film_add(sum, value, scale, key, diag);
        return;
    }
    ql_film_add(&whole, value, scale, key, &not_counted);
    ql_film_add(&kept, value, ql_real_mul(clamp->limit, ql_real_recip(most)),
            key, diag);
    for (unsigned i = 0; i < 3; i++) {
        /* by chance a faint channel may be rounded up although it is less */
        const uint64_t less =
                kept.rgb[i] < whole.rgb[i] ? kept.rgb[i] : whole.rgb[i];

        add_up(sum->rgb + i, less);
        add_up(clamp->cut + i, whole.rgb[i] - less);
    }
}

#endif
