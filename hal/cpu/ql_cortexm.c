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
void ql_cpu_fault_report(const uint32_t *frame, uint32_t vector, uint32_t pc);

/* Below the stack there is no memory, but not every bus says so: QEMU's boards
 * take a write there, and with the next ones what lies further down. So the
 * memory protection unit guards it; a chip that was made without one ignores
 * this. */
#if defined(__ARM_ARCH_7M__) || defined(__ARM_ARCH_7EM__)
#define MPU_CTRL        0xe000ed94u
#define MPU_RBAR        0xe000ed9cu
#define MPU_RASR        0xe000eda0u
#define MPU_REGION_0    (1u << 4) /* with its address */
#define MPU_NO_ACCESS   (0u << 24)
#define MPU_BYTES(log2) (((log2)-1) << 1 | 1u)
#define MPU_GUARD_LOG2  20u
#define MPU_ON          5u /* all other memory is as without it */

static void guard_stack(void)
{
    const uint32_t bottom = (uint32_t)(uintptr_t)ql_ld_stack_bottom;

    QL_REG(MPU_RBAR) = (bottom - (1u << MPU_GUARD_LOG2)) | MPU_REGION_0;
    QL_REG(MPU_RASR) = MPU_NO_ACCESS | MPU_BYTES(MPU_GUARD_LOG2);
    QL_REG(MPU_CTRL) = MPU_ON;
}
#else
static void guard_stack(void)
{
}
#endif

void ql_cpu_reset(void)
{
    guard_stack();
    /* linker/sections.ld asserts that there is no initialised data to copy */
    for (uint32_t *to = ql_ld_bss_begin; to < ql_ld_bss_end; to++) {
        *to = 0;
    }
    main();
    ql_cpu_exit(QL_EXIT_PANIC);
}

/* No address of an instruction. */
#define NO_PC 1

/* Every vector without a purpose ends here. The CPU has stacked r0-r3, r12, lr,
 * pc and psr, unless there was no stack left to put them on. The stack pointer
 * may be what went wrong, so the report begins with a fresh stack, which may
 * overwrite them: the pc is read before. */
__attribute__((naked)) void ql_cpu_fault(void)
{
    __asm__ volatile("mov r0, sp\n\t"
                     "mrs r1, ipsr\n\t"
                     "movs r2, #1\n\t" /* NO_PC */
                     "ldr r3, =ql_ld_stack_bottom\n\t"
                     "cmp r0, r3\n\t"
                     "ldr r3, =ql_ld_stack_top\n\t"
                     "blo 1f\n\t"
                     "cmp r0, r3\n\t"
                     "bhs 1f\n\t"
                     "ldr r2, [r0, #24]\n"
                     "1:\tmov sp, r3\n\t"
                     "bl ql_cpu_fault_report\n\t"
                     ".ltorg");
}

__attribute__((used)) void ql_cpu_fault_report(
        const uint32_t *frame, uint32_t vector, uint32_t pc)
{
    ql_report_text("\nqlux: fault");
    ql_report_hex(vector);
    if (pc != NO_PC) {
        ql_report_text(" at pc");
        ql_report_hex(pc);
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
