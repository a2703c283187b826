/* soft.c - real numbers of 64 bits precision, the same on every host */
/* SPDX-License-Identifier: MIT */

#include "lib/math/soft.h"

#include <math.h>
#include <stddef.h>

u128_t u128_mul(uint64_t a, uint64_t b)
{
    const uint64_t a0 = a & 0xffffffffu, a1 = a >> 32;
    const uint64_t b0 = b & 0xffffffffu, b1 = b >> 32;
    const uint64_t low = a0 * b0;
    /* (2^32 - 1)^2 + 2 (2^32 - 1) < 2^64 */
    const uint64_t middle = a1 * b0 + (low >> 32);
    const uint64_t cross = a0 * b1 + (middle & 0xffffffffu);
    u128_t r;

    r.high = a1 * b1 + (middle >> 32) + (cross >> 32);
    r.low = cross << 32 | (low & 0xffffffffu);
    return r;
}

u128_t u128_add(u128_t a, u128_t b)
{
    u128_t r;

    r.low = a.low + b.low;
    r.high = a.high + b.high + (r.low < a.low);
    return r;
}

u128_t u128_sub(u128_t a, u128_t b)
{
    u128_t r;

    r.low = a.low - b.low;
    r.high = a.high - b.high - (a.low < b.low);
    return r;
}

int u128_compare(u128_t a, u128_t b)
{
    if (a.high != b.high) {
        return a.high < b.high ? -1 : 1;
    }
    return a.low == b.low ? 0 : a.low < b.low ? -1 : 1;
}

u128_t u128_shift_right(u128_t a, unsigned bits)
{
    u128_t r = {0, 0};

    if (bits == 0) {
        return a;
    }
    if (bits < 64) {
        r.high = a.high >> bits;
        r.low = a.high << (64 - bits) | a.low >> bits;
    } else if (bits < 128) {
        r.low = a.high >> (bits - 64);
    }
    return r;
}

static u128_t shift_left(u128_t a, unsigned bits)
{
    u128_t r = {0, 0};

    if (bits == 0) {
        return a;
    }
    if (bits < 64) {
        r.high = a.high << bits | a.low >> (64 - bits);
        r.low = a.low << bits;
    } else if (bits < 128) {
        r.high = a.low << (bits - 64);
    }
    return r;
}

u128_t u128_div(u128_t a, uint64_t b, uint64_t *rest)
{
    u128_t q = {0, 0};
    uint64_t r = a.high % b;

    q.high = a.high / b;
    for (int i = 63; i >= 0; i--) {
        const bool carry = r >> 63 != 0; /* r < b, so 2 r + 1 < 2^65 */

        r = r << 1 | (a.low >> i & 1u);
        if (carry || r >= b) {
            r -= b;
            q.low |= (uint64_t)1 << i;
        }
    }
    if (rest != NULL) {
        *rest = r;
    }
    return q;
}

unsigned u128_bits(u128_t a)
{
    uint64_t word = a.high != 0 ? a.high : a.low;
    unsigned bits = a.high != 0 ? 64 : 0;

    for (unsigned step = 32; step > 0; step /= 2) {
        if (word >> step != 0) {
            word >>= step;
            bits += step;
        }
    }
    return bits + (unsigned)word; /* word is 0 or 1 now */
}

uint64_t u128_sqrt(u128_t a)
{
    uint64_t root = 0;

    for (int i = 63; i >= 0; i--) {
        const uint64_t trial = root | (uint64_t)1 << i;

        if (u128_compare(u128_mul(trial, trial), a) <= 0) {
            root = trial;
        }
    }
    return root;
}

/* a * 2^e as a real, rounded to nearest. */
static soft_t normalise(bool negative, u128_t a, int32_t e)
{
    const unsigned bits = u128_bits(a);
    soft_t r = {negative, 0, 0};

    if (bits == 0) {
        r.negative = false;
        return r;
    }
    a = shift_left(a, 128 - bits);
    r.e = e + (int32_t)bits - 64;
    r.m = a.high + (a.low >> 63);
    if (r.m == 0) { /* rounded up to 2^64 */
        r.m = (uint64_t)1 << 63;
        r.e++;
    }
    return r;
}

soft_t soft_from(double x)
{
    int e;
    u128_t m = {0, 0};

    /* frexp, ldexp by 53 and the conversion are exact for a double */
    m.low = (uint64_t)ldexp(frexp(fabs(x), &e), 53);
    return normalise(x < 0, m, e - 53);
}

soft_t soft_int(int64_t x, int e)
{
    u128_t m = {0, 0};

    m.low = x < 0 ? 0u - (uint64_t)x : (uint64_t)x;
    return normalise(x < 0, m, e);
}

soft_t soft_negate(soft_t a)
{
    a.negative = !a.negative && a.m != 0;
    return a;
}

/* |a| against |b| */
static int compare_size(soft_t a, soft_t b)
{
    if (a.m == 0 || b.m == 0) {
        return (a.m != 0) - (b.m != 0);
    }
    if (a.e != b.e) {
        return a.e < b.e ? -1 : 1;
    }
    return a.m == b.m ? 0 : a.m < b.m ? -1 : 1;
}

int soft_compare(soft_t a, soft_t b)
{
    if (a.negative != b.negative) {
        return a.negative ? -1 : 1;
    }
    return a.negative ? compare_size(b, a) : compare_size(a, b);
}

