/* built.h - a choice of each kind that this build has */
/* SPDX-License-Identifier: MIT */

#ifndef BUILT_H
#define BUILT_H

#include "base/ql_settings.h"
#include "base/ql_format.h"

/* A pixel format: the first. A line of it is no longer than one of RGB888. */
#define BUILT_FORMAT                                                           \
    (QL_CFG_FORMATS & 1          ? QL_FORMAT_RGB888                            \
            : QL_CFG_FORMATS & 2 ? QL_FORMAT_RGB565_LE                         \
            : QL_CFG_FORMATS & 4 ? QL_FORMAT_RGB565_BE                         \
            : QL_CFG_FORMATS & 8 ? QL_FORMAT_GRAY8                             \
                                 : QL_FORMAT_GRAY4)

/* Is a format, a ql_sampler_kind_t, a ql_direct_t, a ql_light_choice_t built
 * in? Every build of the tests has area and power. */
#define BUILT_HAS_FORMAT(format)   ((QL_CFG_FORMATS >> (format)&1) != 0)
#define BUILT_HAS_SAMPLER(sampler) ((QL_CFG_SAMPLERS >> (sampler)&1) != 0)
#define BUILT_HAS_DIRECT(direct)   ((QL_CFG_DIRECT >> (direct)&1) != 0)
#define BUILT_HAS_LIGHTS(choice)   ((QL_CFG_LIGHT_CHOICES >> (choice)&1) != 0)

/* A path of so many bounces, or what there is of it. */
#define BUILT_BOUNCES(bounces) ((uint8_t)(QL_CFG_INDIRECT ? (bounces) : 0))

#endif
