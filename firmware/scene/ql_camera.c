/* ql_camera.c - affine origin and direction, clipped to the scene's box */
/* SPDX-License-Identifier: MIT */

#include "scene/ql_camera.h"

#include "math/vec/ql_vec_unit.h"

/* The box in s.16 grid units. */
#define BOX_MAX_Q16 ((int64_t)QL_GRID_MAX << 16)

/* A coordinate of the camera, affine on the plane: base + x right + y up. */
typedef int64_t affine_t[QL_CAMERA_AFFINE];

/* Axis 0..2 of the origin, s31.32, or 3..5 of the direction over 2^down. */
static void affine_of(
        const ql_blob_camera_t *c, unsigned axis, unsigned down, affine_t a)
{
    for (unsigned i = 0; i < QL_CAMERA_AFFINE; i++) {
        if (axis < 3) {
            a[i] = ql_blob_wide(c->at[i][axis]);
            continue;
        }
        a[i] = ql_blob_narrow(c->towards[i][axis - 3]);
        for (unsigned n = down; n > 0; n--) {
            a[i] = ql_asr64(a[i], 1);
        }
    }
}

/* Steps per pixel: the picture is 2 high and 2 width/height wide; y points
 * down. Sums stay in 64 bits because ql_camera_init() checked reach_of(). */
static void axis_init(ql_camera_axis_t *axis, const affine_t a, uint16_t width,
        uint16_t height)
{
    const int64_t half_x = ql_div_s64_u16(a[QL_CAMERA_RIGHT], height);
    const int64_t half_y = ql_div_s64_u16(-a[QL_CAMERA_UP], height);

    axis->right = 2 * half_x;
    axis->down = 2 * half_y;
    axis->corner = a[QL_CAMERA_BASE] - ql_mul_s64_u16(half_x, width) -
                   ql_mul_s64_u16(half_y, height);
}

/* Size of a sum base + right * width / height + up; above 2^62 some number
 * above that. */
static uint64_t reach_of(const affine_t a, uint16_t width, uint16_t height)
{
    const uint64_t limit = UINT64_MAX / 4;
    const uint64_t side =
            ql_abs64(ql_div_s64_u16(a[QL_CAMERA_RIGHT], height)) + 1;
    const uint64_t base = ql_abs64(a[QL_CAMERA_BASE]);
    const uint64_t up = ql_abs64(a[QL_CAMERA_UP]);

    /* width <= 2^14 and side <= 2^63, so the first product fits */
    if (base > limit || up > limit ||
            ql_mul_s64_u16((int64_t)(side >> 16), width) > (int64_t)1 << 46) {
        return UINT64_MAX;
    }
    /* < 3/4 2^64: side width <= 2^62 + 2^30 */
    return base + (uint64_t)ql_mul_s64_u16((int64_t)side, width) + up;
}

/* The largest component of a direction of the picture, lens included. */
static uint64_t direction_reach(
        const ql_scene_t *scene, uint16_t width, uint16_t height)
{
    uint64_t film = 0, reach = 0;

    for (unsigned k = 0; k < 3; k++) {
        affine_t a;
        uint64_t r;

        affine_of(scene->camera, 3 + k, 0, a);
        r = reach_of(a, width, height); /* below 2^61 */
        film = r > film ? r : film;
    }
    for (unsigned k = 0; k < 3; k++) {
        const uint64_t r = film + ql_lens_direction_reach(scene, k);

        reach = r > reach ? r : reach;
    }
    return reach;
}

/* The lens of a camera: remembered if lenses are built in. */
#if QL_CFG_LENS
static void set_lens(ql_camera_t *camera, const ql_scene_t *scene, uint8_t down)
{
    camera->lens.lens = scene->lens;
    camera->lens.down = down;
}

QL_INLINE const ql_lens_t *lens_of(const ql_camera_t *camera)
{
    return &camera->lens;
}
#else
QL_INLINE void set_lens(
        ql_camera_t *camera, const ql_scene_t *scene, uint8_t down)
{
    (void)camera, (void)scene, (void)down;
}

QL_INLINE const ql_lens_t *lens_of(const ql_camera_t *camera)
{
    return (void)camera, NULL;
}
#endif

bool ql_camera_init(ql_camera_t *camera, const ql_scene_t *scene,
        uint16_t width, uint16_t height)
{
    const uint64_t most = (uint64_t)1 << 62;
    uint64_t reach = direction_reach(scene, width, height);
    unsigned down = 0;

    /* Directions of very wide pictures are scaled to stay below 2^30. */
    for (; reach > (uint64_t)1 << 46; reach >>= 1) {
        down++;
    }
    for (unsigned k = 0; k < 6; k++) {
        affine_t a;

        affine_of(scene->camera, k, down, a);
        if (k < 3) {
            const uint64_t r = reach_of(a, width, height);

            /* the lens adds at most 2^63 + 2^49, so the sum fits */
            if (r > most || r + ql_lens_origin_reach(scene, k) > most) {
                return false;
            }
        }
        axis_init(&camera->axes[k], a, width, height);
    }
    /* down <= 15: reach < 2^61 + 2^48 */
    set_lens(camera, scene, (uint8_t)down);
    return true;
}

