/* test_sky_map.c - maps: look-ups, directions, densities, the integral */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <string.h>

#include "blob/ql_blob_open.h"
#include "support/ql_stats.h"
#include "support/ql_table_error.h"
#include "support/ql_test.h"
#include "sample/ql_table.h"
#include "lib/math/build_table.h"
#include "light/ql_emit_sky.h"
#include "light/sky/ql_sky_map.h"

#if QL_CFG_SKY_MAP

/* Errors of a drawn direction, rad, and of a density, relative. */
#define ANGLE_ERROR   BY_TABLES(QL_CFG_PRECISION == 0 ? 4e-5 : 9e-8)
#define INVERSE_ERROR 0x1p-26

enum {
    CELLS_MAX = 4096,
    SAMPLES = MANY(1 << 16),
    CHI2_SAMPLES = MANY(1 << 18)
};

static const double pi = 3.14159265358979323846;

static struct {
    ql_blob_sky_t sky;
    ql_blob_texel_t texels[CELLS_MAX];
    ql_blob_distribution_t table;
    uint16_t words[2 * CELLS_MAX];
    double weights[CELLS_MAX];
    ql_scene_t scene;
    uint16_t width, height;
    double rotate; /* turns */
} map;

static uint64_t state;

static double real(ql_real_t a)
{
    return ldexp(a.m, a.e);
}

/* ---- Maps ---------------------------------------------------------------- */

/* Channel i of a texel, and their sum. */
static uint32_t channel(uint32_t texel, int i)
{
    return (texel >> 9 * i & 511) << (texel >> 27);
}

static double total(uint32_t texel)
{
    return (double)channel(texel, 0) + channel(texel, 1) + channel(texel, 2);
}

/* Exact share of the sphere's area that a row's texel has. */
static double texel_area(uint32_t row)
{
    return 2 * pi / map.width *
           (cos(pi * row / map.height) - cos(pi * (row + 1) / map.height));
}

/* Open what is in map.texels, weighted as qlux-scene would. */
static void open_map(uint16_t width, uint16_t height, double degrees)
{
    const uint16_t count[2] = {width, height};
    ql_table_t table;
    uint32_t words;
    table_error_t error;

    map.width = width;
    map.height = height;
    for (uint32_t i = 0; i < (uint32_t)width * height; i++) {
        map.weights[i] = total(QL_LE32(map.texels[i].rgb9e5)) *
                         sin(pi * (i / width + 0.5) / height);
    }
    words = table_words(2, count);
    CHECK(words <= 2 * CELLS_MAX, "%lu words", (unsigned long)words);
    error = table_build(map.words + 3, map.weights, 2, count);
    CHECK(error == TABLE_OK, "%s", table_error_text(error));
    CHECK(ql_table_open(&table, map.words + 3, words, 2, count) == QL_OK,
            "table");
    map.table.first = QL_LE32(3);
    map.table.count[0] = QL_LE16(width);
    map.table.count[1] = QL_LE16(height);
    map.table.count[2] = QL_LE16(1);
    map.table.dims = QL_LE16(2);
    memset(&map.sky, 0, sizeof map.sky);
    map.sky.width = QL_LE16(width);
    map.sky.height = QL_LE16(height);
    map.sky.rotate = QL_LE32((uint32_t)llrint(ldexp(degrees / 360, 32)));
    map.rotate = ldexp(QL_LE32(map.sky.rotate), -32);
    memset(&map.scene, 0, sizeof map.scene);
    map.scene.sky = &map.sky;
    map.scene.texels = map.texels;
    map.scene.tables = &map.table;
    map.scene.table_count = 1;
    map.scene.words = map.words;
}

static uint32_t random_texel(void)
{
    const uint64_t bits = stats_random(&state);

    return (uint32_t)(bits & 0x07ffffffu) |
           (uint32_t)stats_random_below(&state, 24) << 27;
}

/* Random texels; row 1 and every third texel dark. */
static void random_map(uint16_t width, uint16_t height, double degrees)
{
    for (uint32_t i = 0; i < (uint32_t)width * height; i++) {
        const bool dark = (height > 2 && i / width == 1) ||
                          (width * height > 8 && i % 3 == 2);

        map.texels[i].rgb9e5 = QL_LE32(dark ? 0 : random_texel() | 1);
    }
    open_map(width, height, degrees);
}

