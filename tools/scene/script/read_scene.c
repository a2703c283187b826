/* read_scene.c - the .scene text and the meshes it names */
/* SPDX-License-Identifier: MIT */

#include "scene/script/read_scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"
#include "scene/crease/crease.h"
#include "scene/read/read_mtl.h"
#include "scene/read/read_table.h"
#include "scene/script/item.h"
#include "scene/sky/read_sky.h"
#include "scene/ql_blob.h"
#include "lib/math/soft_vec.h"

#define EXPOSURE_MAX 64

#define ROTATE_MAX 1e6 /* degrees */

static void read_vector(text_t *text, const char *what, double vector[3])
{
    for (int k = 0; k < 3; k++) {
        vector[k] = text_number(text, what);
    }
}

/* A scene while its lines are read. */
typedef struct {
    world_t *world;
    items_t items;
    bool is_up_z;
} script_t;

/* A value of a line that its name announces. */
typedef struct {
    const char *name;
    double *numbers;
    int count;
    const char *what; /* for messages */
} named_t;

#if defined(__GNUC__)
__attribute__((noreturn))
#endif
static void
fail_at_name(const text_t *text, const named_t *values, unsigned count,
        const char *found)
{
    char names[80] = "";

    for (unsigned i = 0; i < count; i++) {
        const size_t length = strlen(names);

        (void)snprintf(names + length, sizeof names - length, "%s%s",
                i > 0 ? ", " : "", values[i].name);
    }
    text_fail(text, "expected each of %s once, found '%s'", names, found);
}

/* Read names and their values in any order, each at most once; return bits that
 * say which were there. */
static unsigned read_named(text_t *text, const named_t *values, unsigned count)
{
    unsigned seen = 0;
    const char *word;

    while ((word = text_word(text)) != NULL) {
        unsigned i = 0;

        while (i < count && strcmp(word, values[i].name) != 0) {
            i++;
        }
        if (i == count || (seen & 1u << i) != 0) {
            fail_at_name(text, values, count, word);
        }
        seen |= 1u << i;
        for (int k = 0; k < values[i].count; k++) {
            values[i].numbers[k] = text_number(text, values[i].what);
        }
    }
    return seen;
}

/* Fail at its line if it has no picture. */
static void check_camera(text_t *text, const world_t *world)
{
    const world_camera_t *camera = &world->camera;
    const soft_vec_t up = soft_vec_from(camera->up);
    const soft_vec_t view = soft_vec_sub(
            soft_vec_from(camera->look), soft_vec_from(camera->eye));
    const soft_vec_t side = soft_vec_cross(view, up);
    soft_t least = soft_mul(soft_vec_dot(view, view), soft_vec_dot(up, up));

    text->line = world->camera_line;
    if (soft_vec_dot(view, view).m == 0) {
        text_fail(text, "expected camera 'eye' and 'look' at different points");
    }
    least.e -= 40; /* sin^2 of the angle: a millionth, squared */
    if (soft_compare(soft_vec_dot(side, side), least) <= 0) {
        text_fail(text, "expected camera 'up' not parallel to the view");
    }
}

/* Its up may be missing, and is 0 0 0 until the file is read. */
static void read_camera(text_t *text, world_t *world)
{
    world_camera_t *camera = &world->camera;
    const named_t values[] = {{"eye", camera->eye, 3, "three coordinates"},
            {"look", camera->look, 3, "three coordinates"},
            {"up", camera->up, 3, "three coordinates"},
            {"fov", &camera->fov, 1, "the field of view in degrees"}};
    unsigned seen;

    world->camera_line = text->line;
    camera->up[0] = camera->up[1] = camera->up[2] = 0;
    seen = read_named(text, values, 4);
    if ((seen | 4u) != 15) { /* all but up */
        text_fail(text, "expected camera eye X Y Z look X Y Z [up X Y Z] "
                        "fov DEGREES");
    }
    if (!(camera->fov > 0 && camera->fov < 180)) {
        text_fail(text, "expected a fov above 0 and below 180 degrees");
    }
    if ((seen & 4u) != 0 && camera->up[0] == 0 && camera->up[1] == 0 &&
            camera->up[2] == 0) {
        text_fail(text, "expected camera 'up' that is not 0 0 0");
    }
}

