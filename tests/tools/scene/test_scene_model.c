/* test_scene_model.c - numbers that qlux-scene puts into a blob */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>

#include "lib/math/build_cdf.h"
#include "lib/program/cli.h"
#include "scene/build/build_camera.h"
#include "tools/scene/scene_worlds.h"
#include "support/ql_double.h"

/* ---- distributions ---- */

static void check_shares(const u128_t *weights, uint32_t count)
{
    uint64_t *shares = cli_alloc(count, sizeof *shares);
    uint64_t sum = 0;
    double total = 0;

    cdf_shares(shares, weights, count);
    for (uint32_t i = 0; i < count; i++) {
        total += (double)weights[i].high * 0x1p64 + (double)weights[i].low;
    }
    for (uint32_t i = 0; i < count; i++) {
        const double exact =
                ((double)weights[i].high * 0x1p64 + (double)weights[i].low) /
                total * 0x1p32;
        const double slack = exact > 0x1p16 ? count : 1.001;

        CHECK(shares[i] >= 1, "share %u of %u is 0", i, count);
        CHECK(fabs((double)shares[i] - exact) <= slack + exact * 1e-14,
                "share %u of %u is %.0f, exactly %.3f", i, count,
                (double)shares[i], exact);
        sum += shares[i];
    }
    CHECK(sum == (uint64_t)1 << 32, "%u shares sum to 2^32 + %lld", count,
            (long long)(sum - ((uint64_t)1 << 32)));
    free(shares);
}

TEST(shares_sum_to_one_and_none_is_zero)
{
    static const uint32_t counts[] = {1, 2, 3, 7, 1000, 65535};

    for (int c = 0; c < 6; c++) {
        u128_t *weights = cli_alloc(counts[c], sizeof *weights);

        for (int shape = 0; shape < 5; shape++) {
            for (uint32_t i = 0; i < counts[c]; i++) {
                const u128_t random = {next() >> 32, next()};
                const u128_t shapes[] = {{0, 1}, random, {0, 1 + next() % 3},
                        {i == counts[c] / 2 ? (uint64_t)1 << 40 : 0, 1},
                        {0, i + 1}};

                weights[i] = shapes[shape];
            }
            weights[0].low |= 1;
            check_shares(weights, counts[c]);
        }
        free(weights);
    }
    NOTE("30 distributions");
}

TEST(no_weight_is_too_small_to_be_chosen)
{
    const u128_t weights[2] = {{0, 1}, {(uint64_t)1 << 40, 0}};
    uint64_t shares[2];

    cdf_shares(shares, weights, 2);
    CHECK(shares[0] == 1 && shares[1] == 0xffffffffu, "%lu and %lu",
            (unsigned long)shares[0], (unsigned long)shares[1]);
}

TEST(equal_weights_share_to_within_one)
{
    u128_t weights[7];
    uint64_t shares[7];

    for (int i = 0; i < 7; i++) {
        weights[i].high = 0;
        weights[i].low = 12345;
    }
    cdf_shares(shares, weights, 7);
    for (int i = 0; i < 7; i++) {
        /* 2^32 = 7 * 613566756 + 4: the first four get one more */
        CHECK(shares[i] == 613566756u + (i < 4), "share %d is %lu", i,
                (unsigned long)shares[i]);
    }
}

TEST(weights_are_one_over_two_pi_p)
{
    for (int i = 0; i < 100000; i++) {
        const uint64_t share =
                i < 33 ? (uint64_t)1 << i : (next() >> 32 >> next() % 32) + 1;
        uint32_t m;
        int16_t e;
        double wanted, got;

        cdf_weight(share, &m, &e);
        got = ldexp(m, e);
        wanted = 0x1p32 / (2 * PI * (double)share);
        CHECK(m >> 31 == 1, "share %lu: top bit of %lx", (unsigned long)share,
                (unsigned long)m);
        CHECK(fabs(got / wanted - 1) <= 0x1p-32, "share %lu: %.12g not %.12g",
                (unsigned long)share, got, wanted);
    }
    NOTE("100000 inputs");
}

