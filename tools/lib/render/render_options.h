/* render_options.h - what qlux-sim was asked to do */
/* SPDX-License-Identifier: MIT */

#ifndef SIM_OPTIONS_H
#define SIM_OPTIONS_H

#include "lib/render/develop.h"
#include "base/ql_settings.h"

/* A range [first, end); end 0 is up to the last. */
typedef struct {
    uint32_t first;
    uint32_t end;
} sim_range_t;

typedef struct {
    const char *scene;      /* path of the blob */
    const char *picture;    /* -o, or NULL */
    const char *save;       /* --save-sums, or NULL */
    const char *map;        /* --samples-map, or NULL */
    image_kind_t kind;      /* of the picture */
    ql_format_t format;     /* of the display */
    ql_settings_t settings; /* width and height 0: the scene's own */
    sim_range_t rows;
    sim_range_t samples; /* resolved: within [0, spp) */
    unsigned threads;
    bool stats;
    bool quiet;
} render_options_t;

/* Parse the command line, or cli_fail(CLI_USAGE). Rows are checked against the
 * height later, by render_options_rows(), when it is known. */
void render_options_parse(render_options_t *options, int argc, char **argv);

/* Resolve rows for a picture of some height, or cli_fail(CLI_USAGE). */
void render_options_rows(render_options_t *options, uint32_t height);

#endif