static void read_size(text_t *text, world_t *world)
{
    world->width = text_integer(text, "the width", 1, QL_IMAGE_MAX);
    world->height = text_integer(text, "the height", 1, QL_IMAGE_MAX);
}

static void read_exposure(text_t *text, world_t *world)
{
    world->exposure = text_number(text, "the exposure in stops");
    if (world->exposure < -EXPOSURE_MAX || world->exposure > EXPOSURE_MAX) {
        text_fail(text, "expected an exposure of %d to %d stops", -EXPOSURE_MAX,
                EXPOSURE_MAX);
    }
}

static void read_smooth(text_t *text, world_t *world)
{
    world->smooth = text_number(text, "an angle in degrees");
    if (!(world->smooth > 0 && world->smooth <= 180)) {
        text_fail(text, "expected an angle above 0 and at most 180 degrees");
    }
}

static void read_lights(text_t *text, world_t *world)
{
    const char *word = text_word(text);

    if (word == NULL || (strcmp(word, "two-sided") != 0 &&
                                strcmp(word, "one-sided") != 0)) {
        text_fail(text, "expected lights one-sided or two-sided");
    }
    world->two_sided = word[0] == 't';
}

/* The path of a file that the scene names; fails if it cannot be read. */
static char *find_path(const text_t *text, const char *what, const char *name)
{
    char *path = text_beside(text->path, name);
    FILE *file = fopen(path, "rb");

    if (file == NULL) {
        cli_fail(CLI_IO, "%s:%u: cannot read the %s '%s'", text->path,
                text->line, what, path);
    }
    fclose(file);
    return path;
}

static void read_table_file(text_t *text, world_t *world)
{
    const char *name = text_rest(text);
    char *path;

    if (name == NULL) {
        text_fail(text, "expected table FILE");
    }
    path = find_path(text, "table", name);
    read_table(world, path);
    free(path);
}

static void read_lens(text_t *text, world_t *world)
{
    const named_t values[] = {{"radius", &world->lens.radius, 1, "a length"},
            {"focus", &world->lens.focus, 1, "a length"}};

    if (read_named(text, values, 2) != 3) {
        text_fail(text, "expected lens radius R focus DISTANCE");
    }
    if (!(world->lens.radius >= 0 && world->lens.focus > 0)) {
        text_fail(text, "expected a radius of 0 or more and a focus above 0");
    }
    world->lens_line = text->line;
}

static void read_colour(text_t *text, world_sky_t *sky)
{
    read_vector(text, "a radiance, red, green and blue,", sky->colour);
    for (int k = 0; k < 3; k++) {
        if (!(sky->colour[k] >= 0 && sky->colour[k] <= SKY_RADIANCE_MAX)) {
            text_fail(text, "expected a radiance from 0 to %g, found %g",
                    SKY_RADIANCE_MAX, sky->colour[k]);
        }
    }
}

static void read_map(text_t *text, world_sky_t *sky)
{
    char *path = find_path(text, "sky", text_word(text));
    sky_rows_t rows = SKY_AS_WRITTEN;
    const char *word;

    while ((word = text_word(text)) != NULL) {
        if (strcmp(word, "flip") == 0) {
            rows = SKY_FLIPPED;
        } else if (strcmp(word, "rotate") == 0) {
            sky->rotate = text_number(text, "degrees");
            if (!(sky->rotate >= -ROTATE_MAX && sky->rotate <= ROTATE_MAX)) {
                text_fail(text, "expected %g degrees at most", ROTATE_MAX);
            }
        } else {
            text_fail(text,
                    "expected sky FILE [rotate DEGREES] [flip], found '%s'",
                    word);
        }
    }
    read_sky(sky, path, rows);
    free(path);
}

static void read_sky_line(text_t *text, world_t *world)
{
    const size_t word = strcspn(text->rest, " \t\v\f");

    if (word == 0) {
        text_fail(text, "expected sky RED GREEN BLUE or sky FILE");
    }
    if (strspn(text->rest, "0123456789+-.eE") == word) {
        read_colour(text, &world->sky);
    } else {
        read_map(text, &world->sky);
    }
}

