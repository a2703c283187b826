/* warp_cells.c - distributions over entries and cells, and their masses */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <string.h>

#include "lib/program/cli.h"
#include "sample/ql_cdf.h"
#include "lib/math/build_table.h"
#include "warp/warps.h"

#define TWO_31 2147483648.0 /* 2^31 */
#define TWO_32 4294967296.0 /* 2^32 */

/* Entries, some of no weight, the first and last among them. */
static void entry_weights(warp_cells_t *cells)
{
    static const double weights[16] = {
            0, 3, 1, 0, 6, 9, 4, 2, 0, 12, 7, 5, 1, 2, 1, 0};

    cells->dims = 1;
    cells->count[0] = 16;
    memcpy(cells->wanted, weights, sizeof weights);
}

/* Two hills and nothing between. */
static void line_weights(warp_cells_t *cells)
{
    cells->dims = 1;
    cells->count[0] = 32;
    for (int i = 0; i < 32; i++) {
        const double x = (i + 0.5) / 32;
        const double a = 1 - fabs(x - 0.28) / 0.26;
        const double b = 1 - (x - 0.76) * (x - 0.76) / 0.04;

        cells->wanted[i] = fmax(0, a) + 0.6 * fmax(0, b);
    }
}

/* A sky with a sun over ground that sheds no light. */
static void plane_weights(warp_cells_t *cells)
{
    cells->dims = 2;
    cells->count[0] = 20;
    cells->count[1] = 16;
    for (int i = 0; i < 20 * 16; i++) {
        const double x = (i % 20 + 0.5) / 20, y = (i / 20 + 0.5) / 16;
        const double dx = x - 0.68, dy = y - 0.7;
        const double sun = exp(-60 * (dx * dx + dy * dy));

        cells->wanted[i] = i / 20 < 4 ? 0 : 0.25 + 0.5 * (1 - y) + 5 * sun;
    }
}

/* A shell, empty inside and outside. */
static void space_weights(warp_cells_t *cells)
{
    cells->dims = 3;
    cells->count[0] = cells->count[1] = 8;
    cells->count[2] = 6;
    for (int i = 0; i < 8 * 8 * 6; i++) {
        const double x = (i % 8 + 0.5) / 8 - 0.5, z = (i / 64 + 0.5) / 6 - 0.5;
        const double y = (i / 8 % 8 + 0.5) / 8 - 0.5;
        const double r = sqrt(x * x + y * y + z * z);

        cells->wanted[i] = fmax(0, 1 - fabs(r - 0.36) / 0.2);
    }
}

static void need(table_error_t error)
{
    if (error != TABLE_OK) {
        cli_fail(CLI_INPUT, "no table: %s", table_error_text(error));
    }
}

/* Fill what follows from dims, the counts and the weights wanted. */
static void finish_cells(warp_cells_t *cells)
{
    double sum = 0;

    cells->n = 1;
    for (unsigned d = 0; d < QL_TABLE_DIMS_MAX; d++) {
        cells->count[d] = cells->count[d] > 0 ? cells->count[d] : 1;
        cells->n *= cells->count[d];
    }
    for (uint32_t i = 0; i < cells->n; i++) {
        sum += cells->wanted[i];
    }
    for (uint32_t i = 0; i < cells->n; i++) {
        cells->wanted[i] /= sum;
    }
}

static void discrete_setup(warp_setup_t *s)
{
    warp_cells_t *c = &s->cells;
    uint32_t bound = 0;

    entry_weights(c);
    finish_cells(c);
    need(table_shares(c->shares, c->wanted, c->n, 31));
    for (uint32_t i = 0; i < c->n; i++) {
        c->mass[i] = c->shares[i] / TWO_31;
        c->bounds[i] = bound;
        bound += 2 * c->shares[i]; /* 2^32, so 0, only after the last */
        c->used = c->shares[i] > 0 ? (uint16_t)(i + 1) : c->used;
    }
}

