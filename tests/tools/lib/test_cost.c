/* test_cost.c - what is counted of a rendering is what the core does */
/* SPDX-License-Identifier: MIT */

#include "blob/ql_blob_open.h"
#include "lib/cost/cost.h"
#include "support/picture/box_scene.h"
#include "support/ql_test.h"

static ql_scene_t scene;

/* Render by the core and by its copy; the bits are the same, and so are rays.
 * Returns what was counted. */
static cost_events_t count(ql_direct_t direct, uint8_t light_samples)
{
    static const cost_events_t none;
    ql_settings_t settings = QL_SETTINGS_DEFAULT;
    cost_events_t events = none;
    ql_render_t render, copy;

    settings.direct = (uint8_t)direct;
    settings.light_samples = light_samples;
    settings.width = settings.height = 12;
    CHECK(ql_render_init(&render, &scene, &settings) == QL_OK, "settings");
    copy = render;
    for (uint16_t y = 0; y < 12; y++) {
        for (uint16_t x = 0; x < 12; x++) {
            ql_sum_t a = {{0, 0, 0}}, b = {{0, 0, 0}};

            ql_render_pixel(&render, x, y, 0, 4, &a);
            cost_render_pixel(&events, &copy, x, y, 0, 4, &b);
            CHECK(memcmp(&a, &b, sizeof a) == 0, "%u,%u", x, y);
        }
    }
    CHECK(events.samples == 12 * 12 * 4, "%lu", (unsigned long)events.samples);
    CHECK(copy.diag.closest_rays == render.diag.closest_rays &&
                    copy.diag.shadow_rays == render.diag.shadow_rays,
            "rays of the copy differ");
    /* without contacts and smooth normals these are all */
    CHECK(events.walks - events.segments == render.diag.closest_rays,
            "%lu rays, not %lu", (unsigned long)events.walks,
            (unsigned long)render.diag.closest_rays);
    CHECK(events.segments >= render.diag.shadow_rays, "%lu segments",
            (unsigned long)events.segments);
    return events;
}

TEST(the_copy_has_the_bits_and_rays_of_the_core)
{
    for (unsigned direct = QL_DIRECT_NONE; direct <= QL_DIRECT_MIS; direct++) {
        (void)count((ql_direct_t)direct, 1);
    }
}

TEST(events_are_those_of_the_strategy)
{
    const cost_events_t area = count(QL_DIRECT_AREA, 1);
    const cost_events_t four = count(QL_DIRECT_AREA, 4);
    const cost_events_t mis = count(QL_DIRECT_MIS, 1);
    const cost_events_t none = count(QL_DIRECT_NONE, 1);

    CHECK(area.vertices == four.vertices && area.vertices == mis.vertices &&
                    area.vertices == none.vertices,
            "the same paths have other vertices");
    CHECK(area.points > 0 && four.points == 4 * area.points &&
                    mis.points == area.points && none.points == 0,
            "%lu points, %lu", (unsigned long)area.points,
            (unsigned long)four.points);
    CHECK(area.balances == 0 && mis.balances > 0 && mis.weights > 0,
            "%lu balances", (unsigned long)mis.balances);
    CHECK(mis.densities >= mis.vertices, "%lu densities",
            (unsigned long)mis.densities);
}

TEST(every_event_costs_more_the_more_there_are)
{
    const cost_events_t area = count(QL_DIRECT_AREA, 1);
    const cost_events_t mis = count(QL_DIRECT_MIS, 1);
    cost_events_t twice = area;
    uint64_t *at = (uint64_t *)&twice;

    for (unsigned i = 0; i < COST_EVENT_COUNT; i++) {
        at[i] *= 2;
    }
    for (unsigned core = 0; core < COST_CORES; core++) {
        for (unsigned fine = 0; fine < 2; fine++) {
            const cost_core_t c = (cost_core_t)core;
            const uint64_t once = cost_instructions(&area, c, fine);
            const uint64_t both = cost_instructions(&twice, c, fine);

            CHECK(both >= 2 * once - 1 && both <= 2 * once + 1, "%s: %lu",
                    cost_core_name(c), (unsigned long)both);
            CHECK(once > 1000 * area.samples, "%s: %lu", cost_core_name(c),
                    (unsigned long)once);
            CHECK(cost_instructions(&mis, c, fine) > once, "%s: mis is cheaper",
                    cost_core_name(c));
        }
        CHECK(cost_instructions(&area, (cost_core_t)core, 1) >
                        cost_instructions(&area, (cost_core_t)core, 0),
                "fine is cheaper");
    }
}

TEST(cores_have_their_names)
{
    cost_core_t core = COST_M0;

    CHECK(cost_core_find(&core, "cortex-m3") && core == COST_M3, "%u", core);
    CHECK(cost_core_find(&core, "rv32imac") && core == COST_RV32, "%u", core);
    CHECK(!cost_core_find(&core, "z80"), "z80 is in the table");
}

int main(int argc, char **argv)
{
    size_t size;
    const void *blob = box_scene(&size);

    TEST_BEGIN("tools/test_cost", argc, argv);
    if (ql_blob_open(&scene, blob, size) != QL_OK) {
        return 1;
    }
    RUN(the_copy_has_the_bits_and_rays_of_the_core);
    RUN(events_are_those_of_the_strategy);
    RUN(every_event_costs_more_the_more_there_are);
    RUN(cores_have_their_names);
    return TEST_END();
}