static void read_up(text_t *text, script_t *script)
{
    const char *word = text_word(text);

    if (word == NULL || (strcmp(word, "y") != 0 && strcmp(word, "z") != 0)) {
        text_fail(text, "expected up y or up z");
    }
    script->is_up_z = word[0] == 'z';
}

static void read_own_material(text_t *text, script_t *script)
{
    read_material(script->world, text);
    script->world->own_count = script->world->material_count;
}

/* A key of the language; one of the three reads the rest of its line. */
typedef struct {
    const char *name;
    void (*read)(text_t *, world_t *);
    void (*read_item)(items_t *, text_t *);
    void (*read_script)(text_t *, script_t *);
    bool repeats; /* a scene may have several */
} key_t;

enum { CAMERA, KEY_COUNT = 14 };

static const key_t keys[KEY_COUNT] = {
        [CAMERA] = {.name = "camera", .read = read_camera},
        {.name = "mesh", .read_item = item_read_mesh, .repeats = true},
        {.name = "box", .read_item = item_read_box, .repeats = true},
        {.name = "quad", .read_item = item_read_quad, .repeats = true},
        {.name = "sphere", .read_item = item_read_sphere, .repeats = true},
        {.name = "material", .read_script = read_own_material, .repeats = true},
        {.name = "up", .read_script = read_up},
        {.name = "image", .read = read_size},
        {.name = "exposure", .read = read_exposure},
        {.name = "lights", .read = read_lights},
        {.name = "smooth", .read = read_smooth},
        {.name = "lens", .read = read_lens},
        {.name = "sky", .read = read_sky_line},
        {.name = "table", .read = read_table_file, .repeats = true},
};

/* Read a line; seen has a bit for each key that was there before. */
static void read_line(text_t *text, script_t *script, unsigned *seen)
{
    const char *word = text_word(text);
    int key = 0;

    while (key < KEY_COUNT && strcmp(word, keys[key].name) != 0) {
        key++;
    }
    if (key == KEY_COUNT) {
        text_fail(text,
                "expected mesh, box, quad, sphere, material, camera, lens, "
                "image, sky, lights, smooth, up, exposure or table, found "
                "'%.80s'",
                word);
    }
    if (!keys[key].repeats && (*seen & 1u << key) != 0) {
        text_fail(text, "expected one '%s' in a scene, found a second", word);
    }
    *seen |= 1u << key;
    if (keys[key].read_item != NULL) {
        keys[key].read_item(&script->items, text);
    } else if (keys[key].read_script != NULL) {
        keys[key].read_script(text, script);
    } else {
        keys[key].read(text, script->world);
    }
    text_finish(text);
}

/* Let the camera's up be that of the scene, if it has none of its own. */
static void finish_camera(script_t *script, text_t *text)
{
    double *up = script->world->camera.up;

    if (up[0] == 0 && up[1] == 0 && up[2] == 0) {
        up[script->is_up_z ? 2 : 1] = 1;
    }
    check_camera(text, script->world);
}

void read_scene(world_t *world, text_t *text)
{
    static const char *const names[] = {"mesh", "box", "quad", "sphere", NULL};
    script_t script = {.world = world};
    unsigned seen = 0, last_line;

    text->whole = names;
    memset(world, 0, sizeof *world);
    world->path = text->path;
    world->width = world->height = 256;
    while (text_line(text)) {
        read_line(text, &script, &seen);
    }
    if ((seen & 1u << CAMERA) == 0) {
        text_fail(text, "expected a 'camera' line before the end of the file");
    }
    last_line = text->line;
    finish_camera(&script, text);
    text->line = last_line;
    if (script.items.count == 0) {
        text_fail(text, "expected a mesh, box, quad or sphere before the end "
                        "of the file");
    }
    item_build(&script.items, world, text);
    item_free(&script.items);
    if (script.is_up_z) {
        world_turn_up(world);
    }
    crease_world(world);
}
