/* ql_real_log.h - logarithm and power to the base of 2 of real numbers */
/* SPDX-License-Identifier: MIT */

/* A real number has no sign, so logarithms are those of numbers below 1 and
 * exponents those of powers below 1, without their minus. Both keep their bits
 * where they are tiny. */

#ifndef QL_REAL_LOG_H
#define QL_REAL_LOG_H

#include "math/ql_real.h"

/* No power is below 2^-this: it is zero. */
#define QL_REAL_LOG_MAX 4096u

/* Logarithm of a number below 1.
 *
 *   u       real  in (0, 1), 2^-4096 or more
 *   w       real  1 - u, as exactly as it is known
 *   return  real  -log2(u)
 *
 * Error: relative, 2^-26.
 * Cost:  nine multiplications and one look-up; near 1 seven multiplications.
 */
ql_real_t ql_real_log_minus_log2(ql_real_t u, ql_real_t w);

/* What a power of 1/2 is below 1.
 *
 *   y       real  in [0, 2^21]
 *   return  real  1 - 2^-y, below 1
 *
 * Error: relative, 2^-26.
 * Cost:  about six multiplications and one look-up.
 */
ql_real_t ql_real_log_decay(ql_real_t y);

/* A power of 1/2.
 *
 *   y       real  in [0, 2^21]
 *   return  real  2^-y; 0 below 2^-QL_REAL_LOG_MAX
 *
 * Error: relative, 2^-29.
 * Cost:  as ql_real_log_decay().
 */
ql_real_t ql_real_log_half_to_the(ql_real_t y);

#endif
