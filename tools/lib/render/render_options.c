/* render_options.c - the options that every renderer of blobs takes */
/* SPDX-License-Identifier: MIT */

#include "lib/render/render_options.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

#include "qlux.h"

#define THREADS_MAX 1024
#define AT(field)   OPTION_FIELD(render_options_t, field)

/* Words in the order of the core's enums, as develop_formats are. */
const char *const render_words_sampler[] = {"random", "sobol", NULL};
const char *const render_words_direct[] = {"none", "area", "hemisphere",
        "cosine", "solid-angle", "mis", "auto", NULL};
const char *const render_words_indirect[] = {
        "none", "cosine", "uniform", "brdf", NULL};
const char *const render_words_lights[] = {
        "power", "all", "uniform", "auto", NULL};
const char *const render_words_exposure[] = {"auto", NULL};
const char *const render_words_curve[] = {"srgb", "filmic", "reinhard", NULL};

static const char *const pictures[] = {".ppm", ".pfm", ".png", NULL};
static const char *const linear[] = {".pfm", NULL};

const option_t render_options_scene[] = {
        {"SCENE.qlb", OPTION_TEXT, AT(scene), .required = true}, OPTION_END};

const option_t render_options_picture[] = {
        {"-o FILE", OPTION_FILE, AT(picture), .words = pictures,
                .help = ".ppm and .png as a display shows it, .pfm linear "
                        "radiance in the units of Ke"},
        {"--format F", OPTION_WORD, AT(format), .words = develop_formats,
                .help = "of the display, widened to 8-bit RGB"},
        OPTION_END};

const option_t render_options_settings[] = {
        {"--size WxH", OPTION_SIZE, AT(size), .min = 1, .max = QL_IMAGE_MAX,
                .preset = "the scene's own", .help = "pixels"},
        {"--spp N", OPTION_NUMBER, AT(settings.spp), .min = 1,
                .max = QL_SPP_MAX, .help = "samples a pixel"},
        {"--seed N", OPTION_NUMBER, AT(settings.seed), .max = UINT32_MAX,
                .help = "of the random numbers"},
        {"--sampler S", OPTION_WORD, AT(settings.sampler),
                .words = render_words_sampler, .help = "points of a pixel"},
        {"--direct D", OPTION_WORD, AT(settings.direct),
                .words = render_words_direct,
                .help = "light straight from emitters; auto is what qlux-scene "
                        "found best in the scene"},
        {"--indirect I", OPTION_WORD, AT(settings.indirect),
                .words = render_words_indirect,
                .help = "light from other surfaces, by directions"},
        {"--bounces N", OPTION_NUMBER, AT(settings.bounces),
                .max = QL_BOUNCES_MAX, .help = "indirect reflections"},
        {"--lights L", OPTION_WORD, AT(settings.lights),
                .words = render_words_lights,
                .help = "emitters asked at a hit; power and uniform ask one"},
        {"--light-samples N", OPTION_NUMBER, AT(settings.light_samples),
                .min = 1, .max = UINT8_MAX,
                .help = "of each emitter asked; directions, by hemisphere and "
                        "cosine"},
        {"--roulette", OPTION_FLAG, AT(roulette),
                .help = "end paths at random, by their throughput"},
#if QL_CFG_CLAMP
        {"--clamp X", OPTION_REAL, AT(clamp), .max = UINT16_MAX,
                .preset = "0, which is off",
                .help = "cut contributions above this radiance, in the units "
                        "of Ke; biased: --stats tells by how much"},
#endif
        {"--exposure S", OPTION_REAL, AT(exposure), .min = -64, .max = 64,
                .words = render_words_exposure,
                .help = "stops brighter than the scene's own exposure; auto "
                        "meters the picture"},
#if QL_ROLL_OFF
        {"--curve C", OPTION_WORD, AT(settings.curve),
                .words = render_words_curve,
                .help = "how bright light is shown; filmic and reinhard let "
                        "it roll off to white"},
#endif
        OPTION_END};

