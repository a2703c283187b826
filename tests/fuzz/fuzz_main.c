/* fuzz_main.c - the entry of libFuzzer: takes the format that FUZZ names */
/* SPDX-License-Identifier: MIT */

#include <stdio.h>
#include <stdlib.h>

#include "fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static fuzz_take_t *take;

    if (take == NULL) {
        const char *name = getenv("FUZZ");

        take = name != NULL ? fuzz_format(name) : NULL;
        if (take == NULL) {
            (void)fprintf(stderr, "FUZZ: no format of this name\n");
            exit(1);
        }
    }
    fuzz_run(take, data, size);
    return 0;
}
