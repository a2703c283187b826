#!/bin/sh
# run_matrix.sh - the core by every compiler for every CPU: bits and objects
# SPDX-License-Identifier: MIT
#
# usage: tests/matrix/run_matrix.sh [NAME...]
#        tests/matrix/run_matrix.sh --job NAME | --jobs | --update
#   NAME      only builds whose name contains one of these
#   --job     this one build; $BUILD/golden/blobs is there
#   --jobs    print "matrix/NAME|command;" for each, as tests/run.sh takes them
#   --update  rewrite checksums.txt and digests.txt from one build of each
#             precision and table
#
# Compiles the core once for each line of builds.txt and precision, without a
# warning, and looks at it in every way that the line names. Prints
# "matrix/NAME-PRECISION CLAIM ok"; a compiler or emulator that is missing is a
# failure. Needs build/qlux-scene; works in build/matrix.
#
# Example: tests/matrix/run_matrix.sh powerpc

# shellcheck disable=SC2046,SC2086  # flags and scenes are words
# shellcheck disable=SC2317  # look_golden and the like are called by name
set -u
here=tests/matrix
root=$(pwd)
built=${BUILD:-build}
out=$built/matrix
blobs=$built/golden
sums=tests/golden/checksums.txt
warn="-std=c99 -pedantic $(sed -n 's/^export WARN := //p' Makefile) -Werror"
. tests/support/claims.sh

# Lines of builds.txt as NAME|COMPILER|RUNNER|LOOKS|FLAGS
builds()
{
    awk '
        function put() { if (line != "") print line; line = "" }
        /^#/ || !NF { next }
        /^ / { sub(/^ +/, ""); line = line $0; next }
        { put(); line = $1 "|" $2 "|" ($3 == "-" ? "" : $3) "|" $4 "|" }
        END { put() }' $here/builds.txt
}

# The scenes drawn: the Cornell box with nodes of both widths, then one for each
# feature; with other tables the small ones will do.
scenes_for() # FLAGS
{
    echo "$blobs/16/cornell.qlb $blobs/8/cornell.qlb"
    ls "$blobs"/16/corner-*.qlb
    case $1 in
    *TABLE_BITS*) ;;
    *)
        for scene in square glossy sky lens smooth strategies; do
            echo "$blobs/16/$scene.qlb"
        done
        ;;
    esac
}