/* ---- scenes made here ---- */

/* A triangle whose corner i is a random point of the unit cube to a power. */
static void add_random(world_t *world, double power)
{
    double corners[3][3];

    for (int i = 0; i < 9; i++) {
        corners[i / 3][i % 3] = pow(uniform(), power);
    }
    add_triangle(world, (const double(*)[3])corners, NULL);
}

/* ---- triangles ---- */

static void check_inverse(const model_t *model, uint32_t t)
{
    const ql_blob_tri_t *tri = model->triangles + t;
    int64_t p[3][3], n[3];
    double length, got;

    for (int i = 0; i < 9; i++) {
        p[i / 3][i % 3] =
                model->vertices[((uint32_t)tri->material >> 14 << 16) +
                                tri->vertex[i / 3]]
                        .xyz[i % 3];
    }
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;

        n[k] = (p[1][a] - p[0][a]) * (p[2][b] - p[0][b]) -
               (p[1][b] - p[0][b]) * (p[2][a] - p[0][a]);
    }
    length = sqrt((double)(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]));
    got = ldexp(tri->inv_n & ~31u, 1 - 32 - (int)(tri->inv_n & 31u));
    CHECK(tri->inv_n >> 31 == 1, "inv_n %lx", (unsigned long)tri->inv_n);
    /* 27 bits, the top one set: half of the last is 2^-27 of the least */
    CHECK(fabs(got * length - 1) <= 0x1p-27 * 1.0001, "|n| %.9g: 1/%.9g",
            length, 1 / got);
}

TEST(inv_n_is_rounded_to_nearest)
{
    world_t world;
    model_t model;
    grid_t grid;

    open_world(&world);
    for (int i = 0; i < 20000; i++) {
        add_random(&world, 1 + i % 8);
    }
    build(&model, &grid, &world);
    check_opens(&model);
    for (uint32_t t = 0; t < model.triangles_count; t++) {
        check_inverse(&model, t);
    }
    NOTE("%lu triangles", (unsigned long)model.triangles_count);
    close_all(&model, &grid, &world);
}

TEST(the_largest_and_the_smallest_triangle_have_an_inv_n)
{
    static const double corners[3][3][3] = {
            {{0, 0, 0}, {32751, 0, 0}, {0, 32751, 0}},
            {{0, 0, 0}, {32751, 0, 32751}, {0, 32751, 32751}},
            {{5, 5, 5}, {6, 5, 5}, {5, 6, 5}}};
    world_t world;
    model_t model;
    grid_t grid;

    open_world(&world);
    for (int i = 0; i < 3; i++) {
        add_triangle(&world, corners[i], NULL);
    }
    build(&model, &grid, &world);
    check_opens(&model);
    CHECK(model.triangles_count == 3, "%lu",
            (unsigned long)model.triangles_count);
    for (uint32_t t = 0; t < model.triangles_count; t++) {
        check_inverse(&model, t);
    }
    close_all(&model, &grid, &world);
}

/* ---- pages ---- */

/* One that is near few others, so that a mesh of many is done soon. */
static void add_small(world_t *world)
{
    const double at[3] = {uniform(), uniform(), uniform()};
    double corners[3][3];

    for (int i = 0; i < 9; i++) {
        corners[i / 3][i % 3] = at[i % 3] + 0.01 * uniform();
    }
    add_triangle(world, (const double(*)[3])corners, NULL);
}

