/* extreme_samplers.c - samplers, lobes at their ends: cases 1 to 5, 33 to 35 */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "support/picture/mini_scene.h"
#include "support/ql_double.h"
#include "support/ql_stats.h"
#include "support/ql_test.h"
#include "math/vec/ql_vec_unit.h"
#include "sample/lecture/ql_alias.h"
#include "warp/lecture/ql_warp_lecture.h"
#include "warp/ql_warp_cone.h"
#include "warp/ql_warp_hemisphere.h"
#include "warp/ql_warp_lobe.h"
#include "warp/ql_warp_plane.h"
#include "warp/ql_warp_sphere.h"
#include "warp/ql_warp_spherical.h"
#include "sample/ql_sampler.h"
#include "material/ql_bsdf.h"
#include "trace/ql_bvh.h"
#include "trace/surface/ql_surface_at.h"

#define ONE 0x1p-29 /* of s2.29 */

/* Largest error of a unit vector's length that the headers state. */
#if QL_CFG_PRECISION == 0
#define LENGTH_MAX 4.5e-5
#define DISK_MAX   2.1e-5
#else
#define LENGTH_MAX 5.1e-8
#define DISK_MAX   5.1e-8
#endif

static double length_of(ql_vec3_t v)
{
    return sqrt((double)v.x * v.x + (double)v.y * v.y + (double)v.z * v.z) *
           ONE;
}

static double longest; /* by how much a length was off */

static void check_unit(ql_vec3_t v, bool above, const char *what, unsigned c)
{
    const double off = fabs(length_of(v) - 1);

    CHECK(off <= LENGTH_MAX && (!above || v.z >= 0),
            "%s, corner %u: (%ld %ld %ld), length off by %g", what, c,
            (long)v.x, (long)v.y, (long)v.z, off);
    longest = fmax(longest, off);
}

/* ---- Ends -------------------------------------------------------------- */

/* Exponents of cos^m, u16.16; the last is the largest there is. */
static const ql_uq16_t powers[] = {0, 1, 1u << 16, 5u << 16, 20u << 16,
        1000u << 16, 65535u << 16, 0xffffffffu};
enum { POWERS = sizeof powers / sizeof powers[0] };

static void check_lobes(ql_uq32_t u1, ql_uq32_t u2, unsigned c)
{
    static const ql_real_t widths[] = {{0x80000000u, -31}, {0xffffffffu, -32},
            {0x80000000u, -60}, {0x80000000u, -126}, {0, 0}};

    check_unit(ql_warp_hemisphere_uniform(u1, u2), true, "hemisphere", c);
    check_unit(ql_warp_lecture_naive(u1, u2), true, "naive", c);
    check_unit(ql_warp_lecture_cosine(u1, u2), true, "cosine", c);
    check_unit(ql_warp_sphere(u1, u2), false, "sphere", c);
    for (unsigned i = 0; i < POWERS; i++) {
        ql_uq31_t s;

        check_unit(ql_warp_lobe(ql_warp_lobe_inverse(powers[i]), u1, u2, &s),
                true, "power", c);
        CHECK(s <= QL_UQ31_ONE, "power %lu: s %lu", (unsigned long)powers[i],
                (unsigned long)s);
    }
    for (unsigned i = 0; i < sizeof widths / sizeof widths[0]; i++) {
        check_unit(ql_warp_cone(widths[i], u1, u2), true, "cone", c);
    }
}

static void check_plane(ql_uq32_t u1, ql_uq32_t u2, unsigned c)
{
    ql_q29_t x, y;
    uint32_t b1, b2;

    ql_warp_plane_disk(u1, u2, &x, &y);
    CHECK(hypot(x, y) * ONE <= 1 + DISK_MAX, "disk, corner %u: %.9f", c,
            hypot(x, y) * ONE);
    ql_warp_plane_triangle(u1, u2, &b1, &b2);
    CHECK((uint64_t)b1 + b2 < (uint64_t)1 << QL_BARY_BITS,
            "triangle, corner %u: %lu + %lu", c, (unsigned long)b1,
            (unsigned long)b2);
    CHECK(ql_warp_lecture_tent_pdf(ql_warp_lecture_tent(u1, u2)) > 0,
            "tent, corner %u", c);
}

