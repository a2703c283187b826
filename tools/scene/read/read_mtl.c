/* read_mtl.c - materials from MTL files */
/* SPDX-License-Identifier: MIT */

#include "scene/read/read_mtl.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "lib/math/soft.h"
#include "lib/program/alloc.h"
#include "scene/ql_blob.h"
#include "scene/foreign/notes.h"
#include "scene/read/text.h"
#include "scene/world/reflectance.h"

#define NS_MOST  65535
#define NI_LEAST 0.0625
#define NI_MOST  64
#define KS_MOST  1e6 /* Kd + Ks above 1 is scaled */

#define MAKE_GLASS "opaque; illum 7 makes it glass"

/* What one material says beside its colours; it decides what it becomes. Lines
 * are 0 if it does not say it. */
typedef struct {
    unsigned ns_line, ni_line, ks_line, tf_line, illum_line;
    unsigned opacity_line; /* of what makes it less than opaque */
    const char *opacity;   /* its key */
    unsigned map_kd_line, map_ke_line;
    int64_t illum;
} extras_t;

typedef struct {
    text_t text;
    world_t *world;
    world_material_t *material; /* being read; NULL before the first newmtl */
    extras_t extras;
    notes_t notes;
    bool strict; /* a property of no numbers is an error */
} reader_t;

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
        notes_add(&reader->notes, reader->extras.ks_line, "Ks of illum 0 and 1",
                "Ks of '%s' is not used, for its illum is %d", material->name,
                (int)illum);
        return;
    }
    material->kind =
            illum == 3 || illum == 5 ? QL_GLOSS_MIRROR : QL_GLOSS_PHONG;
    if (material->kind == QL_GLOSS_PHONG && reader->extras.ns_line == 0) {
        notes_add(&reader->notes, reader->extras.ks_line, "Ks without Ns",
                "'%s' has a Ks and no Ns: it is 0", material->name);
    }
    if (reflectance_is_excess(material)) {
        notes_add(&reader->notes, reader->extras.ks_line, "Kd + Ks above 1",
                "Kd + Ks of '%s' is above 1: both scaled by %.4g",
                material->name, soft_double(reflectance_scale(material)));
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

/* Say what becomes of an illumination model that is not modelled. */
static void report_illum(reader_t *reader)
{
    const int64_t illum = reader->extras.illum;
    const char *instead = illum == 8 ? "as illum 2; illum 3 makes it a mirror"
                          : illum == 10 ? "as illum 2"
                                        : MAKE_GLASS;

    if (illum == 4 || illum == 6 || illum >= 8) {
        notes_add(&reader->notes, reader->extras.illum_line, "illum",
                "'illum %d' of '%s' is not modelled: %s", (int)illum,
                reader->material->name, instead);
    }
}

/* Say that what lets light through does not. */
static void report_opacity(reader_t *reader)
{
    const world_material_t *material = reader->material;
    const extras_t *extras = &reader->extras;
    const bool is_glass = material->kind == QL_GLOSS_GLASS;
    const double *tf = material->filter;

    if (extras->opacity_line > 0) {
        notes_add(&reader->notes, extras->opacity_line, extras->opacity,
                "'%s' of '%s' is not modelled: %s", extras->opacity,
                material->name, is_glass ? "glass of Ni and Tf" : MAKE_GLASS);
    }
    if (!is_glass && (tf[0] != 1 || tf[1] != 1 || tf[2] != 1)) {
        notes_add(&reader->notes, extras->tf_line, "Tf",
                "'Tf' of '%s' is not modelled: " MAKE_GLASS, material->name);
    }
}

/* Say which colours stand for the maps of them. */
static void report_colour_maps(reader_t *reader)
{
    const world_material_t *material = reader->material;
    const double *kd = material->kd;
    char instead[80];

    (void)snprintf(instead, sizeof instead, ": Kd %.4g %.4g %.4g is used",
            kd[0], kd[1], kd[2]);
    if (reader->extras.map_kd_line > 0) {
        notes_add(&reader->notes, reader->extras.map_kd_line, "map_Kd",
                "'map_Kd' of '%s' is not modelled%s", material->name,
                material->kind == QL_GLOSS_GLASS ? ": glass has no Kd"
                : !is_black(kd)                  ? instead
                : material->kind == 0 && is_black(material->ke)
                        ? " and its Kd is 0: the object is black"
                        : " and its Kd is 0: it has no diffuse colour");
    }
    if (reader->extras.map_ke_line > 0) {
        notes_add(&reader->notes, reader->extras.map_ke_line, "map_Ke",
                "'map_Ke' of '%s' is not modelled%s", material->name,
                is_black(material->ke) ? " and its Ke is 0: it does not shine"
                                       : ": Ke is used");
    }
}

/* All is known of the material: decide what it is, report what it is not. */
static void end_material(reader_t *reader)
{
    if (reader->material == NULL) {
        return;
    }
    if (reader->extras.illum == 7) {
        end_glass(reader);
    } else if (!is_black(reader->material->ks)) {
        end_specular(reader);
    }
    report_illum(reader);
    report_opacity(reader);
    report_colour_maps(reader);
}

/* Say that what stands in the line is not what was expected. */
static void report_no_number(
        reader_t *reader, const char *what, const char *key, const char *found)
{
    if (reader->strict) {
        text_fail(&reader->text, "expected %s for %s of '%s', found '%.80s'",
                what, key, reader->material->name, found);
    }
    notes_add(&reader->notes, reader->text.line, "properties of no numbers",
            "expected %s for %s of '%s', found '%.80s': left out", what, key,
            reader->material->name, found);
}

/* One number; false, and value is as it was, if it is none. */
static bool read_real(reader_t *reader, const char *key, double *value)
{
    char *found = alloc_text(reader->text.rest, strlen(reader->text.rest));
    const bool good = text_try_number(&reader->text, value);

    if (!good) {
        report_no_number(reader, "a number", key, found);
    }
    free(found);
    return good;
}

/* One or three numbers: one is grey, as the format has it. False, and colour is
 * as it was, if they are none. */
static bool read_colour(reader_t *reader, const char *key, double colour[3])
{
    text_t *text = &reader->text;
    char *found = alloc_text(text->rest, strlen(text->rest));
    double c[3];
    bool good = text_try_number(text, c);

    c[1] = c[2] = c[0];
    if (good && *text->rest != '\0') {
        good = text_try_number(text, c + 1) && text_try_number(text, c + 2);
    }
    if (good) {
        memcpy(colour, c, sizeof c);
    } else {
        report_no_number(reader, "a colour", key, found);
    }
    free(found);
    return good;
}

/* A colour in another space is there, so no default may stand for it. */
static void refuse_other_spaces(reader_t *reader, const char *key)
{
    const char *rest = reader->text.rest;

    if (strncmp(rest, "xyz", 3) == 0 || strncmp(rest, "spectral", 8) == 0) {
        text_fail(&reader->text,
                "expected a colour for %s as RGB numbers, found '%s'", key,
                rest);
    }
}

/* A colour of which each channel is clamped to 0..most. False if it is none. */
static bool read_clamped(
        reader_t *reader, const char *key, double colour[3], double most)
{
    bool outside = false;

    if (!read_colour(reader, key, colour)) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        outside = outside || colour[k] < 0 || colour[k] > most;
        colour[k] = colour[k] < 0 ? 0 : colour[k] > most ? most : colour[k];
    }
    if (outside) {
        notes_add(&reader->notes, reader->text.line, "clamped colours",
                "%s of '%s' clamped to 0..%g", key, reader->material->name,
                most);
    }
    return true;
}

