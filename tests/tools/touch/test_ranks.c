/* test_ranks.c - faces in one place have ranks, by the file */
/* SPDX-License-Identifier: MIT */

#include "scene/touch/ranks.h"
#include "tools/scene/scene_worlds.h"

static grid_t grid;
static bvh_t bvh;
static uint16_t *ranks;

static void find(world_t *world, unsigned leaf_max)
{
    static const bvh_cost_t cost = {100, 80};

    grid_round(&grid, world);
    bvh_build(&bvh, &grid, leaf_max, &cost, true);
    ranks = ranks_find(&grid, &bvh);
}

static void forget(world_t *world)
{
    free(ranks);
    bvh_free(&bvh);
    grid_free(&grid);
    world_free(world);
}

/* The rank of a face of the file. */
static unsigned rank_of(uint32_t face)
{
    for (uint32_t i = 0; i < grid.face_count; i++) {
        if (bvh.order[i] == face) {
            return ranks[i];
        }
    }
    return 99;
}

/* A square of two triangles in the plane z = slope x. */
static void add_square(
        world_t *world, double x, double y, double size, double slope)
{
    const double p[4][3] = {{x, y, slope * x},
            {x + size, y, slope * (x + size)},
            {x + size, y + size, slope * (x + size)}, {x, y + size, slope * x}};
    const double q[3][3] = {{p[0][0], p[0][1], p[0][2]},
            {p[2][0], p[2][1], p[2][2]}, {p[3][0], p[3][1], p[3][2]}};

    add_triangle(world, p, NULL);
    add_triangle(world, q, NULL);
}

TEST(what_only_meets_at_edges_has_no_ranks)
{
    world_t world;

    open_world(&world);
    add_square(&world, 0, 0, 1, 0.5);
    add_square(&world, 1, 0, 1, 0.5); /* beside it */
    add_square(&world, 0, 0, 1, 0.7); /* through it, in another plane */
    find(&world, 4);
    CHECK(ranks == NULL, "ranks");
    forget(&world);
}

TEST(what_overlaps_has_its_place_in_the_file_in_any_tree)
{
    for (unsigned leaf_max = 1; leaf_max <= 13; leaf_max += 4) {
        for (int i = 0; i < 3; i++) {
            const double slope = i - 1;
            world_t world;

            open_world(&world);
            /* the grid's unit is 1, so that the plane stays one */
            add_square(&world, 0, 0, 32751, slope);
            add_square(&world, 9000, 7000, 3000, slope); /* a decal */
            find(&world, leaf_max);
            CHECK(ranks != NULL, "no ranks");
            for (uint32_t f = 0; f < 4 && ranks != NULL; f++) {
                CHECK(rank_of(f) == f, "face %u: rank %u", f, rank_of(f));
            }
            forget(&world);
        }
    }
}

TEST(the_back_of_a_face_has_ranks)
{
    static const double p[3][3] = {{0, 0, 0}, {4, 0, 1}, {0, 4, 2}};
    static const double q[3][3] = {{4, 0, 1}, {0, 0, 0}, {0, 4, 2}};
    world_t world;

    open_world(&world);
    add_triangle(&world, p, NULL);
    add_triangle(&world, q, NULL);
    find(&world, 4);
    CHECK(ranks != NULL && rank_of(0) == 0 && rank_of(1) == 1, "ranks");
    forget(&world);
}

static void add_sphere(world_t *world, double x, double radius)
{
    world_sphere_t *sphere = world_add_sphere(world);

    sphere->centre[0] = x;
    sphere->radius = radius;
}

/* Two in one place, or as large ones beside each other and one in another. */
TEST(spheres_in_one_place_have_ranks_and_others_none)
{
    for (int equal = 0; equal < 2; equal++) {
        world_t world;

        open_world(&world);
        add_sphere(&world, 0, 1);
        add_sphere(&world, 3, 1);
        add_sphere(&world, 3, equal ? 1 : 0.5);
        find(&world, 4);
        CHECK((ranks != NULL) == equal, "%d: ranks %d", equal, ranks != NULL);
        for (uint32_t f = 0; f < 3 && ranks != NULL; f++) {
            CHECK(rank_of(f) == f, "sphere %u: rank %u", f, rank_of(f));
        }
        forget(&world);
    }
}

int main(int argc, char **argv)
{
    TEST_BEGIN("tools/ranks", argc, argv);
    RUN(what_only_meets_at_edges_has_no_ranks);
    RUN(what_overlaps_has_its_place_in_the_file_in_any_tree);
    RUN(the_back_of_a_face_has_ranks);
    RUN(spheres_in_one_place_have_ranks_and_others_none);
    return TEST_END();
}
