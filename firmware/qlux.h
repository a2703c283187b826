/* qlux.h - the whole public API: open a scene, render a line, read pixels */
/* SPDX-License-Identifier: MIT */

/* Synopsis (tests/unit/test_api.c compiles and runs it):
 *
 *     static uint8_t line[QL_LINE_BYTES(128, QL_FORMAT_RGB888)];
 *     ql_scene_t scene;
 *     ql_render_t render;
 *     ql_settings_t settings = QL_SETTINGS_DEFAULT;
 *     const ql_output_t output = {QL_FORMAT_RGB888, line};
 *
 *     settings.width = 128;
 *     settings.height = 64;
 *     if (ql_blob_open(&scene, blob, blob_size) == QL_OK &&
 *             ql_render_init(&render, &scene, &settings) == QL_OK) {
 *         for (uint16_t y = 0; y < 64; y++) {
 *             ql_render_line(&render, y, &output, 1);
 *             send(line);
 *         }
 *     }
 *
 * A picture is a pure function of (blob, settings): compiler, word size, byte
 * order, order of lines and threads change no bit of it. The core owns no
 * memory; a ql_render_t is changed while rendering, and as before but for its
 * counters afterwards, so give each thread its own copy. */

#ifndef QLUX_H
#define QLUX_H

#include "blob/ql_blob_open.h"
#include "render/ql_line.h"

/* Numbers for #if, major * 65536 + minor * 256 + patch in one; and text. */
#define QLUX_VERSION_MAJOR 0
#define QLUX_VERSION_MINOR 1
#define QLUX_VERSION_PATCH 0
#define QLUX_VERSION_NUMBER                                                    \
    (QLUX_VERSION_MAJOR * 65536l + QLUX_VERSION_MINOR * 256 +                  \
            QLUX_VERSION_PATCH)
#define QLUX_VERSION                                                           \
    QLUX_VERSION_TEXT(                                                         \
            QLUX_VERSION_MAJOR, QLUX_VERSION_MINOR, QLUX_VERSION_PATCH)
#define QLUX_VERSION_TEXT(major, minor, patch)                                 \
    QLUX_VERSION_TEXT_(major, minor, patch)
#define QLUX_VERSION_TEXT_(major, minor, patch) #major "." #minor "." #patch

#endif
