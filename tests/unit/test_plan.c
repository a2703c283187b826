/* test_plan.c - every vertex counts every emitter exactly once */
/* SPDX-License-Identifier: MIT */

#include "render/ql_plan.h"
#include "support/built.h"
#include "support/ql_test.h"

/* What a plan depends on. */
typedef struct {
    unsigned direct, indirect;
    unsigned samples; /* light_samples */
    ql_lobes_t lobes;
    unsigned bounces;
    bool specular;
} case_t;

static ql_plan_t plan_of(const case_t *c)
{
    ql_settings_t s = QL_SETTINGS_DEFAULT;

    s.direct = (uint8_t)c->direct;
    s.indirect = (uint8_t)c->indirect;
    s.light_samples = (uint8_t)c->samples;
    return ql_plan_of(&s, c->lobes, c->bounces, c->specular);
}

/* Call check for every case that this build has. Returns how many there are. */
static unsigned long each_case(
        void (*check)(const case_t *c, const ql_plan_t *plan))
{
    unsigned long count = 0;
    case_t c;

    for (c.direct = QL_DIRECT_NONE; c.direct <= QL_DIRECT_MIS; c.direct++) {
        for (unsigned i = 0; i < 4 * 4 * 3 * 2 * 2; i++) {
            c.indirect = i % 4; /* QL_INDIRECT_NONE .. _BRDF */
            c.lobes = (ql_lobes_t)(i / 4 % 4);
            c.bounces = i / 16 % 3;
            c.specular = i / 48 % 2 != 0;
            c.samples = i / 96 != 0 ? 3 : 1;
            if (!BUILT_HAS_DIRECT(c.direct) ||
                    (!QL_CFG_UNIFORM && c.indirect == QL_INDIRECT_UNIFORM) ||
                    (!QL_CFG_LIGHT_SAMPLES && c.samples > 1)) {
                continue;
            }
            {
                const ql_plan_t plan = plan_of(&c);

                check(&c, &plan);
                count++;
            }
        }
    }
    return count;
}

/* ---- The rule, from what is counted, not from how it is decided -------- */

/* By how much the estimators of a vertex count an emitter: in full, by shares
 * of some rays, or by the MIS weight that belongs to one of two densities. */
typedef struct {
    unsigned in_full, shares, of_towards, of_lobe;
} count_t;

static bool has_specular(ql_lobes_t lobes)
{
    return lobes == QL_LOBES_SPECULAR || lobes == QL_LOBES_MIXED;
}

static bool has_other(ql_lobes_t lobes)
{
    return lobes != QL_LOBES_SPECULAR;
}

static void count_rays(count_t *count, unsigned rays, ql_counts_t counts)
{
    count->in_full += counts == QL_COUNTS_ALL ? rays : 0;
    count->shares += counts == QL_COUNTS_SHARE ? rays : 0;
    count->of_lobe += counts == QL_COUNTS_MIS ? rays : 0;
}

/* All shares are one emitter. */
static void add_shares(count_t *count, const case_t *c)
{
    count->in_full += count->shares == c->samples;
    count->in_full += count->shares % c->samples != 0 ? 2 : 0; /* too many */
}

/* What is counted of light that a lobe which is not specular reflects. */
static count_t count_other(const case_t *c, const ql_plan_t *plan)
{
    count_t count = {0, 0, 0, 0};

    /* points or directions drawn towards the emitters */
    count.in_full += c->direct == QL_DIRECT_AREA;
    count.in_full += c->direct == QL_DIRECT_SOLID_ANGLE;
    count.of_towards += c->direct == QL_DIRECT_MIS;
    if (plan->indirect.density != QL_DENSITY_NONE) {
        count_rays(&count, 1, plan->indirect.counts);
    }
    if (plan->emitter.density != QL_DENSITY_NONE &&
            plan->emitter.density != QL_DENSITY_SPECULAR) {
        count_rays(&count, plan->emitter_rays, plan->emitter.counts);
    }
    add_shares(&count, c);
    return count;
}

/* And of light that a specular lobe does. */
static count_t count_specular(const case_t *c, const ql_plan_t *plan)
{
    count_t count = {0, 0, 0, 0};

    if (plan->indirect.density != QL_DENSITY_NONE) {
        count_rays(&count, 1, plan->indirect.specular);
    }
    if (plan->emitter.density != QL_DENSITY_NONE) {
        count_rays(&count, plan->emitter_rays, plan->emitter.specular);
    }
    add_shares(&count, c);
    return count;
}

