# shrink.awk - variance against solid angle, log-log: what shrink.sh measured
# SPDX-License-Identifier: MIT
#
# usage: awk -f tools/sheet/shrink.awk TABLE.csv >DRAWING.svg
#
# Lines of the table: side,solid_angle,strategy,directions,expected,measured.
# What is expected is a line, what was measured a dot.

BEGIN {
    FS = ","
    left = 70
    top = 40
    width = 520
    height = 420
    x_low = -3
    x_high = 0.6
    y_low = -8
    y_high = 5
    colours = "#d62728 #ff9896 #ff7f0e #1f77b4 #2ca02c #9467bd"
}

function log10(x)
{
    return log(x) / log(10)
}

function x_of(angle)
{
    return left + width * (log10(angle) - x_low) / (x_high - x_low)
}

function y_of(variance)
{
    return top + height * (y_high - log10(variance)) / (y_high - y_low)
}

function line(x0, y0, x1, y1)
{
    printf "<path d=\"M%.1f %.1fL%.1f %.1f\" stroke=\"#ddd\"/>\n", x0, y0,
        x1, y1
}

function text(x, y, anchor, colour, words)
{
    printf "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" fill=\"%s\">%s" \
        "</text>\n", x, y, anchor, colour, words
}

# 10 to a whole power, raised.
function power(n)
{
    return "10<tspan dy=\"-5\" font-size=\"9\">" n "</tspan>"
}

FNR > 1 {
    name = $3 ($4 > 1 ? ", " $4 " rays" : "")
    if (!(name in count))
        names[++series] = name
    n = ++count[name]
    x[name, n] = x_of($2)
    line_y[name, n] = y_of($5)
    dot_y[name, n] = y_of($6)
}

END {
    split(colours, colour, " ")
    printf "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" " \
        "height=\"%d\" font-family=\"sans-serif\" font-size=\"12\" " \
        "fill=\"none\">\n<rect width=\"100%%\" height=\"100%%\" " \
        "fill=\"#fff\"/>\n", left + width + 190, top + height + 60
    for (k = y_low; k <= y_high; k++) {
        line(left, y_of(10 ^ k), left + width, y_of(10 ^ k))
        text(left - 8, y_of(10 ^ k) + 4, "end", "#333", power(k))
    }
    for (k = x_low; k <= x_high; k++) {
        line(x_of(10 ^ k), top, x_of(10 ^ k), top + height)
        text(x_of(10 ^ k), top + height + 18, "middle", "#333", power(k))
    }
    printf "<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" " \
        "stroke=\"#888\"/>\n", left, top, width, height
    text(left, top - 14, "start", "#000", \
        "variance of a sample over its squared mean, as a square light shrinks")
    text(left + width / 2, top + height + 40, "middle", "#333", \
        "solid angle of the light in sr; lines: quadrature, dots: qlux-sim")
    for (s = 1; s <= series; s++) {
        name = names[s]
        printf "<path d=\""
        for (i = 1; i <= count[name]; i++)
            printf("%s%.1f %.1f", i > 1 ? "L" : "M", x[name, i], \
                line_y[name, i])
        printf "\" stroke=\"%s\" stroke-width=\"1.6\"/>\n", colour[s]
        for (i = 1; i <= count[name]; i++)
            printf "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3.4\" " \
                "fill=\"%s\"/>\n", \
                x[name, i], dot_y[name, i], colour[s]
        y = top + 12 + 20 * (s - 1)
        printf "<path d=\"M%d %dh22\" stroke=\"%s\" stroke-width=\"1.6\"/>\n", \
            left + width + 16, y, colour[s]
        text(left + width + 44, y + 4, "start", "#333", name)
    }
    print "</svg>"
}
