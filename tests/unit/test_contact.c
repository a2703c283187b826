/* test_contact.c - hit points have nothing between the ray's origin and them */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>

#include "support/picture/mini_scene.h"
#include "support/ql_points.h"
#include "support/ql_test.h"
#include "math/vec/ql_vec_unit.h"
#include "trace/ql_bvh.h"
#include "trace/surface/ql_surface_at.h"
#include "trace/surface/ql_contact.h"

#if QL_CFG_CONTACT
static mini_scene_t mini;
static ql_scene_t scene;

static void put(int32_t to[3], ql_vec3_t v)
{
    to[0] = v.x;
    to[1] = v.y;
    to[2] = v.z;
}

static void add(ql_vec3_t a, ql_vec3_t b, ql_vec3_t c, uint16_t material)
{
    int32_t corner[3][3];

    put(corner[0], a);
    put(corner[1], b);
    put(corner[2], c);
    mini_triangle(&mini, corner[0], corner[1], corner[2], material);
}

/* n.(p - a) of the plane through a, b and c. */
static int64_t side(ql_vec3_t a, ql_vec3_t b, ql_vec3_t c, ql_vec3_t p)
{
    const ql_vec3_t n = ql_vec_cross(ql_vec_sub(b, a), ql_vec_sub(c, a));

    return ql_vec_dot(n, ql_vec_sub(p, vec(a.x * ONE, a.y * ONE, a.z * ONE)));
}

static ql_vec3_t grid_point(int32_t low, int32_t high)
{
    return vec(
            random_in(low, high), random_in(low, high), random_in(low, high));
}

#if !QL_CFG_SMALL
/* ---- The inside -------------------------------------------------------- */

static int64_t cross2(const int64_t a[2], const int64_t b[2])
{
    return a[0] * b[1] - a[1] * b[0];
}

/* The same by each edge for itself, with 64 bits. */
static bool is_inside(const ql_vec3_t v[3], unsigned axis, ql_vec3_t p)
{
    int64_t corner[3][2], at[2], area;
    bool inside = true;

    for (unsigned i = 0; i < 4; i++) {
        const ql_vec3_t q = i < 3 ? v[i]
                                  : vec(ql_asr32(p.x, QL_POS_BITS),
                                            ql_asr32(p.y, QL_POS_BITS),
                                            ql_asr32(p.z, QL_POS_BITS));
        int64_t *to = i < 3 ? corner[i] : at;

        to[0] = axis == 0 ? q.y : q.x;
        to[1] = axis == 2 ? q.y : q.z;
    }
    {
        const int64_t a[2] = {
                corner[1][0] - corner[0][0], corner[1][1] - corner[0][1]};
        const int64_t b[2] = {
                corner[2][0] - corner[0][0], corner[2][1] - corner[0][1]};

        area = cross2(a, b);
    }
    for (unsigned i = 0; i < 3; i++) {
        const int64_t *from = corner[i], *to = corner[(i + 1) % 3];
        const int64_t edge[2] = {to[0] - from[0], to[1] - from[1]};
        const int64_t way[2] = {at[0] - from[0], at[1] - from[1]};
        const int64_t far = cross2(edge, way) * (area < 0 ? -1 : 1);

        inside = inside && far >= (int64_t)QL_CONTACT_EDGE *
                                           (llabs(edge[0]) + llabs(edge[1]));
    }
    return inside;
}

