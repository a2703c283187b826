#!/bin/sh
# help.sh - print the variables of make, with their defaults
# SPDX-License-Identifier: MIT
#
# usage: tools/dev/help.sh
#
# Example: make help

awk '
    # SPP  picture  64  --spp  QL_APP_SPP  1..16777216
    /^[A-Za-z]/ && $1 != "use" {
        name = $2 == "inner" ? "" : $1 ($3 ~ /^[=!-]/ ? "" : "=" $3)
    }
    #     samples a pixel; on a board the board has its own
    /^ / && name != "" && $0 !~ /^ *unused$/ {
        printf "  %-16s %s\n", name, substr($0, 5)
    }' "$(dirname "$0")/variables.txt"
