/* golden.c - checksums of pictures and parts: nothing changed by accident */
/* SPDX-License-Identifier: MIT */

/* Usage: golden print|check|some|update CHECKSUMS BLOB16 BLOB8 [SCENE.qlb ...]
 *        golden bits|tables
 *
 * BLOB16 and BLOB8 are one scene with both node widths; every further scene is
 * rendered under its own name.
 *
 * Every line of CHECKSUMS is "name crc32"; names begin with the precision and,
 * unless they are the default, the tables, so one file serves all builds. check
 * fails for a difference, for a missing line, and for a line of this build that
 * no longer means anything. some is check for a build with gates off: what the
 * build lacks is left out, and what it has must have the bits of a build that
 * has everything. update rewrites the lines of this build and keeps the others.
 * bits prints a width of nodes that the build has, tables how it names them,
 * contact the folder of blobs that it opens.
 *
 * Plain C99 and stdio: it runs wherever the core does. Numbers go into a
 * checksum as bytes of fixed order. */

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/ql_crc.h"
#include "film/ql_curve.h"
#include "math/lut/ql_lut.h"
#include "math/ql_trig.h"
#include "math/vec/ql_vec_unit.h"
#include "qlux.h"
#include "render/ql_path.h"
#include "sample/ql_hash.h"
#include "warp/lecture/ql_warp_lecture.h"
#include "warp/ql_warp_cone.h"
#include "warp/ql_warp_hemisphere.h"
#include "warp/ql_warp_lobe.h"
#include "warp/ql_warp_plane.h"
#include "warp/ql_warp_sphere.h"
#include "warp/ql_warp_spherical.h"
#include "sample/ql_sampler.h"
#include "sample/ql_sobol.h"
#include "support/built.h"

/* Other tables are other pictures. */
#define TEXT_OF(word) #word
#define TEXT(word)    TEXT_OF(word)
#if QL_CFG_TABLE_BITS == 7 && QL_CFG_TABLE_LERP
#define TABLES ""
#elif QL_CFG_TABLE_LERP
#define TABLES "-lerp-" TEXT(QL_CFG_TABLE_BITS)
#else
#define TABLES "-nearest-" TEXT(QL_CFG_TABLE_BITS)
#endif

#if QL_CFG_PRECISION == 0
#define PRECISION "draft" TABLES
#else
#define PRECISION "fine" TABLES
#endif

enum { SIZE = 32, ENTRIES_MAX = 4096, NAME_MAX_BYTES = 64, SCENES_MAX = 20 };

static bool some;      /* what the build lacks is left out */
static unsigned drawn; /* pictures */

typedef struct {
    char name[NAME_MAX_BYTES];
    uint32_t crc;
} entry_t;

static entry_t made[ENTRIES_MAX]; /* what this build makes */
static unsigned made_count;

static void add(const char *name, uint32_t crc)
{
    if (made_count == ENTRIES_MAX) {
        (void)fprintf(stderr, "golden: more than %d entries\n", ENTRIES_MAX);
        exit(2);
    }
    (void)snprintf(
            made[made_count].name, NAME_MAX_BYTES, PRECISION "/%s", name);
    made[made_count++].crc = crc;
}

static uint32_t crc_u32(uint32_t crc, uint32_t value)
{
    const uint8_t bytes[4] = {(uint8_t)value, (uint8_t)(value >> 8),
            (uint8_t)(value >> 16), (uint8_t)(value >> 24)};

    return ql_crc32(crc, bytes, sizeof bytes);
}

static uint32_t crc_vec(uint32_t crc, ql_vec3_t v)
{
    crc = crc_u32(crc, (uint32_t)v.x);
    crc = crc_u32(crc, (uint32_t)v.y);
    return crc_u32(crc, (uint32_t)v.z);
}

/* ---- Parts ------------------------------------------------------------- */

static uint32_t crc_words(const void *words, size_t count, size_t size)
{
    uint32_t crc = 0;

    for (size_t i = 0; i < count; i++) {
        crc = crc_u32(crc, size == 2 ? ((const uint16_t *)words)[i]
                                     : ((const uint32_t *)words)[i]);
    }
    return crc;
}

static void add_tables(void)
{
    add("table_sin", crc_words(ql_lut_sin, QL_SIN_CELLS + 1, 4));
    add("table_rsqrt", crc_words(ql_lut_rsqrt, QL_RSQRT_CELLS, 2));
    add("table_recip", crc_words(ql_lut_recip, QL_RECIP_CELLS, 2));
    add("table_srgb",
            crc_words(ql_lut_srgb, QL_SRGB_OCTAVES * QL_SRGB_STEPS + 1, 2));
}

