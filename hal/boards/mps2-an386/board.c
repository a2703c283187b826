/* board.c - Arm MPS2 with AN386: serial port, ticks */
/* SPDX-License-Identifier: MIT */

#include "board.h"

#include "cpu/ql_cortexm.h"

/* A wait for the serial port gives up after this many polls, a second. */
#define POLLS_MAX 4000000ul

ql_status_t ql_hal_init(void)
{
    QL_REG(TIMER0_RELOAD) = 0xffffffffu;
    QL_REG(TIMER0_VALUE) = 0xffffffffu;
    QL_REG(TIMER0_CTRL) = 1;
    QL_REG(UART0_BAUDDIV) = (QL_PORT_CPU_HZ + QL_PORT_BAUD / 2) / QL_PORT_BAUD;
    QL_REG(UART0_CTRL) = 3;
    return QL_OK;
}

static bool wait_for_room(void)
{
    for (uint32_t i = 0; i < POLLS_MAX; i++) {
        if ((QL_REG(UART0_STATE) & 1u) == 0) {
            return true;
        }
    }
    return false;
}

ql_status_t ql_hal_serial_write(const uint8_t *bytes, uint16_t size)
{
    for (uint16_t i = 0; i < size; i++) {
        if (!wait_for_room()) {
            return QL_ERR_SERIAL;
        }
        QL_REG(UART0_DATA) = bytes[i];
    }
    /* Handed over means sent: the program may be about to end. */
    return wait_for_room() ? QL_OK : QL_ERR_SERIAL;
}

uint32_t ql_hal_ticks(void)
{
    return ~QL_REG(TIMER0_VALUE);
}

/* Ctrl-C on the serial port. */
bool ql_hal_stop_requested(void)
{
    bool stop = false;

    while ((QL_REG(UART0_STATE) & 2u) != 0) {
        stop = (QL_REG(UART0_DATA) & 0xffu) == 3 || stop;
    }
    return stop;
}