soft_t soft_add(soft_t a, soft_t b)
{
    u128_t x = {0, 0}, y = {0, 0};
    int32_t e;

    if (compare_size(a, b) < 0) {
        const soft_t swap = a;

        a = b;
        b = swap;
    }
    if (b.m == 0 || a.e - b.e >= 64) {
        return a;
    }
    /* a in the upper 64 of 127 bits, so that a sum fits */
    x.high = a.m >> 1;
    x.low = a.m << 63;
    y.high = b.m >> 1;
    y.low = b.m << 63;
    y = u128_shift_right(y, (unsigned)(a.e - b.e));
    e = a.e - 63;
    return normalise(a.negative,
            a.negative == b.negative ? u128_add(x, y) : u128_sub(x, y), e);
}

soft_t soft_sub(soft_t a, soft_t b)
{
    return soft_add(a, soft_negate(b));
}

soft_t soft_mul(soft_t a, soft_t b)
{
    return normalise(a.negative != b.negative, u128_mul(a.m, b.m), a.e + b.e);
}

soft_t soft_div(soft_t a, soft_t b)
{
    u128_t n = {0, 0};

    n.high = a.m;
    return normalise(
            a.negative != b.negative, u128_div(n, b.m, NULL), a.e - b.e - 64);
}

soft_t soft_sqrt(soft_t a)
{
    u128_t n = {0, 0}, root = {0, 0};
    const bool odd = (a.e & 1) != 0, negative = false;

    /* m 2^64 2^(e - 64), or m 2^63 2^(e - 63): an even exponent */
    n.high = odd ? a.m >> 1 : a.m;
    n.low = odd ? a.m << 63 : 0;
    root.low = u128_sqrt(n);
    return normalise(negative, root, (a.e - (odd ? 63 : 64)) / 2);
}

/* sum of (-1)^k x^(2k + first) / (2k + first)!, for 0 < x < pi/2 */
static soft_t series(soft_t x, int first)
{
    const soft_t square = soft_mul(x, x);
    soft_t term = first == 1 ? x : soft_int(1, 0);
    soft_t sum = term;

    /* (pi/2)^34 / 34! < 2^-105: 16 terms more than suffice */
    for (int k = first + 1; k < 34; k += 2) {
        term = soft_div(soft_mul(term, square), soft_int(k * (k + 1), 0));
        term = soft_negate(term);
        if (term.m == 0) {
            break;
        }
        sum = soft_add(sum, term);
    }
    return sum;
}

soft_t soft_pi(void)
{
    static const soft_t pi = {false, -62, 0xc90fdaa22168c235u};

    return pi;
}

soft_t soft_tan_half(soft_t degrees)
{
    const soft_t x = soft_div(soft_mul(degrees, soft_pi()), soft_int(360, 0));

    return soft_div(series(x, 1), series(x, 0));
}

soft_t soft_sin_pi(soft_t x)
{
    if (soft_compare(x, soft_int(1, -1)) > 0) {
        x = soft_sub(soft_int(1, 0), x);
    }
    return series(soft_mul(x, soft_pi()), 1);
}

soft_t soft_atan(soft_t x)
{
    const soft_t one = soft_int(1, 0);
    const bool steep = soft_compare(x, one) > 0;
    soft_t square, sum = soft_int(0, 0);

    x = steep ? soft_div(one, x) : x;
    /* half the angle, three times: x is tan(pi / 32) at most, below 0.0985 */
    for (int i = 0; i < 3; i++) {
        x = soft_div(
                x, soft_add(one, soft_sqrt(soft_add(one, soft_mul(x, x)))));
    }
    /* x - x^3 / 3 + ..; 8 times 0.0985^13 / 13 is below 2^-44 */
    square = soft_mul(x, x);
    for (int k = 11; k > 0; k -= 2) {
        sum = soft_sub(soft_div(one, soft_int(k, 0)), soft_mul(square, sum));
    }
    sum = soft_mul(sum, x);
    sum.e += 3;
    return steep ? soft_sub(soft_div(soft_pi(), soft_int(2, 0)), sum) : sum;
}

u128_t soft_floor(soft_t a)
{
    u128_t m = {0, 0};

    m.low = a.m;
    if (a.e >= 0) {
        return shift_left(m, (unsigned)a.e);
    }
    return a.e > -64 ? u128_shift_right(m, (unsigned)-a.e) : (u128_t){0, 0};
}

int64_t soft_round(soft_t a, int bits)
{
    const int64_t t = (int64_t)a.e + bits;
    uint64_t size;

    if (a.m == 0 || t < -64) {
        return 0;
    }
    if (t >= 0) {
        size = INT64_MAX;
    } else if (t == -64) {
        size = 1; /* m >= 2^63 */
    } else {
        size = (a.m >> -t) + (a.m >> (-t - 1) & 1u);
    }
    if (size > INT64_MAX) {
        size = INT64_MAX;
    }
    return a.negative ? -(int64_t)size : (int64_t)size;
}

double soft_double(soft_t a)
{
    /* at most 2^53, so no register's width rounds it again */
    const uint64_t m = (a.m >> 11) + (a.m >> 10 & 1u);
    const double size = ldexp((double)m, a.e + 11);

    return a.negative ? -size : size;
}
