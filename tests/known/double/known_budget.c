/* known_budget.c - what each stage's rounding does to a picture, one by one */
/* SPDX-License-Identifier: MIT */

/* Usage: known_budget [CLAIM]
 *        known_budget --table    the rows that stand in firmware/DESIGN.md
 *
 * tools/ref renders with the core's random numbers in double precision. Here
 * one stage after the other is given the rounding of the core (rounding.h) and
 * the picture is compared with the exact one: SIZE x SIZE pixels, SPP samples,
 * 4 bounces, of build/cornell.qlb and build/mesh.qlb. A sample whose rays met
 * something else than they do without rounding has passed an edge on its other
 * side. Such samples are few and far off, so they are kept apart: "edges". */

#include <math.h>
#include <stdlib.h>

#include "bench/rays/bench_rays.h"
#include "math/lut/ql_lut.h"
#include "support/picture/picture.h"
#include "support/ql_test.h"
#include "qlux.h"
#include "known/double/rounding.h"
#include "trace/ql_bvh.h"

enum { SIZE = 36, SPP = 64, SAMPLES = SIZE * SIZE * SPP };
enum { VALUES = 3 * SIZE * SIZE };

#define COARSER 4 /* the planted fault: two bits less, at every stage */

#if QL_POS_BITS == 0
#define PRECISION  "draft"
#define RELMSE_MAX 1e-4
#define BIAS_MAX   1e-3
#else
#define PRECISION  "fine"
#define RELMSE_MAX 1e-6
#define BIAS_MAX   1e-4
#endif

/* ---- Scenes ------------------------------------------------------------- */

enum { CORNELL, MESH, SCENES };

/* Samples of a picture, exact. */
typedef struct {
    double *rgb; /* 3 of each sample */
    uint32_t *route;
} exact_t;

typedef struct {
    void *bytes;
    ql_scene_t blob;
    ql_settings_t settings;
    ref_scene_t scene;
    rounding_t rounding;
    exact_t exact[2];       /* indirect light by cosine, uniform */
    double picture[VALUES]; /* exact, by cosine */
    double core[VALUES];
    double all[VALUES]; /* every stage rounded */
} case_t;

static case_t cases[SCENES];
static const char *fail;

static void *allocate(size_t count, size_t size)
{
    void *memory = malloc(count * size);

    if (memory == NULL) {
        printf("known/budget: out of memory\n");
        exit(3);
    }
    return memory;
}

static void render_sample(case_t *c, unsigned i, double rgb[3])
{
    ref_stats_t stats = {0, 0, 0};

    rgb[0] = rgb[1] = rgb[2] = 0;
    c->rounding.route = 2166136261u;
    ref_pixel(&c->scene, &c->settings, (uint16_t)(i / SPP % SIZE),
            (uint16_t)(i / SPP / SIZE), i % SPP, 1, rgb, &stats);
}

static exact_t render_exact(case_t *c)
{
    exact_t exact;

    exact.rgb = allocate(SAMPLES, 3 * sizeof *exact.rgb);
    exact.route = allocate(SAMPLES, sizeof *exact.route);
    for (unsigned i = 0; i < SAMPLES; i++) {
        render_sample(c, i, exact.rgb + (size_t)3 * i);
        exact.route[i] = c->rounding.route;
    }
    return exact;
}

static void render_core(case_t *c)
{
    ql_render_t render;

    if (ql_render_init(&render, &c->blob, &c->settings) != QL_OK) {
        fail = "the core refuses the settings";
        return;
    }
    for (unsigned i = 0; i < VALUES / 3; i++) {
        ql_sum_t sum = {{0, 0, 0}};

        ql_render_pixel(&render, (uint16_t)(i % SIZE), (uint16_t)(i / SIZE), 0,
                SPP, &sum);
        for (unsigned k = 0; k < 3; k++) {
            c->core[3 * i + k] = ldexp((double)sum.rgb[k], -QL_SUM_BITS) / SPP;
        }
    }
    fail = render.diag.saturated > 0 ? "contributions saturated" : fail;
}

static void open_case(case_t *c, const char *path)
{
    static const ql_settings_t start = QL_SETTINGS_DEFAULT;
    size_t size;

    c->bytes = picture_load(path, &size);
    if (c->bytes == NULL || ql_blob_open(&c->blob, c->bytes, size) != QL_OK) {
        fail = path;
        return;
    }
    c->settings = start;
    c->settings.direct = QL_DIRECT_AREA;
    c->settings.lights = QL_LIGHTS_POWER;
    c->settings.width = c->settings.height = SIZE;
    c->settings.spp = SPP;
    ref_scene_init(&c->scene, &c->blob);
    rounding_begin(&c->rounding, &c->scene, &c->settings);
    c->exact[0] = render_exact(c);
    for (unsigned i = 0; i < 3 * SAMPLES; i++) {
        c->picture[i / 3 / SPP * 3 + i % 3] += c->exact[0].rgb[i] / SPP;
    }
    render_core(c);
    c->settings.indirect = QL_INDIRECT_UNIFORM;
    c->exact[1] = render_exact(c);
    c->settings.indirect = start.indirect;
}

static void open_cases(void)
{
    open_case(cases + CORNELL, picture_built("cornell.qlb"));
    if (fail == NULL) {
        open_case(cases + MESH, picture_built("mesh.qlb"));
    }
}

static void close_cases(void)
{
    for (unsigned i = 0; i < SCENES; i++) {
        ref_scene_free(&cases[i].scene);
        free(cases[i].bytes);
        for (unsigned k = 0; k < 2; k++) {
            free(cases[i].exact[k].rgb);
            free(cases[i].exact[k].route);
        }
    }
}

