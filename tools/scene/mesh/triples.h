/* triples.h - sets of integer triples, each with an index */
/* SPDX-License-Identifier: MIT */

#ifndef TRIPLES_H
#define TRIPLES_H

#include <stddef.h>
#include <stdint.h>

/* A triple and what it belongs to; equal if both are. */
typedef struct {
    uint32_t owner;
    uint32_t triple[3];
} triples_key_t;

/* Open addressing, at most half full. */
typedef struct {
    triples_key_t *keys;
    uint32_t *indices;
    size_t mask;
} triples_t;

/* Begin with an empty set; triples_close() it.
 *
 *   set        -  out
 *   count_max  -  most keys that will be added
 */
void triples_open(triples_t *set, size_t count_max);

/* Add a key unless the set has it.
 *
 *   set     -  in, out
 *   key     -  to find or add
 *   index   -  of the key if it is new; below 2^32 - 1
 *   return  index if the key was new, else the one it was added with
 */
uint32_t triples_add(triples_t *set, const triples_key_t *key, uint32_t index);

void triples_close(triples_t *set);

#endif
