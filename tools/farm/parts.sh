# parts.sh - parts of a picture in a folder: which are there; scripts source it
# SPDX-License-Identifier: MIT
#
# Before: usage prints the help. After `begin PARTS OUT SCENE --size WxH ...`:
# $parts, $out, $scene, $options, and $folder, which is OUT.parts. Part I is
# $folder/I.qls, sums of the I-th band of rows; it is complete if it is there.

sim=${SIM:-qlux-sim}
merge=${MERGE:-qlux-merge}

fail() { # STATUS MESSAGE
    echo "${0##*/}: $2" >&2
    exit "$1"
}

begin() {
    [ $# -ge 5 ] || fail 1 "too few arguments (see --help)"
    parts=$1 out=$2 scene=$3 folder=$2.parts
    shift 3
    options=$*
    height=$(expr " $options " : '.* --size [0-9]*x\([0-9]*\) ')
    case $options in
    *[!A-Za-z0-9\ .:_-]*) fail 1 "'$options': expected words without signs" ;;
    esac
    [ "$parts" -ge 1 ] 2>/dev/null && [ "$parts" -le "${height:-0}" ] ||
        fail 1 "'$parts' of '$options': expected --size, and parts of 1 row up"
    sum=$(cksum <"$scene") && mkdir -p "$folder" || exit 3
    set -- "$sim, $parts parts, scene $sum, $options"
    [ -e "$folder/what" ] || echo "$1" >"$folder/what" || exit 3
    [ "$(cat "$folder/what")" = "$1" ] ||
        fail 2 "$folder has parts of another picture: $(cat "$folder/what")"
}

# The numbers of the parts that are not there.
missing() {
    i=0
    while [ $i -lt "$parts" ]; do
        [ -e "$folder/$i.qls" ] || echo $i
        i=$((i + 1))
    done
}

# part I [COMMAND...]: render it by the simulator, run by COMMAND. The scene and
# the sums go through pipes, so no folder needs to be shared.
part() {
    i=$1 rows=$((height * $1 / parts)):$((height * ($1 + 1) / parts))
    shift
    file=$folder/$i.$(uname -n).$$.tmp
    # shellcheck disable=SC2086 # words
    "$@" "$sim" - $options --rows $rows --save-sums - --quiet <"$scene" \
        >"$file" && mv "$file" "$folder/$i.qls"
}

# Put all of them together, and forget what was left half-written.
finish() {
    [ -z "$(missing)" ] || fail 3 "parts $(missing | paste -s -d ' ' -) are \
missing; the others are in $folder: run it again"
    "$merge" "$folder"/*.qls -o "$out" && rm -f "$folder"/*.tmp
}
