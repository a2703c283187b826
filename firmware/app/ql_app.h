/* ql_app.h - the product loop: open the scene, render lines, send and show */
/* SPDX-License-Identifier: MIT */

/* The one place where core and HAL meet. A picture leaves as the frames of
 * ql_stream.h, RGB888, and at the same time goes to the board's panel if it has
 * one (ql_panel.h). */

#ifndef QL_APP_H
#define QL_APP_H

#include "app/ql_panel.h"
#include "app/ql_stream.h"
#include "ql_hal.h"
#include "qlux.h"

QL_C_BEGIN

/* Links with firmware of the same gates only (ql_config.h). */
#define ql_app_run QL_GATED(ql_app_run)

#define QL_APP_MAX(a, b) ((a) > (b) ? (a) : (b))

/* Bytes of working memory of one run: one frame, and one line of the panel.
 * panel_width is 0 without a panel. Constant when its arguments are. */
#define QL_WORK_BYTES(width, panel_width, panel_format)                        \
    (QL_APP_FRAME_BYTES(width) +                                               \
            QL_PANEL_BYTES(width, panel_width, panel_format))

/* The part of it that holds a frame; the panel's line follows. */
#define QL_APP_FRAME_BYTES(width)                                              \
    QL_APP_MAX(QL_STREAM_FRAME_BYTES(QL_STREAM_END_BYTES),                     \
            QL_STREAM_LINE_FRAME(width, QL_FORMAT_RGB888))

/* One run. */
typedef struct {
    ql_settings_t settings; /* width or height 0 means the scene's own */
    uint8_t interlace;      /* px between lines of the first pass: 1, 2, 4,
                                   .. 128; each pass halves it */
    uint8_t *work;          /* QL_WORK_BYTES(...), all zero */
    size_t work_bytes;
    uint32_t tick_hz; /* of ql_hal_ticks(); goes into the stream */
} ql_app_t;

/* Render one picture, from ql_hal_init() to the stream's last frame.
 *
 *   app     -  what to do, and the memory to do it in
 *   return  QL_OK, or the first error, which the last frame carries too:
 *           QL_ERR_SETTINGS  a setting is out of range, work is too small, or
 *                            QL_CFG_FORMATS lacks the stream's, RGB888
 *           QL_ERR_STOPPED   the user asked; the lines sent so far are good
 *           QL_ERR_DISPLAY, QL_ERR_SERIAL  the HAL failed
 *           any status of ql_blob_open()
 */
ql_status_t ql_app_run(const ql_app_t *app);

QL_C_END

#endif
