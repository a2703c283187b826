#!/bin/sh
# help.sh - print the variables of make, with their defaults and values
# SPDX-License-Identifier: MIT
#
# usage: tools/dev/help.sh
#
# Example: make help
awk '
    # SPP picture 64 --spp QL_APP_SPP 1..16777216 : samples a pixel
    /^#/ && variables { print "" }
    $0 !~ /^(#|$|use)/ && $2 != "inner" && $0 !~ /: unused$/ {
        text = $0
        sub(/^[^:]* : /, "", text)
        name = $1 ($3 ~ /^[=!-]/ ? "" : "=" $3)
        printf "  %-16s %s\n", name, text
    }' "$(dirname "$0")/variables.txt"
