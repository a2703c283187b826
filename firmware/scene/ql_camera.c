/* ql_camera.c - affine origin and direction, clipped to the scene's box */
/* SPDX-License-Identifier: MIT */

#include "scene/ql_camera.h"

#include "math/ql_real.h"
#include "sample/ql_square.h"
#include "sample/ql_warp.h"

/* The box in s.16 grid units, and how far outside an origin may be: rays from
 * further away cannot hit it, because the origins' plane touches the box and
 * rays spread from there. */
#define BOX_MAX_Q16 ((int64_t)QL_GRID_MAX << 16)
#define FAR_Q16     ((int64_t)1 << 36)

QL_FAST_INLINE int64_t wide_field(const uint32_t words[2])
{
    return ql_i64((uint64_t)QL_LE32(words[1]) << 32 | QL_LE32(words[0]));
}

QL_FAST_INLINE int64_t narrow_field(uint32_t word)
{
    return (int64_t)ql_i32(QL_LE32(word)) * 65536;
}

/* A coordinate as the blob has it: base + x right + y up on the plane. */
enum { BASE, RIGHT, UP, AFFINE };

/* Axis 0..2 of the origin, 3..5 of the direction. */
static void affine_of(
        const ql_blob_camera_t *c, unsigned axis, int64_t a[AFFINE])
{
    const uint32_t(*const wide[AFFINE])[2] = {c->p, c->pr, c->pu};
    const uint32_t *const narrow[AFFINE] = {c->d, c->dr, c->du};

    for (unsigned i = 0; i < AFFINE; i++) {
        a[i] = axis < 3 ? wide_field(wide[i][axis])
                        : narrow_field(narrow[i][axis - 3]);
    }
}

/* Steps per pixel: the picture is 2 high and 2 width/height wide; y points
 * down. Sums stay in 64 bits because ql_camera_init() checked reach_of(). */
static void axis_init(ql_camera_axis_t *axis, const int64_t a[AFFINE],
        unsigned down, uint16_t width, uint16_t height)
{
    const int64_t half_x = ql_div_s64_u16(ql_asr64(a[RIGHT], down), height);
    const int64_t half_y = ql_div_s64_u16(-ql_asr64(a[UP], down), height);

    axis->right = 2 * half_x;
    axis->down = 2 * half_y;
    axis->corner = ql_asr64(a[BASE], down) - ql_mul_s64_u16(half_x, width) -
                   ql_mul_s64_u16(half_y, height);
}

/* Size of a sum base + right * width / height + up; above 2^62 some number
 * above that. */
static uint64_t reach_of(
        const int64_t a[AFFINE], uint16_t width, uint16_t height)
{
    const uint64_t limit = UINT64_MAX / 4;
    const uint64_t side = ql_abs64(ql_div_s64_u16(a[RIGHT], height)) + 1;
    const uint64_t base = ql_abs64(a[BASE]), up = ql_abs64(a[UP]);

    /* width <= 2^14 and side <= 2^63, so the first product fits */
    if (base > limit || up > limit ||
            ql_mul_s64_u16((int64_t)(side >> 16), width) > (int64_t)1 << 46) {
        return UINT64_MAX;
    }
    /* < 3/4 2^64: side width <= 2^62 + 2^30 */
    return base + (uint64_t)ql_mul_s64_u16((int64_t)side, width) + up;
}

#if QL_CFG_LENS
/* What a lens adds to a reach: both of its halves, and what ql_warp_disk() may
 * err by. At most 2^63 + 2^49. */
static uint64_t lens_reach(int64_t first, int64_t second)
{
    const uint64_t sum = ql_abs64(first) + ql_abs64(second);

    return sum + (sum >> 14);
}
#endif

bool ql_camera_init(ql_camera_t *camera, const ql_scene_t *scene,
        uint16_t width, uint16_t height)
{
    uint64_t reach = 0;
    unsigned down = 0;

    /* Directions of very wide pictures are scaled to stay below 2^30. */
    for (unsigned k = 3; k < 6; k++) {
        int64_t a[AFFINE];
        uint64_t r;

        affine_of(scene->camera, k, a);
        r = reach_of(a, width, height);
        reach = r > reach ? r : reach;
    }
#if QL_CFG_LENS
    camera->lens = scene->lens;
    if (scene->lens != NULL) {
        const uint64_t at_film = reach; /* below 2^61 */

        for (unsigned k = 0; k < 3; k++) {
            const uint64_t r =
                    at_film + lens_reach(narrow_field(scene->lens->d[0][k]),
                                      narrow_field(scene->lens->d[1][k]));

            reach = r > reach ? r : reach;
        }
    }
#endif
    for (; reach > (uint64_t)1 << 46; reach >>= 1) {
        down++;
    }
    for (unsigned k = 0; k < 6; k++) {
        int64_t a[AFFINE];

        affine_of(scene->camera, k, a);
        if (k < 3) {
            uint64_t r = reach_of(a, width, height);

#if QL_CFG_LENS
            if (scene->lens != NULL && r <= (uint64_t)1 << 62) {
                r += lens_reach(wide_field(scene->lens->p[0][k]),
                        wide_field(scene->lens->p[1][k]));
            }
#endif
            if (r > (uint64_t)1 << 62) {
                return false;
            }
        }
        axis_init(&camera->axes[k], a, k < 3 ? 0 : down, width, height);
    }
#if QL_CFG_LENS
    camera->down = (uint8_t)down; /* <= 15: reach < 2^61 + 2^48 */
#endif
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

#if !QL_CFG_SMALL
    if (ql_abs32(high) < 32768u) { /* 2^15 grid units a pixel */
        return high * (int32_t)u_q16 + (int32_t)low;
    }
#endif
    return ql_mul_s64_u16(high, (uint16_t)u_q16) + (int32_t)low;
}

