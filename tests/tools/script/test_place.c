/* test_place.c - surfaces scaled, turned and moved */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "scene/script/place.h"
#include "scene/script/shape.h"
#include "support/ql_test.h"

static uint64_t state = 7;

/* -1..1 */
static double next(void)
{
    uint64_t z = (state += 0x9e3779b97f4a7c15u);

    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-52 - 1;
}

static place_t random_place(void)
{
    place_t place;

    for (int k = 0; k < 3; k++) {
        place.scale[k] = (0.1 + fabs(next())) * (next() < 0 ? -1 : 1);
        place.turn[k] = 720 * next();
        place.at[k] = 10 * next();
    }
    return place;
}

/* About x, then y, then z, as one writes it with matrices of doubles. */
static void turn(double p[3], const double degrees[3])
{
    const double unit = 3.14159265358979323846 / 180;

    for (int k = 0; k < 3; k++) {
        const double c = cos(degrees[k] * unit), s = sin(degrees[k] * unit);
        double *a = p + (k + 1) % 3, *b = p + (k + 2) % 3;
        const double x = *a, y = *b;

        *a = c * x - s * y;
        *b = s * x + c * y;
    }
}

static void place_all(world_t *world, const place_t *place)
{
    const place_mark_t from = {0, 0, 0};

    CHECK(place_part(world, place, from, place_mark(world)), "is far");
}

TEST(points_are_scaled_then_turned_about_x_y_and_z_then_moved)
{
    double worst = 0;

    for (int i = 0; i < 2000; i++) {
        const place_t place = random_place();
        const double p[3] = {next(), next(), next()};
        double q[3];
        world_t world;

        memset(&world, 0, sizeof world);
        (void)world_add_vertex(&world, p);
        place_all(&world, &place);
        for (int k = 0; k < 3; k++) {
            q[k] = p[k] * place.scale[k];
        }
        turn(q, place.turn);
        for (int k = 0; k < 3; k++) {
            const double off = fabs(world.vertices[0][k] - q[k] - place.at[k]);

            worst = off > worst ? off : worst;
        }
        world_free(&world);
    }
    CHECK(worst < 2e-14, "worst %g", worst);
    NOTE("2000 places, worst %.2g", worst);
}

TEST(quarters_of_a_turn_are_exact)
{
    /* where 1 2 3 goes by each about one axis */
    static const double to[3][4][3] = {
            {{1, 2, 3}, {1, -3, 2}, {1, -2, -3}, {1, 3, -2}},
            {{1, 2, 3}, {3, 2, -1}, {-1, 2, -3}, {-3, 2, 1}},
            {{1, 2, 3}, {-2, 1, 3}, {-1, -2, 3}, {2, -1, 3}}};

    for (int axis = 0; axis < 3; axis++) {
        for (int i = -8; i <= 8; i++) {
            static const double p[3] = {1, 2, 3};
            const double *wanted = to[axis][(i + 8) % 4];
            place_t place = PLACE_NOWHERE;
            world_t world;

            memset(&world, 0, sizeof world);
            (void)world_add_vertex(&world, p);
            place.turn[axis] = 90 * i;
            place_all(&world, &place);
            for (int k = 0; k < 3; k++) {
                const double x = world.vertices[0][k];

                CHECK(!(x < wanted[k]) && !(x > wanted[k]),
                        "%d degrees about %c: %c is %.17g", 90 * i, "xyz"[axis],
                        "xyz"[k], x);
            }
            world_free(&world);
        }
    }
}

/* e1 x e2 */
static void find_normal(const world_t *world, size_t f, double n[3])
{
    const uint32_t *v = world->faces[f].vertex;
    double a[3], b[3];

    for (int k = 0; k < 3; k++) {
        a[k] = world->vertices[v[1]][k] - world->vertices[v[0]][k];
        b[k] = world->vertices[v[2]][k] - world->vertices[v[0]][k];
    }
    for (int k = 0; k < 3; k++) {
        n[k] = a[(k + 1) % 3] * b[(k + 2) % 3] -
               a[(k + 2) % 3] * b[(k + 1) % 3];
    }
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

TEST(boxes_have_their_fronts_outside_however_they_are_placed)
{
    static const double low[3] = {-1, -2, -3}, high[3] = {1, 2, 3};
    int mirrored = 0;

    for (int i = 0; i < 200; i++) {
        const shape_front_t front = i % 2 != 0 ? SHAPE_INSIDE : SHAPE_OUTSIDE;
        const place_t place = random_place();
        world_t world;

        memset(&world, 0, sizeof world);
        shape_box(&world, low, high, front, 0, "box");
        place_all(&world, &place);
        mirrored += place.scale[0] * place.scale[1] * place.scale[2] < 0;
        CHECK(world.face_count == 12, "%zu faces", world.face_count);
        for (size_t f = 0; f < world.face_count; f++) {
            double n[3], out[3];

            find_normal(&world, f, n);
            for (int k = 0; k < 3; k++) {
                out[k] = world.vertices[world.faces[f].vertex[0]][k] -
                         place.at[k];
            }
            CHECK((dot(n, out) > 0) == (front == SHAPE_OUTSIDE),
                    "face %zu of box %d", f, i);
        }
        world_free(&world);
    }
    CHECK(mirrored > 50 && mirrored < 150, "%d mirrored", mirrored);
    NOTE("200 boxes, %d of them mirrored", mirrored);
}

TEST(normals_stay_across_and_in_front)
{
    for (int i = 0; i < 500; i++) {
        const place_t place = random_place();
        world_face_t face = {{0, 1, 2}, 0, {1, 1, 1}, 0, false};
        double n[3];
        world_t world;

        memset(&world, 0, sizeof world);
        for (int v = 0; v < 3; v++) {
            const double p[3] = {next(), next(), next()};

            (void)world_add_vertex(&world, p);
        }
        world_add_face(&world, &face);
        find_normal(&world, 0, n);
        (void)world_add_normal(&world, n);
        place_all(&world, &place);
        find_normal(&world, 0, n);
        CHECK(fabs(dot(n, world.normals[0]) / sqrt(dot(n, n)) - 1) < 1e-9,
                "triangle %d: %g", i,
                dot(n, world.normals[0]) / sqrt(dot(n, n)));
        world_free(&world);
    }
}

TEST(what_is_beyond_all_numbers_is_told)
{
    static const double p[3] = {1e200, 0, 0};
    const place_mark_t from = {0, 0, 0};
    place_t place = PLACE_NOWHERE;
    world_t world;

    memset(&world, 0, sizeof world);
    (void)world_add_vertex(&world, p);
    place.scale[0] = 1e200;
    CHECK(!place_part(&world, &place, from, place_mark(&world)), "not told");
    world_free(&world);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("tools/place", argc, argv);
    RUN(points_are_scaled_then_turned_about_x_y_and_z_then_moved);
    RUN(quarters_of_a_turn_are_exact);
    RUN(boxes_have_their_fronts_outside_however_they_are_placed);
    RUN(normals_stay_across_and_in_front);
    RUN(what_is_beyond_all_numbers_is_told);
    return TEST_END();
}
