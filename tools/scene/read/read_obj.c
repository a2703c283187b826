/* read_obj.c - meshes from Wavefront OBJ files */
/* SPDX-License-Identifier: MIT */

#include "scene/read/read_obj.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/program/alloc.h"
#include "lib/program/cli.h"
#include "lib/program/names.h"
#include "scene/read/read_mtl.h"
#include "scene/read/text.h"

#define NORMAL_MAX 1e300

/* A corner of a face, as indices into the world; normal 1 + its own or 0. */
typedef struct {
    uint32_t vertex, normal;
} corner_t;

/* One mesh being read. Materials may be used before they are defined, so faces
 * first name an entry of used, and get the material's index at the end. */
typedef struct {
    text_t text;
    world_t *world;
    size_t first_vertex; /* of this mesh in the world */
    size_t first_normal;
    size_t first_face;
    size_t first_material;
    char **used; /* names as usemtl gives them */
    size_t used_count, used_capacity;
    size_t current;    /* entry of used; 0 is "none yet" */
    corner_t *polygon; /* corners of the face being read */
    size_t polygon_capacity;
    int64_t index_max; /* largest that was ahead of its vertex */
    unsigned index_max_line;
    names_t reported; /* keys and libraries reported already */
} reader_t;

static void read_vertex(reader_t *reader)
{
    double position[3];

    /* more numbers may follow, a weight or a colour: not needed */
    for (int k = 0; k < 3; k++) {
        position[k] = text_number(&reader->text, "three coordinates");
    }
    world_add_vertex(reader->world, position);
}

/* Anything but three numbers, as the nan of a face without area, is no normal;
 * that is 0. */
static void read_normal(reader_t *reader)
{
    double normal[3] = {0, 0, 0};

    for (int k = 0; k < 3; k++) {
        const char *word = text_word(&reader->text);
        char *end;

        normal[k] = word != NULL ? strtod(word, &end) : NAN;
        if (word == NULL || *end != '\0' || !(fabs(normal[k]) <= NORMAL_MAX)) {
            if (names_add(&reader->reported, "vn of no numbers")) {
                cli_warn("%s:%u: expected vn X Y Z: triangles that use it are "
                         "flat",
                        reader->text.path, reader->text.line);
            }
            memset(normal, 0, sizeof normal);
            break;
        }
    }
    world_add_normal(reader->world, normal);
}

/* Read one index of a corner from *at; return false if there is none. */
static bool read_index(char **at, long *index)
{
    char *end;

    if ((**at < '0' || **at > '9') && **at != '-') {
        return false;
    }
    errno = 0;
    *index = strtol(*at, &end, 10);
    if (end == *at || errno != 0) {
        return false;
    }
    *at = end;
    return *index != 0;
}

/* The world's index of a corner's vertex. */
static uint32_t find_vertex(reader_t *reader, long v)
{
    const int64_t count =
            (int64_t)(reader->world->vertex_count - reader->first_vertex);
    const int64_t index = v > 0 ? (int64_t)v - 1 : count + v;

    if (index < 0) {
        text_fail(&reader->text, "expected a vertex from %lld to -1, found %ld",
                (long long)-count, v);
    }
    if (index >= count && index > reader->index_max) {
        reader->index_max = index; /* legal if the vertex comes later */
        reader->index_max_line = reader->text.line;
    }
    if ((uint64_t)index >= UINT32_MAX - reader->first_vertex) {
        text_fail(&reader->text, "expected a smaller vertex than %ld", v);
    }
    return (uint32_t)(reader->first_vertex + (size_t)index);
}

/* 1 + the world's index of a corner's normal, 0 for none. It may come later, or
 * never: resolve_normals() sees to that. */
