/* scene_main.c - qlux-scene: compile scenes into blobs, show blobs */
/* SPDX-License-Identifier: MIT */

/* The folders beside this file; each includes only itself and those before it:
 *
 *     world   a scene as its files describe it
 *     fill    faces of many corners to triangles
 *     crease  normals where faces meet
 *     lamp    faces that shine together
 *     foreign what other programs leave in files, what is left out of them
 *     read    texts of meshes, materials and tables to a world
 *     script  the .scene: its lines, its own surfaces and materials
 *     mesh    a world on its grid, smooth corners, the tree
 *     bare    the .scene that an OBJ alone stands for
 *     blob    a model and its bytes, a model and its text
 *     choose  the way of finding light that a model asks for, by pilots
 *     report  what a model could not keep of a world, what sees nothing in it
 *     build   a world on its grid to a model
 */

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/program/options.h"
#include "lib/render/open_blob.h"
#include "scene/bare/bare.h"
#include "scene/blob/dump_blob.h"
#include "scene/blob/model.h"
#include "scene/blob/parse_dump.h"
#include "scene/blob/read_blob.h"
#include "scene/blob/write_blob.h"
#include "scene/build/compile.h"
#include "scene/choose/choose.h"
#include "scene/script/read_scene.h"
#include "scene/scene_features.h"
#include "scene/scene_info.h"

enum { NODES8, NODES16 }; /* --node-bits */
enum { UP_Y, UP_Z };      /* --up */

/* --direct and --lights, in the order of choice_ways. */
enum { DIRECT_AUTO, DIRECT_AREA };
enum { LIGHTS_POWER, LIGHTS_ALL, LIGHTS_CHOICES };

typedef struct {
    const char *input;
    const char *output;
    const char *features;
    const char *script; /* --write-scene */
    unsigned nodes;
    unsigned direct, lights;
    unsigned leaf_max;
    unsigned up;
    bool info, dump, quiet, floor;
} options_t;

#define AT(field) OPTION_FIELD(options_t, field)

static const char *const node_bits[] = {"8", "16", NULL};
static const char *const direct[] = {
        "auto", "area", "solid-angle", "mis", NULL};
static const char *const lights[] = {"power", "all", NULL};

static const option_t every_form[] = {
        {"FILE", OPTION_TEXT, AT(input), .required = true},
        {"-o FILE", OPTION_FILE, AT(output), .help = "the blob, or the text"},
        {"--info", OPTION_FLAG, AT(info),
                .help = "print what is in a blob as lines of \"key: value\""},
        {"--dump", OPTION_FLAG, AT(dump), .help = "all of a blob as text"},
        {"--quiet", OPTION_FLAG, AT(quiet),
                .help = "no progress bar, no summary"},
        OPTION_END};

static const option_t making_blobs[] = {
        {"--node-bits N", OPTION_WORD, AT(nodes), .words = node_bits,
                .help = "16 is fast, 8 is small"},
        {"--leaf N", OPTION_NUMBER, AT(leaf_max), .min = 1, .max = QL_LEAF_MAX,
                .help = "most triangles in a leaf; at most 12 with 8-bit "
                        "nodes"},
        {"--direct D", OPTION_WORD, AT(direct), .words = direct,
                .help = "what the blob calls auto; unless named it is what is "
                        "best for the scene, by small pictures"},
        {"--lights L", OPTION_WORD, AT(lights), .words = lights,
                .help = "likewise, with a --direct that is named"},
        {"--features FILE", OPTION_FILE, AT(features),
                .help = "write the gates of a core for this scene (.h)"},
        OPTION_END};

static const char *const ups[] = {"y", "z", NULL};

static const option_t from_objs[] = {
        {"--up AXIS", OPTION_WORD, AT(up), .words = ups,
                .help = "what is up in the OBJ"},
        {"--floor", OPTION_FLAG, AT(floor), .help = "put it on a floor"},
        {"--write-scene FILE", OPTION_FILE, AT(script),
                .help = "write the .scene that it stands for, to edit"},
        OPTION_END};

static const option_section_t sections[] = {{NULL, every_form},
        {"To make a blob:", making_blobs}, {"Of an OBJ alone:", from_objs},
        {NULL, NULL}};

static const program_t program = {.name = "qlux-scene",
        .about = "compile a scene into a blob, show and edit blobs",
        .usage = "IN.scene -o OUT.qlb [options]\tcompile\n"
                 "IN.obj -o OUT.qlb [options]\tthe same, camera and light "
                 "chosen\n"
                 "--info BLOB.qlb\tsay what is in a blob\n"
                 "--dump BLOB.qlb [-o TEXT]\tall of it as text\n"
                 "TEXT -o OUT.qlb\tand back, bit by bit",
        .sections = sections,
        .example = "qlux-scene tests/scenes/cornell.scene -o cornell.qlb"};

/* The first option given of those that only an OBJ has, or NULL. */
static const char *obj_option(void)
{
    return options_given("--up")            ? "--up"
           : options_given("--floor")       ? "--floor"
           : options_given("--write-scene") ? "--write-scene"
                                            : NULL;
}

/* The first option given of those that only compiling has, or NULL. */
static const char *compiling_option(void)
{
    return obj_option() != NULL           ? obj_option()
           : options_given("--node-bits") ? "--node-bits"
           : options_given("--leaf")      ? "--leaf"
           : options_given("--direct")    ? "--direct"
           : options_given("--lights")    ? "--lights"
           : options_given("--features")  ? "--features"
                                          : NULL;
}