TEST(the_inside_begins_four_units_from_each_edge)
{
    static const uint16_t none[1] = {0};
    unsigned long inside = 0, edge = 0;

    memset(&scene, 0, sizeof scene);
    scene.contacts = none;
    state = 41;
    for (long i = 0; i < MANY(300000); i++) {
        const int32_t size = 1 << random_in(2, 15);
        const int32_t low = random_in(8, 32759 - (size < 32751 ? size : 32751));
        const int32_t high = low + (size < 32751 ? size : 32751);
        const ql_vec3_t v[3] = {grid_point(low, high), grid_point(low, high),
                grid_point(low, high)};
        const ql_edges_t e = {
                v[0], ql_vec_sub(v[1], v[0]), ql_vec_sub(v[2], v[0])};
        const ql_vec3_t n = ql_vec_cross(e.e1, e.e2);
        const uint32_t x = ql_abs32(n.x), y = ql_abs32(n.y), z = ql_abs32(n.z);
        const unsigned axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
        const double a = i % 4 == 0 ? 0.003 : stats_random_unit(&state);
        const double b = stats_random_unit(&state) * (1 - a);
        const ql_vec3_t p =
                i % 8 == 7
                        ? random_position()
                        : vec((int32_t)((v[0].x + a * e.e1.x + b * e.e2.x) *
                                        ONE),
                                  (int32_t)((v[0].y + a * e.e1.y + b * e.e2.y) *
                                            ONE),
                                  (int32_t)((v[0].z + a * e.e1.z + b * e.e2.z) *
                                            ONE));
        const ql_vec3_t turned = ql_vec_neg(n);
        const bool wanted = is_inside(v, axis, p);

        CHECK(ql_contact_is_clear(&scene, 0, &e, i % 2 ? &n : &turned, &p) ==
                        wanted,
                "triangle %ld: wanted %d", i, wanted);
        inside += wanted;
        edge += !wanted;
    }
    CHECK(inside > 1000 && edge > 1000, "%lu and %lu", inside, edge);
    NOTE("%lu inside, %lu not", inside, edge);
}

TEST(marks_are_a_bit_for_each_triangle)
{
    static uint16_t marks[3];
    static const ql_edges_t e = {{100, 100, 100}, {1000, 0, 0}, {0, 1000, 0}};
    const ql_vec3_t n = {0, 0, 1000000};
    const ql_vec3_t p = {400 * ONE, 400 * ONE, 100 * ONE};

    memset(&scene, 0, sizeof scene);
    CHECK(ql_contact_is_clear(&scene, 3, &e, &n, &e.v0), "without a table");
    scene.contacts = marks;
    for (uint16_t i = 0; i < 48; i++) {
        marks[i / 16] = QL_LE16((uint16_t)(1u << i % 16));
        for (uint16_t k = 0; k < 48; k++) {
            CHECK(ql_contact_is_clear(&scene, k, &e, &n, &p) == (k != i) &&
                            ql_contact_has_none(&scene, k) == (k != i),
                    "mark %u, triangle %u", i, k);
        }
        marks[i / 16] = 0;
    }
}

#endif

/* ---- Points ------------------------------------------------------------ */

/* Two triangles on a common edge, an angle below 180 degrees between their
 * fronts, and so wide that no point gets around them; a point in front of both.
 */
static ql_vec3_t wedge[4];

/* The square of a triangle's width across its first edge. */
static double width2(ql_vec3_t a, ql_vec3_t b, ql_vec3_t c)
{
    const ql_vec3_t e = ql_vec_sub(b, a);
    const ql_vec3_t n = ql_vec_cross(e, ql_vec_sub(c, a));

    return ((double)n.x * n.x + (double)n.y * n.y + (double)n.z * n.z) /
           ((double)e.x * e.x + (double)e.y * e.y + (double)e.z * e.z);
}

