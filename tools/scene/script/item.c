/* item.c - lines of a scene that are surfaces: mesh, box, quad, sphere */
/* SPDX-License-Identifier: MIT */

#include "scene/script/item.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/program/alloc.h"
#include "lib/program/cli.h"
#include "scene/read/read_obj.h"

#define PLACE " [scale S] [turn X Y Z] [at X Y Z]"

/* What each line is, for messages. */
static const char *const forms[] = {
        [ITEM_MESH] = "mesh FILE.obj" PLACE " [material NAME]",
        [ITEM_BOX] =
                "box from X Y Z to X Y Z [inside]" PLACE " [material NAME]",
        [ITEM_QUAD] = "quad of four corners X Y Z" PLACE " [material NAME]",
        [ITEM_SPHERE] = "sphere X Y Z radius R [material NAME]"};

static item_t *add_item(items_t *items, item_kind_t kind, const text_t *text)
{
    static const place_t nowhere = PLACE_NOWHERE;
    item_t *item;

    items->items = alloc_grow(
            items->items, items->count, &items->capacity, sizeof *items->items);
    item = items->items + items->count++;
    memset(item, 0, sizeof *item);
    item->kind = kind;
    item->line = text->line;
    item->place = nowhere;
    return item;
}

static void read_vector(text_t *text, double vector[3])
{
    for (int k = 0; k < 3; k++) {
        vector[k] = text_number(text, "three coordinates");
    }
}

/* ---- words behind the key ---- */

enum {
    WORD_SCALE,
    WORD_TURN,
    WORD_AT,
    WORD_MATERIAL,
    WORD_FROM,
    WORD_TO,
    WORD_INSIDE,
    WORD_RADIUS,
    WORD_COUNT
};

static const char *const words[WORD_COUNT] = {
        "scale", "turn", "at", "material", "from", "to", "inside", "radius"};

/* Those that each kind of line has, and those it must have, as bits. */
#define BIT(word)   (1u << (word))
#define BITS_PLACED (BIT(WORD_SCALE) | BIT(WORD_TURN) | BIT(WORD_AT))
#define BITS_BOX    (BIT(WORD_FROM) | BIT(WORD_TO))

static const struct {
    unsigned may, must;
} takes[] = {[ITEM_MESH] = {BITS_PLACED | BIT(WORD_MATERIAL), 0},
        [ITEM_BOX] = {BITS_PLACED | BIT(WORD_MATERIAL) | BITS_BOX |
                              BIT(WORD_INSIDE),
                BITS_BOX},
        [ITEM_QUAD] = {BITS_PLACED | BIT(WORD_MATERIAL), 0},
        [ITEM_SPHERE] = {
                BIT(WORD_RADIUS) | BIT(WORD_MATERIAL), BIT(WORD_RADIUS)}};

/* One number for all axes, or three. */
static void read_scale(text_t *text, place_t *place)
{
    place->scale[0] = text_number(text, "the scale");
    place->scale[1] = place->scale[2] = place->scale[0];
    if (*text->rest != '\0' && strchr("0123456789+-.", *text->rest) != NULL) {
        place->scale[1] = text_number(text, "the scale along y");
        place->scale[2] = text_number(text, "the scale along z");
    }
    for (int k = 0; k < 3; k++) {
        if (place->scale[k] == 0) {
            text_fail(text, "expected a scale that is not 0");
        }
    }
}

static void read_turn(text_t *text, place_t *place)
{
    for (int k = 0; k < 3; k++) {
        double *degrees = place->turn + k;

        *degrees = text_number(text, "three angles in degrees");
        if (!(*degrees >= -PLACE_DEGREES_MOST &&
                    *degrees <= PLACE_DEGREES_MOST)) {
            text_fail(text, "expected %g degrees at most", PLACE_DEGREES_MOST);
        }
    }
}

static void read_radius(text_t *text, item_t *item)
{
    item->radius = text_number(text, "the radius");
    if (!(item->radius > 0)) {
        text_fail(text, "expected a radius above 0");
    }
}

static void read_material(text_t *text, item_t *item)
{
    const char *name = text_rest(text);

    if (name == NULL) {
        text_fail(text, "expected %s", forms[item->kind]);
    }
    item->material = alloc_text(name, strlen(name));
}

/* What follows a word. */
static void read_value(text_t *text, item_t *item, int word)
{
    switch (word) {
    case WORD_SCALE:
        read_scale(text, &item->place);
        break;
    case WORD_TURN:
        read_turn(text, &item->place);
        break;
    case WORD_AT:
        read_vector(text, item->place.at);
        break;
    case WORD_FROM:
        read_vector(text, item->corners[0]);
        break;
    case WORD_TO:
        read_vector(text, item->corners[1]);
        break;
    case WORD_INSIDE:
        item->front = SHAPE_INSIDE;
        break;
    case WORD_RADIUS:
        read_radius(text, item);
        break;
    default:
        read_material(text, item);
    }
}

