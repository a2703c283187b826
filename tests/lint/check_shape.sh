#!/bin/sh
# check_shape.sh - limits on gates, parameters, flags, folders and line widths
# SPDX-License-Identifier: MIT
#
# usage: tests/lint/check_shape.sh [--list | --table]
#   --list   print what is counted, the limits and each place
#   --table  print the measures of the tree in the current folder, any version
#
# A limit is what the tree has reached: it is lowered with the count, and never
# raised. Prints one claim a rule; exit 1 if any is broken.
#
# Example: tests/lint/check_shape.sh --list

set -u
gates_max=0        # #if inside bodies in firmware/, ql_bvh.c and ql_tri.h apart
parameters_max=8   # of a function
wide_parameters=0  # functions with more
flags_max=0        # calls with a bare true or false as an argument
files_max=12       # in a folder
wide_folders=0     # folders with more, tests/unit apart
wide_lines_max=0   # lines over 80 columns
alone_max=17       # exported functions that nobody else calls

here=$(dirname "$0")
suite=lint/shape
. "$here/../support/claims.sh"
product='firmware hal sim tools'
generated='ql_lut_data\.c|pairs\.mk'

# Names of files, one a line: of the folders given, with one of the suffixes.
files() # SUFFIXES FOLDER...
{
    suffixes=$1
    shift
    find "$@" -type f | grep -E "\.($suffixes)\$" | sort
}

# shellcheck disable=SC2046,SC2086  # no name has a space
facts=$(awk -f "$here/shape.awk" $(files '[ch]' $product))

# Facts of a kind for which an awk condition holds, as "FILE:LINE REST".
facts_of() # KIND CONDITION
{
    echo "$facts" | awk "\$1 == \"$1\" && ($2)" | cut -d ' ' -f 2-
}

gates()
{
    facts_of gate '$2 ~ /^firmware/ && $2 !~ /\/ql_(bvh\.c|tri\.h):/'
}

folders() # COUNT FOLDER
{
    files 'c|h|sh|awk' $product tests | sed 's|/[^/]*$||' |
        grep -vx tests/unit | uniq -c | sort -rn
}

wide_lines()
{
    # shellcheck disable=SC2046,SC2086
    awk 'length($0) > 80 { print FILENAME ":" FNR }' \
        $(files 'c|h|sh|mk|awk' $product tests | grep -vE "$generated") Makefile
}

# Functions of headers, of which no other file speaks, tests included.
alone()
{
    facts_of parameters '$2 ~ /\.h:/ && $4 !~ /_t$/' |
        awk '{ print $3, $1 }' > "$names"
    # shellcheck disable=SC2046,SC2086
    awk '
        FNR == 1 {
            unit = FILENAME
            sub(/\.[ch]$/, "", unit)
        }
        FILENAME == ARGV[1] {
            home = $2
            sub(/\.h:.*/, "", home)
            at[$1] = home
            next
        }
        {
            n = split($0, word, /[^a-zA-Z_0-9]+/)
            for (i = 1; i <= n; i++)
                if (word[i] in at && at[word[i]] != unit) used[word[i]] = 1
        }
        END { for (name in at) if (!(name in used)) print at[name] ".h " name }
    ' "$names" $(files '[ch]' $product tests) | sort
}

# The claim that there are at most so many; those there are, if there are more.
at_most() # CLAIM LIMIT PLACES
{
    count=$(printf '%s' "$3" | grep -c '')
    if [ "$list" = yes ]; then
        printf '%s: %s, at most %s\n' "$1" "$count" "$2"
        [ -z "$3" ] || printf '%s\n' "$3" | sed 's/^/    /'
        return
    fi
    [ "$count" -le "$2" ]
    status=$?
    note="$count, at most $2"
    [ $status -eq 0 ] ||
        note="$note: $(printf '%s\n' "$3" | head -n 5 | paste -s -d ' ' -)"
    say "$1" $status "$note"
}

table()
{
    printf '#if in bodies of firmware/: %s\n' "$(gates | grep -c '')"
    echo "$facts" | awk '
        $1 == "void" { unused++ }
        $1 == "flag" { flags++ }
        $1 == "parameters" && $3 > most { most = $3; widest = $4 }
        $1 == "function" {
            if ($3 > longest) { longest = $3; name = $4 }
            if ($3 > 50) long++
        }
        END {
            printf "longest function: %d lines, %s\n", longest, name
            printf "functions over 50 lines: %d\n", long
            printf "most parameters: %d, %s\n", most, widest
            printf "calls with a bare true or false: %d\n", flags
            printf "lines (void)name; in bodies: %d\n", unused
        }'
    printf 'files in a folder, most: %s\n' \
        "$(folders | head -n 1 | awk '{ print $1 ", " $2 }')"
    printf 'folders of more than %s files: %s\n' "$files_max" \
        "$(folders | awk -v most="$files_max" '$1 > most' | grep -c '')"
    printf 'lines over 80 columns: %s\n' "$(wide_lines | grep -c '')"
}

# A file with one of each, and what is none: facts as "KIND LINE REST".
sample()
{
    cat > "$names" << 'END'
#if 1
typedef int nine_t(int a, int b, int c, int d, int e,
        int f, int g, int h, int (*i)(int, int));
#endif
static const row_t row = {1, true, 2}; /* g(a, true) */
int f(int a, bool b)
{
    (void)a;
#if 1
    if (b == true || f(row[1], false)) {
        return f((g(")"), 1), /* and */
                true);
    }
#endif
    while (true) {
        f(1, b == false);
    }
}
END
    awk -f "$here/shape.awk" "$names" | sed "s|$names:||; s| *\$||"
}

names=$(mktemp) || exit 3
trap 'rm -f "$names"' EXIT
list=no
case ${1-} in
--table) table && exit ;;
--list) list=yes ;;
esac
if [ "$list" = yes ]; then
    gates | sed 's/:.*//' | uniq -c | sort -rn
fi
if [ "$list" = no ]; then
    wanted='parameters 3 9 nine_t,parameters 7 2 f,void 8,gate 9,'
    wanted="${wanted}flag 10,flag 12,function 18 10 f"
    [ "$(sample | paste -s -d , -)" = "$wanted" ]
    say facts_of_a_sample_are_those_in_it $?
fi
[ -n "$facts" ]
say there_are_files_to_look_at $?
at_most bodies_of_the_core_have_few_gates $gates_max "$(gates)"
at_most few_functions_have_nine_parameters_or_more $wide_parameters \
    "$(facts_of parameters "\$3 > $parameters_max")"
at_most calls_name_what_a_flag_means $flags_max "$(facts_of flag 1)"
at_most folders_have_at_most_a_dozen_files $wide_folders \
    "$(folders | awk -v most="$files_max" '$1 > most { print $2 ":" $1 }')"
at_most lines_have_at_most_80_columns $wide_lines_max "$(wide_lines)"
at_most exported_functions_have_a_caller $alone_max "$(alone)"
exit $((failures > 0))
