/* contacts.h - which faces have another that comes near their inside */
/* SPDX-License-Identifier: MIT */

/* The core puts a hit point up to 3.2 grid units off the place that was hit, in
 * draft, so another face may be in between. It looks for one where the point is
 * near an edge of its own triangle, and where the table made here says so. The
 * numbers and why they suffice are in firmware/DESIGN.md. */

#ifndef CONTACTS_H
#define CONTACTS_H

#include "scene/mesh/bvh.h"
#include "scene/mesh/grid.h"

/* Find the faces that have to be marked: in front of the inside of a triangle,
 * or behind it, another face comes within 3.5 units, seen along the dominant
 * axis of its normal. The inside begins 2.5 units from the edges, as
 * ql_contact_is_clear() has distances. A sphere is marked if anything comes
 * within 8 units of it on each axis, or if it is small. A face in the same
 * plane is neither in front nor behind.
 *
 *   grid    -  complete
 *   bvh     -  of it
 *   return     a bit for each face in the order of bvh, 16 a word, from
 *              malloc(); NULL if no face has another within 8 units that is not
 *              in its plane, and none is a small sphere
 *
 * Errs on the side of marks only: what is within rounding is near.
 */
uint16_t *contacts_find(const grid_t *grid, const bvh_t *bvh);

#endif