static void check_pages(const world_t *world, uint32_t vertices_least)
{
    model_t model;
    grid_t grid;

    build(&model, &grid, world);
    check_opens(&model);
    CHECK((model.header.features & QL_FEATURE_PAGES) != 0, "features %lx",
            (unsigned long)model.header.features);
    CHECK(model.triangles_count > 65500, "%lu triangles",
            (unsigned long)model.triangles_count);
    CHECK(model.vertices_count > vertices_least, "%lu vertices",
            (unsigned long)model.vertices_count);
    for (uint32_t t = 0; t < model.triangles_count; t++) {
        for (int i = 0; i < 3; i++) {
            CHECK(model.triangles[t].vertex[i] != 65535, "triangle %lu",
                    (unsigned long)t);
        }
        check_inverse(&model, t); /* the right corners, by their normal */
    }
    NOTE("%lu vertices", (unsigned long)model.vertices_count);
    model_free(&model);
    grid_free(&grid);
}

TEST(more_than_65535_vertices_use_pages)
{
    world_t world;

    open_world(&world);
    for (int i = 0; i < 65535; i++) {
        add_small(&world);
    }
    check_pages(&world, 3 * 65000);
    /* two corners that many share: every page needs them again */
    for (uint32_t f = 2; f < 65535; f += 256) {
        world.faces[f].vertex[0] = world.faces[f % 2].vertex[0];
    }
    check_pages(&world, 2 * 65000);
    world_free(&world);
}

/* ---- the grid ---- */

