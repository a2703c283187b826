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
#include "scene/fill/fill.h"
#include "scene/foreign/notes.h"
#include "scene/read/read_mtl.h"
#include "scene/read/text.h"

#define NORMAL_MAX 1e300

/* A corner of a face, as indices into the world; normal 1 + its own or 0. */
typedef struct {
    uint32_t vertex, normal;
} corner_t;

/* A face as the file has it: its triangles go to that of the next one. */
typedef struct {
    size_t first_face;
    unsigned line;
} polygon_t;

/* A name of usemtl. */
typedef struct {
    char *name;
    unsigned line; /* that used it first */
} used_t;

/* One mesh being read. Materials may be used before they are defined, so faces
 * first name an entry of used, and get the material's index at the end. */
typedef struct {
    text_t text;
    world_t *world;
    size_t first_vertex; /* of this mesh in the world */
    size_t first_normal;
    size_t first_face;
    size_t first_material;
    used_t *used;
    size_t used_count, used_capacity;
    size_t current;    /* entry of used; 0 is "none yet" */
    uint32_t group;    /* of s; 0 is none */
    corner_t *corners; /* of the face being read */
    size_t corner_capacity;
    polygon_t *polygons;
    size_t polygon_count, polygon_capacity;
    int64_t index_max; /* largest that was ahead of its vertex */
    unsigned index_max_line;
    bool has_library;  /* there is a mtllib */
    names_t libraries; /* read already */
    notes_t notes;
} reader_t;

