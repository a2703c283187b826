/* board.c - a board that does nothing: every function a port must have */
/* SPDX-License-Identifier: MIT */

#include "board.h"

#include "ql_report.h"

ql_status_t ql_hal_init(void)
{
    /* Clocks, pins, serial port, counter, panel. */
    return QL_OK;
}

ql_status_t ql_hal_serial_write(const uint8_t *bytes, uint16_t size)
{
    (void)bytes;
    (void)size;
    return QL_OK;
}

uint32_t ql_hal_ticks(void)
{
    return 0;
}

bool ql_hal_stop_requested(void)
{
    return false;
}

/* A Cortex-M or RISC-V board has this from cpu/ql_cortexm.c or cpu/ql_riscv.c,
 * with reset, vectors and fault reports. */
void ql_cpu_exit(int code)
{
    (void)code;
    for (;;) {
    }
}