static void read_kd(reader_t *reader, const char *key)
{
    refuse_other_spaces(reader, key);
    (void)read_clamped(reader, key, reader->material->kd, 1);
}

static void read_ks(reader_t *reader, const char *key)
{
    refuse_other_spaces(reader, key);
    if (read_clamped(reader, key, reader->material->ks, KS_MOST)) {
        reader->extras.ks_line = reader->text.line;
    }
}

static void read_tf(reader_t *reader, const char *key)
{
    if (read_clamped(reader, key, reader->material->filter, 1)) {
        reader->extras.tf_line = reader->text.line;
    }
}

static void read_ke(reader_t *reader, const char *key)
{
    double *ke = reader->material->ke;

    refuse_other_spaces(reader, key);
    (void)read_colour(reader, key, ke);
    for (int k = 0; k < 3; k++) {
        if (ke[k] < 0 || ke[k] > 1e18) {
            text_fail(&reader->text, "expected a Ke from 0 to 1e18, found %g",
                    ke[k]);
        }
    }
}

static void begin_material(reader_t *reader, const char *name)
{
    const size_t index = world_add_material(reader->world, name, strlen(name));

    reader->material = reader->world->materials + index;
    reader->material->defined = true;
    memset(&reader->extras, 0, sizeof reader->extras);
    reader->extras.illum = -1; /* not said */
}

