/* board.c - BBC micro:bit (nRF51822): serial port, ticks */
/* SPDX-License-Identifier: MIT */

#include "board.h"

#include "cpu/ql_cortexm.h"

/* Waits for a peripheral give up after this many polls, a second or more. */
#define POLLS_MAX 4000000ul

static bool wait_for_event(uint32_t event)
{
    for (uint32_t i = 0; i < POLLS_MAX; i++) {
        if (QL_REG(event) != 0) {
            return true;
        }
    }
    return false;
}

ql_status_t ql_hal_init(void)
{
    /* The crystal: the RC oscillator is too far off for a serial port. */
    QL_REG(CLOCK_HFCLKSTART) = 1;
    if (!wait_for_event(CLOCK_HFCLKSTARTED)) {
        return QL_ERR_SERIAL;
    }

    QL_REG(TIMER0_BITMODE) = 3;
    QL_REG(TIMER0_PRESCALER) = 0;
    QL_REG(TIMER0_START) = 1;

    /* A transmit pin idles high. */
    QL_REG(GPIO_OUTSET) = 1u << PIN_TX;
    QL_REG(GPIO_DIRSET) = 1u << PIN_TX;
    QL_REG(UART_PSELTXD) = PIN_TX;
    QL_REG(UART_PSELRXD) = PIN_RX;
    QL_REG(UART_BAUDRATE) = UART_BAUD_115200;
    QL_REG(UART_ENABLE) = 4;
    QL_REG(UART_STARTTX) = 1;
    QL_REG(UART_STARTRX) = 1;
    return QL_OK;
}

ql_status_t ql_hal_serial_write(const uint8_t *bytes, uint16_t size)
{
    for (uint16_t i = 0; i < size; i++) {
        QL_REG(UART_TXDRDY) = 0;
        QL_REG(UART_TXD) = bytes[i];
        if (!wait_for_event(UART_TXDRDY)) {
            return QL_ERR_SERIAL;
        }
    }
    return QL_OK;
}

uint32_t ql_hal_ticks(void)
{
    QL_REG(TIMER0_CAPTURE0) = 1;
    return QL_REG(TIMER0_CC0);
}

/* Ctrl-C on the serial port. */
bool ql_hal_stop_requested(void)
{
    bool stop = false;

    while (QL_REG(UART_RXDRDY) != 0) {
        QL_REG(UART_RXDRDY) = 0;
        stop = (QL_REG(UART_RXD) & 0xffu) == 3 || stop;
    }
    return stop;
}