/* ---- Differences -------------------------------------------------------- */

/* relMSE and bias as qlux-diff has them: of the samples that met the same as
 * without rounding, and of the others. */
typedef struct {
    double relmse, bias;
    double edges, edge_bias;
    unsigned passed; /* how many others */
} figures_t;

static const figures_t no_figures;

static double mean_of(const double *picture)
{
    double sum = 0;

    for (unsigned i = 0; i < VALUES; i++) {
        sum += picture[i] / VALUES;
    }
    return sum;
}

static double relmse_of(const double *off, const double *picture)
{
    const double mean = mean_of(picture);
    double sum = 0;

    for (unsigned i = 0; i < VALUES; i++) {
        sum += off[i] * off[i] /
               (picture[i] * picture[i] + 0.01 * mean * mean) / VALUES;
    }
    return sum;
}

/* Render as the case is set and compare with exact samples.
 *
 *   picture  -  out, if not NULL
 */
static figures_t measure(case_t *c, const exact_t *exact, double *picture)
{
    static double off[2][VALUES], wanted[VALUES];
    figures_t f = no_figures;

    memset(off, 0, sizeof off);
    memset(wanted, 0, sizeof wanted);
    memset(c->rounding.error, 0, sizeof c->rounding.error);
    for (unsigned i = 0; i < SAMPLES; i++) {
        const double *before = exact->rgb + (size_t)3 * i;
        double rgb[3];
        bool other;

        render_sample(c, i, rgb);
        other = c->rounding.route != exact->route[i];
        f.passed += other;
        for (unsigned k = 0; k < 3; k++) {
            const unsigned at = i / SPP * 3 + k;

            off[other][at] += (rgb[k] - before[k]) / SPP;
            wanted[at] += before[k] / SPP;
        }
    }
    f.relmse = relmse_of(off[0], wanted);
    f.bias = mean_of(off[0]) / mean_of(wanted);
    f.edges = relmse_of(off[1], wanted);
    f.edge_bias = mean_of(off[1]) / mean_of(wanted);
    for (unsigned i = 0; picture != NULL && i < VALUES; i++) {
        picture[i] = wanted[i] + off[0][i] + off[1][i];
    }
    return f;
}

/* Of two pictures: there are no samples to tell apart. */
static figures_t compare(const double *picture, const double *wanted)
{
    static double off[VALUES];
    figures_t f = no_figures;

    for (unsigned i = 0; i < VALUES; i++) {
        off[i] = picture[i] - wanted[i];
    }
    f.relmse = relmse_of(off, wanted);
    f.bias = mean_of(off) / mean_of(wanted);
    return f;
}

/* ---- Stages ------------------------------------------------------------- */

/* Those of rounding.h, and the albedo as it is stored. */
enum { ALBEDO = ROUNDING_STAGES, STAGES };

/* The albedo that was written, in six digits, may be off by half an ulp: move
 * each away by as much again. */
static void round_albedo(case_t *c, double coarser, rounding_error_t *e)
{
    const uint32_t count = QL_LE32(c->blob.header->materials.count);

    for (uint32_t i = 0; i < count; i++) {
        for (unsigned k = 0; k < 3; k++) {
            double *albedo = c->scene.materials[i].albedo + k;
            const double off = *albedo - floor(*albedo * 1e6 + 0.5) / 1e6;

            *albedo += coarser * off;
            e->worst = fmax(e->worst, fabs(ldexp(off, 31)));
            e->squares += ldexp(off * off, 62);
            e->count++;
        }
    }
}

/* As the blob has it. */
static void restore_albedo(case_t *c)
{
    const uint32_t count = QL_LE32(c->blob.header->materials.count);

    for (uint32_t i = 0; i < 3 * count; i++) {
        c->scene.materials[i / 3].albedo[i % 3] = ldexp(
                (double)QL_LE32(c->blob.materials[i / 3].albedo[i % 3]), -31);
    }
}

/* One stage alone, its errors times coarser. */
static figures_t measure_stage(
        case_t *c, unsigned stage, double coarser, rounding_error_t *error)
{
    const uint8_t indirect = c->settings.indirect;
    figures_t f;

    if (stage == ALBEDO) {
        rounding_error_t e = {0, 0, 0, 0};

        round_albedo(c, coarser, &e);
        f = measure(c, c->exact, NULL);
        restore_albedo(c);
        *error = e;
        return f;
    }
    c->rounding.coarser = coarser;
    c->rounding.on = (uint32_t)1 << stage;
    if (stage == ROUNDING_FRAME) {
        c->settings.indirect = QL_INDIRECT_UNIFORM;
    }
    f = measure(c, c->exact + (stage == ROUNDING_FRAME), NULL);
    c->settings.indirect = indirect;
    c->rounding.on = 0;
    c->rounding.coarser = 1;
    *error = c->rounding.error[stage];
    return f;
}

/* What is measured once. */
static struct {
    bool done;
    figures_t figures[SCENES];
    rounding_error_t error[SCENES];
} measured[STAGES];

static const figures_t *figures_of(unsigned stage, unsigned scene)
{
    if (!measured[stage].done) {
        for (unsigned i = 0; i < SCENES; i++) {
            measured[stage].figures[i] = measure_stage(
                    cases + i, stage, 1, measured[stage].error + i);
        }
        measured[stage].done = true;
    }
    return measured[stage].figures + scene;
}

