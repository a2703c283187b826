/* extreme_scenes.c - cameras in odd places, odd scenes: cases 49 to 52 */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>

#include "support/built.h"
#include "support/picture/estimate.h"
#include "support/picture/lambert.h"
#include "support/ql_points.h"
#include "support/ql_test.h"
#include "qlux.h"
#include "math/vec/ql_vec_unit.h"
#include "scene/blob/write_blob.h"
#include "scene/build/compile.h"
#include "trace/ql_bvh.h"
#include "trace/ql_order.h"

#define RADIANCE 0.5

static mini_scene_t m;
static ql_scene_t scene;

static const int32_t low[3] = {1000, 1000, 1000};
static const int32_t high[3] = {31000, 31000, 31000};

static ql_settings_t settings_of(unsigned direct, uint8_t bounces)
{
    ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, bounces, 49);

    s.direct = (uint8_t)direct;
    return s;
}

static bool is_built(unsigned direct)
{
    return BUILT_HAS_DIRECT(direct);
}

/* Two of them: counter-clockwise seen from above, if up. */
static void add_square(
        int32_t from, int32_t to, int32_t z, bool up, uint16_t material)
{
    const int32_t a[3] = {from, from, z}, b[3] = {to, from, z};
    const int32_t c[3] = {to, to, z}, d[3] = {from, to, z};

    mini_quad(&m, a, up ? b : d, c, up ? d : b, material);
}

/* ---- Cameras ----------------------------------------------------------- */

static unsigned pictures;

/* Every direction from an eye: finite, uncut, and the same twice. Returns the
 * sum of all pixels. */
static uint64_t look_around(double x, double y, double z, uint8_t bounces)
{
    static const double right[3] = {0.5, 0.1, 0}, up[3] = {0.1, 0.5, 0.2};
    static const double ways[][3] = {{0, 0, 0.4}, {0, 0, -0.4}, {0.4, 0, 0},
            {-0.4, 0, 0}, {0, 0.4, 0}, {0, -0.4, 0}, {0.3, 0.3, 0.3}};
    uint64_t total = 0;

    mini_eye(&m, x, y, z);
    mini_field(&m, right, up);
    m.width = m.height = 6;
    for (unsigned way = 0; way < 7; way++) {
        const ql_settings_t s = settings_of(QL_DIRECT_AREA, bounces);
        ql_render_t r;

        mini_look(&m, ways[way][0], ways[way][1], ways[way][2]);
        mini_open(&m, &scene);
        CHECK(ql_render_init(&r, &scene, &s) == QL_OK, "settings");
        for (uint16_t i = 0; i < 36; i++) {
            ql_sum_t sum = {{0, 0, 0}}, again = {{0, 0, 0}};

            ql_render_pixel(&r, i % 6, i / 6, 0, 8, &sum);
            ql_render_pixel(&r, i % 6, i / 6, 0, 8, &again);
            CHECK(memcmp(&sum, &again, sizeof sum) == 0, "not the same twice");
            CHECK(sum.rgb[0] <= 8 * QL_CONTRIBUTION_MAX, "px %u: %llu", i,
                    (unsigned long long)sum.rgb[0]);
            total += sum.rgb[0];
        }
        pictures++;
    }
    return total;
}

/* A closed room of which the walls shine, so a ray that leaves is seen. */
static void make_shining_room(void)
{
    mini_begin(&m);
    mini_room(&m, low, high, mini_material(&m, 0.5, RADIANCE));
}