/* Numbers spread over all 32 bits. */
static uint32_t spread(uint32_t i)
{
    return ql_hash32(i + 1);
}

static void add_numbers(void)
{
    uint32_t hash = 0, owen = 0, sobol = 0, sine = 0, root = 0, recip = 0;

    for (uint32_t i = 0; i < 4096; i++) {
        int32_t s, c;

        hash = crc_u32(hash, ql_hash32(i * 2654435761u));
        owen = crc_u32(owen, ql_owen_reversed(i, spread(i)));
        sobol = crc_u32(sobol, ql_sobol_1_reversed(ql_reverse32(i)));
        ql_sincos(spread(i), &s, &c);
        sine = crc_u32(crc_u32(sine, (uint32_t)s), (uint32_t)c);
        root = crc_u32(root, ql_sqrt_uq32(spread(i) >> i % 32));
        recip = crc_u32(recip, ql_recip_m(spread(i) | 0x80000000u));
    }
    add("hash32", hash);
    add("owen", owen);
    add("sobol_1", sobol);
    add("sincos", sine);
    add("sqrt", root);
    add("recip", recip);
}

static void add_samplers(void)
{
    static const char *const names[2] = {"sampler_random", "sampler_sobol"};

    for (uint8_t kind = 0; kind < 2; kind++) {
        ql_sampler_t sampler;
        uint32_t crc = 0;

        if (!BUILT_HAS_SAMPLER(kind)) {
            continue;
        }
        ql_sampler_begin(&sampler, kind, 0x12345678u, 3, 5);
        for (uint32_t i = 0; i < 1024; i++) {
            ql_uniform2_t u;

            ql_sampler_start(&sampler, i);
            u = ql_sampler_2d(&sampler, i % 17);
            crc = crc_u32(crc_u32(crc, u.u1), u.u2);
            crc = crc_u32(crc, ql_sampler_1d(&sampler, i % 19));
        }
        add(names[kind], crc);
    }
}

static void add_warps(void)
{
    const ql_vec3_t n = {
            1 << 28, -(1 << 28), 379625062}; /* (1, -1, sqrt 2)/2 */
    uint32_t sphere = 0, cosine = 0, triangle = 0, rounded = 0;

    for (uint32_t i = 0; i < 4096; i++) {
        const uint32_t u1 = spread(i), u2 = spread(~i);
        uint32_t b1, b2;

        sphere = crc_vec(sphere, ql_warp_sphere(u1, u2));
        cosine = crc_vec(cosine, ql_warp_hemisphere_cosine(n, u1, u2));
        ql_warp_plane_triangle(u1, u2, &b1, &b2);
        triangle = crc_u32(crc_u32(triangle, b1), b2);
        rounded = crc_vec(rounded, ql_vec_to_dir(ql_warp_sphere(u1, u2)));
    }
    add("warp_sphere", sphere);
    add("warp_cosine", cosine);
    add("warp_triangle", triangle);
    add("dir_round", rounded);
}

static void add_lobes(void)
{
    uint32_t uniform = 0, naive = 0, cosine = 0, power = 0, cone = 0, disk = 0;

    for (uint32_t i = 0; i < 4096; i++) {
        const uint32_t u1 = spread(i), u2 = spread(~i);
        const ql_uq16_t m = spread(i * 3) >> i % 16;
        const ql_real_t s_max = {0x80000000u | u2, -32 - (int16_t)(i % 40)};
        ql_uq31_t s;
        ql_q29_t x, y;
        ql_real_t pdf;

        uniform = crc_vec(uniform, ql_warp_hemisphere_uniform(u1, u2));
        naive = crc_vec(naive, ql_warp_lecture_naive(u1, u2));
        cosine = crc_vec(cosine, ql_warp_lecture_cosine(u1, u2));
        power = crc_vec(
                power, ql_warp_lobe(ql_warp_lobe_inverse(m), u1, u2, &s));
        pdf = ql_warp_lobe_pdf(m, s);
        power = crc_u32(crc_u32(crc_u32(power, s), pdf.m), (uint16_t)pdf.e);
        cone = crc_vec(cone, ql_warp_cone(s_max, u1, u2));
        ql_warp_plane_disk(u1, u2, &x, &y);
        disk = crc_u32(crc_u32(disk, (uint32_t)x), (uint32_t)y);
    }
    add("warp_uniform_hemisphere", uniform);
    add("warp_naive_hemisphere", naive);
    add("warp_cosine_lobe", cosine);
    add("warp_power_lobe", power);
    add("warp_cone", cone);
    add("warp_disk", disk);
}