/* About the axes and a slanted normal the cosine direction is above them. */
static void check_cosine(ql_uq32_t u1, ql_uq32_t u2, unsigned c)
{
    static const ql_vec3_t normals[] = {{1l << 29, 0, 0}, {-(1l << 29), 0, 0},
            {0, 1l << 29, 0}, {0, -(1l << 29), 0}, {0, 0, 1l << 29},
            {0, 0, -(1l << 29)}, {322122547, 0, 429496730}};

    for (unsigned i = 0; i < sizeof normals / sizeof normals[0]; i++) {
        const ql_vec3_t n = normals[i];
        const ql_vec3_t v = ql_warp_hemisphere_cosine(n, u1, u2);
        const ql_vec3_t d = ql_vec_to_dir(v);
        const double cosine =
                ((double)v.x * n.x + (double)v.y * n.y + (double)v.z * n.z) *
                ONE * ONE;

        /* of length 2 cos: n.v = |v|^2 / 2 */
        CHECK(fabs(cosine - length_of(v) * length_of(v) / 2) < 4 * LENGTH_MAX,
                "corner %u, normal %u: %g of length %g", c, i, cosine,
                length_of(v));
        CHECK(ql_abs32(d.x) <= 1ul << QL_DIR_BITS &&
                        ql_abs32(d.y) <= 1ul << QL_DIR_BITS &&
                        ql_abs32(d.z) <= 1ul << QL_DIR_BITS,
                "corner %u, normal %u: rounded too large", c, i);
    }
}

static void check_triangle_seen(ql_uq32_t u1, ql_uq32_t u2, unsigned c)
{
    static const ql_vec3_t a = {10000, 0, 0}, b = {0, 10000, 0};
    static const ql_vec3_t far = {0, 0, 10000};
    ql_warp_spherical_t t;

    CHECK(ql_warp_spherical_begin(&t, a, b, far), "an octant");
    check_unit(ql_warp_spherical(&t, u1, u2), false, "octant", c);
}

TEST(case_01_every_sampler_stays_in_its_domain_at_all_four_corners)
{
    static const ql_uq32_t ends[] = {
            0, 1, 0x7fffffffu, 0x80000000u, 0xfffffffeu, 0xffffffffu};

    longest = 0;
    for (unsigned c = 0; c < 36; c++) {
        check_lobes(ends[c % 6], ends[c / 6], c);
        check_plane(ends[c % 6], ends[c / 6], c);
        check_cosine(ends[c % 6], ends[c / 6], c);
        check_triangle_seen(ends[c % 6], ends[c / 6], c);
    }
    NOTE("20 maps, corners and middle; lengths within %.1e", longest);
}

/* ---- u is below 1 ------------------------------------------------------ */

static double midpoint_of(ql_uq32_t u)
{
    const ql_real_t r = ql_real_midpoint(u);

    return ldexp(r.m, r.e);
}

TEST(case_02_random_numbers_are_above_0_and_below_1)
{
    static const uint32_t counts[] = {1, 2, 3, 100, 1000, 16384, 65535};
    uint32_t lowest = 0xffffffffu, highest = 0;

    CHECK(midpoint_of(0) == 0x1p-33, "u = 0 stands for %g", midpoint_of(0));
    CHECK(midpoint_of(0xffffffffu) < 1, "u = max stands for %.17g",
            midpoint_of(0xffffffffu));
    for (unsigned i = 0; i < sizeof counts / sizeof counts[0]; i++) {
        CHECK(ql_mulhi_u32(0xffffffffu, counts[i]) == counts[i] - 1,
                "u = max of %lu: entry %lu", (unsigned long)counts[i],
                (unsigned long)ql_mulhi_u32(0xffffffffu, counts[i]));
    }
    for (unsigned sobol = 0; sobol < 2; sobol++) {
        ql_sampler_t sampler;

        ql_sampler_begin(&sampler, (uint8_t)sobol, 1, 2, 3);
        for (uint32_t i = 0; i < 1ul << 20; i++) {
            ql_uq32_t u;

            ql_sampler_start(&sampler, i);
            u = ql_sampler_1d(&sampler, QL_DIM_DIRECTION);
            lowest = u < lowest ? u : lowest;
            highest = u > highest ? u : highest;
        }
    }
    CHECK(lowest < 1ul << 14 && highest > 0xffffffffu - (1ul << 14),
            "the ends are never come near: %lu..%lu", (unsigned long)lowest,
            (unsigned long)highest);
    NOTE("2^21 numbers, from %.1e to 1 - %.1e", midpoint_of(lowest),
            1 - midpoint_of(highest));
}

/* ---- Marginals --------------------------------------------------------- */

