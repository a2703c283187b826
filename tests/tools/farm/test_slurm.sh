#!/bin/sh
# test_slurm.sh - parts of a picture as a Slurm job array: a task dies
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/farm/test_slurm.sh [BUILD]
# Example: tests/tools/farm/test_slurm.sh build
#
# A cluster of one node, this machine: slurmctld and slurmd of our own on high
# ports, without munge, cgroups or systemd, all of it in the test's folder.

suite=tools/slurm
. tests/tools/farm/farm.sh
PATH=$PATH:/usr/sbin

stop() {
    # shellcheck disable=SC2086 # numbers
    [ -z "$daemons" ] || kill $daemons 2>/dev/null
    wait # they write until they end
    rm -rf "$spool"
}

daemons=
node=$(uname -n | cut -d . -f 1)
mkdir state
# Sockets lie there, whose names may not be long.
spool=$(mktemp -d /tmp/slurm.XXXXXX) || exit 3
# start PORT: true when the node is ready
start() {
    cat >slurm.conf <<END
ClusterName=qlux
SlurmctldHost=$node(127.0.0.1)
SlurmctldPort=$1
SlurmdPort=$(($1 + 1))
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/none
CredType=cred/none
StateSaveLocation=$work/state
SlurmdSpoolDir=$spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1,batch_sched_delay=0
NodeName=$node NodeAddr=127.0.0.1 CPUs=2
PartitionName=all Nodes=ALL Default=YES
END
    slurmctld -D >slurmctld.log 2>&1 &
    daemons=$!
    slurmd -D -N "$node" >slurmd.log 2>&1 &
    daemons="$daemons $!"
    for _ in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15; do
        sinfo -h -o %t 2>/dev/null | grep -q idle && return
        # shellcheck disable=SC2086 # numbers
        kill -0 $daemons 2>/dev/null || return
        sleep 1
    done
    return 1
}

export SLURM_CONF="$work/slurm.conf"
for try in 1 2 3 4 5; do
    start $((20000 + ($$ * 7 + try * 1001) % 40000)) && break
    # shellcheck disable=SC2086 # numbers
    kill $daemons 2>/dev/null
    wait
done
sinfo -h -o %t 2>/dev/null | grep -q idle
say a_cluster_of_one_node_is_up $?
if [ $failures -ne 0 ]; then
    tail -n 5 slurmctld.log slurmd.log
    exit 1
fi
check "$farm/slurm.sh"
[ -e many.png.parts/0.log ]
say tasks_leave_what_they_said $?

exit $((failures != 0))
