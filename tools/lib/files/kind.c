/* kind.c - what a file is that is not what a program wants, and what to do */
/* SPDX-License-Identifier: MIT */

#include "lib/files/kind.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "lib/program/cli.h"

#define STL_HEADER   80 /* bytes; then the number of triangles */
#define STL_TRIANGLE 50 /* bytes */
#define HEAD_BYTES   65536

/* A file as it begins. */
typedef struct {
    const char *path;
    const char *data;
    size_t size;
} head_t;

/* A format: its name, and what it is. */
typedef struct {
    const char *begins; /* contents, or the end of a name */
    const char *name;
    kind_t kind;
} format_t;

/* The first that fits counts. */
static const format_t contents[] = {
        {"qlux-dump", "the dump of a blob", KIND_DUMP},
        {"QLUX", "a blob", KIND_BLOB}, {"QLS", "a sum file", KIND_SUMS},
        {"scene,core,", "a table of qlux-trade", KIND_TABLE},
        {"\x89PNG", "a PNG picture", KIND_PICTURE},
        {"P6", "a PPM picture", KIND_PICTURE},
        {"PF", "a PFM picture", KIND_PFM}, {"Pf", "a PFM picture", KIND_PFM},
        {"#?RADIANCE", "a Radiance picture", KIND_RADIANCE},
        {"#?RGBE", "a Radiance picture", KIND_RADIANCE},
        {"\xff\xd8\xff", "a JPEG picture", KIND_OTHER_PICTURE},
        {"GIF8", "a GIF picture", KIND_OTHER_PICTURE},
        {"RIFF", "a WebP picture", KIND_OTHER_PICTURE},
        {"v/1\x01", "an OpenEXR picture", KIND_OTHER_PICTURE},
        {"II*", "a TIFF picture", KIND_OTHER_PICTURE},
        {"P3", "a PPM picture in letters", KIND_OTHER_PICTURE},
        {"P5", "a grey PGM picture", KIND_OTHER_PICTURE},
        {"ply", "a PLY mesh", KIND_OTHER_MODEL},
        {"solid", "an STL mesh", KIND_OTHER_MODEL},
        {"OFF", "an OFF mesh", KIND_OTHER_MODEL},
        {"glTF", "a glTF mesh", KIND_OTHER_MODEL},
        {"Kaydara FBX", "an FBX scene", KIND_OTHER_MODEL},
        {"BLENDER", "a Blender scene", KIND_OTHER_MODEL},
        {"\x28\xb5\x2f\xfd", "compressed by zstd, as Blender's scenes are",
                KIND_OTHER_MODEL},
        {"#usda", "a USD scene", KIND_OTHER_MODEL},
        {"PXR-USDC", "a USD scene", KIND_OTHER_MODEL},
        {"ISO-10303-21", "a STEP model", KIND_OTHER_MODEL},
        {"PK\3\4", "a zip archive", KIND_PACKED},
        {"\x1f\x8b", "compressed by gzip", KIND_PACKED},
        {"\xff\xfe", "text in UTF-16", KIND_OTHER_TEXT},
        {"\xfe\xff", "text in UTF-16", KIND_OTHER_TEXT}};

static const format_t names[] = {{".scene", "a scene", KIND_SCENE},
        {".obj", "an OBJ mesh", KIND_OBJ}, {".mtl", "an MTL library", KIND_MTL},
        {".qlb", "a blob by its name", KIND_BLOB},
        {".qls", "a sum file by its name", KIND_SUMS},
        {".gltf", "a glTF mesh", KIND_OTHER_MODEL},
        {".stl", "an STL mesh", KIND_OTHER_MODEL},
        {".dae", "a COLLADA scene", KIND_OTHER_MODEL},
        {".3ds", "a 3DS scene", KIND_OTHER_MODEL},
        {".bmp", "a BMP picture", KIND_OTHER_PICTURE}};

static const format_t stl = {"", "an STL mesh", KIND_OTHER_MODEL};
static const format_t scene = {"", "a scene", KIND_SCENE};
static const format_t obj = {"", "an OBJ mesh", KIND_OBJ};
static const format_t mtl = {"", "an MTL library", KIND_MTL};

/* ---- what it is ---- */