/* Kolmogorov-Smirnov's distance of a map over all 2^16 numbers, given F of
 * each in order. */
typedef struct {
    double before; /* F of the last one */
    double worst;
    uint32_t count;
} distance_t;

static void add_to(distance_t *d, double f)
{
    const double low = d->count / 65536.0, high = (d->count + 1) / 65536.0;

    CHECK(f >= d->before, "number %lu is below the one before",
            (unsigned long)d->count);
    d->worst = fmax(d->worst, fmax(fabs(f - low), fabs(f - high)));
    d->before = f;
    d->count++;
}

/* Half a step, and what the value is off: a root's error counts twice in its
 * square. */
#define HALF_STEP 0x1p-17
#if QL_CFG_PRECISION == 0
#define ROOT_MAX 0x1p-14
#else
#define ROOT_MAX 0x1p-27
#endif

static double worst_distance;

static void check_distance(const distance_t *d, double error, const char *what)
{
    CHECK(d->count == 65536 && d->worst <= HALF_STEP + error,
            "%s: distance %.3e, at most %.3e", what, d->worst,
            HALF_STEP + error);
    worst_distance = fmax(worst_distance, d->worst);
}

/* The number k of 2^16, in the middle of its interval. */
static ql_uq32_t middle(uint32_t k)
{
    return k << 16 | 0x8000u;
}

static void check_powers(void)
{
    for (unsigned i = 0; i < POWERS; i++) {
        const double m1 = powers[i] * 0x1p-16 + 1;
        const ql_real_t inverse = ql_warp_lobe_inverse(powers[i]);
        distance_t d = {0, 0, 0};

        /* a large u1 is near the axis: from the last to the first */
        for (uint32_t k = 65536; k-- > 0;) {
            ql_uq31_t s;

            (void)ql_warp_lobe(inverse, middle(k), 0, &s);
            add_to(&d, -expm1(m1 * log1p(-ldexp(s, -31))));
        }
        /* s to nearest and 2^-24 of itself: F = 1 - (1 - s)^m1 moves by m1
         * 2^-32, and by (m1 s (1 - s)^(m1 - 1) <= 1/e) 2^-24 */
        check_distance(&d, m1 * 0x1p-32 + 0x1p-24, "power");
    }
}

TEST(case_03_marginals_of_all_16_bit_numbers_are_half_a_step_off)
{
    static const ql_real_t width = {0x80000000u, -41}; /* 2^-10 */
    distance_t hemisphere = {0, 0, 0}, cosine = {0, 0, 0}, sphere = {0, 0, 0};
    distance_t disk = {0, 0, 0}, cone = {0, 0, 0};

    worst_distance = 0;
    for (uint32_t k = 0; k < 65536; k++) {
        const ql_uq32_t u = middle(k), down = middle(65535 - k);
        ql_q29_t x, y;
        double z;

        add_to(&hemisphere, ql_warp_hemisphere_uniform(u, 0).z * ONE);
        z = ql_warp_lecture_cosine(down, 0).z * ONE;
        add_to(&cosine, z * z);
        add_to(&sphere, (1 + ql_warp_sphere(down, 0).z * ONE) / 2);
        /* of the disk the larger of two coordinates: the other in the middle,
         * its square has the share r of the square's sides */
        ql_warp_plane_disk(
                0x80000000u + (k << 15 | 0x4000u), 0x80000000u, &x, &y);
        add_to(&disk, x * ONE);
        add_to(&cone, (1 - ql_warp_cone(width, u, 0).z * ONE) * 1024);
    }
    check_distance(&hemisphere, 0x1p-30, "hemisphere");
    check_distance(&cosine, ROOT_MAX, "cosine");
    check_distance(&sphere, 0x1p-30, "sphere");
    check_distance(&disk, DISK_MAX, "disk");
    check_distance(&cone, 0x1p-19, "cone"); /* half an ulp of z is 2^-30 */
    check_powers();
    NOTE("5 maps, %d exponents; worst %.2e, half a step is %.2e", POWERS,
            worst_distance, HALF_STEP);
}

/* ---- Disk -------------------------------------------------------------- */

typedef struct {
    ql_q29_t x, y;
} point_t;

static point_t disk_at(ql_uq32_t u1, ql_uq32_t u2)
{
    point_t p;

    ql_warp_plane_disk(u1, u2, &p.x, &p.y);
    return p;
}

/* All eight images of one point; on a diagonal x and y are the same but for
 * the errors of sine and cosine. */
