/* test_segment.c - what blocks a segment next to either of its ends */
/* SPDX-License-Identifier: MIT */

/* A segment is open: what lies on an end does not block it, what is one unit of
 * the last place inside does. One that is closed at its far end is blocked by
 * what lies there too. Plates and spheres are put 0, 1 and 2 units from either
 * end, as segments and as shadows of lamps in a picture. */

#include "support/built.h"
#include "support/picture/estimate.h"
#include "support/ql_points.h"
#include "support/ql_table_error.h"
#include "support/ql_test.h"
#include "trace/ql_bvh.h"

static mini_scene_t mini;
static ql_scene_t scene;

/* Distances from an end, in position ulps; below 0: beyond it. */
static const int32_t steps[] = {0, 1, 2, ONE, 2 * ONE, 40 * ONE, 15000 * ONE};
enum { STEPS = sizeof steps / sizeof steps[0], MIDDLE = 16000, REACH = 3000 };

/* Things far from every segment, so that the tree has boxes to look into. */
static void add_far(uint16_t white)
{
    for (int32_t i = 0; i < 4; i++) {
        const int32_t a[3] = {500 + 300 * i, 900, 700 + i};
        const int32_t b[3] = {700 + 300 * i, 1000, 800};
        const int32_t c[3] = {600 + 300 * i, 1100, 900};

        mini_triangle(&mini, a, b, c, white);
    }
}

/* ---- Plates ------------------------------------------------------------ */

/* A square about the middle, perpendicular to an axis, or the plane in which
 * x + y + z is constant (axis 3). */
static void build_plate(unsigned axis, unsigned bits)
{
    static const int32_t flat[4][2] = {
            {-REACH, -REACH}, {REACH, -REACH}, {REACH, REACH}, {-REACH, REACH}};
    int32_t v[4][3];
    uint16_t white;

    for (unsigned i = 0; i < 4; i++) {
        const int32_t a = flat[i][0], b = flat[i][1];

        for (unsigned k = 0; k < 3; k++) {
            v[i][k] = MIDDLE + (k == axis ? 0 : k == (axis + 1) % 3 ? a : b);
        }
        if (axis == 3) {
            v[i][0] = MIDDLE + a;
            v[i][1] = MIDDLE + b;
            v[i][2] = MIDDLE - a - b;
        }
    }
    mini_begin(&mini);
    mini.node_bits = bits;
    mini.leaf_max = 1;
    white = mini_material(&mini, 0.5, 0);
    add_far(white);
    mini_quad(&mini, v[0], v[1], v[2], v[3], white);
    mini_open(&mini, &scene);
}

static unsigned long segments, blocked;

/* From one side of the plate by so many ulps to the other, with what is added
 * along the plate. */
static void check_plate(
        unsigned axis, int32_t from, int32_t to, ql_vec3_t along)
{
    const int32_t middle = MIDDLE * ONE;
    ql_ray_t ray = {{middle + 37, middle - 11, middle + 5}, {0, 0, 0}};
    bool got, wanted = (from > 0 && to < 0) || (from < 0 && to > 0);
    ql_vec3_t end;

    if (axis == 3) { /* x + y + z is what counts */
        ray.origin.z = 3 * middle - ray.origin.x - ray.origin.y;
        along.z = -along.x - along.y;
    }
    end = vec(ray.origin.x + along.x, ray.origin.y + along.y,
            ray.origin.z + along.z);
    switch (axis) {
    case 0:
        ray.origin.x = middle + from;
        end.x = middle + to;
        break;
    case 1:
        ray.origin.y = middle + from;
        end.y = middle + to;
        break;
    default:
        ray.origin.z += axis == 2 ? middle + from - ray.origin.z : from;
        end.z += axis == 2 ? middle + to - end.z : to;
    }
    ray.direction = vec(
            end.x - ray.origin.x, end.y - ray.origin.y, end.z - ray.origin.z);
    got = ql_bvh_occluded(&scene, &ray);
    CHECK(got == wanted,
            "axis %u, %ld ulps before to %ld beyond, %ld %ld %ld along: %s",
            axis, (long)from, (long)to, (long)along.x, (long)along.y,
            (long)along.z, got ? "blocked" : "free");
#if QL_CFG_CONTACT
    CHECK(from == 0 || ql_bvh_touches(&scene, &ray, (uint16_t)QL_TRI_MAX) ==
                               (wanted || to == 0),
            "axis %u, %ld ulps before to %ld beyond: end not closed", axis,
            (long)from, (long)to);
#endif
    segments++;
    blocked += got;
}

