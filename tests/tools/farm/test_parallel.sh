#!/bin/sh
# test_parallel.sh - parts of a picture over ssh: a worker and a machine die
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/farm/test_parallel.sh [BUILD]
# Example: tests/tools/farm/test_parallel.sh build
#
# The other machine is this one: an sshd of our own on a high port of 127.0.0.1,
# with keys of its own, which reads no file outside the test's folder.

suite=tools/parallel
. tests/tools/farm/farm.sh

stop() {
    [ -z "$sshd" ] || kill "$sshd"
    [ -z "$run" ] || rmdir "$run"
}

# As root it wants a folder of the system that its package makes at boot.
run=
if [ "$(id -u)" -eq 0 ] && mkdir /run/sshd 2>/dev/null; then
    run=/run/sshd
    chmod 755 $run
fi
for key in host user; do
    ssh-keygen -q -t ed25519 -N '' -f $key || exit 3
done
cp user.pub allowed
cat >sshd.conf <<END
ListenAddress 127.0.0.1
HostKey $work/host
AuthorizedKeysFile $work/allowed
PidFile none
StrictModes no
PermitRootLogin prohibit-password
PasswordAuthentication no
END
sshd=
: >sshd.log
for try in 1 2 3 4 5 6 7 8 9; do
    port=$((20000 + ($$ * 7 + try * 1001) % 40000))
    /usr/sbin/sshd -D -e -f sshd.conf -p $port 2>sshd.log &
    sshd=$!
    until grep -q 'Server listening' sshd.log || ! kill -0 $sshd 2>/dev/null; do
        sleep 0.1
    done
    kill -0 $sshd 2>/dev/null && break
    sshd=
done
echo "[127.0.0.1]:$port $(cut -d ' ' -f 1,2 host.pub)" >known
export SSH="ssh -F none -i $work/user -o BatchMode=yes -o IdentitiesOnly=yes \
-o UserKnownHostsFile=$work/known -o GlobalKnownHostsFile=/dev/null"

# Nobody listens at the first one.
printf '%s\n' '-p 1 127.0.0.1' "-p $port 127.0.0.1" '' : >hosts.txt
check "$farm/parallel.sh" hosts.txt
[ "$(grep -c 'Accepted publickey' sshd.log)" -ge 2 ]
say parts_went_over_ssh $? "$(grep -c 'Accepted publickey' sshd.log) of them"
grep -q 'part 0 failed on -p 1 127' err.txt ||
    "$farm/parallel.sh" hosts.txt 2 dead.png scene.qlb --size 9x3 2>err.txt &&
    grep -q 'part 0 failed on -p 1 127' err.txt
say a_machine_that_is_dead_is_named_and_left_out $?
expect hosts_that_are_none_are_refused 1 "'no.txt': expected a file that " \
    "$farm/parallel.sh" no.txt 2 none.png scene.qlb --size 9x3

exit $((failures != 0))
