# cover.awk - a covering array of the gates: every pair or triple in some row
# SPDX-License-Identifier: MIT
#
# usage: awk -v strength=2 -f cover.awk gates.txt
#
# Prints a row a line, NAME=VALUE for every gate. Each row begins with a tuple
# that no row has yet; then gate by gate, in an order drawn, takes the value
# that completes most new tuples and can still become a row. Of several such
# rows the best is kept. That is AETG (Cohen, Dalal, Fredman, Patton: IEEE TSE
# 23, 1997). Of pairs, one row after the other is then taken away, and entries
# of the others are changed until nothing is missing, or it seems in vain.
# Random numbers are fixed: the same list gives the same rows.

$1 == "gate" {
    name[++gates] = $2
    for (k = 3; k <= NF; k++) {
        gate_of[++literals] = gates
        text[literals] = $2 "=" $k
        number[$2 "=" $k] = literals
    }
    first[gates] = literals - NF + 3
    last[gates] = literals
}

$1 == "never" {
    nevers++
    for (k = 2; k <= NF; k++) {
        never[nevers, k - 1] = number[$k]
        bound[gate_of[number[$k]]] = 1
    }
    size[nevers] = NF - 1
}

# row[g] is a literal or 0; could some row have these?
function refused(    k, i)
{
    for (k = 1; k <= nevers; k++) {
        for (i = 1; i <= size[k]; i++) {
            if (row[gate_of[never[k, i]]] != never[k, i]) {
                break
            }
        }
        if (i > size[k]) {
            return 1
        }
    }
    return 0
}

function possible(g,    l)
{
    if (refused()) {
        return 0
    }
    while (g <= gates && (row[g] || !bound[g])) {
        g++
    }
    if (g > gates) {
        return 1
    }
    for (l = first[g]; l <= last[g]; l++) {
        row[g] = l
        if (possible(g + 1)) {
            row[g] = 0
            return 1
        }
    }
    row[g] = 0
    return 0
}

# Tuples are numbers: their literals in order, as digits.
function tuples_from(g, depth, key,    l)
{
    if (depth == strength) {
        if (possible(1)) {
            list[++tuples] = key
            open[key] = 1
        }
        return
    }
    for (; g <= gates - (strength - depth - 1); g++) {
        for (l = first[g]; l <= last[g]; l++) {
            row[g] = l
            tuples_from(g + 1, depth + 1, key * 1000 + l)
        }
        row[g] = 0
    }
}

# Open tuples of literal l with what the row has.
function count(l,    n, i, j, key, a)
{
    n = 0
    a = gate_of[l]
    for (i = 1; i <= gates; i++) {
        if (!row[i] || i == a) {
            continue
        }
        if (strength == 2) {
            n += (i < a ? row[i] * 1000 + l : l * 1000 + row[i]) in open
            continue
        }
        for (j = i + 1; j <= gates; j++) {
            if (!row[j] || j == a) {
                continue
            }
            key = a < i ? (l * 1000 + row[i]) * 1000 + row[j] : a < j \
                ? (row[i] * 1000 + l) * 1000 + row[j] \
                : (row[i] * 1000 + row[j]) * 1000 + l
            n += key in open
        }
    }
    return n
}

function draw(below)
{
    seed = seed * 16807 % 2147483647
    return int(seed / 2147483647 * below)
}

# Fill the row in an order drawn; returns how many new tuples it has.
function fill(    order, i, k, g, l, n, best, choice, gain)
{
    gain = 0
    for (i = 1; i <= gates; i++) {
        order[i] = i
    }
    for (i = gates; i > 1; i--) {
        k = 1 + draw(i)
        g = order[k]
        order[k] = order[i]
        order[i] = g
    }
    for (i = 1; i <= gates; i++) {
        g = order[i]
        if (row[g]) {
            continue
        }
        best = -1
        for (l = first[g]; l <= last[g]; l++) {
            n = count(l)
            row[g] = l
            if (possible(1) &&
                (n > best || (n == best && used[l] < used[choice]))) {
                best = n
                choice = l
            }
            row[g] = 0
        }
        row[g] = choice
        gain += best
    }
    return gain
}

# The row's tuples are no longer open.
function close_from(g, depth, key)
{
    if (depth == strength) {
        delete open[key]
        return
    }
    for (; g <= gates - (strength - depth - 1); g++) {
        close_from(g + 1, depth + 1, key * 1000 + row[g])
    }
}