TEST(a_plate_blocks_what_has_an_end_on_either_side_of_it)
{
    static const int32_t slants[][3] = {
            {0, 0, 0}, {1, 0, -1}, {700, 300, -500}, {-2900, 2500, 1800}};

    segments = blocked = 0;
    for (unsigned i = 0; i < 4 * 2; i++) {
        const unsigned bits = i < 4 ? MINI_BITS_MIN : MINI_BITS_MAX;

        build_plate(i % 4, bits);
        for (unsigned k = 0; k < STEPS * STEPS * 4 * 4; k++) {
            const int32_t a = steps[k % STEPS], b = steps[k / STEPS % STEPS];
            const unsigned signs = k / (STEPS * STEPS) % 4;
            const int32_t *const s = slants[k / (STEPS * STEPS) / 4];

            check_plate(i % 4, signs & 1 ? -a : a, signs & 2 ? -b : b,
                    vec(s[0] * ONE, s[1] * ONE, s[2] * ONE));
        }
    }
    NOTE("%lu segments, %lu blocked", segments, blocked);
}

/* ---- Spheres ----------------------------------------------------------- */

#if QL_CFG_SPHERES

/* From so many ulps outside a sphere (or inside) towards its centre and on, to
 * so many ulps outside of its other side, or of the same one. */
static void check_sphere(
        int32_t r, unsigned axis, int32_t from, int32_t to, bool same)
{
    const int32_t c = MIDDLE * ONE;
    const int32_t begin = r + from, end = same ? r + to : -r - to;
    ql_ray_t ray = {{c, c, c}, {0, 0, 0}};
    /* passing from side to side; or through the middle, from outside */
    const bool wanted = (from > 0 && to < 0) || (from < 0 && to > 0) ||
                        (!same && (from > 0 || to > 0));
    bool got;

    if (from <= -r || to <= -r || (same && (from == 0 || to == 0))) {
        return; /* past the centre; a point on it is stepped off it before */
    }
    switch (axis) {
    case 0:
        ray.origin.x += begin;
        ray.direction.x = end - begin;
        break;
    case 1:
        ray.origin.y += begin;
        ray.direction.y = end - begin;
        break;
    default:
        ray.origin.z += begin;
        ray.direction.z = end - begin;
    }
    got = ql_bvh_occluded(&scene, &ray);
    CHECK(got == wanted, "axis %u, from %ld to %ld ulps outside, %s side: %s",
            axis, (long)from, (long)to, same ? "the same" : "the other",
            got ? "blocked" : "free");
#if QL_CFG_CONTACT
    CHECK(from == 0 || ql_bvh_touches(&scene, &ray, (uint16_t)QL_TRI_MAX) ==
                               (wanted || to == 0),
            "axis %u, from %ld to %ld ulps outside: end not closed", axis,
            (long)from, (long)to);
#endif
    segments++;
    blocked += got;
}

TEST(a_sphere_blocks_what_has_one_end_outside_and_passes_it)
{
    static const int32_t centre[3] = {MIDDLE * 256, MIDDLE * 256, MIDDLE * 256};

    segments = blocked = 0;
    for (unsigned k = 0; k < STEPS * STEPS * 4 * 3 * 2; k++) {
        const int32_t radius = k < STEPS * STEPS * 4 * 3 ? 1 : 500;
        const int32_t a = steps[k % STEPS], b = steps[k / STEPS % STEPS];
        const unsigned signs = k / (STEPS * STEPS) % 4;

        const unsigned axis = k / (STEPS * STEPS) / 4 % 3;

        if (k % (STEPS * STEPS * 4 * 3) == 0) {
            mini_begin(&mini);
            add_far(mini_material(&mini, 0.5, 0));
            (void)mini_sphere(&mini, centre, radius * 256, 0);
            mini_open(&mini, &scene);
        }

        check_sphere(radius * ONE, axis, signs & 1 ? -a : a, signs & 2 ? -b : b,
                true);
        check_sphere(radius * ONE, axis, signs & 1 ? -a : a, signs & 2 ? -b : b,
                false);
    }
    NOTE("%lu segments, %lu blocked", segments, blocked);
}

#endif

/* ---- Shadows of lamps -------------------------------------------------- */

#if QL_CFG_LIGHTS

enum { FLOOR = 12000, LAMP = 12400, SHADOW_SAMPLES = 64, NOTHING = -1000 };

static void add_square(int32_t half, int32_t z, bool up, uint16_t material)
{
    const int32_t low = MIDDLE - half, high = MIDDLE + half;
    const int32_t a[3] = {low, low, z}, b[3] = {high, low, z};
    const int32_t c[3] = {high, high, z}, d[3] = {low, high, z};

    if (up) {
        mini_quad(&mini, a, b, c, d, material);
    } else {
        mini_quad(&mini, d, c, b, a, material);
    }
}

typedef enum { SQUARE_LAMP, ROUND_LAMP } lamp_t;

