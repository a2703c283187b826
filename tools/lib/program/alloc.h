/* alloc.h - arrays that grow, copies of text */
/* SPDX-License-Identifier: MIT */

#ifndef ALLOC_H
#define ALLOC_H

#include <stddef.h>

/* Make room for one more entry behind count entries of size bytes each.
 *
 *   array     -      as returned before; NULL at first
 *   count     -      entries in use
 *   capacity  -      in, out: entries there is room for; 0 at first
 *   size      bytes  one entry
 *   return    the array, moved if it had to grow
 */
void *alloc_grow(void *array, size_t count, size_t *capacity, size_t size);

/* A copy of length bytes of text and a zero byte. */
char *alloc_text(const char *text, size_t length);

#endif