/* Errors of a stage on the paths of both pictures. */
static rounding_error_t error_of(unsigned stage)
{
    rounding_error_t sum = {0, 0, 0, 0};

    (void)figures_of(stage, 0);
    for (unsigned i = 0; i < SCENES; i++) {
        const rounding_error_t *e = measured[stage].error + i;

        sum.worst = fmax(sum.worst, e->worst);
        sum.squares += e->squares;
        sum.along += e->along;
        sum.count += e->count;
    }
    return sum;
}

/* All that a picture goes through; what only other pictures do does nothing. */
static const figures_t *figures_of_all(unsigned scene)
{
    static figures_t figures[SCENES];
    case_t *c = cases + scene;

    if (figures[scene].relmse <= 0) {
        c->rounding.on = ROUNDING_ALL & ~((uint32_t)1 << ROUNDING_FRAME);
        figures[scene] = measure(c, c->exact, c->all);
        c->rounding.on = 0;
    }
    return figures + scene;
}

/* What the core has of them is added up: not the frame, not the albedo. */
static figures_t sum_of_stages(unsigned scene)
{
    figures_t sum = no_figures;

    for (unsigned s = 0; s < ROUNDING_STAGES; s++) {
        const figures_t *f = figures_of(s, scene);

        if (s != ROUNDING_FRAME) {
            sum.relmse += f->relmse;
            sum.bias += f->bias;
            sum.edges += f->edges;
            sum.edge_bias += f->edge_bias;
            sum.passed += f->passed;
        }
    }
    return sum;
}

/* ---- Intersection ------------------------------------------------------- */

typedef struct {
    unsigned long rays, other_rays, segments, other_segments;
} answers_t;

static ref_ray_t ray_of(const ql_ray_t *ray, double *length)
{
    const ref_vec_t d = {ray->direction.x, ray->direction.y, ray->direction.z};
    ref_ray_t r;

    *length = ldexp(ref_length(d), -QL_POS_BITS);
    r.origin.x = ldexp(ray->origin.x, -QL_POS_BITS);
    r.origin.y = ldexp(ray->origin.y, -QL_POS_BITS);
    r.origin.z = ldexp(ray->origin.z, -QL_POS_BITS);
    r.direction = ref_unit(d);
    r.from = REF_NOWHERE;
    r.inside = false;
    return r;
}

/* Do both find the same? The reference is turned by so many radians. */
static void add_answers(
        const case_t *c, const bench_batch_t *b, double turn, answers_t *a)
{
    double length;

    for (uint32_t i = 0; i < b->closest_count; i++) {
        ref_ray_t ray = ray_of(b->closest + i, &length);
        ref_hit_t hit;
        ql_hit_t core;
        const bool met = ql_bvh_closest_hit(&c->blob, b->closest + i, &core);

        ray.direction.x += turn;
        a->other_rays +=
                ref_closest(&c->scene, &ray, &hit) != met ||
                (met && (hit.shape != core.tri_idx || hit.front != core.front));
    }
    for (uint32_t i = 0; i < b->shadow_count; i++) {
        ref_ray_t ray = ray_of(b->shadow + i, &length);
        const bool blocked = ql_bvh_occluded(&c->blob, b->shadow + i);

        ray.direction.x += turn;
        a->other_segments +=
                ref_blocked(&c->scene, &ray, length, REF_NOWHERE) != blocked;
    }
    a->rays += b->closest_count;
    a->segments += b->shadow_count;
}

/* Rays and segments of a picture, as the core rounds them, traced by both. */
static answers_t compare_answers(case_t *c, double turn)
{
    enum { CAPACITY = 4096 };
    static ql_ray_t closest[CAPACITY], shadow[CAPACITY];
    static bench_warp_t warps[CAPACITY];
    bench_batch_t b = {closest, shadow, warps, CAPACITY, 0, 0, 0, 0};
    answers_t a = {0, 0, 0, 0};
    ql_settings_t s = c->settings;
    ql_render_t render;
    uint32_t next = 0;

    s.bounces = BENCH_BOUNCES;
    s.spp = SPP / 4;
    if (ql_render_init(&render, &c->blob, &s) == QL_OK) {
        while (bench_rays_fill(&b, &render, &next)) {
            add_answers(c, &b, turn, &a);
        }
    }
    return a;
}

/* ---- Curve -------------------------------------------------------------- */

static double srgb(double x)
{
    x = fmin(x, 1);
    return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055);
}

/* The core's display value, u8.8, as ql_tonemap.c has it before the dither. */
static uint32_t display_value(ql_uq16_t linear)
{
    unsigned octave;
    uint32_t mantissa, step, low, high;

    if (linear >= 65536u) {
        return 65280u;
    }
    if (linear < 128) {
        return (linear * 3295u + 128u) >> 8;
    }
    octave = 24 - ql_clz32(linear);
    mantissa = linear << (8 - octave);
    step = octave * QL_SRGB_STEPS + (mantissa >> 11 & 15u);
    low = ql_lut_srgb[step];
    high = ql_lut_srgb[step + 1];
    return low + (((high - low) * (mantissa & 2047u) + 1024u) >> 11);
}

/* Does the core show that value, at all places of the dither together? */
static bool is_shown(ql_uq16_t linear, uint32_t value)
{
    const ql_uq16_t rgb[3] = {linear, linear, linear};
    unsigned sum = 0, count = 0;

    for (uint16_t i = 0; i < 64; i++) {
        uint8_t line[3 * 8];

        ql_tonemap_pixel(line, QL_FORMAT_RGB888, i % 8, i / 8, rgb);
        sum += line[3 * (i % 8)];
    }
    for (unsigned t = 0; t < 64; t++) {
        count += (value + 2 * (2 * t + 1)) >> 8;
    }
    return sum == count;
}

