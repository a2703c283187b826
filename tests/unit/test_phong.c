/* test_phong.c - the Phong lobe against its albedos; faults are rejected */
/* SPDX-License-Identifier: MIT */

#include "material/ql_phong.h"
#include "support/seen_phong.h"

#if QL_CFG_PHONG
/* The fault: the cosine left out of the weight. */
static double weight_without_cosine(draw_t draw)
{
    ql_bsdf_sample_t sample;

    return ql_bsdf_sample(&bsdf, density, draw.pick, draw.u, &sample, NULL)
                   ? channel(&sample.weight, 0) / cosine_to_normal(sample.wi)
                   : 0;
}

static double is_kept(draw_t draw)
{
    return drawn_weight(draw) > 0;
}

TEST(phong_lobes_have_the_albedos_of_the_table)
{
    double worst = 0;

    density = QL_DENSITY_BRDF;
    for (int i = 0; i < EXPONENTS; i++) {
        for (int k = 0; k < VIEWS; k++) {
            const double n = exponents[i], exact = albedos[i][k];
            estimate_t e;

            set_phong(0, 1, n, 1);
            see_at(views[k]);
            e = estimate(drawn_weight, 1024);
            worst = fmax(worst, fabs(e.mean - exact));
            CHECK(fabs(e.mean - exact) <= WITHIN(e),
                    "n = %g, %g degrees: %.8f +- %.8f, not %.8f", n, views[k],
                    e.mean, e.error, exact);
            CHECK(e.most <= (n + 2) / (n + 1) * (1 + 0x1p-29),
                    "n = %g, %g degrees: weight %.10f", n, views[k], e.most);
            CHECK(e.mean <= 1 + WITHIN(e), "n = %g: gains energy", n);
        }
    }
    NOTE("worst %.1e, %d albedos of 2^16 samples", worst, EXPONENTS * VIEWS);
}

/* Of a uniform lobe 1 - theta/180 is above the horizon, of a cosine lobe
 * (1 + cos)/2. */
TEST(phong_lobes_are_cut_at_the_horizon)
{
    density = QL_DENSITY_BRDF;
    for (int k = 0; k < VIEWS; k++) {
        estimate_t e;

        set_phong(0, 1, 0, 1);
        see_at(views[k]);
        e = estimate(is_kept, 256);
        CHECK(fabs(e.mean - (1 - views[k] / 180)) <= WITHIN(e) + 1e-4,
                "n = 0, %g degrees: %.6f +- %.6f", views[k], e.mean, e.error);
        set_phong(0, 1, 1, 1);
        see_at(views[k]);
        e = estimate(is_kept, 256);
        CHECK(fabs(e.mean - (1 + cos(views[k] * PI / 180)) / 2) <=
                        WITHIN(e) + 1e-4,
                "n = 1, %g degrees: %.6f +- %.6f", views[k], e.mean, e.error);
    }
}

TEST(phong_lobes_of_exponent_n_plus_1_are_rejected)
{
    const uint32_t count = QL_CFG_SAMPLERS & 2 ? 1024 : 16384; /* no Sobol */

    density = QL_DENSITY_BRDF;
    for (int i = 0; i < 3; i++) {
        estimate_t e;

        set_phong(0, 1, exponents[i] + 1, 1);
        see_at(60);
        e = estimate(drawn_weight, count);
        CHECK(fabs(e.mean - albedos[i][3]) > WITHIN(e), "n = %g: %.6f +- %.6f",
                exponents[i], e.mean, e.error);
    }
}

TEST(phong_weights_without_the_cosine_are_rejected)
{
    density = QL_DENSITY_BRDF;
    for (int i = 0; i < EXPONENTS; i++) {
        estimate_t e;

        set_phong(0, 1, exponents[i], 1);
        see_at(60);
        e = estimate(weight_without_cosine, 64);
        CHECK(fabs(e.mean - albedos[i][3]) > WITHIN(e), "n = %g: %.6f +- %.6f",
                exponents[i], e.mean, e.error);
    }
}

/* ---- The distribution --------------------------------------------------- */

enum { ROWS = 16, COLUMNS = 32, BINS = ROWS * COLUMNS };

/* p-value of 2^18 directions in bins that are equally likely for exponent n
 * about the mirror direction, worked out in double. */
static double chi2_p(double n)
{
    static uint32_t counts[BINS];
    const long count = 1L << 18;
    const ql_vec3_t incoming = incoming_at(normal(), 0.3, 2);
    const point_t in = unit(from_vec(incoming));
    const point_t axis = along(in, -2 * dot(in, normal()), normal());
    point_t s, t;

    memset(counts, 0, sizeof counts);
    across(axis, &s, &t);
    see(true, incoming);
    state = 5;
    for (long i = 0; i < count; i++) {
        const uint64_t bits = stats_random(&state);
        const ql_uniform2_t u = {(uint32_t)bits, (uint32_t)(bits >> 32)};
        ql_bsdf_sample_t sample;
        point_t w, apart;
        double at, turn;

        if (!ql_bsdf_sample(&bsdf, QL_DENSITY_BRDF, 0, u, &sample, NULL)) {
            return 0;
        }
        w = unit(from_vec(sample.wi));
        apart = along(w, -1, axis);
        at = -expm1(log1p(-fmin(dot(apart, apart) / 2, 1)) * (n + 1));
        turn = atan2(dot(w, t), dot(w, s)) / (2 * PI) + 0.5;
        counts[(int)fmin(at * ROWS, ROWS - 1) * COLUMNS +
                (int)(turn * COLUMNS) % COLUMNS]++;
    }
    return stats_chi2_p(
            stats_chi2_equal(counts, BINS, (double)count / BINS), BINS - 1);
}

TEST(phong_directions_match_their_density)
{
    double p;

    set_phong(0, 1, 40, 1);
    set_normal(tilted);
    p = chi2_p(40);
    CHECK(p > STATS_P_MIN, "p = %.3g", p);
    NOTE("p = %.2f, %d bins", p, BINS);
}

TEST(phong_directions_of_another_exponent_are_rejected)
{
    double p;

    set_phong(0, 1, 41.5, 1);
    set_normal(tilted);
    p = chi2_p(40);
    CHECK(p <= STATS_P_MIN, "p = %.3g", p);
    NOTE("p = %.1e", p);
}

#else

TEST(no_surface_is_phong_where_that_is_not_built)
{
    static const ql_blob_gloss_t built = {.kind = QL_LE16(QL_GLOSS_PHONG)};

    bsdf.gloss = &built;
    CHECK(!ql_phong_is(&bsdf), "it is");
}

#endif

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_phong", argc, argv);
#if QL_CFG_PHONG
    RUN(phong_lobes_have_the_albedos_of_the_table);
    RUN(phong_lobes_are_cut_at_the_horizon);
    RUN_IF(TABLES_EXACT, phong_lobes_of_exponent_n_plus_1_are_rejected);
    RUN(phong_weights_without_the_cosine_are_rejected);
    RUN(phong_directions_match_their_density);
    RUN(phong_directions_of_another_exponent_are_rejected);
#else
    RUN(no_surface_is_phong_where_that_is_not_built);
#endif
    return TEST_END();
}