static void read_vertex(reader_t *reader)
{
    double position[3];
    unsigned more = 0;

    for (int k = 0; k < 3; k++) {
        position[k] = text_coordinate(&reader->text, "three coordinates");
    }
    if (isnan(position[0] + position[1] + position[2])) {
        position[0] = NAN; /* until finish_faces() */
        notes_add(&reader->notes, reader->text.line, "vertices of no numbers",
                "a vertex of no finite numbers is dropped with the faces that "
                "use it");
    }
    while (text_word(&reader->text) != NULL) {
        more++;
    }
    if (more >= 3) { /* one more may be a weight, which is not needed */
        notes_add(&reader->notes, reader->text.line, "vertex colours",
                "colours of vertices are not modelled: the Kd of the material "
                "is used");
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
            notes_add(&reader->notes, reader->text.line, "vn of no numbers",
                    "expected vn X Y Z: triangles that use it are flat");
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
    return true;
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

/* A slash and the index of a vt or vn, which may be missing; 0 says that too.
 * False if something else follows. */
static bool read_optional(reader_t *reader, char **at, long *index)
{
    if (**at != '/') {
        return **at == '\0';
    }
    ++*at;
    if (**at == '/' || **at == '\0') {
        return true;
    }
    if (!read_index(at, index)) {
        return false;
    }
    if (*index == 0) {
        notes_add(&reader->notes, reader->text.line, "index 0",
                "index 0 of a vt or vn is taken for a missing one");
    }
    return true;
}

/* v, v/vt, v//vn or v/vt/vn */
static corner_t read_corner(reader_t *reader, char *word)
{
    char *at = word;
    long v = 0, n = 0, other;
    corner_t corner;

    if (!read_index(&at, &v) || v == 0 || !read_optional(reader, &at, &other) ||
            !read_optional(reader, &at, &n) || *at != '\0') {
        text_fail(&reader->text,
                "expected a corner like 1, 1/2, 1//3 or 1/2/3 "
                "with no vertex 0, found '%s'",
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

static void begin_polygon(reader_t *reader)
{
    const polygon_t polygon = {reader->world->face_count, reader->text.line};

    reader->polygons = alloc_grow(reader->polygons, reader->polygon_count,
            &reader->polygon_capacity, sizeof *reader->polygons);
    reader->polygons[reader->polygon_count++] = polygon;
}

/* Where the triangles of a polygon end. */
static size_t find_end(const reader_t *reader, size_t polygon)
{
    return polygon + 1 < reader->polygon_count
                   ? reader->polygons[polygon + 1].first_face
                   : reader->world->face_count;
}

static void read_face(reader_t *reader)
{
    size_t count = 0;
    world_face_t face;
    char *word;

    while ((word = text_word(&reader->text)) != NULL) {
        const corner_t corner = read_corner(reader, word);

        reader->corners = alloc_grow(reader->corners, count,
                &reader->corner_capacity, sizeof *reader->corners);
        reader->corners[count++] = corner;
    }
    if (count < 3) {
        notes_add(&reader->notes, reader->text.line, "faces without area",
                "a face of fewer than three corners is dropped");
        return;
    }
    begin_polygon(reader);
    face.material = (uint32_t)reader->current;
    face.group = reader->group;
    face.goes_on = false;
    set_corner(&face, 0, reader->corners[0]);
    for (size_t i = 2; i < count; i++) {
        set_corner(&face, 1, reader->corners[i - 1]);
        set_corner(&face, 2, reader->corners[i]);
        world_add_face(reader->world, &face);
        face.goes_on = true;
    }
}

static void add_used(reader_t *reader, const char *name)
{
    reader->used = alloc_grow(reader->used, reader->used_count,
            &reader->used_capacity, sizeof *reader->used);
    reader->used[reader->used_count].name = alloc_text(name, strlen(name));
    reader->used[reader->used_count++].line = reader->text.line;
}

static void read_usemtl(reader_t *reader)
{
    const char *name = text_rest(&reader->text);

    if (name == NULL) {
        notes_add(&reader->notes, reader->text.line, "usemtl without a name",
                "usemtl without a name is the newmtl without one, or grey 0.5");
        name = "";
    }
    for (size_t i = 1; i < reader->used_count; i++) {
        if (strcmp(reader->used[i].name, name) == 0) {
            reader->current = i;
            return;
        }
    }
    reader->current = reader->used_count;
    add_used(reader, name);
}

/* A folder can be opened, but not read. */
static bool is_readable(const char *path)
{
    FILE *file = fopen(path, "rb");
    bool readable = false;

    if (file != NULL) {
        readable = fgetc(file) != EOF || !ferror(file);
        fclose(file);
    }
    return readable;
}

/* Read one library unless it has been tried; a missing one is no error. */
static void read_library(reader_t *reader, const char *name)
{
    char *path = text_beside(reader->text.path, name);

    if (names_add(&reader->libraries, path)) {
        if (is_readable(path)) {
            read_mtl(reader->world, path);
        } else {
            notes_add(&reader->notes, reader->text.line, "missing libraries",
                    "cannot read '%s'; its materials are grey 0.5", path);
        }
    }
    free(path);
}

/* Read the library that the rest of the line names, if there is one. */
static bool read_whole_name(reader_t *reader)
{
    char *path = text_beside(reader->text.path, reader->text.rest);
    const bool whole = *reader->text.rest != '\0' && is_readable(path);

    free(path);
    if (whole) {
        read_library(reader, text_rest(&reader->text));
    }
    return whole;
}

/* A name may hold blanks and begin with a '#', a line may hold several names,
 * and a comment behind them. */
static void read_mtllib(reader_t *reader)
{
    char *word;

    reader->has_library = true;
    do {
        if (read_whole_name(reader)) {
            return;
        }
    } while (text_cut_comment(reader->text.rest));
    if (*reader->text.rest == '\0') {
        notes_add(&reader->notes, reader->text.line, "mtllib without a name",
                "mtllib without a name names no materials");
    }
    while ((word = text_word(&reader->text)) != NULL) {
        read_library(reader, word);
    }
}

/* A smoothing group, or "off" or 0. */
static void read_group(reader_t *reader)
{
    const char *word = text_word(&reader->text);
    const world_t *world = reader->world;
    char *end = NULL;
    unsigned long group = 0;

    if (word != NULL && *word >= '0' && *word <= '9') {
        group = strtoul(word, &end, 10);
    }
    if (word != NULL && strcmp(word, "on") == 0) {
        group = 1;
    } else if (word == NULL ||
               (strcmp(word, "off") != 0 && (end == NULL || *end != '\0'))) {
        notes_add(&reader->notes, reader->text.line, "s of no group",
                "expected s GROUP or s off: faces from here on are flat");
        group = 0;
    }
    reader->group = (uint32_t)(group % UINT32_MAX); /* 64 bits at most */
    world->meshes[world->mesh_count - 1].has_groups = true;
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
            {"o", leave_out}, {"g", leave_out}, {"s", read_group}};

    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        if (strcmp(key, keys[i].name) == 0) {
            keys[i].read(reader);
            return;
        }
    }
    notes_add(&reader->notes, reader->text.line, "keys that are not modelled",
            "'%s' is not modelled: left out", key);
}

static bool is_exactly(const char *name, const char *other)
{
    return strcmp(name, other) == 0;
}

/* 1 + the material of a name, of which the last definition counts; 0 if there
 * is none. */
static size_t find_material(const reader_t *reader, const char *name,
        bool (*is)(const char *, const char *))
{
    const world_t *world = reader->world;

    for (size_t m = world->material_count; m > reader->first_material; m--) {
        if (is(world->materials[m - 1].name, name)) {
            return m;
        }
    }
    return 0;
}

/* 1 + the material of the .scene that stands for a name; 0 if there is none. */
static size_t find_own(const world_t *world, const char *name)
{
    for (size_t m = 0; m < world->own_count; m++) {
        if (text_is_same_name(world->materials[m].name, name)) {
            return m + 1;
        }
    }
    return 0;
}

/* The material that entry i of used names: a new grey one if there is none. */
static size_t resolve(reader_t *reader, size_t i)
{
    const used_t *used = reader->used + i;
    size_t found = 0;

    if (i > 0) {
        found = find_own(reader->world, used->name);
        found = found > 0 ? found
                          : find_material(reader, used->name, is_exactly);
        found = found > 0
                        ? found
                        : find_material(reader, used->name, text_is_same_name);
    }
    if (found > 0) {
        return found - 1;
    }
    if (i > 0 && used->name[0] != '\0') {
        notes_add(&reader->notes, used->line, "materials that are not defined",
                "material '%s' is not defined: grey 0.5", used->name);
    }
    return world_add_material(reader->world, used->name, strlen(used->name));
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

    for (size_t p = 0; p < reader->polygon_count; p++) {
        bool missing = false;

        for (size_t f = reader->polygons[p].first_face; f < find_end(reader, p);
                f++) {
            for (int i = 0; i < 3; i++) {
                uint32_t *normal = world->faces[f].normal + i;

                if (*normal > world->normal_count) {
                    *normal = 0;
                    missing = true;
                }
            }
        }
        if (missing) {
            notes_add(&reader->notes, reader->polygons[p].line, "missing vn",
                    "corners name normals that are not there: the face is "
                    "flat");
        }
    }
}

/* Does a polygon have a corner that is no point? */
static bool is_lost(const reader_t *reader, size_t polygon)
{
    const world_t *world = reader->world;

    for (size_t f = reader->polygons[polygon].first_face;
            f < find_end(reader, polygon); f++) {
        for (int i = 0; i < 3; i++) {
            if (isnan(world->vertices[world->faces[f].vertex[i]][0])) {
                return true;
            }
        }
    }
    return false;
}

/* Fill the outline of a polygon whose fan is at the end of the kept triangles;
 * return how many triangles it has then. */
static size_t fill_polygon(reader_t *reader, size_t polygon, world_face_t *fan)
{
    const size_t count =
            find_end(reader, polygon) - reader->polygons[polygon].first_face;
    const unsigned line = reader->polygons[polygon].line;
    fill_faults_t faults;
    const size_t filled = fill_face(&faults, reader->world, fan, count);

    if (faults.crosses) {
        notes_add(&reader->notes, line, "outlines that cross themselves",
                "the outline of a face crosses itself: its triangles overlap");
    }
    if (faults.is_bent) {
        notes_add(&reader->notes, line, "bent faces",
                "a face is bent by more than 20 degrees: other programs may "
                "fold it the other way");
    }
    if (filled == 0) {
        notes_add(&reader->notes, line, "faces without area",
                "a face whose outline encloses nothing is dropped");
    }
    return filled;
}

/* Drop the polygons of vertices that are no points, fill the others, then let
 * these vertices be 0. The polygons are not needed any more. */
static void finish_faces(reader_t *reader)
{
    world_t *world = reader->world;
    size_t kept = reader->first_face, first;

    for (size_t p = 0; p < reader->polygon_count; p++) {
        if (is_lost(reader, p)) {
            notes_add(&reader->notes, reader->polygons[p].line,
                    "faces of no numbers",
                    "a face of a vertex of no finite numbers is dropped");
            continue;
        }
        first = reader->polygons[p].first_face;
        memmove(world->faces + kept, world->faces + first,
                (find_end(reader, p) - first) * sizeof *world->faces);
        kept += fill_polygon(reader, p, world->faces + kept);
    }
    world->face_count = kept;
    for (size_t v = reader->first_vertex; v < world->vertex_count; v++) {
        if (isnan(world->vertices[v][0])) {
            memset(world->vertices[v], 0, sizeof world->vertices[v]);
        }
    }
}

static void close_reader(reader_t *reader)
{
    notes_report(&reader->notes);
    for (size_t i = 0; i < reader->used_count; i++) {
        free(reader->used[i].name);
    }
    free(reader->used);
    free(reader->corners);
    free(reader->polygons);
    names_free(&reader->libraries);
    text_close(&reader->text);
}

/* Fail if a face has a vertex that has not come, or if there is no face. */
static void check_faces(reader_t *reader)
{
    const size_t vertices = reader->world->vertex_count - reader->first_vertex;

    if (reader->index_max >= (int64_t)vertices) {
        reader->text.line = reader->index_max_line;
        text_fail(&reader->text, "expected a vertex from 1 to %zu, found %lld",
                vertices, (long long)reader->index_max + 1);
    }
    if (reader->polygon_count > 0) {
        return;
    }
    if (vertices > 0) {
        text_fail(&reader->text,
                "expected a face before the end of the file, found a cloud of "
                "%zu points",
                vertices);
    }
    if (!reader->has_library) {
        text_fail(&reader->text,
                "expected v and f, or mtllib, before the end of the file, "
                "found nothing of a mesh");
    }
}

void read_obj(world_t *world, const char *path)
{
    static const char *const names[] = {"usemtl", "mtllib", NULL};
    reader_t reader = {0};
    char *key;

    reader.world = world;
    reader.first_vertex = world->vertex_count;
    reader.first_normal = world->normal_count;
    reader.first_face = world->face_count;
    world_add_mesh(world, path);
    reader.first_material = world->material_count;
    reader.index_max = -1;
    reader.notes.quiet = world->quiet;
    add_used(&reader, "(none)");
    text_open_foreign(&reader.text, path, &reader.notes, names);
    while (text_line(&reader.text)) {
        key = text_word(&reader.text);
        read_key(&reader, key);
    }
    check_faces(&reader);
    resolve_materials(&reader);
    resolve_normals(&reader);
    finish_faces(&reader);
    close_reader(&reader);
}
