/* foreign.h - bytes that other programs leave in OBJ and MTL files */
/* SPDX-License-Identifier: MIT */

#ifndef FOREIGN_H
#define FOREIGN_H

#include <stddef.h>

#include "scene/foreign/notes.h"

/* Make a text of the bytes of an OBJ or MTL file: zero bytes at the end of a
 * word, between words or in a comment become blanks, and are noted.
 *
 *   notes  -      in, out; has the path
 *   data   -      in, out: the file
 *   size   bytes  of it
 *
 * Fails: exit 2 if it is a file of another format, which is named, or if a
 *        word has a zero byte inside.
 */
void foreign_clean(notes_t *notes, char *data, size_t size);

#endif
