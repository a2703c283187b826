/* build_materials.c - what surfaces reflect and emit, in fixed point */
/* SPDX-License-Identifier: MIT */

#include "scene/build/build_materials.h"

#include <stdlib.h>
#include <string.h>

#include "lib/math/soft.h"
#include "lib/program/cli.h"
#include "scene/build/build_sky.h"
#include "scene/mesh/gain.h"
#include "scene/world/reflectance.h"

#define ONE              ((uint32_t)1 << 31) /* u1.31 */
#define RADIANCE_EXP_MAX 64

/* ---- what one reflects ---- */

/* 0..1 to u1.31. */
static uint32_t round_fraction(soft_t x)
{
    return (uint32_t)soft_round(x, 31);
}

/* Light that goes through a body crosses its surface twice, and Tf is what is
 * left then: each crossing takes the root. */
static void round_glass(
        ql_blob_gloss_t *gloss, const world_material_t *material)
{
    for (int k = 0; k < 3; k++) {
        gloss->specular[k] =
                round_fraction(soft_sqrt(soft_from(material->filter[k])));
    }
    /* 1/16..64 is 2^12..2^22 */
    gloss->parameter = (uint32_t)soft_round(soft_from(material->ni), 16);
    gloss->chance = ONE;
    gloss->kind = QL_GLOSS_GLASS;
}

/* s / (d + s) of the sums of channels, to nearest; an end only if it is one. */
static uint32_t find_chance(
        const uint32_t albedo[3], const uint32_t specular[3])
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

bool build_materials_round(uint32_t albedo[3], ql_blob_gloss_t *gloss,
        const world_material_t *material)
{
    const bool beyond = material->kind != 0;
    const soft_t scale = beyond ? reflectance_scale(material) : soft_int(1, 0);

    memset(gloss, 0, sizeof *gloss);
    if (material->kind == QL_GLOSS_GLASS) {
        memset(albedo, 0, 3 * sizeof *albedo);
        round_glass(gloss, material);
        return true;
    }
    for (int k = 0; k < 3; k++) {
        albedo[k] = round_fraction(soft_mul(soft_from(material->kd[k]), scale));
        if (beyond) {
            const uint32_t room = ONE - albedo[k];
            const uint32_t ks =
                    round_fraction(soft_mul(soft_from(material->ks[k]), scale));

            gloss->specular[k] = ks < room ? ks : room; /* both rounded up */
        }
    }
    if ((gloss->specular[0] | gloss->specular[1] | gloss->specular[2]) == 0) {
        return false;
    }
    gloss->kind = (uint16_t)material->kind;
    gloss->chance = find_chance(albedo, gloss->specular);
    if (material->kind == QL_GLOSS_PHONG) {
        /* 0..65535 is below 2^32 */
        gloss->parameter = (uint32_t)soft_round(soft_from(material->ns), 16);
    }
    return true;
}

/* ---- those in use ---- */

/* A material as some faces have it: a lamp that is smaller on the grid than it
 * was written shines the brighter. */
typedef struct {
    uint32_t material; /* of the world */
    uint32_t gain;
} use_t;

static int compare_uses(const void *a, const void *b)
{
    const use_t *p = a, *q = b;

    return p->material != q->material ? (p->material < q->material ? -1 : 1)
           : p->gain != q->gain       ? (p->gain < q->gain ? -1 : 1)
                                      : 0;
}

/* Each once, in the order of their definition; free() them. */
static use_t *find_uses(const grid_t *grid, size_t *count)
{
    use_t *uses = cli_alloc(grid->face_count, sizeof *uses);
    size_t n = 0;

    for (uint32_t i = 0; i < grid->face_count; i++) {
        uses[i].material = grid->faces[i].material;
        uses[i].gain = grid->faces[i].gain;
    }
    qsort(uses, grid->face_count, sizeof *uses, compare_uses);
    for (uint32_t i = 0; i < grid->face_count; i++) {
        if (n == 0 || compare_uses(uses + n - 1, uses + i) != 0) {
            uses[n++] = uses[i];
        }
    }
    *count = n;
    return uses;
}

