/* ql_light.c - discrete choice of an emitter, what its probability comes to */
/* SPDX-License-Identifier: MIT */

#include "light/ql_light.h"

#include "sample/ql_cdf.h"

#define LIGHT_WORDS (sizeof(ql_blob_light_t) / sizeof(uint32_t))

uint16_t ql_light_choose(
        const ql_scene_t *scene, unsigned choice, ql_uq32_t pick)
{
    if (scene->light_count < 2) {
        return 0;
    }
    if (ql_lights_is(choice, QL_LIGHTS_UNIFORM)) {
        return (uint16_t)ql_mulhi_u32(pick, scene->light_count);
    }
    return ql_cdf_sample(
            &scene->lights->cum, LIGHT_WORDS, scene->light_count, pick);
}

/* ceil(i 2^32 / n) for i <= n: where equal shares begin; 0 for i = n = 2^32. */
static uint32_t equal_bound(uint32_t i, uint32_t n)
{
    /* digit by digit in base 2^16, as i < 2^16 */
    const uint32_t high = (i << 16) / n, rest = (i << 16) - high * n;
    const uint32_t low = (rest << 16) / n;

    return (high << 16 | low) + (low * n != rest << 16);
}

/* Where the values for which a light is chosen begin; 0 after the last, which
 * is 2^32. */
static uint32_t bound_of(
        const ql_scene_t *scene, unsigned choice, uint32_t light)
{
    const uint32_t n = scene->light_count;

    if (ql_lights_is(choice, QL_LIGHTS_UNIFORM)) {
        return equal_bound(light, n);
    }
    return light < n ? QL_LE32(scene->lights[light].cum) : 0;
}

ql_real_t ql_light_pmf(const ql_scene_t *scene, unsigned choice, uint16_t light)
{
    if (ql_lights_is(choice, QL_LIGHTS_ALL) || scene->light_count < 2) {
        return QL_REAL_ONE;
    }
    return ql_real_scale(ql_real_from_u64(bound_of(scene, choice, light + 1ul) -
                                          bound_of(scene, choice, light)),
            -32);
}

#if QL_CFG_LIGHT_CHOICES != 1 || QL_CFG_LIGHT_SAMPLES
ql_real_t ql_light_weight(const ql_scene_t *scene, unsigned choice,
        unsigned samples, uint16_t light)
{
    ql_real_t weight = QL_REAL_INV_2PI;

    if (ql_lights_is(choice, QL_LIGHTS_POWER)) {
        weight = ql_light_power_weight(scene->lights + light);
    } else if (ql_lights_is(choice, QL_LIGHTS_UNIFORM) &&
               scene->light_count > 1) {
        weight = ql_real_mul(
                weight, ql_real_recip(ql_light_pmf(scene, choice, light)));
    }
    if (QL_CFG_LIGHT_SAMPLES && samples > 1) {
        weight = ql_real_mul(weight, ql_real_recip(ql_real_from_u64(samples)));
    }
    return weight;
}
#endif

#if QL_MIS
bool ql_light_find(const ql_scene_t *scene, uint16_t index, uint16_t *light)
{
    uint32_t low = 0, high = scene->light_count;

    while (low < high) {
        const uint32_t mid = (low + high) / 2;

        if (QL_LE16(scene->lights[mid].triangle) < index) {
            low = mid + 1;
        } else {
            high = mid;
        }
    }
    *light = (uint16_t)low; /* <= light_count */
    return low < scene->light_count &&
           QL_LE16(scene->lights[low].triangle) == index;
}
#endif
