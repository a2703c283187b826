/* test_camera.c - rays through pixels against the same camera in double */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>

#include "support/picture/mini_scene.h"
#include "support/ql_double.h"
#include "support/ql_stats.h"
#include "support/ql_table_error.h"
#include "support/ql_test.h"
#include "math/vec/ql_vec_unit.h"
#include "warp/ql_warp_plane.h"
#include "scene/ql_camera.h"

#define ONE (1 << QL_POS_BITS)

/* The stated bounds: half an ulp of an origin. Entering the box adds what 30
 * fraction bits of a direction lose on the way: 2^-10 of a grid unit. */
#define ORIGIN_BOUND (0.5 + ldexp(1, QL_POS_BITS - 10))

typedef struct {
    double x[3];
} point_t;

/* A camera in double: origin and direction affine in the picture's plane. */
typedef struct {
    double p[3], pr[3], pu[3], d[3], dr[3], du[3];
} reference_t;

static mini_scene_t mini;
static ql_scene_t scene;
static uint64_t state, lens_state;

static const ql_uniform2_t middle = {0x80000000u, 0x80000000u};

static ql_uniform2_t pair(uint32_t u1, uint32_t u2)
{
    const ql_uniform2_t u = {u1, u2};

    return u;
}

static double wide(const uint32_t words[2])
{
    return ldexp((double)ql_i64((uint64_t)words[1] << 32 | words[0]), -32);
}

static double narrow(uint32_t word)
{
    return ldexp(ql_i32(word), -30);
}

/* What the blob's fields say, after their own quantisation: a pinhole, moved to
 * a point of the lens if there is one. */
static reference_t reference(ql_uniform2_t lens)
{
    reference_t r;
    ql_q29_t at[2] = {0, 0};

    if (mini.has_lens) {
        ql_warp_plane_disk(lens.u1, lens.u2, &at[0], &at[1]);
    }
    for (unsigned k = 0; k < 3; k++) {
        r.p[k] = wide(mini.camera.at[QL_CAMERA_BASE][k]);
        r.pr[k] = wide(mini.camera.at[QL_CAMERA_RIGHT][k]);
        r.pu[k] = wide(mini.camera.at[QL_CAMERA_UP][k]);
        r.d[k] = narrow(mini.camera.towards[QL_CAMERA_BASE][k]);
        r.dr[k] = narrow(mini.camera.towards[QL_CAMERA_RIGHT][k]);
        r.du[k] = narrow(mini.camera.towards[QL_CAMERA_UP][k]);
        for (unsigned i = 0; i < 2 && mini.has_lens; i++) {
            r.p[k] += ldexp(at[i], -29) * wide(mini.lens.p[i][k]);
            r.d[k] += ldexp(at[i], -29) * narrow(mini.lens.d[i][k]);
        }
    }
    return r;
}

static void open_scene(void)
{
    static const int32_t v[3][3] = {
            {100, 100, 100}, {200, 100, 100}, {100, 200, 100}};

    mini_triangle(&mini, v[0], v[1], v[2], mini_material(&mini, 0.5, 0));
    mini_open(&mini, &scene);
}

/* The ray of the reference: entry into the box included. Returns the distance
 * to a decision that could go either way: how far inside the ray passes. */
static bool reference_ray(const reference_t *r, uint16_t width, uint16_t height,
        double px, double py, point_t *origin, point_t *direction,
        double *margin)
{
    const double plane_x = (2 * px - width) / height;
    const double plane_y = (height - 2 * py) / height;
    double enter = 0, leave = INFINITY;

    for (unsigned k = 0; k < 3; k++) {
        origin->x[k] = r->p[k] + plane_x * r->pr[k] + plane_y * r->pu[k];
        direction->x[k] = r->d[k] + plane_x * r->dr[k] + plane_y * r->du[k];
    }
    for (unsigned k = 0; k < 3; k++) {
        const double o = origin->x[k], d = direction->x[k];
        double near, far;

        if (d == 0) {
            if (o < 0 || o > QL_GRID_MAX) {
                *margin = o < 0 ? o : QL_GRID_MAX - o;
                return false;
            }
            continue;
        }
        near = (d > 0 ? -o : QL_GRID_MAX - o) / d;
        far = (d > 0 ? QL_GRID_MAX - o : -o) / d;
        enter = fmax(enter, near);
        leave = fmin(leave, far);
    }
    for (unsigned k = 0; k < 3; k++) {
        origin->x[k] += enter * direction->x[k];
    }
    *margin = (leave - enter) * sqrt(direction->x[0] * direction->x[0] +
                                        direction->x[1] * direction->x[1] +
                                        direction->x[2] * direction->x[2]);
    return enter <= leave;
}