static void alias_setup(warp_setup_t *s)
{
    warp_cells_t *c = &s->cells;

    discrete_setup(s);
    need(alias_build(c->alias_words, c->shares, c->n, &c->alias.total));
    c->alias.words = c->alias_words;
    c->alias.count = (uint16_t)c->n;
}

static void table_setup(warp_setup_t *s)
{
    warp_cells_t *c = &s->cells;
    uint32_t words;

    finish_cells(c);
    words = table_words(c->dims, c->count);
    need(table_build(c->table_words, c->wanted, c->dims, c->count));
    if (ql_table_open(&c->table, c->table_words, words, c->dims, c->count) !=
            QL_OK) {
        cli_fail(CLI_INPUT, "the core refuses a table");
    }
    for (uint32_t i = 0; i < c->n; i++) {
        const uint32_t row = i / c->count[0];
        const uint16_t cell[3] = {(uint16_t)(i % c->count[0]),
                (uint16_t)(row % c->count[1]), (uint16_t)(row / c->count[1])};

        c->mass[i] = ldexp(
                (double)ql_table_mass(&c->table, cell), -16 * (int)c->dims);
    }
}

static void line_setup(warp_setup_t *s)
{
    line_weights(&s->cells);
    table_setup(s);
}

static void plane_setup(warp_setup_t *s)
{
    plane_weights(&s->cells);
    table_setup(s);
}

static void space_setup(warp_setup_t *s)
{
    space_weights(&s->cells);
    table_setup(s);
}

static void put_entry(const warp_setup_t *s, uint16_t entry, warp_point_t *p)
{
    p->x[0] = entry;
    p->inside = entry < s->cells.n;
    p->density = p->inside ? s->cells.shares[entry] / TWO_31 : 0;
}

static void discrete_draw(
        const warp_setup_t *s, const uint32_t *u, warp_point_t *p)
{
    put_entry(s, ql_cdf_sample(s->cells.bounds, 1, s->cells.used, u[0]), p);
}

static void alias_draw(
        const warp_setup_t *s, const uint32_t *u, warp_point_t *p)
{
    uint32_t weight;

    put_entry(s, ql_alias_sample(&s->cells.alias, u[0], u[1], &weight), p);
    p->density = weight / TWO_31;
}

/* An entry spreads over its share; its middle stands for it. */
static void entry_invert(const warp_setup_t *s, const double *x, double *c)
{
    const uint32_t i = (uint32_t)x[0];

    c[0] = s->cells.bounds[i] / TWO_32 + s->cells.mass[i] / 2;
}

static double entry_density(const warp_setup_t *s, const double *x)
{
    return s->cells.mass[(uint32_t)x[0]];
}

static void entry_moments(const warp_setup_t *s, warp_moments_t *m)
{
    memset(m, 0, sizeof *m);
    for (uint32_t i = 0; i < s->cells.n; i++) {
        m->mean[0] += i * s->cells.mass[i];
        m->second[0] += (double)i * i * s->cells.mass[i];
    }
}

static void table_draw(
        const warp_setup_t *s, const uint32_t *u, warp_point_t *p)
{
    const warp_cells_t *c = &s->cells;
    ql_table_point_t point;

    ql_table_sample(&c->table, u, &point);
    for (unsigned d = 0; d < c->dims; d++) {
        p->x[d] = (point.x[d] + 0.5) / TWO_32;
    }
    p->inside = true;
    p->density = warp_real(ql_table_density(&c->table, point.mass));
}

/* Cell of a place, and where in it along each axis. */
static void locate(
        const warp_cells_t *c, const double *x, uint32_t *cell, double *rest)
{
    for (unsigned d = 0; d < 3; d++) {
        const double at = d < c->dims ? x[d] * c->count[d] : 0;

        cell[d] = (uint32_t)at < c->count[d] ? (uint32_t)at : 0;
        rest[d] = at - cell[d];
    }
}

static double mass_of_block(const warp_cells_t *c, uint32_t first, uint32_t n)
{
    double sum = 0;

    for (uint32_t i = 0; i < n; i++) {
        sum += c->mass[first + i];
    }
    return sum;
}

