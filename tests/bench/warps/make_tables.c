/* make_tables.c - the distributions whose sampling is measured, as a header */
/* SPDX-License-Identifier: MIT */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"
#include "sample/lecture/ql_alias.h"
#include "lib/math/build_table.h"

enum { ENTRIES = 16, CDF_BITS = 31 };

static const char help[] =
        "usage: make-tables -o FILE.h\n"
        "Write a discrete distribution of 16 entries, as prefix sums and as "
        "an\n"
        "alias table, and a tabulated density of 16 x 16 cells.\n"
        "\nExample: build/make-tables -o build/bench_tables.h\n";

static void check(table_error_t error)
{
    if (error != TABLE_OK) {
        cli_fail(CLI_INPUT, "%s", table_error_text(error));
    }
}

static void write_words(
        FILE *file, const char *name, const uint32_t *words, unsigned count)
{
    fprintf(file, "static const uint32_t %s[] = {", name);
    for (unsigned i = 0; i < count; i++) {
        fprintf(file, "%s%luu", i == 0 ? "" : ", ", (unsigned long)words[i]);
    }
    fputs("};\n", file);
}

/* Weights that differ by two powers of ten, in no order. */
static double weight(unsigned i)
{
    return 1 + i * 37 % 101;
}

static void write_row(FILE *file)
{
    double weights[ENTRIES];
    uint32_t words[ENTRIES * QL_ALIAS_WORDS], bounds[ENTRIES];
    uint32_t total, before = 0;

    for (unsigned i = 0; i < ENTRIES; i++) {
        weights[i] = weight(i);
    }
    check(alias_build_real(words, weights, ENTRIES, &total));
    fprintf(file,
            "#define BENCH_ENTRIES %d\n"
            "#define BENCH_ALIAS_TOTAL %luu\n",
            ENTRIES, (unsigned long)total);
    write_words(file, "bench_alias", words, ENTRIES * QL_ALIAS_WORDS);
    check(table_shares(bounds, weights, ENTRIES, CDF_BITS));
    for (unsigned i = 0; i < ENTRIES; i++) {
        const uint32_t share = bounds[i];

        bounds[i] = before << (32 - CDF_BITS);
        before += share;
    }
    write_words(file, "bench_cdf", bounds, ENTRIES);
}

static void write_square(FILE *file)
{
    static const uint16_t count[2] = {ENTRIES, ENTRIES};
    const uint32_t size = table_words(2, count);
    uint16_t *words = cli_alloc(size, sizeof *words);
    double weights[ENTRIES * ENTRIES];

    for (unsigned i = 0; i < ENTRIES * ENTRIES; i++) {
        weights[i] = weight(i);
    }
    check(table_build(words, weights, 2, count));
    fprintf(file,
            "#define BENCH_TABLE_WORDS %lu\n"
            "static const uint16_t bench_table[] = {",
            (unsigned long)size);
    for (uint32_t i = 0; i < size; i++) {
        fprintf(file, "%s%u", i == 0 ? "" : ", ", (unsigned)words[i]);
    }
    fputs("};\n", file);
    free(words);
}

int main(int argc, char **argv)
{
    cli_out_t out;

    cli_begin("make-tables");
    if (argc == 2 && strcmp(argv[1], "--help") == 0) {
        fputs(help, stdout);
        return CLI_DONE;
    }
    if (argc != 3 || strcmp(argv[1], "-o") != 0) {
        cli_fail(CLI_USAGE, "give -o FILE (see --help)");
    }
    cli_out_open(&out, argv[2]);
    fputs("/* Distributions to measure, written by make-tables */\n", out.file);
    write_row(out.file);
    write_square(out.file);
    cli_out_commit(&out);
    return CLI_DONE;
}