static uint32_t find_normal(const reader_t *reader, long n)
{
    const int64_t count =
            (int64_t)(reader->world->normal_count - reader->first_normal);
    const int64_t index = n > 0 ? (int64_t)n - 1 : count + n;

    if (n == 0 || index < 0 ||
            (uint64_t)index >= UINT32_MAX - 1 - reader->first_normal) {
        return n == 0 ? 0 : UINT32_MAX;
    }
    return (uint32_t)(reader->first_normal + (size_t)index) + 1;
}

/* v, v/vt, v//vn or v/vt/vn */
static corner_t read_corner(reader_t *reader, char *word)
{
    char *at = word;
    long v, n = 0, other;
    corner_t corner;
    bool good = read_index(&at, &v);

    if (good && *at == '/') {
        at++;
        /* vt may be missing, but a lone "v/" may also end the corner */
        good = *at == '/' || *at == '\0' || read_index(&at, &other);
        if (good && *at == '/') {
            at++;
            good = *at == '\0' || read_index(&at, &n);
        }
    }
    if (!good || *at != '\0') {
        text_fail(&reader->text,
                "expected a corner like 1, 1/2, 1//3 or 1/2/3 "
                "with no index 0, found '%s'",
                word);
    }
    corner.vertex = find_vertex(reader, v);
    corner.normal = find_normal(reader, n);
    return corner;
}

static void set_corner(world_face_t *face, int i, corner_t corner)
{
    face->vertex[i] = corner.vertex;
    face->normal[i] = corner.normal;
}

static void read_face(reader_t *reader)
{
    size_t count = 0;
    world_face_t face;
    char *word;

    while ((word = text_word(&reader->text)) != NULL) {
        const corner_t corner = read_corner(reader, word);

        reader->polygon = alloc_grow(reader->polygon, count,
                &reader->polygon_capacity, sizeof *reader->polygon);
        reader->polygon[count++] = corner;
    }
    if (count < 3) {
        text_fail(&reader->text, "expected three or more corners, found %zu",
                count);
    }
    face.material = (uint32_t)reader->current;
    set_corner(&face, 0, reader->polygon[0]);
    for (size_t i = 2; i < count; i++) {
        set_corner(&face, 1, reader->polygon[i - 1]);
        set_corner(&face, 2, reader->polygon[i]);
        world_add_face(reader->world, &face);
    }
}

static void add_used(reader_t *reader, const char *name)
{
    reader->used = alloc_grow(reader->used, reader->used_count,
            &reader->used_capacity, sizeof *reader->used);
    reader->used[reader->used_count++] = alloc_text(name, strlen(name));
}

static void read_usemtl(reader_t *reader)
{
    const char *name = text_rest(&reader->text);

    if (name == NULL) {
        text_fail(&reader->text, "expected usemtl NAME");
    }
    for (size_t i = 1; i < reader->used_count; i++) {
        if (strcmp(reader->used[i], name) == 0) {
            reader->current = i;
            return;
        }
    }
    reader->current = reader->used_count;
    add_used(reader, name);
}

static bool is_readable(const char *path)
{
    FILE *file = fopen(path, "rb");

    if (file != NULL) {
        fclose(file);
    }
    return file != NULL;
}

/* Read one library unless it has been tried; a missing one is no error. */
static void read_library(reader_t *reader, const char *name)
{
    char *path = text_beside(reader->text.path, name);

    if (names_add(&reader->reported, path)) {
        if (is_readable(path)) {
            read_mtl(reader->world, path);
        } else {
            cli_warn("%s:%u: cannot read '%s'; its materials are grey 0.5",
                    reader->text.path, reader->text.line, path);
        }
    }
    free(path);
}

/* A name may hold blanks, and a line may hold several names. */
static void read_mtllib(reader_t *reader)
{
    char *path, *word;
    bool whole;

    if (*reader->text.rest == '\0') {
        text_fail(&reader->text, "expected mtllib FILE.mtl");
    }
    path = text_beside(reader->text.path, reader->text.rest);
    whole = is_readable(path);
    free(path);
    if (whole) {
        read_library(reader, text_rest(&reader->text));
        return;
    }
    while ((word = text_word(&reader->text)) != NULL) {
        read_library(reader, word);
    }
}

