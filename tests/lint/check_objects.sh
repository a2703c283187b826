#!/bin/sh
# check_objects.sh - compile the core for every CPU; look into its objects
# SPDX-License-Identifier: MIT
#
# usage: tests/lint/check_objects.sh
#
# For each CPU and precision: no warning; no undefined symbol but the core's
# own, memcpy, memset and integer helpers; no 64-bit division. Prints one claim
# each; exit 1 if any fails.
#
# Example: tests/lint/check_objects.sh

set -u
out=${BUILD:-build}/check-objects
flags="-std=c99 -pedantic -ffreestanding -Werror -O2 -ffunction-sections
    $(sed -n 's/^export WARN := //p' Makefile) -Ifirmware -Ihal"
. tests/support/claims.sh

# name, tool prefix, flags of each CPU the core is built for
if tools/dev/setup.sh --x86; then
    own='x86_64|||-m64
i386|||-m32'
else
    own="$(uname -m)|||"
    say_as objects/i386 cannot_be_made_on_this_machine ok "$(uname -m)"
fi
cpus="$own
armv6-m|arm-none-eabi-||-mcpu=cortex-m0 -mthumb
armv7-m|arm-none-eabi-||-mcpu=cortex-m3 -mthumb
armv7e-m|arm-none-eabi-||-mcpu=cortex-m4 -mthumb
armv8-m.base|arm-none-eabi-||-mcpu=cortex-m23 -mthumb
armv8-m.main|arm-none-eabi-||-mcpu=cortex-m33 -mthumb
rv32imc|riscv64-unknown-elf-||-march=rv32imc -mabi=ilp32
rv32imac|riscv64-unknown-elf-||-march=rv32imac -mabi=ilp32
avr|avr-||-mmcu=atmega2560"

check_cpu()
{
    name=$1 prefix=$2 options=$3
    for precision in 0 1; do
        dir=$out/$name-$precision
        mkdir -p "$dir"
        rm -f "$dir"/*.o
        log=
        for source in firmware/*/*.c firmware/*/*/*.c; do
            object=$dir/$(basename "$source" .c).o
            log="$log$(${prefix}gcc $flags $options \
                -DQL_CFG_PRECISION=$precision -c "$source" -o "$object" 2>&1)"
        done
        suite=objects/$name-$([ $precision = 0 ] && echo draft || echo fine)
        say_none the_whole_core_compiles_without_a_warning "$log"

        # Floating-point helpers of libgcc, every ABI's spelling, and the heap.
        bad=$(${prefix}nm -u "$dir"/*.o | awk '{ print $NF }' | sort -u |
            grep -E -e '^(__aeabi_[fd]|__aeabi_[ui]l?2[fd]|__aeabi_c[df])' \
                -e '^(__.*(sf|df|xf|tf)[0-9]*$|__fix|__float)' \
                -e '^(malloc|calloc|realloc|free|_sbrk|printf|abort)')
        say_none no_float_helper_and_no_heap_is_referenced "$bad"

        bad=$(for object in "$dir"/*.o; do
            ${prefix}objdump -dr "$object" |
                awk -v object="$(basename "$object")" '
                /^[0-9a-f]+ <[^.].*>:$/ { name = $2 }
                /__aeabi_u?ldivmod|__u?(div|mod)di3|__udivmoddi4/ {
                    print object ":" name
                }'
        done)
        say_none no_64_bit_division_anywhere "$bad"
    done
}

IFS='
'
for line in $cpus; do
    name=${line%%|*}
    rest=${line#*|}
    prefix=${rest%%|*}
    options=${rest##*|}
    unset IFS
    check_cpu "$name" "$prefix" "$options"
    IFS='
'
done
exit $((failures > 0))
