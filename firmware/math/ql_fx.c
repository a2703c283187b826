/* ql_fx.c - long multiplication and division by a 16-bit number */
/* SPDX-License-Identifier: MIT */

#include "math/ql_fx.h"

#if QL_CFG_SMALL
int64_t ql_mul_s64_u16(int64_t a, uint16_t b)
{
    uint64_t sum = 0;

    for (uint64_t part = (uint64_t)a; b != 0; part += part, b >>= 1) {
        if (b & 1u) {
            sum += part;
        }
    }
    return ql_i64(sum);
}
#endif

int64_t ql_div_s64_u16(int64_t a, uint16_t b)
{
    uint64_t quotient = ql_abs64(a);
    uint32_t rest = 0;

    /* School division, bit by bit: digits of the quotient come in where those
     * of the dividend go out. rest < b, so twice that and a bit fits. */
    for (unsigned i = 0; i < 64; i++) {
        rest = rest << 1 | (uint32_t)(quotient >> 63);
        quotient <<= 1;
        if (rest >= b) {
            rest -= b;
            quotient |= 1u;
        }
    }
    return a < 0 ? ql_i64(0u - quotient) : ql_i64(quotient);
}
