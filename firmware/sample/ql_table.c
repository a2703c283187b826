/* ql_table.c - tabulated distributions in one, two and three dimensions */
/* SPDX-License-Identifier: MIT */

#include "sample/ql_table.h"

/* c_i; the bound of a cell in use. */
static uint32_t begin_of(const uint16_t *row, uint32_t cell)
{
    return cell == 0 ? 0 : (uint32_t)QL_LE16(row[cell]);
}

/* c_(i+1) of the same cell. */
static uint32_t end_of(const uint16_t *row, uint32_t cell)
{
    return cell + 1 < (uint32_t)QL_LE16(row[0])
                   ? (uint32_t)QL_LE16(row[cell + 1])
                   : QL_TABLE_WHOLE;
}

static uint32_t mass_of(const uint16_t *row, uint32_t cell)
{
    return cell < (uint32_t)QL_LE16(row[0])
                   ? end_of(row, cell) - begin_of(row, cell)
                   : 0;
}

/* Bounds that never decrease, and at least one cell if it can be entered. */
static bool row_is_sound(const uint16_t *row, uint16_t count, bool entered)
{
    const uint32_t used = QL_LE16(row[0]);
    uint32_t before = 0;

    if (used > count || (used == 0 && entered)) {
        return false;
    }
    for (uint32_t i = 1; i < used; i++) {
        const uint32_t bound = QL_LE16(row[i]);

        if (bound < before) {
            return false;
        }
        before = bound;
    }
    return true;
}

/* Words of a table, up to 2^48 + 2^32 + 2^16. */
static uint64_t words_of(unsigned dims, const uint16_t *count)
{
    uint64_t rows = 1, words = 0;

    for (unsigned d = dims; d-- > 0;) {
        rows *= count[d];
        words += rows;
    }
    return words;
}

/* Check the rows of one dimension, each against the cell it belongs to. */
static bool level_is_sound(const uint16_t *above, uint16_t above_count,
        const uint16_t *rows, uint16_t count, uint32_t n_rows)
{
    uint16_t cell = 0;

    for (uint32_t r = 0; r < n_rows; r++) {
        const bool entered = above == NULL || mass_of(above, cell) > 0;

        if (!row_is_sound(rows, count, entered)) {
            return false;
        }
        rows += count;
        if (above != NULL && ++cell == above_count) {
            cell = 0;
            above += above_count;
        }
    }
    return true;
}

ql_status_t ql_table_open(ql_table_t *table, const uint16_t *words,
        uint32_t n_words, unsigned dims, const uint16_t *count)
{
    const uint16_t *above = NULL;
    uint16_t above_count = 0;
    uint32_t n_rows = 1;

    if (dims < 1 || dims > QL_TABLE_DIMS_MAX) {
        return QL_ERR_RANGE;
    }
    for (unsigned d = 0; d < QL_TABLE_DIMS_MAX; d++) {
        table->count[d] = d < dims ? count[d] : 1;
        if (table->count[d] == 0) {
            return QL_ERR_RANGE;
        }
    }
    if (words_of(dims, table->count) > n_words) {
        return QL_ERR_TRUNCATED;
    }
    table->words = words;
    table->dims = (uint8_t)dims;
    for (unsigned d = dims; d-- > 0;) {
        if (!level_is_sound(
                    above, above_count, words, table->count[d], n_rows)) {
            return QL_ERR_RANGE;
        }
        above = words;
        above_count = table->count[d];
        n_rows *= above_count; /* <= n_words, as the words of this level */
        words += n_rows;
    }
    return QL_OK;
}

