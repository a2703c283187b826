/* ql_next_event.h - next-event estimation: light drawn towards the emitters */
/* SPDX-License-Identifier: MIT */

#ifndef QL_NEXT_EVENT_H
#define QL_NEXT_EVENT_H

#include "render/ql_context.h"

#if QL_CFG_LIGHTS
/* Estimate the light that a surface reflects from the emitters by points or
 * directions drawn towards them, and add it to the pixel. The strategies AREA,
 * SOLID_ANGLE and MIS do; others, and a scene without emitters, add nothing.
 *
 *   context  -  as every part of a path has it
 *   vertex   -  on the surface, which has a lobe that is not specular
 *
 * Adds f cos Le V / (P pdf), for each emitter drawn. Of a flat diffuse surface
 * and a triangle's area it is reflected Le (n.w)(-N.w) V / (2 pi P |w|^4), w
 * from the vertex to the point, n the unit normal, N = e1 x e2 of the emitter:
 * reflected/pi Le cos cos' / r^2 divided by the pdf P/area, with the square
 * roots cancelled. Exactly zero if either side faces away.
 * Error: relative 2^-26 and the rounding of the sum; directions add 2^-27, a
 *        sphere that is lit 2^-28.
 * Cost:  a shadow ray each, unless nothing can come from there.
 * From:  change of domain to the emitters' area.
 */
void ql_next_event(const ql_context_t *context, const ql_vertex_t *vertex);
#else
QL_INLINE void ql_next_event(
        const ql_context_t *context, const ql_vertex_t *vertex)
{
    (void)context;
    (void)vertex;
}
#endif

#endif
