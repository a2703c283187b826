/* ql_density.h - the densities by which a surface draws directions */
/* SPDX-License-Identifier: MIT */

#ifndef QL_DENSITY_H
#define QL_DENSITY_H

#include "base/ql_base.h"

/* A density per solid angle. It says how one ray is drawn; ql_indirect_t and
 * ql_direct_t, which a user chooses, say what rays are drawn for. */
typedef enum {
    QL_DENSITY_NONE,    /* no ray is drawn */
    QL_DENSITY_COSINE,  /* proportional to the cosine */
    QL_DENSITY_UNIFORM, /* uniform on the hemisphere */
    QL_DENSITY_BRDF,    /* proportional to BRDF and cosine */
    QL_DENSITY_SPECULAR /* along the one direction of a mirror or glass */
} ql_density_t;

/* Is it the uniform one? */
QL_INLINE bool ql_density_is_uniform(ql_density_t density)
{
    return QL_UNIFORM_DIRECTIONS && density == QL_DENSITY_UNIFORM;
}

#endif
