/* ql_cortexm.h - what Cortex-M boards share: registers by address, SysTick */
/* SPDX-License-Identifier: MIT */

#ifndef QL_CORTEXM_H
#define QL_CORTEXM_H

#include "ql_report.h"

/* A 32-bit device register. */
#define QL_REG(address) (*(volatile uint32_t *)(uintptr_t)(address))

/* Called by the SysTick exception; a board without one need not define it. */
void ql_cpu_systick(void);

#endif
