/* known_leak.c - no path leaves a closed room */
/* SPDX-License-Identifier: MIT */

/* usage: known_leak [CLAIM]
 *        known_leak --table RAYS [ROOM]
 *
 * The second prints the table that stands in firmware/DESIGN.md, of so many
 * rays a room. */

#include <stdlib.h>

#include "closed/rooms.h"
#include "qlux.h"
#include "scene/blob/write_blob.h"
#include "scene/build/compile.h"
#include "support/picture/estimate.h"
#include "support/ql_test.h"

enum { BOUNCES = 64, TURNS = 20, PARTS = 3 };

static const double parts[PARTS] = {1, 8, 32};

/* ---- Rays that leave --------------------------------------------------- */

typedef struct {
    uint64_t rays, left; /* closest-hit rays, and paths that saw the sky */
} count_t;

/* Follow paths until there were so many rays. */
static void follow(
        count_t *count, const ql_scene_t *scene, uint32_t seed, uint64_t rays)
{
    ql_settings_t settings =
            estimate_settings(QL_SAMPLER_RANDOM, BOUNCES, seed);
    ql_render_t render;

    settings.direct = QL_DIRECT_COSINE;
    settings.indirect = QL_INDIRECT_BRDF;
    CHECK(ql_render_init(&render, scene, &settings) == QL_OK, "settings");
    for (uint32_t i = 0; render.diag.closest_rays < rays; i++) {
        ql_sum_t sum = {{0, 0, 0}};

        ql_render_pixel(&render, 0, 0, i, 1, &sum);
        count->left += sum.rgb[0] > 0;
    }
    count->rays += render.diag.closest_rays;
}

/* Is contact looked for, as it is, or never? */
typedef enum { CORE, BLIND } eyes_t;

static count_t measure(
        const room_t *room, unsigned node_bits, eyes_t eyes, uint64_t rays)
{
    const compile_options_t options = {node_bits, 4, true};
    count_t count = {0, 0};

    for (unsigned i = 0; i < TURNS * PARTS; i++) {
        ql_scene_t scene;
        world_t world;
        model_t model;
        uint8_t *blob;
        size_t size;

        room_open(&world, room, i / PARTS, parts[i % PARTS]);
        compile_scene(&model, &world, &options);
        blob = write_blob(&model, &size);
        CHECK(ql_blob_open(&scene, blob, size) == QL_OK, "%s", room->name);
        if (eyes == BLIND) {
            scene.contacts = NULL;
        }
        follow(&count, &scene, i, rays / (TURNS * PARTS));
        free(blob);
        model_free(&model);
        world_free(&world);
    }
    return count;
}

TEST(no_path_leaves_a_closed_room)
{
    count_t all = {0, 0};

    for (unsigned i = 0; i < room_count; i++) {
        const count_t count =
                measure(rooms + i, i % 2 ? 8 : 16, CORE, MANY(150000));

        CHECK(count.left == 0, "%s: %llu of %llu", rooms[i].name,
                (unsigned long long)count.left, (unsigned long long)count.rays);
        all.rays += count.rays;
    }
    NOTE("%llu rays, %u rooms, %d turns, 1 to 1/32 of the grid",
            (unsigned long long)all.rays, room_count, TURNS);
}

TEST(paths_leave_if_nobody_looks_for_contact)
{
    const room_t *room = rooms;
    count_t count;

    while (strcmp(room->name, "glass") != 0) { /* the one that most leave */
        room++;
    }
    count = measure(room, 16, BLIND, MANY(600000));
    CHECK(count.left > 0, "none of %llu", (unsigned long long)count.rays);
    NOTE("%llu of %llu rays", (unsigned long long)count.left,
            (unsigned long long)count.rays);
}

static void print_table(uint64_t rays, const char *only)
{
    for (unsigned i = 0; i < room_count; i++) {
        count_t before, now;

        if (strstr(rooms[i].name, only) == NULL) {
            continue;
        }
        before = measure(rooms + i, 16, BLIND, rays);
        now = measure(rooms + i, 16, CORE, rays);
        (void)printf("| %s | %llu | %llu |\n", rooms[i].name,
                (unsigned long long)before.left, (unsigned long long)now.left);
        (void)fflush(stdout);
    }
}

int main(int argc, char **argv)
{
    if (argc > 2 && strcmp(argv[1], "--table") == 0) {
        print_table(strtoull(argv[2], NULL, 10), argc > 3 ? argv[3] : "");
        return 0;
    }
    TEST_BEGIN("known/leak", argc, argv);
    RUN(no_path_leaves_a_closed_room);
    RUN(paths_leave_if_nobody_looks_for_contact);
    return TEST_END();
}