static const struct {
    uint16_t width, height;
    double degrees;
} sizes[] = {{1, 1, 0}, {1, 1, 90}, {1, 13, 90}, {17, 1, 359.9}, {32, 16, 0},
        {32, 16, 90}, {64, 32, 359.9}, {5, 7, 200}, {64, 64, 12.5}};

enum { SIZES = sizeof sizes / sizeof sizes[0] };

/* ---- Looking up ---------------------------------------------------------- */

/* Where a vector lies, u and v in texels. */
static void place(ql_vec3_t d, double *x, double *y)
{
    double u = atan2(d.x, d.z) / (2 * pi) - map.rotate;

    u -= floor(u);
    *x = u * map.width;
    *y = atan2(hypot(d.x, d.z), d.y) / pi * map.height;
}

/* Distance from the nearest border between texels. */
static double from_border(double x)
{
    return fabs(x - nearbyint(x));
}

static uint32_t at(uint32_t x, uint32_t y)
{
    return QL_LE32(
            map.texels[(y < map.height ? y : map.height - 1u) * map.width +
                       (x < map.width ? x : 0)]
                    .rgb9e5);
}

static bool same(const ql_uq32_t emission[3], uint32_t texel)
{
    return emission[0] == channel(texel, 0) &&
           emission[1] == channel(texel, 1) && emission[2] == channel(texel, 2);
}

static int32_t random_in(int32_t most)
{
    return (int32_t)stats_random_below(&state, 2 * (uint64_t)most + 1) - most;
}

static ql_vec3_t random_vector(unsigned bits)
{
    const int32_t most = (int32_t)1 << bits;
    ql_vec3_t d;

    do {
        d.x = random_in(most);
        d.y = random_in(most);
        d.z = random_in(most);
    } while (d.x == 0 && d.y == 0 && d.z == 0);
    return d;
}

/* Look d up and compare; 1 if it is too near a border to say. */
static unsigned check_lookup(ql_vec3_t d)
{
    const double sine =
            hypot(d.x, d.z) /
            sqrt((double)d.x * d.x + (double)d.y * d.y + (double)d.z * d.z);
    ql_uq32_t emission[3];
    ql_real_t inverse;
    double x, y, density, got;
    uint16_t cell[2];
    ql_table_t table = {map.words + 3, {map.width, map.height, 1}, 2};

    ql_sky_map_radiance(&map.scene, d, emission, &inverse);
    place(d, &x, &y);
    if (sine == 0 || from_border(x) < map.width * 0x1p-29 / sine ||
            from_border(y) < map.height * 0x1p-28) {
        return 1;
    }
    CHECK(same(emission, at((uint32_t)x, (uint32_t)y)),
            "(%ld, %ld, %ld) is at %.6f, %.6f", (long)d.x, (long)d.y, (long)d.z,
            x, y);
    cell[0] = (uint16_t)x;
    cell[1] = (uint16_t)y;
    density = ldexp((double)ql_table_mass(&table, cell), -32) * map.width *
              map.height;
    got = real(inverse) * density;
    CHECK(density > 0 ? fabs(got / (2 * pi * pi * sine) - 1) < INVERSE_ERROR
                      : inverse.m == 0,
            "(%ld, %ld, %ld): %.9g", (long)d.x, (long)d.y, (long)d.z, got);
    return 0;
}

TEST(directions_are_looked_up_where_their_angles_say)
{
    unsigned long skipped = 0, tried = 0;

    state = 1;
    for (int s = 0; s < SIZES; s++) {
        random_map(sizes[s].width, sizes[s].height, sizes[s].degrees);
        for (long i = 0; i < MANY(30000); i++) {
            skipped += check_lookup(random_vector(29));
            skipped += check_lookup(random_vector(i & 1 ? 15 : 22));
            tried += 2;
        }
    }
    /* within 2^-29 / sin(theta) turns of 64 borders: fewer than 10^-5 */
    CHECK(skipped < 20, "%lu too near a border", skipped);
    NOTE("%lu, %lu too near a border", tried, skipped);
}

/* Is it that of a sine above 0, but of less than a grid unit of 2^-29? */
static bool at_pole(ql_real_t inverse, uint16_t row)
{
    const ql_table_t table = {map.words + 3, {map.width, map.height, 1}, 2};
    const uint16_t cell[2] = {(uint16_t)((1 - map.rotate) * map.width), row};
    const double sine =
            real(inverse) / (2 * pi * pi) *
            real(ql_table_density(&table, ql_table_mass(&table, cell)));

    return sine > 0 && sine < 0x1p-29 + 0x1p-50;
}