/* Errors of the display values of exact sums, of 255; shift moves what is
 * displayed by so many linear steps of 2^-16. */
static rounding_error_t curve_error(
        const case_t *c, uint32_t shift, unsigned long *not_shown)
{
    const ql_blob_header_t *h = c->blob.header;
    const int16_t radiance_exp = ql_i16(QL_LE16((uint16_t)h->radiance_exp));
    const int16_t exposure_q8 = ql_i16(QL_LE16((uint16_t)h->exposure_q8));
    const double exposure = ldexp(exp2(exposure_q8 / 256.0), radiance_exp);
    rounding_error_t e = {0, 0, 0, 0};

    for (unsigned i = 0; i < VALUES / 3; i++) {
        ql_uq16_t linear[3];
        ql_sum_t sum;

        for (unsigned k = 0; k < 3; k++) {
            sum.rgb[k] =
                    (uint64_t)ldexp(c->picture[3 * i + k] * SPP, QL_SUM_BITS);
        }
        ql_film_display(
                &sum, SPP, ql_film_exposure(radiance_exp, exposure_q8), linear);
        for (unsigned k = 0; k < 3; k++) {
            const uint32_t value = display_value(linear[k] + shift);
            const double mean = ldexp((double)sum.rgb[k], -QL_SUM_BITS) / SPP;
            const double off = value / 256.0 - srgb(mean * exposure);

            *not_shown += !is_shown(linear[k] + shift, value);
            e.worst = fmax(e.worst, fabs(off));
            e.squares += off * off;
            e.along += off;
            e.count++;
        }
    }
    return e;
}

/* ---- The table ---------------------------------------------------------- */

/* Who holds a stage's own error. */
static const char *const held_by[STAGES] = {"test_trig", "test_real",
        "test_real", "test_camera", "test_camera", "test_light",
        "test_warp_sphere", "test_surface", "test_warp_lobe", "test_bvh",
        "test_surface", "test_real", "test_fx", "test_film", "known_budget"};

typedef struct {
    char text[256];
} row_t;

/* "a + b", or "a - b" */
static void append_sum(row_t *row, const char *format, double a, double b)
{
    const size_t at = strlen(row->text);
    char text[2][32];

    (void)snprintf(text[0], sizeof text[0], format, a);
    (void)snprintf(text[1], sizeof text[1], format, fabs(b));
    if (fabs(b) > 0) {
        (void)snprintf(row->text + at, sizeof row->text - at, " %s %c %s |",
                text[0], b < 0 ? '-' : '+', text[1]);
    } else {
        (void)snprintf(row->text + at, sizeof row->text - at, " %s |", text[0]);
    }
}

static void append(row_t *row, const char *text)
{
    const size_t at = strlen(row->text);

    (void)snprintf(row->text + at, sizeof row->text - at, "%s", text);
}

static void append_figures(row_t *row, const figures_t *f)
{
    append_sum(row, "%.1e", f->relmse, f->edges);
    append_sum(row, "%.1e", f->bias, f->edge_bias);
}

static row_t stage_row(unsigned stage)
{
    const rounding_error_t e = error_of(stage);
    row_t row;

    (void)snprintf(row.text, sizeof row.text, "| %s | %.2g, %.2g %s; `%s` |",
            stage == ALBEDO ? "shading: stored albedo" : rounding_name(stage),
            e.worst, sqrt(e.squares / (double)e.count),
            stage == ALBEDO ? "of 2^-31" : rounding_unit(stage),
            held_by[stage]);
    for (unsigned i = 0; i < SCENES; i++) {
        append_figures(&row, figures_of(stage, i));
    }
    return row;
}

/* Rays that meet something else in double, measured once. */
static const answers_t *answers_of(unsigned scene)
{
    static answers_t answers[SCENES];

    if (answers[scene].rays == 0) {
        answers[scene] = compare_answers(cases + scene, 0);
    }
    return answers + scene;
}

enum { SUM_OF_STAGES, ALL_STAGES, CORE, TOTALS };

static figures_t total_of(unsigned total, unsigned scene)
{
    return total == SUM_OF_STAGES ? sum_of_stages(scene)
           : total == ALL_STAGES
                   ? *figures_of_all(scene)
                   : compare(cases[scene].core, cases[scene].picture);
}

static row_t total_row(unsigned total)
{
    static const char *const names[TOTALS] = {"| sum of the stages | |",
            "| all stages at once | |", "| **the core** | |"};
    row_t row = {""};

    append(&row, names[total]);
    for (unsigned i = 0; i < SCENES; i++) {
        const figures_t f = total_of(total, i);

        append_figures(&row, &f);
    }
    return row;
}

static row_t curve_row(void)
{
    rounding_error_t e[SCENES];
    unsigned long not_shown = 0;
    double squares = 0, count = 0;
    row_t row;

    for (unsigned i = 0; i < SCENES; i++) {
        e[i] = curve_error(cases + i, 0, &not_shown);
        squares += e[i].squares;
        count += (double)e[i].count;
    }
    (void)snprintf(row.text, sizeof row.text,
            "| curve | %.2g, %.2g of 255; `test_tonemap` | | %.1e of 255 | | "
            "%.1e of 255 |",
            fmax(e[0].worst, e[1].worst), sqrt(squares / count),
            e[0].along / (double)e[0].count, e[1].along / (double)e[1].count);
    return row;
}

static row_t intersection_row(void)
{
    unsigned long traced = 0, other = 0;
    row_t row;

    for (unsigned i = 0; i < SCENES; i++) {
        const answers_t *a = answers_of(i);

        traced += a->rays + a->segments;
        other += a->other_rays + a->other_segments;
    }
    (void)snprintf(row.text, sizeof row.text,
            "| intersection: what is met | %lu of %lu rays; `test_tri`, "
            "`test_bvh` | 0 | 0 | 0 | 0 |",
            other, traced);
    return row;
}