TEST(case_49_camera_in_a_light_on_a_plane_or_at_a_vertex_sees_a_picture)
{
    const uint64_t full = (uint64_t)7 * 36 * 8 << (QL_SUM_BITS - 1);
    const ql_settings_t seen = settings_of(QL_DIRECT_NONE, 0);
    uint64_t sum;

    pictures = 0;
    /* in the middle, on a wall's plane and at a corner of it: a ray hits what
     * lies ahead, never the plane it begins in */
    make_shining_room();
    CHECK(look_around(16000, 16000, 16000, 2) >= full, "in the middle");
    sum = look_around(1000, 16000, 16000, 2);
    CHECK(sum > full / 4, "on a wall: %g of it", (double)sum / (double)full);
    sum = look_around(1000, 1000, 1000, 2);
    CHECK(sum > 0, "at a corner: nothing is seen");
    sum = look_around(1000, 1000, 16000, 2);
    CHECK(sum > 0, "on an edge: nothing is seen");
    /* outwards from a vertex: nothing is ahead */
    m.width = m.height = 1;
    mini_eye(&m, 1000, 1000, 1000);
    mini_look(&m, -0.3, -0.3, -0.3);
    CHECK(estimate_pixel(&m, &seen, 0, 0, 16).mean == 0, "outwards");
#if QL_CFG_SPHERES
    /* in a sphere light: its inside shines if it is two-sided */
    for (unsigned two = 0; two < 2; two++) {
        static const int32_t centre[3] = {
                16000 * 256, 16000 * 256, 16000 * 256};
        static const double eyes[][3] = {{16000, 16000, 16000},
                {16400.5, 15900.25, 16000}, {16000, 16000, 16999.99}};

        mini_begin(&m);
        m.two_sided = two;
        (void)mini_sphere(
                &m, centre, 1000 * 256, mini_material(&m, 0, RADIANCE));
        for (unsigned i = 0; i < 3; i++) {
            sum = look_around(eyes[i][0], eyes[i][1], eyes[i][2], 0);
            /* in draft the last eye is on the sphere: half of it is outside */
            CHECK(sum == (two ? full : 0) ||
                            (QL_POS_BITS == 0 && i == 2 && sum < full),
                    "eye %u, two-sided %u: %g of it", i, two,
                    (double)sum / (double)full);
        }
        (void)look_around(16000, 16000, 17000, 0); /* on it */
    }
#endif
    NOTE("%u pictures from 8 places, none cut, each the same twice", pictures);
}

/* ---- Nothing at all ---------------------------------------------------- */

static uint64_t total_of(uint8_t bounces)
{
    uint64_t sum = 0;

    for (unsigned direct = QL_DIRECT_NONE; direct <= QL_DIRECT_MIS; direct++) {
        const ql_settings_t s = settings_of(direct, bounces);

        if (is_built(direct)) {
            sum += estimate_brightest(&m, &s, 16);
        }
    }
    return sum;
}

TEST(case_50_empty_scenes_no_lights_one_triangle_one_pixel_no_samples)
{
    static const int32_t a[3] = {8, 8, 20000}, b[3] = {32759, 8, 20000};
    static const int32_t c[3] = {8, 32759, 20000};
    ql_settings_t s = settings_of(QL_DIRECT_AREA, 64);
    ql_uq16_t linear[3] = {1, 1, 1};
    const ql_sum_t sum = {{5, 5, 5}};
    ql_render_t r;

    for (unsigned bits = 8; bits <= 16; bits += 8) {
        mini_begin(&m);
        m.node_bits = bits;
        CHECK(total_of(64) == 0, "an empty scene is not black");
        mini_open(&m, &scene);
        CHECK(scene.light_count == 0 && m.triangle_count == 0, "lights");
        (void)mini_material(&m, 1, 0);
        mini_triangle(&m, a, c, b, 0);
        mini_eye(&m, 8000, 8000, 10000);
        CHECK(total_of(64) == 0, "a scene without lights is not black");
        m.materials[0].emission[1] = RADIANCE;
        CHECK(total_of(0) == 6 * ((uint64_t)16 << (QL_SUM_BITS - 1)) ||
                        QL_CFG_DIRECT != 63,
                "one triangle that shines");
    }
    mini_open(&m, &scene);
    s.spp = 0;
    CHECK(ql_render_init(&r, &scene, &s) == QL_ERR_SETTINGS && r.scene == NULL,
            "no samples are rendered");
    ql_film_display(&sum, 0, (ql_real_t){0x80000000u, -31}, linear);
    CHECK(linear[0] == 0 && linear[1] == 0 && linear[2] == 0,
            "the mean of no samples is not black");
    s.spp = 1;
    s.width = s.height = 1;
    CHECK(ql_render_init(&r, &scene, &s) == QL_OK, "one pixel, one sample");
    NOTE("6 strategies, both node widths; 0 spp is QL_ERR_SETTINGS");
}

/* ---- Many alike -------------------------------------------------------- */

static world_t world;
static uint8_t *blob;
static uint32_t depth;

static void open_world(void)
{
    static const world_camera_t camera = {
            {0.5, 0.5, 3}, {0.5, 0.5, 0}, {0, 1, 0}, 40};

    memset(&world, 0, sizeof world);
    world.camera = camera;
    world.width = world.height = 16;
    (void)world_add_material(&world, "m", 1);
    world.materials[0].kd[0] = 0.5;
}

