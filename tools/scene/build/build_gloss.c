/* build_gloss.c - what materials are beyond diffuse, in fixed point */
/* SPDX-License-Identifier: MIT */

#include "scene/build/build_gloss.h"

#include <string.h>

#define ONE ((uint32_t)1 << 31) /* u1.31 */

/* The largest sum of Kd and Ks of a channel. */
static soft_t largest_sum(const world_material_t *material)
{
    soft_t most = soft_int(0, 0);

    for (int k = 0; k < 3; k++) {
        const soft_t sum = soft_add(
                soft_from(material->kd[k]), soft_from(material->ks[k]));

        most = soft_compare(sum, most) > 0 ? sum : most;
    }
    return most;
}

bool gloss_excess(const world_material_t *material)
{
    return soft_round(largest_sum(material), 31) > ONE;
}

soft_t gloss_scale(const world_material_t *material)
{
    const soft_t one = soft_int(1, 0);

    return gloss_excess(material) ? soft_div(one, largest_sum(material)) : one;
}

/* 0..1 to u1.31. */
static uint32_t fraction(soft_t x)
{
    return (uint32_t)soft_round(x, 31);
}

static void round_glass(
        ql_blob_gloss_t *gloss, const world_material_t *material)
{
    for (int k = 0; k < 3; k++) {
        gloss->specular[k] = fraction(soft_from(material->filter[k]));
    }
    /* 1/16..64 is 2^12..2^22 */
    gloss->parameter = (uint32_t)soft_round(soft_from(material->ni), 16);
    gloss->chance = ONE;
    gloss->kind = QL_GLOSS_GLASS;
}

/* s / (d + s) of the sums of channels, to nearest; an end only if it is one. */
static uint32_t chance_of(const uint32_t albedo[3], const uint32_t specular[3])
{
    const uint64_t s = (uint64_t)specular[0] + specular[1] + specular[2];
    const uint64_t d = (uint64_t)albedo[0] + albedo[1] + albedo[2];
    /* s, d < 2^33; one bit more than wanted, to round by */
    const uint64_t q =
            u128_div(u128_mul(s, (uint64_t)1 << 32), s + d, NULL).low;
    const uint32_t chance = (uint32_t)((q + 1) >> 1); /* <= 2^31 */

    if (chance == 0 || d == 0) {
        return d == 0 ? ONE : 1;
    }
    return chance == ONE ? ONE - 1 : chance;
}

bool gloss_round(uint32_t albedo[3], ql_blob_gloss_t *gloss,
        const world_material_t *material)
{
    const bool beyond = material->kind != 0;
    const soft_t scale = beyond ? gloss_scale(material) : soft_int(1, 0);

    memset(gloss, 0, sizeof *gloss);
    if (material->kind == QL_GLOSS_GLASS) {
        memset(albedo, 0, 3 * sizeof *albedo);
        round_glass(gloss, material);
        return true;
    }
    for (int k = 0; k < 3; k++) {
        albedo[k] = fraction(soft_mul(soft_from(material->kd[k]), scale));
        if (beyond) {
            const uint32_t room = ONE - albedo[k];
            const uint32_t ks =
                    fraction(soft_mul(soft_from(material->ks[k]), scale));

            gloss->specular[k] = ks < room ? ks : room; /* both rounded up */
        }
    }
    if ((gloss->specular[0] | gloss->specular[1] | gloss->specular[2]) == 0) {
        return false;
    }
    gloss->kind = (uint16_t)material->kind;
    gloss->chance = chance_of(albedo, gloss->specular);
    if (material->kind == QL_GLOSS_PHONG) {
        /* 0..65535 is below 2^32 */
        gloss->parameter = (uint32_t)soft_round(soft_from(material->ns), 16);
    }
    return true;
}
