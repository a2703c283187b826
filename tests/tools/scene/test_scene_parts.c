/* test_scene_parts.c - spheres, gloss, normals and skies that go into a blob */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>

#include "lib/program/cli.h"
#include "scene/build/build_materials.h"
#include "scene/build/build_sky.h"
#include "scene/world/reflectance.h"
#include "tools/scene/scene_worlds.h"
#include "support/ql_double.h"

/* ---- scenes made here ---- */

/* Look at a point from a distance, along -z. */
static void aim(world_t *world, const double at[3], double distance)
{
    for (int k = 0; k < 3; k++) {
        world->camera.look[k] = at[k];
        world->camera.eye[k] = at[k] + (k == 2 ? distance : 0);
    }
}

static void add_sphere(world_t *world, const double centre[3], double radius)
{
    world_sphere_t *sphere = world_add_sphere(world);

    memcpy(sphere->centre, centre, sizeof sphere->centre);
    sphere->radius = radius;
}

/* ---- spheres ---- */

/* Face f of the grid against the sphere it came from. */
static void check_sphere(
        const grid_t *grid, const world_t *world, const grid_face_t *face)
{
    const world_sphere_t *from = world->spheres + face->source;
    const ql_blob_sphere_t *s = grid->spheres + face->sphere - 1;
    const double unit = soft_double(grid->unit);
    const double r = from->radius / unit * 256;
    uint16_t low[3], high[3];

    grid_box(grid, face, low, high);
    CHECK(s->radius >= 256 && fabs(s->radius - r) <= 1.5 + r * 1e-12,
            "radius %lu, exactly %g", (unsigned long)s->radius, r);
    for (int k = 0; k < 3; k++) {
        const double c =
                (from->centre[k] - soft_double(grid->origin[k])) / unit * 256 +
                8 * 256;
        const uint32_t under = s->centre[k] - s->radius;
        const uint32_t above = s->centre[k] + s->radius;

        CHECK(fabs(s->centre[k] - c) <= 0.5 + 1e-6, "centre %lu, exactly %g",
                (unsigned long)s->centre[k], c);
        CHECK(under >= 8 * 256 && above <= 32759u * 256, "%lu..%lu",
                (unsigned long)under, (unsigned long)above);
        CHECK(low[k] * 256u <= under && under < (low[k] + 1) * 256u &&
                        high[k] * 256u >= above && above + 256 > high[k] * 256u,
                "box %d..%d of %lu..%lu", low[k], high[k], (unsigned long)under,
                (unsigned long)above);
    }
}

TEST(spheres_lie_in_the_grid_and_their_boxes_are_tight)
{
    unsigned long count = 0;

    for (int scene = 0; scene < 40; scene++) {
        static const double origin[3] = {0, 0, 0};
        const double size = pow(10, scene % 10 - 5);
        world_t world;
        model_t model;
        grid_t grid;

        open_world(&world);
        aim(&world, origin, 3 * size);
        for (int i = 0; i < 1 + scene * 5; i++) {
            const double centre[3] = {
                    uniform() * size, uniform() * size, uniform() * size};

            add_sphere(&world, centre, size * pow(uniform() + 1e-3, 4));
        }
        build(&model, &grid, &world);
        check_opens(&model);
        CHECK(grid.sphere_count + grid.tiny_count == world.sphere_count &&
                        model.spheres_count == grid.sphere_count,
                "%lu of %zu spheres", (unsigned long)grid.sphere_count,
                world.sphere_count);
        for (uint32_t f = 0; f < grid.face_count; f++) {
            check_sphere(&grid, &world, grid.faces + f);
        }
        count += grid.sphere_count;
        close_all(&model, &grid, &world);
    }
    NOTE("%lu spheres", count);
}