/* Corners all around, near and far. */
static ql_vec3_t corner(uint32_t i)
{
    const ql_vec3_t v = {ql_asr32(ql_i32(spread(i)), 8 + i % 12),
            ql_asr32(ql_i32(spread(i + 1)), 8 + i % 12),
            ql_asr32(ql_i32(spread(i + 2)), 8 + i % 12)};

    return v;
}

static void add_spherical(void)
{
    uint32_t crc = 0, angle = 0;

    for (uint32_t i = 0; i < 4096; i++) {
        ql_warp_spherical_t t;

        angle = crc_u32(angle, ql_atan2(ql_i32(spread(i)), ql_i32(spread(~i))));
        if (ql_warp_spherical_begin(
                    &t, corner(9 * i), corner(9 * i + 3), corner(9 * i + 6))) {
            crc = crc_u32(crc, t.solid_angle.m);
            crc = crc_vec(crc, ql_warp_spherical(&t, spread(i), spread(~i)));
        }
    }
    add("atan2", angle);
    add("warp_spherical_triangle", crc);
}

static const char *const formats[QL_FORMAT_COUNT] = {
        "rgb888", "rgb565_le", "rgb565_be", "gray8", "gray4"};

/* Add a checksum for each format that is built in. */
static void add_formats(const char *name, const uint32_t crc[QL_FORMAT_COUNT])
{
    for (int f = 0; f < QL_FORMAT_COUNT; f++) {
        char full[NAME_MAX_BYTES];

        (void)snprintf(full, sizeof full, "%s_%s", name, formats[f]);
        if (BUILT_HAS_FORMAT(f)) {
            add(full, crc[f]);
        }
    }
}

static void add_tonemap(void)
{
    uint32_t crc[QL_FORMAT_COUNT] = {0, 0, 0, 0, 0};

    for (uint32_t i = 0; i < 2048; i++) {
        const uint32_t linear[3] = {spread(i) >> i % 20, i * 37, 70000 - i};

        for (int f = 0; f < QL_FORMAT_COUNT; f++) {
            uint8_t pixels[4] = {0, 0, 0, 0};

            if (BUILT_HAS_FORMAT(f)) {
                ql_tonemap_pixel(
                        pixels, (ql_format_t)f, 0, (uint16_t)i, linear);
            }
            crc[f] = ql_crc32(crc[f], pixels, sizeof pixels);
        }
    }
    add_formats("tonemap", crc);
}

#if QL_ROLL_OFF
static void add_curve(const char *name, ql_curve_t curve)
{
    uint32_t crc = 0;

    for (uint32_t i = 0; i < 2048; i++) {
        uint32_t linear[3] = {spread(i) >> i % 20, i * 257, i};

        ql_curve_roll_off(curve, linear);
        for (int k = 0; k < 3; k++) {
            crc = crc_u32(crc, linear[k]);
        }
    }
    add(name, crc);
}
#endif

static void add_curves(void)
{
#if QL_CFG_CURVES & 1
    add_curve("curve_filmic", QL_CURVE_FILMIC);
#endif
#if QL_CFG_CURVES & 2
    add_curve("curve_reinhard", QL_CURVE_REINHARD);
#endif
}

/* ---- Pictures ---------------------------------------------------------- */

/* False if the build lacks the scene or the settings. */
static bool begin(ql_render_t *render, const ql_scene_t *scene,
        const ql_settings_t *settings)
{
    if (scene->header != NULL &&
            ql_render_init(render, scene, settings) == QL_OK) {
        drawn++;
        return true;
    }
    if (!some) {
        (void)fprintf(stderr, "golden: the core refuses the settings\n");
        exit(2);
    }
    return false;
}

static void add_lines(
        const ql_scene_t *scene, const char *name, ql_settings_t settings)
{
    static uint8_t lines[QL_FORMAT_COUNT][3 * SIZE];
    ql_render_t render;
    ql_output_t outputs[QL_FORMAT_COUNT];
    uint32_t crc[QL_FORMAT_COUNT] = {0, 0, 0, 0, 0};
    uint8_t count = 0;

    if (!begin(&render, scene, &settings)) {
        return;
    }
    for (int f = 0; f < QL_FORMAT_COUNT; f++) {
        if (BUILT_HAS_FORMAT(f)) {
            outputs[count].format = (ql_format_t)f;
            outputs[count++].pixels = lines[f];
        }
    }
    for (uint16_t y = 0; y < settings.height; y++) {
        memset(lines, 0, sizeof lines);
        ql_render_line(&render, y, outputs, count);
        for (int f = 0; f < QL_FORMAT_COUNT; f++) {
            crc[f] = ql_crc32(crc[f], lines[f],
                    QL_LINE_BYTES((size_t)settings.width, (ql_format_t)f));
        }
    }
    add_formats(name, crc);
}