/* The unit cube's corners and a point inside, scaled and moved. */
static void check_grid(double scale, double move)
{
    static const double corners[2][3][3] = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}},
            {{0, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
    world_t world;
    grid_t grid;

    open_world(&world);
    for (int t = 0; t < 2; t++) {
        double p[3][3];

        for (int i = 0; i < 9; i++) {
            p[i / 3][i % 3] = corners[t][i / 3][i % 3] * scale + move;
        }
        add_triangle(&world, (const double(*)[3])p, NULL);
    }
    grid_round(&grid, &world);
    for (int i = 0; i < 18; i++) {
        const uint16_t got =
                grid.vertices[grid.faces[i / 9].vertex[i / 3 % 3]][i % 3];
        const double wanted = 8 + corners[i / 9][i / 3 % 3][i % 3] * 32751;

        CHECK(fabs(got - wanted) <= 0.5 + 1e-6, "scale %g, move %g: %d not %g",
                scale, move, got, wanted);
    }
    CHECK(fabs(soft_double(grid.unit) * 32751 / scale - 1) < 1e-6, "unit %g",
            soft_double(grid.unit));
    grid_free(&grid);
    world_free(&world);
}

TEST(scenes_of_any_size_anywhere_fill_the_grid)
{
    check_grid(1e-6, 0);
    check_grid(1e9, 0);
    check_grid(1, 1e9);
    check_grid(1e9, -1e12);
    check_grid(1e-6, 100);
    check_grid(1e-200, 0);
    check_grid(1e200, 1e201);
}

/* ---- the camera ---- */

static double wide(const uint32_t words[2])
{
    const double high = words[1] < 0x80000000u ? (double)words[1]
                                               : (double)words[1] - 0x1p32;

    return high + words[0] * 0x1p-32;
}

static double narrow(uint32_t word)
{
    return word < 0x80000000u ? (double)word : (double)word - 0x1p32;
}

/* The ray of picture point (x, y) passes through the point of the scene that a
 * pinhole camera sees there, at distance t along the view. */
static void check_ray(const ql_blob_camera_t *c, const grid_t *grid,
        const world_camera_t *w, const double axes[3][3], double x, double y)
{
    const double slope = tan(w->fov * (PI / 360));
    double o[3], d[3], v[3], s = 0, dv = 0, error = 0, length = 0;

    for (int k = 0; k < 3; k++) {
        const double unit = soft_double(grid->unit);

        o[k] = wide(c->at[QL_CAMERA_BASE][k]) +
               x * wide(c->at[QL_CAMERA_RIGHT][k]) +
               y * wide(c->at[QL_CAMERA_UP][k]);
        d[k] = narrow(c->towards[QL_CAMERA_BASE][k]) +
               x * narrow(c->towards[QL_CAMERA_RIGHT][k]) +
               y * narrow(c->towards[QL_CAMERA_UP][k]);
        CHECK(fabs(narrow(c->towards[QL_CAMERA_BASE][k])) +
                                4 * fabs(narrow(
                                            c->towards[QL_CAMERA_RIGHT][k])) +
                                fabs(narrow(c->towards[QL_CAMERA_UP][k])) <
                        0x1p30,
                "axis %d", k);
        v[k] = axes[2][k] + slope * (x * axes[0][k] + y * axes[1][k]);
        /* the ray's origin, seen from the eye, in grid units */
        o[k] -= (w->eye[k] - soft_double(grid->origin[k])) / unit + GRID_LOW;
        s += o[k] * v[k];
        dv += d[k] * v[k];
        length += v[k] * v[k];
    }
    for (int k = 0; k < 3; k++) {
        const double off_origin = o[k] - s / length * v[k];
        const double off_direction = d[k] / dv - v[k] / length;

        error += off_origin * off_origin;
        CHECK(fabs(off_direction) < 1e-8, "direction is off by %g",
                off_direction);
    }
    CHECK(dv > 0, "the ray points backward: %g", dv);
    CHECK(sqrt(error) < 1e-4, "origin is %g units off the ray", sqrt(error));
}

static void check_view(double ex, double ey, double ez, double fov, bool far)
{
    static const double corners[2][3][3] = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}},
            {{0, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
    const world_camera_t camera = {
            {ex, ey, ez}, {0.5, 0.5, 0.5}, {0, 1, 0}, fov};
    ql_blob_camera_t c;
    ql_blob_lens_t lens;
    double axes[3][3], length = 0, right = 0;
    world_t world;
    grid_t grid;

    open_world(&world);
    world.camera = camera;
    add_triangle(&world, corners[0], NULL);
    add_triangle(&world, corners[1], NULL);
    grid_round(&grid, &world);
    build_camera(&c, &lens, &world, &grid);
    for (int k = 0; k < 3; k++) {
        axes[2][k] = camera.look[k] - camera.eye[k];
        length += axes[2][k] * axes[2][k];
    }
    /* right = forward x up with up = y: (-fz, 0, fx) */
    axes[0][0] = -axes[2][2];
    axes[0][1] = 0;
    axes[0][2] = axes[2][0];
    right = sqrt(axes[0][0] * axes[0][0] + axes[0][2] * axes[0][2]);
    for (int k = 0; k < 3; k++) {
        axes[2][k] /= sqrt(length);
        axes[0][k] /= right;
    }
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;

        axes[1][k] = axes[0][a] * axes[2][b] - axes[0][b] * axes[2][a];
    }
    for (int i = 0; i < 6; i++) {
        CHECK(lens.d[i / 3][i % 3] == 0 && wide(lens.p[i / 3][i % 3]) == 0,
                "a pinhole has a lens");
    }
    CHECK(far == ((c.at[QL_CAMERA_RIGHT][0][0] | c.at[QL_CAMERA_RIGHT][1][0] |
                          c.at[QL_CAMERA_RIGHT][2][0]) != 0),
            "origins %s a plane", far ? "should lie on" : "should not lie on");
    for (int i = 0; i < 9; i++) {
        check_ray(&c, &grid, &camera, (const double(*)[3])axes, i % 3 - 1,
                i / 3 - 1);
    }
    grid_free(&grid);
    world_free(&world);
}

TEST(camera_rays_are_those_of_a_pinhole)
{
    check_view(0.5, 0.5, 3, 40, true);
    check_view(0.3, 0.4, 0.1, 60, false); /* inside */
    check_view(4, 3, -5, 20, true);
    check_view(0.2, -7, 0.1, 90, true);
    check_view(1000, 2000, 1500, 0.05, true);
    check_view(-1, 0.5, 0.5, 179, true);
    NOTE("54 rays");
}

