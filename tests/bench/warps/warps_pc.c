/* warps_pc.c - call each warp on this PC, for an instruction counter */
/* SPDX-License-Identifier: MIT */

#include <stdio.h>
#include <string.h>

#include "bench/warps/warp_list.h"

enum { NUMBERS = 1024, EXIT_USAGE = 1, EXIT_INPUT = 2 };

static const char help[] =
        "usage: warps-pc\n"
        "Call each warp of the core on the same numbers, in a function of its\n"
        "own called warp_batch_NAME, and print how often: \"NAME: N\". For\n"
        "count_warps.sh, which has the instructions of each function counted.\n"
        "\nExample: valgrind --tool=callgrind build/warps-pc\n";

int main(int argc, char **argv)
{
    static ql_uniform2_t numbers[NUMBERS];
    const bool ask = argc == 2 && strcmp(argv[1], "--help") == 0;

    if (argc != 1) {
        fputs(help, ask ? stdout : stderr);
        return ask ? 0 : EXIT_USAGE;
    }
    if (!warp_list_open()) {
        fputs("warps-pc: a table or triangle is refused\n", stderr);
        return EXIT_INPUT;
    }
    warp_numbers(numbers, 0, NUMBERS);
    warp_batch_empty(numbers, NUMBERS);
    for (const warp_t *w = warp_list; w->name != NULL; w++) {
        w->run(numbers, NUMBERS);
        printf("%s: %d\n", w->name, NUMBERS);
    }
    return 0;
}