# compile DIR COMPILER FLAGS FILE...: objects in DIR
compile()
{
    (
        mkdir -p "$1" && cd "$1" || exit
        compiler=$2 flags=$3
        shift 3
        rm -f ./*.o
        "$compiler" $warn $flags -pipe -I"$root/firmware" -I"$root/hal" \
            -I"$root/tests" -c "$@"
    )
}

# The core in one piece: half the time of compiling its files one by one.
compile_core() # DIR COMPILER FLAGS
{
    compile "$1" "$2" "$3" "$root/firmware/qlux.c"
}

# link PROGRAM SOURCE FLAGS [LINK-FLAGS]: with the core; it alone is optimised
link()
{
    # gcc-multilib does not bring <asm/errno.h> along.
    case $flags in
    *-m32*) set -- "$1" "$2" "$3 -isystem /usr/include/$(
        gcc -print-multiarch)" ;;
    esac
    compile "$dir/$1.d" "$compiler" "$flags $3 -O0" "$root/$2" &&
        "$compiler" $flags "$dir/$1.d"/*.o "$dir"/*.o ${4-} -o "$dir/$1"
}

# CLAIM STATUS: of a failure, where to read on
say_or_log()
{
    if [ "$2" -eq 0 ]; then
        say "$1" 0
    else
        say "$1" 1 "see $log"
        sed -n '1,12p' "$log"
    fi
}

look_golden()
{
    link golden tests/golden/golden.c '' >> "$log" 2>&1 &&
        $runner "$dir/golden" check $sums $(scenes_for "$flags") >> "$log" 2>&1
    say_or_log goldens_match_bit_for_bit $?
}

# digest_is COMMAND: does it print the number?
digest_is()
{
    number=$("$@" 2>> "$log")
    wanted=$(sed -n "s/^$precision //p" $here/digests.txt)
    [ -n "$wanted" ] && [ "$number" = "$wanted" ]
    say case_55_pictures_have_the_number_of_all $? \
        "${number:-none, see $log}, wanted $wanted"
}

look_digest()
{
    link digest $here/digest_main.c '' >> "$log" 2>&1
    digest_is $runner "$dir/digest" "$blobs/digest.bin"
}

look_bare()
{
    relax=
    case $flags in
    *rv32*) relax=-Wl,--no-relax ;;
    esac
    mkdir -p "$dir/digest.d" && cp "$blobs/digest.bin" "$dir/digest.d" &&
        link digest $here/digest_main.c "-fomit-frame-pointer \
            -DDIGEST_BARE=\"digest.bin\"" "-nostdlib -static $relax -lgcc" \
            >> "$log" 2>&1
    digest_is $runner "$dir/digest"
}

# CLAIM KIND: objects.awk has found none
say_no()
{
    say_none "$1" "$(printf '%s\n' "$found" | sed -n "s/^$2 //p")"
}

look_objects()
{
    found=$(cd "$dir" && "${compiler%gcc}nm" -A ./*.o app/*.o |
        awk -f "$root/$here/objects.awk")
    say_no no_float_helper_and_no_heap_is_referenced float
    say_no no_64_bit_division_anywhere wide
    say_no nothing_else_is_but_the_core_the_port_and_integers other
    say_no nothing_static_can_be_written static
}

# rejects WHAT COMMAND...: it fails, and says so by status 1
rejects()
{
    what=$1
    shift
    "$@" >> "$log" 2>&1
    [ $? -eq 1 ]
    say "${what}_is_noticed" $?
}

# changed AWK-PROGRAM: the goldens, with checksums changed so
changed()
{
    awk "$1" $sums > "$dir/changed.txt"
    "$dir/golden" check "$dir/changed.txt" $(scenes_for "$flags")
}

changed_blob()
{
    cp "$blobs/digest.bin" "$dir/changed.bin"
    printf '\001' | dd of="$dir/changed.bin" bs=1 seek=200 conv=notrunc &&
        number=$("$dir/digest" "$dir/changed.bin") &&
        grep -x "$precision $number" $here/digests.txt
}

# One object with a fault of each kind, and one without
faulty_objects()
{
    {
        for symbol in __aeabi_fadd __divsf3 __floatsidf printf; do
            echo "a.o:         U $symbol"
        done
        for symbol in __aeabi_uldivmod __divdi3 __umoddi3; do
            echo "b.o:         U $symbol"
        done
        echo 'c.o:         U ql_nowhere'
        echo 'd.o:00000000 b count'
        echo 'e.o:00000000 D table'
        echo 'f.o:         U memcpy'
        echo 'f.o:         U ql_hal_init'
        echo 'f.o:00000000 T ql_function'
        echo 'f.o:00000000 r constant'
    } | awk -f $here/objects.awk | sed 's/\..*//' | sort | uniq -c | tr -s ' ' |
        paste -s -d , -
}

look_faults()
{
    rejects a_changed_checksum changed \
        "\$1 == \"$precision/hash32\" { \$2 = \"00000000\" } 1"
    rejects a_missing_checksum changed "\$1 != \"$precision/hash32\""
    rejects a_checksum_of_nothing changed \
        "{ print } END { print \"$precision/no 0\" }"
    rejects a_changed_blob changed_blob
    kinds=$(faulty_objects)
    [ "$kinds" = ' 4 float a, 1 other c, 1 static d, 1 static e, 3 wide b' ]
    say a_faulty_object_is_noticed $? "$kinds"
}

# Both precisions of "NAME|COMPILER|RUNNER|LOOKS|FLAGS"
build_and_look()
{
    IFS='|' read -r name compiler runner looks all << END_OF_LINE
$1
END_OF_LINE
    case $all in
    *-m32*)
        if ! tools/dev/setup.sh --x86; then
            say_as "matrix/$name" cannot_be_made_on_this_machine ok \
                "$(uname -m)"
            return
        fi
        ;;
    esac
    for precision in draft fine; do
        suite=matrix/$name-$precision
        dir=$out/$name-$precision
        log=$dir.log
        flags="$all -DQL_CFG_PRECISION=$([ $precision = draft ]; echo $?)"
        compile_core "$dir" "$compiler" "$flags" > "$log" 2>&1 &&
            case $looks in
            *objects*) compile "$dir/app" "$compiler" "$flags" \
                "$root"/firmware/app/*.c >> "$log" 2>&1 ;;
            esac
        status=$?
        say_or_log the_core_compiles_without_a_warning $status
        if [ $status -eq 0 ]; then
            for look in $(echo "$looks" | tr , ' '); do
                "look_$look"
            done
        fi
    done
}

# Every checksum and number anew, with this machine's compiler
update()
{
    compiler=${CC:-cc}
    rm -f "$out/digests.txt"
    for precision in draft fine; do
        [ $precision = draft ]
        all=-DQL_CFG_PRECISION=$?
        for tables in 7-1 5-0 5-1 6-0 6-1 7-0 8-0 8-1 9-0 9-1 10-0 10-1; do
            dir=$out/update log=$out/update.log
            flags="-O2 $all"
            # The default's are not named: with them every scene is drawn.
            [ $tables = 7-1 ] ||
                flags="$flags -DQL_CFG_TABLE_BITS=${tables%-*} \
                    -DQL_CFG_TABLE_LERP=${tables#*-}"
            compile_core "$dir" "$compiler" "$flags" &&
                link golden tests/golden/golden.c '' &&
                "$dir/golden" update $sums $(scenes_for "$flags") || return
            [ $tables = 7-1 ] || continue
            link digest $here/digest_main.c '' &&
                number=$("$dir/digest" "$blobs/digest.bin") || return
            echo "$precision $number" >> "$out/digests.txt"
        done
    done
    mv "$out/digests.txt" $here/digests.txt &&
        echo "$sums: $(wc -l < $sums) checksums"
}

mkdir -p "$out"
case ${1-} in
--jobs)
    builds | sed "s,\([^|]*\).*,matrix/\1|$here/run_matrix.sh --job \1;,"
    exit
    ;;
--job)
    build_and_look "$(builds | grep "^$2|")"
    exit $((failures > 0))
    ;;
esac

tests/golden/scenes.sh "$built/qlux-scene" "$blobs" || exit 1
if [ "${1-}" = --update ]; then
    update
    exit
fi
for part in "${@:-}"; do
    chosen=$(builds | grep "^[^|]*${part}[^|]*|")
    [ -n "$chosen" ] || say_as matrix/run "has_a_build_named_$part" FAIL
    for line in $(echo "$chosen" | cut -d '|' -f 1); do
        build_and_look "$(builds | grep "^$line|")"
    done
done
exit $((failures > 0))