/* Along each axis, the share of what lies before within the row, layer or
 * whole: the conditional distribution functions. */
static void table_invert(const warp_setup_t *s, const double *x, double *out)
{
    const warp_cells_t *c = &s->cells;
    const uint32_t sizes[4] = {
            1, c->count[0], (uint32_t)c->count[0] * c->count[1], c->n};
    uint32_t cell[3], first = 0;
    double rest[3];

    locate(c, x, cell, rest);
    for (unsigned d = 3; d-- > 0;) {
        const double whole = mass_of_block(c, first, sizes[d + 1]);
        const double before = mass_of_block(c, first, cell[d] * sizes[d]);
        double own;

        first += cell[d] * sizes[d];
        own = mass_of_block(c, first, sizes[d]);
        if (d < c->dims) {
            out[d] = (before + rest[d] * own) / whole;
        }
    }
}

static double table_density(const warp_setup_t *s, const double *x)
{
    const warp_cells_t *c = &s->cells;
    uint32_t cell[3];
    double rest[3];

    locate(c, x, cell, rest);
    return c->n *
           c->mass[(cell[2] * c->count[1] + cell[1]) * c->count[0] + cell[0]];
}

static void table_moments(const warp_setup_t *s, warp_moments_t *m)
{
    const warp_cells_t *c = &s->cells;

    memset(m, 0, sizeof *m);
    for (uint32_t i = 0; i < c->n; i++) {
        const uint32_t row = i / c->count[0];
        double middle[3] = {(i % c->count[0] + 0.5) / c->count[0],
                (row % c->count[1] + 0.5) / c->count[1],
                (row / c->count[1] + 0.5) / c->count[2]};

        for (unsigned d = c->dims; d < 3; d++) {
            middle[d] = 0;
        }
        warp_add_moments(middle, c->mass[i], m);
        for (unsigned d = 0; d < c->dims; d++) { /* of the cell itself */
            m->second[d] += c->mass[i] / 12 / c->count[d] / c->count[d];
        }
    }
}

const warp_t warps_over_cells[] = {
        {.name = "discrete",
                .domain = "16 entries",
                .density = "w / (sum of w) per entry",
                .source = "prefix sums, search",
                .kind = WARP_ENTRY,
                .dims = 1,
                .numbers = 1,
                .setup = discrete_setup,
                .draw = discrete_draw,
                .invert = entry_invert,
                .density_at = entry_density,
                .moments = entry_moments},
        {.name = "alias",
                .domain = "16 entries",
                .density = "w / (sum of w) per entry",
                .source = "Walker 1977, Vose 1991",
                .kind = WARP_ENTRY,
                .dims = 1,
                .numbers = 2,
                .lecture = true,
                .setup = alias_setup,
                .draw = alias_draw,
                .invert = entry_invert,
                .density_at = entry_density,
                .moments = entry_moments},
        {.name = "table-1d",
                .domain = "[0, 1), 32 cells",
                .density = "n w / (sum of w) per length",
                .source = "inversion",
                .kind = WARP_TABLE,
                .dims = 1,
                .numbers = 1,
                .setup = line_setup,
                .draw = table_draw,
                .invert = table_invert,
                .density_at = table_density,
                .moments = table_moments},
        {.name = "table-2d",
                .domain = "[0, 1)^2, 20 x 16 cells",
                .density = "n w / (sum of w) per area",
                .source = "marginal, conditional",
                .kind = WARP_TABLE,
                .dims = 2,
                .numbers = 2,
                .setup = plane_setup,
                .draw = table_draw,
                .invert = table_invert,
                .density_at = table_density,
                .moments = table_moments},
        {.name = "table-3d",
                .domain = "[0, 1)^3, 8 x 8 x 6",
                .density = "n w / (sum of w) per volume",
                .source = "marginal, conditional",
                .kind = WARP_TABLE,
                .dims = 3,
                .numbers = 3,
                .setup = space_setup,
                .draw = table_draw,
                .invert = table_invert,
                .density_at = table_density,
                .moments = table_moments},
        {.name = NULL},
};
