/* ql_contact.c - hit points that nothing is in front of */
/* SPDX-License-Identifier: MIT */

#include "trace/surface/ql_contact.h"

#if QL_CFG_CONTACT && !QL_CFG_SMALL

/* How far from each edge, see ql_contact_is_clear(). */
QL_FAST_INLINE int32_t edge_margin(int32_t x, int32_t y)
{
    return (int32_t)(QL_CONTACT_EDGE * (ql_abs32(x) + ql_abs32(y)));
}

/* Put z into the place of the dominant axis, which leaves x and y. */
QL_FAST_INLINE void flatten(ql_vec3_t *v, unsigned axis)
{
    if (axis == 0) {
        v->x = v->z;
    } else if (axis == 1) {
        v->y = v->z;
    }
}

bool ql_contact_is_clear(const ql_scene_t *scene, uint16_t tri_idx,
        const ql_edges_t *edges, const ql_vec3_t *n, const ql_vec3_t *p)
{
    const uint32_t ax = ql_abs32(n->x), ay = ql_abs32(n->y);
    const uint32_t az = ql_abs32(n->z);
    const unsigned axis = ax >= ay && ax >= az ? 0 : ay >= az ? 1 : 2;
    ql_vec3_t a = edges->e1, b = edges->e2, s;
    int32_t whole, from_a, from_b;

    if (ql_scene_contacts(scene) == NULL) {
        return true;
    }
    if (!ql_contact_has_none(scene, tri_idx)) {
        return false;
    }
    s.x = ql_asr32(p->x, QL_POS_BITS) - edges->v0.x;
    s.y = ql_asr32(p->y, QL_POS_BITS) - edges->v0.y;
    s.z = ql_asr32(p->z, QL_POS_BITS) - edges->v0.z;
    flatten(&a, axis);
    flatten(&b, axis);
    flatten(&s, axis);
    /* edges are <= 32751 and s <= 32767, so each product is < 2^30 and each
     * difference at least 2^20 below 2^31: room for a margin */
    whole = a.x * b.y - a.y * b.x;
    from_a = a.x * s.y - a.y * s.x;
    from_b = s.x * b.y - s.y * b.x;
    if (whole < 0) {
        whole = -whole;
        from_a = -from_a;
        from_b = -from_b;
    }
    /* the third edge is as far as what is left of the whole */
    return from_a >= edge_margin(a.x, a.y) && from_b >= edge_margin(b.x, b.y) &&
           whole - from_a - edge_margin(b.x - a.x, b.y - a.y) >= from_b;
}

#endif
