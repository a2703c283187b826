#!/bin/sh
# run.sh - plant one fault after the other: a test must see each
# SPDX-License-Identifier: MIT
#
# usage: tests/mutants/run.sh [NAME...]        all of mutants.txt, or these
#        tests/mutants/run.sh --share K-of-N   every Nth test's, one by one
#        tests/mutants/run.sh --check          only: do they apply and compile?
#        tests/mutants/run.sh --list           README.md's table
#        tests/mutants/run.sh --needs          what make has to build first
#
# A mutant is a line or a few of one file, replaced. What its file is part of
# is compiled into build/mutants/NAME, and linked, unchanged otherwise, into the
# test named to kill it; for a script, into the programs that the script runs.
# That test then has to fail, in the claim named. If it passes, every other test
# gets its chance. A mutant fails this test if nothing kills it, if its lines
# are not found exactly once, if it does not compile, or if it leaves the object
# code as it was.
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
flags="-std=c99 -O1 -g0 -w -D_POSIX_C_SOURCE=200809L"
rest="-Ifirmware -Itools -Ihal -Itests -I. -Isim -Itests/known -Itests/bench"
built=${BUILD:-build}
work=${WORK:-$built/mutants}

# ---- the list ---------------------------------------------------------------

names()
{
    awk '$1 == "mutant" { print $2 }' $list
}

# Those of every Nth test, so that each test is tried without a fault once.
share() # K N
{
    awk -v k="$1" -v n="$2" '
        $1 == "mutant" { name = $2 }
        $1 == "killer" && name {
            if (!($2 in at)) at[$2] = count++
            if (at[$2] % n == k - 1) print name
            name = ""
        }' $list
}

# The part of the list that is of each NAME, as a file of its own.
split_list()
{
    mkdir -p "$work/of"
    awk -v to="$work/of/" '
        $1 == "mutant" { if (file) close(file); file = to $2 }
        file { print > file }' $list
}

# NAME: set what the list has of it; killers are lines "TEST CLAIM".
load()
{
    name=$1
    file=none
    build=fine
    programs=
    killers=
    while IFS= read -r line; do
        case $line in
        'file '*) file=${line##* } ;;
        'build '*) build=${line##* } ;;
        'program '*) programs="$programs ${line##* }" ;;
        'killer '*) killers="$killers${killers:+
}${line#killer }" ;;
        esac
    done < "$work/of/$1"
    dir=$work/$1
    case $programs,$file in
    ,sim/*) programs=qlux-sim ;;
    ,tools/lib/* | ,tools/figure/*) ;;
    ,tools/*)
        programs=${file#tools/}
        programs=qlux-${programs%%/*}
        ;;
    esac
}

# ---- plant ------------------------------------------------------------------

precision_of() # CONFIGURATION: as tests/configs
{
    case $1 in
    draft) echo -DQL_CFG_PRECISION=0 ;;
    *) echo -DQL_CFG_PRECISION=1 ;;
    esac
}

# Print the file with the fault. Fails unless the lines are there once.
plant()
{
    awk '
        FNR == NR {
            if (/^[-+ ]/) {
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
        }' "$work/of/$name" "$file"
}

# Of the sources on the input those that TEST is linked with.
linked()
{
    base=$built/test/$build
    $CC "$base/tests/$1.o" "$base/support.a" "$base/core.a" "$base/support.a" \
        -o "$dir/unused" -lm -lpthread -Wl,-t,-t |
        sed -n 's|.*[(/)]\([a-z0-9_]*\)\.o)*$|/\1.c|p' > "$dir/linked"
    grep -F -f "$dir/linked"
}

# [TEST]: the sources that the file is part of. Of a header those that include
# it: the tests named and all others, or TEST and what it is linked with.
sources_of()
{
    case $file in
    *.c)
        echo "$file"
        return
        ;;
    esac
    printf '%s\n' "${1-$killers}" |
        sed 's| .*||; /\.sh$/d; s|^|tests/|; s|$|.c|' | sort -u
    grep -rlF " $file" --include='*.d' "$built/$build/firmware" \
        "$built/test/$build/tests/support" "$built/host/tools/scene" |
        sed "s|^$built/||; s|^test/||; s|^[a-z]*/||; s|d\$|c|" |
        if [ $# -eq 0 ]; then cat; else linked "$1"; fi
}

# CONFIGURATION SOURCE OBJECT [FOLDER]: compile, headers from FOLDER first.
compile()
{
    mkdir -p "${3%/*}" &&
        $CC $flags ${4:+"-I$4/firmware" "-I$4/tools"} $rest \
            "$(precision_of "$1")" -c "$2" -o "$3"
}

# [TEST]: plant the fault, compile what it is part of, or what TEST needs of
# it. Says what went wrong.
make_mutant()
{
    rm -rf "$dir"
    mkdir -p "$dir/${file%/*}"
    if [ ! -f "$file" ] || ! plant > "$dir/$file"; then
        say_as "mutants/$name" is_found_exactly_once FAIL "in $file"
        return 1
    fi
    for source in $(sources_of "$@"); do
        from=$source
        [ "$source" = "$file" ] && from=$dir/$file
        if ! compile "$build" "$from" "$dir/${source%.c}.o" "$dir" \
            2> "$dir/errors"; then
            say_as "mutants/$name" compiles FAIL \
                "$(grep error: "$dir/errors" | head -n 1)"
            return 1
        fi
    done
}

# Does the object code differ from what it is without the fault?
differs()
{
    for source in $(sources_of); do
        compile "$build" "$source" "$dir/without.o" 2> "$dir/errors" &&
            ! cmp -s "$dir/without.o" "$dir/${source%.c}.o" && return
    done
    say_as "mutants/$name" changes_the_code FAIL "the objects are the same"
    return 1
}

# ---- kill -------------------------------------------------------------------

# LOG COMMAND...: does a test pass? Leaves why not in $why.
passes()
{
    log=$1
    shift
    "$@" > "$log" 2>&1
    status=$?
    why=
    [ $status = 0 ] && return
    why=$(awk '$3 == "FAIL" { print $2; exit }' "$log")
    case $status in
    124) why="no end: $(tail -n 1 "$log")" ;;
    152) why="no end: $LIMIT s of processor time" ;; # SIGXCPU
    esac
    [ $status -gt 124 ] && why=${why:-"died, status $status"}
    return 1
}

