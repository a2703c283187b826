/* extreme_scale.c - scaled, moved, turned scenes: cases 18 to 20, 55 */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>

#include "support/picture/estimate.h"
#include "support/ql_points.h"
#include "support/ql_test.h"
#include "qlux.h"
#include "math/vec/ql_vec_unit.h"
#include "scene/blob/write_blob.h"
#include "scene/build/compile.h"
#include "trace/ql_bvh.h"

enum { SIDE = 12, PIXELS = SIDE * SIDE };

static mini_scene_t m;
static ql_scene_t scene;

/* ---- A room of 31 units a side ----------------------------------------- */

/* Where a point of the room goes: 48 turned and mirrored ones. Bits 0 to 2
 * mirror an axis, the rest is one of six orders. */
static void turn(unsigned way, const double from[3], bool point, double to[3])
{
    static const uint8_t orders[6][3] = {
            {0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};

    for (unsigned k = 0; k < 3; k++) {
        const double v = from[orders[way >> 3][k]];

        to[k] = way >> k & 1u ? (point ? 31 - v : -v) : v;
    }
}

/* An odd number of swaps and mirrors turns every triangle over. */
static bool turns_over(unsigned way)
{
    return ((way & 1u) + (way >> 1 & 1u) + (way >> 2 & 1u) +
                   ((way >> 3) >= 3)) %
                   2 !=
           0;
}

static uint16_t add_vertex(unsigned way, int32_t scale, const double at[3])
{
    double to[3];

    turn(way, at, true, to);
    return mini_vertex(&m, 8 + (int32_t)to[0] * scale,
            8 + (int32_t)to[1] * scale, 8 + (int32_t)to[2] * scale);
}

static void add_face(unsigned way, int32_t scale, const double a[3],
        const double b[3], const double c[3], uint16_t material)
{
    const uint16_t i = add_vertex(way, scale, a);
    const uint16_t j = add_vertex(way, scale, b);
    const uint16_t k = add_vertex(way, scale, c);

    mini_face(
            &m, i, turns_over(way) ? k : j, turns_over(way) ? j : k, material);
}

static void make_room(unsigned way, int32_t scale)
{
    static const double eye[3] = {15, 14, 2}, look[3] = {0.02, -0.05, 0.25};
    static const double right[3] = {0.25, 0, 0}, up[3] = {0, 0.25, 0};
    static const double box[8][3] = {{0, 0, 0}, {31, 0, 0}, {0, 31, 0},
            {31, 31, 0}, {0, 0, 31}, {31, 0, 31}, {0, 31, 31}, {31, 31, 31}};
    static const uint8_t faces[6][4] = {{0, 2, 6, 4}, {1, 5, 7, 3},
            {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 6, 7, 5}};
    static const double tent[4][3] = {
            {4, 1, 16}, {13, 1, 12}, {8, 1, 24}, {9, 12, 18}};
    static const double lamp[3][3] = {{10, 30, 10}, {20, 30, 12}, {15, 30, 22}};
    const uint16_t white = (mini_begin(&m), mini_material(&m, 0.75, 0));
    const uint16_t light = mini_material(&m, 0.5, 3);
    double to[3][3];

    m.width = m.height = SIDE;
    m.radiance_exp = 2;
    for (unsigned f = 0; f < 6; f++) {
        const uint8_t *const c = faces[f];

        add_face(way, scale, box[c[0]], box[c[1]], box[c[2]], white);
        add_face(way, scale, box[c[0]], box[c[2]], box[c[3]], white);
    }
    for (unsigned f = 0; f < 3; f++) {
        add_face(way, scale, tent[f], tent[3], tent[(f + 1) % 3], white);
    }
    add_face(way, scale, lamp[0], lamp[1], lamp[2], light);
    turn(way, eye, true, to[0]);
    mini_eye(&m, 8 + to[0][0] * scale, 8 + to[0][1] * scale,
            8 + to[0][2] * scale);
    turn(way, look, false, to[0]);
    mini_look(&m, to[0][0], to[0][1], to[0][2]);
    turn(way, right, false, to[1]);
    turn(way, up, false, to[2]);
    mini_field(&m, to[1], to[2]);
}

static void render(ql_sum_t sums[PIXELS], uint32_t spp)
{
    const ql_settings_t s = estimate_settings(QL_SAMPLER_SOBOL, 4, 11);
    ql_render_t r;

    memset(sums, 0, PIXELS * sizeof *sums);
    CHECK(ql_render_init(&r, &scene, &s) == QL_OK, "settings");
    for (uint16_t i = 0; i < PIXELS; i++) {
        ql_render_pixel(&r, i % SIDE, i / SIDE, 0, spp, sums + i);
    }
}

static double mean_of(const ql_sum_t sums[PIXELS])
{
    double mean = 0;

    for (unsigned i = 0; i < PIXELS; i++) {
        mean += (double)sums[i].rgb[0] / PIXELS;
    }
    return mean;
}

static ql_sum_t home[PIXELS], away[PIXELS];

/* ---- Scale ------------------------------------------------------------- */

enum { RAYS = 5000, STEPS = 11 };

/* What rays of the same directions, from the same places, hit. */
static void shoot(int32_t scale, uint16_t ids[RAYS], double t[RAYS])
{
    state = 18;
    mini_open(&m, &scene);
    for (unsigned i = 0; i < RAYS; i++) {
        ql_ray_t ray;
        ql_hit_t hit;

        ray.origin = vec((8 + random_in(1, 30) * scale) * ONE,
                (8 + random_in(1, 30) * scale) * ONE,
                (8 + random_in(1, 30) * scale) * ONE);
        ray.direction = ql_vec_to_dir(vec(random_in(-(1l << 29), 1l << 29),
                random_in(-(1l << 29), 1l << 29),
                random_in(-(1l << 29), 1l << 29)));
        CHECK(ql_bvh_closest_hit(&scene, &ray, &hit), "a ray leaves the room");
        ids[i] = hit.tri_idx;
        t[i] = ldexp(hit.t, -30) / scale;
    }
}

/* The same triangles at the same places: exact. Radiance differs by points
 * lifted off their planes by an ulp, in proportion to an ulp in room units. */
TEST(case_18_scenes_scaled_by_powers_of_two_hit_the_same_triangles)
{
    static uint16_t ids[2][RAYS];
    static double t[2][RAYS];
    double worst = 0, finest = 0;

    make_room(0, 1 << (STEPS - 1));
    shoot(1 << (STEPS - 1), ids[0], t[0]);
    render(home, 64);
    for (unsigned step = 0; step + 1 < STEPS; step++) {
        const int32_t scale = (int32_t)1 << step;
        const double u = ldexp(1, -(int)step - QL_POS_BITS);
        unsigned other = 0;
        double off;

        make_room(0, scale);
        shoot(scale, ids[1], t[1]);
        for (unsigned i = 0; i < RAYS; i++) {
            /* of an ulp of t, and the stated error of both */
            other += ids[0][i] != ids[1][i] ||
                     fabs(t[0][i] - t[1][i]) >
                             0x1p-26 / scale + 0x1p-28 * t[0][i];
        }
        CHECK(other == 0, "1:%d: %u of %d rays hit elsewhere",
                1 << (STEPS - 1 - step), other, RAYS);
        render(away, 64);
        off = fabs(mean_of(away) / mean_of(home) - 1);
        CHECK(off < 0.18 * u + 2e-4 * sqrt(u), "1:%d: mean off by %.6f, u %.6f",
                1 << (STEPS - 1 - step), off, u);
        worst = fmax(worst, off / u);
        finest = off;
    }
    NOTE("%d scales, %d rays each; means off %.2f ulps a unit, at 1:2 %.0e",
            STEPS, RAYS, worst, finest);
}

/* ---- Moves ------------------------------------------------------------- */

/* The room with everything a build may have. */
static void make_rich_room(unsigned node_bits)
{
    const int32_t ball[3] = {2300 * 256 + 77, 700 * 256, 1900 * 256 + 130};
    const int32_t bulb[3] = {900 * 256, 2500 * 256 + 1, 2000 * 256};

    make_room(0, 100);
    m.node_bits = node_bits;
    m.triangle_count = 10; /* the last wall away: the sky is seen */
#if QL_CFG_SPHERES
    (void)mini_sphere(&m, bulb, 300 * 256, mini_material(&m, 0, 3.5));
#endif
#if QL_CFG_SPHERES && QL_CFG_PHONG
    {
        const uint16_t shiny = mini_material(&m, 0.3, 0);

        mini_gloss(&m, shiny, QL_GLOSS_PHONG, 0.6, 30);
        (void)mini_sphere(&m, ball, 600 * 256 + 33, shiny);
    }
#endif
#if QL_CFG_SKY
    mini_sky(&m, 0.5, 0.25, 1);
#endif
    (void)ball;
    (void)bulb;
}

TEST(case_19_scenes_moved_by_grid_units_give_the_same_bits)
{
    static const int16_t moves[][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1},
            {255, 256, 257}, {1023, 4097, 7}, {10000, 77, 9999},
            {29000, 29000, 29000}};
    const unsigned count = sizeof moves / sizeof *moves;

    for (unsigned bits = 8; bits <= 16; bits += 8) {
        make_rich_room(bits);
        mini_open(&m, &scene);
        render(home, 16);
        for (unsigned i = 0; i < count; i++) {
            make_rich_room(bits);
            mini_move(&m, moves[i][0], moves[i][1], moves[i][2]);
            mini_open(&m, &scene);
            render(away, 16);
            CHECK(memcmp(home, away, sizeof home) == 0,
                    "by %d %d %d, %u-bit nodes", moves[i][0], moves[i][1],
                    moves[i][2], bits);
        }
    }
    /* by a unit of the camera alone they are not the same */
    m.camera.at[QL_CAMERA_BASE][0][1]++;
    mini_open(&m, &scene);
    render(away, 16);
    CHECK(memcmp(home, away, sizeof home) != 0, "a moved camera sees the same");
    NOTE("%u moves to the end of the box, spheres, gloss and sky, both widths",
            count);
}

