/* board.h - Arm MPS2 with AN386: clocks, addresses */
/* SPDX-License-Identifier: MIT */

#ifndef BOARD_H
#define BOARD_H

#ifndef QL_PORT_EMULATED
#define QL_PORT_EMULATED 0
#endif

/* Timer 0 counts the 25 MHz clock. Under QEMU's -icount shift=0 an instruction
 * takes 1 ns, so a tick is 40 instructions. */
#define QL_PORT_CPU_HZ  25000000ul
#define QL_PORT_TICK_HZ QL_PORT_CPU_HZ
#define QL_PORT_BAUD    115200ul

/* The board has a panel; this port does not drive it. */
#define QL_PORT_PANEL_WIDTH  0
#define QL_PORT_PANEL_HEIGHT 0
#define QL_PORT_PANEL_FORMAT QL_FORMAT_RGB565_BE

/* CMSDK timer 0: counts down. */
#define TIMER0_CTRL   0x40000000u /* 1: on */
#define TIMER0_VALUE  0x40000004u
#define TIMER0_RELOAD 0x40000008u

/* CMSDK UART 0. */
#define UART0_DATA    0x40004000u
#define UART0_STATE   0x40004004u /* bit 0: full, 1: something received */
#define UART0_CTRL    0x40004008u /* bit 0: transmit, 1: receive */
#define UART0_BAUDDIV 0x40004010u

#endif
