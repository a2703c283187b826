/* test_crease.c - normals of faces that have none: groups, angles, creases */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "scene/crease/crease.h"
#include "support/ql_test.h"
#include "tools/scene/scene_worlds.h"

#define PI 3.14159265358979323846

static world_t world;

/* ---- Meshes ------------------------------------------------------------- */

static void begin(double smooth)
{
    open_world(&world);
    world.smooth = smooth;
    world_add_mesh(&world, "mesh");
}

static void add_face(
        const double a[3], const double b[3], const double c[3], uint32_t group)
{
    world_face_t face = {{0, 0, 0}, 0, {0, 0, 0}, group, false};

    /* vertices of their own: places are what counts */
    face.vertex[0] = (uint32_t)world_add_vertex(&world, a);
    face.vertex[1] = (uint32_t)world_add_vertex(&world, b);
    face.vertex[2] = (uint32_t)world_add_vertex(&world, c);
    world_add_face(&world, &face);
}

/* A quad as two triangles, cut from the corner that a bit of cut chooses. */
static void add_quad(double corners[4][3], unsigned cut, uint32_t group)
{
    const unsigned k = cut & 1u;

    add_face(corners[k], corners[k + 1], corners[k + 2], group);
    add_face(corners[k], corners[k + 2], corners[(k + 3) % 4], group);
}

