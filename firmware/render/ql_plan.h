/* ql_plan.h - which rays a vertex draws, and what they count of an emitter */
/* SPDX-License-Identifier: MIT */

/* At every vertex the light that comes straight from the emitters is counted
 * exactly once: by next-event estimation (ql_next_event.h), by a ray that meets
 * an emitter, or by both, each with its MIS weight. A vertex draws up to two
 * kinds of rays. The indirect ray leads on. Emitter rays end at what they meet;
 * they only count emitters.
 *
 * D is the density of the indirect ray; the last vertex has none. E is the
 * density by which the direct strategy draws rays towards emitters:
 *
 *     HEMISPHERE  UNIFORM             MIS                      BRDF
 *     COSINE      COSINE              NONE, AREA, SOLID_ANGLE  none
 *
 * Where D and E are the same, one ray does both. BRDF and COSINE are the same
 * of a surface that is diffuse only. A ray drawn by E counts C: all, or with
 * MIS the part of its MIS weight. A specular lobe has one direction only, so
 * no strategy but a ray along it counts what is there: that ray counts S,
 * which is all, or nothing if the strategy is NONE. But S is all for NONE as
 * well while the path was specular at every vertex, as what a mirror shows is
 * what the camera sees.
 *
 *     lobes      D, E          indirect ray  ..specular  emitter ray  ..spec.
 *     DIFFUSE,   none, none    none                      none
 *     GLOSSY     none, E       none                      E: C
 *                D, none       D: nothing                none
 *                D = E         E: C                      none
 *                D, E differ   D: nothing                E: C
 *     SPECULAR   none, any     none                      SPECULAR     S
 *                D, any        D           S             none
 *     MIXED      none, none    none                      SPECULAR     S
 *                none, E       none                      E: C         all
 *                D, none       D: nothing  S             none
 *                D = E         E: C        all           none
 *                D, E differ   D: nothing  nothing       E: C         all
 *
 * A SPECULAR emitter ray is drawn only if S is all.
 *
 * HEMISPHERE and COSINE draw N rays by E, N being light_samples, and the light
 * that a vertex reflects is estimated by their mean:
 *
 *     L = 1/N sum T_i Le_i,  T_i = f cos / pdf of ray i, Le_i what it meets
 *
 * So each of them counts 1/N, and of emitters that a specular lobe leads to as
 * well. If D = E the indirect ray is the first of the N. It counts 1/N too, but
 * leads on with all of its T_1: what comes by way of other surfaces is what one
 * ray says of it, whatever N is. MIS draws N points for each emitter asked and
 * one direction; its weights are those of N + 1 samples (ql_mis.h).
 * tests/unit/test_plan.c tries every row. */

#ifndef QL_PLAN_H
#define QL_PLAN_H

#include "base/ql_density.h"
#include "base/ql_settings.h"

/* How much of an emitter's light a ray counts that meets it. */
typedef enum {
    QL_COUNTS_NOTHING, /* it is counted in another way */
    QL_COUNTS_ALL,
    QL_COUNTS_MIS,  /* the part of its MIS weight (ql_mis.h) */
    QL_COUNTS_SHARE /* 1/N: it is one of N */
} ql_counts_t;

/* What lobes a surface has. */
typedef enum {
    QL_LOBES_DIFFUSE,  /* the diffuse one alone */
    QL_LOBES_GLOSSY,   /* Phong's, with a diffuse one or without */
    QL_LOBES_SPECULAR, /* one of a single direction: a mirror or glass */
    QL_LOBES_MIXED     /* a diffuse and a specular one */
} ql_lobes_t;

/* A ray to be drawn. */
typedef struct {
    ql_density_t density; /* QL_DENSITY_NONE: it is not drawn */
    ql_counts_t counts;   /* drawn from a lobe that is not specular */
    ql_counts_t specular; /* drawn from a specular lobe */
} ql_plan_ray_t;

/* The rays of a vertex. */
typedef struct {
    ql_plan_ray_t indirect; /* without one the path ends */
    ql_plan_ray_t emitter;
    uint8_t emitter_rays; /* how many are drawn by that */
} ql_plan_t;

