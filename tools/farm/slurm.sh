#!/bin/sh
# slurm.sh - render a picture on a cluster: a Slurm job array
# SPDX-License-Identifier: MIT

usage() {
    cat <<'END'
usage: tools/farm/slurm.sh PARTS OUT SCENE.qlb --size WxH [OPTION...]
Render a picture in PARTS bands of rows, each a task of a job array, wait for
them, and add them up into OUT (.png, .ppm, .pfm): the bits of one machine.
Tasks that failed are submitted again while others succeed.

  PARTS    at most the cluster's MaxArraySize - 1, which is 1000 by default
  OPTION   of qlux-sim, except --rows, -o and --save-sums

OUT.parts, in a folder that all nodes share, has the parts, each there only when
it is complete, and what tasks said (*.log). If anything was stopped, the same
command goes on: what is there is not rendered again.

Environment:
  SIM, MERGE  the programs, if not qlux-sim (on all nodes) and qlux-merge
  SBATCH_*    as sbatch has them: SBATCH_PARTITION, SBATCH_TIMELIMIT ..

Example: SBATCH_TIMELIMIT=60 tools/farm/slurm.sh 500 large.png room.qlb \
             --size 16384x16384 --spp 256
END
}

# Each argument as a word for a shell.
quote() {
    for word; do
        printf "'%s' " "$(printf %s "$word" | sed "s/'/'\\\\''/g")"
    done
}

# Until nothing of the job is left. That the controller is away is a line too.
await() {
    nap=1
    until squeue -h -j "$1" 2>&1 |
        awk '!/Invalid job/ { left = 1 } END { exit left }'; do
        sleep $nap
        nap=$((nap < 10 ? nap + 1 : 10))
    done
}

. "$(dirname "$0")/parts.sh"
case ${1-} in
-h | --help) usage; exit 0 ;;
--part) shift && begin "$@" && part "$SLURM_ARRAY_TASK_ID" env; exit ;;
esac
begin "$@"
before=
while left=$(missing | paste -s -d , -) && [ "$left" != "$before" ]; do
    before=$left
    job=$(sbatch --parsable --array="$left" --output="$folder/%a.log" \
        --wrap "$(quote "$0" --part "$@")") || exit 3
    await "${job%%;*}"
done
finish
