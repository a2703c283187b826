/* ql_diag.h - counters of what happened while rendering */
/* SPDX-License-Identifier: MIT */

#ifndef QL_DIAG_H
#define QL_DIAG_H

#include "base/ql_base.h"

/* What happened while rendering; never changes a pixel. */
typedef struct {
    uint32_t paths;
    uint32_t closest_rays;
    uint32_t shadow_rays;
    uint32_t saturated; /* contributions or sums cut at their limit */
    uint32_t faint;     /* contributions rounded by chance, paths that ended as
                           their throughput was rounded to zero */
} ql_diag_t;

#if QL_CFG_DIAG
#define QL_DIAG_COUNT(diag, counter) ((void)(diag)->counter++)
#else
#define QL_DIAG_COUNT(diag, counter) ((void)(diag))
#endif

/* What only a tool counts, in a copy of its own (tools/lib/cost): the work that
 * a path is made of. Nothing here. */
#ifndef QL_COUNT
#define QL_COUNT(event) ((void)0)
#endif

#endif
