/* ql_direct.h - light that comes straight from the emitters */
/* SPDX-License-Identifier: MIT */

#ifndef QL_DIRECT_H
#define QL_DIRECT_H

#include "render/ql_film.h"
#include "sample/ql_sampler.h"
#include "scene/ql_ray.h"
#include "scene/ql_scene.h"

/* Estimate the light that a surface reflects from the emitters, by one point
 * on one of them, and add it to a pixel.
 *
 *   scene      -     has lights
 *   sampler    -     started
 *   dim        -     QL_DIM_BOUNCE(k) of this vertex
 *   surface    -     the vertex, on the side it is seen from
 *   reflected  uq31  throughput times albedo, RGB
 *   sum        -     added to
 *   diag       -     counts
 *
 * Adds reflected Le (n.w)(-N.w) V / (2 pi P |w|^4), w from the vertex to the
 * point, n the unit normal, N = e1 x e2 of the emitter, P its probability: the
 * estimator reflected/pi Le cos cos' / r^2 divided by the pdf P/area, with the
 * square roots cancelled. Exactly zero if either side faces away.
 * Error: relative 2^-26 and the rounding of the sum.
 * From:  change of domain to the emitters' area; truth of the signs is exact.
 */
void ql_direct_area(const ql_scene_t *scene, const ql_sampler_t *sampler,
        uint32_t dim, const ql_surface_t *surface, const ql_uq31_t reflected[3],
        ql_sum_t *sum, ql_diag_t *diag);

#endif