/* ---- Symmetry ---------------------------------------------------------- */

TEST(case_20_turned_and_mirrored_scenes_have_the_same_mean)
{
    const ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 4, 20);
    stats_moments_t first;
    double worst = 0, chi2 = 0, fault;

    make_room(0, 1000);
    first = estimate_pixel(&m, &s, 4, 4, MANY(1u << 15));
    for (unsigned way = 1; way < 48; way++) {
        ql_settings_t other = s;
        stats_moments_t got;
        double z;

        other.seed += way;
        make_room(way, 1000);
        got = estimate_pixel(&m, &other, 4, 4, MANY(1u << 11));
        z = (got.mean - first.mean) / sqrt(stats_variance(&got) / got.n +
                                              stats_variance(&first) / first.n);
        CHECK(fabs(z) < STATS_Z_MAX, "way %u: %.6f, not %.6f, z %.1f", way,
                got.mean, first.mean, z);
        worst = fmax(worst, fabs(z));
        chi2 += z * z;
    }
    CHECK(stats_chi2_p(chi2, 47) > STATS_P_MIN, "chi2 %.1f of 47", chi2);
    /* a lamp a tenth too bright is told apart */
    make_room(47, 1000);
    m.light_weight_scale = 1.1;
    first.mean -= estimate_pixel(&m, &s, 4, 4, MANY(1u << 15)).mean;
    fault = -first.mean / sqrt(2 * stats_variance(&first) / first.n);
    CHECK(fault > STATS_Z_MAX, "a brighter lamp: z %.1f", fault);
    NOTE("47 ways; worst z %.1f, chi2 %.0f; a lamp 10 %% brighter: %.0f", worst,
            chi2, fault);
}

