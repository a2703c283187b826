/* ql_fx.c - long division by a 16-bit number */
/* SPDX-License-Identifier: MIT */

#include "math/ql_fx.h"

int64_t ql_div_s64_u16(int64_t a, uint16_t b)
{
    const uint64_t size = ql_abs64(a);
    uint64_t quotient = 0;
    uint32_t rest = 0;

    /* School division with 16-bit digits: rest < b, so a digit fits. */
    for (unsigned shift = 64; shift > 0;) {
        uint32_t part;

        shift -= 16;
        part = rest << 16 | (uint32_t)(size >> shift & 0xffffu);
        quotient = quotient << 16 | part / b;
        rest = part % b;
    }
    return a < 0 ? ql_i64(0u - quotient) : ql_i64(quotient);
}
