/* crease.c - normals where faces meet, split at creases */
/* SPDX-License-Identifier: MIT */

#include "scene/crease/crease.h"

#include <stdlib.h>

#include "lib/math/soft_vec.h"
#include "lib/program/cli.h"
#include "scene/crease/edges.h"

enum { FACES_MOST = 16, DEGREES_MOST = 179 };

/* The faces of a mesh. */
typedef struct {
    const world_t *world;
    const world_face_t *faces;
    size_t count;
    bool *wanted;       /* those that are to be smooth */
    soft_vec_t *across; /* e1 x e2 of each */
    soft_vec_t *unit;   /* of length 1, of the whole face in the file */
    uint32_t *first;    /* triangle of that */
    uint32_t *leaders;  /* of each corner: one that has the same normal */
    soft_t cosine;      /* of the largest angle between faces */
} mesh_t;

/* ---- which faces ---- */

static bool has_normals(const world_face_t *face)
{
    return face->normal[0] != 0 || face->normal[1] != 0 || face->normal[2] != 0;
}

/* Does a mesh say nothing about what is smooth? */
static bool is_silent(
        const world_mesh_t *mesh, const world_face_t *faces, size_t count)
{
    bool silent = !mesh->has_groups;

    for (size_t f = 0; f < count && silent; f++) {
        silent = !has_normals(faces + f);
    }
    return silent;
}

static soft_t find_cosine(double degrees)
{
    /* of 180 + half of what remains to 90 */
    const soft_t beyond = soft_div(
            soft_sub(soft_from(degrees), soft_int(90, 0)), soft_int(180, 0));

    return beyond.m == 0      ? soft_int(0, 0)
           : !beyond.negative ? soft_negate(soft_sin_pi(beyond))
                              : soft_sin_pi(soft_negate(beyond));
}

/* Find the normals of triangles; those without area are not wanted. */
static void find_across(mesh_t *mesh)
{
    for (size_t f = 0; f < mesh->count; f++) {
        const uint32_t *v = mesh->faces[f].vertex;
        const soft_vec_t p = soft_vec_from(mesh->world->vertices[v[0]]);
        const soft_vec_t n = soft_vec_cross(
                soft_vec_sub(soft_vec_from(mesh->world->vertices[v[1]]), p),
                soft_vec_sub(soft_vec_from(mesh->world->vertices[v[2]]), p));

        mesh->wanted[f] = mesh->wanted[f] && soft_vec_dot(n, n).m != 0;
        mesh->across[f] = n;
    }
}

/* Find the normals of faces, as the file has them: a triangle's own is that of
 * rounding if it is thin, and says nothing if its face is bent. */
static void find_units(mesh_t *mesh)
{
    size_t end;

    for (size_t f = 0; f < mesh->count; f = end) {
        soft_vec_t sum = mesh->across[f];

        for (end = f + 1; end < mesh->count && mesh->faces[end].goes_on;
                end++) {
            sum = soft_vec_add(sum, mesh->across[end]);
        }
        sum = soft_vec_dot(sum, sum).m != 0 ? soft_vec_unit(sum) : sum;
        for (size_t i = f; i < end; i++) {
            mesh->unit[i] = sum;
            mesh->first[i] = (uint32_t)f;
        }
    }
}

/* ---- what belongs together ---- */

static uint32_t find_leader(uint32_t *leaders, uint32_t corner)
{
    while (leaders[corner] != corner) {
        leaders[corner] = leaders[leaders[corner]];
        corner = leaders[corner];
    }
    return corner;
}

static void join(mesh_t *mesh, uint32_t a, uint32_t b)
{
    const uint32_t p = find_leader(mesh->leaders, a);
    const uint32_t q = find_leader(mesh->leaders, b);

    mesh->leaders[p > q ? p : q] = p > q ? q : p;
}

static bool is_crease(const mesh_t *mesh, const edge_t *a, const edge_t *b)
{
    const uint32_t f = a->corners[0] / 3, g = b->corners[0] / 3;

    if (a->forwards == b->forwards) {
        return true;
    }
    return mesh->first[f] != mesh->first[g] &&
           (mesh->faces[f].group != mesh->faces[g].group ||
                   soft_compare(soft_vec_dot(mesh->unit[f], mesh->unit[g]),
                           mesh->cosine) < 0);
}

/* Join the corners of faces that meet at an edge. */
static void join_edge(mesh_t *mesh, const edge_t *edges, size_t count)
{
    for (size_t i = 0; i < count && count <= FACES_MOST; i++) {
        for (size_t k = 0; k < i; k++) {
            if (!is_crease(mesh, edges + i, edges + k)) {
                join(mesh, edges[i].corners[0], edges[k].corners[0]);
                join(mesh, edges[i].corners[1], edges[k].corners[1]);
            }
        }
    }
}

static void join_corners(mesh_t *mesh, const uint32_t *places)
{
    size_t count, end;
    edge_t *edges =
            edges_sort(mesh->faces, mesh->wanted, mesh->count, places, &count);

    for (uint32_t i = 0; i < 3 * mesh->count; i++) {
        mesh->leaders[i] = i;
    }
    for (size_t i = 0; i < count; i = end) {
        for (end = i + 1;
                end < count && edges[end].ends[0] == edges[i].ends[0] &&
                edges[end].ends[1] == edges[i].ends[1];
                end++) {
        }
        join_edge(mesh, edges + i, end - i);
    }
    free(edges);
}

/* ---- sums ---- */

