/* test_shading.c - unit normals and cosines against exact ones */
/* SPDX-License-Identifier: MIT */

#include "trace/surface/ql_shading.h"
#include "support/seen_surface.h"

TEST(cosines_are_within_their_bounds)
{
    double worst = 0, smooth = 0;

    state = 2;
    for (long k = 0; k < MANY(300000); k++) {
        const int32_t most = 0x1fffffff >> stats_random_below(&state, 25);
        const ql_vec3_t w = random_vec(most);
        double exact, got;

        set_normal(random_normal());
        exact = dot(from_vec(w), normal());
        got = real(ql_shading_cosine(&surface, w));
        CHECK((got > 0) == (ql_vec_dot(w, surface.n) > 0), "sign of %g", exact);
        if (exact > 0x1p-20 * most) { /* below, the double cancels */
            worst = fmax(worst, fabs(got / exact - 1));
            CHECK(fabs(got / exact - 1) <= 0x1p-26, "%.12g, not %.12g", got,
                    exact);
        }
#if QL_CFG_SMOOTH
        {
            const point_t shade = random_unit();
            const double size = sqrt(dot(from_vec(w), from_vec(w)));
            const bool above = ql_vec_dot(w, surface.n) > 0;

            surface.smooth = true;
            surface.shade = to_q29(shade);
            got = real(ql_shading_cosine(&surface, w));
            exact = above ? fmax(0, dot(from_vec(w), shade)) : 0;
            smooth = fmax(smooth, fabs(got - exact) / size);
            CHECK(fabs(got - exact) <= 0x1p-28 * size, "%.12g, not %.12g", got,
                    exact);
        }
#endif
    }
    NOTE("worst 2^%.2f flat, 2^%.2f smooth", log2(worst),
            log2(fmax(smooth, 1e-30)));
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_shading", argc, argv);
    RUN(cosines_are_within_their_bounds);
    return TEST_END();
}
