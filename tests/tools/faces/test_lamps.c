/* test_lamps.c - a lamp of which the grid drops faces keeps its power */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "scene/fill/fill.h"
#include "support/ql_test.h"
#include "tools/scene/scene_worlds.h"

#define PI 3.14159265358979323846

enum { SIDES = 40, LAMP = 1, OTHER = 2 };

static world_t world;

/* A floor that is 1 wide, so that the grid is 3.05e-5; two kinds of lamps. */
static void begin(void)
{
    static const double floor[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

    open_world(&world);
    (void)world_add_material(&world, "lamp", 4);
    (void)world_add_material(&world, "other", 5);
    for (int k = 0; k < 3; k++) {
        world.materials[LAMP].ke[k] = world.materials[OTHER].ke[k] = 1;
    }
    add_triangle(&world, floor, NULL);
}

/* A ring of a radius as one outline with a bridge, and its area. */
static double add_ring(double x, double y, double radius, uint32_t material)
{
    const uint32_t first = (uint32_t)world.vertex_count;
    const uint32_t n = 2 * SIDES + 2;
    fill_faults_t faults;
    size_t begin;

    for (int side = 0; side < 2; side++) {
        for (int i = 0; i <= SIDES; i++) {
            const double angle =
                    2 * PI * (side == 0 ? i % SIDES : -i % SIDES) / SIDES;
            const double r = side == 0 ? radius : 0.75 * radius;
            const double p[3] = {x + r * cos(angle), y + r * sin(angle), 0.25};

            (void)world_add_vertex(&world, p);
        }
    }
    begin = world.face_count;
    for (uint32_t i = 2; i < n; i++) {
        const world_face_t face = {{first, first + i - 1, first + i}, material,
                {0, 0, 0}, 0, false};

        world_add_face(&world, &face);
    }
    world.face_count =
            begin + fill_face(&faults, &world, world.faces + begin, n - 2);
    return SIDES / 2.0 * sin(2 * PI / SIDES) * radius * radius * (1 - 0.5625);
}

/* The emission times the area of a material on the grid. */
static double find_power(const grid_t *grid, uint32_t material)
{
    const double unit = soft_double(grid->unit);
    double power = 0;

    for (uint32_t i = 0; i < grid->face_count; i++) {
        const grid_face_t *face = grid->faces + i;
        int64_t n[3];

        if (face->material == material) {
            grid_normal(grid, face, n);
            power += soft_double(gain_value(face->gain)) * unit * unit / 2 *
                     sqrt((double)(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]));
        }
    }
    return power;
}

TEST(a_ring_keeps_its_power_when_most_of_its_faces_are_dropped)
{
    double most_dropped = 0;

    for (double radius = 3e-5; radius < 0.1; radius *= 1.5) {
        grid_t grid;
        double area;

        begin();
        area = add_ring(0.3, 0.4, radius, LAMP);
        grid_round(&grid, &world);
        (void)gain_faces(&grid, &world);
        CHECK(fabs(find_power(&grid, LAMP) / area - 1) < 0x1p-9, "%g: %g of %g",
                radius, find_power(&grid, LAMP), area);
        most_dropped = fmax(most_dropped,
                (double)grid.tiny_count / (double)world.face_count);
        grid_free(&grid);
        world_free(&world);
    }
    CHECK(most_dropped > 0.8, "%g", most_dropped);
    NOTE("up to %.0f %% of the faces dropped", 100 * most_dropped);
}

TEST(lamps_keep_their_own_power_only)
{
    double areas[2];
    grid_t grid;

    begin();
    areas[0] = add_ring(0.3, 0.4, 4e-5, LAMP);
    areas[1] = add_ring(0.3, 0.7, 9e-5, OTHER);
    (void)add_ring(0.6, 0.3, 1e-6, LAMP); /* all of it is dropped */
    grid_round(&grid, &world);
    (void)gain_faces(&grid, &world);
    CHECK(fabs(find_power(&grid, LAMP) / areas[0] - 1) < 0x1p-9, "%g of %g",
            find_power(&grid, LAMP), areas[0]);
    CHECK(fabs(find_power(&grid, OTHER) / areas[1] - 1) < 0x1p-9, "%g of %g",
            find_power(&grid, OTHER), areas[1]);
    CHECK(grid.lost_count == 1, "%zu lost", grid.lost_count);
    grid_free(&grid);
    world_free(&world);
}

TEST(a_lamp_that_is_there_twice_shines_once)
{
    grid_t grid;
    double area;

    begin();
    area = add_ring(0.3, 0.4, 6e-5, LAMP);
    (void)add_ring(0.3, 0.4, 6e-5, LAMP);
    grid_round(&grid, &world);
    (void)gain_faces(&grid, &world);
    CHECK(fabs(find_power(&grid, LAMP) / area - 1) < 0x1p-9, "%g of %g",
            find_power(&grid, LAMP), area);
    grid_free(&grid);
    world_free(&world);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("tools/lamps", argc, argv);
    RUN(a_ring_keeps_its_power_when_most_of_its_faces_are_dropped);
    RUN(lamps_keep_their_own_power_only);
    RUN(a_lamp_that_is_there_twice_shines_once);
    return TEST_END();
}
