/* read_mtl.c - materials from MTL files, and sets of names */
/* SPDX-License-Identifier: MIT */

#include "read_mtl.h"

#include <stdlib.h>
#include <string.h>

#include "alloc.h"
#include "cli.h"
#include "text.h"

bool names_add(names_t *set, const char *name)
{
    for (size_t i = 0; i < set->count; i++) {
        if (strcmp(set->names[i], name) == 0) {
            return false;
        }
    }
    set->names = alloc_grow(
            set->names, set->count, &set->capacity, sizeof *set->names);
    set->names[set->count++] = alloc_text(name, strlen(name));
    return true;
}

void names_free(names_t *set)
{
    for (size_t i = 0; i < set->count; i++) {
        free(set->names[i]);
    }
    free(set->names);
    memset(set, 0, sizeof *set);
}

/* What one material says beside its colours; it decides what is missed. */
typedef struct {
    bool specular;    /* a Ks above 0 */
    bool shininess;   /* Ns */
    bool transparent; /* d below 1, Tr above 0, Tf not white */
    bool refraction;  /* Ni */
    int64_t illum;
} extras_t;

typedef struct {
    text_t text;
    world_t *world;
    world_material_t *material; /* being read; NULL before the first newmtl */
    extras_t extras;
    names_t reported;
} reader_t;

static void report(reader_t *reader, const char *name)
{
    if (names_add(&reader->reported, name)) {
        cli_warn("%s: '%s' is not modelled", reader->text.path, name);
    }
}

/* Report what the material that ends here would have needed. Exporters write
 * Ns and Ni into every material; they matter only beside Ks or glass. */
static void end_material(reader_t *reader)
{
    static const char *const illum[] = {"illum 3", "illum 4", "illum 5",
            "illum 6", "illum 7", "illum 8", "illum 9", "illum 10"};
    const extras_t *extras = &reader->extras;

    if (extras->specular) {
        report(reader, "Ks");
        if (extras->shininess) {
            report(reader, "Ns");
        }
    }
    if (extras->illum >= 3) {
        report(reader, illum[extras->illum - 3]);
    }
    if (extras->refraction &&
            (extras->transparent || extras->illum == 6 || extras->illum == 7)) {
        report(reader, "Ni");
    }
    memset(&reader->extras, 0, sizeof reader->extras);
}

/* One or three numbers: one is grey, as the format has it. */
static void read_colour(reader_t *reader, const char *what, double colour[3])
{
    text_t *text = &reader->text;

    if (strncmp(text->rest, "xyz", 3) == 0 ||
            strncmp(text->rest, "spectral", 8) == 0) {
        text_fail(text, "expected %s as RGB numbers, found '%s'", what,
                text->rest);
    }
    colour[0] = colour[1] = colour[2] = text_number(text, what);
    if (*text->rest != '\0') {
        colour[1] = text_number(text, what);
        colour[2] = text_number(text, what);
    }
}

static void read_kd(reader_t *reader)
{
    double *kd = reader->material->kd;
    bool outside = false;

    read_colour(reader, "a colour for Kd", kd);
    for (int k = 0; k < 3; k++) {
        outside = outside || kd[k] < 0 || kd[k] > 1;
        kd[k] = kd[k] < 0 ? 0 : kd[k] > 1 ? 1 : kd[k];
    }
    if (outside) {
        cli_warn("%s:%u: Kd of '%s' clamped to 0..1", reader->text.path,
                reader->text.line, reader->material->name);
    }
}

static void read_ke(reader_t *reader)
{
    double *ke = reader->material->ke;

    read_colour(reader, "a colour for Ke", ke);
    for (int k = 0; k < 3; k++) {
        if (ke[k] < 0 || ke[k] > 1e18) {
            text_fail(&reader->text, "expected a Ke from 0 to 1e18, found %g",
                    ke[k]);
        }
    }
}

static void read_newmtl(reader_t *reader)
{
    const char *name = text_rest(&reader->text);
    size_t index;

    if (name == NULL) {
        text_fail(&reader->text, "expected newmtl NAME");
    }
    end_material(reader);
    index = world_add_material(reader->world, name, strlen(name));
    reader->material = reader->world->materials + index;
}

/* d F, d -halo F, Tr F: opacity and its opposite. */
static void read_opacity(reader_t *reader, const char *key)
{
    const double opaque = strcmp(key, "d") == 0 ? 1 : 0;

    if (strncmp(reader->text.rest, "-halo", 5) == 0) {
        (void)text_word(&reader->text);
    }
    if (text_number(&reader->text, "a number") != opaque) {
        reader->extras.transparent = true;
        report(reader, key);
    }
}

/* A key that is not modelled but belongs to the format; false if unknown. */
static bool read_extra(reader_t *reader, const char *key)
{
    double colour[3];

    if (strcmp(key, "Ks") == 0) {
        read_colour(reader, "a colour for Ks", colour);
        reader->extras.specular =
                colour[0] != 0 || colour[1] != 0 || colour[2] != 0;
    } else if (strcmp(key, "Tf") == 0) {
        read_colour(reader, "a colour for Tf", colour);
        if (colour[0] != 1 || colour[1] != 1 || colour[2] != 1) {
            report(reader, key);
        }
    } else if (strcmp(key, "Ns") == 0) {
        reader->extras.shininess = true;
    } else if (strcmp(key, "Ni") == 0) {
        reader->extras.refraction = true;
    } else if (strcmp(key, "illum") == 0) {
        reader->extras.illum =
                text_integer(&reader->text, "the illumination model", 0, 10);
    } else if (strcmp(key, "d") == 0 || strcmp(key, "Tr") == 0) {
        read_opacity(reader, key);
    } else {
        return false;
    }
    return true;
}

static void read_key(reader_t *reader, const char *key)
{
    if (strcmp(key, "newmtl") == 0) {
        read_newmtl(reader);
    } else if (reader->material == NULL) {
        text_fail(&reader->text, "expected newmtl NAME, found '%s'", key);
    } else if (strcmp(key, "Kd") == 0) {
        read_kd(reader);
    } else if (strcmp(key, "Ke") == 0) {
        read_ke(reader);
    } else if (!read_extra(reader, key) && strcmp(key, "Ka") != 0) {
        report(reader, key);
    }
}

void read_mtl(world_t *world, const char *path)
{
    reader_t reader = {0};

    reader.world = world;
    text_open(&reader.text, path);
    while (text_line(&reader.text)) {
        read_key(&reader, text_word(&reader.text));
    }
    end_material(&reader);
    names_free(&reader.reported);
    text_close(&reader.text);
}