static void add_triangle(const double p[3][3])
{
    world_face_t face;

    memset(&face, 0, sizeof face);
    for (unsigned i = 0; i < 3; i++) {
        face.vertex[i] = (uint32_t)world_add_vertex(&world, p[i]);
    }
    world_add_face(&world, &face);
}

/* Compile the world as qlux-scene does, and open it. Triangles it has. */
static uint32_t compile(unsigned node_bits)
{
    const compile_options_t options = {node_bits, 4, true};
    model_t model;
    size_t bytes;
    uint32_t count;

    compile_scene(&model, &world, &options);
    depth = model.header.depth;
    blob = write_blob(&model, &bytes);
    CHECK(ql_blob_open(&scene, blob, bytes) == QL_OK, "the core refuses it");
    CHECK(depth <= QL_DEPTH_MAX, "depth %lu", (unsigned long)depth);
    count = model.triangles_count;
    model_free(&model);
    return count;
}

static unsigned long hits;

/* Of hits within rounding the exact order decides, which test_order.c tests. */
static bool is_before(const ql_hit_t *a, const ql_hit_t *b)
{
    return ql_order_is_close(&scene, a, b)
                   ? ql_order_is_before_exactly(&scene, a, b)
                   : ql_order_is_before_as_rounded(a, b);
}

/* The tree finds what all triangles one by one do. */
static void check_rays(uint32_t count, unsigned rays)
{
    for (unsigned i = 0; i < rays; i++) {
        ql_scene_t leaf = scene;
        ql_hit_t got, best, one;
        ql_ray_t ray;
        bool any = false, found;

        ray.origin = random_position();
        ray.direction =
                ql_vec_to_dir(ql_vec_sub(random_position(), ray.origin));
        if (i & 1) { /* at a corner, so that something is hit */
            const ql_vec3_t c = ql_scene_corner(&scene,
                    scene.triangles +
                            stats_random_below(&state, (uint64_t)count),
                    i % 3);

            ray.direction = ql_vec_to_dir(ql_vec_sub(
                    vec(c.x * ONE + 1, c.y * ONE + 1, c.z * ONE), ray.origin));
        }
        best.t = 0;
        best.tri_idx = 0;
        for (uint32_t k = 0; k < count; k += QL_LEAF_MAX) {
            leaf.root_link = (uint16_t)k;
            leaf.root_meta =
                    (uint8_t)(3 + (count - k < QL_LEAF_MAX ? count - k
                                                           : QL_LEAF_MAX));
            if (ql_bvh_closest_hit(&leaf, &ray, &one) &&
                    (!any || is_before(&one, &best))) {
                best = one;
                any = true;
            }
        }
        found = ql_bvh_closest_hit(&scene, &ray, &got);
        CHECK(found == any && (!any || (got.t == best.t &&
                                               got.tri_idx == best.tri_idx)),
                "ray %u: %d triangle %u, one by one %d triangle %u", i, found,
                got.tri_idx, any, best.tri_idx);
        hits += any;
    }
}

static void add_random(double size)
{
    double p[3][3];

    for (unsigned k = 0; k < 3; k++) {
        const double at = stats_random_unit(&state) * (1 - size);

        for (unsigned i = 0; i < 3; i++) {
            p[i][k] = at + stats_random_unit(&state) * size;
        }
    }
    add_triangle((const double(*)[3])p);
}

/* Nothing tells the boxes of such triangles apart. */
static void add_both_sides_in_the_unit_cube(void)
{
    const double a = stats_random_unit(&state), b = stats_random_unit(&state);
    const double c = stats_random_unit(&state);
    const double front[3][3] = {{0, 0, 0}, {1, 1, a}, {b, c, 1}};
    const double back[3][3] = {{0, 0, 0}, {b, c, 1}, {1, 1, a}};

    add_triangle(front);
    add_triangle(back);
}

TEST(case_51_1000_triangles_of_one_box_and_1000_in_a_row_build_and_trace)
{
    uint32_t one_box = 0, row = 0;

    state = 51;
    hits = 0;
    for (unsigned bits = 8; bits <= 16; bits += 8) {
        open_world();
        for (unsigned i = 0; i < 1000; i += 2) {
            add_both_sides_in_the_unit_cube();
        }
        CHECK(compile(bits) == 1000, "triangles of one box are lost");
        one_box = depth;
        check_rays(1000, 2000);
        free(blob);
        world_free(&world);
        open_world();
        for (unsigned i = 0; i < 1000; i++) {
            const double x = i;
            const double p[3][3] = {{x, 0, 0}, {x + 1, 0, 1}, {x, 1, 1}};

            add_triangle(p);
        }
        CHECK(compile(bits) == 1000, "triangles in a row are lost");
        row = depth;
        check_rays(1000, 2000);
        free(blob);
        world_free(&world);
    }
    CHECK(hits > 1000, "%lu hits", hits);
    NOTE("depths %lu and %lu of %u; 8000 rays, %lu hits as one by one",
            (unsigned long)one_box, (unsigned long)row, QL_DEPTH_MAX, hits);
}

