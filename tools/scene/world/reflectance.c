/* reflectance.c - how much a material reflects, and what keeps it to 1 */
/* SPDX-License-Identifier: MIT */

#include "scene/world/reflectance.h"

/* The largest sum of Kd and Ks of a channel. */
static soft_t find_largest_sum(const world_material_t *material)
{
    soft_t most = soft_int(0, 0);

    for (int k = 0; k < 3; k++) {
        const soft_t sum = soft_add(
                soft_from(material->kd[k]), soft_from(material->ks[k]));

        most = soft_compare(sum, most) > 0 ? sum : most;
    }
    return most;
}

bool reflectance_is_excess(const world_material_t *material)
{
    return soft_round(find_largest_sum(material), 31) > (int64_t)1 << 31;
}

soft_t reflectance_scale(const world_material_t *material)
{
    const soft_t one = soft_int(1, 0);

    return reflectance_is_excess(material)
                   ? soft_div(one, find_largest_sum(material))
                   : one;
}
