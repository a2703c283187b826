#!/bin/sh
# test_run.sh - whatever a job does, it gets its line and the others run
# SPDX-License-Identifier: MIT
#
# usage: tests/tools/dev/test_run.sh
#
# Example: tests/tools/dev/test_run.sh

set -u
suite=tools/test_run
. tests/support/claims.sh
work=$(mktemp -d) || exit 3
trap 'rm -rf "$work"' EXIT
folder="$work/a folder"
mkdir "$folder"
unset JOB_CPU JOB_IDLE

# run OPTION...: the jobs on standard input; leaves what was said and $status
run()
{
    cat > "$folder/jobs"
    BUILD=$folder tests/run.sh "$@" "$folder/jobs" > "$work/said" 2>&1
    status=$?
}

# said LINE: a line, with whatever blanks are between its words
said()
{
    tr -s ' ' < "$work/said" | grep -qxF -- "$1"
}

# says CLAIM LINE
says()
{
    said "$2"
    say "$1" $?
}

# gone NUMBER...: are these processes no more, or about to be buried?
gone()
{
    for pid in "$@"; do
        ! state=$(sed 's/.*) //' "/proc/$pid/stat" 2> /dev/null) ||
            [ "${state%% *}" = Z ] || return 1
    done
}

# ---- what never ends, having written a claim that holds

export JOB_CPU=1
run << 'END'
burns/one|echo a burns_alone ok; while :; do :; done
burns/tree|echo a burns_in_children ok; while :; do seq 99999 | sort; done
ends/last|echo a comes_after ok
END
cpu='ends_by_itself FAIL ended after 1 s of processor time'
says a_program_that_computes_for_ever_is_ended "burns/one $cpu"
says so_is_a_script_that_does_by_its_children "burns/tree $cpu"
said 'a comes_after ok' && said '3 passed, 2 failed' && [ "$status" -ne 0 ]
say the_others_run_and_all_are_counted $?

unset JOB_CPU
export JOB_IDLE=3
cat > "$work/children" << END
sleep 1000 & echo \$! > '$work/left'
setsid sleep 1000 & echo \$! >> '$work/left'
END
run << END
sleeps|echo a sleeps ok; sleep 1000
polls|echo a polls ok; while :; do sleep 0.5; done
blocks|mkfifo '$work/pipe'; echo a blocks ok; exec cat '$work/pipe'
keeps children|echo a keeps ok; . '$work/children'; sleep 1000
ends/last|echo a comes_after ok
END
unset JOB_IDLE
idle='ends_by_itself FAIL ended after 3 s of waiting'
says a_job_that_sleeps_is_ended "sleeps $idle"
says a_job_that_only_looks_again_and_again_is_ended "polls $idle"
says a_job_that_waits_for_a_pipe_is_ended "blocks $idle"
says a_job_with_a_blank_in_its_name_has_one_word_in_its_line \
    "keeps_children $idle"
# shellcheck disable=SC2046 # several words
[ "$(wc -l < "$work/left")" -eq 2 ] && gone $(cat "$work/left")
say what_an_ended_job_started_ends_with_it $?
said 'a comes_after ok' && said '5 passed, 4 failed' && [ "$status" -ne 0 ]
say the_others_run_then_and_are_counted_too $?

# ---- what ends badly

run << END
dies|echo a dies ok; printf 'half a line'; kill -SEGV \$\$
fails|echo a fails ok; exit 7
tells|echo a tells FAIL it; exit 1
silent|echo nothing of note
stops us|exit 255
a/b|echo same a ok
a b|echo leaves a ok; sleep 1000 & echo \$! > '$work/left'
END
says a_job_that_dies_by_a_signal_is_a_failure \
    'dies exits_with_success FAIL signal SEGV'
says a_status_is_a_failure 'fails exits_with_success FAIL status 7'
says a_status_that_ends_xargs_is_a_failure_too \
    'stops_us exits_with_success FAIL status 255'
