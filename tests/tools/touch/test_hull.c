/* test_hull.c - walls apart from the rest: what rays meet stays the same */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "math/vec/ql_vec_unit.h"
#include "scene/touch/hull.h"
#include "tools/scene/scene_worlds.h"
#include "trace/ql_bvh.h"
#include "trace/ql_hull.h"
#include "trace/ql_tri.h"

static grid_t grid;
static bvh_t bvh;
static hull_t hull;
static uint8_t *blob;
static ql_scene_t scene;

/* A grid unit as positions have it. */
#define ONE (1 << QL_POS_BITS)

static int32_t random_in(int32_t low, int32_t high)
{
    return low + (int32_t)(next() % (uint64_t)((int64_t)high - low + 1));
}

static ql_vec3_t vec(int32_t x, int32_t y, int32_t z)
{
    const ql_vec3_t v = {x, y, z};

    return v;
}

/* ---- Rooms --------------------------------------------------------------- */

static void add_quad(world_t *world, double p[4][3])
{
    double second[3][3];

    memcpy(second[0], p[0], sizeof second[0]);
    memcpy(second[1], p[2], 2 * sizeof second[1]);
    add_triangle(world, (const double(*)[3])p, NULL);
    add_triangle(world, (const double(*)[3])second, NULL);
}

/* Sides of a box that face its inside, those of a mask, turned about y and then
 * about x. */
static void add_box(world_t *world, const double middle[3], double half,
        unsigned sides, double turn)
{
    const double c = cos(turn), s = sin(turn);

    for (unsigned k = 0; k < 6; k++) {
        const unsigned axis = k / 2, x = (axis + 1) % 3, y = (axis + 2) % 3;
        const double side = k % 2 ? half : -half;
        double p[4][3];

        for (unsigned i = 0; i < 4; i++) {
            const bool right = (i == 1 || i == 2) != (k % 2 != 0);
            double q[3], z;

            q[axis] = side;
            q[x] = right ? half : -half;
            q[y] = i >= 2 ? half : -half;
            z = c * q[2] - s * q[0];
            p[i][0] = middle[0] + c * q[0] + s * q[2];
            p[i][1] = middle[1] + c * q[1] - s * z;
            p[i][2] = middle[2] + s * q[1] + c * z;
        }
        if (sides >> k & 1) {
            add_quad(world, p);
        }
    }
}

static void add_ball(world_t *world, double y, double radius)
{
    world_sphere_t *sphere = world_add_sphere(world);

    sphere->centre[1] = y;
    sphere->radius = radius;
}

/* Room number i of many: with some sides missing, turned or not, with a block
 * that stands on the floor or floats, a ball, loose triangles. */
static void open_room(world_t *world, unsigned i)
{
    static const double middle[3] = {0, 0, 0};
    const double turn = i % 3 == 0 ? 0 : 0.17 * i;
    const double block[3] = {0.4, i % 2 ? -0.6 : -0.699, 0.2};

    open_world(world);
    add_box(world, middle, 1, i % 4 == 0 ? 63 : 63u & ~(1u << i % 6), turn);
    add_box(world, block, 0.3, 63, i % 3 == 0 ? 0.4 : turn);
    if (i % 4 == 1) {
        add_ball(world, 0.3, 0.25);
        add_ball(world, -0.1, i % 8 == 1 ? 0.1 : 0.95); /* through the floor */
    }
    for (unsigned k = 0; k < i % 5; k++) {
        double p[3][3];

        for (int j = 0; j < 9; j++) {
            p[j / 3][j % 3] = uniform() - 0.5;
        }
        add_triangle(world, (const double(*)[3])p, NULL);
    }
}

/* Compile a world with the hull that is found, or with a part of it changed. */
static void compile(world_t *world, void (*change)(hull_t *))
{
    static const bvh_cost_t cost = {100, 80};
    bvh_apart_t apart;
    model_t model;
    size_t size;

    grid_round(&grid, world);
    smooth_corners(&grid, world);
    hull_find(&hull, &grid);
    if (change != NULL) {
        change(&hull);
    }
    apart = hull_apart(&hull);
    bvh_build_apart(&bvh, &grid, &apart, 4, &cost, true);
    compile_model(&model, world, &grid, &bvh, &hull, 16);
    blob = write_blob(&model, &size);
    model_free(&model);
    CHECK(ql_blob_open(&scene, blob, size) == QL_OK, "the core refuses it");
}

