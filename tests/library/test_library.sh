#!/bin/sh
# test_library.sh - the core in someone else's program: C, C++, other gates
# SPDX-License-Identifier: MIT
#
# usage: tests/library/test_library.sh [BUILD]
#
# Builds the program of firmware/README.md by the commands there, then others.
# Environment: CC (cc).
#
# Example: tests/library/test_library.sh build

suite=library
. tests/support/workspace.sh
CC=${CC:-cc}
strict='-pedantic -Wall -Wextra -Wundef -Werror'
PATH=$build:$PATH

# ---- the page, word for word

# block NAME: what stands in the block of code below <!-- NAME -->
block() {
    awk -v mark="<!-- $1 -->" '
        $0 == mark { found = 1 }
        inside && /^```$/ { exit }
        inside
        found && /^```/ { inside = 1 }' "$root/firmware/README.md"
}

ln -s "$root/firmware" "$root/hal" .
cp "$root"/tests/scenes/cornell.* .
mv cornell.scene room.scene
block main.c >main.c
block build.sh >build.sh
cp main.c main.cpp
cat >show.c <<'END'
#include <stdint.h>
#include <stdio.h>

void show(uint16_t y, const uint8_t *pixels);

void show(uint16_t y, const uint8_t *pixels)
{
    if (y == 0) {
        printf("P6\n64 48\n255\n");
    }
    fwrite(pixels, 1, 3 * 64, stdout);
}
END
cp show.c show.cpp
export CC
CFLAGS="-O0 $strict" sh -e build.sh >said.txt 2>&1
say the_commands_of_the_page_build_its_program $? "$(tail -n 1 said.txt)"
mkdir core && mv ./*.o core && mv core/main.o .
qlux-sim-draft room.qlb -o wanted.ppm --size 64x48 --spp 16 --quiet

# draws COMPILER ARGUMENT...: so linked, the program draws what the board would
draws() {
    rm -f picture picture.ppm
    "$@" core/*.o -o picture 2>said.txt && ./picture >picture.ppm &&
        cmp -s picture.ppm wanted.ppm
}

draws "$CC" main.o show.c
say it_draws_the_simulators_bits $? "$(tail -n 1 said.txt)"

# The gates of the page are words for the shell.
eval "$(grep '^gates=' build.sh)"

# ---- C++

for compiler in g++ clang++; do
    # shellcheck disable=SC2086
    draws $compiler -std=c++11 $strict $gates -I. -Ifirmware main.cpp show.cpp
    say "the_same_text_as_c++11_draws_them_by_$compiler" $? \
        "$(tail -n 1 said.txt)"
done

# What a program may include: the API, the application and the HAL, and all that
# these include.
headers=$($CC -MM -Ifirmware -Ihal -x c firmware/qlux.h firmware/app/*.h \
    hal/ql_hal.h | tr ' \\' '\n\n' | grep '\.h$' | sort -u)
short='-DQL_CFG_SMALL=1 -DQL_CFG_ASSERT=1 -DQL_CFG_ADAPTIVE=0 -DQL_CFG_LENS=0
    -DQL_CFG_PANEL=0 -DQL_PORT_WIDE_MUL=0'
mkdir each
for header in $headers; do
    echo "#include \"$header\"" >"each/$(basename "$header").cpp"
done

# compiles CLAIM COMPILER FLAG...: each header by itself, without a warning
compiles() {
    claim=$1
    shift
    # shellcheck disable=SC2086 # several words
    "$@" -std=c++11 $strict -I. -Ifirmware -Ihal -fsyntax-only each/*.cpp \
        >said.txt 2>&1
    say "$claim" $? "$(ls each | wc -l) headers $(head -n 1 said.txt)"
}

compiles each_public_header_is_c++11_by_g++ g++
compiles each_public_header_is_c++11_by_clang++ clang++
# shellcheck disable=SC2086
compiles so_it_is_with_the_gates_of_short_code g++ $short

# Each function that they declare has in C++ the name that C gives it.
echo "$headers" | sed 's/.*/#include "&"/' >all.c
gcc -Ifirmware -Ihal -I. -fsyntax-only -aux-info declared.txt all.c
grep -v '\*/ static' declared.txt | grep -o 'ql_[a-z0-9_]* (' |
    sed 's/ (//' | sort -u >functions.txt
