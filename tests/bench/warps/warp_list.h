/* warp_list.h - every warp, called on a batch of numbers, by name */
/* SPDX-License-Identifier: MIT */

#ifndef WARP_LIST_H
#define WARP_LIST_H

#include "sample/ql_sampler.h"

/* Call a warp once for each pair of numbers. */
typedef void (*warp_batch_t)(const ql_uniform2_t *u, unsigned count);

typedef struct {
    const char *name; /* of the row, '_' for '-' */
    warp_batch_t run;
} warp_t;

/* The loop without a warp, to be taken off the others. */
void warp_batch_empty(const ql_uniform2_t *u, unsigned count);

/* All warps, the last one has no name. A warp's function is called warp_batch_
 * and its name. */
extern const warp_t warp_list[];

/* Work out what warps share. Call first.
 *
 *   return  false if the tables or the spherical triangle are refused
 */
bool warp_list_open(void);

/* Numbers for a batch: samples first .. first + count - 1 of a pixel's Sobol
 * points. */
void warp_numbers(ql_uniform2_t *u, uint32_t first, unsigned count);

#endif
