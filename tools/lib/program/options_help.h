/* options_help.h - the help of a program, out of its table of options */
/* SPDX-License-Identifier: MIT */

#ifndef OPTIONS_HELP_H
#define OPTIONS_HELP_H

#include "lib/program/option_table.h"

/* Print the help to stdout, no line over 79 columns.
 *
 *   program   -  as options_parse() has it
 *   defaults  -  the struct of the fields before anything was taken
 */
void options_help(const program_t *program, const void *defaults);

/* Words as a sentence has them: "a, b or c".
 *
 *   text   -      out
 *   size   bytes  of text, which is cut if it is longer
 *   words  -      one or more, NULL ends them
 */
void options_words(char *text, size_t size, const char *const *words);

/* A whole number out of a field of 1, 2, 4 or 8 bytes. */
uint64_t options_load(const option_t *option, const void *fields);

#endif
