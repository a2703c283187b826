/* test_scene_soft.c - the real numbers qlux-scene computes with */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "support/ql_test.h"
#include "lib/math/soft.h"

static uint64_t state = 1;

static uint64_t next(void)
{
    uint64_t z = (state += 0x9e3779b97f4a7c15u);

    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

/* Any size, both signs. */
static double random_double(void)
{
    const double m = (double)(next() >> 11) + 0.5;

    return ldexp(next() & 1 ? m : -m, (int)(next() % 200) - 150);
}

static double relative(double got, double wanted)
{
    return wanted == 0 ? fabs(got) : fabs(got / wanted - 1);
}

TEST(doubles_become_soft_without_loss)
{
    static const double nasty[] = {0, 1, -1, 0x1p-1074, 0x1p-1022, 1e300,
            -1e300, 0x1.fffffffffffffp+1000, 0x1.fffffffffffffp-1000};

    for (int i = 0; i < 100000; i++) {
        const double x = i < 9 ? nasty[i] : random_double();
        const double y = soft_double(soft_from(x));

        CHECK(!(x < y) && !(x > y), "%a came back as %a", x, y);
    }
    NOTE("100000 inputs");
}

TEST(arithmetic_agrees_with_double_to_its_precision)
{
    double worst = 0;

    for (int i = 0; i < 100000; i++) {
        const double x = random_double(), y = random_double();
        const soft_t a = soft_from(x), b = soft_from(y);
        const double errors[] = {
                relative(soft_double(soft_add(a, b)), x + y),
                relative(soft_double(soft_sub(a, b)), x - y),
                relative(soft_double(soft_mul(a, b)), x * y),
                relative(soft_double(soft_div(a, b)), x / y),
                relative(soft_double(soft_sqrt(soft_mul(a, a))), fabs(x)),
        };

        for (int k = 0; k < 5; k++) {
            worst = errors[k] > worst ? errors[k] : worst;
            CHECK(errors[k] < 4e-16, "%a, %a: operation %d is off by %g", x, y,
                    k, errors[k]);
        }
    }
    NOTE("worst %.2g", worst);
}

TEST(sums_that_cancel_are_exact)
{
    for (int i = 0; i < 100000; i++) {
        const double x = random_double();
        const double y = x * (1 + (double)(next() % 1000) * 0x1p-52);
        /* within a factor of two: the difference is a double */
        const double wanted = x - y;
        const double got = soft_double(soft_sub(soft_from(x), soft_from(y)));

        CHECK(!(got < wanted) && !(got > wanted), "%a - %a gave %a", x, y, got);
    }
    NOTE("100000 inputs");
}

TEST(division_undoes_multiplication_of_integers)
{
    for (int i = 0; i < 100000; i++) {
        const int64_t a = (int64_t)(next() >> 33) + 1;
        const int64_t b = (int64_t)(next() >> 33) + 1;
        const soft_t p = soft_mul(soft_int(a, 0), soft_int(b, 0));

        CHECK(soft_compare(soft_div(p, soft_int(b, 0)), soft_int(a, 0)) == 0,
                "%lld * %lld", (long long)a, (long long)b);
        CHECK(soft_compare(soft_sqrt(soft_mul(soft_int(a, 0), soft_int(a, 0))),
                      soft_int(a, 0)) == 0,
                "sqrt(%lld^2)", (long long)a);
    }
    NOTE("100000 inputs");
}

TEST(rounding_goes_to_nearest_with_halves_away_from_zero)
{
    static const struct {
        double x;
        int bits;
        int64_t wanted;
    } cases[] = {{0, 0, 0}, {0.5, 0, 1}, {-0.5, 0, -1},
            {0.49999999999999994, 0, 0}, {1.5, 0, 2}, {2.5, 0, 3},
            {-2.5, 0, -3}, {1, 31, 0x80000000}, {0x1p-33, 32, 1},
            {0x1p-34, 32, 0}, {-1e300, 0, -INT64_MAX}, {1e300, 0, INT64_MAX},
            {4503599627370497.0, 0, 4503599627370497}};

    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const int64_t got = soft_round(soft_from(cases[i].x), cases[i].bits);

        CHECK(got == cases[i].wanted, "%.17g << %d gave %lld", cases[i].x,
                cases[i].bits, (long long)got);
    }
    NOTE("13 cases");
}