function begin_with(key,    g, l)
{
    for (g = 1; g <= gates; g++) {
        row[g] = 0
    }
    for (; key > 0; key = int(key / 1000)) {
        l = key % 1000
        row[gate_of[l]] = l
    }
}


# ---- Fewer rows: of pairs only ----

function pair(a, b)
{
    return a < b ? a * 1000 + b : b * 1000 + a
}

# Row r takes or loses literal l: how many open pairs more?
function change(r, l, by,    h, g, key, n)
{
    n = 0
    g = gate_of[l]
    for (h = 1; h <= gates; h++) {
        if (h != g) {
            key = pair(l, at[r, h])
            cover[key] += by
            n += by < 0 ? cover[key] == 0 : -(cover[key] == 1)
        }
    }
    return n
}

function set(r, l,    n)
{
    n = change(r, at[r, gate_of[l]], -1)
    at[r, gate_of[l]] = l
    return n + change(r, l, 1)
}

function row_refused(r,    g)
{
    for (g = 1; g <= gates; g++) {
        row[g] = at[r, g]
    }
    return refused()
}

function an_open_pair(    i, from)
{
    from = draw(tuples)
    for (i = 0; i < tuples; i++) {
        if (cover[list[1 + (from + i) % tuples]] == 0) {
            return list[1 + (from + i) % tuples]
        }
    }
    return 0
}

# Do without row r: enter open pairs into the others until there is none. A
# change that opens more than it closes is seldom kept.
function without(r, moves,    g, h, key, a, b, old_a, old_b, left, n)
{
    left = 0
    for (g = 1; g <= gates; g++) {
        for (h = g + 1; h <= gates; h++) {
            left += --cover[pair(at[r, g], at[r, h])] == 0
        }
    }
    for (g = 1; g <= gates; g++) {
        at[r, g] = at[rows, g]
    }
    rows--
    for (; moves > 0 && left > 0; moves--) {
        key = an_open_pair()
        a = int(key / 1000)
        b = key % 1000
        r = 1 + draw(rows)
        old_a = at[r, gate_of[a]]
        old_b = at[r, gate_of[b]]
        n = set(r, a) + set(r, b)
        if ((n <= 0 || draw(1000) < 40 / (n * n)) && !row_refused(r)) {
            left += n
        } else {
            set(r, old_a)
            set(r, old_b)
        }
    }
    return left == 0
}

# There are no fewer rows than pairs of values of some two gates.
function fewest(    g, h, n, most)
{
    most = 0
    for (g = 1; g <= gates; g++) {
        for (h = 1; h < g; h++) {
            n = (last[g] - first[g] + 1) * (last[h] - first[h] + 1)
            most = n > most ? n : most
        }
    }
    return most
}

function reduce(    r, g, h, kept, keep)
{
    for (r = 1; r <= rows; r++) {
        for (g = 1; g <= gates; g++) {
            for (h = g + 1; h <= gates; h++) {
                cover[pair(at[r, g], at[r, h])]++
            }
        }
    }
    do {
        kept = rows
        for (r = 1; r <= rows; r++) {
            for (g = 1; g <= gates; g++) {
                keep[r, g] = at[r, g]
            }
        }
    } while (rows > fewest() && without(1 + draw(rows), 20000))
    rows = kept
    for (r = 1; r <= rows; r++) {
        for (g = 1; g <= gates; g++) {
            at[r, g] = keep[r, g]
        }
    }
}

# A row that has this tuple, and many others that are open.
function add_row(key,    g, try, gain, best, best_row)
{
    best = -1
    for (try = 1; try <= 5; try++) {
        begin_with(key)
        gain = fill()
        if (gain > best) {
            best = gain
            for (g = 1; g <= gates; g++) {
                best_row[g] = row[g]
            }
        }
    }
    rows++
    for (g = 1; g <= gates; g++) {
        at[rows, g] = row[g] = best_row[g]
        used[row[g]]++
    }
    close_from(1, 0, 0)
}

END {
    seed = strength == 2 ? 23 : 13 # of some primes, those of fewest rows
    tuples_from(1, 0, 0)
    for (i = 1; i <= tuples; i++) {
        if (list[i] in open) {
            add_row(list[i])
        }
    }
    if (strength == 2) {
        reduce()
    }
    for (r = 1; r <= rows; r++) {
        line = ""
        for (g = 1; g <= gates; g++) {
            line = line (g > 1 ? " " : "") text[at[r, g]]
        }
        print line
    }
}
