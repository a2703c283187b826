#!/bin/sh
# jobs.sh - the jobs of unit tests, without running the same bytes twice
# SPDX-License-Identifier: MIT
#
# usage: tests/configs/jobs.sh build/test/CONFIG/unit/TEST...
#
# Prints "name|command;" for each, as tests/run.sh takes them. A gate changes
# few of the programs; one that is equal to that of another configuration need
# not run again: its job compares them.
#
# Example: tests/configs/jobs.sh build/test/*/unit/test_fx

set -u
built=${BUILD:-build}
cksum "$@" | awk -v built="$built/test/" '
    {
        name = $3
        name = substr(name, length(built) + 1)
        config = name
        sub(/\/.*/, "", config)
        suite = substr(name, length(config) + 2)
        key = suite " " $1 " " $2
        if (key in first) {
            printf "%s|cmp %s%s/%s %s && " \
                "echo %s is_the_program_of_%s ok;\n",
                name, built, first[key], suite, $3, suite, first[key]
        } else {
            first[key] = config
            printf "%s|%s;\n", name, $3
        }
    }'