TEST(every_small_vector_and_the_poles_are_looked_up)
{
    unsigned long skipped = 0;

    state = 2;
    for (uint32_t i = 0; i < 31 * 15; i++) {
        map.texels[i].rgb9e5 = QL_LE32(random_texel() | 1);
    }
    open_map(31, 15, 20);
    for (int32_t i = 0; i < 21 * 21 * 21; i++) {
        const ql_vec3_t d = {i % 21 - 10, i / 21 % 21 - 10, i / 441 - 10};

        if (d.x != 0 || d.y != 0 || d.z != 0) {
            skipped += check_lookup(d);
        }
    }
    CHECK(skipped <= 20 + 40, "%lu", skipped);
    for (int e = 0; e <= 30; e++) {
        const ql_vec3_t up = {0, (int32_t)1 << e, 0};
        const ql_vec3_t down = {0, -((int32_t)1 << e), 0};
        ql_uq32_t a[3], b[3];
        ql_real_t inverse;

        ql_sky_map_radiance(&map.scene, up, a, &inverse);
        CHECK(at_pole(inverse, 0), "%g", real(inverse));
        ql_sky_map_radiance(&map.scene, down, b, &inverse);
        CHECK(at_pole(inverse, (uint16_t)(map.height - 1)), "%g",
                real(inverse));
        CHECK(same(a, at((uint32_t)((1 - map.rotate) * map.width), 0)) &&
                        same(b, at((uint32_t)((1 - map.rotate) * map.width),
                                        map.height - 1u)),
                "pole of length 2^%d", e);
    }
    NOTE("%lu on borders", skipped);
}

/* Rotating the map by r is turning the direction back by r about y. */
TEST(the_map_begins_at_its_azimuth_and_runs_from_z_to_x)
{
    static const ql_vec3_t z = {0, 1, 1000}, x = {1000, 1, 0},
                           back = {0, 1, -1000}, left = {-1000, 1, 0};
    ql_uq32_t emission[3];

    for (uint32_t i = 0; i < 8; i++) {
        map.texels[i].rgb9e5 = QL_LE32(i + 1);
    }
    open_map(8, 1, -1); /* 1 degree before z, so that axes are no borders */
    ql_sky_map_radiance(&map.scene, z, emission, NULL);
    CHECK(emission[0] == 1, "+z: %lu", (unsigned long)emission[0]);
    ql_sky_map_radiance(&map.scene, x, emission, NULL);
    CHECK(emission[0] == 3, "+x: %lu", (unsigned long)emission[0]);
    ql_sky_map_radiance(&map.scene, back, emission, NULL);
    CHECK(emission[0] == 5, "-z: %lu", (unsigned long)emission[0]);
    ql_sky_map_radiance(&map.scene, left, emission, NULL);
    CHECK(emission[0] == 7, "-x: %lu", (unsigned long)emission[0]);
    open_map(8, 1, 89);
    ql_sky_map_radiance(&map.scene, x, emission, NULL);
    CHECK(emission[0] == 1, "+x of 90: %lu", (unsigned long)emission[0]);
    ql_sky_map_radiance(&map.scene, z, emission, NULL);
    CHECK(emission[0] == 7, "+z of 90: %lu", (unsigned long)emission[0]);
}

TEST(any_vector_at_all_has_some_texel)
{
    static const int32_t odd[] = {
            INT32_MIN, INT32_MIN + 1, -(1 << 30), -1, 0, 1, 1 << 30, INT32_MAX};
    unsigned long none = 0;

    state = 3;
    random_map(7, 5, 33);
    for (int i = 0; i < 512; i++) {
        const ql_vec3_t d = {odd[i & 7], odd[i >> 3 & 7], odd[i >> 6]};
        ql_uq32_t emission[3];
        bool found = false;

        ql_sky_map_radiance(&map.scene, d, emission, NULL);
        for (uint32_t k = 0; k < 35; k++) {
            found |= same(emission, QL_LE32(map.texels[k].rgb9e5));
        }
        none += !found;
    }
    CHECK(none == 0, "%lu", none);
}

TEST(a_constant_sky_is_the_same_all_around)
{
    const ql_blob_sky_t sky = {
            {QL_LE32(1), QL_LE32(0x80000000u), QL_LE32(0xffffffffu)}, 0, 0, 0,
            0, 0};
    ql_scene_t scene;

    memset(&scene, 0, sizeof scene);
    scene.sky = &sky;
    state = 4;
    for (long i = 0; i < 1000; i++) {
        ql_uq32_t e[3];

        ql_emit_sky_radiance(&scene, random_vector(29), e);
        CHECK(e[0] == 1 && e[1] == 0x80000000u && e[2] == 0xffffffffu,
                "%lu %lu %lu", (unsigned long)e[0], (unsigned long)e[1],
                (unsigned long)e[2]);
    }
}

