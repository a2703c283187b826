# shape.awk - facts about C files: functions, parameters, gates, flags
# SPDX-License-Identifier: MIT
#
# usage: awk -f tests/lint/shape.awk FILE.[ch]...
#
# Relies on the format that check_format.sh holds: whatever begins at the margin
# is outside of every body, and a body ends with a brace at the margin. Prints a
# line a fact:
#   gate       FILE:LINE               an #if inside a body
#   function   FILE:LINE LINES NAME    its body has so many lines
#   parameters FILE:LINE COUNT NAME    of a function or a type of functions
#   flag       FILE:LINE               a call has a bare true or false
#   void       FILE:LINE               a line (void)name; in a body

function fact(kind, text) {
    print kind, FILENAME ":" FNR, text
}

# Code without comments, strings and characters.
function strip(line) {
    if (comment) {
        if (!match(line, /\*\//)) return ""
        line = substr(line, RSTART + 2)
        comment = 0
    }
    gsub(/\\./, "", line)
    gsub(/"[^"]*"/, "\"\"", line)
    gsub(/'[^']*'/, "0", line)
    gsub(/\/\*[^*]*\*+([^\/*][^*]*\*+)*\//, "", line)
    if (match(line, /\/\*/)) {
        line = substr(line, 1, RSTART - 1)
        comment = 1
    }
    return line
}

# Of a declaration's text: the name before its first "(" that opens a list of
# parameters, and how many there are.
function judge_declaration(text, i, c, depth, count) {
    if (text ~ /^#|=/ || !match(text, /[a-zA-Z_0-9]+ ?\(/)) return
    name = substr(text, RSTART, RLENGTH)
    sub(/ ?\($/, "", name)
    count = 1
    for (i = RSTART + RLENGTH; i <= length(text); i++) {
        c = substr(text, i, 1)
        if (c == "(") depth++
        if (c == ")" && depth-- == 0) break
        if (c == "," && depth == 0) count++
    }
    fact("parameters", count " " name)
}

# Of a statement's text: is there a call with a true or false of its own?
function judge_calls(text, i, n, word, open, depth, last, before) {
    n = length(text)
    for (i = 1; i <= n; i++) {
        c = substr(text, i, 1)
        if (c ~ /[a-zA-Z_0-9]/) {
            match(substr(text, i), /^[a-zA-Z_0-9]+/)
            word = substr(text, i, RLENGTH)
            i += RLENGTH - 1
            if ((word == "true" || word == "false") && open[depth] &&
                    last ~ /[(,]/ && substr(text, i + 1) ~ /^ *[,)]/)
                return 1
            before = word
            last = "w"
        } else if (c ~ /[({\[]/) {
            open[++depth] = c == "(" && last == "w" &&
                before !~ /^(if|while|for|switch|return|sizeof)$/
            last = c
        } else if (c ~ /[)}\]]/) {
            depth--
            last = c
        } else if (c != " ") {
            last = c
        }
    }
    return 0
}

FNR == 1 { comment = 0; body = 0; declaration = ""; statement = "" }

{
    code = strip($0)
}

body && /^[ \t]*#[ \t]*if/ { fact("gate", "") }

body && code ~ /^ +\(void\)[a-z_A-Z0-9]+;/ { fact("void", "") }

# Declarations begin at the margin and may go on below.
!body && code ~ /^[a-zA-Z_]/ { declaration = code }
!body && code ~ /^ / && declaration != "" { declaration = declaration code }
!body && declaration ~ /;$/ {
    judge_declaration(declaration)
    declaration = ""
}

code ~ /^\}/ && body {
    if (function_name != "") fact("function", FNR - body - 1 " " function_name)
    body = 0
    declaration = ""
    next
}
!body && (code ~ /^\{$/ || code ~ /^[^#].*\{$/) {
    body = FNR
    function_name = ""
    name = ""
    if (code == "{") {
        judge_declaration(declaration)
        function_name = name
    }
    declaration = ""
    statement = ""
    next
}

body && code !~ /^[ \t]*#/ {
    statement = statement " " code
    if (code ~ /[;{}:]$/) {
        if (statement ~ /true|false/ && judge_calls(statement)) fact("flag", "")
        statement = ""
    }
}
