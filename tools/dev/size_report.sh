#!/bin/sh
# size_report.sh - flash of a firmware by module, from its debug information
# SPDX-License-Identifier: MIT

usage() {
    cat <<'END'
usage: tools/dev/size_report.sh [--files] ELF PREFIX
Print a row "NAME: BYTES" for each folder of sources, "libgcc" for the
compiler's own functions, "data" for the scene's blob, and "rest": strings,
tables the compiler made, alignment. With --files a row for each source instead
of each folder. Together they are the flash of ELF.

Each instruction counts for the line it was compiled from, wherever inlining and
link-time optimisation put it; a constant that code loads from beside it for the
first instruction that does, and a variable for the file that defines it. PREFIX
is that of the binutils. Run it where the sources are.

Example: tools/dev/size_report.sh build/microbit/cornell.elf arm-none-eabi-
END
}

files=0
case ${1-} in
--help) usage; exit 0 ;;
--files) files=1; shift ;;
esac
if [ $# -ne 2 ]; then
    usage >&2
    exit 1
fi
elf=$1
prefix=$2
if [ ! -r "$elf" ]; then
    echo "size_report.sh: cannot read $elf" >&2
    exit 3
fi

sections=$("${prefix}size" -A "$elf") || exit 3
# Bytes that the linker left free behind the vectors (hal/boards.mk).
gap=$("${prefix}nm" "$elf" | sed -n 's/ A ql_ld_gap_bytes$//p')
gap=$((0x${gap:-0}))
{
    echo "$sections"
    echo "$sections" | awk -v gap="$gap" '
        $1 == ".text" { for (i = gap; i < $2; i += 2) printf "%x\n", $3 + i }' |
        "${prefix}addr2line" -a -e "$elf"
    "${prefix}nm" -S "$elf"
    "${prefix}objdump" -d --no-show-raw-insn "$elf"
    "${prefix}objdump" --dwarf=rawline "$elf"
    "${prefix}objdump" --dwarf=info "$elf"
} | awk -v root="$PWD/" -v files="$files" -v gap="$gap" '
function number(hex,    i, n) {
    n = 0
    sub(/^0x/, "", hex)
    for (i = 1; i <= length(hex); i++) {
        n = 16 * n + index("0123456789abcdef", substr(hex, i, 1)) - 1
    }
    return n
}
# Bytes of a source, or of the blob, or of the rest.
function count(source, n) {
    if (index(source, root) == 1) {
        source = substr(source, length(root) + 1)
    }
    if (source ~ /^(firmware|hal)\//) {
        if (!files) {
            sub(/^hal\/.*/, "hal", source)
            sub(/^firmware\//, "", source)
            sub(/\/.*/, "", source)
        }
    } else if (source != "data" && source != "rest") {
        source = "libgcc"
    }
    bytes[source] += n
    left -= n
}

# .text  7176  0
$1 ~ /^\.(text|rodata|data)$/ && NF == 3 {
    left += $2
    if ($1 == ".text") {
        left -= gap
        text = $3
        text_end = $3 + $2
    }
    next
}
# 0x00000054, then PATH:LINE
/^0x[0-9a-f]+$/ {
    half = number($1)
    getline
    line[half] = sub(/:[0-9]+( .*)?$/, "") ? $0 : "?"
    next
}
# 00001c38 00000018 r basic
$2 ~ /^[0-9a-f]+$/ && length($2) >= 8 && NF == 4 && $3 ~ /^[rRtTwW]$/ {
    size[number($1)] = number($2)
}
$3 == "ql_blob_begin" { blob = number($1) }
$3 == "ql_blob_end" { blob = number($1) - blob }
# 5cc:  ldr  r3, [pc, #28]  @ (5e8 <name+0x1c>)
$1 ~ /^[0-9a-f]+:$/ && $2 ~ /^ldr/ && /\[pc/ {
    sub(":", "", $1)
    target = $0
    sub(/.*\(/, "", target)
    sub(/ .*/, "", target)
    target = number(target)
    if (!(target in loader)) {
        loader[target] = number($1)
    }
}
# Of each table of lines its folders, and its files as "3 1 0 0 ql_fx.c"
$1 == "Offset:" { table = number($2) }
/^ The (Directory|File Name) Table/ { entries = $2 }
/^ (Line Number Statements|No Line)/ { entries = "" }
entries == "Directory" && $1 ~ /^[0-9]+$/ { folder[table, $1] = $NF }
entries == "File" && $1 ~ /^[0-9]+$/ {
    named[table, $1] = ((table, $2) in folder ? folder[table, $2] "/" : "") $NF
}
# <2d><1f>: Abbrev Number: 4 (DW_TAG_variable)
/^ *<[0-9a-f]+><[0-9a-f]+>: Abbrev/ {
    split($1, part, /[<>]+/)
    die = part[3]
}
/DW_AT_stmt_list/ { table = number($NF) }
/DW_AT_decl_file/ { file[die] = named[table, $NF] }
/DW_AT_(abstract_origin|specification)/ {
    gsub(/[<>]|0x/, "", $NF)
    origin[die] = $NF
}
# Of a variable that lies in memory; what tells its file may be another.
/DW_AT_location.*\(DW_OP_addr: [0-9a-f]+\)$/ {
    sub(/\)$/, "", $NF)
    variable[number($NF)] = die
}

END {
    for (at in variable) {
        die = variable[at]
        object[at] = file[die in origin ? origin[die] : die]
    }
    for (at in size) {
        at += 0
        if (at >= text && at < text_end) {
            for (half = at; half < at + size[at]; half += 2) {
                inside[half] = 1
                if (at in object) {
                    line[half] = object[at]
                } else if (line[half] == "?") {
                    line[half] = line[at]
                }
            }
        } else if (at in object) {
            count(object[at], size[at])
        }
    }
    for (half in line) {
        first = half - half % 4
        from = first in loader ? loader[first] : half
        count(line[from] == "?" && !(half in inside) ? "rest" : line[from], 2)
    }
    count("data", blob)
    bytes["rest"] += left
    if (files) {
        for (name in bytes) {
            print name ": " bytes[name] | "sort"
        }
        exit
    }
    n = split("base math sample warp scene blob trace material light film" \
        " render app hal libgcc data rest", module, " ")
    for (i = 1; i <= n; i++) {
        print module[i] ": " bytes[module[i]] + 0
    }
}'
