/* ql_cortexm.c - reset, vectors, faults and exit of any Cortex-M */
/* SPDX-License-Identifier: MIT */

#include "cpu/ql_cortexm.h"

#include "board.h"

/* From linker/sections.ld. */
extern uint32_t ql_ld_stack_bottom[];
extern uint32_t ql_ld_stack_top[];
extern uint32_t ql_ld_bss_begin[];
extern uint32_t ql_ld_bss_end[];

int main(void);
void ql_cpu_reset(void);
void ql_cpu_fault(void);
void ql_cpu_fault_report(const uint32_t *frame, uint32_t vector);

void ql_cpu_reset(void)
{
    /* linker/sections.ld asserts that there is no initialised data to copy */
    for (uint32_t *to = ql_ld_bss_begin; to < ql_ld_bss_end; to++) {
        *to = 0;
    }
    main();
    ql_cpu_exit(QL_EXIT_PANIC);
}

/* Every vector without a purpose ends here. The stack pointer may be what went
 * wrong, so the report begins with a fresh stack; frame is the old one. */
__attribute__((naked)) void ql_cpu_fault(void)
{
    __asm__ volatile("mov r0, sp\n\t"
                     "mrs r1, ipsr\n\t"
                     "ldr r2, =ql_ld_stack_top\n\t"
                     "mov sp, r2\n\t"
                     "bl ql_cpu_fault_report\n\t"
                     ".ltorg");
}

/* The CPU has stacked r0-r3, r12, lr, pc and psr at frame, unless there was no
 * stack left to put them on. */
__attribute__((used)) void ql_cpu_fault_report(
        const uint32_t *frame, uint32_t vector)
{
    ql_report_text("\nqlux: fault");
    ql_report_hex(vector);
    if (frame >= ql_ld_stack_bottom && frame + 8 <= ql_ld_stack_top) {
        ql_report_text(" at pc");
        ql_report_hex(frame[6]);
    } else {
        ql_report_text(" stack overflow, sp");
        ql_report_hex((uint32_t)(uintptr_t)frame);
    }
    ql_report_text("\n");
    ql_cpu_exit(QL_EXIT_FAULT);
}

/* For boards that do not use SysTick. */
__attribute__((weak, alias("ql_cpu_fault"))) void ql_cpu_systick(void);

/* The architecture's sixteen vectors. Interrupts of the chip are never enabled,
 * so their vectors are left out. */
typedef struct {
    uint32_t *stack_top;
    void (*handlers[15])(void);
} vectors_t;

__attribute__((section(".vectors"), used)) static const vectors_t vectors = {
        ql_ld_stack_top,
        {
                ql_cpu_reset, ql_cpu_fault, /* NMI */
                ql_cpu_fault,               /* HardFault */
                ql_cpu_fault,               /* MemManage */
                ql_cpu_fault,               /* BusFault */
                ql_cpu_fault,               /* UsageFault */
                ql_cpu_fault, ql_cpu_fault, /* reserved */
                ql_cpu_fault, ql_cpu_fault, /* reserved */
                ql_cpu_fault,               /* SVCall */
                ql_cpu_fault,               /* DebugMonitor */
                ql_cpu_fault,               /* reserved */
                ql_cpu_fault,               /* PendSV */
                ql_cpu_systick,             /* SysTick */
        },
};

#if QL_PORT_EMULATED
/* Semihosting SYS_EXIT_EXTENDED: reason ADP_Stopped_ApplicationExit, code. */
void ql_cpu_exit(int code)
{
    const uint32_t block[2] = {0x20026u, (uint32_t)code};
    register uint32_t r0 __asm__("r0") = 0x20u;
    register const uint32_t *r1 __asm__("r1") = block;

    for (;;) {
        __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    }
}
#else
/* A BKPT without a debugger would be a fault: sleep instead. */
void ql_cpu_exit(int code)
{
    (void)code;
    for (;;) {
        __asm__ volatile("cpsid i\n\twfi");
    }
}
#endif
