/* ql_contact.h - hit points that nothing is in front of */
/* SPDX-License-Identifier: MIT */

/* A hit point is a few units of a position off the place that was hit, so it
 * may lie behind another surface that comes within as many units of that place.
 * The scene compiler says which triangles and spheres have such a neighbour at
 * their inside; at the edges every triangle may have one. Only there the point
 * is tested, with a segment. The proof is in DESIGN.md. */

#ifndef QL_CONTACT_H
#define QL_CONTACT_H

#include "scene/ql_scene.h"
#include "trace/ql_bvh.h"

#if QL_CFG_CONTACT && !QL_CFG_SMALL
/* Can nothing be near a point of a triangle?
 *
 *   scene    -     open
 *   tri_idx  -     the triangle
 *   edges    grid  of the triangle
 *   n        -     e1 x e2 or its negative
 *   p        pos   moved from a point of the triangle by ql_surface_at()
 *   return   true if the scene has no contacts, or if the triangle has none at
 *            its inside and p is QL_CONTACT_EDGE units or more from each edge
 *
 * Seen along the dominant axis of n; a distance from an edge (x, y) counts as
 * the cross product over |x| + |y|, which is the true one or less.
 * Cost: six products of 32 bits.
 */
bool ql_contact_is_clear(const ql_scene_t *scene, uint16_t tri_idx,
        const ql_edges_t *edges, const ql_vec3_t *n, const ql_vec3_t *p);

/* Can nothing be near any point of a sphere, or of the inside of a triangle?
 *
 *   scene    -  open
 *   tri_idx  -  the entry of the table of triangles
 */
QL_INLINE bool ql_contact_has_none(const ql_scene_t *scene, uint16_t tri_idx)
{
    return scene->contacts == NULL ||
           (QL_LE16(scene->contacts[tri_idx >> 4]) >> (tri_idx & 15u) & 1) == 0;
}

#else
/* Small builds look everywhere: it takes longer and gives the same points. */
QL_INLINE bool ql_contact_has_none(const ql_scene_t *scene, uint16_t tri_idx)
{
    return (void)tri_idx, ql_scene_contacts(scene) == NULL;
}

QL_INLINE bool ql_contact_is_clear(const ql_scene_t *scene, uint16_t tri_idx,
        const ql_edges_t *edges, const ql_vec3_t *n, const ql_vec3_t *p)
{
    return (void)edges, (void)n, (void)p, ql_contact_has_none(scene, tri_idx);
}
#endif

#if QL_CFG_CONTACT
/* Does a segment meet nothing, at its far end too?
 *
 *   scene     -    open
 *   from, to  pos  its ends; from lies on no surface
 *   but       -    what does not count; QL_TRI_MAX for nothing
 */
QL_INLINE bool ql_contact_is_free(const ql_scene_t *scene,
        const ql_vec3_t *from, const ql_vec3_t *to, uint16_t but)
{
    ql_ray_t way;

    way.origin = *from;
    way.direction = ql_vec_sub(*to, *from);
    return !ql_bvh_touches(scene, &way, but);
}
#else
QL_INLINE bool ql_contact_is_free(const ql_scene_t *scene,
        const ql_vec3_t *from, const ql_vec3_t *to, uint16_t but)
{
    return (void)scene, (void)from, (void)to, (void)but, true;
}
#endif

#endif