static void check_images(ql_uq32_t u1, ql_uq32_t u2)
{
    const point_t p = disk_at(u1, u2);
    const uint32_t a = ql_abs32(ql_i32((u1 | 1u) ^ 0x80000000u));
    const uint32_t b = ql_abs32(ql_i32((u2 | 1u) ^ 0x80000000u));
    const double slack = a == b ? DISK_MAX * 0x1p29 + 1 : 0;

    for (unsigned i = 0; i < 8; i++) {
        const ql_uq32_t v1 = i & 1 ? ~u1 : u1, v2 = i & 2 ? ~u2 : u2;
        const point_t q = i & 4 ? disk_at(v2, v1) : disk_at(v1, v2);
        const ql_q29_t x = i & 4 ? q.y : q.x, y = i & 4 ? q.x : q.y;

        CHECK(fabs((double)x - (i & 1 ? -p.x : p.x)) <= slack &&
                        fabs((double)y - (i & 2 ? -p.y : p.y)) <= slack,
                "image %u of (%08lx %08lx): (%ld %ld), not (+-%ld +-%ld)", i,
                (unsigned long)u1, (unsigned long)u2, (long)x, (long)y,
                (long)p.x, (long)p.y);
    }
}

TEST(case_04_concentric_map_is_symmetric_at_centre_diagonals_and_corners)
{
    uint64_t state = 4;

    for (uint32_t i = 0; i < 4; i++) {
        const point_t p = disk_at(0x7fffffffu + (i & 1), 0x7fffffffu + i / 2);

        /* a ulp of 2^-31 off the centre: it rounds to the centre */
        CHECK(ql_abs32(p.x) <= 1 && ql_abs32(p.y) <= 1, "cell %lu: (%ld %ld)",
                (unsigned long)i, (long)p.x, (long)p.y);
    }
    check_images(0x80000000u, 0x80000000u);
    check_images(0, 0);
    check_images(0, 0x80000000u);
    for (unsigned i = 0; i < 20000; i++) {
        const ql_uq32_t u = (uint32_t)stats_random(&state);

        check_images(u, u);
        check_images(u, u + 2);
        check_images(u, (uint32_t)stats_random(&state));
    }
    NOTE("60003 points, 8 images each");
}

/* ---- Triangle ---------------------------------------------------------- */

static void check_weights(ql_uq32_t u1, ql_uq32_t u2)
{
    const uint64_t whole = (uint64_t)1 << QL_BARY_BITS;
    uint32_t b1, b2;

    ql_warp_plane_triangle(u1, u2, &b1, &b2);
    CHECK(b1 > 0 && b2 > 0 && b1 < whole && b2 < whole - b1,
            "(%08lx %08lx): %lu %lu", (unsigned long)u1, (unsigned long)u2,
            (unsigned long)b1, (unsigned long)b2);
}

TEST(case_05_triangle_weights_are_above_0_and_sum_to_1_on_the_diagonal)
{
    static const ql_uq32_t ends[] = {0, 1, 0x7fffffffu, 0x80000000u,
            0xbfffffffu, 0xc0000000u, 0xfffffffeu, 0xffffffffu};
    const ql_uq32_t step = (uint32_t)1 << (34 - QL_BARY_BITS);

    for (uint32_t k = 0; k < 65536; k++) {
        const ql_uq32_t u = k << 16;

        check_weights(u, u);
        check_weights(u, u + step); /* of the lattice, on either side */
        check_weights(u + step, u);
    }
    for (unsigned i = 0; i < 64; i++) {
        check_weights(ends[i % 8], ends[i / 8]);
    }
    NOTE("3 x 65536 beside the diagonal, 64 ends; b0 = 1 - b1 - b2 > 0");
}

/* ---- Phong ------------------------------------------------------------- */

#if QL_CFG_PHONG

#define GRID_UNIT (1 << QL_POS_BITS)

static mini_scene_t m;
static ql_scene_t scene;
static ql_surface_t surface;
static ql_bsdf_t bsdf;

