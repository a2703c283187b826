/* joints.c - edges are split at the corners of other faces that lie on them */
/* SPDX-License-Identifier: MIT */

#include "scene/touch/joints.h"

#include <stdlib.h>
#include <string.h>

#include "lib/math/soft.h"
#include "lib/program/cli.h"
#include "scene/mesh/grid.h"
#include "scene/mesh/triples.h"

#define NONE UINT32_MAX

enum {
    FRACTION = 4, /* bits of a position below the grid unit */
    OFF_MAX = 8,  /* from an edge, in these: half a unit */
    CELL = 10     /* bits of a cell's side: 64 units */
};

/* Where corners are on the grid: vertices that become one are one place. */
typedef struct {
    int64_t at[3];   /* as written, in 1/16 units from the grid's origin */
    uint32_t vertex; /* of the world, one that is there */
    bool open;       /* an end of an edge that no other face has */
} place_t;

/* Places by a key, sorted: open ones by the cell they are in, or the other ends
 * of a place's open edges by the place. */
typedef struct {
    uint64_t key;
    uint32_t place;
} entry_t;

typedef struct {
    entry_t *entries;
    size_t count;
} index_t;

typedef struct {
    world_t *world;
    grid_t grid;
    place_t *places;
    uint32_t place_count;
    uint32_t *place_of; /* each vertex */
    triples_t edges;    /* between places */
    uint32_t *uses;     /* how many faces have each edge */
    uint32_t edge_count;
    index_t cells;       /* open places by their cells */
    index_t spokes;      /* the other ends of open edges by the one */
    world_face_t *faces; /* the new ones */
    size_t face_count, face_capacity;
} joints_t;

/* ---- places ------------------------------------------------------------ */

static void find_places(joints_t *j)
{
    const size_t n = j->world->vertex_count;
    triples_t known;

    j->places = cli_alloc(n, sizeof *j->places);
    j->place_of = cli_alloc(n, sizeof *j->place_of);
    triples_open(&known, n);
    for (size_t v = 0; v < n; v++) {
        place_t *place = j->places + j->place_count;
        triples_key_t key = {0, {0, 0, 0}};

        for (int k = 0; k < 3; k++) {
            const soft_t x =
                    soft_div(soft_sub(soft_from(j->world->vertices[v][k]),
                                     j->grid.origin[k]),
                            j->grid.unit);

            /* what no face has may be anywhere: it saturates */
            place->at[k] = soft_round(x, FRACTION);
            key.triple[k] = (uint32_t)soft_round(x, 0);
        }
        place->vertex = (uint32_t)v;
        j->place_of[v] = triples_add(&known, &key, j->place_count);
        j->place_count += j->place_of[v] == j->place_count;
    }
    triples_close(&known);
}

static uint32_t place_at(const joints_t *j, const world_face_t *face, int i)
{
    return j->place_of[face->vertex[i % 3]];
}

/* Twice the area of three places, along an axis, in squares of 1/16 units. */
static int64_t area_along(
        const place_t *a, const place_t *b, const place_t *c, int axis)
{
    const int x = (axis + 1) % 3, y = (axis + 2) % 3;

    return (b->at[x] - a->at[x]) * (c->at[y] - a->at[y]) -
           (b->at[y] - a->at[y]) * (c->at[x] - a->at[x]); /* below 2^41 */
}

/* Has a face an area, where its corners are? If not it is dropped later. */
static bool counts(const joints_t *j, const world_face_t *face)
{
    const place_t *a = j->places + place_at(j, face, 0);
    const place_t *b = j->places + place_at(j, face, 1);
    const place_t *c = j->places + place_at(j, face, 2);

    return area_along(a, b, c, 0) != 0 || area_along(a, b, c, 1) != 0 ||
           area_along(a, b, c, 2) != 0;
}

/* ---- indices ------------------------------------------------------------ */

static int compare_entries(const void *a, const void *b)
{
    const entry_t *x = a, *y = b;

    if (x->key != y->key) {
        return x->key < y->key ? -1 : 1;
    }
    return x->place < y->place ? -1 : x->place > y->place;
}