/* What is wrong with a plan; NULL if nothing is. */
static const char *fault_of(const case_t *c, const ql_plan_t *plan)
{
    const count_t other = count_other(c, plan);
    const count_t specular = count_specular(c, plan);

    if (has_other(c->lobes)) {
        if (other.in_full > 1 || other.of_lobe > 1 ||
                other.of_lobe != other.of_towards ||
                (other.in_full != 0 && other.of_lobe != 0)) {
            return "an emitter is counted twice, or by half of MIS";
        }
        if ((other.in_full + other.of_lobe == 0) !=
                (c->direct == QL_DIRECT_NONE)) {
            return "an emitter is counted by no strategy, or not by one";
        }
    }
    if (has_specular(c->lobes)) {
        /* Without direct light a mirror shows what the camera sees. */
        const bool shows = c->direct != QL_DIRECT_NONE || c->specular;

        if (specular.in_full != shows || specular.of_lobe != 0) {
            return "a mirror counts an emitter twice, or not at all";
        }
    }
    return NULL;
}

static void check_counts(const case_t *c, const ql_plan_t *plan)
{
    const char *fault = fault_of(c, plan);

    CHECK(fault == NULL,
            "direct %u x %u indirect %u lobes %d bounces %u/%d: %s", c->direct,
            c->samples, c->indirect, c->lobes, c->bounces, c->specular, fault);
}

TEST(every_emitter_is_counted_exactly_once)
{
    const unsigned long count = each_case(check_counts);

    unsigned long wanted = 0;

    for (unsigned i = QL_DIRECT_NONE; i <= QL_DIRECT_MIS; i++) {
        wanted += BUILT_HAS_DIRECT(i) ? (QL_CFG_UNIFORM ? 4 : 3) * 4 * 3 * 2 *
                                                (QL_CFG_LIGHT_SAMPLES ? 2 : 1)
                                      : 0;
    }
    CHECK(count == wanted, "%lu, not %lu", count, wanted);
    NOTE("%lu plans", count);
}

/* ---- Densities --------------------------------------------------------- */

/* Is a density the one wanted? Of a diffuse lobe alone BRDF is COSINE. */
static bool is_density(
        ql_lobes_t lobes, ql_density_t density, ql_density_t wanted)
{
    static const ql_density_t diffuse[] = {QL_DENSITY_NONE, QL_DENSITY_COSINE,
            QL_DENSITY_UNIFORM, QL_DENSITY_COSINE, QL_DENSITY_SPECULAR};

    return lobes == QL_LOBES_DIFFUSE ? diffuse[density] == diffuse[wanted]
                                     : density == wanted;
}

static void check_indirect(const case_t *c, const ql_plan_t *plan)
{
    static const ql_density_t density[] = {QL_DENSITY_NONE, QL_DENSITY_COSINE,
            QL_DENSITY_UNIFORM, QL_DENSITY_BRDF};
    const bool goes_on = QL_CFG_INDIRECT && c->bounces > 0;

    CHECK(is_density(c->lobes, plan->indirect.density,
                  density[goes_on ? c->indirect : QL_INDIRECT_NONE]),
            "direct %u indirect %u lobes %d bounces %u: density %d", c->direct,
            c->indirect, c->lobes, c->bounces, plan->indirect.density);
}

TEST(the_path_goes_on_by_the_density_asked_for_until_the_last_vertex)
{
    NOTE("%lu plans", each_case(check_indirect));
}

static void check_emitter(const case_t *c, const ql_plan_t *plan)
{
    static const ql_density_t wanted[] = {QL_DENSITY_NONE, QL_DENSITY_NONE,
            QL_DENSITY_UNIFORM, QL_DENSITY_COSINE, QL_DENSITY_NONE,
            QL_DENSITY_BRDF};
    const ql_plan_ray_t *ray =
            plan->indirect.density != QL_DENSITY_NONE &&
                            plan->indirect.counts != QL_COUNTS_NOTHING
                    ? &plan->indirect
                    : &plan->emitter;

    if (!has_other(c->lobes) || wanted[c->direct] == QL_DENSITY_NONE) {
        return; /* a ray along the specular lobe, or none */
    }
    CHECK(is_density(c->lobes, ray->density, wanted[c->direct]),
            "direct %u indirect %u lobes %d bounces %u: density %d", c->direct,
            c->indirect, c->lobes, c->bounces, ray->density);
    CHECK(ray->counts == (c->direct == QL_DIRECT_MIS ? QL_COUNTS_MIS
                                 : c->samples > 1    ? QL_COUNTS_SHARE
                                                     : QL_COUNTS_ALL),
            "direct %u x %u counts %d", c->direct, c->samples, ray->counts);
}