/* The density E of a strategy, see above. */
QL_INLINE ql_density_t ql_plan_emitter_density(unsigned direct)
{
    return ql_direct_is(direct, QL_DIRECT_MIS)          ? QL_DENSITY_BRDF
           : ql_direct_is(direct, QL_DIRECT_HEMISPHERE) ? QL_DENSITY_UNIFORM
           : ql_direct_is(direct, QL_DIRECT_COSINE)     ? QL_DENSITY_COSINE
                                                        : QL_DENSITY_NONE;
}

/* Is a ray weighed by MIS? */
QL_INLINE bool ql_plan_is_mis(ql_counts_t counts)
{
    return QL_MIS && counts == QL_COUNTS_MIS;
}

/* Is it weighed by 1/N? Only directions are, and if there may be several. */
QL_INLINE bool ql_plan_is_share(ql_counts_t counts)
{
    return QL_CFG_LIGHT_SAMPLES && QL_DIRECTIONS && counts == QL_COUNTS_SHARE;
}

/* Are two densities one on a surface with these lobes? */
QL_INLINE bool ql_plan_is_same(ql_lobes_t lobes, ql_density_t a, ql_density_t b)
{
    return a == b || (lobes == QL_LOBES_DIFFUSE && a != QL_DENSITY_UNIFORM &&
                             b != QL_DENSITY_UNIFORM);
}

/* Plan the rays of a vertex: the table above.
 *
 *   settings   -  direct, indirect and light_samples are looked at
 *   lobes      -  of the surface
 *   bounces    -  how many indirect reflections may follow, 0 at the last
 *                 vertex
 *   specular   -  were all vertices before this one left by a specular lobe?
 *   return     the plan. Where an indirect ray has no density to choose, as
 *              the surface is specular only, its density does not matter.
 *
 * Cost: inline, so that a build pays for what its settings can ask for.
 */
QL_INLINE ql_plan_t ql_plan_of(const ql_settings_t *settings, ql_lobes_t lobes,
        unsigned bounces, bool specular)
{
    const ql_density_t indirect = QL_CFG_INDIRECT && bounces > 0
                                          ? (ql_density_t)settings->indirect
                                          : QL_DENSITY_NONE;
    const ql_density_t emitter =
            lobes != QL_LOBES_SPECULAR
                    ? ql_plan_emitter_density(settings->direct)
                    : QL_DENSITY_NONE;
    const bool mis = ql_direct_is(settings->direct, QL_DIRECT_MIS);
    const unsigned directions =
            QL_CFG_LIGHT_SAMPLES && !mis ? settings->light_samples : 1;
    const ql_counts_t of_all = directions > 1 ? QL_COUNTS_SHARE : QL_COUNTS_ALL;
    const ql_counts_t by_emitter = mis ? QL_COUNTS_MIS : of_all;
    const ql_counts_t by_specular =
            ql_direct_is(settings->direct, QL_DIRECT_NONE) && !specular
                    ? QL_COUNTS_NOTHING
                    : QL_COUNTS_ALL;
    ql_plan_t plan = {
            .indirect = {indirect, QL_COUNTS_NOTHING, by_specular},
            .emitter = {QL_DENSITY_NONE, QL_COUNTS_ALL, QL_COUNTS_ALL},
    };

    if (emitter == QL_DENSITY_NONE) {
        /* Only a specular lobe leads to emitters. If no indirect ray does, an
         * emitter ray takes that lobe alone. */
        if (indirect == QL_DENSITY_NONE && lobes >= QL_LOBES_SPECULAR &&
                by_specular == QL_COUNTS_ALL) {
            plan.emitter.density = QL_DENSITY_SPECULAR;
            plan.emitter_rays = 1;
        }
        return plan;
    }
    /* Rays towards emitters count whatever lobe they take. */
    plan.emitter = (ql_plan_ray_t){emitter, by_emitter, of_all};
    plan.emitter_rays = (uint8_t)directions; /* <= 255 */
    if (indirect == QL_DENSITY_NONE ||
            !ql_plan_is_same(lobes, indirect, emitter)) {
        plan.indirect.specular = QL_COUNTS_NOTHING;
        return plan;
    }
    /* The indirect ray is as good an emitter ray as any. */
    plan.indirect = plan.emitter;
    plan.emitter_rays--;
    if (plan.emitter_rays == 0) {
        plan.emitter.density = QL_DENSITY_NONE;
    }
    return plan;
}

#endif
