#!/bin/sh
# run_matrix.sh - the goldens with every compiler, level, word size, byte order
# SPDX-License-Identifier: MIT
#
# usage: tests/golden/run_matrix.sh [CONFIG | --update]
#   CONFIG    only configurations whose name contains it
#   --update  rewrite checksums.txt from one build of each precision
#
# Builds golden.c and the core each way and compares with checksums.txt. Prints
# "golden/NAME  matches_bit_for_bit  ok" a configuration; a compiler or emulator
# that is missing is a failure. Needs build/qlux-scene; works in build/golden.
#
# Example: tests/golden/run_matrix.sh powerpc

set -u
only=${1:-}
built=${BUILD:-build}
out=$built/golden
sums=tests/golden/checksums.txt
warn="-std=c99 -pedantic $(sed -n 's/^export WARN := //p' Makefile) -Werror"
. tests/support/claims.sh
ran=0
core=$(ls firmware/*/*.c firmware/*/*/*.c | grep -v /app/)
nearest='-DQL_CFG_TABLE_BITS=5 -DQL_CFG_TABLE_LERP=0'
lerp='-DQL_CFG_TABLE_BITS=10 -DQL_CFG_TABLE_LERP=1'

mkdir -p "$out"
tests/golden/scenes.sh "$built/qlux-scene" "$out" || exit 1
# The Cornell box with nodes of both widths, then a scene for each feature; of
# other tables the small scenes will do.
cornell="$out/16/cornell.qlb $out/8/cornell.qlb"
small=$(ls "$out"/16/corner-*.qlb | tr '\n' ' ')
few="$cornell $small"
blobs=$few
for scene in square glossy sky lens smooth strategies; do
    blobs="$blobs $out/16/$scene.qlb"
done

# build NAME COMPILER FLAGS: build/golden/NAME
build()
{
    # shellcheck disable=SC2086  # COMPILER and FLAGS are lists of words
    $2 $warn $3 -Ifirmware -Ihal -Itests $core tests/golden/golden.c \
        -o "$out/$1"
}

# run NAME RUNNER MODE
run()
{
    case $1 in
    *-nearest-* | *-lerp-*) set -- "$@" "$few" ;;
    *) set -- "$@" "$blobs" ;;
    esac
    # shellcheck disable=SC2086
    $2 "$out/$1" "$3" "$sums" $4
}

# config NAME RUNNER COMPILER FLAGS: both precisions
config()
{
    case $1 in
    *"$only"*) ;;
    *) return ;;
    esac
    for precision in draft fine; do
        number=0
        [ "$precision" = draft ] || number=1
        name=$1-$precision
        ran=$((ran + 1))
        if build "$name" "$3" "$4 -DQL_CFG_PRECISION=$number" \
            > "$out/$name.log" 2>&1 &&
            run "$name" "$2" check >> "$out/$name.log" 2>&1; then
            say_as "golden/$name" matches_bit_for_bit ok
        else
            say_as "golden/$name" matches_bit_for_bit FAIL "see $out/$name.log"
            sed -n '1,12p' "$out/$name.log"
        fi
    done
}

if [ "$only" = --update ]; then
    for number in 0 1; do
        for tables in 7-1 5-0 5-1 6-0 6-1 7-0 8-0 8-1 9-0 9-1 10-0 10-1; do
            name=update-$(echo $tables | sed 's/\(.*\)-0/nearest-\1/
                s/^7-1$/all/; s/\(.*\)-1$/lerp-\1/')-
            build "$name" "${CC:-cc}" "-O2 -DQL_CFG_PRECISION=$number \
                -DQL_CFG_TABLE_BITS=${tables%-*} \
                -DQL_CFG_TABLE_LERP=${tables#*-}" &&
                run "$name" '' update || exit 1
        done
    done
    echo "$sums: $(wc -l < "$sums") checksums"
    exit 0
fi

for level in O0 O2 Os; do
    config "gcc-$level" '' gcc "-$level"
    config "clang-$level" '' clang "-$level"
done
config gcc-halves '' gcc '-O2 -DQL_PORT_WIDE_MUL=0'
config clang-halves '' clang '-O2 -DQL_PORT_WIDE_MUL=0'

# 32-bit words. The multilib package does not bring <asm/errno.h> along.
if tools/dev/setup.sh --x86; then
    config gcc-i386 '' gcc \
        "-m32 -O2 -isystem /usr/include/$(gcc -print-multiarch)"
elif [ -z "${only%%gcc-i386*}" ]; then
    ran=$((ran + 1))
    say_as golden/gcc-i386 cannot_run_on_this_machine ok "$(uname -m)"
fi

# Coarse tables and long ones.
config gcc-nearest-5 '' gcc "-O2 $nearest"
config clang-nearest-5 '' clang "-O2 $nearest"
config gcc-lerp-10 '' gcc "-O2 $lerp"
config clang-lerp-10 '' clang "-Os $lerp"
config powerpc-nearest-5 qemu-ppc powerpc-linux-gnu-gcc \
    "-static -O2 $nearest"

# The other byte order.
config powerpc qemu-ppc powerpc-linux-gnu-gcc '-static -O2'
config powerpc-halves qemu-ppc powerpc-linux-gnu-gcc \
    '-static -O2 -DQL_PORT_WIDE_MUL=0'

# rejects WHAT AWK-PROGRAM: checksums that AWK changes must fail
rejects()
{
    ran=$((ran + 1))
    awk "$2" "$sums" > "$out/changed.txt"
    # shellcheck disable=SC2086  # a list of scenes
    if "$out/gcc-O2-fine" check "$out/changed.txt" $blobs \
        > "$out/rejects.log" 2>&1; then
        say_as golden/check "rejects_$1" FAIL "it passes"
    else
        say_as golden/check "rejects_$1" ok
    fi
}

if [ -z "$only" ]; then
    rejects a_changed_checksum '$1 == "fine/hash32" { $2 = "00000000" } 1'
    rejects a_missing_checksum '$1 != "fine/hash32"'
    rejects a_checksum_of_nothing '{ print } END { print "fine/no 0" }'
fi

if [ "$ran" -eq 0 ]; then
    say_as golden/matrix "has_a_configuration_named_$only" FAIL
fi
exit $((failures > 0))
