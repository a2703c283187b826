/* read_scene.c - the .scene text and the meshes it names */
/* SPDX-License-Identifier: MIT */

#include "read_scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "read_obj.h"
#include "scene/ql_blob.h"
#include "soft.h"

#define EXPOSURE_MAX 64

/* Keys of the language, in the order of the bits of seen. */
enum { MESH, CAMERA, IMAGE, EXPOSURE, LIGHTS, LENS, SKY, SPHERE, KEY_COUNT };

static const char *const key_names[KEY_COUNT] = {
        "mesh",
        "camera",
        "image",
        "exposure",
        "lights",
        "lens",
        "sky",
        "sphere",
};

static void read_vector(text_t *text, const char *what, double vector[3])
{
    for (int k = 0; k < 3; k++) {
        vector[k] = text_number(text, what);
    }
}

/* The squared length of (a - b) x up. */
static soft_t cross_square(
        const double a[3], const double b[3], const double up[3])
{
    soft_t sum = soft_int(0, 0);

    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const soft_t fj = soft_sub(soft_from(a[j]), soft_from(b[j]));
        const soft_t fk = soft_sub(soft_from(a[k]), soft_from(b[k]));
        const soft_t c = soft_sub(
                soft_mul(fj, soft_from(up[k])), soft_mul(fk, soft_from(up[j])));

        sum = soft_add(sum, soft_mul(c, c));
    }
    return sum;
}

/* The squared length of a - b. */
static soft_t distance_square(const double a[3], const double b[3])
{
    soft_t sum = soft_int(0, 0);

    for (int k = 0; k < 3; k++) {
        const soft_t d = soft_sub(soft_from(a[k]), soft_from(b[k]));

        sum = soft_add(sum, soft_mul(d, d));
    }
    return sum;
}

static void check_camera(const text_t *text, const world_camera_t *camera)
{
    static const double zero[3] = {0, 0, 0};
    const soft_t view = distance_square(camera->look, camera->eye);
    const soft_t up = distance_square(camera->up, zero);
    soft_t least = soft_mul(view, up);

    if (view.m == 0) {
        text_fail(text, "expected camera 'eye' and 'look' at different points");
    }
    if (up.m == 0) {
        text_fail(text, "expected camera 'up' that is not 0 0 0");
    }
    least.e -= 40; /* sin^2 of the angle: a millionth, squared */
    if (soft_compare(cross_square(camera->look, camera->eye, camera->up),
                least) <= 0) {
        text_fail(text, "expected camera 'up' not parallel to the view");
    }
}

static void read_camera(text_t *text, world_camera_t *camera)
{
    static const char *const names[] = {"eye", "look", "up", "fov"};
    unsigned seen = 0;
    const char *word;

    camera->up[0] = camera->up[2] = 0;
    camera->up[1] = 1;
    while ((word = text_word(text)) != NULL) {
        unsigned i = 0;

        while (i < 4 && strcmp(word, names[i]) != 0) {
            i++;
        }
        if (i == 4 || (seen & 1u << i) != 0) {
            text_fail(text,
                    "expected each of eye, look, up, fov once, found "
                    "'%s'",
                    word);
        }
        seen |= 1u << i;
        if (i == 3) {
            camera->fov = text_number(text, "the field of view in degrees");
        } else {
            read_vector(text, "three coordinates",
                    i == 0   ? camera->eye
                    : i == 1 ? camera->look
                             : camera->up);
        }
    }
    if ((seen & 1u) == 0 || (seen & 2u) == 0 || (seen & 8u) == 0) {
        text_fail(text, "expected camera eye X Y Z look X Y Z [up X Y Z] "
                        "fov DEGREES");
    }
    if (!(camera->fov > 0 && camera->fov < 180)) {
        text_fail(text, "expected a fov above 0 and below 180 degrees");
    }
    check_camera(text, camera);
}

static void read_exposure(text_t *text, world_t *world)
{
    world->exposure = text_number(text, "the exposure in stops");
    if (world->exposure < -EXPOSURE_MAX || world->exposure > EXPOSURE_MAX) {
        text_fail(text, "expected an exposure of %d to %d stops", -EXPOSURE_MAX,
                EXPOSURE_MAX);
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

static void read_mesh(text_t *text, world_t *world)
{
    const char *name = text_rest(text);
    char *path;
    FILE *file;

    if (name == NULL) {
        text_fail(text, "expected mesh FILE.obj");
    }
    path = text_beside(text->path, name);
    file = fopen(path, "rb");
    if (file == NULL) {
        cli_fail(CLI_IO, "%s:%u: cannot read the mesh '%s'", text->path,
                text->line, path);
    }
    fclose(file);
    read_obj(world, path);
    free(path);
}

static void read_key(text_t *text, world_t *world, int key)
{
    switch (key) {
    case MESH:
        read_mesh(text, world);
        break;
    case CAMERA:
        world->camera_line = text->line;
        read_camera(text, &world->camera);
        break;
    case IMAGE:
        world->width = text_integer(text, "the width", 1, QL_IMAGE_MAX);
        world->height = text_integer(text, "the height", 1, QL_IMAGE_MAX);
        break;
    case EXPOSURE:
        read_exposure(text, world);
        break;
    case LIGHTS:
        read_lights(text, world);
        break;
    default:
        text_fail(
                text, "'%s' is not supported by this version", key_names[key]);
    }
    text_finish(text);
}

void read_scene(world_t *world, text_t *text)
{
    unsigned seen = 0;

    memset(world, 0, sizeof *world);
    world->path = text->path;
    world->width = world->height = 256;
    while (text_line(text)) {
        const char *word = text_word(text);
        int key = 0;

        while (key < KEY_COUNT && strcmp(word, key_names[key]) != 0) {
            key++;
        }
        if (key == KEY_COUNT) {
            text_fail(text,
                    "expected mesh, camera, image, exposure or lights, "
                    "found '%s'",
                    word);
        }
        if (key != MESH && (seen & 1u << key) != 0) {
            text_fail(
                    text, "expected one '%s' in a scene, found a second", word);
        }
        seen |= 1u << key;
        read_key(text, world, key);
    }
    if ((seen & 1u << CAMERA) == 0) {
        text_fail(text, "expected a 'camera' line before the end of the file");
    }
    if ((seen & 1u << MESH) == 0) {
        text_fail(text, "expected a 'mesh' line before the end of the file");
    }
}
