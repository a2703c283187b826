# includes.awk - which file of the tree includes which: a line "FROM TO" each
# SPDX-License-Identifier: MIT
#
# usage: awk -f tests/lint/includes.awk FILE...
#
# Looks for a name beside the file that includes it, then where the compiler is
# told to. Names that are no file of the list are left out: board.h, which each
# board has, and what make generates.

BEGIN {
    folders = split(". firmware hal tools tests sim tests/known tests/bench", \
        folder, " ")
    for (i = 1; i < ARGC; i++) known[ARGV[i]] = 1
}

# At a path of the tree, or "" if there is no such file.
function find(from, name, path, i) {
    path = from
    sub(/[^\/]*$/, "", path)
    if (path name in known) return path name
    for (i = 1; i <= folders; i++) {
        path = (folder[i] == "." ? "" : folder[i] "/") name
        if (path in known) return path
    }
    return ""
}

/^#[ \t]*include "/ {
    split($0, part, "\"")
    to = find(FILENAME, part[2])
    if (to != "") print FILENAME, to
}
