/* ql_panel.h - the picture on the board's panel, line by line */
/* SPDX-License-Identifier: MIT */

/* A picture larger than the panel is cropped at its middle, a smaller one is
 * centred on black; pixels are never scaled. Without QL_CFG_PANEL, or on a
 * board that has no panel, all of this does nothing. */

#ifndef QL_PANEL_H
#define QL_PANEL_H

#include "ql_hal.h"
#include "qlux.h"

QL_C_BEGIN

/* Bytes of working memory for a picture of this width; 0 without a panel, whose
 * width is 0. Constant when its arguments are. */
#define QL_PANEL_BYTES(width, panel_width, panel_format)                       \
    ((panel_width) == 0                                                        \
                    ? 0u                                                       \
                    : QL_LINE_BYTES((width) > (panel_width) ? (width)          \
                                                            : (panel_width),   \
                              panel_format))

#if QL_CFG_PANEL
/* Where the picture lies on the panel, in one dimension: the picture's pixel
 * crop is the first one shown, at the panel's pixel pad. One of them is 0. */
typedef struct {
    uint16_t crop;
    uint16_t pad;
} ql_panel_place_t;

typedef struct {
    ql_hal_display_t display;
    uint16_t height;     /* px, of the picture */
    uint8_t *pixels;     /* the picture's line in the panel's format */
    const uint8_t *line; /* what the panel shows of it */
    ql_panel_place_t x, y;
} ql_panel_t;

/* Ask for the panel, give it its working memory, and blank it.
 *
 *   panel       -      out
 *   settings    -      with width and height resolved, as in ql_render_t
 *   work        -      all zero; must outlive panel
 *   work_bytes  bytes  of it
 *   return      QL_OK; QL_ERR_SETTINGS if work has less than QL_PANEL_BYTES(),
 *               QL_ERR_DISPLAY if the build lacks its format or the HAL failed
 */
QL_MUST_CHECK ql_status_t ql_panel_begin(ql_panel_t *panel,
        const ql_settings_t *settings, uint8_t *work, size_t work_bytes);

/* Where a line is to be encoded for the panel.
 *
 *   panel   -  from ql_panel_begin()
 *   output  -  out: for ql_render_line(); as it was if 0 is returned
 *   return  how many outputs the panel takes, 0 or 1
 */
uint8_t ql_panel_output(const ql_panel_t *panel, ql_output_t *output);

/* Show a line that was encoded, also in place of lines that are still to come.
 *
 *   panel   -   from ql_panel_begin()
 *   y       px  the line's number
 *   rows    px  1 or more: lines y to y + rows - 1 show it
 *   return  QL_OK or QL_ERR_DISPLAY
 */
QL_MUST_CHECK ql_status_t ql_panel_line(
        const ql_panel_t *panel, uint16_t y, uint16_t rows);
#else
typedef struct {
    uint8_t nothing;
} ql_panel_t;

QL_INLINE ql_status_t ql_panel_begin(ql_panel_t *panel,
        const ql_settings_t *settings, uint8_t *work, size_t work_bytes)
{
    return (void)panel, (void)settings, (void)work, (void)work_bytes, QL_OK;
}

QL_INLINE uint8_t ql_panel_output(const ql_panel_t *panel, ql_output_t *output)
{
    return (void)panel, (void)output, 0;
}

QL_INLINE ql_status_t ql_panel_line(
        const ql_panel_t *panel, uint16_t y, uint16_t rows)
{
    return (void)panel, (void)y, (void)rows, QL_OK;
}
#endif

QL_C_END

#endif