static soft_t find_emission(const world_t *world, const use_t *use, int k)
{
    return soft_mul(soft_from(world->materials[use->material].ke[k]),
            gain_value(use->gain));
}

/* Smallest exponent for which every emission and the sky fit u0.32; 0 without
 * any. */
static int choose_exponent(
        const world_t *world, const use_t *uses, size_t count)
{
    soft_t most = build_sky_most(&world->sky);
    int e = -RADIANCE_EXP_MAX;

    for (size_t i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            const soft_t x = find_emission(world, uses + i, k);

            most = soft_compare(x, most) > 0 ? x : most;
        }
    }
    if (most.m == 0) {
        return 0;
    }
    /* x 2^(32 - e) <= 2^32 - 1 */
    while (soft_compare(most, soft_int(0xffffffff, e - 32)) > 0) {
        e++;
    }
    return e; /* Ke and sky are at most 1e18 < 2^60, gains 2^4 */
}

static void round_emission(uint32_t emission[3], const world_t *world,
        const use_t *use, int radiance_exp)
{
    for (int k = 0; k < 3; k++) {
        const soft_t x = find_emission(world, use, k);
        const int64_t rounded = soft_round(x, 32 - radiance_exp);

        /* what shines must not stop shining; 2^32 cannot be reached */
        emission[k] = rounded == 0 && x.m != 0 ? 1 : (uint32_t)rounded;
    }
}

typedef enum { DIFFUSE, GLOSSY } lobes_t;

/* Those in use; place[i] is where uses[i] went. */
typedef struct {
    use_t *uses;
    uint32_t *place;
    size_t count;
} uses_t;

/* Add the materials in use that are glossy, or those that are diffuse only. */
static void place_kind(
        model_t *model, const world_t *world, uses_t *all, lobes_t lobes)
{
    for (size_t i = 0; i < all->count; i++) {
        const use_t *use = all->uses + i;
        ql_blob_material_t material;
        ql_blob_gloss_t gloss;

        if (build_materials_round(material.albedo, &gloss,
                    world->materials + use->material) != (lobes == GLOSSY)) {
            continue;
        }
        round_emission(
                material.emission, world, use, model->header.radiance_exp);
        if (lobes == GLOSSY) {
            model->gloss[model->gloss_count++] = gloss;
        }
        all->place[i] = model->materials_count;
        model->materials[model->materials_count++] = material;
    }
}

static uint32_t find_place(const uses_t *all, const grid_face_t *face)
{
    const use_t key = {face->material, face->gain};
    const use_t *found = bsearch(
            &key, all->uses, all->count, sizeof *all->uses, compare_uses);

    return all->place[found - all->uses]; /* every face's is there */
}

void build_materials(model_t *model, const world_t *world, const grid_t *grid,
        const bvh_t *bvh)
{
    uses_t all;

    all.uses = find_uses(grid, &all.count);
    all.place = cli_alloc(all.count, sizeof *all.place);
    model->header.radiance_exp =
            (int16_t)choose_exponent(world, all.uses, all.count);
    model->materials = cli_alloc(all.count, sizeof *model->materials);
    model->gloss = cli_alloc(all.count, sizeof *model->gloss);
    place_kind(model, world, &all, GLOSSY);
    place_kind(model, world, &all, DIFFUSE);
    if (model->materials_count > QL_MATERIAL_MAX) {
        cli_fail(CLI_INPUT, "%s: expected %lu materials at most, found %lu",
                world->path, (unsigned long)QL_MATERIAL_MAX,
                (unsigned long)model->materials_count);
    }
    for (uint32_t i = 0; i < model->triangles_count; i++) {
        const uint32_t m = find_place(&all, grid->faces + bvh->order[i]);

        model->triangles[i].material =
                (uint16_t)(model->triangles[i].material | m);
    }
    free(all.place);
    free(all.uses);
}
