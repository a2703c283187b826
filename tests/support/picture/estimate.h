/* estimate.h - what the core says of one pixel, sample by sample */
/* SPDX-License-Identifier: MIT */

#ifndef ESTIMATE_H
#define ESTIMATE_H

#include "base/ql_settings.h"
#include "support/picture/mini_scene.h"
#include "support/ql_stats.h"

/* Every strategy of direct light that finds all of it. */
enum { AREA, HEMISPHERE, COSINE, SOLID_ANGLE, MIS, STRATEGIES };
extern const struct strategy {
    const char *name;
    uint8_t direct;
} strategies[STRATEGIES];

/* Settings of a claim: one bounce and sampler chosen, everything else fixed. */
ql_settings_t estimate_settings(
        ql_sampler_kind_t sampler, uint8_t bounces, uint32_t seed);

/* Render one pixel of a scene through ql_render_pixel(), one sample at a time.
 *
 *   m         -  complete; opened here
 *   settings  -  width and height are taken from m
 *   x, y      px the pixel
 *   samples   -  how many
 *   return    moments of the samples, in the units of mini_material()
 *
 * If a contribution was cut at its limit the mean is NAN, which no claim takes.
 */
stats_moments_t estimate_pixel(mini_scene_t *m, const ql_settings_t *settings,
        uint16_t x, uint16_t y, uint32_t samples);

/* The largest sum of any channel of any pixel: 0 only if all are black. */
uint64_t estimate_brightest(
        mini_scene_t *m, const ql_settings_t *settings, uint32_t samples);

/* How many standard errors the mean is off what it should be. */
double estimate_z(const stats_moments_t *moments, double mean, double variance);

#endif
