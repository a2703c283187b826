# rules.awk - choices.txt to make rules: what is built, measured, and kept
# SPDX-License-Identifier: MIT
#
# usage: awk -v quick=0 -v build=build -f tools/dev/gates.awk \
#            -f tools/trade/rules.awk tools/trade/choices.txt
#
# Every measurement is a file in BUILD/trade, so make does what is missing and
# what has changed, and goes on where it was stopped. -v quick=1 is for the
# choices with a ! in front, in small pictures of two scenes, on one core.

BEGIN {
    gates_read()
    dir = build "/trade" (quick ? "/quick" : "")
    n_scenes = split(quick ? "cornell dents" : "cornell lights dents", scenes,
        " ")
    size["cornell"] = quick ? "18x18" : "36x36"
    size["lights"] = size["dents"] = quick ? "20x15" : "40x30"
    n_cores = quick ? 1 : 3
    split("lm3s6965evb microbit mps2-an386", boards, " ")
    cap = quick ? 256 : 1024
    reference_spp = quick ? 512 : 4096
    enough = 0.0095
}

/^#/ || NF == 0 { next }

NF < 8 || ($4 != "draft" && $4 != "fine") {
    print FILENAME ":" FNR ": expected NAME KNOB SCENES PRECISION BITS LERP " \
        "NODE LEAF OPTIONS" > "/dev/stderr"
    bad = 1
    exit
}

{
    name = $1
    if (sub(/^!/, "", name) == 0 && quick)
        next
    deep = sub(/\+$/, "", name)
    options = ""
    for (i = 9; i <= NF; i++)
        options = options " " $i
    core = $4 "-" $5 "-" $6
    cores[core] = 1
    for (k = 1; k <= n_scenes; k++)
        if ($3 == "all" || index("," $3 ",", "," scenes[k] ","))
            choice(scenes[k])
}

# Write a file unless it says so already: what depends on it stays as it is.
function keep(file, text,    line, old) {
    while ((getline line < file) > 0)
        old = old line "\n"
    close(file)
    if (old == text)
        return
    line = file
    sub(/\/[^\/]*$/, "", line)
    system("mkdir -p \"" line "\"")
    printf "%s", text > file
    close(file)
}

# A rule: what it makes, from what, by which recipe of trade.mk, ARGS in it.
function rule(target, needs, recipe, args)
{
    print target ": private ARGS = " args
    print target ": " needs "; $(" recipe ")"
}

function blob_of(scene, blob)
{
    return build "/trade/" scene "-" blob
}

# A choice in a scene: its error here, its place in a firmware.
function choice(scene,    blob, out, spp, group, args)
{
    blob = "n" $7 "l" $8
    blobs[scene " " blob] = "--node-bits " $7 " --leaf " $8
    spp = cap * (deep && !quick ? 8 : 1)
    out = dir "/" scene "/" name
    args = enough " " blob_of(scene, blob) ".qlb --size " size[scene] \
        " --spp " spp " --direct " value("--direct", "area") " --lights " \
        value("--lights", "power") others(options)
    keep(out ".args", args "\n")
    rule(out ".error", build "/trade/error-" core " " dir "/" scene "-a.pfm " \
        dir "/" scene "-b.pfm " blob_of(scene, blob) ".qlb " out ".args",
        "trade_error", args)
    targets = targets " " out ".error"
    # estimators of their own cost a firmware that has all of them
    group = scene " " core " " blob " " strategies(options)
    members[group] = members[group] c_settings(scene) "\n"
    row[++n_rows] = scene "|" name "|" $2 "|" $4 "|" $5 "|" $6 "|" $7 "|" $8 \
        "|" options "|" group
}

# The options that say nothing of direct and lights.
function others(options)
{
    gsub(/ --(direct|lights) [a-z-]+/, "", options)
    return options
}

# Does a firmware of these options need more than area by power?
function strategies(options,    settings)
{
    settings["indirect"] = gates_value(enumerator("indirect", "brdf"))
    settings["light_samples"] = value("--light-samples", 1)
    settings["roulette"] = options ~ /--roulette/
    return value("--direct", "area") != "area" || \
        value("--lights", "power") != "power" || \
        gates_need("UNIFORM", settings) != "" || \
        gates_need("LIGHT_SAMPLES", settings) != "" || \
        gates_need("ROULETTE", settings) != ""
}