/* Outside the box, in s.16? */
static bool is_outside(int64_t q16)
{
    return (uint64_t)q16 > (uint64_t)BOX_MAX_Q16;
}

/* Parameter at which the ray enters the slab of one axis, as a real; returns
 * false if it never does. */
static bool slab_entry(int64_t origin, int32_t direction, ql_real_t *entry)
{
    const int64_t outside = origin < 0 ? -origin : origin - BOX_MAX_Q16;

    if ((origin < 0) != (direction > 0) || direction == 0) {
        return false;
    }
    *entry = ql_real_mul(ql_real_from_u64((uint64_t)outside),
            ql_real_recip(ql_real_from_u64(ql_abs32(direction))));
    return true;
}

static bool real_less(ql_real_t a, ql_real_t b)
{
    return b.m != 0 && (a.m == 0 || a.e < b.e || (a.e == b.e && a.m < b.m));
}

/* Move an origin outside the box along the ray to where it enters. */
static bool enter_box(int64_t origin[3], const int32_t direction[3])
{
    ql_real_t entry = {0, 0};

    for (unsigned k = 0; k < 3; k++) {
        ql_real_t t;

        if (ql_abs64(origin[k]) > (uint64_t)FAR_Q16) {
            return false;
        }
        if (is_outside(origin[k])) {
            if (!slab_entry(origin[k], direction[k], &t)) {
                return false;
            }
            entry = real_less(entry, t) ? t : entry;
        }
    }
    for (unsigned k = 0; k < 3; k++) {
        const ql_real_t way =
                ql_real_mul(entry, ql_real_from_u64(ql_abs32(direction[k])));
        int64_t step = 0;

        if (way.m != 0 && way.e > 6) {
            return false; /* 2^38 or more: past the box */
        }
        if (way.m != 0 && way.e > -32) {
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

#if QL_CFG_LENS
/* Move the ray to a point (a, b) of the lens. */
static void lens_add(const ql_camera_t *camera, ql_uniform2_t u, int64_t at[6])
{
    const ql_blob_lens_t *lens = camera->lens;
    ql_q29_t a[2];

    ql_warp_disk(u.u1, u.u2, &a[0], &a[1]);
    for (unsigned i = 0; i < 6; i++) {
        /* p in s31.16 = high 2^16 + low: products below 2^60 */
        const unsigned k = i >> 1;
        const int64_t p = ql_asr64(wide_field(lens->p[i & 1u][k]), 16);
        const int64_t high = ql_asr64(p, 16), low = p & 0xffff;
        const int64_t d = ql_i32(QL_LE32(lens->d[i & 1u][k]));

        at[k] += ql_asr64(high * a[i & 1u], 13) + ql_asr64(low * a[i & 1u], 29);
        at[3 + k] += ql_asr64(d * a[i & 1u], 29u + camera->down);
    }
}
#endif

bool ql_camera_ray(const ql_camera_pixel_t *pixel, ql_uniform2_t u,
        ql_uniform2_t lens, ql_ray_t *ray)
{
    const ql_camera_t *camera = pixel->camera;
    int64_t at[6];
    int32_t direction[3];
    const uint32_t right = u.u1 >> 17 << 1 | 1u; /* midpoints, u0.16 */
    const uint32_t below = u.u2 >> 17 << 1 | 1u;
    bool outside = false;
    ql_vec3_t d;

    for (unsigned k = 0; k < 6; k++) {
        at[k] = pixel->corner[k] + part_of(camera->axes[k].right, right) +
                part_of(camera->axes[k].down, below);
    }
#if QL_CFG_LENS
    if (camera->lens != NULL) {
        lens_add(camera, lens, at);
    }
#else
    (void)lens;
#endif
    for (unsigned k = 0; k < 3; k++) {
        /* ql_camera_init() keeps it at 2^30 or below */
        direction[k] = (int32_t)at[3 + k];
        outside = outside || is_outside(at[k]);
    }
    d.x = direction[0];
    d.y = direction[1];
    d.z = direction[2];
    ray->direction = ql_dir_round(d);
    if (outside && !enter_box(at, direction)) {
        return false;
    }
    ray->origin.x = to_position(at[0]);
    ray->origin.y = to_position(at[1]);
    ray->origin.z = to_position(at[2]);
    return true;
}
