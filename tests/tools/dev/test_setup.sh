#!/bin/sh
# test_setup.sh - setup.sh asks apt for what is missing, and looks again
# SPDX-License-Identifier: MIT
#
# usage: tests/tools/dev/test_setup.sh
#
# On machines made up: a folder of programs that pretend, apt and compilers too.
#
# Example: tests/tools/dev/test_setup.sh

set -u
suite=tools/test_setup
. tests/support/claims.sh
unset NO_INSTALL
setup=$(pwd)/tools/dev/setup.sh
work=$(mktemp -d) || exit 3
trap 'rm -rf "$work"' EXIT

# A program that a package brings. Compilers can make nothing without the files
# of another package.
cat > "$work/program" << 'END'
#!/bin/sh
has() { [ -e "$machine/packages/$1" ]; }
case ${0##*/},${1-} in
gcc,-dumpversion) echo "$gcc" ;;
gcc,-m32) has "gcc-${gcc%%.*}-multilib" ;;
avr-gcc,*) has avr-libc ;;
powerpc-linux-gnu-gcc,*) has libc6-dev-powerpc-cross ;;
clang,-fsanitize=fuzzer) has libclang-rt-dev ;;
esac
END

# Its arguments on one line, and what it was told to do.
cat > "$work/apt-get" << 'END'
#!/bin/sh
echo "apt-get $*" >> "$machine/calls"
[ "$1" = install ] || exit "${apt_update:-0}"
for package; do
    case $package in
    install | -* | "${absent:-none}") ;;
    *) bring "$package" ;;
    esac
