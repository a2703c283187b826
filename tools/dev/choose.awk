# choose.awk - check what make was given, fill in the rest, derive the gates
# SPDX-License-Identifier: MIT
#
# usage: awk -f tools/dev/gates.awk -f tools/dev/choose.awk \
#            tools/dev/variables.txt - < WHAT_MAKE_KNOWS
#
# Lines of the input: "given NAME=VALUE" of make's command line, "board
# NAME=VALUE" of board.mk, "boards NAME...", "scenes NAME...", "goals NAME...",
# "level N". The environment is looked at too.
#
# Prints assignments for make, words without blanks: every variable; sim_options
# of the picture, and cost_options, those on which its cost depends; with a
# BOARD, what its compiler defines. Or "error" and one line that says what is
# wrong. Which settings of a board's picture have no effect goes to stderr;
# qlux-sim says it of a picture here.

function fail(text)
{
    print "error " text
    failed = 1
    exit
}

function wrong(name, text)
{
    fail(name "=" value[name] ": use " text)
}

# a b c: a, b or c
function listed(words, last,    n, part, i, text)
{
    n = split(words, part, " ")
    text = part[1]
    for (i = 2; i <= n; i++)
        text = text (i < n ? ", " : " " last " ") part[i]
    return text
}

function either(words)
{
    return listed(words, "or")
}

# The place of a word in a list, from 0; -1 if it is none of them.
function place(word, words,    n, part, i)
{
    n = split(words, part, " ")
    for (i = 1; i <= n; i++)
        if (part[i] == word)
            return i - 1
    return -1
}

function is_number(text, first, last)
{
    return text ~ /^(0|[1-9][0-9]*)$/ && length(text) <= 10 &&
        text + 0 >= first && text + 0 <= last
}