# LOG PROGRAM TEST [CLAIM]: the same of a compiled test. One of the core alone
# waits for nothing, so that its processor time is limit enough.
program_passes()
{
    argument=
    [ "$3" = unit/test_app ] && argument=$built/cornell.qlb
    case $3 in
    tools/*)
        passes "$1" tools/dev/limit.sh --cpu "$LIMIT" "$2" ${4:+"$4"}
        ;;
    *)
        passes "$1" sh -c 'ulimit -S -t "$1"; shift; exec "$@"' - "$LIMIT" \
            "$2" ${argument:+"$argument"} ${4:+"$4"}
        ;;
    esac
}

# LOG FOLDER SCRIPT [CLAIM...]: the same of a script and the programs in FOLDER.
# It ends when it has said these claims, or at the first that fails.
script_passes()
{
    out=$1
    bin=$2
    script=$3
    shift 3
    passes "$out" env BUILD="$bin" UNTIL="${*:-all_of_them}" \
        tools/dev/limit.sh --cpu "$LIMIT" sh "tests/$script"
}

# TEST: link the mutant into it.
link_test()
{
    base=$built/test/$build
    object=$base/tests/$1.o
    [ -f "$dir/tests/$1.o" ] && object=$dir/tests/$1.o
    mkdir -p "$dir/${1%/*}"
    $CC "$object" $(find "$dir/firmware" "$dir/tests/support" "$dir/tools" \
        "$dir/sim" -name '*.o' 2> /dev/null) "$base/support.a" "$base/core.a" \
        "$base/support.a" -o "$dir/$1" -lm -lpthread 2> "$dir/errors"
}

# PROGRAM: its own objects, without the fault.
objects_of()
{
    case $1 in
    qlux-sim) ls "$built"/fine/sim/*.o ;;
    qlux-trade)
        find "$built/host/tools/trade" "$built/host/tools/figure" \
            -name '*.o' ! -name trade_error.o
        ;;
    qlux-warp)
        find "$built/host/tools/warp" "$built/host/tools/figure" -name '*.o'
        ;;
    *) find "$built/host/tools/${1#qlux-}" -name '*.o' ;;
    esac
}

# A folder of all programs, those with the fault linked anew.
link_programs()
{
    mkdir -p "$dir/bin"
    ln -s "$(cd "$built" && pwd)"/* "$dir/bin"
    for program in $programs; do
        objects=
        for object in $(objects_of "$program"); do
            source=${object#"$built"/*/}
            [ -f "$dir/$source" ] || objects="$objects $object"
        done
        rm -f "$dir/bin/$program"
        $CC $(find "$dir/firmware" "$dir/tools" "$dir/sim" -name '*.o' \
            2> /dev/null) $objects "$built/host/lib.a" \
            "$built/test/fine/core.a" -o "$dir/bin/$program" -lm -lpthread \
            2> "$dir/errors" || return
    done
}

