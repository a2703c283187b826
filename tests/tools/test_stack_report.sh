#!/bin/sh
# test_stack_report.sh - the stack bound is right, or refused with a reason
# SPDX-License-Identifier: MIT

if [ "${1-}" = --help ]; then
    echo 'usage: tests/tools/test_stack_report.sh'
    echo 'Example: tests/tools/test_stack_report.sh'
    exit 0
fi

dir=$(mktemp -d) || exit 3
trap 'rm -rf "$dir"' EXIT
suite=tools/test_stack_report
. tests/support/claims.sh
cross=arm-none-eabi

# report: the bound of the program on stdin, which starts at ql_cpu_reset().
report() {
    cat >"$dir/x.c"
    $cross-gcc -mcpu=cortex-m0 -O1 -ffreestanding -fcallgraph-info=su \
        -fno-optimize-sibling-calls -fno-inline -c "$dir/x.c" -o "$dir/x.o" &&
        $cross-gcc -mcpu=cortex-m0 -nostdlib -Wl,-e,ql_cpu_reset "$dir/x.o" \
            -lgcc -o "$dir/x.elf" &&
        tools/dev/stack_report.sh "$dir/x.elf" $cross-objdump "$dir/x.ci" \
            >"$dir/out" 2>"$dir/err"
}

# check CLAIM STATUS: what the report printed is shown if it does not hold.
check() {
    say "$1" "$2"
    [ "$2" -eq 0 ] || cat "$dir/out" "$dir/err" >&2
}

# 8 + 64 bytes of locals beside registers; the deeper of two branches counts.
report <<'E2'
volatile int n;
void leaf(void) { n++; }
void deep(void) { volatile char a[64]; a[n] = 0; leaf(); }
void ql_cpu_reset(void) { leaf(); deep(); }
E2
check deeper_branch_is_the_bound "$?"
[ "$(cat "$dir/out")" -ge 72 ] && [ "$(cat "$dir/out")" -le 96 ]
check bound_is_the_sum_of_frames $?

# The library's 64-bit division pushes registers and calls further.
report <<'E2'
volatile unsigned long long n;
void ql_cpu_reset(void) { n /= 7 + n; }
E2
check library_is_read_from_the_disassembly "$?"
[ "$(cat "$dir/out")" -ge 40 ] && [ "$(cat "$dir/out")" -le 160 ]
check library_counts $?

report <<'E2'
int f(int n) { return n ? f(n - 1) + n : 0; }
int g(int n) { return n ? f(n) : 1; }
void ql_cpu_reset(void) { volatile int n = 3; n = g(n); }
E2
[ $? -eq 2 ] && grep -q 'recursion through f' "$dir/err"
check recursion_is_refused $?

report <<'E2'
void (*volatile f)(void);
void ql_cpu_reset(void) { f(); }
E2
[ $? -eq 2 ] && grep -q 'a call through a pointer in ql_cpu_reset' "$dir/err"
check call_through_a_pointer_is_refused $?

report <<'E2'
volatile int n;
void f(int size) { volatile char a[size]; a[n] = 1; }
void ql_cpu_reset(void) { f(n); }
E2
[ $? -eq 2 ] && grep -q 'the stack frame of f has no bound' "$dir/err"
check frame_without_a_bound_is_refused $?

exit $((failures > 0))