/* A box, each side cut one way or the other. */
static void add_box(const double size[3], unsigned cuts, uint32_t group)
{
    for (int side = 0; side < 6; side++) {
        const int z = side / 2, x = (z + 1) % 3, y = (z + 2) % 3;
        static const int round[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
        double corners[4][3];

        for (int i = 0; i < 4; i++) {
            const int turn = side % 2 == 0 ? 1 : -1; /* front outwards */

            corners[i][x] = turn * round[i][0] * size[x];
            corners[i][y] = round[i][1] * size[y];
            corners[i][z] = turn * size[z];
        }
        add_quad(corners, cuts >> side, group);
    }
}

/* ---- What they got ------------------------------------------------------ */

static const double *normal_of(size_t face, int corner)
{
    static const double none[3] = {0, 0, 0};
    const uint32_t n = world.faces[face].normal[corner];

    return n > 0 ? world.normals[n - 1] : none;
}

static double cosine_to(size_t face, int corner, const double to[3])
{
    const double *n = normal_of(face, corner);
    const double length = sqrt(to[0] * to[0] + to[1] * to[1] + to[2] * to[2]);

    return (n[0] * to[0] + n[1] * to[1] + n[2] * to[2]) / length;
}

/* The smallest cosine between a corner's normal and where it is, seen from the
 * middle. */
static double find_worst(const double middle[3])
{
    double worst = 1;

    for (size_t f = 0; f < world.face_count; f++) {
        for (int i = 0; i < 3; i++) {
            const double *p = world.vertices[world.faces[f].vertex[i]];
            const double to[3] = {
                    p[0] - middle[0], p[1] - middle[1], p[2] - middle[2]};

            worst = fmin(worst, cosine_to(f, i, to));
        }
    }
    return worst;
}

/* The smallest cosine between a corner's normal and its face's. */
static double find_flattest(void)
{
    double worst = 1;

    for (size_t f = 0; f < world.face_count; f++) {
        double a[3], b[3], n[3];

        for (int k = 0; k < 3; k++) {
            const double p = world.vertices[world.faces[f].vertex[0]][k];

            a[k] = world.vertices[world.faces[f].vertex[1]][k] - p;
            b[k] = world.vertices[world.faces[f].vertex[2]][k] - p;
        }
        for (int k = 0; k < 3; k++) {
            const int x = (k + 1) % 3, y = (k + 2) % 3;

            n[k] = a[x] * b[y] - a[y] * b[x];
        }
        for (int i = 0; i < 3; i++) {
            worst = fmin(worst, cosine_to(f, i, n));
        }
    }
    return worst;
}

/* ---- Claims ------------------------------------------------------------- */

TEST(a_cube_is_smooth_at_90_degrees_however_it_is_cut)
{
    static const double size[3] = {3, 3, 3}, middle[3] = {0, 0, 0};

    for (unsigned cuts = 0; cuts < 64; cuts++) {
        begin(90);
        add_box(size, cuts, 0);
        crease_world(&world);
        CHECK(find_worst(middle) > 1 - 1e-12, "%u: %g", cuts,
                find_worst(middle));
        CHECK(world.normal_count == 8, "%zu", world.normal_count);
        world_free(&world);
        begin(89.9);
        add_box(size, cuts, 0);
        crease_world(&world);
        CHECK(find_flattest() > 1 - 1e-12, "%u: %g", cuts, find_flattest());
        world_free(&world);
    }
}

TEST(sides_of_a_box_count_by_their_area_however_they_are_cut)
{
    /* of a box of 2 a x 2 b x 2 c: (b c, c a, a b) */
    static const double size[3] = {1, 2, 5};
    double worst = 1;

    for (unsigned cuts = 0; cuts < 64; cuts++) {
        begin(90);
        add_box(size, cuts, 0);
        crease_world(&world);
        for (size_t f = 0; f < world.face_count; f++) {
            for (int i = 0; i < 3; i++) {
                const double *p = world.vertices[world.faces[f].vertex[i]];
                const double to[3] = {copysign(10, p[0]), copysign(5, p[1]),
                        copysign(2, p[2])};

                worst = fmin(worst, cosine_to(f, i, to));
            }
        }
        world_free(&world);
    }
    CHECK(worst > 1 - 1e-12, "%g", 1 - worst);
}

/* Twice the area of a triangle at the origin times its angle there, along its
 * normal, added to a sum. */
static void add_weight(double sum[3], const double a[3], const double b[3])
{
    double aa = 0, bb = 0, ab = 0, angle;

    for (int k = 0; k < 3; k++) {
        aa += a[k] * a[k];
        bb += b[k] * b[k];
        ab += a[k] * b[k];
    }
    angle = acos(ab / sqrt(aa * bb));
    for (int k = 0; k < 3; k++) {
        const int x = (k + 1) % 3, y = (k + 2) % 3;

        sum[k] += angle * (a[x] * b[y] - a[y] * b[x]);
    }
}

TEST(faces_around_a_vertex_count_by_area_and_angle)
{
    double worst = 1;

    for (int round = 0; round < 100; round++) {
        static const double origin[3] = {0, 0, 0};
        const int n = 3 + (int)(next() % 6);
        double rim[9][3], sum[3] = {0, 0, 0};

        begin(179);
        for (int i = 0; i < n; i++) {
            const double angle = 2 * PI * (i + 0.7 * uniform()) / n;
            const double r = pow(2, 6 * uniform());

            rim[i][0] = r * cos(angle);
            rim[i][1] = r * sin(angle);
            rim[i][2] = -4 * uniform();
        }
        for (int i = 0; i < n; i++) {
            add_face(origin, rim[i], rim[(i + 1) % n], 0);
            add_weight(sum, rim[i], rim[(i + 1) % n]);
        }
        crease_world(&world);
        for (int i = 0; i < n; i++) {
            worst = fmin(worst, cosine_to((size_t)i, 0, sum));
        }
        world_free(&world);
    }
    CHECK(worst > 1 - 1e-12, "%g", 1 - worst);
}

/* A bent strip: faces 0 and 1 in one plane, 2 and 3 in another at an angle, all
 * of groups. */
static void begin_strip(double smooth, double degrees, const uint32_t groups[2])
{
    const double c = cos(degrees * PI / 180), s = sin(degrees * PI / 180);
    double first[4][3] = {{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {-1, 1, 0}};
    double second[4][3] = {{0, 0, 0}, {c, 0, -s}, {c, 1, -s}, {0, 1, 0}};

    begin(smooth);
    world.meshes[0].has_groups = groups[0] + groups[1] > 0;
    add_quad(first, 0, groups[0]);
    add_quad(second, 0, groups[1]);
}

static bool is_strip_smooth(void)
{
    const double half[3] = {0, 0, 1};
    bool smooth;

    crease_world(&world);
    /* at the bend; 0 without a normal */
    smooth = cosine_to(0, 1, half) > 0 && cosine_to(0, 1, half) < 0.999;
    world_free(&world);
    return smooth;
}

TEST(angles_decide_where_files_say_nothing)
{
    static const uint32_t none[2] = {0, 0};

    for (int degrees = 10; degrees < 179; degrees += 7) {
        begin_strip(degrees, degrees, none);
        CHECK(is_strip_smooth(), "%d of %d", degrees, degrees);
        begin_strip(degrees - 0.1, degrees, none);
        CHECK(!is_strip_smooth(), "%d - 0.1 of %d", degrees, degrees);
    }
    begin_strip(0, 10, none);
    CHECK(!is_strip_smooth() && world.normal_count == 0, "not asked for");
}

TEST(groups_decide_where_there_are_some)
{
    static const uint32_t same[2] = {3, 3}, other[2] = {3, 4}, one[2] = {0, 4};

    begin_strip(0, 120, same);
    CHECK(is_strip_smooth(), "one group");
    begin_strip(40, 120, same);
    CHECK(is_strip_smooth(), "one group, and an angle");
    begin_strip(40, 10, other);
    CHECK(!is_strip_smooth(), "two groups");
    begin_strip(40, 10, one);
    crease_world(&world);
    CHECK(world.faces[0].normal[1] == 0 && world.faces[2].normal[0] > 0,
            "a group beside none");
    world_free(&world);
}

TEST(normals_of_the_file_stay_as_they_are)
{
    static const uint32_t none[2] = {0, 0}, same[2] = {1, 1};
    static const double up[3] = {0.6, 0, 0.8};

    begin_strip(40, 10, none);
    world.faces[0].normal[0] = (uint32_t)world_add_normal(&world, up) + 1;
    crease_world(&world);
    CHECK(world.normal_count == 1 && world.faces[0].normal[0] == 1 &&
                    world.faces[1].normal[0] == 0,
            "the file speaks");
    world_free(&world);
    begin_strip(0, 10, same);
    world.faces[0].normal[0] = (uint32_t)world_add_normal(&world, up) + 1;
    crease_world(&world);
    CHECK(world.faces[0].normal[0] == 1 && world.faces[0].normal[1] == 0 &&
                    world.faces[1].normal[0] > 1,
            "a face speaks");
    world_free(&world);
}

TEST(meshes_of_both_sides_are_smooth_on_both)
{
    static const double size[3] = {3, 3, 3}, middle[3] = {0, 0, 0};
    size_t outer;

    begin(0);
    world.meshes[0].has_groups = true;
    add_box(size, 37, 1);
    outer = world.face_count;
    for (size_t f = 0; f < outer; f++) {
        double p[3][3];

        for (int i = 0; i < 3; i++) {
            memcpy(p[i], world.vertices[world.faces[f].vertex[2 - i]],
                    sizeof p[i]);
        }
        add_face(p[0], p[1], p[2], 1);
    }
    crease_world(&world);
    CHECK(world.normal_count == 16, "%zu", world.normal_count);
    for (size_t f = outer; f < 2 * outer; f++) {
        for (int i = 0; i < 3; i++) {
            const double *p = world.vertices[world.faces[f].vertex[i]];
            const double in[3] = {
                    middle[0] - p[0], middle[1] - p[1], middle[2] - p[2]};

            CHECK(cosine_to(f, i, in) > 1 - 1e-12, "%zu.%d", f, i);
        }
    }
    world_free(&world);
}

TEST(what_has_no_size_or_too_many_neighbours_stays_flat)
{
    static const double o[3] = {0, 0, 0}, up[3] = {0, 0, 1};
    static const double huge[3] = {1e200, 0, 0}, wide[3] = {0, 1e200, 1};

    begin(60);
    add_face(o, up, up, 0);
    add_face(o, o, o, 0);
    add_face(o, huge, wide, 0);
    for (int i = 0; i < 40; i++) { /* a book of pages around one edge */
        const double angle = 2 * PI * i / 40;
        const double p[3] = {cos(angle), sin(angle), 0};

        add_face(o, i % 2 == 0 ? up : p, i % 2 == 0 ? p : up, 0);
    }
    crease_world(&world);
    CHECK(world.faces[0].normal[0] == 0 && world.faces[1].normal[2] == 0,
            "no area");
    CHECK(fabs(normal_of(2, 1)[2] - 1) < 1e-12, "huge");
    CHECK(find_flattest() > 1 - 1e-12, "pages: %g", find_flattest());
    world_free(&world);
}

/* A roof of twice 10 degrees with a thin triangle of rounding at its top, whose
 * own normal is anything. */
TEST(thin_triangles_make_no_crease)
{
    const double c = cos(10 * PI / 180), s = sin(10 * PI / 180);
    static const double a[3] = {0, 0, 0}, b[3] = {1e-9, 0.5, 5e-9};
    static const double d[3] = {0, 1, 0};
    const double left[3] = {-c, 0.5, -s}, right[3] = {c, 0.5, -s};
    const double up[3] = {0, 0, 1};

    begin(40);
    add_face(left, a, d, 0);
    add_face(a, b, d, 0);
    world.faces[1].goes_on = true;
    add_face(right, b, a, 0);
    add_face(right, d, b, 0);
    world.faces[3].goes_on = true;
    crease_world(&world);
    CHECK(cosine_to(0, 1, up) > 0.995, "at a: %g", cosine_to(0, 1, up));
    CHECK(cosine_to(0, 2, up) > 0.995, "at d: %g", cosine_to(0, 2, up));
    world_free(&world);
}

TEST(a_bent_face_has_no_crease_inside)
{
    static const uint32_t none[2] = {0, 0};

    begin_strip(20, 30, none);
    world.faces[1].goes_on = world.faces[2].goes_on = true;
    world.faces[3].goes_on = true;
    CHECK(is_strip_smooth(), "at the bend");
}

int main(int argc, char **argv)
{
    TEST_BEGIN("tools/crease", argc, argv);
    RUN(a_cube_is_smooth_at_90_degrees_however_it_is_cut);
    RUN(sides_of_a_box_count_by_their_area_however_they_are_cut);
    RUN(faces_around_a_vertex_count_by_area_and_angle);
    RUN(angles_decide_where_files_say_nothing);
    RUN(groups_decide_where_there_are_some);
    RUN(normals_of_the_file_stay_as_they_are);
    RUN(meshes_of_both_sides_are_smooth_on_both);
    RUN(what_has_no_size_or_too_many_neighbours_stays_flat);
    RUN(thin_triangles_make_no_crease);
    RUN(a_bent_face_has_no_crease_inside);
    return TEST_END();
}