# TEST [CLAIM]: does it let the mutant live? One that it cannot be linked with
# does.
lives()
{
    case $1 in
    *.sh)
        [ -d "$dir/bin" ] || link_programs || return 0
        script_passes "$dir/log" "$dir/bin" "$@"
        ;;
    *)
        [ -f "$dir/$1" ] || link_test "$1" || return 0
        program_passes "$dir/log" "$dir/$1" "$@"
        ;;
    esac
}

# NAME: make it and let the tests named for it try.
one()
{
    load "$1"
    case $killers in
    *.sh* | *"
"*) make_mutant || return ;;
    *) make_mutant "${killers%% *}" || return ;;
    esac
    first=${killers%%"
"*}
    while read -r test claim; do
        if ! lives "$test" $claim; then
            by=$why
            [ "$test $claim" = "$first" ] ||
                [ -z "$(base_one "$build $test $claim" | tee /dev/stderr)" ] ||
                continue
            say_as "mutants/$name" "killed_by_$test" ok "$by"
            rm -rf "${dir:?}"
            return
        fi
    done <<EOF
$killers
EOF
    echo "$name" >> "$work/lives"
}

# NAME: let all others try. A test that fails without the fault too is none.
others()
{
    load "$1"
    make_mutant && differs || return
    for test in $(all_tests "$file"); do
        if ! lives "$test"; then
            by=$why
            if without "$test"; then
                say_as "mutants/$name" "killed_by_$test" ok "$by"
                echo "$name" >> "$work/by_others"
                return
            fi
        fi
    done
    say_as "mutants/$name" is_killed FAIL "by no test at all"
}

# TEST [CLAIM...]: does it pass without a fault?
without()
{
    log=$work/base/$(echo "$build $*" | tr '/ ' '__' | cut -c 1-200)
    case $1 in
    *.sh) script_passes "$log" "$built" "$@" ;;
    *) program_passes "$log" "$built/test/$build/$1" "$@" ;;
    esac
}