TEST(a_sphere_that_rounding_pushes_out_of_the_grid_shrinks)
{
    /* a unit is 1; the sphere ends where the box does, and both halves of
     * 1/256 round up */
    static const double corners[3][3] = {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    static const double r = 100 + 1.0 / 512;
    const double centre[3] = {32751 - r, 200, 200};
    world_t world;
    model_t model;
    grid_t grid;

    open_world(&world);
    aim(&world, centre, 1000);
    add_triangle(&world, corners, NULL);
    add_sphere(&world, centre, r);
    build(&model, &grid, &world);
    check_opens(&model);
    CHECK(grid.spheres[0].centre[0] == (32759 - 100) * 256 &&
                    grid.spheres[0].radius == 100 * 256,
            "x %lu, radius %lu", (unsigned long)grid.spheres[0].centre[0],
            (unsigned long)grid.spheres[0].radius);
    close_all(&model, &grid, &world);
}

TEST(a_sphere_alone_fills_the_grid)
{
    static const double centre[3] = {1e6, -3, 0.1};
    world_t world;
    model_t model;
    grid_t grid;

    open_world(&world);
    add_sphere(&world, centre, 1e-3);
    aim(&world, centre, 0.01);
    build(&model, &grid, &world);
    check_opens(&model);
    for (int k = 0; k < 3; k++) {
        CHECK(grid.low[k] <= 9 && grid.high[k] >= 32758, "axis %d: %d..%d", k,
                grid.low[k], grid.high[k]);
    }
    CHECK(model.triangles_count == 1 && model.triangles[0].inv_n == 0 &&
                    model.vertices_count == 0 &&
                    model.header.features ==
                            (QL_FEATURE_NODE16 | QL_FEATURE_SPHERES),
            "features %lx", (unsigned long)model.header.features);
    close_all(&model, &grid, &world);
}

/* ---- lights ---- */

/* Of each light in turn, its probability. */
static double chance(const model_t *model, uint32_t i)
{
    const double end = i + 1 < model->lights_count
                               ? (double)model->lights[i + 1].cum
                               : 0x1p32;

    return (end - model->lights[i].cum) * 0x1p-32;
}

TEST(triangles_spheres_and_sky_are_chosen_by_their_power)
{
    static const double corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 0.5, 0}};
    static const double centre[3] = {0.4, 0.4, 0.6};
    world_t world;
    model_t model;
    grid_t grid;

    for (int order = 0; order < 2; order++) {
        double power[3] = {0.25 * 3, 4 * PI * 0.01 * 1.5, 0}, sum = 0;
        double box[3] = {1, 0.5, 0.7}, wanted[3];

        open_world(&world);
        (void)world_add_material(&world, "lamp", 4);
        world.materials[0].ke[0] = world.materials[0].ke[2] = 1.5;
        world.materials[1].ke[1] = 1.5;
        add_triangle(&world, corners, NULL);
        add_sphere(&world, centre, 0.1);
        world.spheres[0].material = 1;
        if (order == 1) {
            world.sky.colour[0] = 0.5;
            world.sky.colour[1] = 0.25;
            power[2] = PI *
                       (box[0] * box[0] + box[1] * box[1] + box[2] * box[2]) *
                       0.75;
        }
        build(&model, &grid, &world);
        check_opens(&model);
        CHECK(model.lights_count == 2u + (unsigned)order, "%lu lights",
                (unsigned long)model.lights_count);
        for (int i = 0; i < 3; i++) {
            sum += power[i];
        }
        for (uint32_t i = 0; i < model.lights_count; i++) {
            const uint16_t t = model.lights[i].triangle;
            const int which = t == QL_LIGHT_SKY               ? 2
                              : model.triangles[t].inv_n == 0 ? 1
                                                              : 0;

            wanted[which] = power[which] / sum;
            CHECK(fabs(chance(&model, i) / wanted[which] - 1) < 2e-4,
                    "light %d has %.9f, exactly %.9f", which, chance(&model, i),
                    wanted[which]);
            CHECK((which == 2) == (i == 2), "the sky is light %lu",
                    (unsigned long)i);
        }
        close_all(&model, &grid, &world);
    }
}

TEST(a_sky_may_be_all_there_is)
{
    world_t world;
    model_t model;
    grid_t grid;

    open_world(&world);
    world.sky.colour[1] = 3;
    world.two_sided = true;
    build(&model, &grid, &world);
    check_opens(&model);
    CHECK(model.lights_count == 1 && model.lights[0].triangle == QL_LIGHT_SKY &&
                    model.header.features ==
                            (QL_FEATURE_NODE16 | QL_FEATURE_LIGHTS |
                                    QL_FEATURE_SKY),
            "features %lx", (unsigned long)model.header.features);
    CHECK(model.sky->emission[1] == 0xc0000000u &&
                    model.header.radiance_exp == 2,
            "%lx 2^%d", (unsigned long)model.sky->emission[1],
            model.header.radiance_exp);
    close_all(&model, &grid, &world);
}

