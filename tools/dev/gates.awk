# gates.awk - which gates settings need, by the list that the core refuses by
# SPDX-License-Identifier: MIT
#
# usage: awk -f tools/dev/gates.awk -f PROGRAM.awk ...
#
# Functions for other programs. gates_read() reads the enums, the numbers and
# the rows of QL_SETTINGS_NEED and QL_SETTINGS_IDLE of
# firmware/base/ql_settings.h, and the pixel formats of ql_format.h;
# gates_set() and gates_need() say what settings need, gates_idle() which have
# no effect.

# solid-angle of QL_DIRECT_: QL_DIRECT_SOLID_ANGLE
function gates_enumerator(prefix, word)
{
    gsub(/-/, "_", word)
    return prefix toupper(word)
}

# QL_DIRECT_SOLID_ANGLE of QL_DIRECT_: solid-angle
function gates_word(prefix, enumerator)
{
    enumerator = tolower(substr(enumerator, length(prefix) + 1))
    gsub(/_/, "-", enumerator)
    return enumerator
}

# Fills gates_number[NAME], gates_words[PREFIX] "none area ..", gates_row[].
function gates_read(    file, line, names, n, i, at, text)
{
    n = split("ql_settings.h ql_format.h", names, " ")
    for (i = 1; i <= n; i++) {
        file = "firmware/base/" names[i]
        while ((getline line < file) > 0) {
            # #define QL_BOUNCES_MAX 64u
            if (line ~ /^#define QL_[A-Z_]+ +[0-9]+u?$/) {
                split(line, text, " ")
                gates_number[text[2]] = text[3] + 0
            }
            #     NEED(ROULETTE, roulette, 1, 1)  \
            if (line ~ /^ +(SET|NEED|BOTH|IDLE)\(/)
                gates_row[++gates_rows] = ""
            if (gates_rows > 0 && gates_row[gates_rows] !~ /\)/) {
                gsub(/[\\ ]/, "", line)
                gates_row[gates_rows] = gates_row[gates_rows] line
                continue
            }
            if (line ~ /^typedef enum/)
                at = 0
            if (line ~ /^}/)
                at = ""
            #     QL_DIRECT_NONE,        /* not at all */
            if (at != "" && match(line, /^ +QL_[A-Z0-9_]+,?( |$)/)) {
                sub(/^ +/, "", line)
                sub(/[, ].*/, "", line)
                gates_number[line] = at++
                gates_list[++gates_enums] = line
            }
        }
        close(file)
    }
}

# Words of the enum whose names begin with prefix, in its order.
function gates_words(prefix,    i, words)
{
    for (i = 1; i <= gates_enums; i++)
        if (index(gates_list[i], prefix) == 1)
            words = words " " gates_word(prefix, gates_list[i])
    return substr(words, 2)
}

function gates_value(name)
{
    return name in gates_number ? gates_number[name] : name + 0
}

# Is settings[MEMBER] within FIRST and LAST? These three begin at part[k].
function gates_within(settings, part, k)
{
    return settings[part[k]] >= gates_value(part[k + 1]) &&
        settings[part[k]] <= gates_value(part[k + 2])
}

# Is row r of settings that have no effect? Sets gates_member to what has none,
# gates_where to the member that is to blame.
function gates_idle(r, settings,    part)
{
    split(gates_row[r], part, /[(),]/)
    gates_member = part[2]
    gates_where = part[5]
    return part[1] == "IDLE" && gates_within(settings, part, 2) &&
        gates_within(settings, part, 5)
}

# The bits of a gate that is a set: that of settings[MEMBER], a number. Sets
# gates_member.
function gates_set(gate, settings,    r, part)
{
    for (r = 1; r <= gates_rows; r++)
        if (split(gates_row[r], part, /[(),]/) && part[1] == "SET" && \
            part[2] == gate) {
            gates_member = part[3]
            return 2 ^ settings[part[3]]
        }
}

# The member of ql_settings_t for which settings[MEMBER], numbers, need a gate;
# nothing if they do not.
function gates_need(gate, settings,    r, n, part, k, all)
{
    for (r = 1; r <= gates_rows; r++) {
        n = split(gates_row[r], part, /[(),]/)
        if (part[2] != gate || part[1] == "SET")
            continue
        all = 1
        for (k = 3; k + 2 <= n && part[k] != ""; k += 3)
            all = all && gates_within(settings, part, k)
        if (all)
            return part[3]
    }
    return ""
}
