/* seen_phong.h - Phong surfaces: exponents, views, and exact albedos */
/* SPDX-License-Identifier: MIT */

#ifndef SEEN_PHONG_H
#define SEEN_PHONG_H

#include "support/seen_surface.h"

#if QL_CFG_PHONG
static const double exponents[] = {0, 1, 5, 20, 100, 1000, 65535};
static const double views[] = {0, 30, 45, 60, 75, 80, 85, 89};

enum { EXPONENTS = 7, VIEWS = 8 };

/* Albedo of the lobe with Ks = 1; the last row is the limit, cos. */
static const double albedos[EXPONENTS][VIEWS] = {
        {1, .9330127019, .8535533906, .75, .6294095226, .5868240888,
                .5435778714, .5087262032},
        {1, .8808427796, .7554091649, .6089977810, .4584415161, .4099452536,
                .3630974852, .3270845671},
        {1, .8662535765, .7103933491, .5194068355, .3271321791, .2692908026,
                .2165609213, .1786207365},
        {1, .8660254050, .7071102788, .5005094980, .2711785286, .2003418687,
                .1382931375, .0970929429},
        {1, .8660254038, .7071067812, .5000000006, .2589453621, .1752326235,
                .0976133604, .0491253640},
        {1, .8660254038, .7071067812, .5, .2588190451, .1736481778, .0871830044,
                .0232122927},
        {1, .8660254038, .7071067812, .5, .2588190451, .1736481777, .0871557427,
                .0174524064}};

static inline void set_phong(double kd, double ks, double n, double chance)
{
    set_albedo(kd, kd, kd);
    set_gloss(QL_GLOSS_PHONG, ks, n, chance);
}

static inline void check_density(int i, int k, double kd, double ks)
{
    const double exact = kd + ks * albedos[i][k];
    const estimate_t e = estimate(drawn_weight, 512);

    CHECK(fabs(e.mean - exact) <= WITHIN(e),
            "density %d, Kd %g, n = %g, %g degrees: %.6f +- %.6f, not %.6f",
            density, kd, exponents[i], views[k], e.mean, e.error, exact);
}
#endif

#endif