/* ---- gloss ---- */

static void check_gloss(const world_material_t *m)
{
    ql_blob_gloss_t gloss;
    uint32_t kd[3];
    double most = 0, scale, s = 0, d = 0;
    const bool beyond = build_materials_round(kd, &gloss, m);

    for (int k = 0; k < 3; k++) {
        most = fmax(most, m->kd[k] + m->ks[k]);
    }
    /* what only rounding takes above 1 is not scaled */
    scale = most * 0x1p31 >= 0x1p31 + 0.5 ? 1 / most : 1;
    for (int k = 0; k < 3; k++) {
        CHECK((uint64_t)kd[k] + gloss.specular[k] <= (uint64_t)1 << 31,
                "Kd %08lx and Ks %08lx", (unsigned long)kd[k],
                (unsigned long)gloss.specular[k]);
        CHECK(fabs(kd[k] - m->kd[k] * scale * 0x1p31) <= 0.5 + 1e-6 &&
                        fabs(gloss.specular[k] - m->ks[k] * scale * 0x1p31) <=
                                1.5 + 1e-6,
                "Kd %08lx and Ks %08lx of %.12g and %.12g, scale %.12g",
                (unsigned long)kd[k], (unsigned long)gloss.specular[k],
                m->kd[k], m->ks[k], scale);
        s += gloss.specular[k];
        d += kd[k];
    }
    CHECK(beyond == (s > 0), "beyond diffuse with %g", s);
    if (s > 0) {
        CHECK(fabs(gloss.chance - s / (s + d) * 0x1p31) <= 1 + 1e-6,
                "chance %08lx of %.12g", (unsigned long)gloss.chance,
                s / (s + d));
        CHECK((gloss.chance == 0x80000000u) == (d == 0) && gloss.chance > 0,
                "chance %08lx", (unsigned long)gloss.chance);
    }
}

TEST(kd_and_ks_never_exceed_1_and_keep_their_ratio)
{
    world_material_t m;
    unsigned long scaled = 0;

    memset(&m, 0, sizeof m);
    m.kind = QL_GLOSS_PHONG;
    for (int i = 0; i < 200000; i++) {
        for (int k = 0; k < 3; k++) {
            m.kd[k] = i % 4 == 0 ? (double)(next() % 11) / 10 : uniform();
            m.ks[k] = i % 4 == 0 ? (double)(next() % 11) / 10
                      : i % 4 == 1
                              ? 1 - m.kd[k] + (i % 8 == 1 ? 0.4 * 0x1p-31 : 0)
                      : i % 4 == 2 ? uniform() * pow(2, (int)(next() % 40) - 35)
                                   : uniform();
        }
        scaled += reflectance_is_excess(&m);
        check_gloss(&m);
    }
    CHECK(scaled > 50000 && scaled < 180000, "%lu scaled", scaled);
    NOTE("200000 materials, %lu scaled", scaled);
}

/* ---- lamps ---- */

/* Area of light i's surface in the world's units. */
static double area_on_grid(const model_t *model, const grid_t *grid,
        const bvh_t *bvh, uint32_t triangle)
{
    const grid_face_t *face = grid->faces + bvh->order[triangle];
    const double unit = soft_double(grid->unit);
    int64_t n[3];

    if (face->sphere != 0) {
        const double r = model->spheres[face->sphere - 1].radius / 256.0 * unit;

        return 4 * PI * r * r;
    }
    grid_normal(grid, face, n);
    return sqrt((double)n[0] * (double)n[0] + (double)n[1] * (double)n[1] +
                   (double)n[2] * (double)n[2]) /
           2 * unit * unit;
}

static double area_as_written(const world_t *world, const grid_face_t *face)
{
    double p[3][3], a[3], b[3], sum = 0;

    if (face->sphere != 0) {
        const double r = world->spheres[face->source].radius;

        return 4 * PI * r * r;
    }
    for (int i = 0; i < 3; i++) {
        const uint32_t v = world->faces[face->source].vertex[i];

        memcpy(p[i], world->vertices[v], sizeof p[i]);
    }
    for (int k = 0; k < 3; k++) {
        a[k] = p[1][k] - p[0][k];
        b[k] = p[2][k] - p[0][k];
    }
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;

        sum += pow(a[i] * b[j] - a[j] * b[i], 2);
    }
    return sqrt(sum) / 2;
}

