/* ql_meter.c - the exposure that a picture wants, from a few of its cells */
/* SPDX-License-Identifier: MIT */

#include "film/ql_meter.h"

#if QL_CFG_METER

#define MIDDLE_GREY_Q8 (-633) /* log2 0.18 */

/* log2 of n > 0, s.8: the mantissa's by a parabola, off by 0.02 */
static int16_t log2_q8(uint64_t n)
{
    const unsigned zeros = ql_clz64(n);
    const uint32_t m = (uint32_t)(n << zeros >> 55 & 255u);

    return (int16_t)(256 * (63 - (int)zeros) +
                     (int)(m + (m * (256u - m) * 88u >> 16)));
}

void ql_meter_add(ql_meter_t *meter, const ql_sum_t *sum)
{
    static const uint8_t weight[3] = {54, 183, 19};
    const uint64_t most = ((uint64_t)1 << 56) - 1;
    uint64_t luminance = 0; /* < 2^64: the weights are 256 together */
    int16_t stops;
    unsigned i;

    for (i = 0; i < 3; i++) {
        luminance += weight[i] * (sum->rgb[i] < most ? sum->rgb[i] : most);
    }
    if (luminance == 0) {
        return;
    }
    QL_ASSERT(meter->count < QL_METER_SIDE * QL_METER_SIDE);
    /* of the mean: 2^8 of weights, 2^24 of the sum, 2^3 samples */
    stops = (int16_t)(log2_q8(luminance) - 256 * (8 + QL_SUM_BITS + 3));
    for (i = meter->count++; i > 0 && meter->stops_q8[i - 1] > stops; i--) {
        meter->stops_q8[i] = meter->stops_q8[i - 1];
    }
    meter->stops_q8[i] = stops;
}

int16_t ql_meter_stops(const ql_meter_t *meter)
{
    const unsigned count = meter->count;
    int32_t sum = 0; /* of 64 numbers of 15 bits */
    int16_t stops, most;

    if (count == 0) {
        return 0;
    }
    for (unsigned i = 0; i < count; i++) {
        sum += meter->stops_q8[i];
    }
    stops = (int16_t)(MIDDLE_GREY_Q8 - sum / (int32_t)count);
    most = (int16_t)-meter->stops_q8[(count * 9u - 1) / 10u];
    return stops < most ? stops : most;
}

#endif