static bool is_corner(const char *name)
{
    return strncmp(name, "corner-", 7) == 0;
}

/* The sums themselves, and what was counted. */
static void add_sums(
        const ql_scene_t *scene, const char *name, ql_settings_t settings)
{
    ql_render_t render;
    char full[NAME_MAX_BYTES];
    uint32_t crc = 0;

    if (!begin(&render, scene, &settings)) {
        return;
    }
    for (uint16_t y = 0; y < settings.height; y++) {
        for (uint16_t x = 0; x < settings.width; x++) {
            ql_sum_t sum = {{0, 0, 0}};

            ql_render_pixel(&render, x, y, 0, settings.spp, &sum);
            for (int k = 0; k < 3; k++) {
                crc = crc_u32(crc, (uint32_t)sum.rgb[k]);
                crc = crc_u32(crc, (uint32_t)(sum.rgb[k] >> 32));
            }
        }
    }
    (void)snprintf(full, sizeof full, "%s_sums", name);
    add(full, crc);
    crc = crc_u32(0, render.diag.paths);
    crc = crc_u32(crc, render.diag.closest_rays);
    crc = crc_u32(crc, render.diag.shadow_rays);
    crc = crc_u32(crc, render.diag.saturated);
    crc = crc_u32(crc, render.diag.faint);
    (void)snprintf(full, sizeof full, "%s_counts", name);
    /* a corner without a lamp has nothing else to show */
    if (QL_CFG_DIAG && (!is_corner(name) || strstr(name, "-dark_") != NULL)) {
        add(full, crc);
    }
}

/* Node widths differ in rays of equal results: the pictures are the same. */
static void add_pictures(const ql_scene_t scenes[2])
{
    static const char *const names[4] = {"cornell_random", "cornell_sobol",
            "cornell_random_node8", "cornell_sobol_node8"};

    for (int i = 0; i < 4; i++) {
        ql_settings_t settings = QL_SETTINGS_DEFAULT;

        settings.width = settings.height = SIZE;
        settings.spp = 4;
        settings.bounces = 4;
        settings.direct = QL_DIRECT_AREA;
        settings.lights = QL_LIGHTS_POWER;
        settings.sampler = (uint8_t)(i % 2);
        add_lines(scenes + i / 2, names[i], settings);
        settings.width = 17;
        settings.height = 11;
        settings.seed = 0xdeadbeefu;
        settings.bounces = 16;
        add_sums(scenes + i / 2, names[i], settings);
    }
}

/* As nothing before has it: metered, cut, by a curve. */
static void add_film(const ql_scene_t *scene)
{
#if QL_CFG_METER && QL_CFG_CLAMP && QL_CFG_CURVES & 1
    ql_settings_t settings = QL_SETTINGS_DEFAULT;

    settings.width = settings.height = SIZE;
    settings.spp = 2;
    settings.sampler = QL_SAMPLER_SOBOL;
    settings.bounces = 2;
    settings.direct = QL_DIRECT_AREA;
    settings.lights = QL_LIGHTS_POWER;
    settings.meter = 1;
    settings.clamp_q16 = QL_CLAMP_Q16(0.5);
    settings.curve = QL_CURVE_FILMIC;
    add_lines(scene, "cornell_film", settings);
    settings.width = 17;
    settings.height = 11;
    add_sums(scene, "cornell_film", settings);
#else
    (void)scene;
#endif
}

/* Every estimator, all else as above. Corners of a room, which show one feature
 * each, take the first four; a build without paths or strategies has two. */