static int find_word(const char *found)
{
    int word = 0;

    while (word < WORD_COUNT && strcmp(words[word], found) != 0) {
        word++;
    }
    return word;
}

/* Read words and their values in any order, each at most once; the material's
 * name ends the line, as a comment does. */
static void read_words(text_t *text, item_t *item)
{
    unsigned seen = 0;
    const char *found;

    while ((found = text_word(text)) != NULL) {
        const int word = find_word(found);

        if (found[0] == '#') {
            (void)text_rest(text);
            break;
        }
        if (word == WORD_COUNT || (takes[item->kind].may & BIT(word)) == 0) {
            text_fail(
                    text, "expected %s, found '%s'", forms[item->kind], found);
        }
        if ((seen & BIT(word)) != 0) {
            text_fail(text, "expected '%s' once, found it twice", found);
        }
        seen |= BIT(word);
        read_value(text, item, word);
    }
    item->is_placed = (seen & BITS_PLACED) != 0;
    if ((takes[item->kind].must & ~seen) != 0) {
        text_fail(text, "expected %s", forms[item->kind]);
    }
}

/* ---- the name of a mesh ---- */

static bool is_readable(const text_t *text, const char *name)
{
    char *path = text_beside(text->path, name);
    FILE *file = fopen(path, "rb");

    free(path);
    if (file != NULL) {
        fclose(file);
    }
    return file != NULL;
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

/* May the name end before this place of the line? At the line's end, before a
 * comment, and before a word that places a mesh. */
static bool may_end(const char *line, size_t at)
{
    bool may = line[at] == '\0' || (line[at] == '#' && at > 0);

    for (int word = 0; word < WORD_COUNT && at > 0; word++) {
        const size_t length = strlen(words[word]);

        may = may || ((takes[ITEM_MESH].may & BIT(word)) != 0 &&
                             strncmp(line + at, words[word], length) == 0 &&
                             is_blank(line[at + length]));
    }
    return may && (line[at] == '\0' || is_blank(line[at - 1]));
}

/* Take the longest name of a file that is there off the line: it may have
 * blanks and a '#'. If none is, the shortest one. NULL: there is no name. */
static char *take_name(text_t *text)
{
    char *line = text->rest, *name = NULL;
    size_t from = strlen(line);
    bool found = false;

    for (size_t at = from + 1; at-- > 0 && !found;) {
        size_t end = at;

        if (!may_end(line, at)) {
            continue;
        }
        while (end > 0 && is_blank(line[end - 1])) {
            end--;
        }
        free(name);
        name = alloc_text(line, end);
        from = at;
        found = is_readable(text, name);
    }
    if (name != NULL && !found && (*name == '\0' || *name == '#')) {
        free(name);
        name = NULL;
    }
    text->rest += from;
    return name;
}

void item_read_mesh(items_t *items, text_t *text)
{
    item_t *item = add_item(items, ITEM_MESH, text);
    char *name = take_name(text);

    if (name == NULL) {
        text_fail(text, "expected mesh FILE.obj");
    }
    if (!is_readable(text, name)) {
        cli_fail(CLI_IO, "%s:%u: cannot read the mesh '%s'", text->path,
                text->line, text_beside(text->path, name));
    }
    item->path = text_beside(text->path, name);
    free(name);
    read_words(text, item);
}

void item_read_box(items_t *items, text_t *text)
{
    item_t *item = add_item(items, ITEM_BOX, text);

    read_words(text, item);
    for (int k = 0; k < 3; k++) {
        const double a = item->corners[0][k], b = item->corners[1][k];

        if (a == b) {
            text_fail(text, "expected a box from X Y Z to another X, Y and Z");
        }
        item->corners[0][k] = a < b ? a : b;
        item->corners[1][k] = a < b ? b : a;
    }
}

void item_read_quad(items_t *items, text_t *text)
{
    item_t *item = add_item(items, ITEM_QUAD, text);

    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 3; k++) {
            item->corners[i][k] =
                    text_number(text, "four corners of three coordinates");
        }
    }
    read_words(text, item);
}

void item_read_sphere(items_t *items, text_t *text)
{
    item_t *item = add_item(items, ITEM_SPHERE, text);

    read_vector(text, item->corners[0]);
    read_words(text, item);
}

/* ---- to a world ---- */

/* 1 + the material of a name: of the .scene, or the last that a library has
 * under it, or else under it but for a comment; 0 if there is none. */
static size_t find_material(const world_t *world, const char *name)
{
    size_t found = 0;
    bool exact = false;

    for (size_t m = 0; m < world->material_count; m++) {
        const world_material_t *material = world->materials + m;
        const bool same = strcmp(material->name, name) == 0;

        if (same && m < world->own_count) {
            return m + 1;
        }
        if (material->defined &&
                (same || (!exact && text_is_same_name(material->name, name)))) {
            found = m + 1;
            exact = same;
        }
    }
    return found;
}

