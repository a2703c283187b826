/* ql_table.h - tabulated distributions in one, two and three dimensions */
/* SPDX-License-Identifier: MIT */

/* A density on the unit interval, square or cube, constant within each of
 * nx, nx ny or nx ny nz equal cells. Sampling chooses the slowest coordinate by
 * its marginal, then each next one by the conditional of what was chosen.
 *
 *     1-D   row of nx
 *     2-D   marginal: row of ny, then ny conditionals: rows of nx
 *     3-D   marginal: row of nz, nz rows of ny, nz ny rows of nx
 *
 * A row of n is n little-endian 16-bit words. Cell i of it begins at bound c_i,
 * the first at 0 and the last at an end of 2^16, none decreasing:
 *
 *     word 0     used: cells up to the last that is not empty; 0 if all are
 *     word i     c_i for i = 1 .. used - 1; words from there on are 0
 *
 * The first bound needs no word and an end of 2^16 would not fit in one: that
 * is why empty cells at the end are cut off by a count, in the free word.
 *
 * Why 16 bits: half the flash of 32 (a sky of 64 x 32: 4,160 bytes), and u can
 * be reused by two 32-bit divisions, where bounds of 32 bits would take a
 * 64-bit one. A mass is a multiple of 2^-16 of its row, within one of those of
 * what it should be where no cell had to be raised to one. The density is the
 * one of the mass in the table, so nothing is biased by it. */

#ifndef QL_TABLE_H
#define QL_TABLE_H

#include "math/ql_real.h"

enum { QL_TABLE_DIMS_MAX = 3 };

/* What a row holds in all. */
#define QL_TABLE_WHOLE 65536u

typedef struct {
    const uint16_t *words;
    uint16_t count[QL_TABLE_DIMS_MAX]; /* nx, ny, nz; 1 or more in use */
    uint8_t dims;                      /* 1..3 */
} ql_table_t;

typedef struct {
    ql_uq32_t x[QL_TABLE_DIMS_MAX];   /* where, [0, 1) */
    uint16_t cell[QL_TABLE_DIMS_MAX]; /* in which cell: floor(x n) */
    uint64_t mass; /* of the cell, 1 or more, in units of 2^(-16 dims) */
} ql_table_point_t;

/* Check a table and open a read-only view of it, in place.
 *
 *   table    -      out: the view; valid only if this succeeds
 *   words    -      rows as described above, 2-byte aligned; flash is fine
 *   n_words  words  how many are readable
 *   dims     -      1..3; anything else fails
 *   count    cells  dims numbers: nx, ny, nz
 *   return   QL_OK
 *
 * Fails: QL_ERR_RANGE for a dimension of 0 or of more than 3, a count of 0,
 *        bounds that decrease, and rows that can be entered but are empty, so
 *        for a table of zeros; QL_ERR_TRUNCATED if rows are missing.
 * Cost:  reads every word once.
 */
ql_status_t ql_table_open(ql_table_t *table, const uint16_t *words,
        uint32_t n_words, unsigned dims, const uint16_t *count) QL_MUST_CHECK;

/* Choose a cell of one row and make the number that chose it new again.
 *
 *   row     -           a row that ql_table_open() checked, not empty
 *   u       uq32 [0,1)  uniform; a larger u never gives a smaller cell
 *   rest    uq32 [0,1)  out: where u fell within the cell; uniform again
 *   mass    2^-16       out: of the cell, 1..2^16
 *   return  cell: the largest with c <= u 2^16; never one of mass 0
 *
 * Exact: cell i is chosen by exactly mass 2^16 of the 2^32 values of u. They
 *        map to as many values of *rest, evenly spaced: its interval's midpoint
 *        rounded down, error below 2^-32. It loses -log2(mass 2^-16) bits, so
 *        16 of 32 at worst; each value of the top 16 is equally likely.
 * Cost:  ceil(log2(used)) comparisons, two 32-bit divisions.
 */
uint16_t ql_table_pick(
        const uint16_t *row, ql_uq32_t u, ql_uq32_t *rest, uint32_t *mass);

/* Put a place within a cell on the whole interval.
 *
 *   cell    0..count-1
 *   rest    uq32 [0,1)  where in the cell
 *   count   cells       1 or more
 *   return  uq32        (cell + rest) / count; floor(x count) is cell again
 *
 * Error: within 2^-32.
 * Cost:  two 32-bit divisions, one multiplication.
 */
ql_uq32_t ql_table_position(uint16_t cell, ql_uq32_t rest, uint16_t count);

/* Draw a point with the density of the table.
 *
 *   table   -           from ql_table_open()
 *   u       uq32 [0,1)  dims uniform numbers: u[0] for x, u[1] for y, ...
 *   point   -           out: where, in which cell, and its mass; what is beyond
 *                       dims is 0
 *
 * Exact: as ql_table_pick(), so a cell is chosen with probability its mass; a
 *        cell, row or layer without mass is never entered. x is monotone in
 *        u[0] for a given row, y in u[1] for a given layer, and z in u[2].
 * Cost:  dims times that of ql_table_pick() and ql_table_position().
 */
void ql_table_sample(
        const ql_table_t *table, const ql_uq32_t *u, ql_table_point_t *point);

/* Mass of one cell.
 *
 *   table   -         from ql_table_open()
 *   cell    cells     dims numbers; one out of range has no mass
 *   return  2^(-16 dims)  0..2^(16 dims)
 *
 * Exact: over all cells the masses sum to 2^(16 dims).
 */
uint64_t ql_table_mass(const ql_table_t *table, const uint16_t *cell);

/* Density of a point whose cell has this mass, per unit length, area or volume.
 *
 *   table   -             from ql_table_open()
 *   mass    2^(-16 dims)  from ql_table_sample() or ql_table_mass()
 *   return  real          mass times the number of cells; 0 for 0
 *
 * Error: none in one dimension; relative error in (-2^-29, 0] in two, in
 *        (-2^-28, 0] in three.
 */
ql_real_t ql_table_density(const ql_table_t *table, uint64_t mass);

/* Density at a point: what ql_table_sample() gives with it.
 *
 *   table   -           from ql_table_open()
 *   x       uq32 [0,1)  dims numbers
 *   return  real        as ql_table_density(); 0 where points are never drawn
 *
 * Cost:  dims multiplications for the cell, dims more for the mass.
 */
ql_real_t ql_table_pdf(const ql_table_t *table, const ql_uq32_t *x);

#endif
