#!/bin/sh
# stack_report.sh - worst-case stack of a firmware, from gcc's call graphs
# SPDX-License-Identifier: MIT

usage() {
    cat <<'END'
usage: tools/dev/stack_report.sh [--path] ELF OBJDUMP FILE.ci...
Print the most bytes of stack that the firmware can use; with --path also the
chain of calls that needs them: bytes from there on, the function's own, name.
The .ci files are those of -fcallgraph-info=su; functions without one, which
are the compiler's own library, are read from the disassembly. Recursion, a
call through a pointer, a stack frame without a bound and a function nothing is
known of are errors.

Example: tools/dev/stack_report.sh --path x.elf arm-none-eabi-objdump x.ci
END
}

path=0
case ${1-} in
--help) usage; exit 0 ;;
--path) path=1; shift ;;
esac
if [ $# -lt 3 ]; then
    usage >&2
    exit 1
fi
elf=$1
objdump=$2
shift 2
for file in "$elf" "$@"; do
    if [ ! -r "$file" ]; then
        echo "stack_report.sh: cannot read $file" >&2
        exit 3
    fi
done

{
    cat "$@"
    echo DISASSEMBLY
    "$objdump" -t -d --no-show-raw-insn "$elf"
} | awk -v path="$path" '
function fail(text) {
    if (!failed) {
        print "stack_report.sh: " text > "/dev/stderr"
    }
    failed = 1
    exit 2
}
# The n-th quoted string of a line. Link-time optimisation makes every function
# one of its own file, by a name that is unique: that of the disassembly.
function quoted(n,    part) {
    split($0, part, "\"")
    sub(/^[^"]*\.ltrans[0-9]+\.o:/, "", part[2 * n])
    return part[2 * n]
}
# Bytes that a call of name needs. deepest[name] is where its callees need most.
function depth(name, caller,    i, n, target, most, bytes) {
    # The disassembly has one name for functions that have several.
    if (!(name in frame) && name in address) {
        name = name_at[address[name]]
    }
    if (name in need) {
        return need[name]
    }
    if (name in active) {
        fail("recursion through " name)
    }
    if (name == "__indirect_call") {
        fail("a call through a pointer in " caller)
    }
    if (!(name in frame)) {
        fail("nothing is known of " name ", called by " caller)
    }
    if (name in unbounded) {
        fail("the stack frame of " name " has no bound")
    }
    active[name] = 1
    n = split(calls[name], target, " ")
    for (i = 1; i <= n; i++) {
        bytes = depth(target[i], name)
        if (bytes > most) {
            most = bytes
            deepest[name] = target[i]
        }
    }
    delete active[name]
    return need[name] = most + frame[name]
}
/^DISASSEMBLY$/ { disassembly = 1 }
# node: { title: "name" label: "name\nfile:line\n24 bytes (static)" }
!disassembly && /^node:/ && / bytes \(/ {
    name = quoted(1)
    bytes = quoted(2)
    sub(/.*\\n/, "", bytes)
    if (bytes !~ /static|bounded/) {
        unbounded[name] = 1
    }
    frame[name] = bytes + 0
    compiled[name] = 1
}
# edge: { sourcename: "name" targetname: "name" ... }
!disassembly && /^edge:/ && !((quoted(1), quoted(2)) in edge) {
    edge[quoted(1), quoted(2)] = 1
    calls[quoted(1)] = calls[quoted(1)] " " quoted(2)
}
!disassembly { next }
# 00005334 g     F .text  00000000 .hidden __aeabi_uidiv
/^[0-9a-f]+ .* F \.text/ {
    address[$NF] = $1
    next
}
# 00005334 <__udivsi3>:
/^[0-9a-f]+ <.*>:$/ {
    at = $2
    gsub(/[<>:]/, "", at)
    name_at[$1] = at
    library = !(at in compiled)
    frame[at] += 0
    next
}
!library { next }
# push {r4, r5, lr}: one register more than there are commas.
$2 ~ /^(push|stmdb)/ {
    if (/-.*}/) {
        fail("a range of registers in " at)
    }
    frame[at] += 4 * gsub(/,/, ",") + 4
}
$2 == "sub" && $3 == "sp," {
    sub(/.*#/, "")
    frame[at] += $1
}
$2 == "addi" && /sp,sp,-/ {
    sub(/.*sp,sp,-/, "")
    frame[at] += $1
}
# A jump to another function counts as a call: a tail call needs less.
$2 ~ /^(b|j)/ && /<[^+>]*>$/ {
    callee = $NF
    gsub(/[<>]/, "", callee)
    if (callee != at) {
        calls[at] = calls[at] " " callee
    }
}
$2 == "blx" && $3 ~ /^r/ { calls[at] = calls[at] " __indirect_call" }
$2 == "jalr" { calls[at] = calls[at] " __indirect_call" }
END {
    if (failed) {
        exit 2
    }
    start = "ql_cpu_reset" in frame ? "ql_cpu_reset" : "ql_cpu_start"
    total = depth(start, "the hardware")
    if (path) {
        for (name = start; name != ""; name = deepest[name]) {
            printf "%6d %6d  %s\n", need[name], frame[name], name
        }
    }
    # SysTick may come on top: the CPU stacks 8 words, and one to align.
    if ("ql_cpu_systick" in compiled) {
        exception = 36 + depth("ql_cpu_systick", "the hardware")
        if (path) {
            printf "%6d %6d  SysTick exception\n", exception, exception
        }
    }
    print total + exception
}'