static void read_newmtl(reader_t *reader)
{
    const char *name = text_rest(&reader->text);

    if (name == NULL) {
        notes_add(&reader->notes, reader->text.line, "newmtl without a name",
                "newmtl without a name is what usemtl without one uses");
        name = "";
    }
    end_material(reader);
    begin_material(reader, name);
}

/* d F, d -halo F, Tr F: opacity and its opposite. */
static void read_opacity(reader_t *reader, const char *key)
{
    const double opaque = strcmp(key, "d") == 0 ? 1 : 0;
    double value;

    if (strncmp(reader->text.rest, "-halo", 5) == 0) {
        (void)text_word(&reader->text);
    }
    if (read_real(reader, key, &value) && value != opaque) {
        reader->extras.opacity = key;
        reader->extras.opacity_line = reader->text.line;
    }
}

static void read_exponent(reader_t *reader, const char *key)
{
    world_material_t *material = reader->material;
    double ns;

    if (!read_real(reader, key, &ns)) {
        return;
    }
    material->ns = ns < 0 ? 0 : ns > NS_MOST ? NS_MOST : ns;
    if (material->ns != ns) {
        notes_add(&reader->notes, reader->text.line, "clamped exponents",
                "%s of '%s' clamped to 0..%d", key, material->name, NS_MOST);
    }
    reader->extras.ns_line = reader->text.line;
}

static void read_index(reader_t *reader, const char *key)
{
    if (read_real(reader, key, &reader->material->ni)) {
        reader->extras.ni_line = reader->text.line;
    }
}

static void read_illum(reader_t *reader, const char *key)
{
    char *found = alloc_text(reader->text.rest, strlen(reader->text.rest));
    double illum;

    if (text_try_number(&reader->text, &illum) && illum >= 0 && illum <= 10 &&
            illum == (int)illum) {
        reader->extras.illum = (int)illum;
        reader->extras.illum_line = reader->text.line;
    } else {
        report_no_number(reader, "an integer from 0 to 10", key, found);
    }
    free(found);
}

/* What is done instead depends on a colour, which may come later. */
static void read_map_kd(reader_t *reader, const char *key)
{
    (void)key;
    reader->extras.map_kd_line = reader->text.line;
}

static void read_map_ke(reader_t *reader, const char *key)
{
    (void)key;
    reader->extras.map_ke_line = reader->text.line;
}

/* Ambient light is what a path tracer computes. */
static void read_ka(reader_t *reader, const char *key)
{
    double unused[3];

    (void)read_colour(reader, key, unused);
}

/* Say what is done instead of what the format has beside these keys. */
static void report_other(reader_t *reader, const char *key)
{
    static const struct {
        const char *key, *instead;
    } others[] = {{"map_Ka", "nothing depends on it"}, {"map_Ks", "Ks is used"},
            {"map_Ns", "Ns is used"}, {"map_Tf", "Tf is used"},
            {"map_d", MAKE_GLASS}, {"map_Tr", MAKE_GLASS},
            {"map_opacity", MAKE_GLASS}, {"map_bump", "it has no bumps"},
            {"bump", "it has no bumps"}, {"norm", "it has no bumps"},
            {"map_norm", "it has no bumps"}, {"map_Kn", "it has no bumps"},
            {"disp", "it has no bumps"}, {"map_disp", "it has no bumps"}};

    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        if (strcasecmp(key, others[i].key) == 0) {
            notes_add(&reader->notes, reader->text.line, others[i].key,
                    "'%s' of '%s' is not modelled: %s", key,
                    reader->material->name, others[i].instead);
            return;
        }
    }
    notes_add(&reader->notes, reader->text.line, "keys that are not modelled",
            "'%s' of '%s' is not modelled: left out", key,
            reader->material->name);
}

