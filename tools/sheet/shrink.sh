#!/bin/sh
# shrink.sh - variance of each direct strategy as a light shrinks
# SPDX-License-Identifier: MIT

usage() {
    cat <<'END2'
usage: tools/sheet/shrink.sh [options]

Render one point below a square light with every direct strategy, while the
light shrinks, and print for each the variance of a sample over its squared
mean: what is expected, by quadrature over the square, and what was measured.
The drawing of that table goes to build/shrink.svg, the table beside it.

  --sides LIST         of the light, its height being 1
                       "2 1 0.5 0.25 0.125 0.0625"
  --spp N              samples of each of 128x128 pixels    64
  -o FILE.svg          the drawing, and FILE.csv            build/shrink.svg

All pixels show one point, so the variance of a sample is spp times that of the
pixels. It is known to a part in 60 or so, and to one in sqrt(hits) where few
samples hit the light; below 1e-7 the rounding of sums is seen. One strategy is
there twice, with --light-samples 16 and a sixteenth of the samples.

Example: tools/sheet/shrink.sh --sides "1 0.5"
END2
}

sides='2 1 0.5 0.25 0.125 0.0625' spp=64
build=${BUILD:-build}
out=$build/shrink.svg

fail() { # code, message
    echo "shrink.sh: $2" >&2
    exit "$1"
}

while [ $# -gt 0 ]; do
    option=$1
    case $option in
    --help) usage; exit 0 ;;
    -*) [ $# -ge 2 ] || fail 1 "'$option': unknown, or its value is missing" ;;
    esac
    case $option in
    --sides) sides=$2 ;;
    --spp) spp=$2 ;;
    -o) case $2 in
        *.svg) out=$2 ;;
        *) fail 1 "'-o $2': expected a name that ends in .svg" ;;
        esac ;;
    *) fail 1 "unknown option '$option' (see --help)" ;;
    esac
    shift 2
done

dir=$build/shrink
mkdir -p "$dir" || exit 3

# light SIDE: the point and the light, as a blob. A unit is 4096 grid units.
light() {
    printf 'newmtl floor\nKd 1 1 1\nnewmtl light\nKd 0 0 0\nKe 1 1 1\n' \
        >"$dir/light.mtl"
    awk -v side="$1" 'BEGIN {
        far = 3.995849609375
        print "mtllib light.mtl\nv -4 0 -4\nv -4 0 " far "\nv " far " 0 " far
        print "v " far " 0 -4"
        h = side / 2
        print "v", -h, 1, -h "\nv", h, 1, -h "\nv", h, 1, h "\nv", -h, 1, h
        print "usemtl floor\nf 1 2 3 4\nusemtl light\nf 5 6 7 8" }' \
        >"$dir/light.obj"
    printf 'mesh light.obj\ncamera eye 3 0.5 0 look 0 0 0 fov 0.02\n' \
        >"$dir/light.scene"
    "$build/qlux-scene" "$dir/light.scene" -o "$dir/light.qlb" --quiet || exit
}

# expect SIDE: lines "SOLID_ANGLE STRATEGY VARIANCE/MEAN^2", by midpoints
# on a quarter of the square. g is the cosine density over that of points.
expect() {
    awk -v side="$1" 'BEGIN {
        pi = atan2(0, -1)
        n = 200
        area = side * side
        for (i = 0; i < n; i++)
            for (j = 0; j < n; j++) {
                x = (i + 0.5) / n * side / 2
                y = (j + 0.5) / n * side / 2
                r2 = x * x + y * y + 1
                cosine = 1 / sqrt(r2)
                omega = area / (n * n) * cosine / r2
                g = area * cosine * cosine / (pi * r2)
                s = g / (1 + g)
                angle += omega
                mean += omega * cosine / pi
                hemisphere += 2 / pi * cosine * cosine * omega
                points += g * g / (n * n)
                toward += cosine * cosine * omega / (pi * pi)
                first += s / (n * n)
                first2 += s * s / (n * n)
                second += g * s / (n * n)
                second2 += g * s * s / (n * n)
            }
        square = mean * mean
        print angle, "hemisphere", hemisphere / square - 1
        print angle, "cosine", 1 / mean - 1
        print angle, "area", points / square - 1
        print angle, "solid-angle", angle * toward / square - 1
        print angle, "mis", \
            (first2 - first * first + second2 - second * second) / square
    }'
}

# measure STRATEGY N: the same of what qlux-sim makes, with --light-samples N
measure() {
    samples=$(((spp + $2 - 1) / $2))
    "$build/qlux-sim" "$dir/light.qlb" -o "$dir/light.pfm" --size 128x128 \
        --spp $samples --sampler random --bounces 0 --direct "$1" \
        --lights power --light-samples "$2" --quiet || exit
    tail -c $((128 * 128 * 12)) "$dir/light.pfm" | od -A n -v -t f4 |
        awk -v spp=$samples '
            { for (i = 1; i <= NF; i++) if (k++ % 3 == 0) value[++n] = $i }
            END {
                for (i = 1; i <= n; i++) mean += value[i] / n
                for (i = 1; i <= n; i++) square += (value[i] - mean) ^ 2
                printf "%.5g\n", spp * square / (n - 1) / (mean * mean)
            }'
}

echo side,solid_angle,strategy,samples,expected,measured >"$dir/table.csv"
for side in $sides; do
    light "$side"
    expect "$side" >"$dir/expected"
    while read -r angle strategy variance; do
        for n in 1 16; do
            case $n,$strategy in
            1,* | 16,hemisphere)
                awk -v a="$angle" -v v="$variance" -v n=$n -v of="$side" \
                    -v name="$strategy" -v got="$(measure "$strategy" $n)" '
                    BEGIN { printf "%s,%.5g,%s,%d,%.5g,%s\n",
                        of, a, name, n, v / n, got }' || exit ;;
            esac
        done
    done <"$dir/expected"
done >>"$dir/table.csv" || exit
awk -f tools/sheet/shrink.awk "$dir/table.csv" >"$dir/drawing.svg" &&
    mv "$dir/drawing.svg" "$out" && cp "$dir/table.csv" "${out%.svg}.csv" ||
    exit 3
awk -F, '{ printf "%-7s %-11s %-11s %7s %-11s %s\n", $1, $2, $3, $4, $5, $6 }' \
    "$dir/table.csv"
echo "$out" >&2