/* A floor of Ks 1 and exponent n, seen at this angle from its normal. */
static void see(double n, double sine, double cosine)
{
    static const int32_t a[3] = {8000, 8000, 8000}, b[3] = {24000, 8000, 8000};
    static const int32_t c[3] = {24000, 24000, 8000};
    static const int32_t d[3] = {8000, 24000, 8000};
    const double most = 1 << QL_DIR_BITS;
    uint16_t shiny;
    ql_vec3_t in;
    ql_ray_t down;
    ql_hit_t hit;

    mini_begin(&m);
    shiny = mini_material(&m, 0, 0);
    mini_gloss(&m, shiny, QL_GLOSS_PHONG, 1, n);
    mini_quad(&m, a, b, c, d, shiny);
    mini_open(&m, &scene);
    down.origin.x = down.origin.y = 16001 * GRID_UNIT;
    down.origin.z = 9000 * GRID_UNIT;
    down.direction.x = down.direction.y = 0;
    down.direction.z = -(int32_t)most;
    CHECK(ql_bvh_closest_hit(&scene, &down, &hit), "no floor");
    ql_surface_at(&scene, &down, &hit, &surface);
    in.x = (int32_t)lrint(sine * most);
    in.y = 0;
    in.z = -(int32_t)lrint(cosine * most);
    ql_bsdf_begin(&bsdf, &scene, &surface,
            ql_scene_material(&scene, scene.triangles + hit.tri_idx), true, in);
}

typedef struct {
    double mean, kept, most, variance;
} lobe_t;

/* Of 2^16 stratified directions: mean weight, share above the horizon. */
static lobe_t draw_lobe(void)
{
    stats_moments_t weights = {0, 0, 0};
    lobe_t lobe = {0, 0, 0, 0};

    for (uint32_t i = 0; i < 65536; i++) {
        const ql_uniform2_t u = {
                (i & 255) << 24 | 0x800000u, (i >> 8) << 24 | 0x800000u};
        ql_bsdf_sample_t sample;
        double weight = 0;

        if (ql_bsdf_sample(&bsdf, QL_DENSITY_BRDF, 0, u, &sample, NULL)) {
            CHECK(ql_vec_dot(sample.wi, surface.n) > 0,
                    "a direction below the surface");
            weight = ldexp(sample.weight.c[0], sample.weight.e - 31);
            lobe.kept += 1 / 65536.0;
        }
        stats_add(&weights, weight);
        lobe.most = fmax(lobe.most, weight);
    }
    lobe.mean = weights.mean;
    lobe.variance = stats_variance(&weights);
    return lobe;
}

/* 256 strata by 256: the error of a mean is far below a random one's. Weights
 * are right to 2^-26, in draft to 2^-14. */
#define WITHIN(lobe)                                                           \
    (sqrt((lobe).variance / 65536) / 4 + (QL_POS_BITS > 0 ? 2e-5 : 0x1p-14))

TEST(case_33_lobes_of_exponent_0_to_65535_have_their_albedo)
{
    static const double exponents[] = {0, 1, 5, 20, 1000, 65535};
    static const double angles[] = {0, 45, 60, 75, 80, 85};
    static const double known[6][6] = {
            {1, .8535533906, .75, .6294095226, .5868240888, .5435778714},
            {1, .7554091649, .6089977810, .4584415161, .4099452536,
                    .3630974852},
            {1, .7103933491, .5194068355, .3271321791, .2692908026,
                    .2165609213},
            {1, .7071102788, .5005094980, .2711785286, .2003418687,
                    .1382931375},
            {1, .7071067812, .5, .2588190451, .1736481778, .0871830044},
            /* nothing is cut off: cos(theta) E[cos] (n + 2)/(n + 1) */
            {1, .7071067812, .5, .2588190451, .1736481777, .0871557427}};
    double worst = 0;

    for (unsigned i = 0; i < 6; i++) {
        const double n = exponents[i];

        for (unsigned k = 0; k < 6; k++) {
            const double angle = angles[k] * PI / 180;
            lobe_t lobe;

            see(n, sin(angle), cos(angle));
            lobe = draw_lobe();
            CHECK(fabs(lobe.mean - known[i][k]) < WITHIN(lobe),
                    "n = %g, %g degrees: %.7f, want %.7f", n, angles[k],
                    lobe.mean, known[i][k]);
            CHECK(lobe.most <= (n + 2) / (n + 1) * (1 + 1e-9),
                    "n = %g, %g degrees: weight %.9f", n, angles[k], lobe.most);
            worst = fmax(worst, fabs(lobe.mean - known[i][k]));
            /* above the horizon: of a uniform lobe 1 - theta/pi, of a cosine
             * lobe (1 + cos)/2, of a narrow one all */
            if (i < 2) {
                const double kept =
                        i == 0 ? 1 - angles[k] / 180 : (1 + cos(angle)) / 2;

                CHECK(fabs(lobe.kept - kept) < 1.0 / 256, "n = %g: kept %.5f",
                        n, lobe.kept);
            }
            CHECK(n < 1000 || angles[k] > 80 || lobe.kept > 1 - 1e-9,
                    "n = %g: kept %.5f", n, lobe.kept);
        }
    }
    NOTE("36 albedos of 2^16 directions; worst %.0e", worst);
}