uint16_t ql_table_pick(
        const uint16_t *row, ql_uq32_t u, ql_uq32_t *rest, uint32_t *mass)
{
    const uint32_t v = u >> 16;
    uint32_t low = 0, high = QL_LE16(row[0]);
    uint32_t within, whole;

    QL_ASSERT(high > 0);
    /* Invariant: c_low <= v < c_high, taking c_used as 2^16. */
    while (high - low > 1) {
        const uint32_t mid = (low + high) / 2;

        if ((uint32_t)QL_LE16(row[mid]) <= v) {
            low = mid;
        } else {
            high = mid;
        }
    }

    /* c_low <= v < c_(low+1) in whatever row, so the mass is 1 or more. */
    *mass = end_of(row, low) - begin_of(row, low);
    within = u - (begin_of(row, low) << 16); /* < mass 2^16 */

    /* floor((within + 1/2) 2^16 / mass), digit by digit in base 2^16: both
     * quotients are below 2^16, and the remainder is below mass <= 2^16 */
    whole = within / *mass;
    *rest = whole << 16 | ((within - whole * *mass) << 16 | 0x8000u) / *mass;
    return (uint16_t)low;
}

ql_uq32_t ql_table_position(uint16_t cell, ql_uq32_t rest, uint16_t count)
{
    /* floor((cell 2^32 + rest) / count), digit by digit as above */
    const uint32_t n = count, top = (uint32_t)cell << 16 | rest >> 16;
    const uint32_t high = top / n;
    const uint32_t low = ((top - high * n) << 16 | (rest & 0xffffu)) / n;
    const ql_uq32_t x = high << 16 | low;

    /* The first place of a cell that is no multiple of 2^-32 is rounded up, so
     * that it is looked up in this cell. */
    return x + (ql_mulhi_u32(x, n) != cell);
}

void ql_table_sample(
        const ql_table_t *table, const ql_uq32_t *u, ql_table_point_t *point)
{
    const uint16_t *rows = table->words; /* of this dimension */
    uint32_t row = 0, n_rows = 1;

    point->mass = 1;
    for (unsigned d = QL_TABLE_DIMS_MAX; d-- > 0;) {
        const uint16_t n = table->count[d];
        ql_uq32_t rest;
        uint32_t mass;

        point->x[d] = 0;
        point->cell[d] = 0;
        if (d < table->dims) {
            point->cell[d] = ql_table_pick(rows + row * n, u[d], &rest, &mass);
            point->x[d] = ql_table_position(point->cell[d], rest, n);
            point->mass *= mass; /* <= 2^48 */
            row = row * n + point->cell[d];
            n_rows *= n;
            rows += n_rows;
        }
    }
}

uint64_t ql_table_mass(const ql_table_t *table, const uint16_t *cell)
{
    const uint16_t *rows = table->words;
    uint32_t row = 0, n_rows = 1;
    uint64_t mass = 1;

    for (unsigned d = table->dims; d-- > 0;) {
        const uint16_t n = table->count[d];
        const uint32_t part = mass_of(rows + row * n, cell[d]);

        /* below a row without mass there may be anything */
        if (part == 0) {
            return 0;
        }
        mass *= part;
        row = row * n + cell[d];
        n_rows *= n;
        rows += n_rows;
    }
    return mass;
}

ql_real_t ql_table_density(const ql_table_t *table, uint64_t mass)
{
    ql_real_t pdf = ql_real_from_u64(mass);

    if (pdf.m == 0) {
        return pdf;
    }
    /* in one dimension 16 significant bits times 16: no bit is lost */
    for (unsigned d = 0; d < table->dims; d++) {
        pdf = ql_real_mul(pdf, ql_real_from_u64(table->count[d]));
    }
    return ql_real_scale(pdf, -16 * (int32_t)table->dims);
}

ql_real_t ql_table_pdf(const ql_table_t *table, const ql_uq32_t *x)
{
    uint16_t cell[QL_TABLE_DIMS_MAX];

    for (unsigned d = 0; d < table->dims; d++) {
        cell[d] = (uint16_t)ql_mulhi_u32(x[d], table->count[d]);
    }
    return ql_table_density(table, ql_table_mass(table, cell));
}
