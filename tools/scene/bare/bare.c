/* bare.c - the .scene that an OBJ alone stands for */
/* SPDX-License-Identifier: MIT */

#include "scene/bare/bare.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "lib/program/alloc.h"
#include "lib/program/cli.h"
#include "scene/bare/frame.h"
#include "scene/bare/sides.h"
#include "scene/read/read_obj.h"

enum {
    FOV = 40, /* degrees */
    FOV_INSIDE = 75,
    FEW_PERCENT = 80,  /* of the fronts that an object shows */
    OPEN_PERCENT = 90, /* of those that an open side shows */
    DIGITS = 4,        /* after the first of the model's size */
    FLOOR_WIDTH = 4    /* times the longest side of the model */
};

/* ---- is it one? ---- */

bool bare_is_name(const char *path)
{
    const size_t length = strlen(path);

    return length >= 4 && strcasecmp(path + length - 4, ".obj") == 0;
}

bool bare_is_text(const text_t *text)
{
    static const char *const keys[] = {
            "v", "vt", "vn", "vp", "f", "o", "g", "s", "l", "usemtl", "mtllib"};
    const char *at = text->next;
    size_t length;

    for (;;) {
        at += strspn(at, " \t\v\f\r\n");
        if (*at != '#') {
            break;
        }
        at += strcspn(at, "\r\n");
    }
    length = strcspn(at, " \t\v\f\r\n");
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        if (strlen(keys[i]) == length && strncmp(keys[i], at, length) == 0) {
            return true;
        }
    }
    return false;
}

/* ---- numbers, as short as the model's size allows ---- */

/* A text that grows, and what its numbers are rounded to. */
typedef struct {
    char *text;
    size_t length;
    int decimals;
    bool is_up_z;
} writer_t;

#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static void
add(writer_t *writer, const char *format, ...)
{
    va_list arguments, again;
    int length;
    char *grown;

    va_start(arguments, format);
    va_copy(again, arguments);
    length = vsnprintf(NULL, 0, format, arguments);
    grown = cli_alloc(writer->length + (size_t)length + 1, 1);
    if (writer->length > 0) {
        memcpy(grown, writer->text, writer->length);
    }
    (void)vsnprintf(grown + writer->length, (size_t)length + 1, format, again);
    va_end(again);
    va_end(arguments);
    free(writer->text);
    writer->text = grown;
    writer->length += (size_t)length;
}

static int choose_decimals(double size)
{
    char text[32];
    int decimals;

    (void)snprintf(text, sizeof text, "%.0e", size);
    decimals = DIGITS - atoi(strchr(text, 'e') + 1);
    return decimals > 0 ? decimals : 0;
}

/* A number without zeros at its end. */
static void add_number(writer_t *writer, double x)
{
    size_t first;

    add(writer, " ");
    first = writer->length;
    add(writer, "%.*f", writer->decimals, x);
    if (writer->decimals > 0) {
        while (writer->text[writer->length - 1] == '0') {
            writer->length--;
        }
        writer->length -= writer->text[writer->length - 1] == '.';
    }
    if (writer->length == first + 2 && writer->text[first] == '-' &&
            writer->text[first + 1] == '0') {
        writer->text[first] = '0'; /* was -0 */
        writer->length--;
    }
}

/* A point whose y is up, in the coordinates of the file. */
static void add_point(writer_t *writer, const double p[3])
{
    add_number(writer, p[0]);
    add_number(writer, writer->is_up_z ? -p[2] : p[1]);
    add_number(writer, writer->is_up_z ? p[1] : p[2]);
}

/* ---- the view ---- */

/* A model, its y up. */
typedef struct {
    world_t world;
    double low[3], high[3], middle[3]; /* its box */
    double size;                       /* the longest side of that */
    bool shines;
} object_t;

static bool is_seen(sides_t sides, unsigned percent)
{
    return sides.fronts * 100 > (sides.fronts + sides.backs) * percent;
}

/* Is there room for a camera? */
static bool is_roomy(const object_t *object)
{
    bool roomy = true;

    for (int k = 0; k < 3; k++) {
        roomy = roomy && object->high[k] - object->low[k] > object->size / 16;
    }
    return roomy;
}

/* In the middle of a wall, looking the longer way through the room. */
static void stand_inside(world_camera_t *camera, const object_t *object)
{
    const double *low = object->low, *high = object->high;
    const int along = high[0] - low[0] > high[2] - low[2] ? 0 : 2;

    for (int k = 0; k < 3; k++) {
        camera->eye[k] = camera->look[k] = object->middle[k];
    }
    camera->eye[along] = high[along] - (high[along] - low[along]) / 16;
    camera->fov = FOV_INSIDE;
}

/* Where a camera may be, and how it looks from there. */
typedef struct {
    int direction[3]; /* towards the eye */
    const char *words;
    bool is_room;
} view_t;

/* Choose the view. */
static const view_t *choose_view(world_camera_t *camera, const object_t *object)
{
    static const view_t inside = {{0, 0, 1},
            "from inside, for its walls show their backs outside", true};
    static const view_t views[] = {
            {{4, 3, 7}, "from the front, right and above", false},
            {{0, 0, 1}, "into its open front", true},
            {{0, 0, -1}, "into its open back", true},
            {{1, 0, 0}, "into its open right side", true},
            {{-1, 0, 0}, "into its open left side", true}};
    const world_t *world = &object->world;
    unsigned fronts = 0, backs = 0;
    size_t chosen = 0;

    for (size_t i = 0; i < sizeof views / sizeof *views; i++) {
        const sides_t sides = sides_see(world, views[i].direction);

        fronts += sides.fronts;
        backs += sides.backs;
        if (i == 0 ? is_seen(sides, FEW_PERCENT)
                   : is_seen(sides, OPEN_PERCENT)) {
            chosen = i;
            break;
        }
        if (i + 1 == sizeof views / sizeof *views && object->shines &&
                backs > 2 * fronts && is_roomy(object)) {
            stand_inside(camera, object);
            return &inside;
        }
    }
    camera->fov = FOV;
    frame_all(camera, world, views[chosen].direction);
    return views + chosen;
}