TEST(scenes_of_65000_triangles_build_and_trace_exactly)
{
    uint32_t count;

    state = 65;
    hits = 0;
    open_world();
    for (unsigned i = 0; i < 65000; i++) {
        add_random(0.02);
    }
    count = compile(8);
    CHECK(count > 64900, "%lu triangles", (unsigned long)count);
    check_rays(count, 60);
    NOTE("%lu triangles, depth %lu; 60 rays, %lu hits", (unsigned long)count,
            (unsigned long)depth, hits);
    free(blob);
    world_free(&world);
}

/* ---- Counted once ------------------------------------------------------ */

/* By cosine, with one half, a sample is exactly 2 less 2^-65 of the emission:
 * an emitter that were counted when it is hit, and when it is sampled, would
 * make it 3. By area 1/r^2 is unbounded in a corner, so there a light wall is
 * seen from a dark floor. */
TEST(case_52_emitters_that_rays_hit_are_counted_once)
{
    double worst = 0;

    for (unsigned direct = QL_DIRECT_AREA; direct <= QL_DIRECT_MIS; direct++) {
        ql_settings_t s = settings_of(direct, 64);
        stats_moments_t got, pictures_of = {0, 0, 0};
        double z;

        if (!is_built(direct)) {
            continue;
        }
        make_shining_room();
        m.radiance_exp = 6;
        mini_eye(&m, 14000, 17000, 12000);
        mini_look(&m, 0.125, 0.0625, 0.25);
        if (direct == QL_DIRECT_COSINE) {
            s.bounces = 20;
            got = estimate_pixel(&m, &s, 0, 0, MANY(200));
            /* no spread but that of faint bounces, rounded by chance: 20 times
             * a quarter of the square of a sum's ulp, 2^(6 - 24) */
            CHECK(got.m2 / got.n <= 5 * 0x1p-36 &&
                            fabs(got.mean / RADIANCE - 2) < 0x1p-16,
                    "by cosine: %.9f, m2 %g", got.mean / RADIANCE, got.m2);
            continue;
        }
        for (unsigned i = 0; i < 12; i++) {
            s.seed = 100 + i;
            stats_add(&pictures_of,
                    estimate_pixel(&m, &s, 0, 0, 400).mean / RADIANCE);
        }
        /* Student's t of 11 degrees of freedom */
        z = (pictures_of.mean - 2) / sqrt(stats_variance(&pictures_of) / 12);
        CHECK(fabs(z) < 9.6 && pictures_of.mean < 2.5,
                "direct %u: %.4f, not 2, t %.1f", direct, pictures_of.mean, z);
        worst = fmax(worst, fabs(pictures_of.mean - 2));
        /* counted again where it is hit: 1 + 2 (1/2 + 1/4 + ..) */
        z = (2 * pictures_of.mean - 1 - 2) /
            sqrt(4 * stats_variance(&pictures_of) / 12);
        CHECK(z > 9.6, "direct %u: counted twice is not told apart", direct);
    }
    NOTE("5 strategies, 64 bounces: 2, within %.3f; by cosine exactly", worst);
}

/* ---- Duplicates -------------------------------------------------------- */

static void render(ql_sum_t sums[64], unsigned node_bits)
{
    const ql_settings_t s = settings_of(QL_DIRECT_AREA, 4);
    ql_render_t r;

    m.node_bits = node_bits;
    m.width = m.height = 8;
    mini_open(&m, &scene);
    memset(sums, 0, 64 * sizeof *sums);
    CHECK(ql_render_init(&r, &scene, &s) == QL_OK, "settings");
    for (uint16_t i = 0; i < 64; i++) {
        ql_render_pixel(&r, i % 8, i / 8, 0, 16, sums + i);
    }
}

