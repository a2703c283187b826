#!/bin/sh
# test_panel.sh - the emulated OLED shows exactly the simulator's grey picture
# SPDX-License-Identifier: MIT

usage() {
    cat <<'END'
usage: tests/boards/test_panel.sh ELF GRAY4.ppm
Run a firmware of lm3s6965evb, the one for a real board; take a screen dump,
which magnifies the panel four times; compare every pixel with the picture of
qlux-sim --format gray4.

Example: tests/boards/test_panel.sh build/lm3s6965evb/cornell.elf gray4.ppm
END
}

case ${1-} in
--help) usage; exit 0 ;;
esac
if [ $# -ne 2 ]; then
    usage >&2
    exit 1
fi
build=${BUILD:-build}

dir=$(mktemp -d) || exit 3
trap 'rm -rf "$dir"' EXIT
tests/boards/with_monitor.sh "$1" "$dir/picture.ppm" \
    "screendump \"$dir/panel.ppm\"" qemu-system-arm -M lm3s6965evb || exit

header=$(head -c 15 "$dir/panel.ppm" | tr '\n' ' ')
if [ "$header" != 'P6 512 256 255 ' ]; then
    echo "test_panel.sh: the screen dump begins '$header'" >&2
    exit 1
fi

# pixels FILE HEADER-BYTES: one a line.
pixels() {
    tail -c "+$(($2 + 1))" "$1" | od -An -v -tx1 -w3
}
pixels "$dir/panel.ppm" 15 >"$dir/panel"
pixels "$2" 14 | awk '
    { line = line $0 "\n" $0 "\n" $0 "\n" $0 "\n" }
    NR % 128 == 0 { printf "%s%s%s%s", line, line, line, line; line = "" }
' >"$dir/wanted"
if ! cmp "$dir/wanted" "$dir/panel"; then
    mkdir -p "$build/fail" && cp "$dir/panel.ppm" "$build/fail/panel_actual.ppm"
    echo "test_panel.sh: see $build/fail/panel_actual.ppm" >&2
    exit 1
fi