const option_t render_options_error[] = {
#if QL_CFG_ADAPTIVE
        {"--error E", OPTION_REAL, AT(error), .max = 0.99999,
                .preset = "0, which is off",
                .help = "end a pixel at this standard error, a part of its "
                        "mean; after 32 to --spp samples, by the error of "
                        "independent ones: sobol errs less"},
#endif
        OPTION_END};

const option_t render_options_part[] = {
        {"--rows A:B", OPTION_RANGE, AT(rows), .max = QL_IMAGE_MAX,
                .help = "only rows A to B-1, the rest black"},
        {"--samples A:B", OPTION_RANGE, AT(samples), .max = QL_SPP_MAX,
                .help = "only samples A to B-1 of each pixel"},
        OPTION_END};

const option_t render_options_sums[] = {
        {"--save-sums FILE", OPTION_FILE, AT(save),
                .help = "exact sums, for qlux-merge (.qls)"},
        {"--resume FILE", OPTION_TEXT, AT(resume),
                .help = "go on with the sums of a run that was interrupted"},
        {"--progressive", OPTION_FLAG, AT(progressive),
                .help = "renew the picture after 1, 2, 4, .. samples a pixel"},
        {"--show", OPTION_FLAG, AT(show),
                .help = "draw the picture in the terminal, in place of a bar"},
        {"--samples-map FILE", OPTION_FILE, AT(map), .words = linear,
                .help = "how many samples each pixel took (.pfm)"},
        OPTION_END};

const option_t render_options_run[] = {
        {"--threads N", OPTION_NUMBER, AT(threads), .min = 1,
                .max = THREADS_MAX, .preset = "one a processor",
                .help = "to render on"},
        {"--stats", OPTION_FLAG, AT(stats),
                .help = "print counts and seconds as lines of \"key: value\""},
        {"--quiet", OPTION_FLAG, AT(quiet), .help = "no progress bar"},
        OPTION_END};

static unsigned count_processors(void)
{
    long n = 1;

#ifdef _SC_NPROCESSORS_ONLN
    n = sysconf(_SC_NPROCESSORS_ONLN);
#endif
    return n < 1 ? 1 : n > THREADS_MAX ? THREADS_MAX : (unsigned)n;
}

/* The part of 1 at which pixels end, to the nearest 2^-16. A pixel that ends by
 * itself holds no range of samples. */
static void take_error(render_options_t *o)
{
#if QL_CFG_ADAPTIVE
    o->settings.error_q16 = QL_ERROR_Q16(o->error); /* at most 65535 */
    if (o->error > 0 && o->settings.error_q16 == 0) {
        options_fail("'--error' is 0, or 0.00001 or more");
    }
    if (o->error > 0 && (o->save != NULL || o->samples.end != 0 ||
                                o->resume != NULL || o->progressive)) {
        options_fail("'--error' goes with none of '--samples', '--save-sums', "
                     "'--resume' and '--progressive': pixels end at samples of "
                     "their own");
    }
#else
    (void)o;
#endif
}

void render_options_expose(double stops, int16_t *exposure_q8, bool *metered)
{
    *metered = stops == HUGE_VAL;
    *exposure_q8 = *metered ? 0 : (int16_t)lround(stops * 256); /* < 2^15 */
}

/* The radiance to the nearest 2^-16. */
static void take_clamp(render_options_t *o)
{
#if QL_CFG_CLAMP
    o->settings.clamp_q16 = QL_CLAMP_Q16(o->clamp); /* at most 65535 2^16 */
    if (o->clamp > 0 && o->settings.clamp_q16 == 0) {
        options_fail("'--clamp' is 0, or 0.0001 or more");
    }
#else
    (void)o;
#endif
}

static void take_samples(render_options_t *o)
{
    if (o->samples.end == 0) {
        o->samples.end = o->settings.spp;
    } else if (!options_given("--spp")) {
        o->settings.spp = o->samples.end;
    } else if (o->samples.end > o->settings.spp) {
        options_fail("'--samples %u:%u': '--spp %u' ends before that",
                (unsigned)o->samples.first, (unsigned)o->samples.end,
                (unsigned)o->settings.spp);
    }
}

/* ---- Settings without effect --------------------------------------------- */

/* A member of ql_settings_t from first to last. */
typedef struct {
    const char *member;
    size_t at;
    unsigned first, last;
} range_t;

