/* test_joints.c - edges are split where others meet on them */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "scene/touch/joints.h"
#include "tools/scene/scene_worlds.h"

static world_t world;

static void add(const double a[3], const double b[3], const double c[3],
        const double (*normals)[3])
{
    double p[3][3];

    memcpy(p[0], a, sizeof p[0]);
    memcpy(p[1], b, sizeof p[1]);
    memcpy(p[2], c, sizeof p[2]);
    add_triangle(&world, (const double(*)[3])p, normals);
}

/* A turn about an axis that is none of the grid's. */
static void turn(double p[3], double angle)
{
    const double c = cos(angle), s = sin(angle);
    const double x = c * p[0] - s * p[1], y = s * p[0] + c * p[1];
    const double z = p[2];

    p[0] = x;
    p[1] = c * y - s * z;
    p[2] = s * y + c * z;
}

/* A square of two triangles, and beyond its side at x = 1 as many narrower
 * ones, up to the same length; shift moves their corners off the side. */
static void make_strip(int parts, double shift, double angle)
{
    double a[3] = {-1, -1, 0}, b[3] = {1, -1, 0}, c[3] = {1, 1, 0};
    double d[3] = {-1, 1, 0};

    open_world(&world);
    turn(a, angle);
    turn(b, angle);
    turn(c, angle);
    turn(d, angle);
    add(a, b, d, NULL);
    add(b, c, d, NULL);
    for (int i = 0; i < parts; i++) {
        double e[3] = {1 + (i > 0 ? shift : 0), -1 + 2.0 * i / parts, 0};
        double f[3] = {2, e[1], 0.5};
        double g[3] = {
                1 + (i < parts - 1 ? shift : 0), -1 + 2.0 * (i + 1) / parts, 0};
        double h[3] = {2, g[1], 0.5};

        turn(e, angle);
        turn(f, angle);
        turn(g, angle);
        turn(h, angle);
        add(e, f, g, NULL);
        add(f, h, g, NULL);
    }
}

/* Edges of the grid that only one face has, but for the outline's. */
static unsigned cracks(void)
{
    static grid_t grid;
    unsigned count = 0;

    grid_round(&grid, &world);
    for (uint32_t f = 0; f < grid.face_count; f++) {
        for (int i = 0; i < 3; i++) {
            const uint32_t a = grid.faces[f].vertex[i];
            const uint32_t b = grid.faces[f].vertex[(i + 1) % 3];
            unsigned uses = 0;

            for (uint32_t g = 0; g < grid.face_count; g++) {
                for (int k = 0; k < 3; k++) {
                    uses += grid.faces[g].vertex[k] == b &&
                            grid.faces[g].vertex[(k + 1) % 3] == a;
                }
            }
            count += uses == 0;
        }
    }
    grid_free(&grid);
    return count;
}

TEST(a_side_is_split_where_others_meet_on_it)
{
    for (int parts = 1; parts <= 7; parts++) {
        for (int i = 0; i < 9; i++) {
            const double angle = 0.2 * i;
            size_t cuts;

            make_strip(parts, 0, angle);
            cuts = joints_split(&world);
            CHECK(cuts == (parts > 1), "%d parts: %zu cuts", parts, cuts);
            CHECK(world.face_count == (size_t)(2 + 2 * parts + parts - 1),
                    "%d parts: %zu faces", parts, world.face_count);
            /* three sides of the square, two ends, and the far side of each */
            CHECK(cracks() == (unsigned)(3 + 2 + parts),
                    "%d parts, angle %g: %u edges", parts, angle, cracks());
            world_free(&world);
        }
    }
}

TEST(what_is_off_the_side_is_left_alone)
{
    /* the scene is 3 wide, so a unit is 3 / 32751 */
    static const double off[] = {0.2, 0.4, 0.7, 1, 3};

    for (int i = 0; i < 5; i++) {
        size_t cuts;

        make_strip(4, off[i] * 3 / 32751, 0);
        cuts = joints_split(&world);
        CHECK(cuts == (off[i] < 0.5), "%g units: %zu cuts", off[i], cuts);
        world_free(&world);
    }
}

TEST(a_closed_mesh_stays_as_it_is)
{
    static const double p[5][3] = {
            {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0, 0}};
    static const double q[2][3] = {{0.2, -0.4, 0}, {0.7, -0.3, 0}};

    open_world(&world);
    add(p[0], p[2], p[1], NULL);
    add(p[0], p[1], p[3], NULL);
    add(p[1], p[2], p[3], NULL);
    add(p[2], p[0], p[3], NULL);
    add(p[4], q[0], q[1], NULL); /* a corner on an edge that two faces have */
    CHECK(joints_split(&world) == 0 && world.face_count == 5, "cut");
    world_free(&world);
}

TEST(an_end_that_nothing_goes_on_from_is_no_joint)
{
    static const double a[3] = {0, 0, 0}, b[3] = {8, 0, 0}, c[3] = {0, 8, 0};
    static const double p[3][3] = {{2, 0, 0}, {6, 0, 0}, {3, -2, 0}};

    open_world(&world);
    add(a, b, c, NULL);
    add(p[0], p[2], p[1], NULL); /* its side lies on another's, within it */
    CHECK(joints_split(&world) == 0 && world.face_count == 2, "cut");
    world_free(&world);
}

/* All of a face: parts in its place, material, group, area, normals. */
TEST(parts_are_what_the_face_was)
{
    static const double n[3][3] = {{0, 0, 1}, {0.6, 0, 0.8}, {0, 0.6, 0.8}};
    static const double a[3] = {0, 0, 0}, b[3] = {8, 0, 0}, c[3] = {0, 8, 0};
    const double m[3] = {2, 0, 0}, below[3] = {3, -2, 0};
    double area = 0;
    size_t mesh;

    open_world(&world);
    world_add_mesh(&world, "one");
    add(a, b, c, n);
    world_add_mesh(&world, "two");
    mesh = world.mesh_count - 1;
    add(a, below, m, NULL);
    add(below, b, m, NULL);
    world.faces[0].material = 5;
    world.faces[0].group = 7;
    CHECK(joints_split(&world) == 1 && world.face_count == 4, "%zu faces",
            world.face_count);
    CHECK(world.meshes[mesh].first_face == 2, "mesh at %zu",
            world.meshes[mesh].first_face);
    for (int f = 0; f < 2; f++) {
        const world_face_t *face = world.faces + f;
        const double *v[3];

        CHECK(face->material == 5 && face->group == 7, "part %d", f);
        for (int i = 0; i < 3; i++) {
            const double *normal = world.normals[face->normal[i] - 1];

            v[i] = world.vertices[face->vertex[i]];
            CHECK(face->normal[i] != 0 &&
                            (v[i][0] != 2 ||
                                    (fabs(normal[0] - 0.15) < 1e-3 &&
                                            fabs(normal[2] - 0.95) < 1e-3)),
                    "part %d, corner %d", f, i);
        }
        area += ((v[1][0] - v[0][0]) * (v[2][1] - v[0][1]) -
                        (v[1][1] - v[0][1]) * (v[2][0] - v[0][0])) /
                2;
    }
    CHECK(fabs(area - 32) < 1e-9, "area %g", area);
    world_free(&world);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("tools/joints", argc, argv);
    RUN(a_side_is_split_where_others_meet_on_it);
    RUN(what_is_off_the_side_is_left_alone);
    RUN(a_closed_mesh_stays_as_it_is);
    RUN(an_end_that_nothing_goes_on_from_is_no_joint);
    RUN(parts_are_what_the_face_was);
    return TEST_END();
}