/* The material of an item; new grey without a name. */
static uint32_t choose_material(world_t *world, item_t *item, text_t *text)
{
    size_t m;

    if (item->material == NULL) {
        return (uint32_t)world_add_material(world, "(none)", 6);
    }
    m = find_material(world, item->material);
    while (m == 0 && text_cut_comment(item->material)) {
        m = find_material(world, item->material);
    }
    if (m == 0) {
        text->line = item->line;
        text_fail(text,
                "expected a material that a mesh's mtllib or a 'material' line "
                "defines, found '%s'",
                item->material);
    }
    return (uint32_t)(m - 1);
}

/* Add what another item is, with its materials. */
static void copy_mesh(world_t *world, const item_t *from, const char *path)
{
    const place_mark_t to = place_mark(world);

    world_add_mesh(world, path);
    world->meshes[world->mesh_count - 1].has_groups =
            world->meshes[from->mesh].has_groups;
    for (size_t v = from->from.vertex; v < from->to.vertex; v++) {
        double p[3];

        memcpy(p, world->vertices[v], sizeof p);
        (void)world_add_vertex(world, p);
    }
    for (size_t n = from->from.normal; n < from->to.normal; n++) {
        double normal[3];

        memcpy(normal, world->normals[n], sizeof normal);
        (void)world_add_normal(world, normal);
    }
    for (size_t f = from->from.face; f < from->to.face; f++) {
        world_face_t face = world->faces[f];

        for (int i = 0; i < 3; i++) {
            face.vertex[i] += (uint32_t)(to.vertex - from->from.vertex);
            face.normal[i] +=
                    face.normal[i] == 0
                            ? 0
                            : (uint32_t)(to.normal - from->from.normal);
        }
        world_add_face(world, &face);
    }
}

/* Read the file of a mesh, or copy what an item before has of it. */
static void add_mesh(items_t *items, size_t index, world_t *world)
{
    const item_t *item = items->items + index;

    for (size_t i = 0; i < index; i++) {
        const item_t *other = items->items + i;

        if (other->kind == ITEM_MESH && strcmp(other->path, item->path) == 0) {
            copy_mesh(world, other, item->path);
            return;
        }
    }
    read_obj(world, item->path);
}

/* Add a surface that is in no file; its material comes later. */
static void add_shape(item_t *item, world_t *world, text_t *text)
{
    char name[40];

    (void)snprintf(name, sizeof name, "the %s of line %u",
            item->kind == ITEM_BOX ? "box" : "quad", item->line);
    if (item->kind == ITEM_BOX) {
        shape_box(world, item->corners[0], item->corners[1], item->front, 0,
                name);
    } else if (!shape_quad(world, item->corners, 0, name)) {
        text->line = item->line;
        text_fail(text, "expected four corners around an area, "
                        "counter-clockwise from its front");
    }
}

static void add_sphere(item_t *item, world_t *world, text_t *text)
{
    const uint32_t material = choose_material(world, item, text);
    world_sphere_t *sphere = world_add_sphere(world);

    memcpy(sphere->centre, item->corners[0], sizeof sphere->centre);
    sphere->radius = item->radius;
    sphere->material = material;
}

static void finish_faces(item_t *item, world_t *world, text_t *text)
{
    if (item->kind != ITEM_MESH || item->material != NULL) {
        const uint32_t material = choose_material(world, item, text);

        for (size_t f = item->from.face; f < item->to.face; f++) {
            world->faces[f].material = material;
        }
    }
    if (item->is_placed &&
            !place_part(world, &item->place, item->from, item->to)) {
        text->line = item->line;
        text_fail(text, "expected a place where coordinates are 1e300 at most");
    }
}

void item_build(items_t *items, world_t *world, text_t *text)
{
    for (size_t i = 0; i < items->count; i++) {
        item_t *item = items->items + i;

        item->mesh = world->mesh_count;
        item->from = place_mark(world);
        if (item->kind == ITEM_MESH) {
            add_mesh(items, i, world);
        } else if (item->kind != ITEM_SPHERE) {
            add_shape(item, world, text);
        }
        item->to = place_mark(world);
    }
    for (size_t i = 0; i < items->count; i++) {
        if (items->items[i].kind == ITEM_SPHERE) {
            add_sphere(items->items + i, world, text);
        } else {
            finish_faces(items->items + i, world, text);
        }
    }
}

void item_free(items_t *items)
{
    for (size_t i = 0; i < items->count; i++) {
        free(items->items[i].path);
        free(items->items[i].material);
    }
    free(items->items);
    memset(items, 0, sizeof *items);
}