/* ---- Worlds ------------------------------------------------------------ */

static void add_world_face(
        world_t *w, const double p[3][3], double size, uint32_t material)
{
    world_face_t face;

    memset(&face, 0, sizeof face);
    face.material = material;
    for (unsigned i = 0; i < 3; i++) {
        const double at[3] = {p[i][0] * size, p[i][1] * size, p[i][2] * size};

        face.vertex[i] = (uint32_t)world_add_vertex(w, at);
    }
    world_add_face(w, &face);
}

/* A floor, a slope and a lamp within a unit cube times size, seen from a
 * distance of so many sizes through a window of 1.2 sizes. */
static uint8_t *compile(double size, double distance)
{
    static const double faces[5][3][3] = {{{0, 0, 0}, {0, 0, 1}, {1, 0, 1}},
            {{0, 0, 0}, {1, 0, 1}, {1, 0, 0}},
            {{0.13, 0, 0.21}, {0.81, 0, 0.17}, {0.37, 0.71, 0.11}},
            {{0.1, 1, 0.1}, {0.9, 1, 0.1}, {0.9, 1, 0.9}},
            {{0.1, 1, 0.1}, {0.9, 1, 0.9}, {0.1, 1, 0.9}}};
    static const double towards[3] = {2 / 7.0, 3 / 7.0, 6 / 7.0};
    static const compile_options_t options = {16, 4, true};
    world_t w;
    model_t model;
    uint8_t *blob;
    size_t bytes;

    memset(&w, 0, sizeof w);
    w.width = w.height = SIDE;
    for (unsigned k = 0; k < 3; k++) {
        w.camera.look[k] = 0.5 * size;
        w.camera.eye[k] = (0.5 + towards[k] * distance) * size;
    }
    w.camera.up[1] = 1;
    w.camera.fov = 2 * atan(0.6 / distance) * 180 / 3.14159265358979323846;
    (void)world_add_material(&w, "white", 5);
    (void)world_add_material(&w, "lamp", 4);
    for (unsigned k = 0; k < 3; k++) {
        w.materials[0].kd[k] = 0.75;
        w.materials[1].ke[k] = 2;
    }
    for (unsigned i = 0; i < 5; i++) {
        add_world_face(&w, faces[i], size, i >= 3);
    }
    compile_scene(&model, &w, &options);
    blob = write_blob(&model, &bytes);
    CHECK(ql_blob_open(&scene, blob, bytes) == QL_OK, "size %g, distance %g",
            size, distance);
    model_free(&model);
    world_free(&w);
    return blob;
}

