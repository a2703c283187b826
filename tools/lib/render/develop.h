/* develop.h - sums of samples to a picture: linear, or as a display shows it */
/* SPDX-License-Identifier: MIT */

#ifndef DEVELOP_H
#define DEVELOP_H

#include "lib/image/image_file.h"
#include "film/ql_curve.h"
#include "film/ql_tonemap.h"
#include "lib/sums/sums.h"

/* Names of ql_format_t, as an option takes them; NULL ends them. */
extern const char *const develop_formats[QL_FORMAT_COUNT + 1];

/* How a picture is made, and where its sums come from. */
typedef struct {
    image_kind_t kind;   /* IMAGE_PFM: linear radiance in the units of Ke, the
                           mean rounded once to the nearest float, without
                           exposure. Others: the bits of ql_render_line() in
                           the format, widened by widen_line() */
    ql_format_t format;  /* of the display */
    ql_curve_t curve;    /* likewise */
    int16_t exposure_q8; /* stops, s7.8, brighter than the scene's exposure; not
                           of IMAGE_PFM */
    const ql_sum_t *(*row)(void *from, uint32_t y); /* width pixels, good until
                           it is called again; NULL: those in memory */
    void *from;
} develop_t;

/* Write a picture into an open file, a row at a time.
 *
 *   sums  -  fields and what sums_settle() knows; rows without samples are
 *            black, and not asked for
 */
void develop_write(const sums_t *sums, const develop_t *how, cli_out_t *out);

/* One row of it.
 *
 *   line    -  in and out: of one row, with floats or bytes
 *   pixels  -  of row y; not used if it is without samples
 */
void develop_row(image_t *line, const sums_t *sums, const ql_sum_t *pixels,
        uint32_t y, const develop_t *how);

#endif