# Is there such a scene? Prints what its files are called: words of make and of
# the shell.
function check_scene(name,    file, line)
{
    file = value[name]
    if (file !~ /\.(scene|obj)$/)
        file = "tests/scenes/" file ".scene"
    if ((getline line < file) < 0)
        wrong(name, "the path of a .scene or .obj file, or " either(scenes))
    close(file)
    sub(/.*\//, "", file)
    sub(/\.(scene|obj)$/, "", file)
    gsub(/[] \t'"$&();:*?<>|!{}\\~#%`,=@^+[]/, "_", file)
    scene_name = file
}

function check_part(name, text)
{
    if (text !~ /^[0-9]*\.?[0-9]+([eE]-?[0-9]+)?$/ ||
        text + 0 >= 65535.5 / 65536 || (text + 0 > 0 && text + 0 < 0.5 / 65536))
        wrong(name, "0, or a part from 0.00001 to 0.9999")
}

function check_stops(name, text)
{
    if (text != "auto" && (text !~ /^[-+]?[0-9]*\.?[0-9]+$/ ||
        text + 0 < -64 || text + 0 > 64))
        wrong(name, "stops from -64 to 64, or auto")
}

function check_radiance(name, text)
{
    if (text !~ /^[0-9]*\.?[0-9]+$/ || text + 0 > 65535 ||
        (text + 0 > 0 && text + 0 < 0.0001))
        wrong(name, "0, or a radiance from 0.0001 to 65535")
}

function check_power(name, text,    n)
{
    for (n = 1; n < text + 0; n *= 2) {
    }
    if (!is_number(text, 1, 16384) || n != text + 0)
        wrong(name, "a power of two from 1 to 16384")
}

# Is what name has one of its values?
function check(name,    text, values, wh)
{
    text = value[name]
    values = of[name]
    if (values == "scene")
        check_scene(name)
    else if (values == "board" && place(text, boards) < 0)
        wrong(name, either(boards))
    else if (values == "size") {
        if (split(text, wh, "x") != 2 || !is_number(wh[1], 1, 16384) ||
            !is_number(wh[2], 1, 16384))
            wrong(name, "WIDTHxHEIGHT, each from 1 to 16384")
    } else if (values == "part")
        check_part(name, text)
    else if (values == "stops")
        check_stops(name, text)
    else if (values == "radiance")
        check_radiance(name, text)
    else if (values == "power")
        check_power(name, text)
    else if (values ~ /\.\./) {
        split(values, wh, /\.\./)
        if (!is_number(text, wh[1], wh[2]))
            wrong(name, wh[2] - wh[1] == 1 ? wh[1] " or " wh[2] : \
                "a number from " wh[1] " to " wh[2])
    } else if (values != "any" && values != "board" &&
        place(text, words[name]) < 0)
        wrong(name, either(words[name]))
}

# Does a goal use name? Of goals that are not listed nothing is known.
function check_use(name,    n, goal, i, needs_board)
{
    if (group[name] == "any" || group[name] == "inner")
        return
    n = split(goals == "" ? "all" : goals, goal, " ")
    for (i = 1; i <= n; i++) {
        if (!(goal[i] in uses))
            return
        if (index(uses[goal[i]] " ", " " group[name] " ")) {
            if (group[name] != "firmware" || "BOARD" in value ||
                uses[goal[i]] ~ / boards/)
                return
            needs_board = goal[i]
        }
    }
    if (needs_board)
        fail(name "=" value[name] ": make " needs_board \
            " uses it only with BOARD=" either(boards))
    fail(name "=" value[name] ": make " goal[1] " does not use it; " \
        users(group[name]))
}

# Which targets use a group of variables.
function users(what,    i, names)
{
    for (i = 1; i <= n_targets; i++)
        if (index(uses[target[i]] " ", " " what " "))
            names = names " " target[i]
    return "make " listed(names, "and") (names ~ / .* / ? " do" : " does")
}

FNR == NR && /^(#|$| )/ { next }

FNR == NR && $1 == "use" {
    target[++n_targets] = $2
    uses[$2] = ""
    for (i = 3; i <= NF; i++)
        uses[$2] = uses[$2] " " $i
    next
}

FNR == NR {
    name[++n] = $1
    group[$1] = $2
    standard[$1] = $3
    option[$1] = $4
    c_name[$1] = $5
    for (i = 6; i <= NF; i++)
        of[$1] = of[$1] (i > 6 ? " " : "") $i
    if (ENVIRON[$1] != "")
        value[$1] = ENVIRON[$1]
    next
}

{ rest = substr($0, length($1) + 2) }

$1 == "boards" { boards = rest }
$1 == "scenes" { scenes = rest }
$1 == "goals" { goals = rest }
$1 == "level" { level = rest + 0 }

$1 == "given" || $1 == "board" {
    key = rest
    sub(/=.*/, "", key)
    text = substr(rest, length(key) + 2)
}

$1 == "given" {
    if (!(key in group))
        fail(rest ": make knows no variable of this name; make help lists all")
    delete value[key]
    if (text != "") {
        value[key] = text
        given[key] = 1
    }
}

$1 == "board" && text != "" { board[key] = text }

# What is not given.
function fill(key,    text)
{
    if (key in value)
        return
    text = standard[key]
    if ("BOARD" in value && key in board)
        text = board[key]
    if (text ~ /^[=!][A-Z]/) {
        fill(substr(text, 2))
        text = text ~ /^!/ ? 1 - value[substr(text, 2)] : \
            value[substr(text, 2)]
    }
    if (text != "-")
        value[key] = text
}

# The value of name as C has it: an enumerator, a place in a list, a number.
function in_c(key)
{
    if (of[key] ~ /^QL_/)
        return gates_enumerator(of[key], value[key])
    if (of[key] == "stops" && value[key] == "auto")
        return 0
    return of[key] ~ /^[a-z]+ / ? place(value[key], of[key]) : value[key]
}

# Who reads a macro is told by its name: every source, hal/ or main().
function define(name, text)
{
    print (name ~ /^QL_APP_/ ? "board_main" : name ~ /^QL_PORT_/ ? \
        "board_port" : "board_gates") "+=-D" name "=" text
}

# LIGHTS=all has no effect with DIRECT=cosine; what is the default is silent.
function print_idle(settings,    r, member, where)
{
    for (r = 1; r <= gates_rows; r++) {
        if (!gates_idle(r, settings))
            continue
        member = toupper(gates_member)
        where = toupper(gates_where)
        if (value[member] != standard[member])
            print "make: " member "=" value[member] " has no effect with " \
                where "=" value[where] > "/dev/stderr"
    }
}

# A gate that is a set: all of it, or what is asked for. The scene's header has
# that of auto.
function print_set(gate, words, settings,    bits, n, part)
{
    bits = gates_set(gate, settings)
    n = split(words, part, " ")
    if (part[n] == "auto")
        n--
    if (bits == 2 ^ n && !value["STRATEGIES"])
        return
    define("QL_CFG_" gate, value["STRATEGIES"] ? 2 ^ n - 1 : bits)
}

function print_gates(    settings, key, k, need, formats, gates, n_gates)
{
    for (k = 1; k <= n; k++)
        if (option[name[k]] ~ /^--/ && name[k] in value)
            settings[tolower(name[k])] = gates_value(in_c(name[k]))
    if (level == 0)
        print_idle(settings)
    print_set("DIRECT", words["DIRECT"], settings)
    print_set("LIGHT_CHOICES", words["LIGHTS"], settings)
    n_gates = split("UNIFORM LIGHT_SAMPLES ROULETTE", gates, " ")
    for (k = 1; k <= n_gates; k++)
        define("QL_CFG_" gates[k], value["STRATEGIES"] + 0 || \
            gates_need(gates[k], settings) != "")
    need = gates_need("INDIRECT", settings) != ""
    define("QL_CFG_INDIRECT", need)
    print "board_indirect=" need
    define("QL_CFG_ADAPTIVE", "ERROR" in value && value["ERROR"] + 0 > 0)
    define("QL_CFG_SAMPLERS", gates_set("SAMPLERS", settings))
    define("QL_CFG_CURVES", int(2 ^ settings["curve"] / 2))
    key = value["EXPOSURE"] == "auto"
    define("QL_CFG_METER", key)
    if (key)
        define("QL_APP_METER", 1)
    define("QL_CFG_CLAMP", "CLAMP" in value && value["CLAMP"] + 0 > 0)
    # The stream is RGB888; a panel may have another format.
    formats = 1
    if ("PANEL" in board) {
        key = gates_enumerator("QL_FORMAT_", board["PANEL"])
        if (!(key in gates_number))
            fail("BOARD_PANEL=" board["PANEL"] ": use " \
                either(gates_words("QL_FORMAT_")))
        formats += gates_number[key] ? 2 ^ gates_number[key] : 0
    }
    define("QL_CFG_PANEL", "PANEL" in board ? 1 : 0)
    define("QL_CFG_FORMATS", formats)
}

# qlux-cost has no display.
function print_option(key, word)
{
    print "sim_options+=" word
    if (key != "EXPOSURE" && key != "CURVE" && key != "ERROR")
        print "cost_options+=" word
}

# What auto is, the scene's header says.
function print_choice(key)
{
    if (of[key] == "any" || of[key] == "scene" || !(key in value))
        return
    print key "=" value[key]
    if (option[key] != "-" && of[key] != "0..1") {
        print_option(key, option[key])
        print_option(key, value[key])
    } else if (option[key] != "-" && value[key])
        print_option(key, option[key])
    if (c_name[key] == "-" || !("BOARD" in value))
        return
    if (of[key] == "size") {
        define("QL_APP_WIDTH", value[key] + 0)
        define("QL_APP_HEIGHT", substr(value[key], index(value[key], "x") + 1))
    } else
        define(c_name[key], value[key] == "auto" && of[key] ~ /^QL_/ ? \
            "QL_SCENE_" key : \
            in_c(key))
}

END {
    if (failed)
        exit
    gates_read()
    for (k = 1; k <= n; k++)
        words[name[k]] = of[name[k]] ~ /^QL_/ ? gates_words(of[name[k]]) : \
            of[name[k]]
    if ("BOARD" in value)
        check("BOARD")
    for (k = 1; k <= n; k++)
        fill(name[k])
    for (k = 1; k <= n; k++)
        if (name[k] in value)
            check(name[k])
    if (level == 0)
        for (key in given)
            check_use(key)
    if ("BOARD" in value)
        print_gates()
    print "scene=" scene_name
    for (k = 1; k <= n; k++)
        print_choice(name[k])
}
