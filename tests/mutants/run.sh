#!/bin/sh
# run.sh - plant one fault after the other in the core: a test must see each
# SPDX-License-Identifier: MIT
#
# usage: tests/mutants/run.sh [NAME...]   all mutants of mutants.txt, or these
#        tests/mutants/run.sh --check     only: do they apply and compile?
#        tests/mutants/run.sh --list      README.md's table
#        tests/mutants/run.sh --needs     what make has to build first
#
# A mutant is a line or a few of one file of the core, replaced. The changed
# file goes to build/mutants/NAME, is compiled against the unchanged rest, and
# linked with the test named to kill it, which then has to fail. If it passes,
# every other test of the core gets its chance. A mutant fails this
# test if nothing kills it, if its lines are not found exactly once, if it does
# not compile, or if it leaves the object code as it was.
#
# Prints one claim a mutant; the last line is "N passed, N failed". First, a
# mutant that changes nothing is refused, and every test named passes without a
# fault.
# Environment: CC (cc); LIMIT (120), seconds of processor time that a test may
# take. A test that goes on, or waits for ever, has failed.
#
# Example: make test-mutants

set -u
. tests/support/claims.sh
columns='%-52s %-34s'
here=tests/mutants
list=$here/mutants.txt
readme=$here/README.md
CC=${CC:-cc}
LIMIT=${LIMIT:-120}
flags="-std=c99 -O1 -w -D_POSIX_C_SOURCE=200809L"
rest="-Ifirmware -Itools -Ihal -Itests -I."
jobs=$(getconf _NPROCESSORS_ONLN)
built=${BUILD:-build}
work=${WORK:-$built/mutants}

precision_of() # CONFIGURATION: as tests/configs
{
    case $1 in
    draft) echo -DQL_CFG_PRECISION=0 ;;
    *) echo -DQL_CFG_PRECISION=1 ;;
    esac
}

names()
{
    awk '$1 == "mutant" { print $2 }' $list
}

field() # NAME FIELD: each of its values on a line
{
    awk -v name="$1" -v field="$2" '
        $1 == "mutant" { on = $2 == name }
        on && $1 == field { sub(/^[a-z]+ +/, ""); print }' $list
}

build_of() # NAME: its configuration
{
    build=$(field "$1" build)
    echo "${build:-fine}"
}

killers() # "CONFIGURATION TEST CLAIM" of all mutants wanted
{
    for name in "$@"; do
        field "$name" killer | sed "s/^/$(build_of "$name") /"
    done | sort -u
}

# ---- plant ------------------------------------------------------------------

# NAME: print its file with the fault. Fails unless the lines are there once.
plant()
{
    awk -v name="$1" '
        FNR == NR {
            if ($1 == "mutant") {
                on = $2 == name
            } else if (on && /^[-+ ]/) {
                line = substr($0, 2) "\n"
                if (!/^\+/) old = old line
                if (!/^-/) new = new line
            }
            next
        }
        { text = text $0 "\n" }
        END {
            text = "\n" text
            at = index(text, "\n" old)
            if (old == "" || at == 0 || index(substr(text, at + 1), "\n" old))
                exit 1
            printf "%s%s%s", substr(text, 2, at - 1), new,
                substr(text, at + 1 + length(old))
        }' $list "$(field "$1" file)"
}

# What may see a header of the core: itself and what tests share.
seeing()
{
    ls firmware/*/*.c firmware/*/*/*.c tests/support/*.c tests/support/*/*.c \
        tools/scene/*.c tools/scene/*/*.c
}

# NAME: the sources that its file is part of; of a header also the tests named.
sources_of()
{
    file=$(field "$1" file)
    case $file in
    *.h)
        awk -v f="$file" '
            { for (i = 2; i <= NF; i++) if ($i == f) { print $1; next } }' \
            "$work/base/includes"
        field "$1" killer | sed 's|^|tests/|; s| .*||; s|$|.c|' | sort -u
        ;;
    *) echo "$file" ;;
    esac
}

# SOURCE...: "source header header ..." of each.
includes()
{
    for source in "$@"; do
        $CC $flags $rest -DQL_CFG_PRECISION=1 -MM "$source" |
            sed 's/^[^:]*: //; s/\\$//' | tr '\n' ' '
        echo
    done
}

# CONFIGURATION SOURCE OBJECT [FOLDER]: compile, headers from FOLDER first.
compile()
{
    mkdir -p "$(dirname "$3")" &&
        $CC $flags ${4:+"-I$4/firmware"} $rest "$(precision_of "$1")" \
            -c "$2" -o "$3"
}

