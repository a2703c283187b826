#!/bin/sh
# setup.sh - install the compilers and emulators that the tests need
# SPDX-License-Identifier: MIT

usage() {
    cat <<'END'
usage: tools/dev/setup.sh [--check | --list | --x86]
Install, with apt, what "make test" and "make fuzz" need and this machine lacks;
says what it installs, and afterwards what is missing still. The renderer, the
simulator and the tools need none of it: only a C compiler and make.

  --check       install nothing; if something is missing, exit 1 and print the
                command
  --list        print each package, and what of it the tests call
  --x86         exit 0 if this machine's own compiler makes x86 code, else 1:
                tests of 32-bit x86 then say that they cannot run here
  NO_INSTALL=1  as --check, from the environment

The ssh server and Slurm's are services, which Debian may start when it installs
them; the tests start their own, and only while they run.

Tests have been run on Debian 12, amd64, only. Apt of Debian 13 has been asked,
for amd64 and arm64, and can install all of it together, but for parallel, ssh
and Slurm, of which it has not been asked. Debian 12 on arm64 cannot: it has no
gcc-powerpc-linux-gnu there. Ubuntu 24.04 has not been tried. Sizes and
instructions are compared with those of Debian 12's compilers, so "make bench"
may fail with others.

Example: NO_INSTALL=1 tools/dev/setup.sh
END
}

x86() {
    [ "$(uname -m)" = x86_64 ]
}

# Package, and the program that shows it is there; or a compiler with options
# that then makes a program. A/B: A, or B where apt knows no A. gcc-multilib
# itself cannot be installed beside other cross compilers.
needs() {
    cat <<END
gcc                       gcc
g++                       g++
gcc-arm-none-eabi         arm-none-eabi-gcc
gcc-riscv64-unknown-elf   riscv64-unknown-elf-gcc
gcc-avr                   avr-gcc
avr-libc                  avr-gcc -mmcu=atmega2560 -include avr/io.h
gcc-powerpc-linux-gnu     powerpc-linux-gnu-gcc
libc6-dev-powerpc-cross   powerpc-linux-gnu-gcc -static -include stdio.h
qemu-system-arm           qemu-system-arm
qemu-system-riscv/qemu-system-misc  qemu-system-riscv32
qemu-user                 qemu-ppc
clang                     clang
libclang-rt-dev           clang -fsanitize=fuzzer -Dmain=LLVMFuzzerTestOneInput
clang-format              clang-format
valgrind                  valgrind
parallel                  parallel
openssh-client            ssh
openssh-server            sshd
slurm-client              sinfo
slurmctld                 slurmctld
slurmd                    slurmd
END
    x86 || return 0
    version=$(gcc -dumpversion 2>/dev/null || apt-cache show gcc 2>/dev/null |
        sed -n 's/^Depends:.* gcc-\([0-9]*\) .*/\1/p')
    version=${version%%[!0-9]*}
    echo "gcc${version:+-$version}-multilib  gcc -m32 -include stdio.h"
}

# Services lie beside the programs that users have in PATH.
PATH=$PATH:$(echo "$PATH" | sed 's/bin:/sbin:/g; s/bin$/sbin/')

# present PROGRAM [OPTION...]
present() {
    command -v "$1" >/dev/null 2>&1 || return
    [ $# -eq 1 ] || "$@" "$work/program.c" -o "$work/program" 2>/dev/null
}

known() {
    apt-cache show "$1" 2>/dev/null | grep -q .
}

# look: sets $missing, $packages, and $unknown, those that apt cannot install
look() {
    missing=
    packages=
    unknown=
    while read -r package trial; do
        # shellcheck disable=SC2086 # several words
        if ! present $trial; then
            case $package in
            */*)
                known "${package%/*}" && package=${package%/*}
                package=${package#*/}
                ;;
            esac
            missing="$missing, $trial"
            packages="$packages $package"
            known "$package" || unknown="$unknown $package"
        fi
    done <<END
$(needs)
END
    missing=${missing#,}
}

check=${NO_INSTALL:+1}
case ${1-} in
'') ;;
--help) usage; exit 0 ;;
--check) check=1 ;;
--list)
    needs | while read -r package trial; do
        printf '%-36s %s\n' "$package" "$trial"
    done
    exit 0
    ;;
--x86) x86; exit ;;
*) usage >&2; exit 1 ;;
esac

work=$(mktemp -d) || exit 3
trap 'rm -rf "$work"' EXIT
echo 'int main(void) { return 0; }' >"$work/program.c"

look
if [ -z "$packages" ]; then
    echo "setup.sh: everything that the tests need is installed"
    exit 0
fi
if ! command -v apt-get >/dev/null 2>&1; then
    echo "setup.sh: this is not Debian; install these by hand:$missing" >&2
    exit 1
fi

sudo=
if [ "$(id -u)" -ne 0 ]; then
    sudo='sudo '
fi
install="apt-get install -y --no-install-recommends"
if [ -n "$check" ]; then
    echo "setup.sh: the tests need$missing; install with" >&2
    echo "    $sudo$install$packages" >&2
    exit 1
fi
if [ -n "$sudo" ] && ! command -v sudo >/dev/null 2>&1; then
    echo "setup.sh: not root, and no sudo; as root, run" >&2
    echo "    $install$packages" >&2
    exit 1
fi

# A repository that has nothing to do with this may be broken. What a new system
# calls its packages is known only now.
${sudo}apt-get update -q ||
    echo "setup.sh: apt-get update failed; trying with what apt knows" >&2
look
asked=
for package in $packages; do
    case " $unknown " in
    *" $package "*) ;;
    *) asked="$asked $package" ;;
    esac
done
echo "setup.sh: installing$asked"
# shellcheck disable=SC2086 # several words
${sudo}env DEBIAN_FRONTEND=noninteractive $install $asked
status=$?
look
if [ -n "$packages" ]; then
    echo "setup.sh: still missing:$missing" >&2
    echo "    $sudo$install$packages" >&2
    [ -z "$unknown" ] || echo "    apt has no$unknown" >&2
    [ $status -eq 0 ] || echo "    failed with status $status" >&2
    exit 3
fi
echo "setup.sh: installed$asked"