/* Triangles and spheres of 1/10,000 of the scene, which the grid makes up to a
 * third larger or smaller: emission times area is what was written. */
TEST(small_lamps_keep_their_power)
{
    enum { LAMPS = 400 };
    static const double floor[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 1}};
    double worst = 0, without = 0;
    world_t world;
    model_t model;
    grid_t grid;
    bvh_t bvh;

    open_world(&world);
    (void)world_add_material(&world, "lamp", 4);
    for (int k = 0; k < 3; k++) {
        world.materials[1].ke[k] = 7.5 - k;
    }
    add_triangle(&world, floor, NULL);
    for (int i = 0; i < LAMPS; i++) {
        double p[3][3];

        for (int k = 0; k < 3; k++) {
            p[0][k] = 0.1 + 0.8 * uniform();
            p[1][k] = p[0][k] + (k == i % 3 ? 1e-4 : 2e-5 * uniform());
            p[2][k] = p[0][k] + (k == (i + 1) % 3 ? 1e-4 : 2e-5 * uniform());
        }
        if (i % 4 == 0) {
            add_sphere(&world, p[0], 5e-5 * (1 + uniform()));
            world.spheres[world.sphere_count - 1].material = 1;
        } else {
            add_triangle(&world, (const double(*)[3])p, NULL);
            world.faces[world.face_count - 1].material = 1;
        }
    }
    build_with(&model, &grid, &world, &bvh);
    CHECK(model.lights_count == LAMPS, "%lu lights",
            (unsigned long)model.lights_count);
    for (uint32_t i = 0; i < model.lights_count; i++) {
        const uint32_t t = model.lights[i].triangle;
        const grid_face_t *face = grid.faces + bvh.order[t];
        const ql_blob_material_t *m =
                model.materials + (model.triangles[t].material & 0x3fffu);
        const double ratio = area_on_grid(&model, &grid, &bvh, t) /
                             area_as_written(&world, face);

        without = fmax(without, fabs(ratio - 1));
        for (int k = 0; k < 3; k++) {
            const double ke =
                    ldexp(m->emission[k], model.header.radiance_exp - 32);
            const double off = fabs(ke * ratio / (7.5 - k) - 1);

            CHECK(off <= 0x1p-9, "light %lu, channel %d: %g of %g",
                    (unsigned long)i, k, ke * ratio, 7.5 - k);
            worst = fmax(worst, off);
        }
    }
    CHECK(without > 0.2, "without a gain the worst is %g off", without);
    NOTE("%d lamps, worst %.4f; on the grid %.2f", LAMPS, worst, without);
    bvh_free(&bvh);
    close_all(&model, &grid, &world);
}

/* ---- maps ---- */

static void open_map(world_t *world, uint32_t width, uint32_t height)
{
    open_world(world);
    world->sky.width = width;
    world->sky.height = height;
    world->sky.map = cli_alloc((size_t)3 * width * height, sizeof(float));
}

/* A texel's channels are those of the map to half of the last of nine bits. */
static void check_texel(const model_t *model, const float *rgb, uint32_t i)
{
    const uint32_t texel = model->texels[i].rgb9e5, e = texel >> 27;
    const double unit = ldexp(1, model->header.radiance_exp - 32);
    uint32_t most = 0;

    CHECK(e <= 23, "texel %lu has 2^%lu", (unsigned long)i, (unsigned long)e);
    for (unsigned k = 0; k < 3; k++) {
        const uint32_t m = texel >> 9 * k & 511u;

        most = m > most ? m : most;
        CHECK(fabs(ldexp(m, (int)e) - (double)rgb[k] / unit) <=
                        ldexp(0.5, (int)e),
                "texel %lu: %lu 2^%lu of %.9g units", (unsigned long)i,
                (unsigned long)m, (unsigned long)e, (double)rgb[k] / unit);
    }
    /* 511 rounds up to 512 2^(e - 1), so 256 is left */
    CHECK(e == 0 || most >= 256, "texel %lu keeps %lu only", (unsigned long)i,
            (unsigned long)most);
}

