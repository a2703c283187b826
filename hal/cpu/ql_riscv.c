/* ql_riscv.c - reset, traps, exit and cycles of a 32-bit RISC-V */
/* SPDX-License-Identifier: MIT */

#include "cpu/ql_riscv.h"

#include "board.h"

/* From linker/sections.ld. */
extern uint32_t ql_ld_stack_bottom[];
extern uint32_t ql_ld_data_begin[];
extern uint32_t ql_ld_data_end[];
extern const uint32_t ql_ld_data_load[];
extern uint32_t ql_ld_bss_begin[];
extern uint32_t ql_ld_bss_end[];

int main(void);
void ql_cpu_entry(void);
void ql_cpu_trap(void);
void ql_cpu_start(void);
void ql_cpu_trap_report(
        uint32_t cause, uint32_t pc, uint32_t address, const uint32_t *sp);

/* The assembler knows CSR instructions only when told; the compiler's own
 * -march stays without, because that selects the right libgcc. */
#define WITH_CSR(code)                                                         \
    ".option push\n\t.option arch,+zicsr\n\t" code "\n\t.option pop\n\t"

/* The first instruction of the flash. */
__attribute__((naked, used, section(".vectors"))) void ql_cpu_entry(void)
{
    __asm__ volatile(WITH_CSR("la t0, ql_cpu_trap\n\t"
                              "csrw mtvec, t0") "la sp, ql_ld_stack_top\n\t"
                                                "j ql_cpu_start");
}

__attribute__((used)) void ql_cpu_start(void)
{
    const uint32_t *from = ql_ld_data_load;

    for (uint32_t *to = ql_ld_data_begin; to < ql_ld_data_end; to++) {
        *to = *from++;
    }
    for (uint32_t *to = ql_ld_bss_begin; to < ql_ld_bss_end; to++) {
        *to = 0;
    }
    main();
    ql_cpu_exit(QL_EXIT_PANIC);
}

/* Interrupts stay off, so every trap is a fault. The stack pointer may be what
 * went wrong: report with a fresh one. */
__attribute__((naked, used, aligned(4))) void ql_cpu_trap(void)
{
    __asm__ volatile(WITH_CSR("csrr a0, mcause\n\t"
                              "csrr a1, mepc\n\t"
                              "csrr a2, mtval") "mv a3, sp\n\t"
                                                "la sp, ql_ld_stack_top\n\t"
                                                "j ql_cpu_trap_report");
}

__attribute__((used)) void ql_cpu_trap_report(
        uint32_t cause, uint32_t pc, uint32_t address, const uint32_t *sp)
{
    ql_report_text("\nqlux: fault");
    ql_report_hex(cause);
    ql_report_text(" at pc");
    ql_report_hex(pc);
    ql_report_text(", address");
    ql_report_hex(address);
    ql_report_text(sp < ql_ld_stack_bottom ? ", stack overflow\n" : "\n");
    ql_cpu_exit(QL_EXIT_FAULT);
}

/* The high word may change between two reads. */
uint64_t ql_cpu_cycles(void)
{
    uint32_t high, low, again;

    do {
        __asm__ volatile(WITH_CSR("csrr %0, mcycleh\n\t"
                                  "csrr %1, mcycle\n\t"
                                  "csrr %2, mcycleh")
                         : "=&r"(high), "=&r"(low), "=&r"(again));
    } while (high != again);
    return (uint64_t)high << 32 | low;
}

#if QL_PORT_EMULATED
/* Semihosting SYS_EXIT_EXTENDED: reason ADP_Stopped_ApplicationExit, code. The
 * three instructions are recognised together: uncompressed, within one page. */
QL_NOINLINE void ql_cpu_exit(int code)
{
    const uint32_t block[2] = {0x20026u, (uint32_t)code};
    register uint32_t a0 __asm__("a0") = 0x20u;
    register const uint32_t *a1 __asm__("a1") = block;

    for (;;) {
        __asm__ volatile(".option push\n\t"
                         ".option norvc\n\t"
                         ".balign 16\n\t"
                         "slli x0, x0, 0x1f\n\t"
                         "ebreak\n\t"
                         "srai x0, x0, 7\n\t"
                         ".option pop"
                         : "+r"(a0)
                         : "r"(a1)
                         : "memory");
    }
}
#else
/* An EBREAK without a debugger would be a trap: sleep instead. */
void ql_cpu_exit(int code)
{
    (void)code;
    for (;;) {
        __asm__ volatile("wfi");
    }
}
#endif