TEST(emitters_are_met_by_rays_of_the_strategys_density)
{
    NOTE("%lu plans", each_case(check_emitter));
}

/* ---- No ray too many --------------------------------------------------- */

static void check_need(const case_t *c, const ql_plan_t *plan)
{
    ql_plan_t less = *plan;

    if (plan->emitter.density == QL_DENSITY_NONE) {
        return;
    }
    less.emitter_rays--;
    CHECK(fault_of(c, &less) != NULL,
            "direct %u indirect %u lobes %d bounces %u: an idle ray", c->direct,
            c->indirect, c->lobes, c->bounces);
    CHECK(c->samples > 1 || !is_density(c->lobes, plan->emitter.density,
                                    plan->indirect.density),
            "direct %u indirect %u lobes %d: two rays of density %d", c->direct,
            c->indirect, c->lobes, plan->emitter.density);
}

TEST(an_emitter_ray_is_drawn_only_where_no_other_ray_will_do)
{
    NOTE("%lu plans", each_case(check_need));
}

/* ---- The rule has teeth ------------------------------------------------ */

static unsigned long planted, seen;

static bool same_ray(const ql_plan_ray_t *a, const ql_plan_ray_t *b)
{
    return a->density == b->density && a->counts == b->counts &&
           a->specular == b->specular;
}

static void plant(const case_t *c, const ql_plan_t *plan, ql_plan_t bad)
{
    const bool same = same_ray(&plan->indirect, &bad.indirect) &&
                      same_ray(&plan->emitter, &bad.emitter) &&
                      plan->emitter_rays == bad.emitter_rays;

    if (!same) {
        planted++;
        seen += fault_of(c, &bad) != NULL;
    }
}

/* Change what a ray that is drawn counts, for lobes that the surface has. */
static void check_teeth(const case_t *c, const ql_plan_t *plan)
{
    /* the share of one is all */
    const ql_counts_t last = c->samples > 1 ? QL_COUNTS_SHARE : QL_COUNTS_MIS;

    for (ql_counts_t k = QL_COUNTS_NOTHING; k <= last; k++) {
        ql_plan_t bad = *plan;

        if (plan->indirect.density != QL_DENSITY_NONE) {
            if (has_other(c->lobes)) {
                bad.indirect.counts = k;
                plant(c, plan, bad);
            }
            bad = *plan;
            if (has_specular(c->lobes)) {
                bad.indirect.specular = k;
                plant(c, plan, bad);
            }
        }
        bad = *plan;
        if (plan->emitter.density != QL_DENSITY_NONE) {
            if (plan->emitter.density != QL_DENSITY_SPECULAR) {
                bad.emitter.counts = k;
                plant(c, plan, bad);
            }
            bad = *plan;
            if (has_specular(c->lobes)) {
                bad.emitter.specular = k;
                plant(c, plan, bad);
            }
            bad = *plan;
            if (k == QL_COUNTS_NOTHING) {
                bad.emitter_rays++;
                plant(c, plan, bad);
            }
        }
    }
}

TEST(a_plan_that_counts_anything_else_is_refused)
{
    (void)each_case(check_teeth);
    CHECK(planted > 0 && seen == planted, "%lu of %lu", seen, planted);
    NOTE("%lu plans", planted);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_plan", argc, argv);
    RUN(every_emitter_is_counted_exactly_once);
    RUN(the_path_goes_on_by_the_density_asked_for_until_the_last_vertex);
    RUN(emitters_are_met_by_rays_of_the_strategys_density);
    RUN(an_emitter_ray_is_drawn_only_where_no_other_ray_will_do);
    RUN_IF(QL_CFG_INDIRECT, a_plan_that_counts_anything_else_is_refused);
    return TEST_END();
}
