/* board.h - BBC micro:bit (nRF51822): clocks, pins, addresses */
/* SPDX-License-Identifier: MIT */

#ifndef BOARD_H
#define BOARD_H

#ifndef QL_PORT_EMULATED
#define QL_PORT_EMULATED 0
#endif

/* TIMER0 counts the CPU's clock. Under QEMU's -icount shift=0 an instruction
 * takes 1 ns, so a tick is 62.5 instructions. */
#define QL_PORT_CPU_HZ  16000000ul
#define QL_PORT_TICK_HZ QL_PORT_CPU_HZ

/* The 5x5 LEDs show no picture. */
#define QL_PORT_PANEL_WIDTH  0
#define QL_PORT_PANEL_HEIGHT 0
#define QL_PORT_PANEL_FORMAT QL_FORMAT_GRAY8

/* Pins of the serial port of the interface chip's USB. */
#define PIN_TX 24u
#define PIN_RX 25u

#define CLOCK_HFCLKSTART   0x40000000u
#define CLOCK_HFCLKSTARTED 0x40000100u
#define GPIO_OUTSET        0x50000508u
#define GPIO_DIRSET        0x50000518u

#define UART_STARTRX     0x40002000u
#define UART_STARTTX     0x40002008u
#define UART_RXDRDY      0x40002108u
#define UART_TXDRDY      0x4000211cu
#define UART_ENABLE      0x40002500u /* 4: on */
#define UART_PSELTXD     0x4000250cu
#define UART_PSELRXD     0x40002514u
#define UART_RXD         0x40002518u
#define UART_TXD         0x4000251cu
#define UART_BAUDRATE    0x40002524u
#define UART_BAUD_115200 0x01d7e000u

#define TIMER0_START     0x40008000u
#define TIMER0_CAPTURE0  0x40008040u
#define TIMER0_BITMODE   0x40008508u /* 3: 32 bits */
#define TIMER0_PRESCALER 0x40008510u
#define TIMER0_CC0       0x40008540u

#endif
