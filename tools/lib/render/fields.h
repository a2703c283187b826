/* fields.h - what a sum file's settings are called, in the words of options */
/* SPDX-License-Identifier: MIT */

#ifndef FIELDS_H
#define FIELDS_H

#include "lib/sums/sums.h"

/* Room for a value in words. */
#define FIELDS_TEXT_BYTES 24

/* The name of a field: "precision", "direct strategy". */
const char *fields_name(unsigned field);

/* The value of a field as an option writes it: "draft", "mis"; a number if it
 * is one, or one that no program of ours writes.
 *
 *   text    -  out: FIELDS_TEXT_BYTES
 *   return  text
 */
const char *fields_text(char *text, const sums_t *sums, unsigned field);

#endif
