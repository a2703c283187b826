# check.awk - is every possible pair or triple of gates in some row?
# SPDX-License-Identifier: MIT
#
# usage: awk -v strength=2 -f check.awk gates.txt rows
#
# Shares nothing with cover.awk. Which tuples are possible it finds by trying
# every combination of the gates that exclude each other. The last line is
# "N rows N covered N excluded N missing N wrong"; before it what is amiss.

FNR == NR {
    if ($1 == "gate") {
        gate[++n] = $2
        for (k = 3; k <= NF; k++) {
            value[n, k - 2] = $2 "=" $k
            known[$2 "=" $k] = 1
        }
        values[n] = NF - 2
    } else if ($1 == "never") {
        sub(/^never +/, "")
        rule[++rules] = $0
        for (k = 1; k <= NF; k++) {
            split($k, part, "=")
            named[part[1]] = 1
        }
    }
    next
}

NF > 0 {
    rows++
    text = " " $0 " "
    bad = NF != n || forbidden(text)
    for (k = 1; k <= NF; k++) {
        bad = bad || !($k in known)
    }
    for (k = 1; k <= n; k++) {
        bad = bad || index(text, " " gate[k] "=") == 0
    }
    for (r = 1; r < rows; r++) {
        bad = bad || line[r] == text
    }
    line[rows] = text
    if (bad) {
        wrong++
        print "not a row of its own: " $0
    }
    note("seen", 1, 0, "")
}

function forbidden(text,    r, k, m, part)
{
    for (r = 1; r <= rules; r++) {
        m = split(rule[r], part, " ")
        for (k = 1; k <= m && index(text, " " part[k] " "); k++) {
        }
        if (k > m) {
            return 1
        }
    }
    return 0
}

# Every tuple of text, a row: "seen" those of all gates, else up to strength of
# those that exclude each other.
function note(what, g, depth, key,    v)
{
    if (what != "seen" || depth == strength) {
        mark[what key] = 1
    }
    for (; depth < strength && g <= n; g++) {
        for (v = 1; v <= values[g]; v++) {
            if (index(text, " " value[g, v] " ")) {
                note(what, g + 1, depth + 1, key " " value[g, v])
            }
        }
    }
}

function combinations(g, so_far,    v)
{
    if (g > n) {
        text = so_far " "
        if (!forbidden(text)) {
            note("may", 1, 0, "")
        }
        return
    }
    if (!(gate[g] in named)) {
        combinations(g + 1, so_far)
        return
    }
    for (v = 1; v <= values[g]; v++) {
        combinations(g + 1, so_far " " value[g, v])
    }
}

function require(g, depth, key, bound,    v)
{
    if (depth == strength) {
        if (("seen" key) in mark) {
            covered++
            wrong += !(("may" bound) in mark)
        } else if (("may" bound) in mark) {
            missing++
            print "in no row:" key
        } else {
            excluded++
        }
        return
    }
    for (; g <= n; g++) {
        for (v = 1; v <= values[g]; v++) {
            require(g + 1, depth + 1, key " " value[g, v],
                bound (gate[g] in named ? " " value[g, v] : ""))
        }
    }
}

END {
    combinations(1, "")
    require(1, 0, "", "")
    printf "%d rows %d covered %d excluded %d missing %d wrong\n", rows,
        covered, excluded, missing, wrong
}
