/* rooms.c - closed rooms, turned and shrunk, that no light may leave */
/* SPDX-License-Identifier: MIT */

#include "closed/rooms.h"

#include <math.h>
#include <string.h>

#include "scene/ql_blob.h"

enum { WHITE, GLASS };

/* What faces are made of, for those that add them. */
static uint32_t material;

static void add_face(
        world_t *world, const double a[3], const double b[3], const double c[3])
{
    world_face_t face;

    memset(&face, 0, sizeof face);
    face.material = material;
    face.vertex[0] = (uint32_t)world_add_vertex(world, a);
    face.vertex[1] = (uint32_t)world_add_vertex(world, b);
    face.vertex[2] = (uint32_t)world_add_vertex(world, c);
    world_add_face(world, &face);
}

static void add_quad(world_t *world, const double a[3], const double b[3],
        const double c[3], const double d[3])
{
    add_face(world, a, b, c);
    add_face(world, a, c, d);
}

/* A prism of any outline, x and y of each corner, from z = low to high. Both
 * ends are a fan around the first corner. */
static void add_prism(world_t *world, const double *outline, int corners,
        double low, double high)
{
    for (int i = 0; i < corners; i++) {
        const double *p = outline + 2 * i;
        const double *q = outline + 2 * ((i + 1) % corners);
        const double a[3] = {p[0], p[1], low}, b[3] = {q[0], q[1], low};
        const double c[3] = {q[0], q[1], high}, d[3] = {p[0], p[1], high};
        const double e[3] = {outline[0], outline[1], low};
        const double f[3] = {outline[0], outline[1], high};

        add_quad(world, a, b, c, d);
        if (i > 0 && i < corners - 1) {
            add_face(world, e, b, a);
            add_face(world, f, d, c);
        }
    }
}

/* A box whose base is turned about z. */
static void add_box(world_t *world, const double middle[3],
        const double half[3], double degrees)
{
    const double c = cos(degrees * 0.017453292519943295);
    const double s = sin(degrees * 0.017453292519943295);
    double outline[4 * 2];

    for (int i = 0; i < 4; i++) {
        const double x = i == 1 || i == 2 ? half[0] : -half[0];
        const double y = i >= 2 ? half[1] : -half[1];

        outline[2 * i] = middle[0] + c * x - s * y;
        outline[2 * i + 1] = middle[1] + s * x + c * y;
    }
    add_prism(world, outline, 4, middle[2] - half[2], middle[2] + half[2]);
}

static void add_cube(world_t *world)
{
    static const double middle[3] = {0, 0, 0}, half[3] = {1, 1, 1};

    add_box(world, middle, half, 0);
}