static bool make_wedge(ql_vec3_t *from)
{
    const int32_t size = 1 << random_in(6, 13);
    const ql_vec3_t middle = grid_point(8400, 24300);
    unsigned tries = 0;

    wedge[0] = grid_point(100, 32000);
    wedge[1] = vec(2 * middle.x - wedge[0].x, 2 * middle.y - wedge[0].y,
            2 * middle.z - wedge[0].z);
    for (unsigned i = 2; i < 4; i++) {
        wedge[i] = vec(middle.x + random_in(-size, size),
                middle.y + random_in(-size, size),
                middle.z + random_in(-size, size));
    }
    for (unsigned i = 0; i < 4; i++) {
        const ql_vec3_t w = wedge[i];

        if (w.x < 8 || w.y < 8 || w.z < 8 || w.x > 32759 || w.y > 32759 ||
                w.z > 32759) {
            return false;
        }
    }
    if (side(wedge[0], wedge[1], wedge[2],
                vec(wedge[3].x * ONE, wedge[3].y * ONE, wedge[3].z * ONE)) <=
                    0 ||
            width2(wedge[0], wedge[1], wedge[2]) < 64 * 64 ||
            width2(wedge[0], wedge[1], wedge[3]) < 64 * 64) {
        return false;
    }
    do {
        const int32_t reach = size * ONE / 2 + 3;

        *from = vec(middle.x * ONE + random_in(-reach, reach),
                middle.y * ONE + random_in(-reach, reach),
                middle.z * ONE + random_in(-reach, reach));
        if (++tries > 200) {
            return false;
        }
    } while (side(wedge[0], wedge[1], wedge[2], *from) <= 0 ||
             side(wedge[1], wedge[0], wedge[3], *from) <= 0);
    return true;
}

/* Somewhere near the middle of the common edge. */
static ql_vec3_t near_edge(void)
{
    const double t = 0.4 + 0.2 * stats_random_unit(&state);
    const ql_vec3_t a = wedge[0], b = wedge[1];

    return vec((int32_t)lrint((a.x + t * (b.x - a.x)) * ONE) + random_in(-3, 3),
            (int32_t)lrint((a.y + t * (b.y - a.y)) * ONE) + random_in(-3, 3),
            (int32_t)lrint((a.z + t * (b.z - a.z)) * ONE) + random_in(-3, 3));
}

/* Does the way from o to p, behind a triangle, go through it? Not if it goes
 * around it, as a way along its plane may. */
static bool goes_through(
        ql_vec3_t a, ql_vec3_t b, ql_vec3_t c, ql_vec3_t o, ql_vec3_t p)
{
    const ql_vec3_t corner[3] = {a, b, c};
    const double before = (double)side(a, b, c, o);
    const double after = (double)side(a, b, c, p);
    const double part = before / (before - after);
    const double at[3] = {o.x + part * (p.x - o.x), o.y + part * (p.y - o.y),
            o.z + part * (p.z - o.z)};
    const ql_vec3_t n = ql_vec_cross(ql_vec_sub(b, a), ql_vec_sub(c, a));

    if (after > 0) {
        return false;
    }
    for (unsigned i = 0; i < 3; i++) {
        const ql_vec3_t from = corner[i], to = corner[(i + 1) % 3];
        const double e[3] = {(double)to.x - from.x, (double)to.y - from.y,
                (double)to.z - from.z};
        const double s[3] = {at[0] - (double)from.x * ONE,
                at[1] - (double)from.y * ONE, at[2] - (double)from.z * ONE};

        if (n.x * (e[1] * s[2] - e[2] * s[1]) +
                        n.y * (e[2] * s[0] - e[0] * s[2]) +
                        n.z * (e[0] * s[1] - e[1] * s[0]) <
                0) {
            return false;
        }
    }
    return true;
}