void ql_camera_pixel(ql_camera_pixel_t *pixel, const ql_camera_t *camera,
        uint16_t x, uint16_t y)
{
    pixel->camera = camera;
    for (unsigned k = 0; k < 6; k++) {
        const ql_camera_axis_t *a = &camera->axes[k];

        pixel->corner[k] = ql_asr64(a->corner + ql_mul_s64_u16(a->right, x) +
                                            ql_mul_s64_u16(a->down, y),
                16);
    }
}

/* step (2^16 of a unit) * u, u in 2^-16: exact floor */
static int64_t part_of(int64_t step, uint32_t u_q16)
{
    const int32_t high = (int32_t)ql_asr64(step, 32);
    const uint32_t low = ((uint32_t)ql_asr64(step, 16) & 0xffffu) * u_q16 >> 16;

    if (QL_CFG_SMALL) {
        /* |step| < 2^63, so the product is below 2^47 2^16 */
        return ql_asr64(
                ql_mul_s64_u16(ql_asr64(step, 16), (uint16_t)u_q16), 16);
    }
    if (ql_abs32(high) < 32768u) { /* 2^15 grid units a pixel */
        return high * (int32_t)u_q16 + (int32_t)low;
    }
    return ql_mul_s64_u16(high, (uint16_t)u_q16) + (int32_t)low;
}

/* Outside the box, in s.16? */
static bool is_outside(int64_t q16)
{
    return (uint64_t)q16 > (uint64_t)BOX_MAX_Q16;
}

/* Parameter at which the ray enters the slab of one axis from outside, as a
 * real; returns false if it never does. */
static bool slab_entry(int64_t origin, int32_t direction, ql_real_t *entry)
{
    int64_t outside = -origin;

    if (origin >= 0) {
        outside = origin - BOX_MAX_Q16;
        direction = -direction;
    }
    if (direction <= 0) {
        return false;
    }
    *entry = ql_real_mul(ql_real_from_u64((uint64_t)outside),
            ql_real_recip(ql_real_from_u64((uint32_t)direction)));
    return true;
}

/* Move an origin outside the box along the ray to where it enters. Origins are
 * below 2^47 in size (ql_camera_init()) and a step is below 2^38, so sums fit;
 * one inside the box stays where it is. */
static bool enter_box(int64_t origin[3], const int32_t direction[3])
{
    ql_real_t entry = {0, INT16_MIN / 2}; /* below any other */

    for (unsigned k = 0; k < 3; k++) {
        ql_real_t t;

        if (is_outside(origin[k])) {
            if (!slab_entry(origin[k], direction[k], &t)) {
                return false;
            }
            if (t.e > entry.e || (t.e == entry.e && t.m > entry.m)) {
                entry = t;
            }
        }
    }
    for (unsigned k = 0; k < 3; k++) {
        const ql_real_t way =
                ql_real_mul(entry, ql_real_from_u64(ql_abs32(direction[k])));
        int64_t step = 0;

        if (direction[k] == 0) {
            continue; /* inside, or there was no entry */
        }
        if (way.e > 6) {
            return false; /* 2^38 or more: past the box */
        }
        if (way.e > -32) {
            step = (int64_t)((uint64_t)way.m << 6 >> (6 - way.e));
        }
        origin[k] += direction[k] < 0 ? -step : step;
        /* A grid unit outside is the rounding of a ray that grazes the box. */
        if ((uint64_t)(origin[k] + 65536) > (uint64_t)BOX_MAX_Q16 + 131072) {
            return false;
        }
    }
    return true;
}

/* s.16 to a position, to nearest, cut to the box */
QL_FAST_INLINE ql_pos_t to_position(int64_t q16)
{
    const int64_t half = (int64_t)1 << (15 - QL_POS_BITS);
    const int64_t p = ql_asr64(q16 + half, 16 - QL_POS_BITS);
    const int64_t max = (int64_t)QL_GRID_MAX << QL_POS_BITS;

    return (ql_pos_t)(p < 0 ? 0 : p > max ? max : p);
}

bool ql_camera_ray(const ql_camera_pixel_t *pixel, ql_uniform2_t u,
        ql_uniform2_t lens, ql_ray_t *ray)
{
    const ql_camera_t *camera = pixel->camera;
    int64_t at[6];
    int32_t direction[3];
    const uint32_t right = u.u1 >> 17 << 1 | 1u; /* midpoints, u0.16 */
    const uint32_t below = u.u2 >> 17 << 1 | 1u;
    bool outside = QL_CFG_SMALL; /* then enter_box() finds out */
    ql_vec3_t d;

    for (unsigned k = 0; k < 6; k++) {
        at[k] = pixel->corner[k] + part_of(camera->axes[k].right, right) +
                part_of(camera->axes[k].down, below);
    }
    ql_lens_move(lens_of(camera), lens, at);
    for (unsigned k = 0; k < 3; k++) {
        /* ql_camera_init() keeps it at 2^30 or below */
        direction[k] = (int32_t)at[3 + k];
        outside = outside || is_outside(at[k]);
    }
    d.x = direction[0];
    d.y = direction[1];
    d.z = direction[2];
    ray->direction = ql_vec_to_dir(d);
    if (outside && !enter_box(at, direction)) {
        return false;
    }
    ray->origin.x = to_position(at[0]);
    ray->origin.y = to_position(at[1]);
    ray->origin.z = to_position(at[2]);
    return true;
}
