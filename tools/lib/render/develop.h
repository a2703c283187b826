/* develop.h - sums of samples to a picture: linear, or as a display shows it */
/* SPDX-License-Identifier: MIT */

#ifndef DEVELOP_H
#define DEVELOP_H

#include "lib/image/image_file.h"
#include "film/ql_tonemap.h"
#include "lib/render/sums.h"

/* Names of ql_format_t, as an option takes them; NULL ends them. */
extern const char *const develop_formats[QL_FORMAT_COUNT + 1];

/* Make a picture of the kind that a file needs.
 *
 *   image   -  out: to be freed
 *   sums    -  rows without samples stay black
 *   kind    -  IMAGE_PFM: linear radiance in the units of Ke, the mean rounded
 *              once to the nearest float, without exposure. Others: the bits
 *              of ql_render_line() in the format, widened by widen_line()
 *   format  -  of the display
 */
void develop(image_t *image, const sums_t *sums, image_kind_t kind,
        ql_format_t format);

/* Row y of it, from width pixels.
 *
 *   image   -  in and out: with floats or bytes; of one row, or the picture
 *   pixels  -  of the row; sums has no other part in it than fields and ranges
 */
void develop_row(image_t *image, const sums_t *sums, const ql_sum_t *pixels,
        uint32_t y, ql_format_t format);

/* The same, straight into an open file. */
void develop_write(const sums_t *sums, image_kind_t kind, ql_format_t format,
        cli_out_t *out);

#endif
