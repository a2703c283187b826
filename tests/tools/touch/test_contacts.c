/* test_contacts.c - what comes near the inside of a face is marked */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "tools/scene/scene_worlds.h"
#include "scene/touch/contacts.h"

static grid_t grid;
static bvh_t bvh;
static uint16_t *marks;

static void find(const world_t *world)
{
    static const bvh_cost_t cost = {100, 80};

    grid_round(&grid, world);
    bvh_build(&bvh, &grid, 4, &cost, true);
    marks = contacts_find(&grid, &bvh);
}

static void forget(world_t *world)
{
    free(marks);
    bvh_free(&bvh);
    grid_free(&grid);
    world_free(world);
}

static bool is_marked(uint32_t i)
{
    return (marks[i / 16] >> i % 16 & 1) != 0;
}

/* Of the faces from first to last of the file. */
static unsigned count_marks(uint32_t first, uint32_t last)
{
    unsigned count = 0;

    for (uint32_t i = 0; i < grid.face_count; i++) {
        count += bvh.order[i] >= first && bvh.order[i] <= last && is_marked(i);
    }
    return count;
}

static void add_quad(world_t *world, const double p[4][3])
{
    const double second[3][3] = {{p[0][0], p[0][1], p[0][2]},
            {p[2][0], p[2][1], p[2][2]}, {p[3][0], p[3][1], p[3][2]}};

    add_triangle(world, p, NULL);
    add_triangle(world, second, NULL);
}

/* The six sides of a box, turned about z: 12 faces. */
static void add_box(
        world_t *world, double x, double y, double z, double half, double turn)
{
    double p[8][3];

    for (int i = 0; i < 8; i++) {
        const double a = i & 1 ? half : -half, b = i & 2 ? half : -half;

        p[i][0] = x + a * cos(turn) - b * sin(turn);
        p[i][1] = y + a * sin(turn) + b * cos(turn);
        p[i][2] = z + (i & 4 ? half : -half);
    }
    for (int k = 0; k < 6; k++) {
        static const int side[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 2, 6, 4},
                {1, 5, 7, 3}, {0, 4, 5, 1}, {2, 3, 7, 6}};
        double q[4][3];

        for (int i = 0; i < 4; i++) {
            memcpy(q[i], p[side[k][i]], sizeof q[i]);
        }
        add_quad(world, (const double(*)[3])q);
    }
}

TEST(what_stands_alone_has_no_table)
{
    static const double quad[4][3] = {
            {0, 0, 0}, {1, 0, 0}, {1, 0.3, 1}, {0, 0.3, 1}};
    world_t world;

    open_world(&world);
    add_quad(&world, quad);
    find(&world);
    CHECK(marks == NULL, "two halves of a plane touch");
    forget(&world);
}

TEST(a_room_touches_at_its_edges_only)
{
    for (int i = 0; i < 8; i++) {
        world_t world;

        open_world(&world);
        add_box(&world, 0, 0, 0, 1, 0.1 * i);
        find(&world);
        CHECK(marks != NULL && count_marks(0, 11) == 0, "%u marks",
                marks == NULL ? 99 : count_marks(0, 11));
        forget(&world);
    }
}

TEST(what_a_block_stands_on_is_marked)
{
    world_t world;

    open_world(&world);
    add_box(&world, 0, 0, 0, 1, 0);            /* faces 0, 1: its floor */
    add_box(&world, 0.3, 0.2, -0.7, 0.3, 0.4); /* 12, 13: what is flush on it */
    find(&world);
    CHECK(count_marks(0, 1) == 2 && count_marks(2, 11) == 0 &&
                    count_marks(12, 13) == 2 && count_marks(14, 23) == 0,
            "floor %u, room %u, bottom %u, block %u", count_marks(0, 1),
            count_marks(2, 11), count_marks(12, 13), count_marks(14, 23));
    forget(&world);
}

/* ---- Anything ---------------------------------------------------------- */

/* Is a point of another face near the inside of a face, by the words of the
 * header, in double? */
static bool is_near(const grid_face_t *face, const double p[3], double room)
{
    double v[3][3], n[3], height = 0, size = 0;
    int z = 0;

    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            v[i][k] = grid.vertices[face->vertex[i]][k];
        }
    }
    for (int k = 0; k < 3; k++) {
        const int x = (k + 1) % 3, y = (k + 2) % 3;

        n[k] = (v[1][x] - v[0][x]) * (v[2][y] - v[0][y]) -
               (v[1][y] - v[0][y]) * (v[2][x] - v[0][x]);
        height += n[k] * (p[k] - v[0][k]);
        if (fabs(n[k]) > size) {
            size = fabs(n[k]);
            z = k;
        }
    }
    if (fabs(height) >= (3.5 + room) * size) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        const int x = (z + 1) % 3, y = (z + 2) % 3;
        const double *a = v[i], *b = v[(i + 1) % 3];
        const double away = ((b[x] - a[x]) * (p[y] - a[y]) -
                                    (b[y] - a[y]) * (p[x] - a[x])) *
                            (n[z] < 0 ? -1 : 1);

        if (away <= (2.5 - room) * (fabs(b[x] - a[x]) + fabs(b[y] - a[y]))) {
            return false;
        }
    }
    return true;
}