/* ---- Drawing ------------------------------------------------------------- */

/* Draw, look up, compare. A direction is off by ANGLE_ERROR, so it may fall
 * beyond a border within that; nothing else may differ. */
TEST(the_texel_drawn_is_the_texel_looked_up)
{
    unsigned long beyond = 0, drawn = 0;
    double expected = 0;

    state = 5;
    for (int s = 0; s < SIZES; s++) {
        random_map(sizes[s].width, sizes[s].height, sizes[s].degrees);
        for (long i = 0; i < SAMPLES; i++) {
            const uint64_t bits = stats_random(&state);
            ql_uq32_t a[3], b[3];
            ql_real_t p, q;
            ql_vec3_t w;
            double x, y, sine;

            p = ql_sky_map_sample(
                    &map.scene, (uint32_t)bits, (uint32_t)(bits >> 32), &w, a);
            ql_sky_map_radiance(&map.scene, w, b, &q);
            place(w, &x, &y);
            sine = ldexp(hypot(w.x, w.z), -29);
            CHECK(p.m >= 0x80000000u, "inverse of mantissa %08lx",
                    (unsigned long)p.m);
            drawn++;
            if (from_border(x) / map.width * 2 * pi <=
                            ANGLE_ERROR + 0x1p-29 / sine ||
                    from_border(y) / map.height * pi <= ANGLE_ERROR) {
                beyond++;
                continue;
            }
            CHECK(memcmp(a, b, sizeof a) == 0,
                    "%u by %u, u = %08lx %08lx: drawn %lu, found %lu at %.5f, "
                    "%.5f",
                    map.width, map.height, (unsigned long)(uint32_t)bits,
                    (unsigned long)(bits >> 32), (unsigned long)a[0],
                    (unsigned long)b[0], x, y);
            /* sin(theta) of a direction that is off by that much */
            CHECK(fabs(real(q) / real(p) - 1) <
                            2 * INVERSE_ERROR + ANGLE_ERROR / sine,
                    "inverse %.9g and %.9g", real(p), real(q));
        }
        /* a strip on both sides of every border that is not the edge of a
         * pole; twice, for the map is not even */
        expected += 2. * SAMPLES * 2 * ANGLE_ERROR *
                    (map.width * 0.5 + map.height / pi);
    }
    CHECK((double)beyond <= expected + 5 * sqrt(expected) + 5,
            "%lu within the error of a border, %.1f expected", beyond,
            expected);
    NOTE("%lu of %lu within the error of a border, %.1f allowed", beyond, drawn,
            expected);
}

TEST(directions_drawn_have_unit_length)
{
    double worst = 0;

    state = 6;
    for (int s = 0; s < SIZES; s++) {
        random_map(sizes[s].width, sizes[s].height, sizes[s].degrees);
        for (long i = 0; i < SAMPLES; i++) {
            const uint64_t bits = stats_random(&state);
            ql_uq32_t e[3];
            ql_vec3_t w;

            ql_sky_map_sample(
                    &map.scene, (uint32_t)bits, (uint32_t)(bits >> 32), &w, e);
            worst = fmax(worst,
                    fabs(ldexp(sqrt((double)w.x * w.x + (double)w.y * w.y +
                                       (double)w.z * w.z),
                                 -29) -
                            1));
        }
    }
    CHECK(worst <= ANGLE_ERROR, "%.3g", worst);
    NOTE("worst %.1e", worst);
}

/* Both ends of both numbers: in range, never an inverse of 0. */
TEST(the_ends_of_the_square_are_drawn_too)
{
    static const uint32_t ends[] = {0, 1, 0xffff, 0x10000, 0x7fffffffu,
            0x80000000u, 0xffff0000u, 0xfffffffeu, 0xffffffffu};

    state = 7;
    for (int s = 0; s < SIZES; s++) {
        random_map(sizes[s].width, sizes[s].height, sizes[s].degrees);
        for (int i = 0; i < 81; i++) {
            ql_uq32_t e[3];
            ql_vec3_t w;
            const ql_real_t p = ql_sky_map_sample(
                    &map.scene, ends[i % 9], ends[i / 9], &w, e);

            CHECK(p.m >= 0x80000000u && (e[0] | e[1] | e[2]) > 0 &&
                            fabs(hypot(hypot(w.x, w.y), w.z) / (1 << 29) - 1) <
                                    ANGLE_ERROR,
                    "map %d, ends %d", s, i);
        }
    }
}

