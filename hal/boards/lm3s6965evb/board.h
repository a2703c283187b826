/* board.h - LM3S6965 evaluation kit: clocks, pins, addresses */
/* SPDX-License-Identifier: MIT */

#ifndef BOARD_H
#define BOARD_H

#ifndef QL_PORT_EMULATED
#define QL_PORT_EMULATED 0
#endif

/* The PLL's 200 MHz by 4. SysTick counts CPU clocks. Under QEMU's -icount
 * shift=0 an instruction takes 1 ns, so a tick is 20 instructions. */
#define QL_PORT_CPU_HZ  50000000ul
#define QL_PORT_TICK_HZ QL_PORT_CPU_HZ
#define QL_PORT_BAUD    115200ul

/* The OLED, an SSD0323. */
#define QL_PORT_PANEL_WIDTH  128
#define QL_PORT_PANEL_HEIGHT 64
#define QL_PORT_PANEL_FORMAT QL_FORMAT_GRAY4

/* System control. */
#define SYSCTL_RIS   0x400fe050u /* bit 6: the PLL has locked */
#define SYSCTL_RCC   0x400fe060u
#define SYSCTL_RCGC1 0x400fe104u /* clocks: bit 0 UART0, bit 4 SSI0 */
#define SYSCTL_RCGC2 0x400fe108u /* clocks: bits 0.. GPIO port A.. */

/* GPIO ports. The address of a data register says which bits it touches.
 *   A  0, 1 UART0; 2 SSI clock, 5 SSI data; 3 panel select, low
 *   C  7 panel data/command
 *   D  0 SD card select, low */
#define GPIO_A          0x40004000u
#define GPIO_C          0x40006000u
#define GPIO_D          0x40007000u
#define GPIO_DATA(bits) (4u * (bits))
#define GPIO_DIR        0x400u
#define GPIO_AFSEL      0x420u
#define GPIO_DEN        0x51cu

/* UART0, a PL011. */
#define UART0     0x4000c000u
#define UART_DR   0x00u
#define UART_FR   0x18u /* bit 4: nothing received, 5: full */
#define UART_IBRD 0x24u
#define UART_FBRD 0x28u
#define UART_LCRH 0x2cu
#define UART_CTL  0x30u

/* SSI0, a PL022. */
#define SSI0     0x40008000u
#define SSI_CR0  0x00u
#define SSI_CR1  0x04u
#define SSI_DR   0x08u
#define SSI_SR   0x0cu /* 1: room, 2: received, 4: busy */
#define SSI_CPSR 0x10u

/* SysTick. */
#define SYST_CSR 0xe000e010u
#define SYST_RVR 0xe000e014u
#define SYST_CVR 0xe000e018u

#endif