#define RANGE(member, first, last)                                             \
    {                                                                          \
#member, offsetof(ql_settings_t, member), first, last                  \
    }
#define IDLE(member, first, last, where, where_first, where_last)              \
    {RANGE(member, first, last), RANGE(where, where_first, where_last)},

static const range_t idle[][2] = {QL_SETTINGS_IDLE(IDLE)};

static unsigned value_of(const ql_settings_t *settings, const range_t *range)
{
    return *((const uint8_t *)settings + range->at);
}

static bool is_within(const ql_settings_t *settings, const range_t *range)
{
    const unsigned value = value_of(settings, range);

    return value >= range->first && value <= range->last;
}

/* "--light-samples 4" of a member. */
static void describe(char *text, size_t size, const ql_settings_t *settings,
        const range_t *range)
{
    const unsigned value = value_of(settings, range);
    const option_t *option = render_options_settings;
    char name[32];

    snprintf(name, sizeof name, "--%s", range->member);
    for (char *c = name; (c = strchr(c, '_')) != NULL;) {
        *c = '-';
    }
    while (strncmp(option->name, name, strcspn(option->name, " ")) != 0) {
        option++;
    }
    if (option->kind == OPTION_FLAG) {
        snprintf(text, size, "%s", name);
    } else if (option->kind == OPTION_WORD) {
        snprintf(text, size, "%s %s", name, option->words[value]);
    } else {
        snprintf(text, size, "%s %u", name, value);
    }
}

/* Say which settings change nothing, unless they are the defaults. */
static void warn_of_idle(const ql_settings_t *s, const ql_settings_t *defaults)
{
    for (size_t i = 0; i < sizeof idle / sizeof *idle; i++) {
        const range_t *what = &idle[i][0], *where = &idle[i][1];
        char option[64], other[64];

        if (is_within(s, what) && is_within(s, where) &&
                value_of(s, what) != value_of(defaults, what)) {
            describe(option, sizeof option, s, what);
            describe(other, sizeof other, s, where);
            cli_warn("'%s' has no effect with '%s'", option, other);
        }
    }
}

void render_options_display(void)
{
    static const char *const options[] = {"--format", "--exposure", "--curve"};

    for (unsigned i = 0; i < sizeof options / sizeof *options; i++) {
        if (options_given(options[i])) {
            options_fail(
                    "'%s' needs '-o' with a .ppm or .png name", options[i]);
        }
    }
}

void render_options_parse(
        const program_t *program, int argc, char **argv, void *into)
{
    static const render_options_t start = {.settings = QL_SETTINGS_DEFAULT};
    render_options_t *o = into;
    bool metered;

    *o = start;
    o->threads = count_processors();
    options_parse(program, argc, argv, into);
    if (o->picture != NULL) {
        o->kind = image_kind(o->picture);
    }
    if (o->picture == NULL || o->kind == IMAGE_PFM) {
        render_options_display();
    }
    o->settings.width = (uint16_t)o->size.width; /* at most QL_IMAGE_MAX */
    o->settings.height = (uint16_t)o->size.height;
    o->settings.roulette = o->roulette;
    render_options_expose(o->exposure, &o->settings.exposure_q8, &metered);
    o->settings.meter = metered;
    if (o->progressive &&
            (o->picture == NULL || strcmp(o->picture, "-") == 0)) {
        options_fail("'--progressive' needs '-o' with a name");
    }
    take_error(o);
    take_clamp(o);
    take_samples(o);
    warn_of_idle(&o->settings, &start.settings);
}

void render_options_rows(render_options_t *options, uint32_t height)
{
    if (options->rows.end == 0) {
        options->rows.end = height;
    }
    if (options->rows.end > height) {
        options_fail("'--rows %u:%u': expected rows from 0 to %u",
                (unsigned)options->rows.first, (unsigned)options->rows.end,
                (unsigned)height);
    }
}

void render_options_print(const ql_settings_t *settings)
{
    printf("direct: %s\n", render_words_direct[settings->direct]);
    printf("lights: %s\n", render_words_lights[settings->lights]);
}