/* Does the file consist of a header and as many triangles as it says? */
static bool is_binary_stl(const head_t *head)
{
    uint64_t count = 0;

    if (head->size < STL_HEADER + 4) {
        return false;
    }
    for (int i = 3; i >= 0; i--) {
        count = count << 8 | (unsigned char)head->data[STL_HEADER + i];
    }
    return count * STL_TRIANGLE == head->size - STL_HEADER - 4;
}

/* Do the bytes begin so? Letters do only if the word ends there, but for the
 * magic of our own files and of some pictures, which versions follow. */
static bool has_beginning(const head_t *head, size_t from, const char *begins)
{
    const size_t length = strlen(begins), size = head->size - from;
    const char *data = head->data + from;

    return size >= length && strncasecmp(data, begins, length) == 0 &&
           (!isalpha((unsigned char)begins[0]) ||
                   !isalpha((unsigned char)begins[length - 1]) ||
                   size == length || !isalpha((unsigned char)data[length]));
}

/* Does a line begin with a word, and go on with one of two others? */
static bool has_line(const head_t *head, const char *word, const char *or_this,
        const char *or_that)
{
    const size_t length = strlen(word);

    for (size_t i = 0; i + length < head->size; i++) {
        const char *at = head->data + i;
        size_t next = i + length;

        if ((i > 0 && at[-1] != '\n' && at[-1] != '\r') ||
                memcmp(at, word, length) != 0) {
            continue;
        }
        while (next < head->size &&
                (head->data[next] == ' ' || head->data[next] == '\t')) {
            next++;
        }
        if (next > i + length && (has_beginning(head, next, or_this) ||
                                         has_beginning(head, next, or_that))) {
            return true;
        }
    }
    return false;
}

/* Of texts: a scene has a camera, a library materials, a mesh vertices. */
static const format_t *find_text(const head_t *head)
{
    for (size_t i = 0; i < head->size; i++) {
        if (head->data[i] == '\0') {
            return NULL;
        }
    }
    if (has_line(head, "camera", "eye", "look") ||
            has_line(head, "camera", "fov", "up")) {
        return &scene;
    }
    for (size_t i = 0; i + 7 < head->size; i++) {
        if ((i == 0 || head->data[i - 1] == '\n') &&
                memcmp(head->data + i, "newmtl ", 7) == 0) {
            return &mtl;
        }
        if ((i == 0 || head->data[i - 1] == '\n') &&
                memcmp(head->data + i, "v ", 2) == 0) {
            return &obj;
        }
    }
    return NULL;
}

static const format_t *find_format(const head_t *head)
{
    const size_t length = strlen(head->path);
    const format_t *found = is_binary_stl(head) ? &stl : NULL;
    size_t blanks = 0;

    while (blanks < head->size && isspace((unsigned char)head->data[blanks])) {
        blanks++;
    }
    for (size_t i = 0; found == NULL && i < sizeof contents / sizeof *contents;
            i++) {
        found = has_beginning(head, blanks, contents[i].begins) ? contents + i
                                                                : NULL;
    }
    found = found != NULL ? found : find_text(head);
    for (size_t i = 0; found == NULL && i < sizeof names / sizeof *names; i++) {
        const size_t end = strlen(names[i].begins);

        if (length > end &&
                strcasecmp(head->path + length - end, names[i].begins) == 0) {
            found = names + i;
        }
    }
    return found;
}

/* ---- what to do ---- */

static const char *const wishes[] = {[KIND_SCENE] = "a .scene or an OBJ",
        [KIND_MODEL] = "OBJ or MTL",
        [KIND_SKY] = "a PFM or a Radiance picture (.hdr)",
        [KIND_TEXT] = "a text file",
        [KIND_BLOB] = "a blob",
        [KIND_SUMS] = "sums",
        [KIND_PICTURE] = "a PPM, PFM or PNG picture",
        [KIND_STREAM] = "what a board sends",
        [KIND_TABLE] = "a table of tools/trade/trade.sh"};

/* Is it what is wanted, or does it serve? */
static bool serves(kind_t kind, kind_t wanted)
{
    return kind == wanted ||
           (wanted == KIND_SCENE && (kind == KIND_OBJ || kind == KIND_DUMP)) ||
           (wanted == KIND_MODEL && (kind == KIND_OBJ || kind == KIND_MTL)) ||
           (wanted == KIND_PICTURE && kind == KIND_PFM) ||
           (wanted == KIND_SKY && (kind == KIND_PFM || kind == KIND_RADIANCE));
}

