#!/bin/sh
# test_options.sh - every program words its help and its refusals in one way
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/lib/test_options.sh [BUILD]
# Example: tests/tools/lib/test_options.sh build

suite=tools/options
. tests/support/workspace.sh
version=$(awk '$1 == "##" { print $2; exit }' "$root/CHANGELOG.md")

# refuses PATTERN ARGUMENTS...: exit code 1, this line and no other is printed,
# nothing is written
refuses() {
    pattern=$1
    shift
    "$build/$program" "$@" >out.txt 2>err.txt
    [ $? -eq 1 ] && [ ! -s out.txt ] && [ "$(wc -l <err.txt)" -eq 1 ] &&
        grep -qx -- "$program: $pattern (see --help)" err.txt &&
        [ "$(ls | tr '\n' ' ')" = "err.txt help.txt out.txt " ]
}

# A program, an option with a wrong value, arguments of which the last is one
# too many; - is none.
while IFS='|' read -r program wrong stray; do
    "$build/$program" --help >help.txt 2>err.txt
    [ $? -eq 0 ] && [ ! -s err.txt ] &&
        head -n 1 help.txt | grep -q "^$program: "
    say "${program}_helps_by_its_own_name" $?
    sed '1,/^Example:$/d' help.txt >out.txt &&
        grep -q "^  $program " out.txt && ! grep -qv '^  ' out.txt
    say "${program}_help_ends_in_an_example" $?
    ! grep -q '.\{80\}' help.txt
    say "${program}_help_is_below_80_columns" $?
    "$build/$program" -h | cmp -s - help.txt &&
        "$build/$program" --bogus x --help y z | cmp -s - help.txt
    say "${program}_helps_wherever_it_is_asked" $?
    [ "$("$build/$program" --version)" = "$program $version" ]
    say "${program}_tells_its_version" $?

    refuses "unknown option '--bogus'" --bogus
    say "${program}_refuses_an_unknown_option" $?
    # "  --spp N    samples": an option that has a value
    bad=
    for option in $(sed -n 's/^  \(-[-a-z]*\) [^ ].*/\1/p' help.txt); do
        needs="'$option' needs a value: .*"
        refuses "$needs" "$option" && refuses "$needs" "$option" '' &&
            refuses "$needs" "$option" --quiet || bad="$bad $option"
    done
    say_none "${program}_refuses_every_missing_value" "$bad"
    # shellcheck disable=SC2086 # a list of arguments
    [ "$wrong" = - ] || refuses "'$wrong': expected .*" $wrong
    say "${program}_refuses_a_wrong_value" $?
    # shellcheck disable=SC2086
    [ "$stray" = - ] || refuses "unexpected argument '${stray##* }'" $stray
    say "${program}_refuses_a_stray_argument" $?
    refuses 'missing .*'
    say "${program}_names_what_is_missing" $?
done <<'END'
qlux-scene|--leaf 0|a b
qlux-lut|-|-o a b
qlux-sim|--spp 0|a b
qlux-sim-draft|--direct x|a b
qlux-merge|--format x|-
qlux-cost|--precision x|a b
qlux-diff|--max-bias x|a b c
qlux-sheet|--zoom 17|-
qlux-recv|--baud 1.5|a b
qlux-warp|-m x|test tent b
qlux-ref|--size 4|a b
qlux-trade|-o a.gif|a b
END

# The settings of a picture are one table.
settings() {
    "$build/$1" --help | sed -n '/^  --size/,/^  --roulette/p' | tr -s ' \n' ' '
}
[ "$(settings qlux-ref | wc -w)" -ge 100 ] &&
    [ "$(settings qlux-sim)" = "$(settings qlux-ref)" ] &&
    [ "$(settings qlux-sim-draft)" = "$(settings qlux-ref)" ]
say simulators_and_reference_have_the_same_settings $?

exit $((failures > 0))
