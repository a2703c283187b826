/* ql_line.c - check settings; render a pixel, a line */
/* SPDX-License-Identifier: MIT */

#include "render/ql_line.h"

#include "render/ql_path.h"

static bool settings_in_range(const ql_settings_t *s)
{
    return s->width >= 1 && s->width <= QL_IMAGE_MAX && s->height >= 1 &&
           s->height <= QL_IMAGE_MAX && s->spp >= 1 && s->spp <= QL_SPP_MAX &&
           s->bounces <= QL_BOUNCES_MAX && s->sampler <= QL_SAMPLER_SOBOL &&
           s->direct <= QL_DIRECT_AREA && s->indirect <= QL_INDIRECT_COSINE;
}

ql_status_t ql_render_init(ql_render_t *render, const ql_scene_t *scene,
        const ql_settings_t *settings)
{
    static const ql_render_t zero;
    ql_settings_t s = *settings;

    *render = zero;
    if (s.width == 0) {
        s.width = QL_LE16(scene->header->image_width);
    }
    if (s.height == 0) {
        s.height = QL_LE16(scene->header->image_height);
    }
    if (!settings_in_range(&s) ||
            !ql_camera_init(&render->camera, scene, s.width, s.height)) {
        *render = zero;
        return QL_ERR_SETTINGS;
    }
    render->scene = scene;
    render->settings = s;
    render->exposure = ql_film_exposure(
            ql_i16(QL_LE16((uint16_t)scene->header->radiance_exp)),
            ql_i16(QL_LE16((uint16_t)scene->header->exposure_q8)));
    return QL_OK;
}

void ql_render_pixel(ql_render_t *render, uint16_t x, uint16_t y,
        uint32_t first, uint32_t count, ql_sum_t *sum)
{
    const ql_settings_t *s = &render->settings;
    ql_camera_pixel_t pixel;
    ql_sampler_t sampler;

    QL_ASSERT(x < s->width && y < s->height);
    QL_ASSERT(first <= QL_SPP_MAX && count <= QL_SPP_MAX - first);
    ql_camera_pixel(&pixel, &render->camera, x, y);
    ql_sampler_begin(&sampler, s->sampler, s->seed, x, y);
    for (uint32_t i = 0; i < count; i++) {
        ql_uniform2_t u;
        ql_ray_t ray;

        ql_sampler_start(&sampler, first + i);
        u = ql_sampler_2d(&sampler, QL_DIM_PIXEL);
        if (ql_camera_ray(&pixel, u.u1, u.u2, &ray)) {
            ql_path_trace(render->scene, s, &sampler, &ray, sum, &render->diag);
        }
    }
}

void ql_render_encode(const ql_render_t *render, uint16_t x, uint16_t y,
        const ql_sum_t *sum, uint32_t samples, const ql_output_t *outputs,
        uint8_t count)
{
    ql_uq16_t linear[3];

    ql_film_display(sum, samples, render->exposure, linear);
    for (uint8_t i = 0; i < count; i++) {
        ql_tonemap_pixel(outputs[i].pixels, outputs[i].format, x, y, linear);
    }
}

void ql_render_line(ql_render_t *render, uint16_t y, const ql_output_t *outputs,
        uint8_t count)
{
    const uint32_t spp = render->settings.spp;

    QL_ASSERT(y < render->settings.height && count > 0);
    for (uint16_t x = 0; x < render->settings.width; x++) {
        ql_sum_t sum = {{0, 0, 0}};

        ql_render_pixel(render, x, y, 0, spp, &sum);
        ql_render_encode(render, x, y, &sum, spp, outputs, count);
    }
}
