/* warps.h - the warps of the core as qlux-warp lists, draws and tests them */
/* SPDX-License-Identifier: MIT */

/* A warp takes uniform numbers to points of a domain. What is known of it in
 * closed form stands beside it in double, worked out without the core: density,
 * moments, and an inverse that takes its points back to uniform numbers. It
 * need not be the inverse of the same map, only of one with the same density,
 * so equal bins of what it returns are equally likely. */

#ifndef WARPS_H
#define WARPS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/ql_settings.h"
#include "sample/lecture/ql_alias.h"
#include "warp/ql_warp_spherical.h"
#include "sample/ql_table.h"

enum {
    WARP_NUMBERS = 4,    /* uniform numbers a draw may take */
    WARP_CELLS_MAX = 512 /* of a discrete distribution or table */
};

/* What a point is, so how it is shown. */
typedef enum {
    WARP_AXIAL,     /* unit vector whose density depends on its z only */
    WARP_DIRECTION, /* any other unit vector */
    WARP_DISK,      /* x, y */
    WARP_TRIANGLE,  /* weights of vertices 1 and 2 */
    WARP_TENT,      /* x, y */
    WARP_ENTRY,     /* index of an entry */
    WARP_TABLE      /* x; x, y; x, y, z in [0, 1) */
} warp_kind_t;

/* A distribution over cells: what it should be and what the core made of it. */
typedef struct {
    unsigned dims;
    uint16_t count[QL_TABLE_DIMS_MAX]; /* 1 beyond dims */
    uint32_t n;                        /* cells in all */
    double wanted[WARP_CELLS_MAX];     /* sums to 1 */
    double mass[WARP_CELLS_MAX];       /* as quantised; sums to 1 */
    uint32_t shares[WARP_CELLS_MAX];   /* of 2^31, for entries */
    uint32_t bounds[WARP_CELLS_MAX];   /* lower ones, u0.32 */
    uint16_t used;                     /* entries up to the last above 0 */
    uint32_t alias_words[WARP_CELLS_MAX * QL_ALIAS_WORDS];
    ql_alias_t alias;
    uint16_t table_words[2 * WARP_CELLS_MAX];
    ql_table_t table;
} warp_cells_t;

/* A warp's parameter and what follows from it. */
typedef struct {
    double parameter;
    ql_uq16_t power; /* m */
    ql_real_t inverse;
    ql_real_t s_max;      /* 1 - cos of a cone's half-angle */
    double corners[3][3]; /* of a spherical triangle, unit */
    ql_warp_spherical_t spherical;
    warp_cells_t cells;
} warp_setup_t;

typedef struct {
    double x[3];    /* see warp_kind_t */
    double density; /* as the core says it */
    bool inside;    /* of the domain, where the density is above 0 */
} warp_point_t;

/* Exact moments: of the coordinates, and of the products xx yy zz xy xz yz. */
typedef struct {
    double mean[3];
    double second[6];
} warp_moments_t;

typedef struct {
    const char *name;
    const char *domain;
    const char *density; /* with its measure */
    const char *source;
    warp_kind_t kind;
    unsigned dims;        /* coordinates of a point */
    unsigned numbers;     /* uniform numbers a draw takes */
    bool lecture;         /* it explains; the renderer does not use it */
    double density_floor; /* errors of lower densities are parts of this */

    /* parameters to test, and how one is called; the first is shown. None, and
     * no label, is one test of a warp without a parameter. */
    const char *label; /* printf format of a number, or NULL */
    unsigned n_parameters;
    double parameters[8];

    /* A hook that needs no setup is a plain one, and what never changes a
     * number; of each kind a warp has one. setup may be NULL. */
    void (*setup)(warp_setup_t *s);
    void (*draw)(const warp_setup_t *s, const uint32_t *u, warp_point_t *p);
    void (*draw_plain)(const uint32_t *u, warp_point_t *p);
    void (*invert)(const warp_setup_t *s, const double *x, double *c);
    void (*invert_plain)(const double *x, double *c);
    double (*density_at)(const warp_setup_t *s, const double *x);
    double (*density_plain)(const double *x);
    double density_const;
    void (*moments)(const warp_setup_t *s, warp_moments_t *m);
    warp_moments_t moments_const;
} warp_t;

/* Those over cells; the last has no name. */
extern const warp_t warps_over_cells[];

/* The warps one by one, in the order of the list; NULL after the last. */
const warp_t *warp_at(unsigned i);

/* The warp of this name, or NULL. */
const warp_t *warp_find(const char *name);

/* Prepare a warp for a parameter; cli_fail(CLI_INPUT) where it has none such.
 * A power counts as the core has it, a multiple of 2^-16. */
void warp_begin(const warp_t *warp, warp_setup_t *s, double parameter);

/* Draw a point by uniform numbers; take one back to such numbers; the density
 * at one; the moments. Each by the hook that the warp has. */
void warp_draw(const warp_t *warp, const warp_setup_t *s, const uint32_t *u,
        warp_point_t *p);
void warp_invert(
        const warp_t *warp, const warp_setup_t *s, const double *x, double *c);
double warp_density(const warp_t *warp, const warp_setup_t *s, const double *x);
void warp_moments(const warp_t *warp, const warp_setup_t *s, warp_moments_t *m);

/* A number of the core in double. */
double warp_real(ql_real_t r);

/* Add a point of this weight to sums of its coordinates and products. */
void warp_add_moments(const double *x, double weight, warp_moments_t *m);

/* Sine and 1 - cosine of the angle from z; the latter keeps its bits. */
double warp_sine(const double *x);
double warp_from_axis(const double *x);

/* Uniform numbers of sample index, of either sampler. */
void warp_numbers(ql_sampler_kind_t kind, uint32_t seed, uint32_t index,
        uint32_t u[WARP_NUMBERS]);

/* How well samples fit a density. */
typedef struct {
    double chi2, dof, chi2_p;
    double ks, ks_p;         /* of the marginal that fits least */
    double mean_error;       /* largest, of any coordinate */
    double second_error;     /* largest, of any product of two */
    double z;                /* largest of these errors, in its own sigmas */
    double density_error;    /* largest relative one of the core's density */
    uint32_t outside;        /* samples where the density is 0 */
    uint32_t cells, inexact; /* counted exactly, and those of a wrong count */
} warp_fit_t;

enum { WARP_TEST_SAMPLES = 1 << 20, WARP_TEST_BINS = 512 };

/* The exponent of cosine-power where none is given. */
#define WARP_POWER_DEFAULT 8.0

/* A random test is failed below this probability, and a moment beyond the z
 * that has it: one false alarm in a million. Seeds are fixed. */
#define WARP_P_MIN 1e-6
#define WARP_Z_MAX 4.9

/* Draw from a warp, by random numbers, and compare with the density of another,
 * or its own. */
void warp_measure(const warp_t *warp, const warp_setup_t *s, const warp_t *as,
        warp_fit_t *fit);

/* The command `test`: of one warp, or of all if it is NULL; of one parameter
 * if power >= 0. Returns an exit code. */
int warp_test(const warp_t *only, double power);

/* What drawing costs, counted: search against alias, analytic against table.
 * Returns false if the counted copies no longer agree with the core. */
bool cost_of_search(void);
bool cost_of_analytic(double power);

/* The command `plot`. */
void warp_plot(const warp_t *warp, double parameter, uint32_t n_samples,
        const char *path);

#endif