static double angle_between(const double a[3], const double b[3])
{
    const double x = a[1] * b[2] - a[2] * b[1];
    const double y = a[2] * b[0] - a[0] * b[2];
    const double z = a[0] * b[1] - a[1] * b[0];

    return atan2(sqrt(x * x + y * y + z * z),
            a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

/* Of a direction the angle of ql_vec_to_dir(), and of each component six units
 * of the last bit: one each for what is cut of the pixel, two steps within it
 * and two of the lens, and one for steps of pixels added up. */
static double angle_bound(const ql_camera_t *camera, const point_t *direction)
{
    const double *d = direction->x;
    const double size = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
#if QL_CFG_LENS
    const int down = camera->lens.down;
#else
    const int down = 0; /* no picture here is that wide */
#endif
    const double cut = sqrt(3) * ldexp(mini.has_lens ? 6 : 4, down - 30) / size;

    (void)camera;
    return ldexp(sqrt(3), -QL_DIR_BITS) + (cut < 1 ? asin(cut) : PI);
}

static double worst_origin, worst_angle, worst_share;
static unsigned long checked, missed;

static void check_lens_ray(const ql_camera_t *camera, uint16_t width,
        uint16_t height, const uint16_t at[2], ql_uniform2_t u,
        ql_uniform2_t lens)
{
    const uint16_t x = at[0], y = at[1];
    const reference_t r = reference(lens);
    /* the top 15 bits of u count, and stand for the middle of their cell */
    const double px = x + ((u.u1 >> 17) + 0.5) / 32768;
    const double py = y + ((u.u2 >> 17) + 0.5) / 32768;
    ql_camera_pixel_t pixel;
    point_t origin, direction;
    ql_ray_t ray = {{0, 0, 0}, {0, 0, 0}};
    double margin, o[3], d[3], angle;
    bool got, expected;

    ql_camera_pixel(&pixel, camera, x, y);
    got = ql_camera_ray(&pixel, u, lens, &ray);
    expected = reference_ray(
            &r, width, height, px, py, &origin, &direction, &margin);
    checked++;
    missed += !expected;
    if (got != expected) { /* only a ray that grazes the box may differ */
        CHECK(fabs(margin) < 4, "pixel %u, %u of %u x %u: %d, not %d, by %.3g",
                x, y, width, height, got, expected, margin);
        return;
    }
    /* a ray that misses still has its direction */
    d[0] = ray.direction.x;
    d[1] = ray.direction.y;
    d[2] = ray.direction.z;
    angle = angle_between(d, direction.x);
    worst_angle = fmax(worst_angle, angle);
    worst_share = fmax(worst_share, angle / angle_bound(camera, &direction));
    CHECK(angle <= angle_bound(camera, &direction),
            "pixel %u, %u of %u x %u, lens %08lx %08lx: direction off by "
            "%.3f 2^-b rad",
            x, y, width, height, (unsigned long)lens.u1, (unsigned long)lens.u2,
            ldexp(angle, QL_DIR_BITS));
    if (!got) {
        return;
    }
    o[0] = ray.origin.x;
    o[1] = ray.origin.y;
    o[2] = ray.origin.z;
    for (unsigned k = 0; k < 3; k++) {
        const double off = fabs(o[k] - origin.x[k] * ONE);

        worst_origin = fmax(worst_origin, off);
        CHECK(off <= ORIGIN_BOUND,
                "pixel %u, %u of %u x %u, axis %u: origin %.1f, not %.4f", x, y,
                width, height, k, o[k], origin.x[k] * ONE);
        CHECK(o[k] >= 0 && o[k] <= QL_GRID_MAX * ONE,
                "pixel %u, %u, axis %u: %.0f is outside the box", x, y, k,
                o[k]);
    }
}

static void check_ray(const ql_camera_t *camera, uint16_t width,
        uint16_t height, uint16_t x, uint16_t y, uint32_t u1, uint32_t u2)
{
    const uint16_t at[2] = {x, y};
    ql_uniform2_t lens;

    lens.u1 = (uint32_t)stats_random(&lens_state);
    lens.u2 = (uint32_t)stats_random(&lens_state);
    check_lens_ray(camera, width, height, at, pair(u1, u2), lens);
}

/* Corners, middles and random points of random pixels and the extreme ones. */
static void check_picture(uint16_t width, uint16_t height, unsigned count)
{
    static const uint32_t ends[] = {0, 0x7fffffffu, 0x80000000u, 0xffffffffu};
    ql_camera_t camera;

    if (!ql_camera_init(&camera, &scene, width, height)) {
        CHECK(false, "%u x %u refused", width, height);
        return;
    }
    for (unsigned i = 0; i < count; i++) {
        const bool corner = i < 64;
        const uint16_t x =
                (uint16_t)(corner ? (i & 1 ? width - 1u : 0u)
                                  : stats_random_below(&state, width));
        const uint16_t y =
                (uint16_t)(corner ? (i & 2 ? height - 1u : 0u)
                                  : stats_random_below(&state, height));

        check_ray(&camera, width, height, x, y,
                corner ? ends[i >> 2 & 3] : (uint32_t)stats_random(&state),
                corner ? ends[i >> 4 & 3] : (uint32_t)stats_random(&state));
    }
}

static void begin(uint64_t seed)
{
    state = seed;
    lens_state = ~seed;
    worst_origin = worst_angle = worst_share = 0;
    checked = missed = 0;
    mini_begin(&mini);
}

static void report(void)
{
    NOTE("%lu rays, %lu miss; %.3f ulp, %.3f 2^-b rad, %.2f of bound", checked,
            missed, worst_origin, ldexp(worst_angle, QL_DIR_BITS), worst_share);
}

static const uint16_t sizes[][2] = {{1, 1}, {2, 1}, {1, 2}, {3, 5}, {64, 48},
        {128, 64}, {320, 240}, {1920, 1080}, {16384, 1}, {1, 16384},
        {16384, 16384}};

#define SIZES (sizeof sizes / sizeof sizes[0])

/* ---- Eyes -------------------------------------------------------------- */

TEST(an_eye_inside_sees_what_the_reference_sees)
{
    static const double right[3] = {0.31, 0.02, -0.1}, up[3] = {0.05, 0.28, 0};

    begin(1);
    mini_eye(&mini, 12345.678, 3000.25, 20000.5);
    mini_look(&mini, 0.1, -0.2, 0.6);
    mini_field(&mini, right, up);
    open_scene();
    for (size_t i = 0; i < 9; i++) {
        if (sizes[i][0] / sizes[i][1] <= 3) {
            check_picture(sizes[i][0], sizes[i][1], 20000);
        }
    }
    report();
}

/* Origins on the plane through the nearest corner, as the scene compiler
 * leaves an eye outside. */
static void look_from_outside(double distance)
{
    /* an eye at (-s, -s, -s) looking at the middle: the plane through the
     * corner at the origin cuts its rays at distance sqrt(3) s */
    const double half = 20000 / (distance + 28000);
    const double c = sqrt(3) * distance;
    const double d = 0.5 / sqrt(3);
    const double a[3] = {half * d * 1.0, -half * d * 1.0, 0};
    const double b[3] = {half * d / 1.7, half * d / 1.7, -half * d * 2 / 1.7};
    double window[2][3];

    mini_eye(&mini, 0, 0, 0);
    mini_look(&mini, d, d, d);
    mini_field(&mini, a, b);
    for (unsigned k = 0; k < 3; k++) {
        /* o + t d on the plane: both steps scale with the distance */
        window[0][k] = a[k] * c / 0.5;
        window[1][k] = b[k] * c / 0.5;
    }
    mini_window(&mini, window[0], window[1]);
}

TEST(an_eye_outside_enters_the_box_where_the_reference_does)
{
    begin(2);
    look_from_outside(20000);
    open_scene();
    for (size_t i = 0; i < 8; i++) {
        check_picture(sizes[i][0], sizes[i][1], 20000);
    }
    report();
}

TEST(an_eye_very_far_away_loses_no_resolution)
{
    static const double distances[] = {1e5, 1e6, 1e8};

    for (unsigned i = 0; i < 3; i++) {
        begin(3 + i);
        look_from_outside(distances[i]);
        open_scene();
        check_picture(320, 240, 50000);
        CHECK(missed < checked, "distance %.0e: all rays miss", distances[i]);
    }
    report();
}

TEST(parallel_rays_enter_where_they_should)
{
    static const double right[3] = {0, 0, 0};
    static const double window_right[3] = {20000, 0, 0};
    static const double window_up[3] = {0, 20000, 0};

    begin(6);
    mini_eye(&mini, 16384, 16384, 0);
    mini_look(&mini, 0, 0, 0.5);
    mini_field(&mini, right, right);
    mini_window(&mini, window_right, window_up);
    open_scene();
    check_picture(64, 64, 50000);
    report();
}

TEST(rays_away_from_the_box_miss)
{
    ql_camera_t camera;
    ql_camera_pixel_t pixel;
    ql_ray_t ray;

    static const double outside[6][3] = {{-10, 100, 100}, {32800, 100, 100},
            {100, -10, 100}, {100, 32800, 100}, {100, 100, -10},
            {100, 100, 32800}};

    for (unsigned i = 0; i < 6; i++) {
        double look[3] = {0.01, 0.01, 0.01};

        mini_begin(&mini);
        look[i / 2] = i % 2 ? 0.5 : -0.5;
        mini_eye(&mini, outside[i][0], outside[i][1], outside[i][2]);
        mini_look(&mini, look[0], look[1], look[2]);
        open_scene();
        CHECK(ql_camera_init(&camera, &scene, 1, 1), "side %u refused", i);
        ql_camera_pixel(&pixel, &camera, 0, 0);
        CHECK(!ql_camera_ray(&pixel, middle, middle, &ray),
                "side %u: a ray from outside, away, enters", i);
        mini_look(&mini, -look[0], -look[1], -look[2]);
        mini.triangle_count = mini.vertex_count = mini.material_count = 0;
        open_scene();
        CHECK(ql_camera_init(&camera, &scene, 1, 1), "side %u refused", i);
        ql_camera_pixel(&pixel, &camera, 0, 0);
        CHECK(ql_camera_ray(&pixel, middle, middle, &ray),
                "side %u: a ray towards the box misses", i);
    }
}

/* ---- Pictures ---------------------------------------------------------- */

TEST(pictures_of_every_size_follow_the_reference)
{
    begin(7);
    for (size_t i = 0; i < SIZES; i++) {
        /* narrow enough for |x| <= width / height */
        const double aspect = (double)sizes[i][0] / sizes[i][1];
        const double right[3] = {0.4 / fmax(aspect, 1), 0, 0};
        const double up[3] = {0, 0.4 / fmax(aspect, 1), 0};

        mini_begin(&mini);
        mini_eye(&mini, 16384, 16384, 8000);
        mini_look(&mini, 0.02, 0.01, 0.5);
        mini_field(&mini, right, up);
        open_scene();
        check_picture(sizes[i][0], sizes[i][1], 5000);
    }
    report();
}

TEST(the_first_pixel_is_at_the_top_left)
{
    static const double right[3] = {0.4, 0, 0}, up[3] = {0, 0.4, 0};
    ql_camera_t camera;
    ql_camera_pixel_t pixel;
    ql_ray_t ray;

    mini_begin(&mini);
    mini_field(&mini, right, up);
    open_scene();
    CHECK(ql_camera_init(&camera, &scene, 10, 10), "refused");
    ql_camera_pixel(&pixel, &camera, 0, 0);
    CHECK(ql_camera_ray(&pixel, pair(0, 0), middle, &ray), "missed");
    CHECK(ray.direction.x < 0 && ray.direction.y > 0, "%ld, %ld",
            (long)ray.direction.x, (long)ray.direction.y);
    ql_camera_pixel(&pixel, &camera, 9, 9);
    CHECK(ql_camera_ray(&pixel, pair(0xffffffffu, 0xffffffffu), middle, &ray),
            "missed");
    CHECK(ray.direction.x > 0 && ray.direction.y < 0, "%ld, %ld",
            (long)ray.direction.x, (long)ray.direction.y);
}

TEST(a_picture_that_reaches_too_far_is_refused)
{
    static const double right[3] = {1e8, 0, 0}, up[3] = {0, 1, 0};
    ql_camera_t camera;

    mini_begin(&mini);
    mini_window(&mini, right, up);
    open_scene();
    CHECK(ql_camera_init(&camera, &scene, 2, 1), "2 x 1 was refused");
    CHECK(!ql_camera_init(&camera, &scene, 16384, 1),
            "16384 x 1 reaches beyond 2^30 and was not refused");
}

/* ---- Lenses ------------------------------------------------------------ */

#if QL_CFG_LENS

/* A lens of this radius in grid units, across the axes of the picture, in focus
 * where the direction has been followed so many times. */
static void set_lens(double radius, double focus)
{
    const double p[2][3] = {{radius, 0, 0}, {0, radius, 0}};
    const double d[2][3] = {{-radius / focus, 0, 0}, {0, -radius / focus, 0}};

    mini_lens(&mini, p, d);
}

TEST(a_point_of_the_lens_moves_the_ray_as_the_reference_does)
{
    static const double right[3] = {0.31, 0.02, -0.1}, up[3] = {0.05, 0.28, 0};
    static const double p[2][3] = {{100, -20, 3}, {-7, 250, 0.001}};
    static const double d[2][3] = {{-0.01, 0.003, 0}, {0.02, -0.4, 1e-8}};

    begin(11);
    mini_eye(&mini, 12345.678, 3000.25, 20000.5);
    mini_look(&mini, 0.1, -0.2, 0.6);
    mini_field(&mini, right, up);
    mini_lens(&mini, p, d);
    open_scene();
    check_picture(64, 48, 20000);
    check_picture(320, 240, 20000);
    report();
}

TEST(a_lens_of_an_eye_outside_enters_the_box_where_it_should)
{
    begin(12);
    look_from_outside(20000);
    set_lens(400, 60000);
    open_scene();
    check_picture(64, 48, 50000);
    CHECK(missed < checked, "all rays miss");
    report();
}

/* A picture so wide and a lens so large that directions have to be scaled; and
 * that the direction of the pixel and what the lens adds may cancel, so that
 * their last bits are seen. The worst were found by hill climbing, in fine and
 * in draft, with tables of 7 bits: the largest angle, and the largest part of
 * the bound. */
TEST(a_very_large_lens_keeps_directions_in_range)
{
    static const struct {
        uint16_t x, y;
        ql_uniform2_t u, lens;
    } worst[] = {
            {33, 25, {0xaa1164c1u, 0xaa5cb9ebu}, {0x116160eeu, 0x189443a8u}},
            {5, 39, {0xd0d1ef2eu, 0xfd2f3603u}, {0x0b40cf9eu, 0x927837feu}},
            {59, 12, {0xd00c5e22u, 0x6f374554u}, {0xa9c90a5au, 0x1f877318u}}};
    ql_camera_t camera;
    static const double right[3] = {0.9, 0, 0}, up[3] = {0, 0.9, 0};
    static const double p[2][3] = {{10000, 0, 0}, {0, 5000, 10000}};
    static const double d[2][3] = {{1, -1, 0.5}, {-1, 1, 1}};

    begin(13);
    mini_look(&mini, 0, 0, 0.9);
    mini_field(&mini, right, up);
    mini_lens(&mini, p, d);
    open_scene();
    check_picture(64, 48, 20000);
    check_picture(320, 64, 20000);
    CHECK(ql_camera_init(&camera, &scene, 64, 48), "refused");
    for (size_t i = 0; i < sizeof worst / sizeof *worst; i++) {
        const uint16_t at[2] = {worst[i].x, worst[i].y};

        check_lens_ray(&camera, 64, 48, at, worst[i].u, worst[i].lens);
    }
    CHECK(!TABLES_DEFAULT || worst_angle > ldexp(sqrt(3), -QL_DIR_BITS),
            "the worst is nothing special: %.3f 2^-b rad",
            ldexp(worst_angle, QL_DIR_BITS));
    report();
}

/* Distance of the ray's line from a point, in positions. */
static double line_distance(const ql_ray_t *ray, const double point[3])
{
    const double d[3] = {ray->direction.x, ray->direction.y, ray->direction.z};
    const double s[3] = {point[0] - ray->origin.x, point[1] - ray->origin.y,
            point[2] - ray->origin.z};
    const double size = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const double x = s[1] * d[2] - s[2] * d[1];
    const double y = s[2] * d[0] - s[0] * d[2];
    const double z = s[0] * d[1] - s[1] * d[0];

    return sqrt(x * x + y * y + z * z) / size;
}

/* Worst distance of rays through one point of the picture from the point in
 * focus, as a part of what origin and direction may err by. */
static double focus_error(double focus)
{
    static const double right[3] = {0.2, 0, 0}, up[3] = {0, 0.2, 0};
    const double from[3] = {16000, 15000, 2000}, radius = 600, at = 40000;
    ql_camera_t camera;
    ql_camera_pixel_t pixel;
    double worst = 0, square = 0;
    const int rays = 20000;

    begin(14);
    mini_eye(&mini, from[0], from[1], from[2]);
    mini_look(&mini, 0, 0, 0.5);
    mini_field(&mini, right, up);
    set_lens(radius, focus);
    open_scene();
    CHECK(ql_camera_init(&camera, &scene, 8, 8), "refused");
    ql_camera_pixel(&pixel, &camera, 2, 5);
    for (int i = 0; i < rays; i++) {
        const ql_uniform2_t lens = pair((uint32_t)stats_random(&lens_state),
                (uint32_t)stats_random(&lens_state));
        const double x = (2 * (2 + 0.5 + 0x1p-16) - 8) / 8;
        const double y = (8 - 2 * (5 + 0.5 + 0x1p-16)) / 8;
        /* followed "at" times; a camera's fields are rounded to 2^-30 */
        const double point[3] = {(from[0] + at * 0.2 * x) * ONE,
                (from[1] + at * 0.2 * y) * ONE, (from[2] + at * 0.5) * ONE};
        const double bound = sqrt(3) * ORIGIN_BOUND +
                             at * 0.6 * ONE * ldexp(sqrt(3), -QL_DIR_BITS) +
                             4 * ldexp(at, -30) * ONE;
        ql_ray_t ray;
        double dx, dy;

        CHECK(ql_camera_ray(&pixel, middle, lens, &ray), "ray %d missed", i);
        worst = fmax(worst, line_distance(&ray, point) / bound);
        dx = (double)ray.origin.x / ONE - from[0];
        dy = (double)ray.origin.y / ONE - from[1];
        square += (dx * dx + dy * dy) / (radius * radius) / rays;
        CHECK(dx * dx + dy * dy <= (radius + 1) * (radius + 1) &&
                        ray.origin.z == from[2] * ONE,
                "ray %d begins off the lens", i);
    }
    /* of a disk 1/2, with a standard deviation of sqrt(1/12) a ray */
    CHECK(fabs(square - 0.5) < STATS_Z_MAX * sqrt(1.0 / 12 / rays),
            "mean square of the radius %.4f", square);
    NOTE("%d rays within %.2f of the bound, mean r^2 %.4f", rays, worst,
            square);
    return worst;
}

TEST(rays_of_a_lens_meet_in_focus)
{
    const double worst = focus_error(40000);

    CHECK(worst <= 1, "%.3f of the bound", worst);
}

TEST(a_focus_off_by_a_percent_is_detected)
{
    const double worst = focus_error(40400);

    CHECK(worst > 2, "only %.3f of the bound", worst);
}

static bool same_ray(const ql_ray_t *a, const ql_ray_t *b)
{
    return a->origin.x == b->origin.x && a->origin.y == b->origin.y &&
           a->origin.z == b->origin.z && a->direction.x == b->direction.x &&
           a->direction.y == b->direction.y && a->direction.z == b->direction.z;
}

/* No lens, whatever its numbers, and one of no size: the same bits. */
TEST(a_lens_of_no_size_changes_no_bit)
{
    static const double none[2][3] = {{0, 0, 0}, {0, 0, 0}};
    static const double right[3] = {0.31, 0.02, -0.1}, up[3] = {0.05, 0.28, 0};
    ql_camera_t camera;
    ql_camera_pixel_t pixel;
    static ql_ray_t rays[2][5000];

    for (unsigned pass = 0; pass < 2; pass++) {
        begin(15);
        mini_eye(&mini, 12345.678, 3000.25, 20000.5);
        mini_look(&mini, 0.1, -0.2, 0.6);
        mini_field(&mini, right, up);
        if (pass) {
            mini_lens(&mini, none, none);
            lens_state = 1;
        }
        open_scene();
        CHECK(ql_camera_init(&camera, &scene, 64, 48), "refused");
        for (unsigned i = 0; i < 5000; i++) {
            const uint32_t u = (uint32_t)stats_random(&state);

            ql_camera_pixel(&pixel, &camera, (uint16_t)(u % 64),
                    (uint16_t)(u / 64 % 48));
            (void)ql_camera_ray(&pixel, pair(u << 7, u * 77),
                    pair((uint32_t)stats_random(&lens_state), ~u),
                    &rays[pass][i]);
            CHECK(pass == 0 || same_ray(&rays[0][i], &rays[1][i]), "ray %u", i);
        }
    }
    NOTE("5000 rays");
}

TEST(a_lens_that_reaches_too_far_is_refused)
{
    static const double p[2][3] = {{9e8, 0, 0}, {9e8, 0, 0}};
    static const double d[2][3] = {{0, 0, 0}, {0, 0, 0}};
    ql_camera_t camera;

    begin(16);
    mini_lens(&mini, p, d);
    open_scene();
    CHECK(!ql_camera_init(&camera, &scene, 1, 1), "not refused");
}

#endif

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_camera", argc, argv);
    RUN(an_eye_inside_sees_what_the_reference_sees);
    RUN(an_eye_outside_enters_the_box_where_the_reference_does);
    RUN(an_eye_very_far_away_loses_no_resolution);
    RUN(parallel_rays_enter_where_they_should);
    RUN(rays_away_from_the_box_miss);
    RUN(pictures_of_every_size_follow_the_reference);
    RUN(the_first_pixel_is_at_the_top_left);
    RUN(a_picture_that_reaches_too_far_is_refused);
#if QL_CFG_LENS
    RUN(a_point_of_the_lens_moves_the_ray_as_the_reference_does);
    RUN(a_lens_of_an_eye_outside_enters_the_box_where_it_should);
    RUN(a_very_large_lens_keeps_directions_in_range);
    RUN(rays_of_a_lens_meet_in_focus);
    RUN(a_focus_off_by_a_percent_is_detected);
    RUN(a_lens_of_no_size_changes_no_bit);
    RUN(a_lens_that_reaches_too_far_is_refused);
#endif
    return TEST_END();
}