done
exit "${apt_install:-0}"
END
cat > "$work/bring" << 'END'
#!/bin/sh
for package; do
    touch "$machine/packages/$package"
    "$setup" --list | while read -r names program options; do
        case /$names/,$options in
        */"$package"/*,) cp "$machine/../program" "$machine/bin/$program" ;;
        esac
    done
done
END
cat > "$work/apt-cache" << 'END'
#!/bin/sh
[ -z "${fresh-}" ] || grep -q update "$machine/calls" 2> /dev/null || exit
case $2 in
gcc) echo "Depends: cpp (= 4), gcc-${gcc%%.*} (>= 12.2.0)" ;;
*)
    case " ${apt_lacks-qemu-system-riscv} " in
    *" $2 "*) ;;
    *) echo "Package: $2" ;;
    esac
    ;;
esac
END
printf '#!/bin/sh\necho "$arch"\n' > "$work/uname"
printf '#!/bin/sh\necho "$user"\n' > "$work/id"
printf '#!/bin/sh\necho sudo >> "$machine/calls"\n"$@"\n' > "$work/sudo"
chmod +x "$work"/*

# machine NAME PACKAGE...: a new one, on which these are
machine() {
    export machine="$work/$1" setup gcc=12 arch=x86_64 user=0
    mkdir -p "$machine/bin" "$machine/packages"
    for name in sh sed cat cp grep env mktemp rm touch; do
        ln -s "$(command -v $name)" "$machine/bin"
    done
    for name in apt-get apt-cache bring uname id; do
        cp "$work/$name" "$machine/bin"
    done
    shift
    PATH=$machine/bin bring "$@"
    calls=
}

# sets_up CODE [ARGUMENT...]: leaves what it said, and the calls of apt-get
sets_up() {
    wanted=$1
    shift
    PATH=$machine/bin "$setup" "$@" > "$work/said" 2>&1
    code=$?
    calls=$(cat "$machine/calls" 2> /dev/null)
    [ $code -eq "$wanted" ] || echo "exit $code: $(cat "$work/said")" >&2
    [ $code -eq "$wanted" ]
}

says() {
    grep -qF -- "$1" "$work/said"
}

all='gcc g++ gcc-arm-none-eabi gcc-riscv64-unknown-elf gcc-avr avr-libc
    gcc-powerpc-linux-gnu libc6-dev-powerpc-cross qemu-system-arm
    qemu-system-misc qemu-user clang libclang-rt-dev clang-format valgrind
    gcc-12-multilib parallel openssh-client openssh-server slurm-client
    slurmctld slurmd'
most=$(echo "$all" | sed 's/avr-libc//; s/valgrind//')
get='apt-get install -y --no-install-recommends'
both="apt-get update -q
$get avr-libc valgrind"

# shellcheck disable=SC2086 # lists of packages
{
machine complete $all
sets_up 0 && [ -z "$calls" ] && says 'everything that the tests need'
say a_machine_that_has_all_is_left_alone $?

machine lacking $most
sets_up 0 && [ "$calls" = "$both" ] && says 'installed avr-libc valgrind'
say what_is_missing_is_installed_headers_too $?
sets_up 0 && [ "$calls" = "$both" ]
say the_second_time_there_is_nothing_to_do $?

machine broken $most
apt_update=100 sets_up 0 && [ "$calls" = "$both" ] && says 'update failed'
say a_broken_repository_elsewhere_is_a_warning $?

machine absent $most
absent=valgrind sets_up 3 && says 'still missing: valgrind' &&
    ! says 'missing: avr'
say what_apt_did_not_bring_is_named $?
machine failing $most
absent=valgrind apt_install=100 sets_up 3 && says 'failed with status 100'
say a_failing_installation_is_told $?
machine enough $most
apt_install=100 sets_up 0
say only_what_is_there_in_the_end_counts $?

machine asking $most
NO_INSTALL=1 sets_up 1 && [ -z "$calls" ] &&
    says 'need avr-gcc -mmcu=atmega2560 -include avr/io.h, valgrind;' &&
    says "    $get avr-libc valgrind"
say no_install_prints_the_command_only $?
sets_up 1 --check && [ -z "$calls" ] && says "    $get avr-libc valgrind"
say check_does_the_same $?

machine user $most
user=1000
sets_up 1 && [ -z "$calls" ] && says 'as root, run' && says "    $get avr-libc"
say a_user_without_sudo_is_told_what_root_runs $?
cp "$work/sudo" "$machine/bin"
sets_up 0 && [ "$calls" = "sudo
apt-get update -q
sudo
$get avr-libc valgrind" ]
say a_user_with_sudo_uses_it_for_both_steps $?

machine other
rm "$machine/bin/apt-get"
sets_up 1 && says 'this is not Debian; install these by hand: gcc, g++'
say without_apt_programs_are_named $?

# ---- other systems

packages() { # of what was asked for, a line each
    echo "$calls" | sed -n "s/^$get //p" | tr ' ' '\n'
}

machine bare
gcc=14
sets_up 0 && packages | grep -qx gcc-14-multilib &&
    packages | grep -qx qemu-system-misc
say a_bare_machine_gets_everything $?
[ -z "$(packages | sed 's/^gcc-14-multilib$//; s/riscv64//; s/libc6//' |
    grep '[0-9]')" ]
say only_the_multilib_package_has_the_version_of_gcc $?
machine ubuntu $most valgrind avr-libc
gcc=13.2.0
sets_up 0 && [ "$(packages)" = gcc-13-multilib ]
say it_is_the_version_of_the_gcc_that_is_there $?

machine trixie
gcc=14
apt_lacks= fresh=1 sets_up 0 && packages | grep -qx qemu-system-riscv &&
    ! packages | grep -q misc && packages | grep -qx gcc-14-multilib
say a_name_that_apt_knows_after_its_update_is_preferred $?
machine without $most
apt_lacks='valgrind qemu-system-riscv' sets_up 3 &&
    says 'apt has no valgrind' && [ "$(packages)" = avr-libc ]
say what_apt_lacks_keeps_nothing_else_out $?

machine arm64
arch=aarch64
sets_up 0 && ! packages | grep -q multilib && ! sets_up 0 --x86 2> /dev/null
say another_cpu_is_not_asked_for_x86_code $?
arch=x86_64
sets_up 0 --x86
say an_x86_machine_is $?
}

# ---- and really

trials=$("$setup" --list | awk '{ print $2 }' | sort -u)
unused=$(for program in $trials; do
    [ "$program" = riscv64-unknown-elf-gcc ] && program=riscv64-unknown-elf-
    [ "$program" = arm-none-eabi-gcc ] && program=arm-none-eabi-
    [ "$program" = avr-gcc ] && program=avr-
    grep -rqwe "$program" tests hal --include='*.sh' --include='*.mk' \
        --include=builds.txt ||
        echo "$program"
done)
say_none every_program_asked_for_is_called_by_a_test "$unused"

exit $((failures > 0))
