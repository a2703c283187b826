/* test_smooth.c - interpolated normals, and lifted points, against double */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <string.h>

#include "support/picture/mini_scene.h"
#include "support/ql_points.h"
#include "support/ql_stats.h"
#include "support/ql_test.h"
#include "math/vec/ql_vec_unit.h"
#include "trace/ql_bvh.h"
#include "trace/surface/ql_smooth.h"
#include "trace/surface/ql_surface_at.h"
#include "trace/ql_tri.h"

#if QL_CFG_SMOOTH

enum {
    LOW = QL_GRID_MARGIN,
    HIGH = QL_GRID_MAX - QL_GRID_MARGIN,
    RAYS = MANY(100000)
};

/* What ql_surface_at.h says. */
#define LENGTH_BOUND ldexp(1, -25)

typedef struct {
    double x, y, z;
} normal_t;

/* ---- One triangle, in one leaf ----------------------------------------- */

static struct {
    ql_scene_t scene;
    ql_blob_vertex_t vertices[3];
    ql_blob_normal_t normals[3];
    ql_blob_tri_t tri;
    ql_vec3_t corner[3];
    ql_vec3_t n;
} one;

static double size_of(normal_t v)
{
    return sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

static void set_corner(uint16_t i, ql_vec3_t at)
{
    one.corner[i] = at;
    one.vertices[i].xyz[0] = QL_LE16((uint16_t)at.x);
    one.vertices[i].xyz[1] = QL_LE16((uint16_t)at.y);
    one.vertices[i].xyz[2] = QL_LE16((uint16_t)at.z);
    one.tri.vertex[i] = QL_LE16(i);
}

static uint16_t q15(double v)
{
    return QL_LE16((uint16_t)(int16_t)fmin(floor(v * 32768 + 0.5), 32767));
}

static void set_normal(unsigned i, normal_t n)
{
    one.normals[i].xyz[0] = (int16_t)q15(n.x);
    one.normals[i].xyz[1] = (int16_t)q15(n.y);
    one.normals[i].xyz[2] = (int16_t)q15(n.z);
}

static normal_t stored(unsigned i)
{
    const int16_t *xyz = one.normals[i].xyz;
    const normal_t n = {ql_i16(QL_LE16((uint16_t)xyz[0])),
            ql_i16(QL_LE16((uint16_t)xyz[1])),
            ql_i16(QL_LE16((uint16_t)xyz[2]))};

    return n;
}

static normal_t random_normal(void)
{
    const double z = 2 * stats_random_unit(&state) - 1;
    const double turn = 6.283185307179586 * stats_random_unit(&state);
    const double r = sqrt(1 - z * z);
    const normal_t n = {r * cos(turn), r * sin(turn), z};

    return n;
}

/* Corners anywhere or close together; normals within a lean of the triangle's
 * own, by less than a right angle for lean < 1. */
static void random_triangle(double lean, bool small)
{
    const int32_t reach = 1 << (small ? random_in(3, 10) : 15);
    normal_t up;

    do {
        const ql_vec3_t a = vec(random_in(LOW, HIGH - 1024),
                random_in(LOW, HIGH - 1024), random_in(LOW, HIGH - 1024));

        set_corner(0, a);
        for (uint16_t i = 1; i < 3; i++) {
            const int32_t x = a.x + random_in(-reach, reach);
            const int32_t y = a.y + random_in(-reach, reach);
            const int32_t z = a.z + random_in(-reach, reach);

            set_corner(i, vec(x < LOW        ? LOW
                                  : x > HIGH ? HIGH
                                             : x,
                                  y < LOW    ? LOW
                                  : y > HIGH ? HIGH
                                             : y,
                                  z < LOW    ? LOW
                                  : z > HIGH ? HIGH
                                             : z));
        }
        one.n = ql_vec_cross(ql_vec_sub(one.corner[1], one.corner[0]),
                ql_vec_sub(one.corner[2], one.corner[0]));
    } while ((one.n.x | one.n.y | one.n.z) == 0);
    up.x = one.n.x;
    up.y = one.n.y;
    up.z = one.n.z;
    for (unsigned i = 0; i < 3; i++) {
        const normal_t r = random_normal();
        const double s = 1 / size_of(up);
        normal_t n = {up.x * s + lean * r.x, up.y * s + lean * r.y,
                up.z * s + lean * r.z};
        const double shorten =
                (i + 1) / 3.0 / size_of(n); /* any length will do */

        n.x *= shorten;
        n.y *= shorten;
        n.z *= shorten;
        set_normal(i, n);
    }
    one.tri.inv_n = QL_LE32(0x80000000u); /* not used here, but not a sphere */
    one.scene.vertices = one.vertices;
    one.scene.normals = one.normals;
    one.scene.triangles = &one.tri;
    one.scene.pairs = one.vertices; /* never read: the root is a leaf */
    one.scene.node_bits = 16;
    one.scene.root_meta = 4;
}

/* A ray towards a random point of the triangle, from anywhere. */
static bool random_hit(ql_ray_t *ray, ql_hit_t *hit)
{
    const double b1 = stats_random_unit(&state);
    const double b2 = stats_random_unit(&state) * (1 - b1);
    const ql_vec3_t *c = one.corner;
    const ql_vec3_t aim = vec((int32_t)((c[0].x + b1 * (c[1].x - c[0].x) +
                                                b2 * (c[2].x - c[0].x)) *
                                        ONE),
            (int32_t)((c[0].y + b1 * (c[1].y - c[0].y) +
                              b2 * (c[2].y - c[0].y)) *
                      ONE),
            (int32_t)((c[0].z + b1 * (c[1].z - c[0].z) +
                              b2 * (c[2].z - c[0].z)) *
                      ONE));

    ray->origin = random_position();
    ray->direction = ql_vec_to_dir(ql_vec_sub(aim, ray->origin));
    return (ray->direction.x | ray->direction.y | ray->direction.z) != 0 &&
           ql_bvh_closest_hit(&one.scene, ray, hit);
}

/* What the angle of an interpolated normal may be off: weights are cut to 2^-30
 * and more, a unit for each corner's length. */
static double angle_bound(normal_t interpolated)
{
    const double lengths =
            size_of(stored(0)) + size_of(stored(1)) + size_of(stored(2));

    return ldexp(1, -27) + ldexp(lengths / size_of(interpolated), -30);
}

/* The exact weights of the corners. */
static void weigh(const ql_ray_t *ray, double w[3])
{
    ql_tri_frame_t f;
    ql_vec3_t n;
    double det;
    int64_t u = 0, minus_v = 0;

    ql_tri_frame(&f, &one.scene, &one.tri, ray->origin);
    n = ql_vec_cross(f.t.e1, f.t.e2);
    (void)ql_tri_edges(&f, ray->direction, &u, &minus_v);
    det = -(double)ql_vec_dot(ray->direction, n) * ONE;
    w[1] = (double)u / det;
    w[2] = -(double)minus_v / det;
    w[0] = (det - (double)u + (double)minus_v) / det;
}

/* The sum of the corner normals with these weights, on the seen side. */
static normal_t interpolated(const ql_ray_t *ray, bool front)
{
    normal_t sum = {0, 0, 0};
    double w[3];

    weigh(ray, w);
    for (unsigned i = 0; i < 3; i++) {
        const normal_t corner = stored(i);
        const double weight = front ? w[i] : -w[i];

        sum.x += weight * corner.x;
        sum.y += weight * corner.y;
        sum.z += weight * corner.z;
    }
    return sum;
}

/* Angle between the shading normal and a vector. */
static double angle_to(ql_vec3_t shade, normal_t n)
{
    const double x = shade.y * n.z - shade.z * n.y;
    const double y = shade.z * n.x - shade.x * n.z;
    const double z = shade.x * n.y - shade.y * n.x;

    return atan2(sqrt(x * x + y * y + z * z),
            shade.x * n.x + shade.y * n.y + shade.z * n.z);
}

static double length_of(ql_vec3_t shade)
{
    const normal_t n = {
            ldexp(shade.x, -29), ldexp(shade.y, -29), ldexp(shade.z, -29)};

    return size_of(n);
}

/* ---- Normals ----------------------------------------------------------- */

/* Worst angle, in units of the bound; the corners' weights shifted by one if
 * that fault is planted. */
static double worst_angle(bool fault)
{
    double worst = 0, longest = 0;
    unsigned long smooth = 0, hits = 0;

    state = 1;
    for (long i = 0; i < RAYS; i++) {
        ql_surface_t surface;
        ql_ray_t ray;
        ql_hit_t hit;
        normal_t want;

        random_triangle(0.9, i % 2);
        if (!random_hit(&ray, &hit)) {
            continue;
        }
        hits++;
        ql_surface_at(&one.scene, &ray, &hit, &surface);
        if (!surface.smooth) {
            continue;
        }
        smooth++;
        if (fault) {
            const ql_blob_normal_t swap = one.normals[1];

            one.normals[1] = one.normals[2];
            one.normals[2] = swap;
        }
        want = interpolated(&ray, hit.front);
        worst = fmax(worst, angle_to(surface.shade, want) / angle_bound(want));
        longest = fmax(longest, fabs(length_of(surface.shade) - 1));
    }
    CHECK(smooth == hits && hits > RAYS / 2, "%lu of %lu hits are smooth",
            smooth, hits);
    CHECK(longest <= LENGTH_BOUND, "length off by %.3g", longest);
    NOTE("%lu hits, angle %.2f of bound, length %.1e", hits, worst, longest);
    return worst;
}

TEST(shading_normals_are_the_interpolated_ones)
{
    const double worst = worst_angle(false);

    CHECK(worst <= 1, "%.3f of the bound", worst);
}

TEST(weights_of_the_wrong_corners_are_rejected)
{
    const double worst = worst_angle(true);

    CHECK(worst > 1000, "%.3f of the bound", worst);
}

TEST(shading_normals_face_the_side_they_were_seen_from)
{
    unsigned long smooth = 0, flat = 0, backs = 0;

    state = 2;
    for (long i = 0; i < RAYS; i++) {
        ql_surface_t surface;
        ql_ray_t ray;
        ql_hit_t hit;
        normal_t want;
        double above;

        random_triangle(4, i % 2); /* many corners lean below the surface */
        if (!random_hit(&ray, &hit)) {
            continue;
        }
        ql_surface_at(&one.scene, &ray, &hit, &surface);
        backs += !hit.front;
        want = interpolated(&ray, hit.front);
        above = (want.x * surface.n.x + want.y * surface.n.y +
                        want.z * surface.n.z) /
                (size_of(want) *
                        sqrt((double)ql_vec_dot(surface.n, surface.n)));
        smooth += surface.smooth;
        flat += !surface.smooth;
        CHECK(!surface.smooth || ql_vec_dot(surface.shade, surface.n) > 0,
                "hit %ld: the shading normal is below the surface", i);
        /* the sum may cancel, and with it the precision */
        CHECK(surface.smooth == (above > 0) || fabs(above) < 1e-5 ||
                        size_of(want) < 2000,
                "hit %ld: smooth %d, but %.3g above", i, surface.smooth, above);
    }
    CHECK(smooth > 1000 && flat > 1000 && backs > 1000,
            "%lu smooth, %lu flat, %lu backs", smooth, flat, backs);
    NOTE("%lu smooth, %lu flat; %lu seen from behind", smooth, flat, backs);
}

#if QL_CFG_PAGES
/* The same triangle on the first page and on each other one. */
TEST(corners_of_a_page_have_its_normals)
{
    enum { PAGE = 65536 };
    static ql_blob_vertex_t vertices[3 * PAGE + 3];
    static ql_blob_normal_t normals[3 * PAGE + 3];
    ql_surface_t want, got;
    ql_ray_t ray;
    ql_hit_t hit;

    state = 5;
    do {
        random_triangle(0.5, false);
    } while (!random_hit(&ray, &hit));
    ql_surface_at(&one.scene, &ray, &hit, &want);
    CHECK(want.smooth, "flat");
    one.scene.vertices = vertices;
    one.scene.normals = normals;
    for (uint16_t page = 1; page < 4; page++) {
        memcpy(vertices + page * PAGE, one.vertices, sizeof one.vertices);
        memcpy(normals + page * PAGE, one.normals, sizeof one.normals);
        one.tri.material = QL_LE16((uint16_t)(page << 14));
        ql_surface_at(&one.scene, &ray, &hit, &got);
        CHECK(got.smooth && got.shade.x == want.shade.x &&
                        got.shade.y == want.shade.y &&
                        got.shade.z == want.shade.z,
                "page %u", page);
    }
    one.tri.material = 0;
}
#endif

TEST(a_corner_without_a_normal_makes_a_triangle_flat)
{
    static const normal_t none = {0, 0, 0};
    unsigned long hits = 0;

    state = 3;
    for (long i = 0; i < 3000; i++) {
        ql_surface_t surface;
        ql_ray_t ray;
        ql_hit_t hit;

        random_triangle(0.5, false);
        set_normal((unsigned)i % 3, none);
        if (random_hit(&ray, &hit)) {
            hits++;
            ql_surface_at(&one.scene, &ray, &hit, &surface);
            CHECK(!surface.smooth, "hit %ld is smooth", i);
            one.scene.normals = NULL;
            ql_surface_at(&one.scene, &ray, &hit, &surface);
            CHECK(!surface.smooth, "hit %ld is smooth without a table", i);
        }
    }
    NOTE("%lu hits", hits);
}

/* Corner normals that are the triangle's own change nothing but rounding. */
TEST(corner_normals_of_the_plane_give_the_plane)
{
    double worst = 0;

    state = 4;
    for (long i = 0; i < RAYS / 4; i++) {
        ql_surface_t surface;
        ql_ray_t ray;
        ql_hit_t hit;
        normal_t n;

        random_triangle(0, i % 2);
        for (unsigned k = 1; k < 3; k++) {
            one.normals[k] = one.normals[2];
        }
        one.normals[0] = one.normals[2];
        if (!random_hit(&ray, &hit)) {
            continue;
        }
        ql_surface_at(&one.scene, &ray, &hit, &surface);
        n.x = surface.n.x;
        n.y = surface.n.y;
        n.z = surface.n.z;
        worst = fmax(worst, angle_to(surface.shade, n));
        CHECK(surface.smooth, "hit %ld is flat", i);
    }
    /* sqrt(3) / 2 of 2^-15, as the corners are stored */
    CHECK(worst < ldexp(0.8661, -15), "off by %.3g rad", worst);
    NOTE("within %.1e rad, stored to 2.6e-05", worst);
}

/* ---- Lifts ------------------------------------------------------------- */

/* How far p is from the corners' tangent planes, along their normals, by their
 * weights: position units. */
static normal_t tangent(const ql_ray_t *ray, ql_vec3_t p)
{
    normal_t sum = {0, 0, 0};
    double w[3];

    weigh(ray, w);
    for (unsigned i = 0; i < 3; i++) {
        const normal_t n = stored(i);
        const ql_vec3_t *c = one.corner + i;
        const double height = (p.x - (double)c->x * ONE) * n.x +
                              (p.y - (double)c->y * ONE) * n.y +
                              (p.z - (double)c->z * ONE) * n.z;
        const double way = -ldexp(w[i] * height, -30);

        sum.x += way * n.x;
        sum.y += way * n.y;
        sum.z += way * n.z;
    }
    return sum;
}

static double cut(double lift, int32_t p)
{
    return fmax(-p / 2.0, fmin(lift, (QL_GRID_MAX * (double)ONE - p) / 2));
}

/* Worst component, position units; two corners' normals are changed after the
 * hit if that fault is planted. */
static double worst_lift(bool fault)
{
    double worst = 0;
    unsigned long lifted = 0;

    state = 6;
    for (long i = 0; i < RAYS; i++) {
        ql_surface_t surface;
        ql_ray_t ray;
        ql_hit_t hit;
        normal_t want;

        random_triangle(0.5, i % 2);
        if (!random_hit(&ray, &hit)) {
            continue;
        }
        ql_surface_at(&one.scene, &ray, &hit, &surface);
        if (fault) {
            const ql_blob_normal_t swap = one.normals[1];

            one.normals[1] = one.normals[2];
            one.normals[2] = swap;
        }
        want = tangent(&ray, surface.p);
        worst = fmax(worst, fabs(surface.lift.x - cut(want.x, surface.p.x)));
        worst = fmax(worst, fabs(surface.lift.y - cut(want.y, surface.p.y)));
        worst = fmax(worst, fabs(surface.lift.z - cut(want.z, surface.p.z)));
        lifted += ql_vec_dot(surface.lift, surface.n) > 0;
    }
    CHECK(lifted > RAYS / 8, "%lu of %lu points are lifted", lifted,
            (unsigned long)RAYS);
    NOTE("off by %.2f of a position unit at most", worst);
    return worst;
}

TEST(lifts_are_the_mean_way_to_the_tangent_planes)
{
    const double worst = worst_lift(false);

    CHECK(worst <= 1, "off by %.3f position units", worst);
}

TEST(lifts_by_the_wrong_corners_are_rejected)
{
    const double worst = worst_lift(true);

    CHECK(worst > 1000, "off by %.3f position units", worst);
}

static bool in_box(int32_t p)
{
    return p >= 0 && p <= QL_GRID_MAX * ONE;
}

/* Of a point that is lifted all that remains smooth is its normal. */
TEST(lifted_points_stay_in_the_box_and_are_flat)
{
    unsigned long lifted = 0, left = 0;

    state = 7;
    for (long i = 0; i < RAYS; i++) {
        ql_surface_t surface, before;
        ql_ray_t ray;
        ql_hit_t hit;
        bool up;

        random_triangle(0.9, i % 2);
        if (!random_hit(&ray, &hit)) {
            continue;
        }
        ql_surface_at(&one.scene, &ray, &hit, &surface);
        before = surface;
        up = surface.smooth && ql_vec_dot_normal(surface.lift, surface.n) > 0;
        ql_smooth_lift(&one.scene, &surface);
        CHECK(in_box(surface.p.x) && in_box(surface.p.y) && in_box(surface.p.z),
                "hit %ld: %ld %ld %ld", i, (long)surface.p.x, (long)surface.p.y,
                (long)surface.p.z);
        CHECK(up ? !surface.smooth && surface.n.x == before.shade.x &&
                                surface.p.x == before.p.x + before.lift.x &&
                                surface.p.y == before.p.y + before.lift.y &&
                                surface.p.z == before.p.z + before.lift.z
                 : surface.smooth == before.smooth && surface.p.x == before.p.x,
                "hit %ld: up %d", i, up);
        lifted += up;
        left += !up;
    }
    CHECK(lifted > 1000 && left > 1000, "%lu lifted, %lu not", lifted, left);
    NOTE("%lu lifted, %lu not", lifted, left);
}

/* ---- Edges ------------------------------------------------------------- */

/* Two triangles that share an edge, as a roof; rays at points of the edge from
 * above hit either, and both give the same normal there. */
TEST(neighbours_have_the_same_normal_along_their_edge)
{
    static mini_scene_t mini;
    static const int32_t v[4][3] = {{4000, 9000, 5000}, {28000, 11000, 30000},
            {27000, 3000, 6000}, {5000, 2000, 29000}};
    static const double n[4][3] = {{0.1, 0.9, 0.2}, {-0.2, 0.8, 0.3},
            {0.6, 0.7, -0.1}, {-0.5, 0.6, 0.1}};
    ql_scene_t scene;
    uint16_t white;
    double worst = 0;
    unsigned long pairs = 0;

    mini_begin(&mini);
    white = mini_material(&mini, 0.5, 0);
    for (int i = 0; i < 4; i++) {
        mini_normal(&mini, mini_vertex(&mini, v[i][0], v[i][1], v[i][2]), n[i]);
    }
    mini_face(&mini, 0, 1, 2, white);
    mini_face(&mini, 1, 0, 3, white);
    mini_open(&mini, &scene);
    state = 5;
    for (long i = 0; i < RAYS / 4; i++) {
        const int32_t k = random_in(0, 16); /* the edge's grid points */
        const int32_t x = v[0][0] + (v[1][0] - v[0][0]) * k / 16;
        const int32_t y = v[0][1] + (v[1][1] - v[0][1]) * k / 16;
        const int32_t z = v[0][2] + (v[1][2] - v[0][2]) * k / 16;
        ql_surface_t side[2];
        ql_ray_t ray;
        normal_t first;
        unsigned hits = 0;

        /* straight down on the edge: exactly on both triangles, or neither */
        ray.origin = vec(x * ONE, (y + random_in(100, 20000)) * ONE, z * ONE);
        ray.direction = vec(0, -(int32_t)(1l << QL_DIR_BITS), 0);
        for (uint16_t t = 0; t < 2; t++) {
            ql_scene_t leaf = scene;
            ql_hit_t hit;

            leaf.root_link = t;
            leaf.root_meta = 4;
            if (ql_bvh_closest_hit(&leaf, &ray, &hit)) {
                ql_surface_at(&scene, &ray, &hit, side + t);
                CHECK(side[t].smooth, "triangle %u is flat", t);
                hits++;
            }
        }
        if (hits < 2) {
            continue;
        }
        pairs++;
        first.x = side[0].shade.x;
        first.y = side[0].shade.y;
        first.z = side[0].shade.z;
        worst = fmax(worst, angle_to(side[1].shade, first));
    }
    /* of lengths up to 1, and between them 0.75 or more */
    CHECK(worst <= 2 * (ldexp(1, -27) + ldexp(3 / 0.75, -30)),
            "off by %.3g rad", worst);
    CHECK(pairs > RAYS / 32, "only %lu points hit both", pairs);
    NOTE("%lu points of the edge, within %.1e rad", pairs, worst);
}

#else

TEST(a_build_without_shading_normals_has_no_room_for_them)
{
    CHECK(sizeof(ql_surface_t) == 2 * sizeof(ql_vec3_t) + sizeof(uint32_t),
            "%u bytes", (unsigned)sizeof(ql_surface_t));
}

#endif

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_smooth", argc, argv);
#if QL_CFG_SMOOTH
    RUN(shading_normals_are_the_interpolated_ones);
    RUN(weights_of_the_wrong_corners_are_rejected);
    RUN(shading_normals_face_the_side_they_were_seen_from);
#if QL_CFG_PAGES
    RUN(corners_of_a_page_have_its_normals);
#endif
    RUN(a_corner_without_a_normal_makes_a_triangle_flat);
    RUN(corner_normals_of_the_plane_give_the_plane);
    RUN(lifts_are_the_mean_way_to_the_tangent_planes);
    RUN(lifts_by_the_wrong_corners_are_rejected);
    RUN(lifted_points_stay_in_the_box_and_are_flat);
    RUN(neighbours_have_the_same_normal_along_their_edge);
#else
    RUN(a_build_without_shading_normals_has_no_room_for_them);
#endif
    return TEST_END();
}
