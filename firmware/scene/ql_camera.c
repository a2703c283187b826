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

static int64_t wide_field(const uint32_t words[2])
{
    return ql_i64((uint64_t)QL_LE32(words[1]) << 32 | QL_LE32(words[0]));
}

static int64_t narrow_field(uint32_t word)
{
    return (int64_t)ql_i32(QL_LE32(word)) * 65536;
}

/* Steps per pixel: the picture is 2 high and 2 width/height wide; y points
 * down. Sums stay in 64 bits because ql_camera_init() checked reach_of(). */
static void axis_init(int64_t base, int64_t right, int64_t up, uint16_t width,
        uint16_t height, int64_t *corner, int64_t *step_x, int64_t *step_y)
{
    const int64_t half_x = ql_div_s64_u16(right, height);
    const int64_t half_y = -ql_div_s64_u16(up, height);

    *step_x = 2 * half_x;
    *step_y = 2 * half_y;
    *corner = base - half_x * width - half_y * height;
}

/* Size of a sum base + right * width / height + up, or UINT64_MAX. */
static uint64_t reach_of(int64_t base, int64_t right, int64_t up,
        uint16_t width, uint16_t height)
{
    const uint64_t limit = UINT64_MAX / 4;
    const uint64_t side = ql_abs64(ql_div_s64_u16(right, height)) + 1;
    const uint64_t side_max =
            ql_abs64(ql_div_s64_u16(INT64_MAX / 2, width)); /* limit / width */

    if (ql_abs64(base) > limit || ql_abs64(up) > limit || side > side_max) {
        return UINT64_MAX;
    }
    return ql_abs64(base) + side * width + ql_abs64(up); /* < 3/4 2^64 */
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
    const ql_blob_camera_t *c = scene->camera;
    uint64_t reach = 0;
    unsigned down = 0;

    /* Directions of very wide pictures are scaled to stay below 2^30. */
    for (unsigned k = 0; k < 3; k++) {
        const uint64_t r = reach_of(narrow_field(c->d[k]),
                narrow_field(c->dr[k]), narrow_field(c->du[k]), width, height);

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
    while (reach >> down > (uint64_t)1 << 46) {
        down++;
    }
    for (unsigned k = 0; k < 3; k++) {
        const int64_t p = wide_field(c->p[k]);
        const int64_t pr = wide_field(c->pr[k]);
        const int64_t pu = wide_field(c->pu[k]);

        if (reach_of(p, pr, pu, width, height) > (uint64_t)1 << 62) {
            return false;
        }
#if QL_CFG_LENS
        if (scene->lens != NULL &&
                reach_of(p, pr, pu, width, height) +
                                lens_reach(wide_field(scene->lens->p[0][k]),
                                        wide_field(scene->lens->p[1][k])) >
                        (uint64_t)1 << 62) {
            return false;
        }
#endif
        axis_init(p, pr, pu, width, height, &camera->origin[k],
                &camera->origin_x[k], &camera->origin_y[k]);
        axis_init(ql_asr64(narrow_field(c->d[k]), down),
                ql_asr64(narrow_field(c->dr[k]), down),
                ql_asr64(narrow_field(c->du[k]), down), width, height,
                &camera->direction[k], &camera->direction_x[k],
                &camera->direction_y[k]);
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
    for (unsigned k = 0; k < 3; k++) {
        pixel->origin[k] =
                ql_asr64(camera->origin[k] + camera->origin_x[k] * x +
                                 camera->origin_y[k] * y,
                        16);
        pixel->direction[k] = (int32_t)ql_asr64(
                camera->direction[k] + camera->direction_x[k] * x +
                        camera->direction_y[k] * y,
                16);
    }
}

/* step (2^16 of a unit) * u, u in 2^-16: exact floor */
static int64_t part_of(int64_t step, uint32_t u_q16)
{
    const int64_t step_q16 = ql_asr64(step, 16);

    if (step_q16 == ql_i32((uint32_t)step_q16)) {
        return ql_mul_s32_u16(ql_i32((uint32_t)step_q16), u_q16);
    }
    return ql_asr64(step_q16, 16) * (int64_t)u_q16; /* beyond 2^15 a pixel */
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

        if (origin[k] < -FAR_Q16 || origin[k] > FAR_Q16) {
            return false;
        }
        if (origin[k] < 0 || origin[k] > BOX_MAX_Q16) {
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
            step = way.e >= 0 ? (int64_t)((uint64_t)way.m << way.e)
                              : (int64_t)(way.m >> -way.e);
        }
        origin[k] += direction[k] < 0 ? -step : step;
        /* A grid unit outside is the rounding of a ray that grazes the box. */
        if (origin[k] < -65536 || origin[k] > BOX_MAX_Q16 + 65536) {
            return false;
        }
    }
    return true;
}

/* s.16 to a position, to nearest, cut to the box */
static ql_pos_t to_position(int64_t q16)
{
    const int64_t half = (int64_t)1 << (15 - QL_POS_BITS);
    const int64_t p = ql_asr64(q16 + half, 16 - QL_POS_BITS);
    const int64_t max = (int64_t)QL_GRID_MAX << QL_POS_BITS;

    return (ql_pos_t)(p < 0 ? 0 : p > max ? max : p);
}

#if QL_CFG_LENS
/* Move the ray to a point (a, b) of the lens along one axis: a of s2.29. */
static void lens_add(const ql_camera_t *camera, unsigned k, const ql_q29_t a[2],
        int64_t *origin, int32_t *direction)
{
    const ql_blob_lens_t *lens = camera->lens;

    for (unsigned i = 0; i < 2; i++) {
        /* p in s31.16 = high 2^16 + low: products below 2^60 */
        const int64_t p = ql_asr64(wide_field(lens->p[i][k]), 16);
        const int64_t high = ql_asr64(p, 16), low = p & 0xffff;
        const int64_t d = ql_i32(QL_LE32(lens->d[i][k]));

        *origin += ql_asr64(high * a[i], 13) + ql_asr64(low * a[i], 29);
        /* ql_camera_init() keeps the sum at 2^30 or below */
        *direction += (int32_t)ql_asr64(d * a[i], 29u + camera->down);
    }
}
#endif

bool ql_camera_ray(const ql_camera_pixel_t *pixel, ql_uniform2_t u,
        ql_uniform2_t lens, ql_ray_t *ray)
{
    const ql_camera_t *camera = pixel->camera;
    int64_t origin[3];
    int32_t direction[3];
    const uint32_t right = u.u1 >> 17 << 1 | 1u; /* midpoints, u0.16 */
    const uint32_t below = u.u2 >> 17 << 1 | 1u;
    bool outside = false;
    ql_vec3_t d;
#if QL_CFG_LENS
    ql_q29_t at[2] = {0, 0};

    if (camera->lens != NULL) {
        ql_warp_disk(lens.u1, lens.u2, &at[0], &at[1]);
    }
#else
    (void)lens;
#endif

    for (unsigned k = 0; k < 3; k++) {
        origin[k] = pixel->origin[k] + part_of(camera->origin_x[k], right) +
                    part_of(camera->origin_y[k], below);
        direction[k] = pixel->direction[k] +
                       (int32_t)part_of(camera->direction_x[k], right) +
                       (int32_t)part_of(camera->direction_y[k], below);
#if QL_CFG_LENS
        if (camera->lens != NULL) {
            lens_add(camera, k, at, &origin[k], &direction[k]);
        }
#endif
        outside = outside || origin[k] < 0 || origin[k] > BOX_MAX_Q16;
    }
    d.x = direction[0];
    d.y = direction[1];
    d.z = direction[2];
    ray->direction = ql_dir_round(d);
    if (outside && !enter_box(origin, direction)) {
        return false;
    }
    ray->origin.x = to_position(origin[0]);
    ray->origin.y = to_position(origin[1]);
    ray->origin.z = to_position(origin[2]);
    return true;
}
