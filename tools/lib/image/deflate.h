/* deflate.h - compress and expand zlib streams (RFC 1950, RFC 1951) */
/* SPDX-License-Identifier: MIT */

#ifndef DEFLATE_H
#define DEFLATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Takes bytes of a stream, in order. */
typedef void deflate_sink_t(void *to, const uint8_t *bytes, size_t size);

/* A zlib stream being written: blocks of fixed codes with greedy matches, or
 * stored where that is shorter. It takes 434 KB, however long it becomes. */
typedef struct deflate deflate_t;

/* Begin one; cli_fail(CLI_IO) if there is no memory.
 *
 *   sink    -  gets the stream, a block of at most 74 KB at a time
 *   to      -  its first argument
 *   return  to be ended by deflate_end()
 */
deflate_t *deflate_begin(deflate_sink_t *sink, void *to);

/* Compress more bytes. */
void deflate_put(deflate_t *d, const uint8_t *data, size_t size);

/* Hand out what is left and the Adler-32, and free it. */
void deflate_end(deflate_t *d);

/* Expand a zlib stream into exactly size bytes.
 *
 *   where   bytes  out: offset in packed of what is wrong
 *   return  NULL, or what is wrong
 *
 * Any content is safe; the Adler-32 is checked.
 */
const char *deflate_unpack(const uint8_t *packed, size_t packed_size,
        uint8_t *data, size_t size, size_t *where);

#endif
