/* read_scene.c - the .scene text and the meshes it names */
/* SPDX-License-Identifier: MIT */

#include "scene/read/read_scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"
#include "lib/program/alloc.h"
#include "scene/crease/crease.h"
#include "scene/read/read_obj.h"
#include "scene/sky/read_sky.h"
#include "scene/read/read_table.h"
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

static void check_camera(const text_t *text, const world_camera_t *camera)
{
    const soft_vec_t up = soft_vec_from(camera->up);
    const soft_vec_t view = soft_vec_sub(
            soft_vec_from(camera->look), soft_vec_from(camera->eye));
    const soft_vec_t side = soft_vec_cross(view, up);
    soft_t least = soft_mul(soft_vec_dot(view, view), soft_vec_dot(up, up));

    if (soft_vec_dot(view, view).m == 0) {
        text_fail(text, "expected camera 'eye' and 'look' at different points");
    }
    if (soft_vec_dot(up, up).m == 0) {
        text_fail(text, "expected camera 'up' that is not 0 0 0");
    }
    least.e -= 40; /* sin^2 of the angle: a millionth, squared */
    if (soft_compare(soft_vec_dot(side, side), least) <= 0) {
        text_fail(text, "expected camera 'up' not parallel to the view");
    }
}

static void read_camera(text_t *text, world_t *world)
{
    world_camera_t *camera = &world->camera;
    const named_t values[] = {{"eye", camera->eye, 3, "three coordinates"},
            {"look", camera->look, 3, "three coordinates"},
            {"up", camera->up, 3, "three coordinates"},
            {"fov", &camera->fov, 1, "the field of view in degrees"}};
    unsigned seen;

    world->camera_line = text->line;
    camera->up[0] = camera->up[2] = 0;
    camera->up[1] = 1;
    seen = read_named(text, values, 4);
    if ((seen | 4u) != 15) { /* all but up */
        text_fail(text, "expected camera eye X Y Z look X Y Z [up X Y Z] "
                        "fov DEGREES");
    }
    if (!(camera->fov > 0 && camera->fov < 180)) {
        text_fail(text, "expected a fov above 0 and below 180 degrees");
    }
    check_camera(text, camera);
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

static void read_mesh(text_t *text, world_t *world)
{
    char *name = text_rest(text);
    char *path;

    while (name != NULL && !is_readable(text, name) && text_cut_comment(name)) {
    }
    if (name == NULL || *name == '\0') {
        text_fail(text, "expected mesh FILE.obj");
    }
    path = find_path(text, "mesh", name);
    read_obj(world, path);
    free(path);
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

/* X Y Z radius R material NAME; the name may hold blanks. */
static void read_sphere(text_t *text, world_t *world)
{
    static const char form[] = "sphere X Y Z radius R material NAME";
    world_sphere_t *sphere = world_add_sphere(world);
    const char *word;

    read_vector(text, "three coordinates", sphere->centre);
    word = text_word(text);
    if (word == NULL || strcmp(word, "radius") != 0) {
        text_fail(text, "expected %s", form);
    }
    sphere->radius = text_number(text, "the radius");
    if (!(sphere->radius > 0)) {
        text_fail(text, "expected a radius above 0");
    }
    word = text_word(text);
    if (word == NULL || strcmp(word, "material") != 0 ||
            (word = text_rest(text)) == NULL) {
        text_fail(text, "expected %s", form);
    }
    sphere->name = alloc_text(word, strlen(word));
    sphere->line = text->line;
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

/* The keys of the language. */
enum { MESH, CAMERA, KEY_COUNT = 10 };

static const struct {
    const char *name;
    void (*read)(text_t *, world_t *);
    bool repeats; /* a scene may have several */
} keys[KEY_COUNT] = {
        [MESH] = {"mesh", read_mesh, true},
        [CAMERA] = {"camera", read_camera, false},
        {"image", read_size, false},
        {"exposure", read_exposure, false},
        {"lights", read_lights, false},
        {"smooth", read_smooth, false},
        {"lens", read_lens, false},
        {"sky", read_sky_line, false},
        {"sphere", read_sphere, true},
        {"table", read_table_file, true},
};

/* Read a line; seen has a bit for each key that was there before. */
static void read_line(text_t *text, world_t *world, unsigned *seen)
{
    const char *word = text_word(text);
    int key = 0;

    while (key < KEY_COUNT && strcmp(word, keys[key].name) != 0) {
        key++;
    }
    if (key == KEY_COUNT) {
        text_fail(text,
                "expected mesh, camera, lens, image, sky, sphere, lights, "
                "smooth, exposure or table, found '%s'",
                word);
    }
    if (!keys[key].repeats && (*seen & 1u << key) != 0) {
        text_fail(text, "expected one '%s' in a scene, found a second", word);
    }
    *seen |= 1u << key;
    keys[key].read(text, world);
    text_finish(text);
}

/* 1 + the last material of a name that a library defines, or else of that name
 * but for a comment; 0 if there is none. */
static size_t find_material(const world_t *world, const char *name)
{
    size_t found = 0;
    bool exact = false;

    for (size_t m = 0; m < world->material_count; m++) {
        const world_material_t *material = world->materials + m;
        const bool same = strcmp(material->name, name) == 0;

        if (material->defined &&
                (same || (!exact && text_is_same_name(material->name, name)))) {
            found = m + 1;
            exact = same;
        }
    }
    return found;
}

/* Materials may be defined after the spheres made of them. The last definition
 * of a name counts. */
static void resolve_spheres(world_t *world, text_t *text)
{
    for (size_t i = 0; i < world->sphere_count; i++) {
        world_sphere_t *sphere = world->spheres + i;
        size_t m = find_material(world, sphere->name);

        while (m == 0 && text_cut_comment(sphere->name)) {
            m = find_material(world, sphere->name);
        }
        if (m == 0) {
            text->line = sphere->line;
            text_fail(text,
                    "expected a material that a mesh's mtllib defines, found "
                    "'%s'",
                    sphere->name);
        }
        sphere->material = (uint32_t)(m - 1);
    }
}

void read_scene(world_t *world, text_t *text)
{
    static const char *const names[] = {"mesh", "sphere", NULL};
    unsigned seen = 0;

    text->whole = names;
    memset(world, 0, sizeof *world);
    world->path = text->path;
    world->width = world->height = 256;
    while (text_line(text)) {
        read_line(text, world, &seen);
    }
    if ((seen & 1u << CAMERA) == 0) {
        text_fail(text, "expected a 'camera' line before the end of the file");
    }
    if ((seen & 1u << MESH) == 0) {
        text_fail(text, "expected a 'mesh' line before the end of the file");
    }
    resolve_spheres(world, text);
    crease_world(world);
}
