/* board.h - SiFive HiFive1 (FE310-G000): clocks, pins, addresses */
/* SPDX-License-Identifier: MIT */

#ifndef BOARD_H
#define BOARD_H

#ifndef QL_PORT_EMULATED
#define QL_PORT_EMULATED 0
#endif

/* The crystal, unmultiplied. */
#define QL_PORT_CPU_HZ 16000000ul
#define QL_PORT_BAUD   115200ul

/* A tick is 16 counts of mcycle: cycles on the chip, and instructions, of 1 ns
 * each, under QEMU's -icount shift=0. */
#define QL_PORT_TICK_SHIFT 4
#if QL_PORT_EMULATED
#define QL_PORT_TICK_HZ (1000000000ul >> QL_PORT_TICK_SHIFT)
#else
#define QL_PORT_TICK_HZ (QL_PORT_CPU_HZ >> QL_PORT_TICK_SHIFT)
#endif

#define QL_PORT_PANEL_WIDTH  0
#define QL_PORT_PANEL_HEIGHT 0
#define QL_PORT_PANEL_FORMAT QL_FORMAT_GRAY8

/* Clocks. */
#define PRCI_HFXOSCCFG 0x10008004u /* bit 30: on, 31: ready */
#define PRCI_PLLCFG    0x10008008u /* bit 16: use, 17: crystal, 18: bypass */

/* Pins 16 and 17 belong to UART0 when IOF is enabled for them. */
#define GPIO_IOF_EN  0x10012038u
#define GPIO_IOF_SEL 0x1001203cu
#define PINS_UART0   (3u << 16)

#define UART0_TXDATA 0x10013000u /* bit 31: full */
#define UART0_RXDATA 0x10013004u /* bit 31: empty */
#define UART0_TXCTRL 0x10013008u
#define UART0_RXCTRL 0x1001300cu
#define UART0_DIV    0x10013018u

#endif