static void add_tetrahedron(world_t *world)
{
    static const double p[4][3] = {
            {1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};

    for (int i = 0; i < 4; i++) {
        add_face(world, p[i], p[(i + 1) % 4], p[(i + 2) % 4]);
    }
}

/* The sides that meet at the far end do so at 3 degrees. */
static void add_wedge(world_t *world)
{
    static const double outline[] = {0.3, -0.0340, 0.3, 0.0340, -0.9984, 0};

    add_prism(world, outline, 3, -0.5, 0.5);
}

/* A part of a ball's surface, cut into four until it is small. */
static void add_patch(world_t *world, const double a[3], const double b[3],
        const double c[3], int cuts)
{
    double middle[3][3];

    if (cuts == 0) {
        add_face(world, a, b, c);
        return;
    }
    for (int i = 0; i < 3; i++) {
        const double *p = i == 0 ? a : i == 1 ? b : c;
        const double *q = i == 0 ? b : i == 1 ? c : a;
        double size = 0;

        for (int k = 0; k < 3; k++) {
            middle[i][k] = p[k] + q[k];
            size += middle[i][k] * middle[i][k];
        }
        for (int k = 0; k < 3; k++) {
            middle[i][k] /= sqrt(size);
        }
    }
    add_patch(world, a, middle[0], middle[2], cuts - 1);
    add_patch(world, b, middle[1], middle[0], cuts - 1);
    add_patch(world, c, middle[2], middle[1], cuts - 1);
    add_patch(world, middle[0], middle[1], middle[2], cuts - 1);
}

/* An icosahedron, each face cut so often. */
static void add_ball(world_t *world, int cuts)
{
    static const int faces[20][3] = {{0, 11, 5}, {0, 5, 1}, {0, 1, 7},
            {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2},
            {10, 7, 6}, {7, 1, 8}, {3, 9, 4}, {3, 4, 2}, {3, 2, 6}, {3, 6, 8},
            {3, 8, 9}, {4, 9, 5}, {2, 4, 11}, {6, 2, 10}, {8, 6, 7}, {9, 8, 1}};
    const double g = (1 + sqrt(5.0)) / 2, size = sqrt(1 + g * g);
    double p[12][3];

    for (int i = 0; i < 12; i++) {
        const int k = i / 4; /* (+-1, +-g, 0), (0, +-1, +-g), (+-g, 0, +-1) */

        p[i][k] = (i % 2 ? 1 : -1) / size;
        p[i][(k + 1) % 3] = (i % 4 / 2 ? -g : g) / size;
        p[i][(k + 2) % 3] = 0;
    }
    for (int i = 0; i < 20; i++) {
        add_patch(world, p[faces[i][0]], p[faces[i][1]], p[faces[i][2]], cuts);
    }
}

static void add_ball_320(world_t *world)
{
    add_ball(world, 2);
}

static void add_ball_1280(world_t *world)
{
    add_ball(world, 3);
}

/* A cube of which four sides are cut where the two others are whole. */
static void add_joints(world_t *world)
{
    static const double outline[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    static const double at[6] = {-1, -0.62, -0.3, 0.1, 0.55, 1};

    for (int i = 0; i < 4; i++) {
        const double *p = outline[i], *q = outline[(i + 1) % 4];

        for (int j = 0; j < 5; j++) { /* strips across the side */
            const double s = (at[j] + 1) / 2, t = (at[j + 1] + 1) / 2;
            const double a[3] = {
                    p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1]), -1};
            const double b[3] = {
                    p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), -1};
            const double c[3] = {b[0], b[1], 1}, d[3] = {a[0], a[1], 1};

            add_quad(world, a, b, c, d);
        }
    }
    for (int i = 0; i < 2; i++) {
        const double z = i == 0 ? -1 : 1;
        const double a[3] = {-1, -1, z}, b[3] = {1, -1, z}, c[3] = {1, 1, z},
                     d[3] = {-1, 1, z};

        add_quad(world, a, b, c, d);
    }
}

static void add_corner_room(world_t *world)
{
    static const double outline[] = {
            0.3, 0.3, -1, 0.3, -1, -0.6, 1, -0.6, 1, 1, 0.3, 1};

    add_prism(world, outline, 6, -0.5, 0.5);
}

/* Six boards that pass through each other. */
static void add_slabs(world_t *world)
{
    for (int i = 0; i < 6; i++) {
        double middle[3] = {0, 0, 0}, half[3] = {1.3, 1.3, 1.3};

        middle[i / 2] = i % 2 ? 1 : -1;
        half[i / 2] = 0.08;
        add_box(world, middle, half, 0);
    }
}

/* A block on the floor, turned, and one that passes through a wall. */
static void add_blocks(world_t *world)
{
    static const double block[3] = {0.35, 0.4, -0.7},
                        size[3] = {0.3, 0.25, 0.3};
    static const double beam[3] = {-1, -0.2, 0.3},
                        long_one[3] = {0.6, 0.2, 0.2};

    add_cube(world);
    add_box(world, block, size, 20);
    add_box(world, beam, long_one, 7);
}

static void add_glass(world_t *world)
{
    static const double block[3] = {0.35, 0.4, -0.7},
                        size[3] = {0.3, 0.25, 0.3};
    static const double beam[3] = {-1, -0.2, 0.3},
                        long_one[3] = {0.6, 0.2, 0.2};

    add_cube(world);
    material = GLASS;
    add_box(world, block, size, 20);
    add_box(world, beam, long_one, 7);
}

static void add_sphere(world_t *world, double x, double y, double z,
        double radius, uint32_t of)
{
    world_sphere_t *sphere = world_add_sphere(world);

    sphere->centre[0] = x;
    sphere->centre[1] = y;
    sphere->centre[2] = z;
    sphere->radius = radius;
    sphere->material = of;
}