/* A key that is left out says nothing that changes the picture. */
static void leave_out(reader_t *reader)
{
    (void)text_rest(&reader->text);
}

static void read_key(reader_t *reader, const char *key)
{
    static const struct {
        const char *name;
        void (*read)(reader_t *);
    } keys[] = {{"v", read_vertex}, {"vn", read_normal}, {"f", read_face},
            {"usemtl", read_usemtl}, {"mtllib", read_mtllib}, {"vt", leave_out},
            {"o", leave_out}, {"g", leave_out}, {"s", leave_out}};

    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        if (strcmp(key, keys[i].name) == 0) {
            keys[i].read(reader);
            return;
        }
    }
    if (names_add(&reader->reported, key)) {
        cli_warn("%s:%u: '%s' is not modelled", reader->text.path,
                reader->text.line, key);
    }
}

/* The material that entry i of used names: a new grey one if there is none. */
static size_t resolve(reader_t *reader, size_t i)
{
    world_t *world = reader->world;
    const char *name = reader->used[i];

    /* the last definition counts */
    for (size_t m = world->material_count; m > reader->first_material; m--) {
        if (i > 0 && strcmp(world->materials[m - 1].name, name) == 0) {
            return m - 1;
        }
    }
    if (i > 0) {
        cli_warn("%s: material '%s' is not defined: grey 0.5",
                reader->text.path, name);
    }
    return world_add_material(world, name, strlen(name));
}

static void resolve_materials(reader_t *reader)
{
    size_t *material = cli_alloc(reader->used_count, sizeof *material);
    const world_t *world = reader->world;

    for (size_t i = 0; i < reader->used_count; i++) {
        material[i] = SIZE_MAX;
    }
    for (size_t f = reader->first_face; f < world->face_count; f++) {
        const uint32_t i = world->faces[f].material;

        if (material[i] == SIZE_MAX) {
            material[i] = resolve(reader, i);
        }
        world->faces[f].material = (uint32_t)material[i];
    }
    free(material);
}

/* Forget normals that the file does not have. */
static void resolve_normals(reader_t *reader)
{
    world_t *world = reader->world;
    bool missing = false;

    for (size_t f = reader->first_face; f < world->face_count; f++) {
        for (int i = 0; i < 3; i++) {
            uint32_t *normal = world->faces[f].normal + i;

            if (*normal > world->normal_count) {
                *normal = 0;
                missing = true;
            }
        }
    }
    if (missing) {
        cli_warn("%s: corners name normals that are not there: those triangles "
                 "are flat",
                reader->text.path);
    }
}

static void close_reader(reader_t *reader)
{
    for (size_t i = 0; i < reader->used_count; i++) {
        free(reader->used[i]);
    }
    free(reader->used);
    free(reader->polygon);
    names_free(&reader->reported);
    text_close(&reader->text);
}

void read_obj(world_t *world, const char *path)
{
    reader_t reader = {0};
    char *key;

    reader.world = world;
    reader.first_vertex = world->vertex_count;
    reader.first_normal = world->normal_count;
    reader.first_face = world->face_count;
    reader.first_material = world->material_count;
    reader.index_max = -1;
    add_used(&reader, "(none)");
    text_open(&reader.text, path);
    while (text_line(&reader.text)) {
        key = text_word(&reader.text);
        read_key(&reader, key);
    }
    if (reader.index_max >=
            (int64_t)(world->vertex_count - reader.first_vertex)) {
        reader.text.line = reader.index_max_line;
        text_fail(&reader.text, "expected a vertex from 1 to %zu, found %lld",
                world->vertex_count - reader.first_vertex,
                (long long)reader.index_max + 1);
    }
    resolve_materials(&reader);
    resolve_normals(&reader);
    close_reader(&reader);
}
