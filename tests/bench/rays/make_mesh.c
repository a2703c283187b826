/* make_mesh.c - write a scene of 20,492 triangles: a bumpy sphere in a room */
/* SPDX-License-Identifier: MIT */

/* An icosahedron's 20 faces, each divided into 32 x 32 triangles, pushed out to
 * a sphere with bumps; five walls and a square light as in the Cornell box.
 * Only additions, multiplications, divisions and square roots, in an order that
 * is the same for points shared by faces: the same files everywhere, and a
 * closed surface. */

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DIVISIONS  32
#define EXIT_USAGE 1
#define EXIT_FILE  3

static const char room[] =
        "mtllib mesh.mtl\n"
        "v 0 0 0\nv 10 0 0\nv 10 0 10\nv 0 0 10\n"
        "v 0 10 0\nv 10 10 0\nv 10 10 10\nv 0 10 10\n"
        "v 3.5 9.95 3.5\nv 6.5 9.95 3.5\nv 6.5 9.95 6.5\nv 3.5 9.95 6.5\n"
        "usemtl white\n"
        "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\n"
        "usemtl red\nf 1 5 8 4\n"
        "usemtl green\nf 2 3 7 6\n"
        "usemtl light\nf 9 10 11 12\n"
        "usemtl white\n";
#define ROOM_VERTICES 12

static const char materials[] = "newmtl white\nKd 0.75 0.75 0.75\n"
                                "newmtl red\nKd 0.6 0.06 0.05\n"
                                "newmtl green\nKd 0.15 0.5 0.1\n"
                                "newmtl light\nKd 0.7 0.7 0.7\nKe 15 12 8\n";

static const char scene[] = "mesh mesh.obj\n"
                            "camera eye 5 5 24  look 5 5 0  up 0 1 0  fov 39\n"
                            "image 256 256\n";

/* Icosahedron: rectangles of 1 by the golden ratio; faces seen from outside
 * counter-clockwise. */
#define GOLDEN 1.618033988749895
static const double corners[12][3] = {{-1, GOLDEN, 0}, {1, GOLDEN, 0},
        {-1, -GOLDEN, 0}, {1, -GOLDEN, 0}, {0, -1, GOLDEN}, {0, 1, GOLDEN},
        {0, -1, -GOLDEN}, {0, 1, -GOLDEN}, {GOLDEN, 0, -1}, {GOLDEN, 0, 1},
        {-GOLDEN, 0, -1}, {-GOLDEN, 0, 1}};
static const int faces[20][3] = {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10},
        {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
        {3, 9, 4}, {3, 4, 2}, {3, 2, 6}, {3, 6, 8}, {3, 8, 9}, {4, 9, 5},
        {2, 4, 11}, {6, 2, 10}, {8, 6, 7}, {9, 8, 1}};

/* Chebyshev's polynomial: n half waves on [-1, 1]. */
static double chebyshev(int n, double x)
{
    double a = 1, b = x;

    for (int i = 1; i < n; i++) {
        const double c = 2 * x * b - a;

        a = b;
        b = c;
    }
    return b;
}

static void write_vertex(FILE *file, const int face[3], const int weight[3])
{
    double p[3], length = 0, radius;

    for (int k = 0; k < 3; k++) {
        /* On an edge a weight is 0 and the sum of the other two commutes. */
        p[k] = weight[0] * corners[face[0]][k] +
               weight[1] * corners[face[1]][k] +
               weight[2] * corners[face[2]][k];
        length += p[k] * p[k];
    }
    length = sqrt(length);
    radius = 2.8 + 0.35 * chebyshev(9, p[0] / length) *
                           chebyshev(7, p[1] / length) *
                           chebyshev(8, p[2] / length);
    fprintf(file, "v %.4f %.4f %.4f\n", 5 + radius * p[0] / length,
            4 + radius * p[1] / length, 5 + radius * p[2] / length);
}

/* Number of vertex j of row i of a face whose vertices begin at base. */
static int index_of(int base, int i, int j)
{
    return base + i * (i + 1) / 2 + j;
}

static void write_face(FILE *file, const int face[3], int base)
{
    for (int i = 0; i <= DIVISIONS; i++) {
        for (int j = 0; j <= i; j++) {
            const int weight[3] = {DIVISIONS - i, i - j, j};

            write_vertex(file, face, weight);
        }
    }
    for (int i = 0; i < DIVISIONS; i++) {
        for (int j = 0; j <= i; j++) {
            fprintf(file, "f %d %d %d\n", index_of(base, i, j),
                    index_of(base, i + 1, j), index_of(base, i + 1, j + 1));
            if (j < i) {
                fprintf(file, "f %d %d %d\n", index_of(base, i, j),
                        index_of(base, i + 1, j + 1), index_of(base, i, j + 1));
            }
        }
    }
}

static FILE *create(const char *folder, const char *name)
{
    char path[1024];
    FILE *file = NULL;
    const int size = snprintf(path, sizeof path, "%s/%s", folder, name);

    if (size > 0 && (size_t)size < sizeof path) {
        file = fopen(path, "w");
    }
    if (file == NULL) {
        fprintf(stderr, "make-mesh: cannot write %s/%s\n", folder, name);
        exit(EXIT_FILE);
    }
    return file;
}

static void finish(FILE *file)
{
    const bool failed = ferror(file) != 0;

    if (fclose(file) != 0 || failed) {
        fprintf(stderr, "make-mesh: cannot write\n");
        exit(EXIT_FILE);
    }
}

static void write_text(const char *folder, const char *name, const char *text)
{
    FILE *file = create(folder, name);

    fputs(text, file);
    finish(file);
}

int main(int argc, char **argv)
{
    const bool help = argc == 2 && strcmp(argv[1], "--help") == 0;
    FILE *file;

    if (argc != 2 || help) {
        fprintf(help ? stdout : stderr,
                "usage: make-mesh FOLDER\n"
                "Write mesh.obj, mesh.mtl and mesh.scene, 20,492 triangles.\n"
                "\nExample: build/make-mesh build\n");
        return help ? 0 : EXIT_USAGE;
    }
    file = create(argv[1], "mesh.obj");
    fputs(room, file);
    for (int i = 0; i < 20; i++) {
        write_face(file, faces[i],
                1 + ROOM_VERTICES + i * (DIVISIONS + 1) * (DIVISIONS + 2) / 2);
    }
    finish(file);
    write_text(argv[1], "mesh.mtl", materials);
    write_text(argv[1], "mesh.scene", scene);
    return 0;
}