static void sort_index(index_t *index)
{
    if (index->count > 0) {
        qsort(index->entries, index->count, sizeof *index->entries,
                compare_entries);
    }
}

/* The first entry of a key, or where it would be. */
static size_t find_key(const index_t *index, uint64_t key)
{
    size_t low = 0, high = index->count;

    while (low < high) {
        const size_t middle = low + (high - low) / 2;

        if (index->entries[middle].key < key) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

static bool has_key(const index_t *index, size_t i, uint64_t key)
{
    return i < index->count && index->entries[i].key == key;
}

/* ---- edges that no other face has --------------------------------------- */

static uint32_t edge_index(joints_t *j, uint32_t a, uint32_t b)
{
    const triples_key_t key = {0, {a < b ? a : b, a < b ? b : a, 0}};
    const uint32_t index = triples_add(&j->edges, &key, j->edge_count);

    j->edge_count += index == j->edge_count;
    return index;
}

static bool is_open(joints_t *j, uint32_t a, uint32_t b)
{
    return j->uses[edge_index(j, a, b)] == 1;
}

static void add_spoke(joints_t *j, uint32_t from, uint32_t to)
{
    entry_t *entry = j->spokes.entries + j->spokes.count++;

    entry->key = from;
    entry->place = to;
    j->places[from].open = true;
}

static void find_open_edges(joints_t *j)
{
    const world_t *world = j->world;

    triples_open(&j->edges, 3 * world->face_count);
    j->uses = cli_alloc(3 * world->face_count, sizeof *j->uses);
    j->spokes.entries =
            cli_alloc(6 * world->face_count, sizeof *j->spokes.entries);
    for (int round = 0; round < 2; round++) {
        for (size_t f = 0; f < world->face_count; f++) {
            const world_face_t *face = world->faces + f;

            for (int i = 0; i < 3 && counts(j, face); i++) {
                const uint32_t a = place_at(j, face, i);
                const uint32_t b = place_at(j, face, i + 1);

                if (round == 0) {
                    j->uses[edge_index(j, a, b)]++;
                } else if (is_open(j, a, b)) {
                    add_spoke(j, a, b);
                    add_spoke(j, b, a);
                }
            }
        }
    }
    sort_index(&j->spokes);
}

/* Twice the room for so many entries. */
static void *grow(void *entries, size_t count, size_t *capacity, size_t size)
{
    void *larger;

    *capacity = 2 * count + 64;
    larger = cli_alloc(*capacity, size);
    if (count > 0) {
        memcpy(larger, entries, count * size);
    }
    free(entries);
    return larger;
}

/* ---- places along an edge ----------------------------------------------- */

static uint64_t cell_of(const int64_t at[3])
{
    /* inside the grid each is below 2^10 */
    return (uint64_t)(at[0] >> CELL) << 40 | (uint64_t)(at[1] >> CELL) << 20 |
           (uint64_t)(at[2] >> CELL);
}

static void sort_open_places(joints_t *j)
{
    j->cells.entries = cli_alloc(j->place_count, sizeof *j->cells.entries);
    for (uint32_t p = 0; p < j->place_count; p++) {
        if (j->places[p].open) {
            entry_t *entry = j->cells.entries + j->cells.count++;

            entry->key = cell_of(j->places[p].at);
            entry->place = p;
        }
    }
    sort_index(&j->cells);
}

/* A place on an edge, and how far along it. */
typedef struct {
    int64_t along;
    uint32_t place;
} joint_t;

typedef struct {
    joint_t *joints;
    size_t count, capacity;
} list_t;

/* Is a place on the line through a and b? How far along from a to b, of
 * |b - a|^2. */
static bool is_on_line(
        const place_t *a, const place_t *b, const place_t *p, int64_t *how_far)
{
    int64_t d[3], s[3], off = 0, longest = 0;

    *how_far = 0;
    for (int k = 0; k < 3; k++) {
        d[k] = b->at[k] - a->at[k]; /* below 2^20 */
        s[k] = p->at[k] - a->at[k];
        *how_far += d[k] * s[k];
        longest = llabs(d[k]) > longest ? llabs(d[k]) : longest;
    }
    for (int k = 0; k < 3; k++) {
        const int x = (k + 1) % 3, y = (k + 2) % 3;
        const int64_t cross = llabs(d[x] * s[y] - d[y] * s[x]);

        off = cross > off ? cross : off;
    }
    return off < OFF_MAX * longest;
}

static int64_t square_of(const place_t *a, const place_t *b)
{
    int64_t square = 0;

    for (int k = 0; k < 3; k++) {
        square += (b->at[k] - a->at[k]) * (b->at[k] - a->at[k]);
    }
    return square;
}

/* Do open edges lead from a place both ways along the line through a and b?
 * Then it is a joint between two edges that the one from a to b should meet. */
static bool is_joint(const joints_t *j, uint32_t p, int64_t how_far,
        const place_t *a, const place_t *b)
{
    bool back = false, on = false;

    for (size_t i = find_key(&j->spokes, p); has_key(&j->spokes, i, p); i++) {
        int64_t other;

        if (is_on_line(a, b, j->places + j->spokes.entries[i].place, &other)) {
            back = back || other < how_far;
            on = on || other > how_far;
        }
    }
    return back && on;
}

static void add_joint(list_t *list, uint32_t place, int64_t how_far)
{
    for (size_t i = 0; i < list->count; i++) {
        if (list->joints[i].place == place) {
            return;
        }
    }
    if (list->count == list->capacity) {
        list->joints = grow(list->joints, list->count, &list->capacity,
                sizeof *list->joints);
    }
    list->joints[list->count].along = how_far;
    list->joints[list->count++].place = place;
}

/* Look into one cell. */
static void look_into(
        joints_t *j, const int64_t at[3], const uint32_t of[3], list_t *list)
{
    const place_t *a = j->places + of[0], *b = j->places + of[1];
    const uint64_t cell = cell_of(at);

    for (size_t i = find_key(&j->cells, cell); has_key(&j->cells, i, cell);
            i++) {
        const uint32_t p = j->cells.entries[i].place;
        int64_t how_far;

        if (p != of[0] && p != of[1] && p != of[2] &&
                is_on_line(a, b, j->places + p, &how_far) && how_far > 0 &&
                how_far < square_of(a, b) && is_joint(j, p, how_far, a, b)) {
            add_joint(list, p, how_far);
        }
    }
}

static int compare_joints(const void *a, const void *b)
{
    const joint_t *x = a, *y = b;

    if (x->along != y->along) {
        return x->along < y->along ? -1 : 1;
    }
    return x->place < y->place ? -1 : x->place > y->place;
}

/* Find the places on the edge from of[0] to of[1], in their order; of[2] is the
 * third corner. */
static void find_joints(joints_t *j, const uint32_t of[3], list_t *list)
{
    const int64_t *a = j->places[of[0]].at, *b = j->places[of[1]].at;
    int64_t steps = 1;

    list->count = 0;
    for (int k = 0; k < 3; k++) {
        const int64_t s = (llabs(b[k] - a[k]) >> CELL) + 1;

        steps = s > steps ? s : steps;
    }
    for (int64_t i = 0; i < steps; i++) {
        int64_t low[3], high[3], at[3];

        for (int k = 0; k < 3; k++) { /* the box of a part, and a bit more */
            const int64_t p = a[k] + (b[k] - a[k]) * i / steps;
            const int64_t q = a[k] + (b[k] - a[k]) * (i + 1) / steps;

            low[k] = (p < q ? p : q) - 2 * OFF_MAX;
            low[k] = low[k] < 0 ? 0 : low[k] >> CELL << CELL;
            high[k] = (p > q ? p : q) + 2 * OFF_MAX;
        }
        for (at[0] = low[0]; at[0] <= high[0]; at[0] += 1 << CELL) {
            for (at[1] = low[1]; at[1] <= high[1]; at[1] += 1 << CELL) {
                for (at[2] = low[2]; at[2] <= high[2]; at[2] += 1 << CELL) {
                    look_into(j, at, of, list);
                }
            }
        }
    }
    if (list->count > 0) {
        qsort(list->joints, list->count, sizeof *list->joints, compare_joints);
    }
}

/* ---- faces --------------------------------------------------------------- */

static void append(joints_t *j, const world_face_t *face)
{
    if (j->face_count == j->face_capacity) {
        j->faces = grow(
                j->faces, j->face_count, &j->face_capacity, sizeof *j->faces);
    }
    j->faces[j->face_count++] = *face;
}

/* The normal between those of two corners; 0 if either has none. */
static uint32_t blend(world_t *world, uint32_t a, uint32_t b, soft_t part)
{
    double n[3];

    if (a == 0 || b == 0) {
        return 0;
    }
    for (int k = 0; k < 3; k++) {
        const soft_t x = soft_from(world->normals[a - 1][k]);
        const soft_t y = soft_from(world->normals[b - 1][k]);

        n[k] = soft_double(soft_add(x, soft_mul(part, soft_sub(y, x))));
    }
    return (uint32_t)world_add_normal(world, n) + 1;
}

/* Cut the new face at an index along its edge i, if that is open. The parts
 * share the corner across; the first takes its place, the others follow.
 * Returns the index of the last part, whose edge i + 1 is the face's. */
static size_t cut_edge(joints_t *j, size_t index, int i, list_t *list)
{
    const world_face_t whole = j->faces[index];
    const int next = (i + 1) % 3;
    const uint32_t of[3] = {place_at(j, &whole, i), place_at(j, &whole, i + 1),
            place_at(j, &whole, i + 2)};
    const int64_t square = square_of(j->places + of[0], j->places + of[1]);
    size_t last = index;

    if (!is_open(j, of[0], of[1])) {
        return index;
    }
    find_joints(j, of, list);
    for (size_t n = 0; n < list->count; n++) {
        const joint_t *joint = list->joints + n;
        const uint32_t vertex = j->places[joint->place].vertex;
        const uint32_t normal = blend(j->world, whole.normal[i],
                whole.normal[next],
                soft_div(soft_int(joint->along, 0), soft_int(square, 0)));
        world_face_t rest = j->faces[last];

        j->faces[last].vertex[next] = vertex;
        j->faces[last].normal[next] = normal;
        rest.vertex[i] = vertex;
        rest.normal[i] = normal;
        last = j->face_count;
        append(j, &rest);
    }
    return last;
}

/* Append a face or its parts; true if it was cut. */
static bool cut_face(joints_t *j, const world_face_t *face, list_t *list)
{
    const size_t first = j->face_count;

    append(j, face);
    if (counts(j, face)) {
        const size_t second = cut_edge(j, first, 0, list);
        const size_t third = cut_edge(j, second, 1, list);

        /* edge 2 is the first part's, if edge 0 was cut */
        (void)cut_edge(j, second == first ? third : first, 2, list);
    }
    return j->face_count > first + 1;
}

static size_t cut_faces(joints_t *j)
{
    world_t *world = j->world;
    list_t list = {NULL, 0, 0};
    size_t cuts = 0, mesh = 0;

    for (size_t f = 0; f < world->face_count; f++) {
        for (; mesh < world->mesh_count && world->meshes[mesh].first_face == f;
                mesh++) {
            world->meshes[mesh].first_face = j->face_count;
        }
        cuts += cut_face(j, world->faces + f, &list);
    }
    for (; mesh < world->mesh_count; mesh++) {
        world->meshes[mesh].first_face = j->face_count;
    }
    free(list.joints);
    return cuts;
}

size_t joints_split(world_t *world)
{
    size_t cuts = 0;
    joints_t j;

    memset(&j, 0, sizeof j);
    j.world = world;
    grid_fit(&j.grid, world);
    find_places(&j);
    find_open_edges(&j);
    sort_open_places(&j);
    if (j.spokes.count > 0) {
        cuts = cut_faces(&j);
        free(world->faces);
        world->faces = j.faces;
        world->face_count = j.face_count;
        world->face_capacity = j.face_capacity;
    }
    triples_close(&j.edges);
    free(j.cells.entries);
    free(j.spokes.entries);
    free(j.uses);
    free(j.place_of);
    free(j.places);
    return cuts;
}
