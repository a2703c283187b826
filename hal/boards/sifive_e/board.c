/* board.c - SiFive HiFive1 (FE310-G000): serial port, ticks */
/* SPDX-License-Identifier: MIT */

#include "board.h"

#include "cpu/ql_riscv.h"

/* Waits for a peripheral give up after this many polls, a second or more. */
#define POLLS_MAX 2000000ul

static bool wait_until(uint32_t address, uint32_t mask, uint32_t wanted)
{
    for (uint32_t i = 0; i < POLLS_MAX; i++) {
        if ((QL_REG(address) & mask) == wanted) {
            return true;
        }
    }
    return false;
}

ql_status_t ql_hal_init(void)
{
    /* The crystal: the ring oscillator is too far off for a serial port. */
    QL_REG(PRCI_HFXOSCCFG) = 1u << 30;
    if (!wait_until(PRCI_HFXOSCCFG, 1u << 31, 1u << 31)) {
        return QL_ERR_SERIAL;
    }
    QL_REG(PRCI_PLLCFG) = 1u << 18 | 1u << 17 | 1u << 16;

    QL_REG(GPIO_IOF_SEL) &= ~PINS_UART0;
    QL_REG(GPIO_IOF_EN) |= PINS_UART0;
    QL_REG(UART0_DIV) = (QL_PORT_CPU_HZ + QL_PORT_BAUD / 2) / QL_PORT_BAUD - 1;
    QL_REG(UART0_TXCTRL) = 1;
    QL_REG(UART0_RXCTRL) = 1;
    return QL_OK;
}

ql_status_t ql_hal_serial_write(const uint8_t *bytes, uint16_t size)
{
    for (uint16_t i = 0; i < size; i++) {
        if (!wait_until(UART0_TXDATA, 1u << 31, 0)) {
            return QL_ERR_SERIAL;
        }
        QL_REG(UART0_TXDATA) = bytes[i];
    }
    return QL_OK;
}

uint32_t ql_hal_ticks(void)
{
    return (uint32_t)(ql_cpu_cycles() >> QL_PORT_TICK_SHIFT);
}

/* Ctrl-C on the serial port. */
bool ql_hal_stop_requested(void)
{
    bool stop = false;
    uint32_t received = QL_REG(UART0_RXDATA);

    for (; (received & 1u << 31) == 0; received = QL_REG(UART0_RXDATA)) {
        stop = (received & 0xffu) == 3 || stop;
    }
    return stop;
}