# NAME: plant it and compile what it is part of. Says what went wrong.
make_mutant()
{
    dir=$work/$1
    build=$(build_of "$1")
    file=$(field "$1" file)
    rm -rf "$dir"
    mkdir -p "$dir/$(dirname "${file:-none}")"
    if [ ! -f "$file" ] || ! plant "$1" > "$dir/$file"; then
        say_as "mutants/$1" is_found_exactly_once FAIL "in ${file:-no file}"
        return 1
    fi
    same=1
    for source in $(sources_of "$1"); do
        object=$dir/${source%.c}.o
        from=$source
        [ "$source" = "$file" ] && from=$dir/$file
        if ! compile "$build" "$from" "$object" "$dir" 2> "$dir/errors"; then
            say_as "mutants/$1" compiles FAIL \
                "$(grep error: "$dir/errors" | head -n 1)"
            return 1
        fi
        cmp -s "$object" "$work/base/$build/${source%.c}.o"
        [ $? = 1 ] && same=0
    done
    if [ $same = 1 ]; then
        say_as "mutants/$1" changes_the_code FAIL "the objects are the same"
        return 1
    fi
}

# ---- kill -------------------------------------------------------------------

# FOLDER LOG TEST CLAIM: does a test pass? Leaves why not in $why.
passes()
{
    case $3 in
    unit/test_app) set -- "$1" "$2" "$3" "$built/cornell.qlb" ;;
    esac
    tools/dev/limit.sh --cpu "$LIMIT" "$1/$3" ${4:+"$4"} > "$2" 2>&1
    status=$?
    why=$(awk '$3 == "FAIL" { print $2; exit }' "$2")
    [ $status = 124 ] && why="no end: $(tail -n 1 "$2")"
    [ $status -gt 124 ] && why="died, status $status"
    [ $status = 0 ]
}

# NAME TEST [CLAIM]: does a test let a mutant live?
lives()
{
    dir=$work/$1
    build=$(build_of "$1")
    base=$built/test/$build
    object=$base/tests/$2.o
    mkdir -p "$dir/$(dirname "$2")"
    if [ ! -f "$dir/$2" ]; then
        case $(field "$1" file) in
        *.h)
            object=$dir/tests/$2.o
            [ -f "$object" ] ||
                compile "$build" "tests/$2.c" "$object" "$dir" || return 0
            ;;
        esac
        $CC "$object" $(find "$dir/firmware" "$dir/tests/support" \
            "$dir/tools" -name '*.o' 2> /dev/null) "$base/support.a" \
            "$base/core.a" "$base/support.a" -o "$dir/$2" -lm -lpthread \
            2> "$dir/errors" || return 0
    fi
    passes "$dir" "$dir/log" "$2" "${3:-}"
}

# NAME: make it and let the tests named for it try.
one()
{
    make_mutant "$1" || return
    while read -r test claim; do
        if ! lives "$1" "$test" "$claim"; then
            say_as "mutants/$1" "killed_by_$test" ok "$why"
            rm -rf "${work:?}/$1"
            return
        fi
    done <<EOF
$(field "$1" killer)
EOF
    echo "$1" >> "$work/lives"
}

# NAME: let all others try. A test that fails without the fault too is none.
others()
{
    build=$(build_of "$1")
    for test in $(all_tests); do
        if ! lives "$1" "$test"; then
            by=$why
            if passes "$built/test/$build" "$work/$1/log" "$test"; then
                say_as "mutants/$1" "killed_by_$test" ok "$by"
                echo "$1" >> "$work/by_others"
                return
            fi
        fi
    done
    say_as "mutants/$1" is_killed FAIL "by no test at all"
}

