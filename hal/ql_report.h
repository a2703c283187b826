/* ql_report.h - lines of text on the serial port, between frames */
/* SPDX-License-Identifier: MIT */

/* For panics and faults. qlux-recv prints lines that begin with "qlux: ". A
 * failing serial port is ignored: there is nowhere else to report to. */

#ifndef QL_REPORT_H
#define QL_REPORT_H

#include "ql_hal.h"

/* Exit codes of an emulated board; a status s leaves with -s. */
#define QL_EXIT_PANIC 100
#define QL_EXIT_FAULT 101

/* Send a string. */
void ql_report_text(const char *text);

/* Send " 0x" and a number's eight hexadecimal digits. */
void ql_report_hex(uint32_t value);

/* Leave the emulator with this code, or stop for good. Each CPU's file under
 * cpu/ has one. */
#if defined(__GNUC__)
__attribute__((noreturn))
#endif
void ql_cpu_exit(int code);

#endif