static void add_strategies(const ql_scene_t *scene, const char *name)
{
    static const struct {
        const char *name;
        ql_settings_t settings;
    } all[] = {
            {"area", {.sampler = QL_SAMPLER_SOBOL,
                             .bounces = 6,
                             .direct = QL_DIRECT_AREA,
                             .indirect = QL_INDIRECT_BRDF,
                             .light_samples = 1}},
            {"direct_sobol", {.sampler = QL_SAMPLER_SOBOL,
                                     .direct = QL_DIRECT_AREA,
                                     .light_samples = 1}},
            {"direct_random", {.sampler = QL_SAMPLER_RANDOM,
                                      .direct = QL_DIRECT_AREA,
                                      .light_samples = 1}},
            {"mis", {.sampler = QL_SAMPLER_SOBOL,
                            .bounces = 6,
                            .direct = QL_DIRECT_MIS,
                            .indirect = QL_INDIRECT_BRDF,
                            .light_samples = 1}},
            {"none", {.sampler = QL_SAMPLER_SOBOL,
                             .bounces = 6,
                             .direct = QL_DIRECT_NONE,
                             .light_samples = 1}},
            {"hemisphere", {.sampler = QL_SAMPLER_SOBOL,
                                   .bounces = 6,
                                   .direct = QL_DIRECT_HEMISPHERE,
                                   .indirect = QL_INDIRECT_UNIFORM,
                                   .light_samples = 1}},
            {"cosine", {.sampler = QL_SAMPLER_SOBOL,
                               .bounces = 6,
                               .direct = QL_DIRECT_COSINE,
                               .indirect = QL_INDIRECT_COSINE,
                               .light_samples = 1,
                               .roulette = 1}},
            {"area_all", {.sampler = QL_SAMPLER_SOBOL,
                                 .bounces = 6,
                                 .direct = QL_DIRECT_AREA,
                                 .indirect = QL_INDIRECT_BRDF,
                                 .lights = QL_LIGHTS_ALL,
                                 .light_samples = 2}},
            {"angle", {.sampler = QL_SAMPLER_SOBOL,
                              .bounces = 6,
                              .direct = QL_DIRECT_SOLID_ANGLE,
                              .indirect = QL_INDIRECT_COSINE,
                              .lights = QL_LIGHTS_UNIFORM,
                              .light_samples = 3,
                              .roulette = 1}},
            {"mis_apart", {.sampler = QL_SAMPLER_SOBOL,
                                  .bounces = 6,
                                  .direct = QL_DIRECT_MIS,
                                  .indirect = QL_INDIRECT_UNIFORM,
                                  .lights = QL_LIGHTS_UNIFORM,
                                  .light_samples = 2,
                                  .roulette = 1}},
    };

    for (size_t i = 0; i < (is_corner(name) ? 4 : sizeof all / sizeof *all);
            i++) {
        ql_settings_t settings = all[i].settings;
        char full[NAME_MAX_BYTES];

        settings.width = 17;
        settings.height = 11;
        settings.spp = 4;
        (void)snprintf(full, sizeof full, "%s_%s", name, all[i].name);
        add_sums(scene, full, settings);
    }
}

/* ---- The file ---------------------------------------------------------- */

static entry_t kept[ENTRIES_MAX];
static unsigned kept_count;

/* A file that is not there holds nothing. */
static void read_checksums(const char *path)
{
    FILE *file = fopen(path, "r");
    char name[NAME_MAX_BYTES];
    unsigned long crc;

    if (file == NULL) {
        if (errno != ENOENT) {
            perror(path);
            exit(3);
        }
        return;
    }
    while (kept_count < ENTRIES_MAX &&
            fscanf(file, "%63s %lx", name, &crc) == 2) {
        memcpy(kept[kept_count].name, name, sizeof name);
        kept[kept_count++].crc = (uint32_t)crc;
    }
    if (!feof(file)) {
        (void)fprintf(stderr, "golden: %s: line %u is not \"name crc32\"\n",
                path, kept_count + 1);
        exit(2);
    }
    (void)fclose(file);
}

static const entry_t *find(
        const entry_t *entries, unsigned count, const char *name)
{
    for (unsigned i = 0; i < count; i++) {
        if (strcmp(entries[i].name, name) == 0) {
            return entries + i;
        }
    }
    return NULL;
}

static int check(void)
{
    unsigned failures = 0;

    for (unsigned i = 0; i < made_count; i++) {
        const entry_t *e = find(kept, kept_count, made[i].name);

        if (e == NULL || e->crc != made[i].crc) {
            failures++;
            (void)printf("  %s %08lx, %s %08lx\n", made[i].name,
                    (unsigned long)made[i].crc,
                    e != NULL ? "expected" : "missing: none expected",
                    e != NULL ? (unsigned long)e->crc : 0ul);
        }
    }
    for (unsigned i = 0; i < kept_count && !some; i++) {
        if (strncmp(kept[i].name, PRECISION "/", sizeof PRECISION) == 0 &&
                find(made, made_count, kept[i].name) == NULL) {
            failures++;
            (void)printf("  %s is expected but no longer made\n", kept[i].name);
        }
    }
    if (drawn == 0 && QL_CFG_LIGHTS) {
        failures++; /* some scene is small enough for any build with lights */
        (void)printf("  no picture is drawn\n");
    }
    (void)printf("  %u of %u checksums wrong, %u pictures\n", failures,
            made_count, drawn);
    return failures > 0;
}

