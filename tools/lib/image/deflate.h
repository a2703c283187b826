/* deflate.h - compress and expand zlib streams (RFC 1950, RFC 1951) */
/* SPDX-License-Identifier: MIT */

#ifndef DEFLATE_H
#define DEFLATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Compress size bytes into a malloc'd zlib stream of *packed_size bytes: one
 * block of fixed codes with greedy matches, or stored if that is shorter. */
uint8_t *deflate_pack(const uint8_t *data, size_t size, size_t *packed_size);

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