/* The mean of L / pdf is the integral of L. The second number is stratified,
 * which only makes the mean better than its variance says. */
/* Of a single texel, where v is the number drawn: 2 pi^2 sin(pi v). */
TEST(densities_keep_their_bits_at_either_pole)
{
    double worst = 0;

    map.texels[0].rgb9e5 = QL_LE32(511);
    open_map(1, 1, 0);
    for (unsigned k = 2; k < 64; k++) {
        const uint32_t from_pole = UINT32_MAX >> k / 2;
        const uint32_t u = k % 2 ? ~from_pole : from_pole;
        const double v = ldexp(from_pole + 0.5, -32);
        const double want = 2 * pi * pi * sin(pi * v);
        ql_uq32_t emission[3];
        ql_vec3_t w;
        const double got = real(
                ql_sky_map_sample(&map.scene, 0x80000000u, u, &w, emission));

        worst = fmax(worst, fabs(got / want - 1));
        CHECK(fabs(got / want - 1) <= INVERSE_ERROR, "%08lx: %.9g, not %.9g",
                (unsigned long)u, got, want);
    }
    NOTE("worst %.2g", worst);
}

TEST(radiance_over_density_adds_up_to_the_integral)
{
    double worst = 0;

    state = 8;
    for (int s = 0; s < SIZES; s++) {
        stats_moments_t m = {0, 0, 0};
        double exact = 0, z;

        random_map(sizes[s].width, sizes[s].height, sizes[s].degrees);
        for (uint32_t i = 0; i < (uint32_t)map.width * map.height; i++) {
            exact += total(QL_LE32(map.texels[i].rgb9e5)) *
                     texel_area(i / map.width);
        }
        for (uint32_t i = 0; i < 65536; i++) {
            const uint64_t bits = stats_random(&state);
            ql_uq32_t e[3];
            ql_vec3_t w;
            const double inverse = real(ql_sky_map_sample(&map.scene,
                    (uint32_t)bits, i << 16 | (uint32_t)(bits >> 48), &w, e));

            stats_add(&m, inverse * ((double)e[0] + e[1] + e[2]));
        }
        z = (m.mean - exact) / sqrt(stats_variance(&m) / m.n);
        worst = fmax(worst, fabs(z));
        CHECK(fabs(z) < STATS_Z_MAX && fabs(m.mean / exact - 1) < 0.02,
                "map %d: %.9g, not %.9g", s, m.mean, exact);
    }
    NOTE("worst z = %.2f of %d maps", worst, SIZES);
}

/* p-value of the texels that directions fall in, against the masses; with a
 * fault, against the solid angles the weights would have without sin(theta). */
static double texels_p(bool forget_sine, unsigned long *dark)
{
    static uint32_t counts[CELLS_MAX];
    static double expected[CELLS_MAX];
    const uint32_t cells = (uint32_t)map.width * map.height;
    ql_table_t table = {map.words + 3, {map.width, map.height, 1}, 2};
    double chi2, dof, all = 0;

    memset(counts, 0, sizeof counts);
    for (long i = 0; i < CHI2_SAMPLES; i++) {
        const uint64_t bits = stats_random(&state);
        ql_uq32_t e[3];
        ql_vec3_t w;
        double x, y;

        ql_sky_map_sample(
                &map.scene, (uint32_t)bits, (uint32_t)(bits >> 32), &w, e);
        place(w, &x, &y);
        if (from_border(x) < 1e-3 || from_border(y) < 1e-3) {
            i--; /* another in its place: texels are all cut alike */
            continue;
        }
        counts[(uint32_t)y * map.width + (uint32_t)x]++;
    }
    for (uint32_t i = 0; i < cells; i++) {
        const uint16_t cell[2] = {
                (uint16_t)(i % map.width), (uint16_t)(i / map.width)};

        expected[i] = (double)ql_table_mass(&table, cell);
        if (forget_sine) {
            expected[i] /= sin(pi * (cell[1] + 0.5) / map.height);
        }
        all += expected[i];
        *dark += expected[i] > 0 ? 0 : counts[i];
    }
    for (uint32_t i = 0; i < cells; i++) {
        expected[i] *= CHI2_SAMPLES / all;
    }
    chi2 = stats_chi2(counts, expected, cells, &dof);
    return stats_chi2_p(chi2, dof);
}