/* The cosine of the view is 2^-15, and less: one ulp of draft's directions. */
TEST(case_34_views_along_the_surface_keep_weights_finite)
{
    static const double exponents[] = {0, 1, 5, 20, 100, 1000, 65535};
    static const double known90[] = {.5, .3183098862, .1697652726, .0880985260,
            .0397946187, .0126125091, 0};
    double most = 0;

    for (unsigned i = 0; i < 7; i++) {
        const double n = exponents[i];
        lobe_t lobe;

        see(n, 1, 0x1p-15);
        lobe = draw_lobe();
        CHECK(lobe.most <= (n + 2) / (n + 1) * (1 + 1e-9), "n = %g: weight %g",
                n, lobe.most);
        CHECK(i == 6 || fabs(lobe.mean - known90[i]) < WITHIN(lobe) + 0x1p-15,
                "n = %g: %.7f, want %.7f", n, lobe.mean, known90[i]);
        CHECK(lobe.mean > 0 && lobe.kept > 0.4, "n = %g: %.4f are kept", n,
                lobe.kept);
        most = fmax(most, lobe.most * (n + 1) / (n + 2));
    }
    NOTE("7 exponents; largest weight %.3f of (n + 2)/(n + 1)", most);
}

/* The convention for n = 0: cos^0 is 1 in the half space about the mirror
 * direction and 0 beyond it. So the albedo is (1 + cos)/2, not 1. */
TEST(case_35_exponent_0_is_the_hemisphere_about_the_mirror_direction)
{
    double worst = 0;

    for (unsigned degrees = 0; degrees < 90; degrees += 5) {
        const double angle = degrees * PI / 180, want = (1 + cos(angle)) / 2;
        const ql_real_t one = {0x80000000u, -31};
        lobe_t lobe;
        ql_rgb_t r;

        see(0, sin(angle), cos(angle));
        lobe = draw_lobe();
        CHECK(fabs(lobe.mean - want) < WITHIN(lobe),
                "%u degrees: %.7f, not %.7f", degrees, lobe.mean, want);
        worst = fmax(worst, fabs(lobe.mean - want));
        /* value: f cos inverse = 2/(2 pi), and 0 beyond 90 degrees from the
         * mirror direction, which points to +x */
        ql_bsdf_eval(&bsdf, bsdf.mirror, one, one, QL_MIS_NONE, &r);
        CHECK(fabs(ldexp(r.c[0], r.e - 31) * PI - 1) < 1e-4,
                "%u degrees: f = %.6f", degrees, ldexp(r.c[0], r.e - 31));
        if (degrees > 0) {
            const ql_vec3_t beyond = {
                    (int32_t)lrint(-cos(angle - 1e-3) * 0x1p29), 0,
                    (int32_t)lrint(sin(angle - 1e-3) * 0x1p29)};

            ql_bsdf_eval(&bsdf, beyond, one, one, QL_MIS_NONE, &r);
            CHECK(ql_rgb_most(&r) == 0, "%u degrees: f = %g beyond", degrees,
                    ldexp(r.c[0], r.e - 31));
        }
    }
    NOTE("(1 + cos)/2 within %.0e; f = 1/pi up to 90 degrees, then 0", worst);
}

#endif

int main(int argc, char **argv)
{
    TEST_BEGIN("extreme/samplers", argc, argv);
    RUN(case_01_every_sampler_stays_in_its_domain_at_all_four_corners);
    RUN(case_02_random_numbers_are_above_0_and_below_1);
    RUN(case_03_marginals_of_all_16_bit_numbers_are_half_a_step_off);
    RUN(case_04_concentric_map_is_symmetric_at_centre_diagonals_and_corners);
    RUN(case_05_triangle_weights_are_above_0_and_sum_to_1_on_the_diagonal);
#if QL_CFG_PHONG
    RUN(case_33_lobes_of_exponent_0_to_65535_have_their_albedo);
    RUN(case_34_views_along_the_surface_keep_weights_finite);
    RUN(case_35_exponent_0_is_the_hemisphere_about_the_mirror_direction);
#endif
    return TEST_END();
}
