/* widen.h - a display's line as RGB of eight bits a channel */
/* SPDX-License-Identifier: MIT */

#ifndef WIDEN_H
#define WIDEN_H

#include <stdint.h>

#include "film/ql_tonemap.h"

/* What a display shows, for a picture file: black stays 0, white becomes 255.
 *
 *   rgb     -   out: 3 * width bytes
 *   line    -   QL_LINE_BYTES(width, format) bytes
 *   format  -   of the display; five bits widen as v << 3 | v >> 2, six as
 *               v << 2 | v >> 4, four as 17 v
 *   width   px  any
 */
void widen_line(
        uint8_t *rgb, const uint8_t *line, ql_format_t format, uint32_t width);

#endif