TEST(directions_fall_in_texels_as_their_masses_say)
{
    double least = 1;
    unsigned long dark = 0;

    state = 9;
    for (int s = 2; s < SIZES; s++) {
        double p;

        random_map(sizes[s].width, sizes[s].height, sizes[s].degrees);
        p = texels_p(false, &dark);
        least = fmin(least, p);
        CHECK(p > STATS_P_MIN && dark == 0, "map %d: p = %.3g, %lu dark", s, p,
                dark);
    }
    NOTE("least p = %.3f of %d", least, SIZES - 2);
}

TEST(a_density_without_the_sine_is_rejected)
{
    unsigned long dark = 0;
    double p, wrong;

    state = 10;
    for (uint32_t i = 0; i < 512; i++) {
        map.texels[i].rgb9e5 = QL_LE32(5);
    }
    open_map(32, 16, 0);
    p = texels_p(false, &dark);
    CHECK(p > STATS_P_MIN, "p = %.3g", p);
    wrong = texels_p(true, &dark);
    CHECK(wrong <= STATS_P_MIN, "accepted with p = %.3g", wrong);
    NOTE("p = %.1e, right one %.2f", wrong, p);
}

/* Within one texel directions are even in azimuth and in theta. */
TEST(directions_are_even_within_a_single_bright_texel)
{
    enum { ROWS = 16, COLUMNS = 32 };
    static uint32_t counts[ROWS * COLUMNS];
    const uint32_t bright = 9 * 32 + 20;
    double p;

    state = 11;
    memset(map.texels, 0, sizeof map.texels);
    map.texels[bright].rgb9e5 = QL_LE32(511u << 9 | 23u << 27);
    open_map(32, 16, 90);
    memset(counts, 0, sizeof counts);
    for (long i = 0; i < CHI2_SAMPLES; i++) {
        const uint64_t bits = stats_random(&state);
        ql_uq32_t e[3];
        ql_vec3_t w;
        double x, y;

        ql_sky_map_sample(
                &map.scene, (uint32_t)bits, (uint32_t)(bits >> 32), &w, e);
        place(w, &x, &y);
        CHECK(e[0] == 0 && e[1] == 511u << 23 && e[2] == 0 && x > 19.999 &&
                        x < 21.001 && y > 8.999 && y < 10.001,
                "%.4f, %.4f", x, y);
        counts[(int)fmin(fmax((y - 9) * ROWS, 0), ROWS - 1) * COLUMNS +
                (int)fmin(fmax((x - 20) * COLUMNS, 0), COLUMNS - 1)]++;
    }
    p = stats_chi2_p(stats_chi2_equal(counts, ROWS * COLUMNS,
                             (double)CHI2_SAMPLES / (ROWS * COLUMNS)),
            ROWS * COLUMNS - 1);
    CHECK(p > STATS_P_MIN, "p = %.3g", p);
    NOTE("p = %.2f", p);
}

#else

TEST(a_map_is_named_as_missing)
{
    ql_blob_header_t header = {0};

    header.features = QL_LE32(QL_FEATURE_SKY_MAP);
    CHECK(strcmp(ql_blob_missing(&header), "sky-map") == 0, "%s",
            ql_blob_missing(&header));
}

#endif

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_sky_map", argc, argv);
#if QL_CFG_SKY_MAP
    RUN(directions_are_looked_up_where_their_angles_say);
    RUN(every_small_vector_and_the_poles_are_looked_up);
    RUN(the_map_begins_at_its_azimuth_and_runs_from_z_to_x);
    RUN(any_vector_at_all_has_some_texel);
    RUN(a_constant_sky_is_the_same_all_around);
    RUN(the_texel_drawn_is_the_texel_looked_up);
    RUN(directions_drawn_have_unit_length);
    RUN(the_ends_of_the_square_are_drawn_too);
    RUN(densities_keep_their_bits_at_either_pole);
    RUN(radiance_over_density_adds_up_to_the_integral);
    RUN_IF(TABLES_EXACT, directions_fall_in_texels_as_their_masses_say);
    RUN(a_density_without_the_sine_is_rejected);
    RUN_IF(TABLES_EXACT, directions_are_even_within_a_single_bright_texel);
#else
    RUN(a_map_is_named_as_missing);
#endif
    return TEST_END();
}