TEST(texels_keep_nine_bits)
{
    world_t world;
    model_t model;
    grid_t grid;

    for (int scene = 0; scene < 6; scene++) {
        open_map(&world, 64, 32);
        for (int i = 0; i < 3 * 64 * 32; i++) {
            world.sky.map[i] =
                    (float)(uniform() * pow(2, (int)(next() % 40) - 20));
        }
        /* one just below, at and just above a power of two */
        world.sky.map[5] = (float)(0x1p21 * (1 + (scene - 1) * 0x1p-10));
        world.materials[0].ke[0] = scene == 4 ? 1e9 : 0;
        build(&model, &grid, &world);
        check_opens(&model);
        for (uint32_t i = 0; i < model.texels_count; i++) {
            /* the blob's columns run the other way */
            const uint32_t painted = i / 64 * 64 + 63 - i % 64;

            check_texel(&model, world.sky.map + 3 * painted, i);
        }
        close_all(&model, &grid, &world);
    }
    NOTE("12288 texels");
}

/* Mass of cell i of a row of n words, of 65536. */
static uint32_t mass_of(const uint16_t *row, uint32_t i)
{
    const uint32_t used = row[0];
    const uint32_t from = i == 0 ? 0 : row[i];
    const uint32_t to = i + 1 < used ? row[i + 1] : 65536;

    return i < used ? to - from : 0;
}

/* Sum of channels of texel i. */
static double light_of(const model_t *model, uint32_t i)
{
    const uint32_t t = model->texels[i].rgb9e5;

    return ldexp(
            (t & 511u) + (t >> 9 & 511u) + (t >> 18 & 511u), (int)(t >> 27));
}

TEST(a_map_is_sampled_by_radiance_and_solid_angle)
{
    const uint32_t w = 24, h = 17;
    double rows[17], total = 0, angle = 0;
    world_t world;
    model_t model;
    grid_t grid;

    open_map(&world, w, h);
    for (uint32_t i = 0; i < 3 * w * h; i++) {
        world.sky.map[i] = (float)uniform();
    }
    for (uint32_t i = 0; i < 3 * w; i++) {
        world.sky.map[3 * w * 4 + i] = 0; /* a row without light */
    }
    build(&model, &grid, &world);
    check_opens(&model);
    for (uint32_t y = 0; y < h; y++) {
        const double solid = cos(PI * y / h) - cos(PI * (y + 1) / h);

        rows[y] = 0;
        for (uint32_t x = 0; x < w; x++) {
            rows[y] += light_of(&model, y * w + x) * solid;
        }
        total += rows[y];
        angle += solid * w;
    }
    CHECK(fabs(soft_double(build_sky_mean(&model)) / (total / angle) - 1) <
                    1e-12,
            "mean %.15g, exactly %.15g", soft_double(build_sky_mean(&model)),
            total / angle);
    for (uint32_t y = 0; y < h; y++) {
        const uint16_t *row = model.words + h + y * w;

        CHECK(fabs(mass_of(model.words, y) - rows[y] / total * 65536) <= 1,
                "row %lu: %lu of %.3f", (unsigned long)y,
                (unsigned long)mass_of(model.words, y),
                rows[y] / total * 65536);
        for (uint32_t x = 0; x < w && y != 4; x++) {
            const double exact = light_of(&model, y * w + x) *
                                 (cos(PI * y / h) - cos(PI * (y + 1) / h)) /
                                 rows[y] * 65536;

            CHECK(fabs(mass_of(row, x) - exact) <= 1, "texel %lu: %lu of %.3f",
                    (unsigned long)x, (unsigned long)mass_of(row, x), exact);
        }
    }
    CHECK(mass_of(model.words, 4) == 0, "the dark row is entered");
    close_all(&model, &grid, &world);
}

/* ---- normals ---- */

static void add_random(world_t *world, bool with_normals)
{
    double corners[3][3], normals[3][3];

    for (int i = 0; i < 9; i++) {
        corners[i / 3][i % 3] = uniform();
        normals[i / 3][i % 3] = uniform() - 0.5;
    }
    add_triangle(world, (const double(*)[3])corners,
            with_normals ? (const double(*)[3])normals : NULL);
}

/* Corner i of a triangle: entry of the table of vertices. */
static uint32_t corner(const ql_blob_tri_t *tri, int i)
{
    return ((uint32_t)tri->material >> 14 << 16) + tri->vertex[i];
}