# FILE: the tests that may see it, the quick ones first.
all_tests()
{
    case $1 in
    firmware/*)
        ls tests/unit/test_*.c tests/extreme/extreme_*.c \
            tests/known/known_*.c tests/known/double/known_*.c
        ;;
    *)
        ls tests/tools/*/test_*.c tests/unit/test_app.c
        ls tests/tools/test_*.sh tests/tools/*/test_*.sh |
            grep -v -e /dev/ -e test_make -e test_trade -e test_stack
        ls tests/known/double/known_ref.c
        ;;
    esac | sed 's|^tests/||; s|\.c$||'
}

# "CONFIGURATION TEST CLAIM...": a killer has to pass without any fault.
base_one()
{
    set -- $1
    build=$1
    shift
    if ! without "$@"; then
        say_as mutants/base "$1" FAIL "fails without any fault: $why"
        return
    fi
    log=$work/base/$(echo "$build $*" | tr '/ ' '__' | cut -c 1-200)
    test=$1
    shift
    for claim in "$@"; do
        awk -v claim="$claim" '
            $3 == "ok" && index($2, claim) { f = 1 } END { exit !f }' "$log" ||
            say_as mutants/base "$test" FAIL "claims nothing like $claim"
    done
}

# "CONFIGURATION TEST CLAIM", the first to be tried, of all mutants wanted; of a
# script all its claims.
all_killers() # NAME...
{
    for name in "$@"; do
        awk '
            $1 == "build" { build = $2 }
            $1 == "killer" {
                print (build ? build : "fine"), $2, $3
                exit
            }' "$work/of/$name"
    done | sort -u | awk '
        $2 !~ /\.sh$/ { print; next }
        { claims[$1 " " $2] = claims[$1 " " $2] " " $3 }
        END { for (test in claims) print test claims[test] }'
}

# ---- all of them ------------------------------------------------------------

each() # COMMAND: run "$0 COMMAND LINE" for each line of the input, in parallel
{
    tr '\n' '\0' | WORK=$work xargs -0 -n 1 -P "$jobs" "$0" "$1"
}

prepare()
{
    rm -rf "$work"
    mkdir -p "$work/base"
    split_list
}

# A fault that is none must not pass for one.
identity()
{
    {
        echo "file firmware/warp/ql_warp_sphere.c"
        sed -n '/^#include/{s/^/ /;p;q;}' firmware/warp/ql_warp_sphere.c
    } > "$work/of/none_at_all"
    if WORK=$work "$0" --check-one none_at_all |
        grep -q 'changes_the_code .*FAIL'; then
        say_as mutants/check a_fault_that_changes_nothing_is_refused ok
    else
        say_as mutants/check a_fault_that_changes_nothing_is_refused FAIL
    fi
}

print_list()
{
    printf '| mutant | fault | killed by |\n|---|---|---|\n'
    awk '
        function row() {
            if (name) printf "| %s | %s | `%s` %s |\n", name, fault, test, claim
        }
        $1 == "mutant" { row(); name = $2; test = "" }
        /^fault / { sub(/^fault +/, ""); fault = $0 }
        /^killer / && !test { test = $2; claim = $3 }
        END { row() }' $list
}

# What is true of the list itself.
listed()
{
    suite=mutants/list
    say_none names_are_unique "$(names | sort | uniq -d)"
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
    prepare
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
    mkdir -p "$work"
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

run() # NAME...
{
    all_killers "$@" > "$work/killers"
    each --base < "$work/killers" > "$work/base.failed"
    cat "$work/base.failed"
    [ -s "$work/base.failed" ] ||
        say_as mutants/base tests_named_pass_without_a_fault ok \
            "$(wc -l < "$work/killers") tests"
    printf '%s\n' "$@" | each --one
    [ -f "$work/lives" ] || return
    make -s -k -j "$jobs" $(sort "$work/lives" | while read -r name; do
        load "$name"
        all_tests "$file" | grep -v '\.sh$' | sed "s|^|$built/test/$build/|"
    done | sort -u) > "$work/make.log" 2>&1
    sort "$work/lives" | each --others
    if [ -f "$work/by_others" ]; then
        say_as mutants/list names_a_test_that_kills_each FAIL \
            "not $(sort "$work/by_others" | tr '\n' ' ')"
    fi
}

run_some()
{
    prepare
    run "$@"
}

run_all()
{
    prepare
    identity
    listed
    run $(names)
}

run_share() # K-of-N
{
    prepare
    if [ "${1%-of-*}" = 1 ]; then
        identity
        listed
    fi
    run $(share "${1%-of-*}" "${1#*-of-}")
}

jobs=$(getconf _NPROCESSORS_ONLN)
case ${1:-} in
--one) one "$2" ;;
--others) others "$2" ;;
--base) base_one "$2" ;;
--check-one)
    load "$2"
    make_mutant && differs
    rm -rf "${dir:?}"
    ;;
--check)
    work=$built/mutants-check
    count check
    ;;
--list) print_list ;;
--share)
    work=$built/mutants/$2
    jobs=1
    count run_share "$2"
    ;;
--needs)
    awk -v to="$built/test/" '
        $1 == "mutant" { build = "fine" }
        $1 == "build" { build = $2 }
        $1 == "killer" && !/\.sh / { print to build "/" $2 }' $list | sort -u
    ls tests/tools/*_main.c tests/tools/*/*_main.c |
        sed "s|^tests|$built/test/fine|; s|\.c$||"
    echo tools "$built/cornell.qlb" "$built/mesh.qlb"
    ;;
-*) sed -n '/^# usage/,/^# Example/s/^# \{0,1\}//p' "$0" >&2 && exit 2 ;;
'') count run_all ;;
*) count run_some "$@" ;;
esac
