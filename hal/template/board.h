/* board.h - a board that does nothing: copy this folder to begin a port */
/* SPDX-License-Identifier: MIT */

#ifndef BOARD_H
#define BOARD_H

/* 1 when the firmware is to leave an emulator at its end, set by make. */
#ifndef QL_PORT_EMULATED
#define QL_PORT_EMULATED 0
#endif

/* The CPU's clock, by which make says how long a picture takes at least, and
 * how fast ql_hal_ticks() counts. */
#define QL_PORT_CPU_HZ  16000000ul
#define QL_PORT_TICK_HZ 1000000ul

/* The panel: all 0 without one. Sizes the line buffer at compile time. */
#define QL_PORT_PANEL_WIDTH  0
#define QL_PORT_PANEL_HEIGHT 0
#define QL_PORT_PANEL_FORMAT QL_FORMAT_RGB565_BE

#endif