static void check_options(const options_t *options)
{
    const char *shows = options->info   ? "--info"
                        : options->dump ? "--dump"
                                        : NULL;

    if (options->info && options->dump) {
        options_fail("'--info' goes without '--dump'");
    }
    if (shows == NULL && options->output == NULL) {
        options_fail("missing -o FILE");
    }
    if (options->nodes == NODES8 && options->leaf_max > COMPILE_LEAF8_MAX) {
        options_fail("'--leaf %u': expected 1 to %d with 8-bit nodes",
                options->leaf_max, COMPILE_LEAF8_MAX);
    }
    if (shows != NULL && compiling_option() != NULL) {
        options_fail("'%s' goes without '%s'", shows, compiling_option());
    }
    if (options->info && options->output != NULL) {
        options_fail("'--info' goes without '-o'");
    }
    if (options_given("--lights") && options->direct == DIRECT_AUTO) {
        options_fail("'--lights' goes with a '--direct' that is named");
    }
}

/* What messages call the blob of a scene. */
static const char *name_blob(const options_t *options)
{
    static char name[512];

    snprintf(name, sizeof name, "the blob of %s", options->input);
    return name;
}

/* Say which way of finding light is best, as named or by pilots. */
static void choose(model_t *model, const options_t *options)
{
    const soft_t untried[CHOICE_WAYS] = {{0}};

    if (options->direct == DIRECT_AUTO) {
        choose_way(model, name_blob(options), options->quiet);
    } else {
        choice_set(model,
                (options->direct - DIRECT_AREA) * LIGHTS_CHOICES +
                        options->lights,
                untried);
    }
}

static void compile(model_t *model, text_t *text, const options_t *options)
{
    const compile_options_t how = {
            .node_bits = options->nodes == NODES8 ? 8 : 16,
            .leaf_max = options->leaf_max,
            .quiet = options->quiet};
    world_t world;

    read_scene(&world, text);
    compile_scene(model, &world, &how);
    world_free(&world);
    choose(model, options);
}

/* A line that says how much is in the blob, and one about the choice. */
static void print_summary(
        const model_t *model, const options_t *options, size_t size)
{
    printf("%s: %" PRIu32 " triangles, ", options->output,
            model->triangles_count - model->spheres_count);
    if (model->spheres_count > 0) {
        printf("%" PRIu32 " spheres, ", model->spheres_count);
    }
    printf("%" PRIu32 " lights, %zu bytes\n", model->lights_count, size);
    print_choice_line(stdout, model);
}

static void write_output(const model_t *model, const options_t *options)
{
    size_t size;
    uint8_t *blob = write_blob(model, &size);
    cli_out_t out, features;
    ql_scene_t scene;

    open_blob_bytes(&scene, blob, size, name_blob(options));
    cli_out_open(&out, options->output);
    (void)fwrite(blob, 1, size, out.file);
    if (options->features != NULL) {
        cli_out_open(&features, options->features);
        write_features(features.file, model);
        cli_out_commit(&features);
    }
    cli_out_commit(&out);
    if (!options->quiet) {
        print_summary(model, options, size);
    }
    free(blob);
}

/* Print a scene that was made, each line indented. */
static void print_script(const char *script)
{
    fputs("qlux-scene: compiled as this scene:\n", stderr);
    while (*script != '\0') {
        const int length = (int)strcspn(script, "\n");

        fprintf(stderr, "    %.*s\n", length, script);
        script += length + 1; /* every line ends */
    }
}

/* Open the scene that an OBJ stands for, and tell it. */
static void open_obj(text_t *text, const options_t *options)
{
    const bare_t bare = {.path = options->input,
            .beside = options->script,
            .is_up_z = options->up == UP_Z,
            .floor = options->floor};
    char *script = bare_describe(&bare);
    cli_out_t out;

    if (!options->quiet) {
        print_script(script);
    }
    if (options->script != NULL) {
        cli_out_open(&out, options->script);
        fputs(script, out.file);
        cli_out_commit(&out);
    }
    text_of(text, options->script != NULL ? options->script : options->input,
            script);
}

static void open_input(text_t *text, const options_t *options)
{
    if (!bare_is_name(options->input)) {
        text_open(text, options->input, KIND_SCENE);
        if (!bare_is_text(text)) {
            if (obj_option() != NULL) {
                options_fail("'%s' is for an OBJ alone; %s is none",
                        obj_option(), options->input);
            }
            return;
        }
        text_close(text);
    }
    open_obj(text, options);
}

/* A scene, an OBJ, or the dump of a blob, to a blob. */
static void make_blob(const options_t *options)
{
    model_t model;
    text_t text;

    open_input(&text, options);
    if (is_dump(&text)) {
        if (compiling_option() != NULL &&
                strcmp(compiling_option(), "--features") != 0) {
            options_fail("'%s' is for scenes; %s is the dump of a blob",
                    compiling_option(), options->input);
        }
        parse_dump(&model, &text);
    } else {
        compile(&model, &text, options);
    }
    text_close(&text);
    write_output(&model, options);
    model_free(&model);
}

static void show_blob(const options_t *options)
{
    model_t model;
    cli_out_t out;

    read_blob(&model, options->input);
    if (options->info) {
        print_info(stdout, &model);
    } else if (options->output == NULL) {
        dump_blob(stdout, &model);
    } else {
        cli_out_open(&out, options->output);
        dump_blob(out.file, &model);
        cli_out_commit(&out);
    }
    model_free(&model);
}

int main(int argc, char **argv)
{
    options_t options = {.nodes = NODES16, .leaf_max = 4};

    options_parse(&program, argc, argv, &options);
    check_options(&options);
    if (options.info || options.dump) {
        show_blob(&options);
    } else {
        make_blob(&options);
    }
    return CLI_DONE;
}
