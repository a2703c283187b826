#!/bin/sh
# size_report.sh - code, constants and RAM of a firmware by module, from its map
# SPDX-License-Identifier: MIT

usage() {
    cat <<'END'
usage: tools/size_report.sh [--files] MAP OBJECT-DIR
Print a row for each folder of sources, with --files for each source (and
"scene" for the blob, "libgcc" for the compiler's own functions): bytes of code,
constants, and RAM. Not of a build with link-time optimisation, which mixes them.

Example: tools/size_report.sh build/microbit/cornell.map build/microbit/cornell
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
if [ ! -r "$1" ]; then
    echo "size_report.sh: cannot read $1" >&2
    exit 3
fi

awk -v dir="$2/" -v files="$files" '
function number(hex,    i, n) {
    n = 0
    for (i = 3; i <= length(hex); i++) {
        n = 16 * n + index("0123456789abcdef", substr(hex, i, 1)) - 1
    }
    return n
}
# " .text.name  0xaddress 0xsize object", or the name on a line of its own.
/^Linker script and memory map/ { map = 1 }
!map { next }
/^ \.[a-z]/ && NF == 1 { section = $1; next }
/^ \.[a-z]/ && NF >= 4 { section = $1; size = $3; object = $4 }
/^ +0x[0-9a-f]+ +0x[0-9a-f]+ [^ ]+\.[oa]/ { size = $2; object = $3 }
object == "" { next }
{
    kind = section ~ /^\.(text|vectors)/ ? "code" : \
        section ~ /^\.s?rodata/ ? "const" : \
        section ~ /^\.s?(data|bss)/ ? "ram" : ""
    module = object
    if (index(module, dir) == 1) {
        module = substr(module, length(dir) + 1)
        sub(files ? "[.]o$" : "/[^/]*$", "", module)
    } else {
        module = "libgcc"
    }
    if (object ~ /ql_blob_data/) {
        module = "scene"
    }
    if (kind != "" && number(size) > 0) {
        bytes[module, kind] += number(size)
        bytes["TOTAL", kind] += number(size)
        modules[module] = 1
    }
    object = ""
}
function row(module) {
    return sprintf("%-28s %8d %8d %8d", module, bytes[module, "code"],
        bytes[module, "const"], bytes[module, "ram"])
}
END {
    printf "%-28s %8s %8s %8s\n", "module", "code", "const", "ram"
    for (module in modules) {
        print row(module) | "sort"
    }
    close("sort")
    print row("TOTAL")
}' "$1"