/* In the order of a path. */
enum { INTERSECTION = STAGES, CURVE, FIRST_TOTAL, ROWS = FIRST_TOTAL + TOTALS };
static const uint8_t order[ROWS] = {ROUNDING_SINE, ROUNDING_ROOT,
        ROUNDING_RECIPROCAL, ROUNDING_ORIGIN, ROUNDING_RAY, ROUNDING_LIGHT,
        ROUNDING_COSINE, ROUNDING_NORMAL, ROUNDING_FRAME, INTERSECTION,
        ROUNDING_WAY, ROUNDING_POINT, ROUNDING_GEOMETRY, ROUNDING_THROUGHPUT,
        ALBEDO, ROUNDING_SUM, CURVE, FIRST_TOTAL + SUM_OF_STAGES,
        FIRST_TOTAL + ALL_STAGES, FIRST_TOTAL + CORE};

static row_t row_of(unsigned i)
{
    return order[i] < STAGES          ? stage_row(order[i])
           : order[i] == INTERSECTION ? intersection_row()
           : order[i] == CURVE        ? curve_row()
                                      : total_row(order[i] - FIRST_TOTAL);
}

static void print_table(void)
{
    printf("| " PRECISION ": stage | own error: worst, rms; held by | Cornell "
           "box: relMSE | bias | mesh: relMSE | bias |\n|---|---|---|---|---|"
           "---|\n");
    for (unsigned i = 0; i < ROWS; i++) {
        printf("%s\n", row_of(i).text);
        (void)fflush(stdout);
    }
}

/* ---- Budgets ------------------------------------------------------------ */

/* A quarter above what was measured, of each scene. */
typedef struct {
    double worst; /* own error */
    struct {
        double relmse, bias, edges, edge_bias;
    } picture[SCENES];
} budget_t;

/* clang-format off */
static const budget_t budgets[STAGES] = {
#if QL_POS_BITS == 0
    [ROUNDING_SINE] = {2.4e-5,
            {{4.3e-11, 9.4e-7, 2.7e-18, 7.9e-12},
             {1.4e-10, 8.2e-7, 1.7e-7, 4.9e-8}}},
    [ROUNDING_ROOT] = {2.9e-5,
            {{2.1e-12, 1.3e-7, 0, 0},
             {1.2e-12, 8.7e-8, 2.5e-8, 1.7e-6}}},
    [ROUNDING_RECIPROCAL] = {1.2e-9,
            {{4.7e-20, 1.4e-10, 0, 0},
             {5.5e-20, 1.3e-10, 0, 0}}},
    [ROUNDING_ORIGIN] = {9.0e-1,
            {{9.2e-10, 2.7e-7, 3.8e-6, 2.3e-5},
             {1.7e-9, 2.4e-8, 3.9e-5, 1.7e-5}}},
    [ROUNDING_RAY] = {1.8e0,
            {{2.7e-9, 4.0e-7, 2.1e-6, 2.0e-7},
             {3.2e-9, 1.2e-7, 6.0e-5, 9.5e-5}}},
    [ROUNDING_LIGHT] = {2.0e0,
            {{5.4e-9, 2.7e-6, 2.7e-7, 3.0e-6},
             {5.4e-9, 5.7e-6, 2.9e-8, 2.9e-6}}},
    [ROUNDING_COSINE] = {1.8e0,
            {{6.5e-11, 2.3e-8, 5.0e-7, 1.8e-5},
             {3.4e-10, 1.9e-7, 6.8e-6, 4.7e-5}}},
    [ROUNDING_NORMAL] = {6.6e0,
            {{6.1e-17, 6.7e-10, 0, 0},
             {2.3e-17, 3.9e-10, 0, 0}}},
    [ROUNDING_FRAME] = {2.5e0,
            {{1.2e-19, 5.0e-12, 0, 0},
             {1.7e-19, 1.9e-11, 0, 0}}},
    [ROUNDING_WAY] = {1.1e-3,
            {{1.5e-17, 1.2e-9, 0, 0},
             {1.4e-17, 9.2e-10, 0, 0}}},
    [ROUNDING_POINT] = {3.5e0,
            {{1.5e-8, 5.7e-5, 2.3e-6, 5.5e-5},
             {1.5e-8, 4.7e-5, 1.7e-5, 6.9e-5}}},
    [ROUNDING_GEOMETRY] = {1.5e-8,
            {{1.2e-17, 1.9e-9, 0, 0},
             {1.8e-17, 2.4e-9, 0, 0}}},
    [ROUNDING_THROUGHPUT] = {6.3e-1,
            {{4.1e-18, 2.7e-10, 0, 0},
             {1.5e-18, 1.7e-10, 0, 0}}},
    [ROUNDING_SUM] = {1.0,
            {{2.3e-11, 2.5e-8, 0, 0},
             {8.7e-13, 1.1e-9, 0, 0}}},
    [ALBEDO] = {6.1e-1,
            {{2.0e-19, 9.9e-11, 0, 0},
             {1.8e-19, 6.9e-12, 0, 0}}},
#else
    [ROUNDING_SINE] = {5.0e-8,
            {{6.6e-17, 9.3e-11, 0, 0},
             {1.1e-16, 1.7e-10, 0, 0}}},
    [ROUNDING_ROOT] = {1.4e-9,
            {{1.6e-19, 2.7e-12, 0, 0},
             {6.4e-20, 1.8e-12, 0, 0}}},
    [ROUNDING_RECIPROCAL] = {1.2e-9,
            {{4.7e-20, 1.4e-10, 0, 0},
             {5.5e-20, 1.3e-10, 0, 0}}},
    [ROUNDING_ORIGIN] = {7.1e0,
            {{4.3e-13, 1.4e-8, 2.9e-9, 8.6e-7},
             {8.9e-13, 2.7e-8, 4.0e-8, 6.1e-8}}},
    [ROUNDING_RAY] = {3.8e0,
            {{2.3e-13, 5.4e-9, 0, 0},
             {4.2e-13, 2.1e-8, 3.4e-8, 9.3e-7}}},
    [ROUNDING_LIGHT] = {1.6e0,
            {{8.3e-14, 9.8e-9, 0, 0},
             {8.3e-14, 2.3e-8, 0, 0}}},
    [ROUNDING_COSINE] = {2.6e0,
            {{7.5e-15, 1.7e-9, 0, 0},
             {3.7e-14, 2.8e-10, 2.8e-8, 3.7e-6}}},
    [ROUNDING_NORMAL] = {6.6e0,
            {{6.1e-17, 6.7e-10, 0, 0},
             {2.3e-17, 3.9e-10, 0, 0}}},
    [ROUNDING_FRAME] = {2.5e0,
            {{1.2e-19, 5.0e-12, 0, 0},
             {1.7e-19, 1.9e-11, 0, 0}}},
    [ROUNDING_WAY] = {2.4e-2,
            {{2.3e-18, 4.3e-10, 0, 0},
             {2.6e-18, 3.3e-10, 0, 0}}},
    [ROUNDING_POINT] = {3.5e0,
            {{2.3e-13, 2.2e-7, 0, 0},
             {2.5e-13, 1.9e-7, 1.5e-21, 6.2e-13}}},
    [ROUNDING_GEOMETRY] = {1.5e-8,
            {{1.2e-17, 1.9e-9, 0, 0},
             {1.8e-17, 2.4e-9, 0, 0}}},
    [ROUNDING_THROUGHPUT] = {6.3e-1,
            {{4.1e-18, 2.7e-10, 0, 0},
             {1.5e-18, 1.7e-10, 0, 0}}},
    [ROUNDING_SUM] = {1.0,
            {{2.3e-11, 2.5e-8, 0, 0},
             {8.7e-13, 1.1e-9, 0, 0}}},
    [ALBEDO] = {6.1e-1,
            {{2.0e-19, 9.9e-11, 0, 0},
             {1.8e-19, 6.9e-12, 0, 0}}},
#endif
};
/* clang-format on */

