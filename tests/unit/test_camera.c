/* test_camera.c - rays through pixels against the same camera in double */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>

#include "mini_scene.h"
#include "ql_stats.h"
#include "ql_test.h"
#include "scene/ql_camera.h"

#define ONE (1 << QL_POS_BITS)

/* The stated bounds: half an ulp of an origin, of a direction the angle of
 * ql_dir_round(). Entering the box adds what 30 fraction bits of a direction
 * lose on the way: 2^-10 of a grid unit. */
#define ORIGIN_BOUND (0.5 + ldexp(1, QL_POS_BITS - 10))
#define ANGLE_BOUND  ldexp(sqrt(3), -QL_DIR_BITS)

typedef struct {
    double x[3];
} point_t;

/* A camera in double: origin and direction affine in the picture's plane. */
typedef struct {
    double p[3], pr[3], pu[3], d[3], dr[3], du[3];
} reference_t;

static mini_scene_t mini;
static ql_scene_t scene;
static uint64_t state;

static double wide(const uint32_t words[2])
{
    return ldexp((double)ql_i64((uint64_t)words[1] << 32 | words[0]), -32);
}

static double narrow(uint32_t word)
{
    return ldexp(ql_i32(word), -30);
}

/* What the blob's fields say, after their own quantisation. */
static reference_t reference(void)
{
    reference_t r;

    for (unsigned k = 0; k < 3; k++) {
        r.p[k] = wide(mini.camera.p[k]);
        r.pr[k] = wide(mini.camera.pr[k]);
        r.pu[k] = wide(mini.camera.pu[k]);
        r.d[k] = narrow(mini.camera.d[k]);
        r.dr[k] = narrow(mini.camera.dr[k]);
        r.du[k] = narrow(mini.camera.du[k]);
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
        double o, d, near, far;

        o = r->p[k] + plane_x * r->pr[k] + plane_y * r->pu[k];
        d = r->d[k] + plane_x * r->dr[k] + plane_y * r->du[k];
        origin->x[k] = o;
        direction->x[k] = d;
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

static double worst_origin, worst_angle;
static unsigned long checked, missed;

static void check_ray(const ql_camera_t *camera, uint16_t width,
        uint16_t height, uint16_t x, uint16_t y, uint32_t u1, uint32_t u2)
{
    const reference_t r = reference();
    /* the top 15 bits of u count, and stand for the middle of their cell */
    const double px = x + ((u1 >> 17) + 0.5) / 32768;
    const double py = y + ((u2 >> 17) + 0.5) / 32768;
    ql_camera_pixel_t pixel;
    point_t origin, direction;
    ql_ray_t ray = {{0, 0, 0}, {0, 0, 0}};
    double margin, o[3], d[3], angle;
    bool got, expected;

    ql_camera_pixel(&pixel, camera, x, y);
    got = ql_camera_ray(&pixel, u1, u2, &ray);
    expected = reference_ray(
            &r, width, height, px, py, &origin, &direction, &margin);
    checked++;
    missed += !expected;
    if (got != expected) { /* only a ray that grazes the box may differ */
        CHECK(fabs(margin) < 4, "pixel %u, %u of %u x %u: %d, not %d, by %.3g",
                x, y, width, height, got, expected, margin);
        return;
    }
    if (!got) {
        return;
    }
    o[0] = ray.origin.x;
    o[1] = ray.origin.y;
    o[2] = ray.origin.z;
    d[0] = ray.direction.x;
    d[1] = ray.direction.y;
    d[2] = ray.direction.z;
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
    angle = angle_between(d, direction.x);
    worst_angle = fmax(worst_angle, angle);
    CHECK(angle <= ANGLE_BOUND,
            "pixel %u, %u of %u x %u: direction off by %.3f 2^-b rad", x, y,
            width, height, ldexp(angle, QL_DIR_BITS));
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
    worst_origin = worst_angle = 0;
    checked = missed = 0;
    mini_begin(&mini);
}

static void report(void)
{
    NOTE("%lu rays, %lu miss; %.3f ulp, %.3f 2^-b rad", checked, missed,
            worst_origin, ldexp(worst_angle, QL_DIR_BITS));
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
        CHECK(!ql_camera_ray(&pixel, 0x80000000u, 0x80000000u, &ray),
                "side %u: a ray from outside, away, enters", i);
        mini_look(&mini, -look[0], -look[1], -look[2]);
        mini.triangle_count = mini.vertex_count = mini.material_count = 0;
        open_scene();
        CHECK(ql_camera_init(&camera, &scene, 1, 1), "side %u refused", i);
        ql_camera_pixel(&pixel, &camera, 0, 0);
        CHECK(ql_camera_ray(&pixel, 0x80000000u, 0x80000000u, &ray),
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
    CHECK(ql_camera_ray(&pixel, 0, 0, &ray), "missed");
    CHECK(ray.direction.x < 0 && ray.direction.y > 0, "%ld, %ld",
            (long)ray.direction.x, (long)ray.direction.y);
    ql_camera_pixel(&pixel, &camera, 9, 9);
    CHECK(ql_camera_ray(&pixel, 0xffffffffu, 0xffffffffu, &ray), "missed");
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
    return TEST_END();
}
