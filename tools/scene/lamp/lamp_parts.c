/* lamp_parts.c - faces that shine together, and what the grid left of them */
/* SPDX-License-Identifier: MIT */

#include "scene/lamp/lamp_parts.h"

#include <stdlib.h>

#include "lib/math/soft_vec.h"
#include "lib/program/cli.h"
#include "scene/crease/edges.h"

/* A face by its corners, or a corner by what it joins. */
typedef struct {
    uint32_t key[3];
    uint32_t face;
} entry_t;

static int compare_keys(const entry_t *p, const entry_t *q)
{
    for (int i = 0; i < 3; i++) {
        if (p->key[i] != q->key[i]) {
            return p->key[i] < q->key[i] ? -1 : 1;
        }
    }
    return 0;
}

static int compare_entries(const void *a, const void *b)
{
    const entry_t *p = a, *q = b;
    const int order = compare_keys(p, q);

    return order != 0 ? order : (p->face > q->face) - (p->face < q->face);
}

/* The faces that emit and repeat no other's corners. */
static bool *find_shining(const world_t *world, const uint32_t *places)
{
    const size_t n = world->face_count;
    entry_t *entries = cli_alloc(n, sizeof *entries);
    bool *shining = cli_alloc(n, sizeof *shining);

    for (size_t f = 0; f < n; f++) {
        const uint32_t *v = world->faces[f].vertex;
        const uint32_t at[3] = {places[v[0]], places[v[1]], places[v[2]]};
        const int low = at[0] <= at[1] && at[0] <= at[2] ? 0
                        : at[1] <= at[2]                 ? 1
                                                         : 2;

        for (int i = 0; i < 3; i++) {
            entries[f].key[i] = at[(low + i) % 3];
        }
        entries[f].face = (uint32_t)f; /* fewer than 2^32 */
    }
    qsort(entries, n, sizeof *entries, compare_entries);
    for (size_t i = 0; i < n; i++) {
        const uint32_t f = entries[i].face;

        shining[f] =
                world_emits(world, world->faces[f].material) &&
                (i == 0 || compare_keys(entries + i - 1, entries + i) != 0);
    }
    free(entries);
    return shining;
}

static uint32_t find_leader(uint32_t *leaders, uint32_t face)
{
    while (leaders[face] != face) {
        leaders[face] = leaders[leaders[face]];
        face = leaders[face];
    }
    return face;
}

/* Give faces that shine one leader if they share a material and a place. */
static uint32_t *find_leaders(
        const world_t *world, const bool *shining, const uint32_t *places)
{
    const size_t n = world->face_count;
    entry_t *entries = cli_alloc(3 * n, sizeof *entries);
    uint32_t *leaders = cli_alloc(n, sizeof *leaders);
    size_t count = 0;

    for (uint32_t f = 0; f < n; f++) {
        leaders[f] = f;
        for (int i = 0; i < 3 && shining[f]; i++) {
            const entry_t entry = {{places[world->faces[f].vertex[i]],
                                           world->faces[f].material, 0},
                    f};

            entries[count++] = entry;
        }
    }
    qsort(entries, count, sizeof *entries, compare_entries);
    for (size_t i = 1; i < count; i++) {
        if (compare_keys(entries + i - 1, entries + i) == 0) {
            leaders[find_leader(leaders, entries[i].face)] =
                    find_leader(leaders, entries[i - 1].face);
        }
    }
    free(entries);
    return leaders;
}

/* Twice the area of a face as written. */
static soft_t find_area(const world_t *world, const world_face_t *face)
{
    const soft_vec_t p = soft_vec_from(world->vertices[face->vertex[0]]);
    const soft_vec_t n = soft_vec_cross(
            soft_vec_sub(soft_vec_from(world->vertices[face->vertex[1]]), p),
            soft_vec_sub(soft_vec_from(world->vertices[face->vertex[2]]), p));

    return soft_sqrt(soft_vec_dot(n, n));
}

/* The areas of a lamp, at its leader. */
typedef struct {
    soft_t all, kept;
} areas_t;

static areas_t *find_areas(const world_t *world, const bool *kept,
        const bool *shining, uint32_t *leaders)
{
    areas_t *areas = cli_alloc(world->face_count, sizeof *areas);

    for (size_t f = 0; f < world->face_count; f++) {
        areas[f].all = areas[f].kept = soft_int(0, 0);
    }
    for (uint32_t f = 0; f < world->face_count; f++) {
        areas_t *of = areas + find_leader(leaders, f);
        const soft_t area = shining[f] ? find_area(world, world->faces + f)
                                       : soft_int(0, 0);

        of->all = soft_add(of->all, area);
        of->kept = kept[f] ? soft_add(of->kept, area) : of->kept;
    }
    return areas;
}

soft_t *lamp_parts_find(const world_t *world, const bool *kept, size_t *lost)
{
    uint32_t *places = edges_places(world);
    bool *shining = find_shining(world, places);
    uint32_t *leaders = find_leaders(world, shining, places);
    areas_t *areas = find_areas(world, kept, shining, leaders);
    soft_t *factors = cli_alloc(world->face_count, sizeof *factors);

    *lost = 0;
    for (uint32_t f = 0; f < world->face_count; f++) {
        const areas_t *of = areas + find_leader(leaders, f);

        factors[f] =
                of->kept.m != 0 ? soft_div(of->all, of->kept) : soft_int(1, 0);
        *lost += leaders[f] == f && of->all.m != 0 && of->kept.m == 0;
    }
    free(areas);
    free(leaders);
    free(shining);
    free(places);
    return factors;
}