says no_claim_is_a_failure 'silent claims_something FAIL it printed no claim'
! grep -q '^tells .*FAIL' "$work/said"
say a_failure_that_is_told_counts_once $?
gone "$(cat "$work/left")"
say children_that_outlive_their_job_are_ended $?
said '4 passed, 5 failed' && [ "$status" -ne 0 ]
say names_that_differ_by_a_stroke_are_two_jobs $?
run << 'END'
a/b|echo one a ok
a_b|echo two a ok
END
said ' run every_job_ran FAIL 1 of 2' && [ "$status" -ne 0 ]
say jobs_that_share_a_log_do_not_pass $?
run < /dev/null
said '0 passed, 0 failed' && [ "$status" -ne 0 ]
say no_job_at_all_does_not_pass $?

# ---- what a job sees

run << 'END'
world|echo world "$LC_ALL,$TZ,$(umask)" ok; touch "$TMPDIR/left"
input|read line || echo input has_none ok
interrupt|sh -c 'kill -INT $$'; [ $? -eq 130 ] && echo interrupt ends_one ok
END
(
    umask 077
    export LC_ALL=C.UTF-8 TZ=Pacific/Kiritimati CDPATH=/
    BUILD=$folder tests/run.sh "$folder/jobs"
) > "$work/said" 2>&1
status=$?
says locale_time_zone_and_umask_are_the_same_for_all 'world C,UTC,0022 ok'
said 'input has_none ok' && said 'interrupt ends_one ok' &&
    said '3 passed, 0 failed' && [ $status -eq 0 ]
say a_run_without_a_failure_says_so_and_succeeds $?
[ "$(ls "$folder/test" | paste -s -d ' ' -)" = 'log log.cost' ]
say nothing_but_logs_and_what_they_cost_is_left $?
[ "$(cut -d ' ' -f 1,3 "$folder/test/log.cost" | sort | paste -s -d , -)" = \
    'input 1,interrupt 1,world 1' ]
say the_claims_of_every_job_are_counted_beside_its_seconds $?
printf '%s 4.25 %s\n' fine/unit/a 12 fine/unit/b 3 lint/x 5 new/part 1 \
    > "$folder/test/log.cost"
printf '%s\n' '0m0.1s 0m0.1s' '1m40.5s 0m19.5s' > "$folder/test/make.times"
BUILD=$folder tests/cost.sh > "$work/said" &&
    said '| arithmetic and structures keep their bounds | 2 | 15 | 8 |' &&
    said '| built before: programs, tests | | | 103 |' &&
    said '| other | 1 | 1 | 4 |' && said '| all | 4 | 21 | 120 |'
say costs_are_added_part_by_part $?
rm "$folder/test/make.times"

# ---- being ended

cat > "$folder/jobs" << END
first|echo \$\$ > '$work/left'; sleep 1000
second|echo second is_never_reached ok
END
rm -f "$work/left"
BUILD=$folder setsid tests/run.sh "$folder/jobs" > "$work/said" 2>&1 &
run=$!
while [ ! -s "$work/left" ] && kill -0 $run; do sleep 0.2; done
kill -s TERM -- "-$run"
wait $run
for _ in 1 2 3 4 5 6 7 8 9 10; do
    gone "$(cat "$work/left")" && break
    sleep 0.5
done
gone "$(cat "$work/left")"
say a_run_that_is_ended_takes_its_jobs_along $?

# ---- order

# One at a time, so that what is printed is the order in which they ran.
mkdir "$work/bin"
printf '#!/bin/sh\n[ "$1" = CLK_TCK ] && echo 100 || echo 1\n' \
    > "$work/bin/getconf"
chmod +x "$work/bin/getconf"
orders()
{
    for seed in "$@"; do
        seq 1 9 | sed 's/.*/&|echo order & ok/' |
            PATH="$work/bin:$PATH" run ${seed:+--shuffle "$seed"}
        said '9 passed, 0 failed' || echo lost
        sed -n 's/^\([0-9]*\)  (.* s)$/\1/p' "$work/said" | paste -s -d ' ' -
    done
}
[ "$(orders '')" = '1 2 3 4 5 6 7 8 9' ]
say jobs_begin_in_their_order $?
[ "$(orders 1 1 2 2 '' | uniq | wc -l)" -eq 3 ]
say a_seed_gives_an_order_of_its_own_and_all_run $?

exit $((failures > 0))