all_tests() # those of the core, the quick ones first
{
    for source in tests/unit/test_*.c tests/extreme/extreme_*.c \
        tests/known/known_*.c tests/known/double/known_*.c; do
        test=${source#tests/}
        echo "${test%.c}"
    done
}

# "CONFIGURATION TEST CLAIM": a killer has to pass without any fault.
base_one()
{
    log=$work/base/log/$(echo "$1" | tr '/ ' '__')
    set -- $1
    if ! passes "$built/test/$1" "$log" "$2" "${3:-}"; then
        say_as mutants/base "$2" FAIL "fails without any fault: $why"
    elif ! awk '$3 == "ok" { f = 1 } END { exit !f }' "$log"; then
        say_as mutants/base "$2" FAIL "claims nothing like ${3:-}"
    fi
}

# ---- all of them ------------------------------------------------------------

each() # COMMAND: run "$0 COMMAND LINE" for each line of the input, in parallel
{
    tr '\n' '\0' | WORK=$work xargs -0 -n 1 -P "$jobs" "$0" "$1"
}

# Objects without a fault, compiled as mutants are.
prepare()
{
    rm -rf "$work"
    mkdir -p "$work/base/log"
    includes $(seeing) > "$work/base/includes"
    for name in "$@"; do
        build=$(build_of "$name")
        for source in $(sources_of "$name"); do
            echo "$build $source"
        done
    done | sort -u | each --base-object
}

# A fault that is none must not pass for one.
identity()
{
    echo "fine firmware/warp/ql_warp_sphere.c" | each --base-object
    {
        cat $list
        printf '\nmutant %s\n' none_at_all
        echo "file firmware/warp/ql_warp_sphere.c"
        sed -n '/^#include/{s/^/ /;p;q;}' firmware/warp/ql_warp_sphere.c
    } > "$work/with_none"
    if LIST=$work/with_none WORK=$work "$0" --check-one none_at_all |
        grep -q 'changes_the_code .*FAIL'; then
        say_as mutants/check a_fault_that_changes_nothing_is_refused ok
    else
        say_as mutants/check a_fault_that_changes_nothing_is_refused FAIL
    fi
}

print_list()
{
    printf '| mutant | fault | killed by |\n|---|---|---|\n'
    for name in $(names); do
        field "$name" killer | awk -v name="$name" \
            -v fault="$(field "$name" fault)" '
            NR == 1 {
                printf "| %s | %s | `%s` %s |\n", name, fault, $1, $2
            }'
    done
}

# What is true of the list itself.
listed()
{
    bad=$(names | sort | uniq -d)
    suite=mutants/list
    say_none names_are_unique "$bad"
    print_list > "$work/list"
    if awk '/^\| mutant /{ on = 1 } on && /^\|/' $readme |
        cmp -s - "$work/list"; then
        say_as mutants/list is_the_table_of_the_readme ok
    else
        say_as mutants/list is_the_table_of_the_readme FAIL "see $0 --list"
    fi
}

check()
{
    prepare $(names)
    identity
    bad=$(names | each --check-one)
    if [ -z "$bad" ]; then
        say_as mutants/check \
            every_fault_applies_once_compiles_and_changes_the_code ok \
            "$(names | wc -l) mutants"
    else
        echo "$bad"
    fi
    listed
}

# COMMAND...: print its claims as they come, count them; fails if a claim does.
count()
{
    mkdir -p "$built"
    "$@" | tee "$work.log"
    awk '
        $3 == "ok" { passed++ }
        $3 == "FAIL" { failed++; list = list "  " $1 " " $2 "\n" }
        END {
            if (failed) printf "failed:\n%s", list
            printf "%d passed, %d failed\n", passed, failed
            exit failed > 0 || passed == 0
        }' "$work.log"
}

run()
{
    prepare "$@"
    identity
    killers "$@" | each --base > "$work/base/failed"
    cat "$work/base/failed"
    [ -s "$work/base/failed" ] ||
        say_as mutants/base tests_named_pass_without_a_fault ok \
            "$(killers "$@" | wc -l) tests"
    printf '%s\n' "$@" | each --one
    [ -f "$work/lives" ] || return
    make -s -k -j "$jobs" $(for build in $(sort "$work/lives" |
        while read -r name; do build_of "$name"; done | sort -u); do
        all_tests | sed "s|^|$built/test/$build/|"
    done) > "$work/make.log" 2>&1
    sort "$work/lives" | each --others
    if [ -f "$work/by_others" ]; then
        say_as mutants/list names_a_test_that_kills_each FAIL \
            "not $(sort "$work/by_others" | tr '\n' ' ')"
    fi
}

run_all()
{
    run $(names)
    listed
}

list=${LIST:-$list}
case ${1:-} in
--one) one "$2" ;;
--others) others "$2" ;;
--base) base_one "$2" ;;
--base-object)
    set -- $2
    compile "$1" "$2" "$work/base/$1/${2%.c}.o"
    ;;
--check-one)
    make_mutant "$2"
    rm -rf "${work:?}/$2"
    ;;
--check)
    work=$built/mutants-check
    count check
    ;;
--list) print_list ;;
--needs)
    killers $(names) | awk -v built="$built" '
        { print built "/test/" $1 "/" $2 }
        END { print built "/cornell.qlb\n" built "/mesh.qlb" }' | sort -u
    ;;
-*) sed -n '/^# usage/,/^# Example/s/^# \{0,1\}//p' "$0" >&2 && exit 2 ;;
'') count run_all ;;
*) count run "$@" ;;
esac