/* ---- the lens ---- */

/* A camera at the origin that looks along -z, so that right is x and up is y:
 * the ray of picture point (x, y) and lens point (a, b) must pass through that
 * lens point and through the point in focus of the pinhole's ray. */
static void check_lens_ray(const ql_blob_camera_t *c,
        const ql_blob_lens_t *lens, const world_t *world, const grid_t *grid,
        const double s[4])
{
    const double slope = tan(world->camera.fov * (PI / 360));
    const double unit = soft_double(grid->unit), f = world->lens.focus;
    const double v[3] = {s[0] * slope, s[1] * slope, -1};
    const double at[3] = {
            s[2] * world->lens.radius, s[3] * world->lens.radius, 0};
    double o[3], d[3], way[3], length = 0, along = 0, off = 0, dw = 0, dd = 0;

    for (int k = 0; k < 3; k++) {
        o[k] = wide(c->at[QL_CAMERA_BASE][k]) +
               s[0] * wide(c->at[QL_CAMERA_RIGHT][k]) +
               s[1] * wide(c->at[QL_CAMERA_UP][k]) +
               s[2] * wide(lens->p[0][k]) + s[3] * wide(lens->p[1][k]);
        d[k] = narrow(c->towards[QL_CAMERA_BASE][k]) +
               s[0] * narrow(c->towards[QL_CAMERA_RIGHT][k]) +
               s[1] * narrow(c->towards[QL_CAMERA_UP][k]) +
               s[2] * narrow(lens->d[0][k]) + s[3] * narrow(lens->d[1][k]);
        /* seen from the lens point, in grid units */
        o[k] -= (at[k] - soft_double(grid->origin[k])) / unit + GRID_LOW;
        way[k] = (f * v[k] - at[k]) / unit;
        length += way[k] * way[k];
        along += o[k] * way[k];
        dw += d[k] * way[k];
        dd += d[k] * d[k];
    }
    for (int k = 0; k < 3; k++) {
        const double rest = o[k] - along / length * way[k];

        off += rest * rest;
    }
    CHECK(sqrt(off) < 1e-4, "origin is %g units off the ray", sqrt(off));
    CHECK(dw > 0 && 1 - dw / sqrt(dd * length) < 1e-15,
            "direction is off by %g", sqrt(2 - 2 * dw / sqrt(dd * length)));
}

/* In every component the format's bounds hold for the whole lens. */
static void check_lens_bounds(
        const ql_blob_camera_t *c, const ql_blob_lens_t *lens)
{
    for (int k = 0; k < 3; k++) {
        const double d = fabs(narrow(c->towards[QL_CAMERA_BASE][k])) +
                         4 * fabs(narrow(c->towards[QL_CAMERA_RIGHT][k])) +
                         fabs(narrow(c->towards[QL_CAMERA_UP][k])) +
                         fabs(narrow(lens->d[0][k])) +
                         fabs(narrow(lens->d[1][k]));
        const double p = fabs(wide(c->at[QL_CAMERA_BASE][k])) +
                         4 * fabs(wide(c->at[QL_CAMERA_RIGHT][k])) +
                         fabs(wide(c->at[QL_CAMERA_UP][k])) +
                         fabs(wide(lens->p[0][k])) + fabs(wide(lens->p[1][k]));

        CHECK(d < 0x1p30, "axis %d: direction reaches %g", k, d);
        CHECK(p < 0x1p30, "axis %d: origin reaches %g", k, p);
    }
}