/* The angle between two sides of a face: twice the one whose tangent is
 * |a x b| / (|a| |b| + a b). */
static soft_t find_angle(const mesh_t *mesh, size_t f, int corner)
{
    const world_t *world = mesh->world;
    const uint32_t *v = mesh->faces[f].vertex;
    const soft_vec_t p = soft_vec_from(world->vertices[v[corner]]);
    const soft_vec_t a = soft_vec_sub(
            soft_vec_from(world->vertices[v[(corner + 1) % 3]]), p);
    const soft_vec_t b = soft_vec_sub(
            soft_vec_from(world->vertices[v[(corner + 2) % 3]]), p);
    const soft_t sine =
            soft_sqrt(soft_vec_dot(mesh->across[f], mesh->across[f]));
    const soft_t sizes =
            soft_sqrt(soft_mul(soft_vec_dot(a, a), soft_vec_dot(b, b)));
    const soft_t sum = soft_add(sizes, soft_vec_dot(a, b));

    /* rounded to 0 or less, it is half a turn but for 2^-30 */
    return sum.m == 0 || sum.negative
                   ? soft_pi()
                   : soft_mul(soft_int(2, 0), soft_atan(soft_div(sine, sum)));
}

/* Give each corner of a wanted face the sum of its leader's. */
static void add_normals(mesh_t *mesh, world_t *world, world_face_t *faces)
{
    const soft_t zero = soft_int(0, 0);
    soft_vec_t *sums = cli_alloc(3 * mesh->count, sizeof *sums);
    uint32_t *indices = cli_alloc(3 * mesh->count, sizeof *indices);

    for (uint32_t i = 0; i < 3 * mesh->count; i++) {
        sums[i].k[0] = sums[i].k[1] = sums[i].k[2] = zero;
        indices[i] = 0;
    }
    for (uint32_t i = 0; i < 3 * mesh->count; i++) {
        const uint32_t leader = find_leader(mesh->leaders, i);

        if (mesh->wanted[i / 3]) {
            sums[leader] = soft_vec_add(sums[leader],
                    soft_vec_scale(mesh->across[i / 3],
                            find_angle(mesh, i / 3, (int)(i % 3))));
        }
    }
    for (uint32_t i = 0; i < 3 * mesh->count; i++) {
        const uint32_t leader = find_leader(mesh->leaders, i);

        /* a leader is the lowest of its corners, so it comes first */
        if (leader == i && soft_vec_dot(sums[i], sums[i]).m != 0) {
            const soft_vec_t unit = soft_vec_unit(sums[i]);
            const double normal[3] = {soft_double(unit.k[0]),
                    soft_double(unit.k[1]), soft_double(unit.k[2])};

            indices[i] = (uint32_t)world_add_normal(world, normal) + 1;
        }
        if (mesh->wanted[i / 3]) {
            faces[i / 3].normal[i % 3] = indices[leader];
        }
    }
    free(indices);
    free(sums);
}

/* Make the wanted faces smooth. */
static void smooth_mesh(mesh_t *mesh, world_t *world, world_face_t *faces,
        const uint32_t *places)
{
    mesh->across = cli_alloc(mesh->count, sizeof *mesh->across);
    mesh->unit = cli_alloc(mesh->count, sizeof *mesh->unit);
    mesh->first = cli_alloc(mesh->count, sizeof *mesh->first);
    mesh->leaders = cli_alloc(3 * mesh->count, sizeof *mesh->leaders);
    find_across(mesh);
    find_units(mesh);
    join_corners(mesh, places);
    add_normals(mesh, world, faces);
    free(mesh->leaders);
    free(mesh->first);
    free(mesh->unit);
    free(mesh->across);
}

/* ---- meshes ---- */

/* The faces of a mesh that are to be smooth, and where their creases are; false
 * if there are none. */
static bool find_wanted(mesh_t *mesh, const world_mesh_t *from)
{
    const double degrees = mesh->world->smooth + 0.01;
    const bool silent = mesh->world->smooth > 0 &&
                        is_silent(from, mesh->faces, mesh->count);
    bool any = false;

    mesh->cosine = find_cosine(
            silent && degrees < DEGREES_MOST ? degrees : DEGREES_MOST);
    for (size_t f = 0; f < mesh->count; f++) {
        const world_face_t *face = mesh->faces + f;

        mesh->wanted[f] = silent || (face->group != 0 && !has_normals(face));
        any = any || mesh->wanted[f];
    }
    return any;
}

void crease_world(world_t *world)
{
    uint32_t *places = NULL;
    bool asked = world->smooth == 0;

    for (size_t m = 0; m < world->mesh_count; m++) {
        const world_mesh_t *from = world->meshes + m;
        const size_t end = m + 1 < world->mesh_count ? from[1].first_face
                                                     : world->face_count;
        mesh_t mesh = {.world = world, .count = end - from->first_face};

        if (mesh.count == 0) {
            continue;
        }
        mesh.faces = world->faces + from->first_face;
        mesh.wanted = cli_alloc(mesh.count, sizeof *mesh.wanted);
        if (find_wanted(&mesh, from)) {
            asked = asked || !from->has_groups;
            places = places != NULL ? places : edges_places(world);
            smooth_mesh(&mesh, world, world->faces + from->first_face, places);
        }
        free(mesh.wanted);
    }
    if (!asked) {
        cli_warn("%s: smooth has no effect: no mesh is without vn and s",
                world->path);
    }
    free(places);
}