static void forget(world_t *world)
{
    free(blob);
    bvh_free(&bvh);
    hull_free(&hull);
    grid_free(&grid);
    world_free(world);
}

/* ---- What is found ------------------------------------------------------- */

/* How far a vertex is in front of a face, times |n|. */
static int64_t height(const grid_face_t *face, const uint16_t *vertex)
{
    int64_t n[3], sum = 0;

    grid_normal(&grid, face, n);
    for (int k = 0; k < 3; k++) {
        sum += n[k] * ((int64_t)vertex[k] - grid.vertices[face->vertex[0]][k]);
    }
    return sum;
}

static bool has_all_in_front(const grid_face_t *face)
{
    int64_t n[3];

    for (uint32_t v = 0; v < grid.vertex_count; v++) {
        if (height(face, grid.vertices[v]) < 0) {
            return false;
        }
    }
    grid_normal(&grid, face, n);
    for (uint32_t s = 0; s < grid.sphere_count; s++) {
        const ql_blob_sphere_t *ball = grid.spheres + s;
        double far = 0;

        for (int k = 0; k < 3; k++) {
            far += (double)n[k] * (ball->centre[k] / 256.0 -
                                          grid.vertices[face->vertex[0]][k]);
        }
        if (far / sqrt((double)(n[0] * n[0] + n[1] * n[1] + n[2] * n[2])) <
                ball->radius / 256.0) {
            return false;
        }
    }
    return true;
}

TEST(the_hull_is_every_face_that_has_all_in_front)
{
    unsigned found = 0, slanted = 0;

    for (unsigned i = 0; i < 24; i++) {
        world_t world;

        open_room(&world, i);
        compile(&world, NULL);
        for (uint32_t f = 0; f < grid.face_count; f++) {
            const grid_face_t *face = grid.faces + f;
            const bool is = hull.part != NULL && hull.part[f] != 0;

            CHECK(is == (face->sphere == 0 && has_all_in_front(face)),
                    "room %u, face %u: %d", i, f, is);
            found += is;
        }
        for (uint32_t s = 0; s < hull.side_count; s++) {
            const int16_t *n = hull.sides[s].n;

            slanted += (n[0] != 0) + (n[1] != 0) + (n[2] != 0) > 1;
        }
        forget(&world);
    }
    CHECK(found > 100 && slanted > 20, "%u faces, %u slanted sides", found,
            slanted);
    NOTE("%u faces, %u slanted sides", found, slanted);
}

TEST(a_wall_with_a_picture_on_it_is_of_no_hull)
{
    static const double middle[3] = {0, 0, 0};
    double picture[4][3] = {
            {-0.3, -0.3, -1}, {0.3, -0.3, -1}, {0.3, 0.3, -1}, {-0.3, 0.3, -1}};
    world_t world;

    open_world(&world);
    add_box(&world, middle, 1, 63, 0);
    add_quad(&world, picture);
    compile(&world, NULL);
    CHECK(hull.side_count == 5, "%u sides", hull.side_count);
    for (uint32_t f = 0; f < grid.face_count; f++) {
        /* the sides of z are the last ones of the box */
        const bool is = f < 8 || f == 10 || f == 11;

        CHECK((hull.part[f] != 0) == is, "face %u", f);
    }
    forget(&world);
}

TEST(what_has_too_many_sides_or_nothing_else_has_no_hull)
{
    static const double middle[3] = {0, 0, 0};
    world_t world;

    open_world(&world);
    add_box(&world, middle, 1, 63, 0);
    compile(&world, NULL);
    CHECK(scene.hull == NULL, "nothing but walls");
    forget(&world);
    open_world(&world);
    for (int i = 0; i < 2 * (HULL_SIDES_MAX + 1); i++) {
        const double a = 0.37 + 3.1415926535 / (HULL_SIDES_MAX + 1) * i;
        const double b = a + 3.1415926535 / (HULL_SIDES_MAX + 1);
        double p[4][3] = {{cos(a), -1, sin(a)}, {cos(a), 1, sin(a)},
                {cos(b), 1, sin(b)}, {cos(b), -1, sin(b)}};

        add_quad(&world, p);
    }
    add_box(&world, middle, 0.1, 63, 0.3);
    compile(&world, NULL);
    CHECK(scene.hull == NULL, "%u sides", hull.side_count);
    forget(&world);
}

