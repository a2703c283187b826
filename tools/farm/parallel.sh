#!/bin/sh
# parallel.sh - render a picture on many machines: GNU parallel over ssh
# SPDX-License-Identifier: MIT

usage() {
    cat <<'END'
usage: tools/farm/parallel.sh HOSTS PARTS OUT SCENE.qlb --size WxH [OPTION...]
Render a picture in PARTS bands of rows, one at a time on each machine, and add
them up into OUT (.png, .ppm, .pfm): the bits of one machine. What a machine
fails to do is done by the next one.

  HOSTS    a file with a machine a line, as ssh takes it: "ann@host", "-p 2222
           host"; ":" is this one. The others need qlux-sim, and nothing more
  OPTION   of qlux-sim, except --rows, -o and --save-sums

OUT.parts has the parts, each there only when it is complete. If anything was
stopped, the same command goes on: what is there is not rendered again.

Environment:
  SIM, MERGE  the programs, if not qlux-sim (on all machines) and qlux-merge
  SSH         how to reach a machine: ssh -o BatchMode=yes -o ConnectTimeout=9

Example: tools/farm/parallel.sh hosts.txt 500 large.png room.qlb \
             --size 16384x16384 --spp 256
END
}

# attempt I SLOT HOSTS: by the machine of the slot, or else by one behind it
attempt() {
    part=$1 count=$(grep -c . "$3")
    for k in $(seq "$2" $(($2 + count - 1))); do
        host=$(grep . "$3" | sed -n "$(((k - 1) % count + 1))p")
        # shellcheck disable=SC2086 # words
        case $host in
        :) part "$part" env && return ;;
        *) part "$part" ${SSH:-ssh -o BatchMode=yes -o ConnectTimeout=9} \
            $host && return ;;
        esac
        echo "parallel.sh: part $part failed on $host" >&2
    done
    return 3
}

. "$(dirname "$0")/parts.sh"
case ${1-} in
-h | --help) usage; exit 0 ;;
--part) # I SLOT HOSTS ..
    number=$2 slot=$3 hosts=$4
    shift 4
    begin "$@" && attempt "$number" "$slot" "$hosts"
    exit ;;
esac
hosts=${1-}
shift $(($# > 0))
begin "$@"
grep -q . "$hosts" || fail 1 "'$hosts': expected a file that names machines"
missing | parallel --will-cite -q -j "$(grep -c . "$hosts")" \
    --halt soon,fail=1 "$0" --part {} {%} "$hosts" "$@"
finish