/* The light of a floor under a lamp, with a plate between both at a height. */
static uint64_t light_past(
        lamp_t lamp, int32_t height, unsigned direct, unsigned bits)
{
    static const int32_t centre[3] = {
            MIDDLE * 256, MIDDLE * 256, (LAMP + 200) * 256};
    ql_settings_t settings = estimate_settings(
            BUILT_HAS_SAMPLER(QL_SAMPLER_SOBOL) ? QL_SAMPLER_SOBOL
                                                : QL_SAMPLER_RANDOM,
            0, 5);
    uint16_t white, shining;

    mini_begin(&mini);
    mini.node_bits = bits;
    mini.leaf_max = 1;
    white = mini_material(&mini, 0.5, 0);
    shining = mini_material(&mini, 0, 0.5);
    add_far(white);
    add_square(300, FLOOR, true, white);
    if (lamp == ROUND_LAMP) {
        (void)mini_sphere(&mini, centre, 200 * 256, shining);
    } else {
        add_square(200, LAMP, false, shining);
    }
    if (height != NOTHING) {
        add_square(1000, height, false, white);
    }
    /* from below any plate */
    mini_eye(&mini, MIDDLE + 3, MIDDLE - 7, FLOOR + 1);
    mini_look(&mini, 0, 0, -0.5);
    settings.direct = (uint8_t)direct;
    return estimate_brightest(&mini, &settings, SHADOW_SAMPLES);
}

static void check_shadow(lamp_t lamp, int32_t height, bool lit, unsigned direct)
{
    for (unsigned bits = MINI_BITS_MIN; bits <= MINI_BITS_MAX; bits += 8) {
        const uint64_t all = light_past(lamp, NOTHING, direct, bits);
        const uint64_t got = light_past(lamp, height, direct, bits);

        CHECK(all > 0 && got == (lit ? all : 0),
                "a plate %ld above the floor, %ld below the lamp, direct %u: "
                "%lu of %lu",
                (long)(height - FLOOR), (long)(LAMP - height), direct,
                (unsigned long)got, (unsigned long)all);
        segments++;
    }
}

/* By points on the lamp, by directions to it, and by rays that may meet it. A
 * point of the floor is an ulp above it, one that is drawn on the lamp an ulp
 * below it. In draft that is a grid unit, so a plate there is at an end. */
TEST(a_plate_a_unit_from_a_lamp_or_from_the_floor_hides_the_lamp)
{
    static const uint8_t directs[] = {QL_DIRECT_AREA, QL_DIRECT_SOLID_ANGLE,
            QL_DIRECT_HEMISPHERE, QL_DIRECT_COSINE, QL_DIRECT_MIS};
    const bool draft = QL_POS_BITS == 0;

    segments = 0;
    for (unsigned i = 0; i < 5; i++) {
        const unsigned direct = directs[i];
        const bool drawn = i < 2;

        /* Directions of a solid angle or of a sphere's cone, by coarse tables,
         * do not end where the lamp is. */
        if (!BUILT_HAS_DIRECT(direct) ||
                (!TABLES_EXACT && (direct == QL_DIRECT_SOLID_ANGLE ||
                                          direct == QL_DIRECT_MIS))) {
            continue;
        }
        for (int32_t beyond = 1; beyond <= 3; beyond++) {
            check_shadow(SQUARE_LAMP, LAMP + beyond, true, direct);
            check_shadow(SQUARE_LAMP, FLOOR - beyond, true, direct);
        }
        if (drawn) { /* of a ray's two hits at once the lower index counts */
            check_shadow(SQUARE_LAMP, LAMP, true, direct);
        }
        if (!draft || direct != QL_DIRECT_MIS) { /* which is half of each */
            check_shadow(SQUARE_LAMP, LAMP - 1, draft && drawn, direct);
        }
        check_shadow(SQUARE_LAMP, FLOOR + 1, draft, direct);
        for (int32_t inside = 2; inside <= 3; inside++) {
            check_shadow(SQUARE_LAMP, LAMP - inside, false, direct);
            check_shadow(SQUARE_LAMP, FLOOR + inside, false, direct);
        }
        if (QL_CFG_SPHERES) {
            check_shadow(ROUND_LAMP, LAMP - 1, false, direct);
            check_shadow(ROUND_LAMP, LAMP - 2, false, direct);
            check_shadow(ROUND_LAMP, FLOOR + 2, false, direct);
        }
    }
    NOTE("%lu pictures", segments);
}

#endif

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_segment", argc, argv);
    RUN(a_plate_blocks_what_has_an_end_on_either_side_of_it);
#if QL_CFG_SPHERES
    RUN(a_sphere_blocks_what_has_one_end_outside_and_passes_it);
#endif
#if QL_CFG_LIGHTS
    RUN(a_plate_a_unit_from_a_lamp_or_from_the_floor_hides_the_lamp);
#endif
    return TEST_END();
}