/* ---- What rays meet ------------------------------------------------------ */

/* One position of many: on a wall or next to it, in the room, anywhere. */
static ql_vec3_t some_position(long i)
{
    const uint16_t *a = grid.vertices[random_in(0, (int)grid.vertex_count - 1)];
    const uint16_t *b = grid.vertices[random_in(0, (int)grid.vertex_count - 1)];
    const int32_t t = i % 2 ? random_in(0, 256) : 256 * random_in(0, 1);
    ql_vec3_t p = vec(a[0] * ONE + (b[0] - a[0]) * t / 256 * ONE,
            a[1] * ONE + (b[1] - a[1]) * t / 256 * ONE,
            a[2] * ONE + (b[2] - a[2]) * t / 256 * ONE);

    if (i % 5 >= 3) {
        return vec(random_in(0, QL_GRID_MAX * ONE),
                random_in(0, QL_GRID_MAX * ONE),
                random_in(0, QL_GRID_MAX * ONE));
    }
    p.x += random_in(-2, 2);
    p.y += random_in(-2, 2);
    p.z += random_in(-2, 2);
    return p;
}

/* Is a segment blocked? Triangle by triangle. */
static bool is_blocked(const ql_ray_t *ray, bool closed)
{
    for (uint32_t i = 0; i < grid.face_count; i++) {
        const ql_blob_tri_t *tri = scene.triangles + i;
        const ql_blob_sphere_t *ball = ql_scene_sphere(&scene, tri);
        ql_scene_t one = scene;
        uint64_t det, t;

        if (ball != NULL) { /* a tree that is one leaf, without a hull */
            one.root_meta = 4;
            one.root_link = (uint16_t)i;
            one.hull = NULL;
            if (closed ? ql_bvh_touches(&one, ray, (uint16_t)QL_TRI_MAX)
                       : ql_bvh_occluded(&one, ray)) {
                return true;
            }
        } else if (ql_tri_hit(&scene, tri, ray, &det, &t) != 0 &&
                   t < det + closed) {
            return true;
        }
    }
    return false;
}

typedef struct {
    unsigned long rays, inside, wrong;
} tried_t;

static void try_segments(tried_t *tried)
{
    for (long i = 0; i < 1500; i++) {
        const ql_vec3_t from = some_position(i), to = some_position(i / 7);
        const ql_ray_t ray = {from, ql_vec_sub(to, from)};
        const bool closed = i % 3 == 0;
        const bool got =
                closed ? ql_bvh_touches(&scene, &ray, (uint16_t)QL_TRI_MAX)
                       : ql_bvh_occluded(&scene, &ray);

        tried->rays++;
        tried->inside += ql_hull_has(&scene, &ray, true);
        tried->wrong += got != is_blocked(&ray, closed);
    }
}

/* The nearest hit, triangle by triangle: those of the hull from their front
 * last, the others as their parameters are rounded. */
static bool find_nearest(const ql_ray_t *ray, ql_hit_t *hit)
{
    bool any = false, last = false;

    for (uint32_t i = 0; i < grid.face_count; i++) {
        const bool wall = hull.part != NULL && hull.part[bvh.order[i]] != 0;
        ql_scene_t one = scene;
        ql_hit_t found;

        one.root_meta = 4;
        one.root_link = (uint16_t)i;
        one.hull = NULL;
        if (ql_bvh_closest_hit(&one, ray, &found)) {
            const bool is_last = wall && found.front;

            if (!any || is_last < last ||
                    (is_last == last && !is_last && found.t < hit->t)) {
                *hit = found;
                last = is_last;
            }
            any = true;
        }
    }
    return any;
}

