/* known_dark.c - pictures that must be exactly black */
/* SPDX-License-Identifier: MIT */

#include <stdlib.h>

#include "support/picture/estimate.h"
#include "support/ql_test.h"

static mini_scene_t m;

#define RADIANCE 0.5

/* A square in a plane of constant z, its front up or down. */
static void add_floor(
        int32_t low, int32_t high, int32_t z, bool up, uint16_t material)
{
    const int32_t a[3] = {low, low, z}, b[3] = {high, low, z};
    const int32_t c[3] = {high, high, z}, d[3] = {low, high, z};

    if (up) {
        mini_quad(&m, a, b, c, d, material);
    } else {
        mini_quad(&m, a, d, c, b, material);
    }
}

/* A pinhole with a wide field. */
static void look_down(double x, double y, double z)
{
    static const double right[3] = {0.25, 0, 0}, up[3] = {0, 0.25, 0};

    m.width = m.height = 8;
    mini_eye(&m, x, y, z);
    mini_look(&m, 0, 0, -0.25);
    mini_field(&m, right, up);
}

/* ---- Closed rooms ------------------------------------------------------ */

/* A room inside a larger one that shines; every pixel looks at its walls. */
static void make_rooms(int32_t size, unsigned node_bits, double wall_albedo)
{
    const int32_t low[3] = {200, 200, 200}, high[3] = {32000, 32000, 32000};
    const int32_t inner_low[3] = {16000 - size, 15900 - size, 16100 - size};
    const int32_t inner_high[3] = {16001 + size, 15903 + size, 16107 + size};

    mini_begin(&m);
    m.node_bits = node_bits;
    mini_room(&m, low, high, mini_material(&m, 0.9, RADIANCE));
    mini_room(&m, inner_low, inner_high, mini_material(&m, wall_albedo, 0));
    look_down(16000, 15900, 16100);
}

TEST(closed_room_under_light_is_black_after_64_bounces)
{
    const ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 64, 1);
    const int32_t sizes[3] = {64, 1000, 13000};

    for (int i = 0; i < 6; i++) {
        uint64_t sum;

        make_rooms(sizes[i / 2], i % 2 == 0 ? 16 : 8, 1);
        sum = estimate_brightest(&m, &s, 128);
        CHECK(sum == 0, "room of %ld, %u-bit nodes: %llu",
                2 * (long)sizes[i / 2], m.node_bits, (unsigned long long)sum);
    }
    NOTE("3 sizes, both node widths, 8x8 px, 128 spp");
}

TEST(open_room_is_not_black)
{
    const ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 64, 1);

    make_rooms(1000, 16, 1);
    m.triangle_count--; /* a hole: half of one wall */
    CHECK(estimate_brightest(&m, &s, 128) > 0, "no light through the hole");
}

/* A smooth ball in a wall, part of it in the light outside. Its points are
 * lifted to where a round one would be, but not through the wall. */
TEST(smooth_ball_in_the_wall_of_a_dark_room_is_black)
{
    const ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 8, 1);

    for (int i = 0; i < 3; i++) {
        const int32_t centre[3] = {16000 + 400 * i, 15900, 15100};

        make_rooms(1000, 16, 1);
        mini_smooth_ball(&m, centre, 600, 2, mini_material(&m, 1, 0));
        CHECK(estimate_brightest(&m, &s, 256) == 0, "ball %d", i);
    }
    NOTE("3 balls of 36 triangles, 8x8 px, 256 spp");
}

/* ---- Sides ------------------------------------------------------------- */

TEST(light_behind_the_receiver_gives_nothing)
{
    const ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 0, 2);

    mini_begin(&m);
    add_floor(8000, 24000, 16000, true, mini_material(&m, 1, 0));
    add_floor(15000, 17000, 15000, true, mini_material(&m, 0, RADIANCE));
    m.two_sided = true;
    look_down(16000, 16000, 20000);
    CHECK(estimate_brightest(&m, &s, 1024) == 0, "lit from below");
}

TEST(back_of_an_emitter_gives_nothing)
{
    const ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 0, 2);

    for (int two_sided = 0; two_sided < 2; two_sided++) {
        mini_begin(&m);
        add_floor(8000, 24000, 16000, true, mini_material(&m, 1, 0));
        add_floor(15000, 17000, 25000, true, mini_material(&m, 0, RADIANCE));
        m.two_sided = two_sided != 0;
        look_down(16000, 16000, 20000);
        CHECK((estimate_brightest(&m, &s, 1024) > 0) == m.two_sided,
                "two_sided %d", two_sided);
    }
    NOTE("and something if emitters are two-sided");
}