function value(option, otherwise,    words, n, i)
{
    n = split(options, words, " ")
    for (i = 1; i < n; i++)
        if (words[i] == option)
            return words[i + 1]
    return otherwise
}

# What an option that takes a word is in C.
function enumerator(option, otherwise)
{
    return gates_enumerator("QL_" toupper(option) "_",
        value("--" option, otherwise))
}

# An initialiser of trade_settings.h.
function c_settings(scene,    wh)
{
    split(size[scene], wh, "x")
    return sprintf("{\"%s\", {.width = %d, .height = %d, .spp = %d, " \
        ".seed = 0, .bounces = %d, .sampler = %s, .direct = %s, " \
        ".indirect = %s, .lights = %s, .light_samples = %d, " \
        ".roulette = %d, .error_q16 = QL_ERROR_Q16(%s)}},",
        name, wh[1], wh[2], value("--error", 0) + 0 > 0 ? 64 : 4,
        value("--bounces", 4), enumerator("sampler", "sobol"),
        enumerator("direct", "area"), enumerator("indirect", "brdf"),
        enumerator("lights", "power"), value("--light-samples", 1),
        options ~ /--roulette/ ? 1 : 0, value("--error", 0))
}

# A firmware for choices that share everything that is built in, on each core.
function firmware(group,    g, b, folder, key, part)
{
    split(group, g, " ")
    split(g[2], part, "-")
    key = g[1] "-" g[2] "-" g[3] "-" g[4]
    folder = dir "/" key
    keep(folder "/trade_settings.h",
        "/* trade_settings.h - GENERATED by tools/trade/rules.awk */\n" \
        "static const struct { const char *name; ql_settings_t settings; } " \
        "trade_settings[] = {\n" members[group] "};\n#define TRADE_COUNT " \
        "(sizeof trade_settings / sizeof trade_settings[0])\n")
    for (b = 1; b <= n_cores; b++) {
        rule(folder "/" boards[b] ".cost", folder "/trade_settings.h " \
            blob_of(g[1], g[3]) ".qlb $(CORE)", "trade_cost",
            "BOARD=" boards[b] " SCENE=" g[1] " BLOB=" blob_of(g[1], g[3]) \
            " PRECISION=" part[1] " TABLE_BITS=" part[2] " TABLE_LERP=" \
            part[3] " DIRECT=area LIGHTS=power STRATEGIES=" g[4] \
            " VARIANT=-" quick "-" key)
        targets = targets " " folder "/" boards[b] ".cost"
    }
}

# The core with other tables: what depends on them is compiled again.
function program(core,    part)
{
    split(core, part, "-")
    rule(build "/trade/error-" core, "tools/trade/trade_error.c " \
        "tools/lib/render/open_blob.c $(trade_tables) $(io) $(" \
        part[1] ")", "trade_core",
        "-DQL_CFG_PRECISION=" (part[1] == "fine") " -DQL_CFG_TABLE_BITS=" \
        part[2] " -DQL_CFG_TABLE_LERP=" part[3])
}

END {
    if (bad)
        exit 2
    for (core in cores)
        program(core)
    for (blob in blobs) {
        split(blob, part, " ")
        out = blob_of(part[1], part[2])
        print out ".h: " out ".qlb"
        rule(out ".qlb", "tests/scenes/" part[1] ".scene $(wildcard " \
            "tests/scenes/" part[1] ".*) " build "/qlux-scene", "trade_blob",
            blobs[blob])
    }
    for (k = 1; k <= n_scenes; k++)
        for (i = 1; i <= 2; i++) {
            out = dir "/" scenes[k] "-" substr("ab", i, 1) ".pfm"
            rule(out, blob_of(scenes[k], "n16l4") ".qlb " build "/qlux-ref",
                "trade_reference", "--size " size[scenes[k]] " --spp " \
                reference_spp " --seed " 1000 + i)
            targets = targets " " out
        }
    for (group in members)
        firmware(group)
    print "TRADE_TARGETS :=" targets
    rows = dir "/rows"
    printf "" > rows
    for (i = 1; i <= n_rows; i++)
        print row[i] > rows
}