static void try_rays(tried_t *tried)
{
    for (long i = 0; i < 1500; i++) {
        ql_ray_t ray = {some_position(i), {0, 0, 0}};
        ql_hit_t got, wanted;
        bool found;

        ray.direction =
                ql_vec_to_dir(ql_vec_sub(some_position(i / 3), ray.origin));
        if ((ray.direction.x | ray.direction.y | ray.direction.z) == 0) {
            continue;
        }
        found = ql_bvh_closest_hit(&scene, &ray, &got);
        tried->rays++;
        tried->inside += ql_hull_has(&scene, &ray, false);
        tried->wrong += found != find_nearest(&ray, &wanted) ||
                        (found && (got.tri_idx != wanted.tri_idx ||
                                          got.front != wanted.front ||
                                          got.t != wanted.t));
    }
}

/* Try something in every room; one in `least` at least is inside the hull. */
static void try_rooms(void (*try)(tried_t *), unsigned long least)
{
    tried_t tried = {0, 0, 0};

    for (unsigned i = 0; i < 24; i++) {
        world_t world;

        open_room(&world, i);
        compile(&world, NULL);
        try(&tried);
        forget(&world);
    }
    CHECK(tried.wrong == 0, "%lu of %lu wrong", tried.wrong, tried.rays);
    CHECK(tried.inside > tried.rays / least, "%lu inside", tried.inside);
    NOTE("%lu tried, %lu inside", tried.rays, tried.inside);
}

TEST(segments_are_blocked_by_what_blocks_them_one_by_one)
{
    try_rooms(try_segments, 20);
}

TEST(rays_meet_the_nearest_one_by_one)
{
    try_rooms(try_rays, 10);
}

/* A fault to plant: a face is taken although something is behind it. */
static void take_another(hull_t *h)
{
    for (uint32_t f = 0; f < grid.face_count && h->part != NULL; f++) {
        if (h->part[f] == 0 && grid.faces[f].sphere == 0) {
            h->part[f] = 1;
            h->box.first--;
            return;
        }
    }
}

TEST(a_face_with_something_behind_it_is_seen_to_be_wrong)
{
    tried_t segments = {0, 0, 0}, rays = {0, 0, 0};

    for (unsigned i = 0; i < 4; i++) {
        world_t world;

        open_room(&world, 3 * i);
        compile(&world, take_another);
        try_segments(&segments);
        try_rays(&rays);
        forget(&world);
    }
    CHECK(segments.wrong > 10 && rays.wrong > 10, "%lu and %lu wrong",
            segments.wrong, rays.wrong);
    NOTE("%lu and %lu wrong", segments.wrong, rays.wrong);
}

TEST(sides_lead_to_nodes_and_triangles_there_are)
{
    for (int i = 0; i < 5; i++) {
        static const bvh_cost_t cost = {100, 80};
        bvh_apart_t apart;
        ql_status_t status;
        world_t world;
        model_t model;
        size_t size;

        open_room(&world, 0);
        grid_round(&grid, &world);
        smooth_corners(&grid, &world);
        hull_find(&hull, &grid);
        apart = hull_apart(&hull);
        bvh_build_apart(&bvh, &grid, &apart, 4, &cost, true);
        compile_model(&model, &world, &grid, &bvh, &hull, 16);
        CHECK(hull.side_count > 3, "%u sides", hull.side_count);
        if (i == 1) {
            model.sides->node = (uint16_t)(2 * bvh.pair_count);
        } else if (i == 2) {
            model.sides->triangle = (uint16_t)grid.face_count;
        } else if (i == 3) {
            model.header.root_meta = 4;
        } else if (i == 4) {
            model.sides->triangle = (uint16_t)(grid.face_count - 1);
        }
        blob = write_blob(&model, &size);
        status = ql_blob_open(&scene, blob, size);
        CHECK(status == (i % 4 == 0 ? QL_OK : QL_ERR_RANGE), "%d: %d", i,
                (int)status);
        model_free(&model);
        forget(&world);
    }
}

int main(int argc, char **argv)
{
    TEST_BEGIN("tools/touch/test_hull", argc, argv);
    RUN(the_hull_is_every_face_that_has_all_in_front);
    RUN(a_wall_with_a_picture_on_it_is_of_no_hull);
    RUN(what_has_too_many_sides_or_nothing_else_has_no_hull);
    RUN(segments_are_blocked_by_what_blocks_them_one_by_one);
    RUN(rays_meet_the_nearest_one_by_one);
    RUN(a_face_with_something_behind_it_is_seen_to_be_wrong);
    RUN(sides_lead_to_nodes_and_triangles_there_are);
    return TEST_END();
}