/* The part of the light of two pictures that lies elsewhere. */
static double distance_of(const ql_sum_t *a, const ql_sum_t *b)
{
    double sum = 0;

    for (unsigned i = 0; i < PIXELS; i++) {
        sum += fabs((double)a[i].rgb[0] - (double)b[i].rgb[0]) / PIXELS;
    }
    return sum / mean_of(b);
}

/* A factor of two changes no bit; one of ten rounds what lies between the
 * doubles, so a few samples see an edge on its other side. */
TEST(scene_sizes_from_1e_minus_6_to_1e9_give_the_same_picture)
{
    double worst = 0;
    unsigned sizes = 0;
    uint8_t *blob = compile(1, 2);

    render(home, 64);
    free(blob);
    for (int e = -30; e <= 30; e += 10) {
        blob = compile(ldexp(1, e), 2);
        render(away, 64);
        free(blob);
        CHECK(memcmp(home, away, sizeof home) == 0, "2^%d: other bits", e);
        sizes++;
    }
    for (int e = -6; e <= 9; e++) {
        double apart;

        blob = compile(pow(10, e), 2);
        render(away, 64);
        free(blob);
        apart = distance_of(away, home);
        CHECK(apart < 1e-3, "1e%d: %.2e of the light elsewhere", e, apart);
        worst = fmax(worst, apart);
        sizes++;
    }
    NOTE("%u sizes; powers of two the same bits, of ten within %.0e", sizes,
            worst);
}

/* From so far the rays are parallel: ten times further is the same picture but
 * for what perspective is left. Far eyes cost the scene no resolution. */
TEST(a_camera_1e6_scene_sizes_away_sees_what_one_at_1e3_sees)
{
    static const double distances[] = {1e4, 1e5, 1e6};
    double apart[3];
    uint8_t *blob = compile(1, 1e3);

    render(home, 256);
    free(blob);
    CHECK(mean_of(home) > 0, "black");
    for (unsigned i = 0; i < 3; i++) {
        blob = compile(1, distances[i]);
        render(away, 256);
        free(blob);
        apart[i] = distance_of(away, home);
        CHECK(apart[i] < 0.01, "%g sizes: %.2e of the light elsewhere",
                distances[i], apart[i]);
    }
    NOTE("against 1e3: at 1e4 %.0e, at 1e5 %.0e, at 1e6 %.0e of the light",
            apart[0], apart[1], apart[2]);
}

/* ---- Orders ------------------------------------------------------------ */

/* Pixels and samples in any order, in tiles, rows backwards, one by one: sums
 * are integers. Compilers and machines: tests/matrix. */
TEST(case_55_tiles_rows_and_samples_in_any_order_give_the_same_bits)
{
    const ql_settings_t s = estimate_settings(QL_SAMPLER_SOBOL, 4, 11);
    ql_render_t r;

    make_rich_room(16);
    mini_open(&m, &scene);
    render(home, 16);
    CHECK(ql_render_init(&r, &scene, &s) == QL_OK, "settings");
    memset(away, 0, sizeof away);
    for (unsigned i = PIXELS; i-- > 0;) { /* backwards, samples in halves */
        ql_render_pixel(
                &r, (uint16_t)(i % SIDE), (uint16_t)(i / SIDE), 9, 7, away + i);
        ql_render_pixel(
                &r, (uint16_t)(i % SIDE), (uint16_t)(i / SIDE), 0, 9, away + i);
    }
    CHECK(memcmp(home, away, sizeof home) == 0, "rows backwards");
    memset(away, 0, sizeof away);
    for (uint32_t k = 0; k < 16; k++) { /* sample by sample, tiles of 4 by 4 */
        for (unsigned i = 0; i < PIXELS; i++) {
            const unsigned tile = i / 16, x = tile % 3 * 4 + i % 4;
            const unsigned y = tile / 3 * 4 + i / 4 % 4;

            ql_render_pixel(&r, (uint16_t)x, (uint16_t)y, 5 * k % 16, 1,
                    away + y * SIDE + x);
        }
    }
    CHECK(memcmp(home, away, sizeof home) == 0, "tiles");
    NOTE("3 orders of pixels and samples");
}

int main(int argc, char **argv)
{
    TEST_BEGIN("extreme/scale", argc, argv);
    RUN(case_18_scenes_scaled_by_powers_of_two_hit_the_same_triangles);
    RUN(case_19_scenes_moved_by_grid_units_give_the_same_bits);
    RUN(case_20_turned_and_mirrored_scenes_have_the_same_mean);
    RUN(case_55_tiles_rows_and_samples_in_any_order_give_the_same_bits);
    RUN(scene_sizes_from_1e_minus_6_to_1e9_give_the_same_picture);
    RUN(a_camera_1e6_scene_sizes_away_sees_what_one_at_1e3_sees);
    return TEST_END();
}