/* ---- the text ---- */

static const char *find_base(const char *path)
{
    const char *slash = strrchr(path, '/');

    return slash != NULL ? slash + 1 : path;
}

/* The OBJ's name as the .scene has it, beside which it is if it can; free() it.
 */
static char *name_mesh(const bare_t *bare)
{
    const char *base = find_base(bare->path);
    const char *beside = bare->beside != NULL ? bare->beside : bare->path;
    const size_t folder = (size_t)(base - bare->path);
    char name[4096] = "";

    if (folder == (size_t)(find_base(beside) - beside) &&
            strncmp(beside, bare->path, folder) == 0) {
        return alloc_text(base, strlen(base));
    }
    if (strchr(beside, '/') != NULL && bare->path[0] != '/' &&
            getcwd(name, sizeof name / 2) != NULL) {
        strcat(name, "/");
    }
    if (strlen(name) + strlen(bare->path) >= sizeof name) {
        cli_fail(CLI_USAGE, "%s: expected a shorter name", bare->path);
    }
    strcat(name, bare->path);
    return alloc_text(name, strlen(name));
}

/* A number not above x, of as many decimals as are written. */
static double round_down(const writer_t *writer, double x)
{
    char text[700];
    double rounded = x;

    for (int i = 0; i < 2; i++) {
        double step = 1;

        for (int k = 0; k < writer->decimals; k++) {
            step /= 10;
        }
        (void)snprintf(text, sizeof text, "%.*f", writer->decimals,
                x - (i == 0 ? 0 : step));
        rounded = atof(text);
        if (rounded <= x) {
            break;
        }
    }
    return rounded;
}

static void add_floor(writer_t *writer, const object_t *object)
{
    static const int corners[4][2] = {{-1, -1}, {-1, 1}, {1, 1}, {1, -1}};
    const double half = object->size * FLOOR_WIDTH / 2;

    add(writer, "quad ");
    for (int i = 0; i < 4; i++) {
        double p[3];

        p[0] = object->middle[0] + corners[i][0] * half;
        p[1] = round_down(writer, object->low[1]);
        p[2] = object->middle[2] + corners[i][1] * half;
        add_point(writer, p);
        add(writer, i < 3 ? " " : "  # the floor\n");
    }
}

/* A soft sky. Under that alone round things look flat, so on an object a wide
 * lamp shines from the left, above the eye; in a room the walls would be in its
 * way. */
static void add_light(
        writer_t *writer, const object_t *object, const view_t *view)
{
    /* its corners, clockwise for who is behind it, in sizes of the model to the
     * right, up, and towards the eye */
    static const double corners[4][3] = {{-2.13, 1.06, 1.13},
            {-1.47, 2.14, 0.47}, {-0.47, 2.14, 1.47}, {-1.13, 1.06, 2.13}};

    if (view->is_room) {
        add(writer, "sky 0.7 0.8 0.9\n");
        return;
    }
    add(writer, "sky 0.35 0.4 0.45\nmaterial key-light  Kd 0  Ke 5\nquad ");
    for (int i = 0; i < 4; i++) {
        double p[3];

        frame_beside(
                p, object->middle, view->direction, corners[i], object->size);
        add_point(writer, p);
        add(writer, i < 3 ? " " : "  material key-light\n");
    }
}

static void open_object(object_t *object, const bare_t *bare)
{
    world_t *world = &object->world;

    memset(object, 0, sizeof *object);
    world->path = bare->path;
    world->quiet = true; /* all is said when the scene is read */
    read_obj(world, bare->path);
    if (bare->is_up_z) {
        world_turn_up(world);
    }
    if (!frame_box(world, object->low, object->high)) {
        cli_fail(CLI_INPUT, "%s: expected a face with an area, found none",
                bare->path);
    }
    for (int k = 0; k < 3; k++) {
        const double side = object->high[k] - object->low[k];

        object->size = side > object->size ? side : object->size;
        object->middle[k] = object->low[k] + side / 2;
    }
    for (size_t f = 0; f < world->face_count; f++) {
        object->shines =
                object->shines || world_emits(world, world->faces[f].material);
    }
}

char *bare_describe(const bare_t *bare)
{
    writer_t writer = {.is_up_z = bare->is_up_z};
    char *name = name_mesh(bare);
    world_camera_t camera;
    object_t object;
    const view_t *view;

    open_object(&object, bare);
    view = choose_view(&camera, &object);
    writer.decimals = choose_decimals(object.size);
    add(&writer, "# %s, seen %s\nmesh %s\n", find_base(bare->path), view->words,
            name);
    if (bare->is_up_z) {
        add(&writer, "up z\n");
    }
    if (bare->floor) {
        add_floor(&writer, &object);
    }
    if (!object.shines) {
        add_light(&writer, &object, view);
    }
    add(&writer, "camera eye");
    add_point(&writer, camera.eye);
    add(&writer, "  look");
    add_point(&writer, camera.look);
    add(&writer, "  fov %g\nimage 256 256\n", camera.fov);
    free(name);
    world_free(&object.world);
    return writer.text;
}
