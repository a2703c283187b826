#!/bin/sh
# strategies.sh - compare the ways of finding light: noise, cost, a picture
# SPDX-License-Identifier: MIT

usage() {
    cat <<'END2'
usage: tools/sheet/strategies.sh [options]

Render a scene under every direct strategy with equally many samples and print
a table "strategy variance instructions variance*instructions"; the pictures
with these figures below them go to build/strategies.png.

  --scene FILE         a .scene           tests/scenes/strategies.scene
  --size WxH           pixels             the scene's own
  --spp N              samples a pixel    64
  --reference-spp N    of the reference   4096
  --bounces N          indirect reflections    0: only direct light
  --sampler S          random or sobol    random
  --strategies LIST    "hemisphere cosine area solid-angle mis"
  -o FILE              the picture        build/strategies.png

The variance is that of one sample, mean over pixels and channels: mse * spp,
the mse being the square of qlux-diff's rmse of linear radiance against the
reference. The reference is the area strategy with Sobol points; it is kept in
build/ until the scene, the simulator or its options change; its own error adds
less than the variance of area times spp / reference-spp. Edges of what the
camera sees add the same to every strategy. With --sampler sobol mse * spp is
less than the variance and falls as spp grows.

Instructions are those of a mean path on an emulated Cortex-M3, counted by make
bench-strategies; without cross compiler or emulator rays are counted instead.
The less variance * instructions, the less work for the same noise.

Example: tools/sheet/strategies.sh --spp 16 --bounces 2
END2
}

scene=tests/scenes/strategies.scene
size='' spp=64 reference_spp=4096 bounces=0 sampler=random
strategies='hemisphere cosine area solid-angle mis'
build=${BUILD:-build}
out=$build/strategies.png

fail() { # code, message
    echo "strategies.sh: $2" >&2
    exit "$1"
}

while [ $# -gt 0 ]; do
    option=$1
    case $option in
    --help) usage; exit 0 ;;
    -*) [ $# -ge 2 ] || fail 1 "'$option': unknown, or its value is missing" ;;
    esac
    case $option in
    --scene) scene=$2 ;;
    --size) size=$2 ;;
    --spp) spp=$2 ;;
    --reference-spp) reference_spp=$2 ;;
    --bounces) bounces=$2 ;;
    --sampler) sampler=$2 ;;
    --strategies) strategies=$2 ;;
    -o) out=$2 ;;
    *) fail 1 "unknown option '$option' (see --help)" ;;
    esac
    shift 2
done
[ -r "$scene" ] || fail 3 "cannot read $scene"

make=${MAKE:-make}
name=$(basename "$scene" .scene)
dir=$build/strategies
mkdir -p "$dir" || exit 3
$make -s --no-print-directory "$build/$name.qlb" \
    "$build/qlux-sim" "$build/qlux-diff" "$build/qlux-merge" \
    "$build/qlux-sheet" SCENE="$scene" >"$dir/make.log" 2>&1 ||
    { cat "$dir/make.log" >&2; exit 2; }
blob=$build/$name.qlb
options="--lights power --bounces $bounces ${size:+--size $size}"

# render NAME OPTIONS...: NAME.png to look at, NAME.pfm to measure
render() {
    picture=$1
    shift
    echo "$name, $picture:" >&2
    # $options is a list
    # shellcheck disable=SC2086
    "$build/qlux-sim" "$blob" -o "$dir/$picture.png" --stats $options "$@" \
        --save-sums "$dir/$picture.qls" >"$dir/$picture.stats" &&
        "$build/qlux-merge" "$dir/$picture.qls" -o "$dir/$picture.pfm" \
            >"$dir/merge.log" || exit
    rm -f "$dir/$picture.qls"
}

key=$(echo "$reference_spp $options" | cat - "$blob" "$build/qlux-sim" | cksum |
    cut -d ' ' -f 1)
reference=reference-$key
if ! [ -s "$dir/$reference.pfm" ]; then
    rm -f "$dir"/reference-*
    render "$reference" --direct area --spp "$reference_spp"
fi

for strategy in $strategies; do
    render "$strategy" --direct "$strategy" --spp "$spp" --sampler "$sampler"
    "$build/qlux-diff" "$dir/$strategy.pfm" "$dir/$reference.pfm" \
        >"$dir/$strategy.diff" || exit
done

# What a path costs, as lines "STRATEGY N".
cost=instructions
if command -v arm-none-eabi-gcc >"$dir/which" &&
        command -v qemu-system-arm >"$dir/which"; then
    echo "$name: counting instructions" >&2
    $make -s --no-print-directory bench-strategies SCENE="$scene" \
        STRATEGY_BOARDS=lm3s6965evb STRATEGY_BOUNCES="$bounces" \
        PRECISIONS=fine >"$dir/rows" 2>"$dir/make.log" ||
        { cat "$dir/rows" "$dir/make.log" >&2; exit 2; }
    sed -n 's/^cortex-m3 fine path-\(.*\): /\1 /p' "$dir/rows" >"$dir/costs"
else
    cost=rays
    for strategy in $strategies; do
        awk -v name="$strategy" '$1 == "rays-per-path:" { print name, $2 }' \
            "$dir/$strategy.stats"
    done >"$dir/costs"
fi

# table.txt for people; labels.txt "STRATEGY TEXT" for the sheet.
for strategy in $strategies; do
    awk -v name="$strategy" '$1 == "rmse:" { print name, $2 }' \
        "$dir/$strategy.diff"
done | awk -v spp="$spp" -v cost="$cost" -v labels="$dir/labels.txt" '
    # Three digits that count, thousands apart.
    function short(x, text, head) {
        if (x < 99.95) return sprintf("%#.3g", x)
        for (text = sprintf("%.0f", x); length(text) > 3; ) {
            head = "," substr(text, length(text) - 2) head
            text = substr(text, 1, length(text) - 3)
        }
        return text head
    }
    FNR == NR { path[$1] = $2; next }
    FNR == 1 {
        form = "%-12s %12s %14s %24s\n"
        printf form, "strategy", "variance", cost, "variance*" cost
    }
    {
        variance = $2 * $2 * spp
        if (!($1 in path)) { bad = 1; exit }
        printf form, $1, short(variance), short(path[$1]),
            short(variance * path[$1])
        printf "%s %s|variance %s|%s %s|product %s\n", $1, $1,
            short(variance), short(path[$1]), cost,
            short(variance * path[$1]) >labels
    }
    END { if (bad) { print "no cost of " $1 >"/dev/stderr"; exit 2 } }
' "$dir/costs" - >"$dir/table.txt" || exit
cat "$dir/table.txt"
echo "# variance = mse * spp, linear radiance against $reference_spp samples"

set --
while read -r strategy label; do
    set -- "$@" "$label=$dir/$strategy.png"
done <"$dir/labels.txt"
"$build/qlux-sheet" -o "$out" --columns 3 \
    --title "Ways of finding light, $spp samples a pixel" \
    --title "$(sed -n '1s/^# *//p' "$scene")" \
    --title "variance of a sample, $cost of a path$([ $cost = rays ] ||
        echo " on a Cortex-M3"), their product" \
    "$@" "reference|area, $reference_spp samples=$dir/$reference.png" || exit
echo "$out" >&2