TEST(tan_of_half_an_angle_agrees_with_libm)
{
    double worst = 0;

    for (int i = 1; i < 18000; i++) {
        const double degrees = i * 0.01;
        const double wanted = tan(degrees * (3.141592653589793238 / 360));
        const double got = soft_double(soft_tan_half(soft_from(degrees)));
        const double error = relative(got, wanted);

        worst = error > worst ? error : worst;
        /* libm sees an angle rounded to a double: 2^-53 / cos */
        CHECK(error < 4e-16 * (1 + wanted), "tan(%g / 2): off by %g", degrees,
                error);
    }
    CHECK(soft_round(soft_tan_half(soft_int(90, 0)), 60) == (int64_t)1 << 60,
            "tan(45 degrees) is not 1 to 60 bits: %lld",
            (long long)soft_round(soft_tan_half(soft_int(90, 0)), 60));
    NOTE("worst %.2g", worst);
}

TEST(wide_integers_divide_and_take_roots_exactly)
{
    for (int i = 0; i < 20000; i++) {
        const uint64_t b = next() >> next() % 64 | 1;
        u128_t a = {next(), next()}, back, next_square;
        uint64_t rest, root;
        u128_t q;

        a = u128_shift_right(a, (unsigned)(next() % 128));
        q = u128_div(a, b, &rest);
        back = u128_mul(q.low, b);
        back.high += q.high * b; /* the product is a: no carry is lost */
        back = u128_add(back, (u128_t){0, rest});
        CHECK(rest < b && u128_compare(back, a) == 0, "%llx%016llx / %llx",
                (unsigned long long)a.high, (unsigned long long)a.low,
                (unsigned long long)b);
        root = u128_sqrt(a);
        next_square = u128_add(u128_mul(root, root), (u128_t){0, root});
        CHECK(u128_compare(u128_mul(root, root), a) <= 0 &&
                        u128_compare(a,
                                u128_add(next_square, (u128_t){0, root})) <= 0,
                "sqrt(%llx%016llx)", (unsigned long long)a.high,
                (unsigned long long)a.low);
    }
    NOTE("20000 inputs");
}

TEST(sines_of_half_turns_agree_with_libm)
{
    double worst = 0;

    for (int n = 1; n <= 4096; n = n < 8 ? n + 1 : 2 * n) {
        for (int i = 0; i < n; i++) {
            const double x = (i + 0.5) / n;
            const double got = soft_double(soft_sin_pi(
                    soft_div(soft_int(2 * i + 1, -1), soft_int(n, 0))));
            const double off = fabs(got - sin(x * 3.14159265358979323846));

            worst = off > worst ? off : worst;
        }
    }
    /* libm's half an ulp and that of its argument, up to pi */
    CHECK(worst < 4e-16, "off by %g", worst);
    NOTE("worst %.2g", worst);
}

TEST(floors_of_soft_numbers_are_exact)
{
    for (int e = -70; e <= 64; e++) {
        const soft_t a = {false, e, 0xc90fdaa22168c235u};
        const u128_t got = soft_floor(a);
        u128_t wanted = {0, 0};

        for (int bit = 0; bit < 64; bit++) {
            const int to = bit + e;

            if ((a.m >> bit & 1) != 0 && to >= 0) {
                wanted.low |= to < 64 ? (uint64_t)1 << to : 0;
                wanted.high |= to >= 64 ? (uint64_t)1 << (to - 64) : 0;
            }
        }
        CHECK(u128_compare(got, wanted) == 0, "2^%d: %llx%016llx", e,
                (unsigned long long)got.high, (unsigned long long)got.low);
    }
    CHECK(soft_floor(soft_int(0, 0)).low == 0, "0");
}

TEST(arcs_of_tangents_agree_with_libm)
{
    double worst = 0;

    for (int i = 0; i < 20000; i++) {
        const double x = ldexp((double)(next() >> 11), (int)(next() % 80) - 93);
        const double got = soft_double(soft_atan(soft_from(x)));

        worst = fmax(worst, fabs(got - atan(x)));
    }
    CHECK(worst < 0x1p-44, "%g", worst);
    CHECK(soft_atan(soft_int(0, 0)).m == 0, "0");
    NOTE("off by 2^%.1f at most", log2(worst));
}

int main(int argc, char **argv)
{
    TEST_BEGIN("tools/scene_soft", argc, argv);
    RUN(doubles_become_soft_without_loss);
    RUN(arithmetic_agrees_with_double_to_its_precision);
    RUN(sums_that_cancel_are_exact);
    RUN(division_undoes_multiplication_of_integers);
    RUN(rounding_goes_to_nearest_with_halves_away_from_zero);
    RUN(tan_of_half_an_angle_agrees_with_libm);
    RUN(sines_of_half_turns_agree_with_libm);
    RUN(arcs_of_tangents_agree_with_libm);
    RUN(floors_of_soft_numbers_are_exact);
    RUN(wide_integers_divide_and_take_roots_exactly);
    return TEST_END();
}