static void check_corner(const model_t *model, const ql_blob_tri_t *tri, int i)
{
    const int16_t *n = model->normals[corner(tri, i)].xyz;
    int64_t e[2][3], side = 0;
    double square = 0;

    for (int j = 0; j < 2; j++) {
        for (int k = 0; k < 3; k++) {
            e[j][k] = model->vertices[corner(tri, j + 1)].xyz[k] -
                      model->vertices[corner(tri, 0)].xyz[k];
        }
    }
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;

        side += n[k] * (e[0][a] * e[1][b] - e[0][b] * e[1][a]);
        square += (double)n[k] * n[k];
    }
    CHECK(side > 0, "a normal lies behind its face");
    /* half of the last bit on each axis */
    CHECK(fabs(sqrt(square) - 32767) <= 0.87, "a normal is %.2f long",
            sqrt(square));
}

TEST(normals_are_unit_vectors_on_the_front)
{
    world_t world;
    model_t model;
    grid_t grid;

    open_world(&world);
    for (int i = 0; i < 4000; i++) {
        add_random(&world, true);
    }
    build(&model, &grid, &world);
    check_opens(&model);
    CHECK(model.normals_count == model.vertices_count &&
                    model.normals_count > 0,
            "%lu normals", (unsigned long)model.normals_count);
    for (uint32_t t = 0; t < model.triangles_count; t++) {
        for (int i = 0; i < 3; i++) {
            check_corner(&model, model.triangles + t, i);
        }
    }
    NOTE("%lu corners", 3 * (unsigned long)model.triangles_count);
    close_all(&model, &grid, &world);
}

TEST(normals_move_no_corner)
{
    world_t smooth, flat;
    model_t smooth_model, flat_model;
    grid_t smooth_grid, flat_grid;

    open_world(&smooth);
    for (int i = 0; i < 3000; i++) {
        add_random(&smooth, i % 3 != 0);
        /* share corners: those of three faces before */
        for (int k = 0; k < 2 && i > 3; k++) {
            smooth.faces[i].vertex[k] = smooth.faces[i - 3].vertex[k + 1];
        }
    }
    build(&smooth_model, &smooth_grid, &smooth);
    flat = smooth;
    flat.normal_count = 0;
    flat.faces = cli_alloc(smooth.face_count, sizeof *flat.faces);
    for (size_t f = 0; f < smooth.face_count; f++) {
        memcpy(flat.faces[f].vertex, smooth.faces[f].vertex,
                sizeof flat.faces[f].vertex);
    }
    build(&flat_model, &flat_grid, &flat);
    free(flat.faces);
    check_opens(&smooth_model);
    CHECK(flat_model.normals == NULL &&
                    flat_model.triangles_count == smooth_model.triangles_count,
            "%lu and %lu triangles", (unsigned long)flat_model.triangles_count,
            (unsigned long)smooth_model.triangles_count);
    for (uint32_t t = 0; t < flat_model.triangles_count; t++) {
        const ql_blob_tri_t *a = smooth_model.triangles + t;
        const ql_blob_tri_t *b = flat_model.triangles + t;

        CHECK(a->inv_n == b->inv_n, "triangle %lu", (unsigned long)t);
        for (int i = 0; i < 3; i++) {
            CHECK(memcmp(smooth_model.vertices[corner(a, i)].xyz,
                          flat_model.vertices[corner(b, i)].xyz, 6) == 0,
                    "corner %d of triangle %lu moved", i, (unsigned long)t);
        }
    }
    NOTE("%lu vertices become %lu", (unsigned long)flat_model.vertices_count,
            (unsigned long)smooth_model.vertices_count);
    model_free(&flat_model);
    grid_free(&flat_grid);
    close_all(&smooth_model, &smooth_grid, &smooth);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("tools/scene_parts", argc, argv);
    RUN(spheres_lie_in_the_grid_and_their_boxes_are_tight);
    RUN(a_sphere_that_rounding_pushes_out_of_the_grid_shrinks);
    RUN(a_sphere_alone_fills_the_grid);
    RUN(triangles_spheres_and_sky_are_chosen_by_their_power);
    RUN(a_sky_may_be_all_there_is);
    RUN(kd_and_ks_never_exceed_1_and_keep_their_ratio);
    RUN(small_lamps_keep_their_power);
    RUN(texels_keep_nine_bits);
    RUN(a_map_is_sampled_by_radiance_and_solid_angle);
    RUN(normals_are_unit_vectors_on_the_front);
    RUN(normals_move_no_corner);
    return TEST_END();
}