static bool is_within(const figures_t *f, unsigned stage, unsigned scene)
{
    return f->relmse <= budgets[stage].picture[scene].relmse &&
           fabs(f->bias) <= budgets[stage].picture[scene].bias &&
           f->edges <= budgets[stage].picture[scene].edges &&
           fabs(f->edge_bias) <= budgets[stage].picture[scene].edge_bias;
}

static void check_budget(unsigned stage)
{
    const rounding_error_t e = error_of(stage);
    const figures_t *f = figures_of(stage, 0);

    CHECK(e.count > 0, "nothing was rounded");
    CHECK(e.worst <= budgets[stage].worst, "worst %.3g", e.worst);
    for (unsigned i = 0; i < SCENES; i++) {
        f = figures_of(stage, i);
        CHECK(is_within(f, stage, i),
                "scene %u: relMSE %.3g, edges %.3g; bias %.3g, edges %.3g", i,
                f->relmse, f->edges, f->bias, f->edge_bias);
    }
    NOTE("worst %.2g; mesh: relMSE %.1e, edges %.1e", e.worst, f->relmse,
            f->edges);
}

static void reject_coarser(unsigned stage)
{
    rounding_error_t e;
    const figures_t f = measure_stage(cases + CORNELL, stage, COARSER, &e);

    CHECK(!is_within(&f, stage, CORNELL),
            "accepted: relMSE %.3g, edges %.3g; bias %.3g, edges %.3g",
            f.relmse, f.edges, f.bias, f.edge_bias);
    NOTE("relMSE %.1e, budget %.1e", f.relmse,
            budgets[stage].picture[CORNELL].relmse);
}

#define STAGE(stage, within, coarser)                                          \
    TEST(within)                                                               \
    {                                                                          \
        check_budget(stage);                                                   \
    }                                                                          \
    TEST(coarser)                                                              \
    {                                                                          \
        reject_coarser(stage);                                                 \
    }

STAGE(ROUNDING_SINE, sine_and_cosine_is_within_its_budget,
        sine_and_cosine_two_bits_coarser_is_rejected)
STAGE(ROUNDING_ROOT, reciprocal_root_is_within_its_budget,
        reciprocal_root_two_bits_coarser_is_rejected)
STAGE(ROUNDING_RECIPROCAL, reciprocal_is_within_its_budget,
        reciprocal_two_bits_coarser_is_rejected)
STAGE(ROUNDING_ORIGIN, camera_origin_is_within_its_budget,
        camera_origin_two_bits_coarser_is_rejected)
STAGE(ROUNDING_RAY, camera_direction_is_within_its_budget,
        camera_direction_two_bits_coarser_is_rejected)
STAGE(ROUNDING_LIGHT, light_point_is_within_its_budget,
        light_point_two_bits_coarser_is_rejected)
STAGE(ROUNDING_COSINE, cosine_direction_is_within_its_budget,
        cosine_direction_two_bits_coarser_is_rejected)
STAGE(ROUNDING_NORMAL, unit_normal_is_within_its_budget,
        unit_normal_two_bits_coarser_is_rejected)