/* Does any of many points of one face come near the inside of another? */
static bool comes_near(
        const grid_face_t *face, const grid_face_t *other, double room)
{
    enum { STEPS = 40 };

    for (int i = 0; i <= STEPS; i++) {
        for (int j = 0; j <= STEPS - i; j++) {
            double p[3];

            for (int k = 0; k < 3; k++) {
                const double a = grid.vertices[other->vertex[0]][k];
                const double b = grid.vertices[other->vertex[1]][k];
                const double c = grid.vertices[other->vertex[2]][k];

                p[k] = a + (b - a) * i / STEPS + (c - a) * j / STEPS;
            }
            if (is_near(face, p, room)) {
                return true;
            }
        }
    }
    return false;
}

/* Small faces close to each other, some in one plane or on a common edge. */
static void add_crowd(world_t *world, double spread)
{
    double last[3][3];

    for (int i = 0; i < 12; i++) {
        double p[3][3];

        for (int j = 0; j < 3; j++) {
            for (int k = 0; k < 3; k++) {
                p[j][k] = 500 + spread * uniform();
            }
        }
        if (i % 3 == 1) {
            memcpy(p[0], last[0], sizeof p[0]);
            memcpy(p[1], last[2], sizeof p[1]);
        }
        memcpy(last, p, sizeof last);
        add_triangle(world, (const double(*)[3])p, NULL);
    }
}

TEST(what_comes_near_is_marked_and_nothing_far_from_it)
{
    static const double corner[2][3][3] = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
            {{32751, 32751, 32751}, {32750, 32751, 32751},
                    {32751, 32750, 32751}}};
    unsigned near = 0, far = 0;

    for (int round = 0; round < MANY(160); round++) {
        world_t world;

        open_world(&world);
        add_triangle(&world, corner[0], NULL); /* the grid's unit is 1 */
        add_triangle(&world, corner[1], NULL);
        add_crowd(&world, 8 << round % 5);
        find(&world);
        for (uint32_t i = 0; i < grid.face_count; i++) {
            const grid_face_t *face = grid.faces + bvh.order[i];
            bool is_close = false, is_far = true;

            for (uint32_t k = 0; k < grid.face_count; k++) {
                const grid_face_t *other = grid.faces + k;

                if (other != face) {
                    is_close = is_close || comes_near(face, other, 0);
                    is_far = is_far && !comes_near(face, other, 1);
                }
            }
            CHECK(!is_close || (marks != NULL && is_marked(i)),
                    "round %d: face %u is not marked", round, bvh.order[i]);
            CHECK(!is_far || marks == NULL || !is_marked(i),
                    "round %d: face %u is marked", round, bvh.order[i]);
            near += is_close;
            far += is_far;
        }
        forget(&world);
    }
    CHECK(near > 20 && far > 20, "%u near, %u far", near, far);
    NOTE("%u faces near another, %u far from all", near, far);
}

TEST(a_sphere_marks_what_it_touches)
{
    for (int i = 0; i < 3; i++) {
        const double at[3] = {0.3, 0.2, i < 2 ? -0.7 : -0.5};
        world_sphere_t *sphere;
        world_t world;

        open_world(&world);
        add_box(&world, 0, 0, 0, 1, 0);
        sphere = world_add_sphere(&world);
        memcpy(sphere->centre, at, sizeof at);
        sphere->radius = i == 0 ? 0.3 : i == 1 ? 0.32 : 0.3;
        find(&world);
        CHECK((count_marks(0, 1) > 0) == (i < 2) && count_marks(2, 11) == 0 &&
                        (count_marks(12, 12) > 0) == (i < 2),
                "%d: floor %u, room %u, sphere %u", i, count_marks(0, 1),
                count_marks(2, 11), count_marks(12, 12));
        forget(&world);
    }
}

int main(int argc, char **argv)
{
    TEST_BEGIN("tools/contacts", argc, argv);
    RUN(what_stands_alone_has_no_table);
    RUN(a_room_touches_at_its_edges_only);
    RUN(what_a_block_stands_on_is_marked);
    RUN(what_comes_near_is_marked_and_nothing_far_from_it);
    RUN(a_sphere_marks_what_it_touches);
    return TEST_END();
}
