#!/bin/sh
# setup.sh - install the compilers and emulators that the tests need
# SPDX-License-Identifier: MIT

usage() {
    cat <<'END'
usage: tools/dev/setup.sh [--check]
Install, with apt, what "make test" needs and this machine lacks; says what it
installs. The renderer, the simulator and the tools need none of it: only a C
compiler and make.

  --check       install nothing; if something is missing, exit 1 and print the
                command
  NO_INSTALL=1  the same, from the environment

Example: NO_INSTALL=1 tools/dev/setup.sh
END
}

# Program or file that shows a package is there, and the package.
needs='
arm-none-eabi-gcc                                  gcc-arm-none-eabi
riscv64-unknown-elf-gcc                            gcc-riscv64-unknown-elf
avr-gcc                                            gcc-avr
/usr/lib/avr/include/avr/io.h                      avr-libc
powerpc-linux-gnu-gcc-12                           gcc-12-powerpc-linux-gnu
/usr/powerpc-linux-gnu/include/stdio.h             libc6-dev-powerpc-cross
/usr/lib/gcc/x86_64-linux-gnu/12/32/libgcc.a       gcc-12-multilib
qemu-system-arm                                    qemu-system-arm
qemu-system-riscv32                                qemu-system-misc
qemu-ppc                                           qemu-user
clang                                              clang
/usr/lib/llvm-14/lib/clang/*/lib/linux/*asan-x86_64.a  libclang-rt-14-dev
clang-format                                       clang-format
valgrind                                           valgrind
'

present() {
    if [ "${1#/}" = "$1" ]; then
        command -v "$1" >/dev/null 2>&1
    else
        # shellcheck disable=SC2086 # the path may be a pattern
        ls $1 >/dev/null 2>&1
    fi
}

check=${NO_INSTALL:+1}
case ${1-} in
'') ;;
--help) usage; exit 0 ;;
--check) check=1 ;;
*) usage >&2; exit 1 ;;
esac

# The 32-bit x86 compiler exists on x86-64 only.
missing=
packages=
while read -r program package; do
    case $package in
    '') continue ;;
    gcc-12-multilib | libclang-rt-14-dev)
        [ "$(uname -m)" = x86_64 ] || continue ;;
    esac
    if ! present "$program"; then
        missing="$missing $program"
        packages="$packages $package"
    fi
done <<END
$needs
END

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
install="${sudo}apt-get install -y --no-install-recommends$packages"
if [ -n "$check" ]; then
    echo "setup.sh: the tests need$missing; install them with" >&2
    echo "    $install" >&2
    exit 1
fi
if [ -n "$sudo" ] && ! command -v sudo >/dev/null 2>&1; then
    echo "setup.sh: not root, and no sudo; as root, run" >&2
    echo "    ${install#sudo }" >&2
    exit 1
fi

echo "setup.sh: installing$packages"
# shellcheck disable=SC2086 # several words
${sudo}apt-get update -q &&
    DEBIAN_FRONTEND=noninteractive $install && exit 0
echo "setup.sh: installing failed: $install" >&2
exit 3
