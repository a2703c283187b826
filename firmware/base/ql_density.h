/* ql_density.h - the densities by which a surface draws directions */
/* SPDX-License-Identifier: MIT */

#ifndef QL_DENSITY_H
#define QL_DENSITY_H

/* A density per solid angle. It says how one ray is drawn; ql_indirect_t and
 * ql_direct_t, which a user chooses, say what rays are drawn for. */
typedef enum {
    QL_DENSITY_NONE,    /* no ray is drawn */
    QL_DENSITY_COSINE,  /* proportional to the cosine */
    QL_DENSITY_UNIFORM, /* uniform on the hemisphere */
    QL_DENSITY_BRDF     /* proportional to BRDF and cosine */
} ql_density_t;

#endif
