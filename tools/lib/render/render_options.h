/* render_options.h - the options that every renderer of blobs takes */
/* SPDX-License-Identifier: MIT */

#ifndef RENDER_OPTIONS_H
#define RENDER_OPTIONS_H

#include "base/ql_settings.h"
#include "lib/program/options.h"
#include "lib/render/develop.h"

typedef struct {
    const char *scene;      /* path of the blob */
    const char *picture;    /* -o, or NULL */
    const char *save;       /* --save-sums, or NULL */
    const char *map;        /* --samples-map, or NULL */
    const char *resume;     /* --resume, or NULL */
    bool progressive;       /* renew the picture while it is rendered */
    image_kind_t kind;      /* of the picture */
    ql_format_t format;     /* of the display */
    ql_settings_t settings; /* width and height 0: the scene's own */
    option_range_t rows;    /* end 0: all; see render_options_rows() */
    option_range_t samples; /* within [0, spp) */
    unsigned threads;
    bool stats;
    bool show; /* draw the picture in the terminal */
    bool quiet;

    /* As they were given; render_options_parse() puts them into settings. */
    option_size_t size;
    double error;
    double exposure;
    double clamp;
    bool roulette;
} render_options_t;

/* Words in the order of the core's enums, as develop_formats are. */
extern const char *const render_words_sampler[];
extern const char *const render_words_direct[];
extern const char *const render_words_indirect[];
extern const char *const render_words_lights[];
extern const char *const render_words_curve[];
extern const char *const render_words_exposure[]; /* beside stops */

/* Parts of a program's table. Their fields lie in a render_options_t. */
extern const option_t render_options_scene[];    /* SCENE.qlb */
extern const option_t render_options_picture[];  /* -o, --format */
extern const option_t render_options_settings[]; /* --size, --spp, .. */
extern const option_t render_options_error[];    /* --error, if it is built */
extern const option_t render_options_part[];     /* --rows, --samples */
extern const option_t render_options_sums[];     /* --save-sums, .. */
extern const option_t render_options_run[];      /* --threads, --stats, .. */

/* Take the command line of a program, or options_fail().
 *
 *   program     -  whose sections have one or more of the parts above
 *   argc, argv  -  as main() has them
 *   into        -  out: a struct that begins with a render_options_t, which is
 *                  set to the defaults; what lies behind that is the caller's
 */
void render_options_parse(
        const program_t *program, int argc, char **argv, void *into);

/* What --exposure says.
 *
 *   stops        -     the option's field
 *   exposure_q8  s7.8  out: stops, 0 if they are to be metered
 *   metered      -     out
 */
void render_options_expose(double stops, int16_t *exposure_q8, bool *metered);

/* There is no picture as a display shows it: options_fail() if one of
 * --format, --exposure and --curve was given. */
void render_options_display(void);

/* Resolve rows for a picture of some height, or options_fail(). */
void render_options_rows(render_options_t *options, uint32_t height);

/* Print how light is found, whatever auto was: lines of "key: value". */
void render_options_print(const ql_settings_t *settings);

#endif
