/* scene_main.c - qlux-scene: compile scenes into blobs, show blobs */
/* SPDX-License-Identifier: MIT */

/* The folders beside this file, in the order in which a scene passes through
 * them; each includes only itself and those before it:
 *
 *     world   a scene as its files describe it
 *     read    texts to a world
 *     mesh    a world on its grid, smooth corners, the tree
 *     blob    a model and its bytes, a model and its text
 *     build   a world on its grid to a model
 */

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"
#include "lib/render/open_blob.h"
#include "scene/blob/dump_blob.h"
#include "scene/blob/model.h"
#include "scene/blob/parse_dump.h"
#include "scene/blob/read_blob.h"
#include "scene/blob/write_blob.h"
#include "scene/build/compile.h"
#include "scene/read/read_scene.h"
#include "scene/scene_features.h"
#include "scene/scene_info.h"

static const char help[] =
        "qlux-scene - compile a scene into a blob, show and edit blobs\n"
        "\n"
        "  qlux-scene IN.scene -o OUT.qlb [options]   compile\n"
        "  qlux-scene --info BLOB.qlb                 say what is in a blob\n"
        "  qlux-scene --dump BLOB.qlb [-o TEXT]       all of it as text\n"
        "  qlux-scene TEXT -o OUT.qlb                 and back, bit by bit\n"
        "\n"
        "  --node-bits 8|16    16: fast, the default; 8: small\n"
        "  --leaf N            most triangles in a leaf, 1 to 13, with 8-bit "
        "nodes\n"
        "                      to 12; default 4\n"
        "  --features FILE.h   write the gates of a core for this scene\n"
        "  --quiet             no progress bar, no summary\n"
        "\n"
        "Exit: 0 done, 1 wrong usage, 2 bad input, 3 could not read or write.\n"
        "\n"
        "Example: qlux-scene tests/scenes/cornell.scene -o cornell.qlb\n";

typedef struct {
    const char *input;
    const char *output;   /* -o */
    const char *features; /* --features */
    unsigned node_bits;
    unsigned leaf_max;
    bool info, dump, quiet;
    bool compiles; /* an option was given that only compiling has */
} options_t;

static const char *next_argument(int *i, int argc, char **argv)
{
    const char *option = argv[*i];

    *i += *i + 1 < argc;
    return cli_text(option, argv[*i] != option ? argv[*i] : NULL);
}

/* Take the option at argv[*i] and its value. */
static void parse_option(options_t *options, int *i, int argc, char **argv)
{
    static const char *const widths[] = {"8", "16", NULL};
    const char *name = argv[*i];

    if (strcmp(name, "-o") == 0) {
        options->output = next_argument(i, argc, argv);
    } else if (strcmp(name, "--node-bits") == 0) {
        options->node_bits =
                cli_choice(name, next_argument(i, argc, argv), widths) == 0
                        ? 8
                        : 16;
        options->compiles = true;
    } else if (strcmp(name, "--leaf") == 0) {
        options->leaf_max = (unsigned)cli_number(
                name, next_argument(i, argc, argv), 1, QL_LEAF_MAX);
        options->compiles = true;
    } else if (strcmp(name, "--features") == 0) {
        options->features = next_argument(i, argc, argv);
    } else if (strcmp(name, "--info") == 0) {
        options->info = true;
    } else if (strcmp(name, "--dump") == 0) {
        options->dump = true;
    } else if (strcmp(name, "--quiet") == 0) {
        options->quiet = true;
    } else {
        cli_fail(CLI_USAGE, "unknown option '%s'; try --help", name);
    }
}

static void check_options(const options_t *options)
{
    const bool shows = options->info || options->dump;

    if (options->input == NULL) {
        cli_fail(CLI_USAGE, "expected an input file; try --help");
    }
    if (options->info && options->dump) {
        cli_fail(CLI_USAGE, "expected --info or --dump, not both");
    }
    if (!shows && options->output == NULL) {
        cli_fail(CLI_USAGE, "expected -o OUT.qlb; try --help");
    }
    if (options->node_bits == 8 && options->leaf_max > COMPILE_LEAF8_MAX) {
        cli_fail(CLI_USAGE,
                "--leaf: expected 1 to %d with 8-bit nodes, found "
                "%u",
                COMPILE_LEAF8_MAX, options->leaf_max);
    }
    if (shows && (options->compiles || options->features != NULL ||
                         (options->info && options->output != NULL))) {
        cli_fail(CLI_USAGE, "%s takes a blob and no option of compiling",
                options->info ? "--info" : "--dump");
    }
}

static options_t parse_options(int argc, char **argv)
{
    options_t options = {NULL, NULL, NULL, 16, 4, false, false, false, false};

    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
            fputs(help, stdout);
            exit(CLI_DONE);
        } else if (argv[i][0] == '-' && argv[i][1] != '\0') {
            parse_option(&options, &i, argc, argv);
        } else if (options.input == NULL) {
            options.input = argv[i];
        } else {
            cli_fail(CLI_USAGE, "expected one input file, found '%s' too",
                    argv[i]);
        }
    }
    check_options(&options);
    return options;
}

static void compile(model_t *model, text_t *text, const options_t *options)
{
    const compile_options_t how = {
            options->node_bits, options->leaf_max, options->quiet};
    world_t world;

    read_scene(&world, text);
    compile_scene(model, &world, &how);
    world_free(&world);
}

static void write_output(const model_t *model, const options_t *options)
{
    size_t size;
    uint8_t *blob = write_blob(model, &size);
    cli_out_t out, features;
    ql_scene_t scene;
    char name[512];

    snprintf(name, sizeof name, "the blob of %s", options->input);
    open_blob_bytes(&scene, blob, size, name);
    cli_out_open(&out, options->output);
    (void)fwrite(blob, 1, size, out.file);
    if (options->features != NULL) {
        cli_out_open(&features, options->features);
        write_features(features.file, model);
        cli_out_commit(&features);
    }
    cli_out_commit(&out);
    if (!options->quiet) {
        printf("%s: %" PRIu32 " triangles, ", options->output,
                model->triangles_count - model->spheres_count);
        if (model->spheres_count > 0) {
            printf("%" PRIu32 " spheres, ", model->spheres_count);
        }
        printf("%" PRIu32 " lights, %zu bytes\n", model->lights_count, size);
    }
    free(blob);
}

/* A scene, or the dump of a blob, to a blob. */
static void make_blob(const options_t *options)
{
    model_t model;
    text_t text;

    text_open(&text, options->input);
    if (is_dump(&text)) {
        if (options->compiles) {
            cli_fail(CLI_USAGE,
                    "--node-bits and --leaf are for scenes; '%s' "
                    "is the dump of a blob",
                    options->input);
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
    options_t options;

    cli_begin("qlux-scene");
    options = parse_options(argc, argv);
    if (options.info || options.dump) {
        show_blob(&options);
    } else {
        make_blob(&options);
    }
    return CLI_DONE;
}