static int update(const char *path)
{
    FILE *file = fopen(path, "w");
    bool failed;

    if (file == NULL) {
        perror(path);
        return 3;
    }
    for (unsigned i = 0; i < kept_count; i++) {
        if (strncmp(kept[i].name, PRECISION "/", sizeof PRECISION) != 0) {
            (void)fprintf(file, "%s %08lx\n", kept[i].name,
                    (unsigned long)kept[i].crc);
        }
    }
    for (unsigned i = 0; i < made_count; i++) {
        (void)fprintf(
                file, "%s %08lx\n", made[i].name, (unsigned long)made[i].crc);
    }
    failed = ferror(file) != 0;
    if (fclose(file) != 0 || failed) {
        perror(path);
        return 3;
    }
    return 0;
}

/* A blob that needs more than the build has is left closed. */
static void open_blob(ql_scene_t *scene, const char *path)
{
    enum { BLOB_MAX = 65536 };
    static uint32_t blobs[SCENES_MAX][BLOB_MAX / 4];
    static unsigned count;
    FILE *file = fopen(path, "rb");
    ql_status_t status;
    size_t size;

    if (file == NULL) {
        perror(path);
        exit(3);
    }
    size = fread(blobs[count], 1, BLOB_MAX, file);
    (void)fclose(file);
    status = ql_blob_open(scene, blobs[count++], size);
    if (status != QL_OK && !(some && (status == QL_ERR_FEATURE ||
                                             status == QL_ERR_CAPACITY))) {
        (void)fprintf(stderr, "golden: %s: not a scene\n", path);
        exit(2);
    }
}

/* The name of a scene: that of its file, without folder and ending. */
static const char *name_of(const char *path)
{
    static char name[24];
    const char *slash = strrchr(path, '/');
    char *dot;

    (void)snprintf(name, sizeof name, "%s", slash != NULL ? slash + 1 : path);
    dot = strchr(name, '.');
    if (dot != NULL) {
        *dot = '\0';
    }
    return name;
}

int main(int argc, char **argv)
{
    ql_scene_t scenes[SCENES_MAX];

    if (argc == 2 && strcmp(argv[1], "bits") == 0) {
        return puts(QL_CFG_NODE16 ? "16" : "8") == EOF;
    }
    if (argc == 2 && strcmp(argv[1], "contact") == 0) {
        return printf("%s%s\n", QL_CFG_CONTACT ? "" : "bare/",
                       QL_CFG_HULL ? "" : "open/") < 0;
    }
    if (argc == 2 && strcmp(argv[1], "tables") == 0) {
        return puts(TABLES) == EOF;
    }
    if (argc < 5 || argc > 3 + SCENES_MAX) {
        (void)fputs("usage: golden print|check|some|update CHECKSUMS BLOB16 "
                    "BLOB8 [SCENE.qlb ...]\n"
                    "Example: golden check tests/golden/checksums.txt "
                    "build/golden/cornell16.qlb build/golden/cornell8.qlb\n",
                stderr);
        return 1;
    }
    some = strcmp(argv[1], "some") == 0;
    for (int i = 3; i < argc; i++) {
        open_blob(scenes + i - 3, argv[i]);
    }
    add_tables();
    add_numbers();
    add_samplers();
    add_warps();
    add_lobes();
    add_spherical();
    add_tonemap();
    add_curves();
    add_pictures(scenes);
    add_film(scenes);
    add_strategies(scenes, "cornell");
    for (int i = 5; i < argc; i++) {
        add_strategies(scenes + i - 3, name_of(argv[i]));
    }
    read_checksums(argv[2]);
    if (some || strcmp(argv[1], "check") == 0) {
        return check();
    }
    if (strcmp(argv[1], "update") == 0) {
        return update(argv[2]);
    }
    for (unsigned i = 0; i < made_count; i++) {
        (void)printf("%s %08lx\n", made[i].name, (unsigned long)made[i].crc);
    }
    return 0;
}