/* Spheres on the floor, through walls, through each other. */
static void add_spheres(world_t *world)
{
    add_cube(world);
    add_sphere(world, 0.5, 0.45, -0.7, 0.3, GLASS);
    add_sphere(world, 0.6, 0.1, -0.75, 0.25, WHITE);
    add_sphere(world, -0.9, -0.3, 0.2, 0.4, GLASS);
    add_sphere(world, 0.3, 1, 0.6, 0.3, WHITE);
    add_sphere(world, -0.4, 0.6, -0.98, 0.02, GLASS);
}

const room_t rooms[] = {{"cube", add_cube}, {"tetrahedron", add_tetrahedron},
        {"wedge of 3 degrees", add_wedge}, {"ball of 320 faces", add_ball_320},
        {"ball of 1,280 faces", add_ball_1280},
        {"cube with T-joints", add_joints}, {"L-shaped room", add_corner_room},
        {"slabs", add_slabs}, {"blocks", add_blocks}, {"glass", add_glass},
        {"spheres", add_spheres}};
const unsigned room_count = sizeof rooms / sizeof *rooms;

/* ---- Turned and shrunk ------------------------------------------------- */

/* A rotation by a quaternion whose parts are as good as random. */
static void turn_matrix(double m[3][3], unsigned turn)
{
    double q[4], size = 0;

    for (int i = 0; i < 4; i++) {
        q[i] = turn == 0 ? i == 0
                         : sin(1.0 + turn * (1.37 + 0.61 * i) + 2.1 * i * i);
        size += q[i] * q[i];
    }
    for (int i = 0; i < 4; i++) {
        q[i] /= sqrt(size);
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;

        m[i][i] = 1 - 2 * (q[j + 1] * q[j + 1] + q[k + 1] * q[k + 1]);
        m[i][j] = 2 * (q[i + 1] * q[j + 1] - q[0] * q[k + 1]);
        m[i][k] = 2 * (q[i + 1] * q[k + 1] + q[0] * q[j + 1]);
    }
}

static void turn(double p[3], double m[3][3])
{
    double r[3];

    for (int i = 0; i < 3; i++) {
        r[i] = m[i][0] * p[0] + m[i][1] * p[1] + m[i][2] * p[2];
    }
    memcpy(p, r, sizeof r);
}

/* Two faces far outside, which make the room a small part of the grid. */
static void add_far_faces(world_t *world, double reach)
{
    for (int i = 0; i < 2; i++) {
        const double at = i == 0 ? -reach : reach, by = i == 0 ? 0.1 : -0.1;
        const double a[3] = {at, at, at}, b[3] = {at + by, at, at};
        const double c[3] = {at, at + by, at};

        add_face(world, a, b, c);
    }
}

void room_open(
        world_t *world, const room_t *room, unsigned turn_index, double part)
{
    static const world_camera_t camera = {
            {0.02, 0.01, 0.03}, {0.3, 1, -0.2}, {0, 0, 1}, 150};
    world_material_t *m;
    double matrix[3][3];

    memset(world, 0, sizeof *world);
    world->path = "room";
    world->camera = camera;
    world->width = world->height = 1;
    for (int k = 0; k < 3; k++) {
        world->sky.colour[k] = 1;
    }
    (void)world_add_material(world, "white", 5);
    (void)world_add_material(world, "glass", 5);
    m = world->materials;
    for (int k = 0; k < 3; k++) {
        m[WHITE].kd[k] = 1;
        m[GLASS].kd[k] = 0;
        m[GLASS].filter[k] = 1;
    }
    m[GLASS].kind = QL_GLOSS_GLASS;
    m[GLASS].ni = 1.5;
    material = WHITE;
    room->build(world);
    turn_matrix(matrix, turn_index);
    for (size_t i = 0; i < world->vertex_count; i++) {
        turn(world->vertices[i], matrix);
    }
    for (size_t i = 0; i < world->sphere_count; i++) {
        turn(world->spheres[i].centre, matrix);
    }
    turn(world->camera.eye, matrix);
    turn(world->camera.look, matrix);
    turn(world->camera.up, matrix);
    if (part > 1) {
        material = WHITE;
        add_far_faces(world, 1.4 * part);
    }
}
