# tree.sh - the files of the tree, with git or without; scripts source it
# SPDX-License-Identifier: MIT
#
# Before: claims.sh is there, and the current folder is the tree's.

# tree_files PATTERN...: those whose name matches one. Where git does not know
# the tree, as an archive or within another repository, all but what was built.
tree_files() {
    if git ls-files --error-unmatch Makefile >/dev/null 2>&1; then
        git ls-files -- "$@"
        return
    fi
    own=${BUILD:-build}
    built="./${own#./}
$(find . -path '*/flags/sources' | sed 's|/flags/sources$||')"
    find . -type f | LC_ALL=C sort | while IFS= read -r file; do
        for folder in $built; do
            case $file in
            "$folder"/*) continue 2 ;;
            esac
        done
        for pattern in "$@"; do
            # shellcheck disable=SC2254 # it is a pattern
            case ${file##*/} in
            $pattern) printf '%s\n' "${file#./}" ;;
            esac
        done
    done
}

# say_found FILES: no rule holds for want of files
say_found() {
    [ -n "$1" ]
    say there_are_files_to_look_at $? "$(printf '%s\n' "$1" | grep -c .)"
}