/* Capital letters count, but in the names of maps. */
static bool is_key(const char *key, const char *name)
{
    return strcmp(key, name) == 0 ||
           (strncmp(name, "map_", 4) == 0 && strcasecmp(key, name) == 0);
}

/* Those that a line of a scene may have come first. */
enum { KEYS_OF_LINES = 7, KEYS = 12 };

static const struct {
    const char *name;
    void (*read)(reader_t *, const char *);
} keys[KEYS] = {{"Kd", read_kd}, {"Ks", read_ks}, {"Ns", read_exponent},
        {"Ke", read_ke}, {"illum", read_illum}, {"Ni", read_index},
        {"Tf", read_tf}, {"d", read_opacity}, {"Tr", read_opacity},
        {"Ka", read_ka}, {"map_Kd", read_map_kd}, {"map_Ke", read_map_ke}};

static void read_key(reader_t *reader, const char *key)
{

    if (strcmp(key, "newmtl") == 0) {
        read_newmtl(reader);
        return;
    }
    if (reader->material == NULL) {
        notes_add(&reader->notes, reader->text.line,
                "properties before the first newmtl",
                "a property before the first newmtl is of no material: left "
                "out");
        return;
    }
    for (size_t i = 0; i < KEYS; i++) {
        if (is_key(key, keys[i].name)) {
            keys[i].read(reader, keys[i].name);
            return;
        }
    }
    report_other(reader, key);
}

void read_mtl(world_t *world, const char *path)
{
    static const char *const names[] = {"newmtl", NULL};
    reader_t reader = {0};

    reader.world = world;
    reader.notes.quiet = world->quiet;
    text_open_foreign(&reader.text, path, &reader.notes, names);
    while (text_line(&reader.text)) {
        read_key(&reader, text_word(&reader.text));
    }
    end_material(&reader);
    notes_report(&reader.notes);
    text_close(&reader.text);
}

/* ---- a line of a scene ---- */

/* Where the next word of letters begins, or the end. */
static char *find_letters(char *rest)
{
    char *at = rest;

    while (*at != '\0' && !isalpha((unsigned char)*at)) {
        at += strcspn(at, " \t\v\f");
        at += strspn(at, " \t\v\f");
    }
    return at;
}

/* Read a property whose values are all that is left of the text; return its
 * bit. */
static unsigned read_property(reader_t *reader, const char *key)
{
    size_t i = 0;

    while (i < KEYS_OF_LINES && strcmp(key, keys[i].name) != 0) {
        i++;
    }
    if (i == KEYS_OF_LINES) {
        text_fail(&reader->text,
                "expected Kd, Ks, Ns, Ke, illum, Ni or Tf of '%s', found "
                "'%.80s'",
                reader->material->name, key);
    }
    keys[i].read(reader, keys[i].name);
    text_finish(&reader->text);
    return 1u << i;
}

void read_material(world_t *world, text_t *text)
{
    reader_t reader = {.world = world, .strict = true};
    const char *name = text_word(text), *key;
    unsigned seen = 0;

    if (name == NULL) {
        text_fail(text, "expected material NAME [Kd R G B] [Ks R G B] [Ns N] "
                        "[Ke R G B] [illum I] [Ni N] [Tf R G B]");
    }
    for (size_t m = 0; m < world->material_count; m++) {
        if (strcmp(world->materials[m].name, name) == 0) {
            text_fail(text,
                    "expected one material '%s' in a scene, found a "
                    "second",
                    name);
        }
    }
    reader.text = *text;
    reader.notes.path = text->path;
    reader.notes.quiet = world->quiet;
    begin_material(&reader, name);
    while ((key = text_word(&reader.text)) != NULL) {
        char *next = find_letters(reader.text.rest);
        unsigned bit;

        if (*next != '\0' && next > reader.text.rest) {
            next[-1] = '\0';
        } else if (*next != '\0') {
            text_fail(text, "expected numbers for %s of '%s', found '%.80s'",
                    key, name, next);
        }
        bit = read_property(&reader, key);
        if ((seen & bit) != 0) {
            text_fail(
                    text, "expected one %s of '%s', found a second", key, name);
        }
        seen |= bit;
        reader.text.rest = next;
    }
    end_material(&reader);
    notes_report(&reader.notes);
    (void)text_rest(text);
}