cp all.c all.cpp
{
    echo 'typedef void (*function_t)(void);'
    echo 'extern const function_t all[] = {'
    sed 's/.*/(function_t)&,/' functions.txt
    echo '};'
} >>all.cpp
g++ -std=c++11 -w -Ifirmware -Ihal -I. -c all.cpp 2>said.txt &&
    nm -u all.o | sed 's/.* //' | sort -u | diff functions.txt - >>said.txt &&
    grep -q '^ql_hal_init$' functions.txt && grep -q '^ql_app_run' functions.txt
say functions_have_c_linkage $? \
    "$(wc -l <functions.txt) functions $(head -n 1 said.txt)"

# ---- other gates in the program than in the core

# gates.txt: a line "GATE=VALUE" for each value that is no default.
awk '$1 == "gate" && $2 ~ /^QL_CFG_/ {
    for (k = 4; k <= NF; k++) print $2 "=" $k
}' "$root/tests/configs/gates.txt" >turned.txt

# What must go with it, so that ql_config.h agrees.
along() {
    case $1 in
    *_LIGHTS=0) echo -DQL_CFG_SKY=0 -DQL_CFG_SKY_MAP=0 ;;
    *_SKY=0 | *_TABLES=0) echo -DQL_CFG_SKY_MAP=0 ;;
    esac
}

core=$build/test/fine/core.a
$CC -Ifirmware -c main.c show.c "$root/hal/ql_blob_data.S" \
    '-DQL_BLOB_FILE="room.qlb"' 2>said.txt
$CC main.o show.o ql_blob_data.o "$core" -o picture 2>>said.txt
say a_program_with_the_gates_of_the_core_links $? "$(head -n 1 said.txt)"

# links FLAGS...: does the program, compiled with these, link with the core?
links() {
    "$CC" -w -Ifirmware "$@" -c main.c || exit 3
    "$CC" main.o show.o ql_blob_data.o "$core" -o picture 2>said.txt
}

count=0 bad=
while read -r gate; do
    # shellcheck disable=SC2046
    links "-D$gate" $(along "$gate")
    if [ $? -ne 1 ] || ! grep -q 'undefined.*`ql_blob_open_' said.txt; then
        bad="$bad $gate"
    fi
    count=$((count + 1))
done <turned.txt
[ $count -gt 26 ]
say_none no_program_with_a_gate_turned_links "$bad"

# Some gates can be turned with others only, so their names are looked at.
printf '%s\n' '#include "ql_config.h"' 'QL_GATED(name)' >name.c
name() {
    $CC -E -P -Ifirmware "$@" name.c
}
bad=$(while read -r gate; do
    # shellcheck disable=SC2046
    set -- $(along "$gate")
    [ "$(name "$@" "-D$gate")" != "$(name "$@")" ] || echo "$gate"
done <turned.txt)
say_none each_gate_alone_is_another_name "$bad"

# With optimisation of the whole program.
for flags in '' -DQL_CFG_ADAPTIVE=0; do
    # shellcheck disable=SC2086
    "$CC" -flto -O2 -Ifirmware -c firmware/blob/ql_blob_open.c &&
        "$CC" -flto -O2 -Ifirmware $flags main.c show.o ql_blob_open.o \
            ql_blob_data.o "$core" -o picture 2>said.txt
    echo $?
done >codes.txt
[ "$(paste -s -d ' ' codes.txt)" = '0 1' ] &&
    grep -q 'undefined.*`ql_blob_open_' said.txt
say nor_does_it_with_link_time_optimisation $?

# ---- its version

text=$(awk '$1 == "##" { print $2; exit }' "$root/CHANGELOG.md")
number=$(echo "$text" | awk -F . '{ print $1 * 65536 + $2 * 256 + $3 }')
cat >version.c <<END
#include <string.h>
#include "qlux.h"
#if QLUX_VERSION_NUMBER != $number
#error "another number"
#endif
int main(void) { return strcmp(QLUX_VERSION, "$text"); }
END
"$CC" -Ifirmware version.c -o version && ./version
say the_version_is_the_changelogs_in_text_and_number $? "$text $number"
exit $((failures > 0))
