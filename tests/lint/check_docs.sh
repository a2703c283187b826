#!/bin/sh
# check_docs.sh - first lines, names, docstrings, maps and numbers in documents
# SPDX-License-Identifier: MIT
#
# usage: tests/lint/check_docs.sh [--write]
#   --write  bring the generated file lists in the READMEs up to date
#
# Prints one claim a rule; exit 1 if any is broken.
#
# Example: tests/lint/check_docs.sh

set -u
suite=lint/docs
. tests/support/claims.sh
. tests/lint/tree.sh
sources=$(tree_files '*.c' '*.h')
scripts=$(tree_files Makefile '*.mk' '*.awk' '*.sh')
documents=$(tree_files '*.md')
for files in "$sources" "$scripts" "$documents"; do
    say_found "$files"
done

bad=$(for f in $sources; do
    awk -v f="$f" -v name="$(basename "$f")" '
        FNR == 1 && (index($0, "/* " name " - ") != 1 || length($0) > 80 ||
            $0 !~ / \*\/$/) { print f ":1" }
        FNR == 2 && $0 != "/* SPDX-License-Identifier: MIT */" { print f ":2" }
        FNR == 2 { exit }' "$f"
done)
say_none every_source_begins_with_its_name_and_one_line "$bad"

# Below the #! of a script.
bad=$(echo "$scripts" | while IFS= read -r f; do
    sed '1{/^#!/d;}' "$f" | awk -v f="$f" -v name="$(basename "$f")" '
        NR == 1 && (index($0, "# " name " - ") != 1 || length($0) > 80) {
            print f ": its first line"
        }
        NR == 2 && $0 != "# SPDX-License-Identifier: MIT" {
            print f ": its licence"
        }
        NR == 2 { exit }'
done)
say_none every_makefile_and_script_begins_so_too "$bad"

bad=$(for f in $sources $scripts; do
    case $f in
    *ql_lut_data.c | *.sh) ;;
    *) awk -v f="$f" 'length($0) > 80 { print f ":" FNR }' "$f" ;;
    esac
done)
say_none no_line_is_over_80_columns "$bad"

bad=$(for f in $sources; do basename "$f"; done | sort | uniq -d |
    grep -v '^board\.[ch]$')
say_none base_names_are_unique "$bad"

# Every prototype of the core's headers has a comment before it in which each
# parameter begins a row of the table (inline one-liners explain themselves).
bad=$(for f in firmware/*.h firmware/*/*.h firmware/*/*/*.h hal/ql_hal.h; do
    awk -v f="$f" '
        /^\/\*/ { comment = "" ; inside = 1 }
        inside { comment = comment $0 "\n" }
        /\*\/ *$/ { inside = 0; next }
        inside { next }
        /^[a-zA-Z].*\(/ &&
                !/^(typedef|QL_(INLINE|FAST|CLZ|FX|STATIC)|static)/ {
            text = ""; collecting = 1
        }
        collecting { text = text " " $0 }
        collecting && /;[[:space:]]*$/ {
            collecting = 0
            if (comment == "") { print f ": no comment:" text; next }
            args = text
            sub(/^[^(]*\(/, "", args); sub(/\)[^)]*$/, "", args)
            n = split(args, part, ",")
            for (i = 1; i <= n; i++) {
                gsub(/\[[^]]*\]/, "", part[i])
                m = split(part[i], word, /[ *]+/)
                name = word[m]
                if (name == "" || name == "void") continue
                if (comment !~ ("[^a-z_]" name "[^a-z_]"))
                    print f ": " name " is not explained"
            }
            comment = ""
        }
        /^$/ { if (!collecting) comment = "" }
    ' "$f"
done)
say_none every_parameter_of_a_public_function_is_explained "$bad"

# File lists between <!-- files DIR... --> and <!-- end --> are generated.
list_files()
{
    for dir in "$@"; do
        for f in "$dir"/*.[ch] "$dir"/*.sh; do
            [ -f "$f" ] || continue
            name=$(basename "$f")
            line=$(sed -n -e "s|^/\* $name - \(.*\) \*/\$|\1|p" \
                -e "s|^# $name - \(.*\)\$|\1|p" "$f" | head -1)
            echo "- \`${f#./}\` - $line"
        done
    done
}

bad=
for doc in $documents; do
    grep -q '<!-- files ' "$doc" || continue
    new=${BUILD:-build}/$(echo "$doc" | tr / _)
    mkdir -p "${BUILD:-build}"
    while IFS= read -r line; do
        case $line in
        '<!-- files '*)
            printf '%s\n\n' "$line"
            dirs=${line#<!-- files }
            list_files ${dirs% -->}
            printf '\n'
            skip=1
            ;;
        '<!-- end -->')
            skip=0
            printf '%s\n' "$line"
            ;;
        *) [ "${skip:-0}" = 1 ] || printf '%s\n' "$line" ;;
        esac
    done < "$doc" > "$new"
    if ! cmp -s "$doc" "$new"; then
        if [ "${1:-}" = --write ]; then
            cp "$new" "$doc"
        else
            bad="$bad $doc"
        fi
    fi
done
say_none the_file_lists_are_up_to_date "$bad"

# Links to files of the tree lead somewhere.
bad=$(for doc in $documents; do
    dir=$(dirname "$doc")
    grep -o '](\([^)#]*\))' "$doc" | sed 's/](\(.*\))/\1/' |
        grep -v '^http' | while IFS= read -r link; do
        [ -e "$dir/$link" ] || echo "$doc: $link"
    done
done)
say_none links_in_documents_lead_somewhere "$bad"

exit $((failures > 0))