/* A command that makes what is wanted: before the file's name, behind it comes
 * -o, the name with another end, and what that does. NULL: no output. */
static const struct {
    kind_t wanted, kind;
    const char *command, *end, *does;
} commands[] = {{KIND_BLOB, KIND_SCENE, "qlux-scene ", ".qlb", ""},
        {KIND_BLOB, KIND_OBJ, "qlux-scene ", ".qlb", ""},
        {KIND_BLOB, KIND_DUMP, "qlux-scene ", ".qlb", ""},
        {KIND_BLOB, KIND_SUMS, "qlux-merge ", ".png", " makes a picture of it"},
        {KIND_SCENE, KIND_BLOB, "qlux-sim ", ".png",
                " draws it, and qlux-scene --info tells of it"},
        {KIND_SCENE, KIND_MTL, NULL, NULL, "give the OBJ that names it"},
        {KIND_PICTURE, KIND_BLOB, "qlux-sim ", ".png", " draws it"},
        {KIND_PICTURE, KIND_SUMS, "qlux-merge ", ".png",
                " makes a picture of it"},
        {KIND_PICTURE, KIND_SCENE, "qlux-scene ", ".qlb",
                ", then qlux-sim draws it"},
        {KIND_PICTURE, KIND_OBJ, "qlux-scene ", ".qlb",
                ", then qlux-sim draws it"},
        {KIND_PICTURE, KIND_OTHER_PICTURE, "magick ", ".png", NULL},
        {KIND_PICTURE, KIND_RADIANCE, "magick ", ".pfm", NULL},
        {KIND_SKY, KIND_OTHER_PICTURE, "oiiotool ", ".hdr", ""},
        {KIND_SKY, KIND_PICTURE, "oiiotool ", ".hdr", ""},
        {KIND_SUMS, KIND_BLOB, "qlux-sim ", ".png --save-sums x.qls", ""},
        {KIND_SUMS, KIND_UNKNOWN, NULL, NULL,
                "qlux-sim --save-sums writes them"}};

static const char *find_advice(kind_t kind)
{
    return kind == KIND_OTHER_MODEL  ? "; Blender or MeshLab converts meshes"
           : kind == KIND_PACKED     ? "; unpack it"
           : kind == KIND_OTHER_TEXT ? "; save it as UTF-8"
                                     : "";
}

/* Where the name ends without what says its kind. */
static int find_stem(const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *dot = strrchr(slash != NULL ? slash : path, '.');

    return (int)(dot != NULL && dot != path ? (size_t)(dot - path)
                                            : strlen(path));
}

void kind_refuse(const char *path, const void *data, size_t size, kind_t wanted)
{
    const head_t head = {path, data, size};
    const format_t *format = find_format(&head);

    if (format == NULL || serves(format->kind, wanted)) {
        return;
    }
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
        if (commands[i].wanted != wanted || commands[i].kind != format->kind) {
            continue;
        }
        if (commands[i].command == NULL) {
            cli_fail(CLI_INPUT, "%s: this is %s; expected %s: %s", path,
                    format->name, wishes[wanted], commands[i].does);
        }
        cli_fail(CLI_INPUT, "%s: this is %s; expected %s: %s%s %s%.*s%s%s",
                path, format->name, wishes[wanted], commands[i].command, path,
                commands[i].does != NULL ? "-o " : "", find_stem(path), path,
                commands[i].end,
                commands[i].does != NULL ? commands[i].does : "");
    }
    cli_fail(CLI_INPUT, "%s: this is %s; expected %s%s", path, format->name,
            wishes[wanted], find_advice(format->kind));
}

void kind_refuse_file(const char *path, kind_t wanted)
{
    static char data[HEAD_BYTES];
    struct stat status;
    FILE *file;
    size_t size;

    if (stat(path, &status) != 0 || !S_ISREG(status.st_mode) ||
            (file = fopen(path, "rb")) == NULL) {
        return;
    }
    size = fread(data, 1, sizeof data, file);
    fclose(file);
    kind_refuse(path, data, size, wanted);
}