STAGE(ROUNDING_FRAME, frame_is_within_its_budget,
        frame_two_bits_coarser_is_rejected)
STAGE(ROUNDING_WAY, ray_parameter_is_within_its_budget,
        ray_parameter_two_bits_coarser_is_rejected)
STAGE(ROUNDING_POINT, hit_point_is_within_its_budget,
        hit_point_two_bits_coarser_is_rejected)
STAGE(ROUNDING_GEOMETRY, geometry_term_is_within_its_budget,
        geometry_term_two_bits_coarser_is_rejected)
STAGE(ROUNDING_THROUGHPUT, throughput_is_within_its_budget,
        throughput_two_bits_coarser_is_rejected)
STAGE(ROUNDING_SUM, sum_is_within_its_budget, sum_two_bits_coarser_is_rejected)
STAGE(ALBEDO, stored_albedo_is_within_its_budget,
        stored_albedo_two_bits_coarser_is_rejected)

TEST(without_rounding_the_reference_is_what_it_was)
{
    case_t *c = cases + CORNELL;
    unsigned long other = 0;

    c->scene.rounding = NULL;
    for (unsigned i = 0; i < SAMPLES; i += 3) {
        double rgb[3];

        render_sample(c, i, rgb);
        other += memcmp(rgb, c->exact[0].rgb + (size_t)3 * i, sizeof rgb) != 0;
    }
    c->scene.rounding = &c->rounding.hooks;
    CHECK(other == 0, "%lu samples differ", other);
    NOTE("%d samples, bit by bit", SAMPLES / 3);
}

TEST(rays_meet_what_they_meet_in_double)
{
    answers_t all = {0, 0, 0, 0};

    for (unsigned i = 0; i < SCENES; i++) {
        const answers_t *a = answers_of(i);

        all.rays += a->rays;
        all.segments += a->segments;
        CHECK(a->rays > 0 && a->other_rays == 0, "scene %u: %lu of %lu rays", i,
                a->other_rays, a->rays);
        CHECK(a->segments > 0 && a->other_segments == 0,
                "scene %u: %lu of %lu segments", i, a->other_segments,
                a->segments);
    }
    NOTE("none of %lu rays, %lu segments differs", all.rays, all.segments);
}

TEST(rays_turned_by_a_ten_thousandth_are_rejected)
{
    const answers_t a = compare_answers(cases + MESH, 1e-4);

    CHECK(a.other_rays > 0 && a.other_segments > 0,
            "%lu rays, %lu segments differ", a.other_rays, a.other_segments);
    NOTE("%lu rays, %lu segments differ", a.other_rays, a.other_segments);
}

TEST(a_sum_that_truncates_is_rejected)
{
    case_t *c = cases + CORNELL;
    figures_t f;

    c->rounding.truncate = true;
    c->rounding.on = (uint32_t)1 << ROUNDING_SUM;
    f = measure(c, c->exact, NULL);
    c->rounding.on = 0;
    c->rounding.truncate = false;
    CHECK(!is_within(&f, ROUNDING_SUM, CORNELL), "accepted: bias %.3g", f.bias);
    NOTE("bias %.1e, budget %.1e", f.bias,
            budgets[ROUNDING_SUM].picture[CORNELL].bias);
}

/* ---- Totals ------------------------------------------------------------- */

/* What the stages do together is what the core does: this much of its relMSE
 * is left, from rays that pass an edge by less than doubles can tell. */
#define LEFT_MAX 0.02

TEST(the_core_is_within_the_targets)
{
    for (unsigned i = 0; i < SCENES; i++) {
        const figures_t f = total_of(CORE, i);

        CHECK(f.relmse <= RELMSE_MAX && fabs(f.bias) <= BIAS_MAX,
                "scene %u: relMSE %.3g, bias %.3g", i, f.relmse, f.bias);
        NOTE("mesh: relMSE %.1e, limit %.0e; bias %.1e, limit %.0e", f.relmse,
                RELMSE_MAX, f.bias, BIAS_MAX);
    }
}

TEST(all_stages_at_once_are_the_core)
{
    for (unsigned i = 0; i < SCENES; i++) {
        const double core = total_of(CORE, i).relmse;
        figures_t left;

        (void)figures_of_all(i);
        left = compare(cases[i].all, cases[i].core);
        CHECK(left.relmse <= LEFT_MAX * core, "scene %u: %.3g of %.3g", i,
                left.relmse, core);
        NOTE("mesh: %.1e of %.1e is left", left.relmse, core);
    }
}

TEST(all_stages_but_the_camera_ray_are_rejected)
{
    static double picture[VALUES];
    case_t *c = cases + CORNELL;
    const double core = total_of(CORE, CORNELL).relmse;
    figures_t left;

    c->rounding.on = ROUNDING_ALL & ~((uint32_t)1 << ROUNDING_FRAME |
                                            (uint32_t)1 << ROUNDING_ORIGIN |
                                            (uint32_t)1 << ROUNDING_RAY);
    (void)measure(c, c->exact, picture);
    c->rounding.on = 0;
    left = compare(picture, c->core);
    CHECK(left.relmse > LEFT_MAX * core, "%.3g of %.3g", left.relmse, core);
    NOTE("%.1e of %.1e is left", left.relmse, core);
}

/* Two errors may have a common cause, which makes them add up or cancel. */
#define REST_FACTOR 2.5
/* Few samples pass an edge, and some do in more than one stage. */
#define EDGES_FACTOR 8.0

