/* ql_report.c - panic and exit as most boards want them: on the serial port */
/* SPDX-License-Identifier: MIT */

#include "ql_report.h"

static void send(const uint8_t *byte)
{
    if (ql_hal_serial_write(byte, 1) != QL_OK) {
        return; /* nowhere else to report to */
    }
}

void ql_report_text(const char *text)
{
    for (; *text != '\0'; text++) {
        send((const uint8_t *)text);
    }
}

void ql_report_hex(uint32_t value)
{
    ql_report_text(" 0x");
    for (unsigned i = 0; i < 8; i++, value <<= 4) {
        const uint8_t digit = (uint8_t)(value >> 28); /* < 16 */
        const uint8_t text = (uint8_t)(digit + (digit < 10 ? '0' : 'a' - 10));

        send(&text);
    }
}

void ql_hal_panic(uint16_t code, uint16_t line)
{
    ql_report_text("\nqlux: panic");
    ql_report_hex(code);
    ql_report_hex(line);
    ql_report_text("\n");
    ql_cpu_exit(QL_EXIT_PANIC);
}

void ql_hal_exit(ql_status_t status)
{
    ql_cpu_exit(-(int)status);
}

#if QL_CFG_ASSERT
void ql_assert_fail(const char *file, int line, const char *claim)
{
    ql_report_text("\nqlux: ");
    ql_report_text(file);
    ql_report_text(": ");
    ql_report_text(claim);
    ql_hal_panic(1, (uint16_t)line);
}
#endif
