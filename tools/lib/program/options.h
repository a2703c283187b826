/* options.h - one table of options a program: parsing, --help, wrong usage */
/* SPDX-License-Identifier: MIT */

/* A program lists its options and arguments once; options_parse() stores what
 * was given into a struct, and --help prints the same list with ranges and
 * defaults. So every program words its help and its refusals alike:
 *
 *     unknown option '--bogus' (see --help)
 *     '--spp' needs a value: a whole number from 1 to 16777216 (see --help)
 *     '--spp 0': expected a whole number from 1 to 16777216 (see --help)
 *     unexpected argument 'b.qlb' (see --help)
 *     missing SCENE.qlb (see --help)
 *
 * each behind the program's name, with exit code 1, before anything is read or
 * written. --help, -h and --version win wherever they stand. */

#ifndef OPTIONS_H
#define OPTIONS_H

#include "lib/program/cli.h"
#include "lib/program/option_table.h"

/* Begin a program (cli_begin) and take its command line.
 *
 *   program     -  what it takes; kept
 *   argc, argv  -  as main() has them; kept
 *   into        -  in, out: the struct of the fields; holds the defaults
 *
 * Prints help or version and exits if asked to; ends in options_fail() if the
 * command line is wrong. */
void options_parse(const program_t *program, int argc, char **argv, void *into);

/* Was this option given? By its name without the value: "--spp". */
bool options_given(const char *name);

/* Print "program: message (see --help)" to stderr, exit(CLI_USAGE). For what
 * one option alone does not show. */
#if defined(__GNUC__)
__attribute__((noreturn, format(printf, 1, 2)))
#endif
void options_fail(const char *format, ...);

#endif