/* A box from z = -near to -near - 2, seen through a lens. */
static void check_lens(double near, double fov, double radius, double focus)
{
    static const double samples[][4] = {{0, 0, 0, 0}, {0, 0, 1, 0},
            {0, 0, 0, -1}, {1, -1, 0.6, 0.8}, {-4, 1, -0.7, 0.7},
            {0.3, 0.9, 0.1, -0.2}};
    const double corners[3][3] = {
            {-1, -1, -near}, {1, -1, -near - 2}, {0, 1, -near - 1}};
    const world_camera_t camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, fov};
    ql_blob_camera_t c;
    ql_blob_lens_t lens;
    world_t world;
    grid_t grid;

    open_world(&world);
    world.camera = camera;
    world.lens.radius = radius;
    world.lens.focus = focus;
    add_triangle(&world, corners, NULL);
    grid_round(&grid, &world);
    build_camera(&c, &lens, &world, &grid);
    CHECK((near > 0.01) == (wide(c.at[QL_CAMERA_RIGHT][0]) != 0), "near %g",
            near);
    check_lens_bounds(&c, &lens);
    for (int i = 0; i < 6; i++) {
        check_lens_ray(&c, &lens, &world, &grid, samples[i]);
    }
    grid_free(&grid);
    world_free(&world);
}

TEST(rays_of_a_lens_meet_where_it_is_in_focus)
{
    check_lens(3, 40, 0.1, 4);
    check_lens(3, 40, 0.1, 3); /* in focus before the box */
    check_lens(3, 40, 2, 0.5); /* ... and far before it */
    check_lens(3, 10, 1e-3, 1e6);
    check_lens(-1, 60, 0.05, 1); /* from inside */
    check_lens(-1, 60, 5, 1);    /* wider than what it sees */
    check_lens(500, 0.3, 10, 501);
    check_lens(3, 150, 20, 0.1); /* 200 times its focus */
    NOTE("48 rays");
}

/* ---- empty and dark scenes ---- */

TEST(empty_scenes_open)
{
    world_t world;
    model_t model;
    grid_t grid;

    open_world(&world);
    build(&model, &grid, &world);
    check_opens(&model);
    CHECK(model.header.root_meta == 3 && model.triangles_count == 0 &&
                    model.lights_count == 0,
            "root %d", model.header.root_meta);
    CHECK((model.header.features & QL_FEATURE_LIGHTS) == 0, "lights");
    close_all(&model, &grid, &world);
}

TEST(faint_emission_does_not_vanish)
{
    static const double corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    static const double other[3][3] = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
    world_t world;
    model_t model;
    grid_t grid;

    open_world(&world);
    (void)world_add_material(&world, "bright", 6);
    world.materials[0].ke[1] = 1e-15;
    world.materials[1].ke[0] = 1024;
    add_triangle(&world, corners, NULL);
    add_triangle(&world, other, NULL);
    world.faces[1].material = 1;
    build(&model, &grid, &world);
    check_opens(&model);
    CHECK(model.header.radiance_exp == 11, "2^%d", model.header.radiance_exp);
    CHECK(model.materials[0].emission[1] == 1 &&
                    model.materials[1].emission[0] == 0x80000000u,
            "emission %lx, %lx", (unsigned long)model.materials[0].emission[1],
            (unsigned long)model.materials[1].emission[0]);
    CHECK(model.lights_count == 2, "%lu lights",
            (unsigned long)model.lights_count);
    close_all(&model, &grid, &world);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("tools/scene_model", argc, argv);
    RUN(shares_sum_to_one_and_none_is_zero);
    RUN(no_weight_is_too_small_to_be_chosen);
    RUN(equal_weights_share_to_within_one);
    RUN(weights_are_one_over_two_pi_p);
    RUN(inv_n_is_rounded_to_nearest);
    RUN(the_largest_and_the_smallest_triangle_have_an_inv_n);
    RUN(more_than_65535_vertices_use_pages);
    RUN(scenes_of_any_size_anywhere_fill_the_grid);
    RUN(camera_rays_are_those_of_a_pinhole);
    RUN(rays_of_a_lens_meet_where_it_is_in_focus);
    RUN(empty_scenes_open);
    RUN(faint_emission_does_not_vanish);
    return TEST_END();
}
