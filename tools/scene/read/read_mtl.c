/* read_mtl.c - materials from MTL files */
/* SPDX-License-Identifier: MIT */

#include "scene/read/read_mtl.h"

#include <stdio.h>
#include <string.h>

#include "lib/math/soft.h"
#include "lib/program/cli.h"
#include "lib/program/names.h"
#include "scene/ql_blob.h"
#include "scene/read/text.h"
#include "scene/world/reflectance.h"

#define NS_MOST  65535
#define NI_LEAST 0.0625
#define NI_MOST  64
#define KS_MOST  1e6 /* Kd + Ks above 1 is scaled */

/* What one material says beside its colours; it decides what it becomes. */
typedef struct {
    bool exponent; /* it has Ns */
    unsigned ni_line;
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

static bool is_black(const double colour[3])
{
    return colour[0] == 0 && colour[1] == 0 && colour[2] == 0;
}

/* Ks as the illumination model has it. */
static void end_specular(reader_t *reader)
{
    world_material_t *material = reader->material;
    const int64_t illum = reader->extras.illum;

    if (illum == 0 || illum == 1) {
        if (names_add(&reader->reported, "Ks of illum 0 and 1")) {
            cli_warn("%s: Ks of '%s' is not used, for its illum is %d",
                    reader->text.path, material->name, (int)illum);
        }
        return;
    }
    material->kind =
            illum == 3 || illum == 5 ? QL_GLOSS_MIRROR : QL_GLOSS_PHONG;
    if (material->kind == QL_GLOSS_PHONG && !reader->extras.exponent) {
        cli_warn("%s: '%s' has a Ks and no Ns: it is 0", reader->text.path,
                material->name);
    }
    if (reflectance_is_excess(material)) {
        cli_warn("%s: Kd + Ks of '%s' is above 1: both scaled by %.4g",
                reader->text.path, material->name,
                soft_double(reflectance_scale(material)));
    }
}

static void end_glass(reader_t *reader)
{
    world_material_t *material = reader->material;

    if (material->ni < NI_LEAST || material->ni > NI_MOST) {
        reader->text.line = reader->extras.ni_line;
        text_fail(&reader->text,
                "expected a Ni of glass from 1/16 to 64, "
                "found %g",
                material->ni);
    }
    material->kind = QL_GLOSS_GLASS;
}

/* All is known of the material: decide what it is, report what it is not. */
static void end_material(reader_t *reader)
{
    static const char *const illum[] = {"illum 4", "illum 5", "illum 6",
            "illum 7", "illum 8", "illum 9", "illum 10"};
    const world_material_t *material = reader->material;
    const int64_t model = reader->extras.illum;

    if (material == NULL) {
        return;
    }
    if (model == 4 || model == 6 || model >= 8) {
        report(reader, illum[model - 4]);
    }
    if (model == 7) {
        end_glass(reader);
    } else {
        if (!is_black(material->ks)) {
            end_specular(reader);
        }
        if (material->filter[0] != 1 || material->filter[1] != 1 ||
                material->filter[2] != 1) {
            report(reader, "Tf");
        }
    }
}

/* One or three numbers: one is grey, as the format has it. */
static void read_colour(reader_t *reader, const char *key, double colour[3])
{
    text_t *text = &reader->text;
    char what[32];

    (void)snprintf(what, sizeof what, "a colour for %s", key);
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

/* A colour of which each channel is clamped to 0..most. */
static void read_clamped(
        reader_t *reader, const char *key, double colour[3], double most)
{
    bool outside = false;

    read_colour(reader, key, colour);
    for (int k = 0; k < 3; k++) {
        outside = outside || colour[k] < 0 || colour[k] > most;
        colour[k] = colour[k] < 0 ? 0 : colour[k] > most ? most : colour[k];
    }
    if (outside) {
        cli_warn("%s:%u: %s of '%s' clamped to 0..%g", reader->text.path,
                reader->text.line, key, reader->material->name, most);
    }
}

static void read_kd(reader_t *reader, const char *key)
{
    read_clamped(reader, key, reader->material->kd, 1);
}

static void read_ks(reader_t *reader, const char *key)
{
    read_clamped(reader, key, reader->material->ks, KS_MOST);
}

static void read_tf(reader_t *reader, const char *key)
{
    read_clamped(reader, key, reader->material->filter, 1);
}

static void read_ke(reader_t *reader, const char *key)
{
    double *ke = reader->material->ke;

    read_colour(reader, key, ke);
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
    reader->material->defined = true;
    memset(&reader->extras, 0, sizeof reader->extras);
    reader->extras.illum = -1; /* not said */
}

/* d F, d -halo F, Tr F: opacity and its opposite. */
static void read_opacity(reader_t *reader, const char *key)
{
    const double opaque = strcmp(key, "d") == 0 ? 1 : 0;

    if (strncmp(reader->text.rest, "-halo", 5) == 0) {
        (void)text_word(&reader->text);
    }
    if (text_number(&reader->text, "a number") != opaque) {
        report(reader, key);
    }
}

static void read_exponent(reader_t *reader, const char *key)
{
    world_material_t *material = reader->material;
    const double ns = text_number(&reader->text, "the exponent Ns");

    material->ns = ns < 0 ? 0 : ns > NS_MOST ? NS_MOST : ns;
    if (material->ns != ns) {
        cli_warn("%s:%u: %s of '%s' clamped to 0..%d", reader->text.path,
                reader->text.line, key, material->name, NS_MOST);
    }
    reader->extras.exponent = true;
}

static void read_index(reader_t *reader, const char *key)
{
    (void)key;
    reader->material->ni =
            text_number(&reader->text, "the index of refraction Ni");
    reader->extras.ni_line = reader->text.line;
}

static void read_illum(reader_t *reader, const char *key)
{
    (void)key;
    reader->extras.illum =
            text_integer(&reader->text, "the illumination model", 0, 10);
}

/* Ambient light is what a path tracer computes. */
static void leave_out(reader_t *reader, const char *key)
{
    (void)reader;
    (void)key;
}

static void read_key(reader_t *reader, const char *key)
{
    static const struct {
        const char *name;
        void (*read)(reader_t *, const char *);
    } keys[] = {{"Kd", read_kd}, {"Ks", read_ks}, {"Tf", read_tf},
            {"Ke", read_ke}, {"Ns", read_exponent}, {"Ni", read_index},
            {"illum", read_illum}, {"d", read_opacity}, {"Tr", read_opacity},
            {"Ka", leave_out}};

    if (strcmp(key, "newmtl") == 0) {
        read_newmtl(reader);
        return;
    }
    if (reader->material == NULL) {
        text_fail(&reader->text, "expected newmtl NAME, found '%s'", key);
    }
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        if (strcmp(key, keys[i].name) == 0) {
            keys[i].read(reader, key);
            return;
        }
    }
    report(reader, key);
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
