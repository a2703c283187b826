/* ql_line.c - check settings; render a pixel, a line */
/* SPDX-License-Identifier: MIT */

#include "render/ql_line.h"

#include "film/ql_adaptive.h"
#include "film/ql_curve.h"
#include "film/ql_meter.h"
#include "render/ql_path.h"
#include "scene/ql_auto.h"

static bool is_within(unsigned value, unsigned first, unsigned last)
{
    return value >= first && value <= last;
}

/* Rows of QL_SETTINGS_NEED: the gate is needed, and the build is without it. */
#define LACKS_OF_SET(gate, member) ((QL_CFG_##gate >> s->member) & 1) == 0 ||
#define LACKS(gate, member, first, last)                                       \
    (!QL_CFG_##gate && is_within(s->member, first, last)) ||
#define LACKS_BOTH(gate, a, a_first, a_last, b, b_first, b_last)               \
    (!QL_CFG_##gate && is_within(s->a, a_first, a_last) &&                     \
            is_within(s->b, b_first, b_last)) ||

/* Do the settings need a gate that this build is without? */
static bool lacks_a_gate(const ql_settings_t *s)
{
    const bool lacks = QL_SETTINGS_NEED(LACKS_OF_SET, LACKS, LACKS_BOTH) false;

    return lacks || ((QL_CFG_CURVES << 1 | 1) >> ql_curve_of(s) & 1) == 0;
}

static bool settings_in_range(const ql_settings_t *s)
{
    return s->width >= 1 && s->width <= QL_IMAGE_MAX && s->height >= 1 &&
           s->height <= QL_IMAGE_MAX && s->spp >= 1 && s->spp <= QL_SPP_MAX &&
           s->bounces <= QL_BOUNCES_MAX && s->sampler <= QL_SAMPLER_SOBOL &&
           s->direct <= QL_DIRECT_MIS && s->indirect <= QL_INDIRECT_BRDF &&
           s->lights <= QL_LIGHTS_UNIFORM && s->light_samples >= 1 &&
           s->roulette <= 1 && ql_curve_of(s) <= QL_CURVE_REINHARD &&
           !lacks_a_gate(s);
}

static int16_t radiance_exp_of(const ql_scene_t *scene)
{
    return ql_i16(QL_LE16((uint16_t)scene->header->radiance_exp));
}

static int16_t scene_exposure_q8(const ql_scene_t *scene)
{
    return ql_i16(QL_LE16((uint16_t)scene->header->exposure_q8));
}

#if QL_CFG_CLAMP
static void begin_clamp(ql_render_t *render)
{
    ql_clamp_begin(&render->clamp, render->settings.clamp_q16,
            radiance_exp_of(render->scene));
}
#else
static void begin_clamp(ql_render_t *render)
{
    (void)render;
}
#endif

/* Nothing is counted yet. */
static void begin_counts(ql_render_t *render)
{
    render->diag = (ql_diag_t){0};
    begin_clamp(render);
}

static int16_t within_64_stops(int32_t stops_q8)
{
    return (int16_t)(stops_q8 < -64 * 256  ? -64 * 256
                     : stops_q8 > 64 * 256 ? 64 * 256
                                           : stops_q8);
}

ql_status_t ql_render_init(ql_render_t *render, const ql_scene_t *scene,
        const ql_settings_t *settings)
{
    ql_settings_t s = *settings;

    ql_auto_resolve(&s, scene->header);
    if (!settings_in_range(&s) ||
            !ql_camera_init(&render->camera, scene, s.width, s.height)) {
        *render = (ql_render_t){0};
        return QL_ERR_SETTINGS;
    }
    render->scene = scene;
    render->settings = s;
    begin_counts(render);
    if (ql_meter_wanted(&s)) {
        s.exposure_q8 = within_64_stops(
                (int32_t)ql_render_meter(render) + s.exposure_q8);
        render->settings.exposure_q8 = s.exposure_q8;
    }
    render->exposure = ql_film_exposure(radiance_exp_of(scene),
            (int32_t)scene_exposure_q8(scene) + s.exposure_q8);
    return QL_OK;
}

/* Add samples first .. first + count - 1 of a pixel; its sampler has begun. */
static void add_samples(ql_render_t *render, const ql_camera_pixel_t *pixel,
        ql_sampler_t *sampler, uint32_t first, uint32_t count, ql_sum_t *sum)
{
    const ql_context_t context = {.scene = render->scene,
            .settings = &render->settings,
            .sampler = sampler,
            .sum = sum,
            .diag = &render->diag,
            QL_IF_BUILT(QL_CFG_CLAMP, .clamp = &render->clamp)};

    QL_ASSERT(first <= QL_SPP_MAX && count <= QL_SPP_MAX - first);
    for (uint32_t i = 0; i < count; i++) {
        ql_uniform2_t u, lens;
        ql_ray_t ray;

        QL_COUNT(samples);

        /* Draw a point of the pixel, and one of the lens if there is one. */
        ql_sampler_start(sampler, first + i);
        u = ql_sampler_2d(sampler, QL_DIM_PIXEL);
        lens = u; /* not looked at without a lens */
        if (ql_scene_lens(render->scene) != NULL) {
            lens = ql_sampler_2d(sampler, QL_DIM_LENS);
        }

        /* Follow the path, or see the sky past the scene. */
        if (ql_camera_ray(pixel, u, lens, &ray)) {
            ql_path_trace(&context, &ray);
        } else {
            ql_path_miss(&context, &ray);
        }
    }
}

void ql_render_pixel(ql_render_t *render, uint16_t x, uint16_t y,
        uint32_t first, uint32_t count, ql_sum_t *sum)
{
    const ql_settings_t *s = &render->settings;
    ql_camera_pixel_t pixel;
    ql_sampler_t sampler;

    QL_ASSERT(x < s->width && y < s->height);
    ql_camera_pixel(&pixel, &render->camera, x, y);
    ql_sampler_begin(&sampler, s->sampler, s->seed, x, y);
    add_samples(render, &pixel, &sampler, first, count, sum);
}

#if QL_CFG_METER
int16_t ql_render_meter(ql_render_t *render)
{
    static const ql_meter_t nothing;
    static const ql_sum_t black;
    const uint32_t width = render->settings.width;
    const uint32_t height = render->settings.height;
    ql_meter_t meter = nothing;

    for (uint32_t cell = 0; cell < QL_METER_SIDE * QL_METER_SIDE; cell++) {
        ql_sum_t sum = black;

        for (uint32_t k = 0; k < 4; k++) {
            /* the middle of a field of 2 by 2 in the cell */
            const uint32_t x = 4 * (cell % QL_METER_SIDE) + 2 * (k % 2) + 1;
            const uint32_t y = 4 * (cell / QL_METER_SIDE) + 2 * (k / 2) + 1;

            ql_render_pixel(render, (uint16_t)(x * width / (4 * QL_METER_SIDE)),
                    (uint16_t)(y * height / (4 * QL_METER_SIDE)), 0,
                    QL_METER_SAMPLES, &sum);
        }
        ql_meter_add(&meter, &sum);
    }
    begin_counts(render);
    if (meter.count == 0) {
        return 0;
    }
    return within_64_stops((int32_t)ql_meter_stops(&meter) -
                           256 * (int32_t)radiance_exp_of(render->scene) -
                           scene_exposure_q8(render->scene));
}
#endif

#if QL_CFG_ADAPTIVE
/* Add samples to a half of a pixel until it has count, each for itself. */
static void fill_half(ql_render_t *render, const ql_camera_pixel_t *pixel,
        ql_sampler_t *sampler, uint32_t count, ql_half_t *half)
{
    while (half->spread.count < count) {
        ql_sum_t sample = {{0, 0, 0}};

        add_samples(render, pixel, sampler, half->spread.count, 1, &sample);
        ql_half_add(half, &sample);
    }
}

uint32_t ql_render_adaptive(
        ql_render_t *render, uint16_t x, uint16_t y, ql_sum_t *sum)
{
    static const ql_sum_t black;
    static const ql_half_t none;
    const ql_settings_t *s = &render->settings;
    const uint32_t seeds[2] = {s->seed, s->seed ^ QL_ADAPTIVE_SEED};
    const uint32_t last = s->spp / 2; /* in each half */
    ql_half_t half[2];
    uint32_t count = QL_ADAPTIVE_MIN / 2;
    ql_camera_pixel_t pixel;
    ql_sampler_t sampler;

    QL_ASSERT(x < s->width && y < s->height);
    ql_camera_pixel(&pixel, &render->camera, x, y);
    if (s->error_q16 == 0 || s->spp < QL_ADAPTIVE_MIN) {
        *sum = black;
        ql_sampler_begin(&sampler, s->sampler, s->seed, x, y);
        add_samples(render, &pixel, &sampler, 0, s->spp, sum);
        return s->spp;
    }
    half[0] = half[1] = none;
    do {
        for (unsigned k = 0; k < 2; k++) {
            ql_sampler_begin(&sampler, s->sampler, seeds[k], x, y);
            fill_half(render, &pixel, &sampler, count, half + k);
        }
        count = 2 * count < last ? 2 * count : last;
    } while (!ql_half_decide(half, s->error_q16, half[0].spread.count == last));
    return ql_half_join(half, sum);
}
#endif

void ql_render_encode(const ql_render_t *render, uint16_t x, uint16_t y,
        const ql_sum_t *sum, uint32_t samples, const ql_output_t *outputs,
        uint8_t count)
{
    ql_uq16_t linear[3];

    ql_film_display(sum, samples, render->exposure, linear);
    ql_curve_roll_off(ql_curve_of(&render->settings), linear);
    for (uint8_t i = 0; i < count; i++) {
        ql_tonemap_pixel(outputs[i].pixels, outputs[i].format, x, y, linear);
    }
}

void ql_render_line(ql_render_t *render, uint16_t y, const ql_output_t *outputs,
        uint8_t count)
{
    QL_ASSERT(y < render->settings.height && count > 0);
    for (uint16_t x = 0; x < render->settings.width; x++) {
        ql_sum_t sum;
        const uint32_t samples = ql_render_adaptive(render, x, y, &sum);

        ql_render_encode(render, x, y, &sum, samples, outputs, count);
    }
}
