/* other_seeds.c - every random number of a test drawn by another seed */
/* SPDX-License-Identifier: MIT */

/* The linker gives calls of main() and ql_sampler_begin() to the functions here
 * (--wrap), and the real ones the names __real_...: neither the core nor the
 * test is compiled another time. */

#include <stdlib.h>

#include "sample/ql_sampler.h"
#include "support/ql_stats.h"

int __real_main(int argc, char **argv);
int __wrap_main(int argc, char **argv);
void __real_ql_sampler_begin(ql_sampler_t *sampler, uint8_t kind, uint32_t seed,
        uint16_t x, uint16_t y);
void __wrap_ql_sampler_begin(ql_sampler_t *sampler, uint8_t kind, uint32_t seed,
        uint16_t x, uint16_t y);

/* SEED is a number; 0 is as the test was written. */
int __wrap_main(int argc, char **argv)
{
    const char *text = getenv("SEED");
    uint64_t state = text ? strtoull(text, NULL, 10) : 0;

    stats_seed = state ? stats_random(&state) : 0;
    return __real_main(argc, argv);
}

/* Seeds that differ still do. */
void __wrap_ql_sampler_begin(ql_sampler_t *sampler, uint8_t kind, uint32_t seed,
        uint16_t x, uint16_t y)
{
    __real_ql_sampler_begin(
            sampler, kind, seed ^ (uint32_t)(stats_seed >> 32), x, y);
}