TEST(the_stages_add_up_to_the_core)
{
    for (unsigned i = 0; i < SCENES; i++) {
        const figures_t sum = total_of(SUM_OF_STAGES, i);
        const figures_t all = total_of(ALL_STAGES, i);
        const double ratio = sum.relmse / all.relmse;
        const double total =
                (sum.relmse + sum.edges) / total_of(CORE, i).relmse;

        CHECK(ratio < REST_FACTOR && ratio > 1 / REST_FACTOR,
                "scene %u: %.3g, %.3g at once", i, sum.relmse, all.relmse);
        CHECK(total < EDGES_FACTOR && total > 1 / EDGES_FACTOR,
                "scene %u: %.3g of the core's relMSE", i, total);
        NOTE("mesh: %.2f without edges, %.2f with them", ratio, total);
    }
}

/* ---- Curve -------------------------------------------------------------- */

#define CURVE_WORST 0.03 /* of 255 */
#define CURVE_MEAN  0.005

static bool curve_is_within(const rounding_error_t *e)
{
    return e->worst <= CURVE_WORST &&
           fabs(e->along) <= CURVE_MEAN * (double)e->count;
}

TEST(display_values_are_within_their_budget)
{
    for (unsigned i = 0; i < SCENES; i++) {
        unsigned long not_shown = 0;
        const rounding_error_t e = curve_error(cases + i, 0, &not_shown);

        CHECK(not_shown == 0, "%lu values are shown otherwise", not_shown);
        CHECK(curve_is_within(&e), "scene %u: worst %.4f, mean %.4f of 255", i,
                e.worst, e.along / (double)e.count);
        NOTE("worst %.3f, mean %.4f of 255", e.worst,
                e.along / (double)e.count);
    }
}

TEST(display_values_off_by_four_linear_steps_are_rejected)
{
    unsigned long not_shown = 0;
    const rounding_error_t e = curve_error(cases + CORNELL, 4, &not_shown);

    CHECK(!curve_is_within(&e), "accepted: worst %.4f", e.worst);
    NOTE("worst %.3f, mean %.4f of 255", e.worst, e.along / (double)e.count);
}

/* ---- The document ------------------------------------------------------- */

#define DOCUMENT "firmware/DESIGN.md"

TEST(design_md_has_this_table)
{
    size_t size;
    char *bytes = picture_load(DOCUMENT, &size), *text;

    CHECK(bytes != NULL, "cannot read " DOCUMENT);
    text = allocate(size + 1, 1);
    if (bytes != NULL) {
        memcpy(text, bytes, size);
    }
    text[size] = '\0';
    for (unsigned i = 0; i < ROWS; i++) {
        const row_t row = row_of(i);

        CHECK(strstr(text, row.text) != NULL,
                "make error-budget, and copy to " DOCUMENT ": %s", row.text);
    }
    free(text);
    free(bytes);
    NOTE("%u rows", (unsigned)ROWS);
}

int main(int argc, char **argv)
{
    open_cases();
    if (fail != NULL) {
        printf("known/budget         scenes_open FAIL %s\n", fail);
        return 1;
    }
    if (argc > 1 && strcmp(argv[1], "--table") == 0) {
        print_table();
        close_cases();
        return 0;
    }
    TEST_BEGIN("known/budget", argc, argv);
    RUN(without_rounding_the_reference_is_what_it_was);
    RUN(sine_and_cosine_is_within_its_budget);
    RUN(sine_and_cosine_two_bits_coarser_is_rejected);
    RUN(reciprocal_root_is_within_its_budget);
    RUN(reciprocal_root_two_bits_coarser_is_rejected);
    RUN(reciprocal_is_within_its_budget);
    RUN(reciprocal_two_bits_coarser_is_rejected);
    RUN(camera_origin_is_within_its_budget);
    RUN(camera_origin_two_bits_coarser_is_rejected);
    RUN(camera_direction_is_within_its_budget);
    RUN(camera_direction_two_bits_coarser_is_rejected);
    RUN(light_point_is_within_its_budget);
    RUN(light_point_two_bits_coarser_is_rejected);
    RUN(cosine_direction_is_within_its_budget);
    RUN(cosine_direction_two_bits_coarser_is_rejected);
    RUN(unit_normal_is_within_its_budget);
    RUN(unit_normal_two_bits_coarser_is_rejected);
    RUN(frame_is_within_its_budget);
    RUN(frame_two_bits_coarser_is_rejected);
    RUN(ray_parameter_is_within_its_budget);
    RUN(ray_parameter_two_bits_coarser_is_rejected);
    RUN(hit_point_is_within_its_budget);
    RUN(hit_point_two_bits_coarser_is_rejected);
    RUN(geometry_term_is_within_its_budget);
    RUN(geometry_term_two_bits_coarser_is_rejected);
    RUN(throughput_is_within_its_budget);
    RUN(throughput_two_bits_coarser_is_rejected);
    RUN(sum_is_within_its_budget);
    RUN(sum_two_bits_coarser_is_rejected);
    RUN(stored_albedo_is_within_its_budget);
    RUN(stored_albedo_two_bits_coarser_is_rejected);
    RUN(a_sum_that_truncates_is_rejected);
    RUN(rays_meet_what_they_meet_in_double);
    RUN(rays_turned_by_a_ten_thousandth_are_rejected);
    RUN(the_core_is_within_the_targets);
    RUN(all_stages_at_once_are_the_core);
    RUN(all_stages_but_the_camera_ray_are_rejected);
    RUN(the_stages_add_up_to_the_core);
    RUN(display_values_are_within_their_budget);
    RUN(display_values_off_by_four_linear_steps_are_rejected);
    RUN(design_md_has_this_table);
    close_cases();
    return TEST_END();
}