static void make_floor_and_lamp(unsigned copies, bool overlap)
{
    static const double right[3] = {0.25, 0, 0}, up[3] = {0, 0.25, 0};
    const uint16_t white = (mini_begin(&m), mini_material(&m, 0.75, 0));
    const uint16_t lamp = mini_material(&m, 0, RADIANCE);

    for (unsigned i = 0; i < copies; i++) {
        add_square(1000, 31000, 8000, true, white);
        add_square(9000, 15000, 11000, true, white);
    }
    if (overlap) {
        add_square(2000, 8000, 8000, true, white);
        add_square(1500, 30500, 8000, false, white);
    }
    add_square(12000, 20000, 20000, false, lamp);
    mini_eye(&m, 14000, 16000, 18000);
    mini_look(&m, 0.01, 0.02, -0.3);
    mini_field(&m, right, up);
}

/* The same triangle again is hit at the same parameter. Another one of the same
 * plane may be hit at one an ulp of 2^-30 smaller, which moves a few points by
 * an ulp. */
TEST(coplanar_and_duplicate_triangles_change_no_bit_or_ulps)
{
    static ql_sum_t alone[64], many[64];
    double most = 0;

    for (unsigned bits = 8; bits <= 16; bits += 8) {
        make_floor_and_lamp(1, false);
        render(alone, bits);
        make_floor_and_lamp(9, false);
        render(many, bits);
        CHECK(memcmp(alone, many, sizeof alone) == 0, "9 copies, %u-bit nodes",
                bits);
        make_floor_and_lamp(1, true);
        render(many, bits);
        for (unsigned i = 0; i < 64; i++) {
            most = fmax(most,
                    fabs((double)many[i].rgb[0] - (double)alone[i].rgb[0]) /
                            (double)(alone[i].rgb[0] + 1));
        }
    }
    CHECK(most < 1e-3, "overlapping: %.1e", most);
    NOTE("9 copies, both node widths, 64 px; overlapping within %.0e", most);
}

/* ---- Small and large lamps --------------------------------------------- */

/* A lamp of one grid unit, so far above a floor. */
static void check_small(int32_t height, double *worst)
{
    const int32_t z = 8000 + height;
    const int32_t a[3] = {16000, 16000, z}, b[3] = {16000, 16001, z};
    const int32_t c[3] = {16001, 16000, z};
    const ql_settings_t s = settings_of(QL_DIRECT_AREA, 0);
    const double n[3] = {0, 0, 1};
    const double h = height - 2.0 / ONE; /* both are lifted by an ulp */
    const double corner[3][3] = {{-4, -4, h}, {-4, -3, h}, {-3, -4, h}};
    const lambert_moments_t e = lambert_triangle_sampling(corner, n, 200);
    stats_moments_t got;

    mini_begin(&m);
    add_square(15000, 17000, 8000, true, mini_material(&m, 1, 0));
    mini_triangle(&m, a, b, c, mini_material(&m, 0, RADIANCE));
    mini_eye(&m, 16004, 16034, 8030);
    mini_look(&m, 0, -0.5, -0.5);
    got = estimate_pixel(&m, &s, 0, 0, 1u << 14);
    /* points of a unit are rounded to an ulp: in draft to its corners */
    CHECK(fabs(got.mean / RADIANCE - e.mean) <
                    STATS_Z_MAX * sqrt(e.variance / got.n) +
                            0x1p-25 / RADIANCE +
                            (QL_POS_BITS > 0 ? 1e-3 : 0.05) * e.mean,
            "%ld above: %.9f, want %.9f", (long)height, got.mean / RADIANCE,
            e.mean);
    *worst = fmax(*worst, fabs(got.mean / RADIANCE / e.mean - 1));
}

TEST(lamps_of_one_grid_unit_have_their_form_factor)
{
    double near = 0, far = 0;

    check_small(10, &near);
    check_small(30, &near);
    check_small(100, &near);
    check_small(1000, &far);
    NOTE("10 to 100 units above within %.0e; at 1000, 1.3 ulp of a sum: %.0e",
            near, far);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("extreme/scenes", argc, argv);
    RUN(case_49_camera_in_a_light_on_a_plane_or_at_a_vertex_sees_a_picture);
    RUN(case_50_empty_scenes_no_lights_one_triangle_one_pixel_no_samples);
    RUN(case_51_1000_triangles_of_one_box_and_1000_in_a_row_build_and_trace);
    RUN(scenes_of_65000_triangles_build_and_trace_exactly);
    RUN(case_52_emitters_that_rays_hit_are_counted_once);
    RUN(coplanar_and_duplicate_triangles_change_no_bit_or_ulps);
    RUN(lamps_of_one_grid_unit_have_their_form_factor);
    return TEST_END();
}