/* How many points are behind a side of their wedge, through it. */
static unsigned long behind(bool contact, unsigned long *hits)
{
    unsigned long count = 0;

    *hits = 0;
    state = 43;
    for (long i = 0; i < MANY(4000); i++) {
        ql_ray_t ray;
        ql_hit_t hit;
        ql_surface_t surface;

        if (!make_wedge(&ray.origin)) {
            continue;
        }
        mini_begin(&mini);
        mini.node_bits = i % 2 ? MINI_BITS_MIN : MINI_BITS_MAX;
        mini.contact = contact;
        (void)mini_material(&mini, 1, 0);
        add(wedge[0], wedge[1], wedge[2], 0);
        add(wedge[1], wedge[0], wedge[3], 0);
        mini_open(&mini, &scene);
        for (unsigned k = 0; k < 40; k++) {
            ray.direction = ql_vec_to_dir(ql_vec_sub(near_edge(), ray.origin));
            if ((ray.direction.x | ray.direction.y | ray.direction.z) == 0 ||
                    !ql_bvh_closest_hit(&scene, &ray, &hit)) {
                continue;
            }
            ql_surface_at(&scene, &ray, &hit, &surface);
            (*hits)++;
            count += goes_through(wedge[0], wedge[1], wedge[2], ray.origin,
                             surface.p) ||
                     goes_through(wedge[1], wedge[0], wedge[3], ray.origin,
                             surface.p);
        }
    }
    return count;
}

TEST(points_next_to_an_edge_are_in_front_of_both_sides)
{
    unsigned long hits, blind;
    const unsigned long count = behind(true, &hits);

    blind = behind(false, &hits);
    CHECK(count == 0, "%lu of %lu", count, hits);
    CHECK(blind > 0, "the test sees nothing");
    NOTE("%lu hits; %lu behind if nobody looks", hits, blind);
}

#if QL_CFG_GLASS
/* A pane, and in its plane or so many units behind it another face. */
static bool crosses(int32_t behind, bool glass_first)
{
    const int32_t z = 16000;
    const ql_vec3_t a = {8000, 8000, z}, b = {24000, 8000, z},
                    c = {16000, 24000, z};
    const ql_vec3_t d = {9000, 8500, z - behind}, e = {23000, 8400, z - behind},
                    f = {16010, 23000, z - behind};
    ql_ray_t ray = {{16000 * ONE, 12000 * ONE, 20000 * ONE}, {0, 0, 0}};
    ql_surface_t surface;
    ql_hit_t hit;
    ql_vec3_t p;
    uint16_t pane;

    mini_begin(&mini);
    mini.contact = true;
    (void)mini_material(&mini, 1, 0);
    if (glass_first) {
        add(a, b, c, 0);
        add(d, e, f, 0);
    } else {
        add(d, e, f, 0);
        add(a, b, c, 0);
    }
    mini_open(&mini, &scene);
    ray.direction =
            ql_vec_to_dir(vec(131, 57, -8000)); /* to the middle of both */
    CHECK(ql_bvh_closest_hit(&scene, &ray, &hit), "no hit");
    for (pane = 0; ql_scene_corner(&scene, scene.triangles + pane, 0).x != a.x;
            pane++) {
    }
    hit.tri_idx = pane;
    ql_surface_at(&scene, &ray, &hit, &surface);
    return ql_surface_cross(&scene, pane, &surface, &p);
}

TEST(light_passes_a_pane_but_not_what_it_lies_on)
{
    for (int i = 0; i < 2; i++) {
        CHECK(!crosses(0, i != 0), "in its plane");
        CHECK(crosses(2, i != 0), "two units behind");
    }
}
#endif
#else
TEST(a_build_without_contacts_has_none)
{
    static const ql_scene_t scene;
    static const ql_vec3_t p;

    CHECK(ql_contact_has_none(&scene, 0) &&
                    ql_contact_is_clear(&scene, 0, NULL, &p, &p) &&
                    ql_contact_is_free(&scene, &p, &p, 0),
            "a contact");
}
#endif

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_contact", argc, argv);
#if QL_CFG_CONTACT
#if !QL_CFG_SMALL
    RUN(the_inside_begins_four_units_from_each_edge);
    RUN(marks_are_a_bit_for_each_triangle);
#endif
    RUN(points_next_to_an_edge_are_in_front_of_both_sides);
#if QL_CFG_GLASS
    RUN(light_passes_a_pane_but_not_what_it_lies_on);
#endif
#else
    RUN(a_build_without_contacts_has_none);
#endif
    return TEST_END();
}
