/* ql_riscv.h - what RISC-V boards share: registers by address, mcycle */
/* SPDX-License-Identifier: MIT */

#ifndef QL_RISCV_H
#define QL_RISCV_H

#include "ql_report.h"

/* A 32-bit device register. */
#define QL_REG(address) (*(volatile uint32_t *)(uintptr_t)(address))

/* The 64 bits of mcycle. */
uint64_t ql_cpu_cycles(void);

#endif
