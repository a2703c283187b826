/* ql_hal.h - what a board must provide: nine functions */
/* SPDX-License-Identifier: MIT */

/* The application (firmware/app/) calls these; the core never does. A board is
 * a folder under hal/boards/ with board.c, board.h, board.mk and a README;
 * hal/template/ is a board that does nothing. See hal/README.md. */

#ifndef QL_HAL_H
#define QL_HAL_H

#include "base/ql_base.h"
#include "base/ql_format.h"

QL_C_BEGIN

/* What the board's panel shows. width 0 means there is no panel. */
typedef struct {
    uint16_t width; /* px */
    uint16_t height;
    ql_format_t format;
} ql_hal_display_t;

/* Bring up clocks, serial port, counter and panel. Called once, first. */
QL_MUST_CHECK ql_status_t ql_hal_init(void);

/* Describe the panel: fills info. */
void ql_hal_display_info(ql_hal_display_t *info);

/* Show line y, from the top. pixels holds QL_LINE_BYTES(width, format) bytes
 * and may be reused when the call returns. Returns QL_OK or QL_ERR_DISPLAY. */
QL_MUST_CHECK ql_status_t ql_hal_display_write(
        uint16_t y, const uint8_t *pixels);

/* Send size bytes on the serial port; returns when they are handed over, QL_OK
 * or QL_ERR_SERIAL. */
QL_MUST_CHECK ql_status_t ql_hal_serial_write(
        const uint8_t *bytes, uint16_t size);

/* A free-running counter of QL_PORT_TICK_HZ; wraps at 32 bits. On emulators
 * that count instructions it is a count of instructions. */
uint32_t ql_hal_ticks(void);

/* The scene: blob and its size in bytes, in flash (or in memory on a PC). */
void ql_hal_scene_blob(const void **blob, size_t *size);

/* True when the user wants the render to stop (a button, a serial byte,
 * Ctrl-C). Asked between lines. */
bool ql_hal_stop_requested(void);

/* The program is over: power down, or leave the emulator with this status. */
void ql_hal_exit(ql_status_t status);

/* Our own code is wrong at code/line: report it as the board can, then stop. */
void ql_hal_panic(uint16_t code, uint16_t line);

QL_C_END

#endif