TEST(back_of_an_emitter_is_seen_black)
{
    const ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 0, 2);

    for (int up = 0; up < 2; up++) {
        mini_begin(&m);
        add_floor(8000, 24000, 16000, up != 0, mini_material(&m, 0, RADIANCE));
        look_down(16000, 16000, 20000);
        CHECK((estimate_brightest(&m, &s, 16) > 0) == (up != 0), "up %d", up);
    }
}

TEST(light_in_the_plane_of_the_receiver_gives_nothing)
{
    const ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 0, 3);

    for (int up = 0; up < 2; up++) {
        mini_begin(&m);
        add_floor(8000, 16000, 16000, true, mini_material(&m, 1, 0));
        add_floor(16000, 24000, 16000, up != 0, mini_material(&m, 0, RADIANCE));
        m.two_sided = true;
        look_down(12000, 12000, 18000);
        CHECK(estimate_brightest(&m, &s, 1024) == 0, "up %d", up);
    }
}

/* A light in a tilted plane that holds the receiver. */
TEST(light_in_a_tilted_plane_of_the_receiver_gives_nothing)
{
    const ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 0, 3);
    const int32_t a[3] = {10000, 10000, 10000}, b[3] = {14000, 10000, 13000};
    const int32_t c[3] = {14000, 15000, 13000}, d[3] = {10000, 15000, 10000};
    const int32_t e[3] = {18000, 10000, 16000}, f[3] = {18000, 15000, 16000};

    mini_begin(&m);
    mini_quad(&m, a, b, c, d, mini_material(&m, 1, 0));
    mini_quad(&m, b, e, f, c, mini_material(&m, 0, RADIANCE));
    look_down(12000, 12500, 15000);
    m.width = m.height = 1;
    CHECK(estimate_brightest(&m, &s, 4096) == 0, "lit along the plane");
}

/* ---- Gaps -------------------------------------------------------------- */

/* A gap of one ulp has no room for a point between: draft begins at two. */
TEST(plane_two_units_above_hides_all_light_or_one_in_fine)
{
    const ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 0, 4);
    const int32_t least = QL_POS_BITS > 0 ? 1 : 2;

    for (int32_t gap = least; gap <= 2; gap++) {
        const uint16_t white = (mini_begin(&m), mini_material(&m, 1, 0));

        /* seen from between the planes, along them */
        add_floor(200, 32000, 16000, true, white);
        add_floor(200, 32000, 16000 + gap, true, white);
        add_floor(10000, 22000, 20000, false, mini_material(&m, 0, RADIANCE));
        mini_eye(&m, 15000, 15000, 16000 + gap / 2.0);
        mini_look(&m, 0.5, 0.25, 0);
        m.width = m.height = 8;
        {
            static const double right[3] = {0.25, -0.5, 0};
            static const double up[3] = {0, 0, 0.5};

            mini_field(&m, right, up);
        }
        CHECK(estimate_brightest(&m, &s, 1024) == 0, "gap of %ld", (long)gap);
    }
}

/* The same receiver where nothing hides the light. */
TEST(plane_one_unit_above_is_itself_lit)
{
    const ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 0, 4);
    const uint16_t white = (mini_begin(&m), mini_material(&m, 1, 0));

    add_floor(200, 32000, 16000, true, white);
    add_floor(200, 32000, 16001, true, white);
    add_floor(10000, 22000, 20000, false, mini_material(&m, 0, RADIANCE));
    look_down(16000, 16000, 17000);
    CHECK(estimate_brightest(&m, &s, 64) > 0, "black");
}

int main(int argc, char **argv)
{
    TEST_BEGIN("known/dark", argc, argv);
    RUN(closed_room_under_light_is_black_after_64_bounces);
    RUN(open_room_is_not_black);
    RUN(smooth_ball_in_the_wall_of_a_dark_room_is_black);
    RUN(light_behind_the_receiver_gives_nothing);
    RUN(back_of_an_emitter_gives_nothing);
    RUN(back_of_an_emitter_is_seen_black);
    RUN(light_in_the_plane_of_the_receiver_gives_nothing);
    RUN(light_in_a_tilted_plane_of_the_receiver_gives_nothing);
    RUN(plane_two_units_above_hides_all_light_or_one_in_fine);
    RUN(plane_one_unit_above_is_itself_lit);
    return TEST_END();
}
