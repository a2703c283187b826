/* ql_bvh.c - BVH traversal for both node widths */
/* SPDX-License-Identifier: MIT */

/* The box test. Let z be the ray's dominant axis and d its direction rounded to
 * 15 bits. In the planes (x, z) and (y, z) the ray is a line, and a box is a
 * rectangle of centre c and half h; with g = c - o the line meets it iff
 *     |g_x d_z - g_z d_x| <= h_x |d_z| + h_z |d_x|.
 * The plane (x, y) is left out, which costs a few boxes more and never loses a
 * hit. Along each axis the ray is an interval; boxes have integer bounds and
 * hits lie strictly between the ray's ends, so the integers strictly between
 * are enough (the origin itself if d = 0). Axis z is tested always and its
 * interval shortened by closest hits; axes x and y are tested before the
 * triangles of a leaf: they keep a ray from the surfaces where it begins and
 * ends. Each test is necessary for a hit, and none needs a division.
 *
 * Draft: o and d are the ray's own integers, so the line tests are exact.
 * Fine: o and d are rounded, by 1/2 at most. A ray that hits passes a point p
 * of the box inside the grid, so (p - o) x d = 0 in that plane; with o and d
 * rounded it is (|p_x - o_x| + |p_z - o_z| + |d_x| + |d_z|) / 2 at most, d as
 * rounded: below 2^16, the margin below. For p the box has room of its own.
 *
 * Bounds: c, o <= 32767, |d| <= 2^15, h <= 2^14. c_x d_z - c_z d_x and the same
 * of o are below 2^31 in size; their difference is the exact g product, taken
 * modulo 2^32, which is below 2^31 too. The right side is <= 2^30 + margin. */

#include "trace/ql_bvh.h"

#include "base/ql_diag.h"
#include "math/ql_real.h"
#include "trace/ql_hull.h"
#include "trace/ql_order.h"
#include "trace/ql_sphere.h"
#include "trace/ql_tri.h"

#if QL_POS_BITS == 0
#define MARGIN 0
#else
#define MARGIN 65536l
#endif

/* The integers an interval holds, as the test wants them: low..low + span. */
typedef struct {
    int32_t low, span;
} interval_t;

/* A ray in the plane of an axis x and the dominant one. */
typedef struct {
    uint8_t k;    /* byte offset of the axis into a box */
    int32_t d;    /* d_x, 15 bits */
    int32_t size; /* |d_x| */
    int32_t o;    /* o_x d_z - o_z d_x less the margin */
} plane_t;

/* A ray as the box test wants it. */
typedef struct {
    uint8_t kz;       /* byte offset of the dominant axis into a box */
    uint8_t backward; /* bit k: the direction is negative on axis k */
    int32_t dz;       /* 15 bits; > 0 */
    plane_t x, y;     /* of the other axes */
    interval_t z;     /* the ray's interval on axis z */
    int32_t start;    /* o_z, ql_pos_t */
    uint32_t size_z;  /* |d_z| of the ray itself */
} probe_t;

/* Do low..low + span and c - h..c + h have an integer in common? An empty
 * interval (span -1 or -2) and a flat box may be said to: that costs a test. */
QL_FAST_INLINE bool meets(interval_t i, int32_t c, int32_t h)
{
    return (uint32_t)(c + h - i.low) <= (uint32_t)(2 * h + i.span);
}

/* The grid integers strictly between o and o + d, or from o on to the edge of
 * the box. d = 0 has those around o. */
QL_INLINE interval_t interval_of(ql_pos_t o, int32_t d, bool segment)
{
    int32_t low = ql_asr32(o, QL_POS_BITS);
    int32_t high = ql_asr32(o + (1 << QL_POS_BITS) - 1, QL_POS_BITS);
    interval_t i;

    if (d > 0) {
        low++;
        high = segment ? ql_asr32(o + d - 1, QL_POS_BITS) : QL_GRID_MAX;
    } else if (d < 0) {
        low = segment ? ql_asr32(o + d, QL_POS_BITS) + 1 : 0;
        high--;
    }
    i.low = low;
    i.span = high - low;
    return i;
}

/* A ray along one axis. */
typedef struct {
    int32_t o, d; /* origin and direction */
    uint8_t k;    /* byte offset of the axis into a box */
} axis_t;

/* The line tests' numbers; z is the dominant axis, x and y the others. */
QL_INLINE void probe_axes(probe_t *p, axis_t x, axis_t y, axis_t z)
{
    int32_t ox = x.o, oy = y.o, oz = z.o;
    int32_t dx = x.d, dy = y.d, dz = z.d;
    const uint32_t az = ql_abs32(dz);

    p->x.k = x.k;
    p->y.k = y.k;
    p->kz = z.k;
    p->start = oz;
    p->size_z = az;
#if QL_POS_BITS > 0
    /* round the origin to the grid and the direction to 15 bits */
    ox = (ox + (1 << (QL_POS_BITS - 1))) >> QL_POS_BITS;
    oy = (oy + (1 << (QL_POS_BITS - 1))) >> QL_POS_BITS;
    oz = (oz + (1 << (QL_POS_BITS - 1))) >> QL_POS_BITS;
    if (az > 32767u) {
        const unsigned excess = 17 - ql_clz32(az);
        const int32_t round = (int32_t)1 << (excess - 1);

        dx = ql_asr32(dx + round, excess);
        dy = ql_asr32(dy + round, excess);
        dz = ql_asr32(dz + round, excess);
    }
#endif
    if (dz < 0) {
        dx = -dx;
        dy = -dy;
        dz = -dz;
    }
    p->dz = dz;
    p->x.d = dx;
    p->x.size = (int32_t)ql_abs32(dx);
    p->x.o = ox * dz - oz * dx - MARGIN;
    p->y.d = dy;
    p->y.size = (int32_t)ql_abs32(dy);
    p->y.o = oy * dz - oz * dy - MARGIN;
}

#if QL_CFG_SMALL
/* Loops over the axes: 260 bytes less on a Cortex-M0 than a call of
 * probe_axes() for each dominant axis, and slower. */
static QL_NOINLINE void probe_begin(
        probe_t *p, interval_t axes[3], const ql_ray_t *ray, bool segment)
{
    const ql_vec3_t d = ray->direction, o = ray->origin;
    const axis_t of[3] = {{o.x, d.x, 0}, {o.y, d.y, 2}, {o.z, d.z, 4}};
    const uint32_t ax = ql_abs32(d.x), ay = ql_abs32(d.y), az = ql_abs32(d.z);
    const uint8_t z = az >= ax && az >= ay ? 2 : ay >= ax ? 1 : 0;

    p->backward = 0;
    for (unsigned k = 0; k < 3; k++) {
        p->backward = (uint8_t)(p->backward | (of[k].d < 0) << k);
        axes[k] = interval_of(of[k].o, of[k].d, segment);
    }
    probe_axes(p, of[z == 0 ? 1 : 0], of[z == 2 ? 1 : 2], of[z]);
    p->z = axes[z];
}
#else
static QL_NOINLINE void probe_begin(
        probe_t *p, interval_t axes[3], const ql_ray_t *ray, bool segment)
{
    const ql_vec3_t d = ray->direction, o = ray->origin;
    const axis_t x = {o.x, d.x, 0}, y = {o.y, d.y, 2}, z = {o.z, d.z, 4};
    const uint32_t ax = ql_abs32(d.x), ay = ql_abs32(d.y), az = ql_abs32(d.z);

    p->backward = (uint8_t)((d.x < 0) | (d.y < 0) << 1 | (d.z < 0) << 2);
    if (az >= ax && az >= ay) {
        probe_axes(p, x, y, z);
    } else if (ay >= ax) {
        probe_axes(p, x, z, y);
    } else {
        probe_axes(p, y, z, x);
    }
    axes[0] = interval_of(o.x, d.x, segment);
    axes[1] = interval_of(o.y, d.y, segment);
    axes[2] = interval_of(o.z, d.z, segment);
    p->z = axes[p->kz >> 1];
}
#endif

QL_INLINE int32_t load16(const void *words, unsigned offset)
{
    return (int32_t)QL_LE16(
            *(const uint16_t *)(const void *)((const char *)words + offset));
}

/* The centre and half of a box along one axis, grid units. node counts
 * children: child n & 1 of pair n / 2. bits is a constant, so only one of the
 * two remains. */
QL_FAST_INLINE void box_axis(const ql_scene_t *scene, uint32_t node,
        unsigned bits, unsigned offset, int32_t *centre, int32_t *half)
{
    if (bits == 16) {
        const ql_blob_node16_t *n =
                (const ql_blob_node16_t *)scene->pairs + node;

        *centre = load16(n->centre, offset);
        *half = load16(n->half, offset);
    } else {
        const ql_blob_pair8_t *n =
                (const ql_blob_pair8_t *)scene->pairs + (node >> 1);
        const unsigned axis = offset >> 1;

        *centre = load16(n->base, offset) +
                  ((int32_t)n->centre[node & 1][axis] << n->shift);
        *half = (int32_t)n->half[node & 1][axis] << n->shift;
    }
}

/* A node's extent along the dominant axis. */
typedef struct {
    int32_t centre, half;
} extent_t;

/* The line test in one plane. */
QL_FAST_INLINE bool line_hit(const ql_scene_t *scene, uint32_t node,
        unsigned bits, const plane_t *plane, int32_t dz, extent_t z)
{
    int32_t c, h;
    uint32_t a, b;

    box_axis(scene, node, bits, plane->k, &c, &h);
    a = (uint32_t)(c * dz) - (uint32_t)(z.centre * plane->d) -
        (uint32_t)plane->o;
    b = (uint32_t)(h * dz) + (uint32_t)(z.half * plane->size);
    return a + b <= 2 * b + 2 * MARGIN;
}

QL_INLINE bool box_hit(
        const ql_scene_t *scene, uint32_t node, unsigned bits, const probe_t *p)
{
    extent_t z;

    QL_COUNT(boxes);
    box_axis(scene, node, bits, p->kz, &z.centre, &z.half);
    return meets(p->z, z.centre, z.half) &&
           line_hit(scene, node, bits, &p->x, p->dz, z) &&
           line_hit(scene, node, bits, &p->y, p->dz, z);
}

/* The interval of an axis that is not dominant. */
QL_FAST_INLINE bool side_hit(const ql_scene_t *scene, uint32_t node,
        unsigned bits, unsigned k, const interval_t axes[3])
{
    int32_t c, h;

    box_axis(scene, node, bits, k, &c, &h);
    return meets(axes[k >> 1], c, h);
}

/* Where a node leads: as root_link and root_meta of the header. */
QL_INLINE unsigned node_link(
        const ql_scene_t *scene, uint32_t node, unsigned bits, unsigned *meta)
{
    if (bits == 16) {
        const ql_blob_node16_t *n =
                (const ql_blob_node16_t *)scene->pairs + node;

        *meta = QL_LE16(n->meta);
        return QL_LE16(n->link);
    } else {
        const ql_blob_pair8_t *n =
                (const ql_blob_pair8_t *)scene->pairs + (node >> 1);

        *meta = node & 1 ? n->meta >> 4 : n->meta & 15u;
        return QL_LE16(n->link[node & 1]);
    }
}

/* t = T / det as u2.30. det is cut to 30 bits and T with it, and the lowest bit
 * is 0: the error is below 2^-29 t + 2^-27. t < 4 because hits lie in the box
 * and the largest component of the direction is 2^(b-1) or more. */
static ql_uq30_t parameter(uint64_t t, uint64_t det)
{
    /* det < 2^55 (ql_tri.h), so there are 9 leading zeros or more; t < 4 det
     * needs two of them */
#if QL_CFG_SMALL
    for (; det < (uint64_t)1 << 61; det <<= 1) {
        t <<= 1;
    }
#else
    const unsigned up = ql_clz64(det) - 2;

    det <<= up;
    t <<= up;
#endif
    /* 2^63 / (4 det30) = 2^61 / det30, times t30 is t 2^61; >> 32, << 1 */
    return ql_mulhi_u32(
                   (uint32_t)(t >> 32), ql_recip_m((uint32_t)(det >> 32) << 2))
           << 1;
}

/* End the interval at a hit, o_z + t d_z, or a little beyond. */
QL_INLINE void probe_shorten(probe_t *p, ql_uq30_t t)
{
    const int32_t way = (int32_t)ql_mulhi_u32(t, p->size_z << 2) + 1;

    if ((unsigned)p->backward >> (p->kz >> 1) & 1u) {
        const int32_t low = ql_asr32(p->start - way, QL_POS_BITS);

        p->z.span += p->z.low - low;
        p->z.low = low;
    } else {
        p->z.span = ql_asr32(p->start + way, QL_POS_BITS) - p->z.low;
    }
}

#if QL_CFG_SPHERES
/* As ql_tri_hit(): the ray parameter is a fraction here too. */
QL_INLINE int sphere_hit(const ql_blob_sphere_t *sphere, const ql_ray_t *ray,
        uint64_t *det, uint64_t *t)
{
    ql_uq30_t at = 0;
    const int side = ql_sphere_hit(sphere, ray, &at);

    QL_COUNT(spheres);
    *det = (uint64_t)1 << 30;
    *t = at;
    return side;
}
#endif

/* ql_tri_hit(), once in each walk, or once only. */
QL_FAST_INLINE int tri_hit(const ql_scene_t *scene, const ql_blob_tri_t *tri,
        const ql_ray_t *ray, uint64_t *det, uint64_t *t)
{
    QL_COUNT(triangles);
    return ql_tri_hit(scene, tri, ray, det, t);
}

/* t of a hit that is none. */
#define NO_HIT 0xffffffffu

/* Is a hit that was found before the nearest so far? */
QL_INLINE bool is_before(
        const ql_scene_t *scene, const ql_hit_t *found, const ql_hit_t *hit)
{
    if (ql_hull_is_last(scene, found)) {
        return hit->t == NO_HIT ||
               (ql_hull_is_last(scene, hit) && found->tri_idx < hit->tri_idx);
    }
    return ql_hull_is_last(scene, hit) ||
           (ql_order_is_close(scene, found, hit)
                           ? ql_order_is_before_exactly(scene, found, hit)
                           : ql_order_is_before_as_rounded(found, hit));
}

/* Test the triangles and spheres of a leaf; shorten the ray to the nearest
 * hit. */
QL_INLINE void leaf_closest(const ql_scene_t *scene, const ql_ray_t *ray,
        unsigned first, unsigned count, probe_t *p, ql_hit_t *hit)
{
    const ql_blob_tri_t *tri = scene->triangles + first;
    const ql_blob_tri_t *const end = tri + count;

    for (; tri < end; tri++) {
        uint64_t det, t;
#if QL_CFG_SPHERES
        const ql_blob_sphere_t *const sphere = ql_scene_sphere(scene, tri);
        const int side = sphere != NULL ? sphere_hit(sphere, ray, &det, &t)
                                        : tri_hit(scene, tri, ray, &det, &t);
#else
        const int side = tri_hit(scene, tri, ray, &det, &t);
#endif

        if (side != 0) {
            ql_hit_t found;

            QL_COUNT(hits);
            found.t = parameter(t, det);
            found.tri_idx = (uint16_t)(tri - scene->triangles);
            found.front = side > 0;
            ql_order_keep(&found, t, det);
            if (is_before(scene, &found, hit)) {
                *hit = found;
                probe_shorten(p, found.t);
            }
        }
    }
}

/* Is a segment closed at its far end? Then it ignores a triangle too, not just
 * a sphere. */
typedef enum { END_OPEN, END_CLOSED } end_t;

/* Close the far ends of a segment's intervals: they hold one integer more if it
 * ends on that. */
QL_FAST_INLINE void probe_close(
        probe_t *p, interval_t axes[3], const ql_ray_t *ray)
{
    const int32_t to[3] = {ray->origin.x + ray->direction.x,
            ray->origin.y + ray->direction.y, ray->origin.z + ray->direction.z};

    for (unsigned k = 0; k < 3; k++) {
        if ((to[k] & ((1 << QL_POS_BITS) - 1)) == 0) {
            axes[k].low -= p->backward >> k & 1;
            axes[k].span++;
        }
    }
    p->z = axes[p->kz >> 1];
}

/* Does a triangle at t / det of a segment count? */
QL_FAST_INLINE bool blocks(uint64_t t, uint64_t det, end_t end, bool is_but)
{
    return end == END_CLOSED ? t <= det && !is_but : t < det;
}

#if QL_CFG_SPHERES
QL_FAST_INLINE bool sphere_blocks(
        const ql_blob_sphere_t *sphere, const ql_ray_t *ray, end_t end)
{
    ql_vec3_t to = ray->origin;

    QL_COUNT(spheres);
    to.x += ray->direction.x;
    to.y += ray->direction.y;
    to.z += ray->direction.z;
    return ql_sphere_blocks(sphere, ray) ||
           (end == END_CLOSED &&
                   ql_sphere_side(sphere, ql_sphere_offset(sphere, to)) == 0);
}
#endif

QL_INLINE bool leaf_occluded(const ql_scene_t *scene, const ql_ray_t *ray,
        uint16_t but, end_t end, unsigned first, unsigned count)
{
    const ql_blob_tri_t *tri = scene->triangles + first;
    const ql_blob_tri_t *const last = tri + count;

    for (; tri < last; tri++) {
        const bool is_but = (QL_CFG_SPHERES || QL_CFG_GLASS) &&
                            (uint16_t)(tri - scene->triangles) == but;
        uint64_t det, t;

#if QL_CFG_SPHERES
        const ql_blob_sphere_t *const sphere = ql_scene_sphere(scene, tri);

        if (sphere != NULL) {
            if (!is_but && sphere_blocks(sphere, ray, end)) {
                return true;
            }
            continue;
        }
#endif
        if (tri_hit(scene, tri, ray, &det, &t) != 0 &&
                blocks(t, det, end, is_but)) {
            return true;
        }
    }
    return false;
}

/* Where a ray goes on that has met nothing inside the hull. */
QL_INLINE uint32_t leave(const ql_scene_t *scene, const ql_ray_t *ray,
        const ql_hit_t *hit, unsigned *left)
{
    return hit != NULL && *left > 0 && hit->t == NO_HIT
                   ? ql_hull_next(scene, ray, left)
                   : QL_HULL_NO_NODE;
}

/* Walk the tree front to back. hit is NULL for an any-hit segment, which a
 * sphere at index but does not block. Returns true as soon as a segment is
 * blocked. From inside the hull the first child of the root is walked; a ray
 * that meets nothing there leaves through the hull's sides below the second. */
QL_FAST_INLINE bool walk(const ql_scene_t *scene, const ql_ray_t *ray,
        ql_hit_t *hit, uint16_t but, end_t end, unsigned bits)
{
    uint32_t stack[QL_CFG_BVH_STACK];
    uint32_t *top = stack;
    unsigned link = scene->root_link, meta = scene->root_meta;
    unsigned left = 0; /* sides of the hull to leave through */
    uint32_t node;
    interval_t axes[3];
    probe_t p;
#if QL_CFG_SMALL

    probe_begin(&p, axes, ray, hit == NULL);
#else
    probe_t begun;

    probe_begin(&begun, axes, ray, hit == NULL);
    p = begun; /* a copy whose address stays here can live in registers */
#endif
    QL_COUNT(walks);
    if (hit == NULL) {
        QL_COUNT(segments);
    }
    if (end == END_CLOSED) {
        probe_close(&p, axes, ray);
    }
    if (ql_hull_has(scene, ray, hit == NULL)) {
        left = ql_scene_sides(scene);
        link = node_link(scene, 0, bits, &meta); /* the root's first child */
    }
    for (;;) {
        if (meta < 3) {
            /* the far child waits; QL_CFG_BVH_STACK covers the checked depth */
            node = 2 * (uint32_t)link + ((unsigned)p.backward >> meta & 1u);
            *top++ = node ^ 1u;
        } else {
            if (hit != NULL) {
                leaf_closest(scene, ray, link, meta - 3, &p, hit);
            } else if (leaf_occluded(scene, ray, but, end, link, meta - 3)) {
                return true;
            }
            if (top != stack) {
                node = *--top;
            } else {
                node = leave(scene, ray, hit, &left);
                if (node == QL_HULL_NO_NODE) {
                    return false;
                }
            }
        }
        for (;;) {
            if (box_hit(scene, node, bits, &p)) {
                link = node_link(scene, node, bits, &meta);
                if (meta < 3 ||
                        (side_hit(scene, node, bits, p.x.k, axes) &&
                                side_hit(scene, node, bits, p.y.k, axes))) {
                    break;
                }
            }
            if (top != stack) {
                node = *--top;
            } else {
                node = leave(scene, ray, hit, &left);
                if (node == QL_HULL_NO_NODE) {
                    return false;
                }
            }
        }
    }
}

bool ql_bvh_closest_hit(
        const ql_scene_t *scene, const ql_ray_t *ray, ql_hit_t *hit)
{
    hit->t = NO_HIT;
    ql_order_keep(hit, 1, 0);
    hit->tri_idx = 0;
    hit->front = false;
#if QL_CFG_NODE16
    if (!QL_CFG_NODE8 || scene->node_bits == 16) {
        (void)walk(scene, ray, hit, 0, END_OPEN, 16);
    }
#endif
#if QL_CFG_NODE8
    if (!QL_CFG_NODE16 || scene->node_bits == 8) {
        (void)walk(scene, ray, hit, 0, END_OPEN, 8);
    }
#endif
    return hit->t != NO_HIT;
}

/* Once for both ends, or for the only one that is asked for. */
static bool is_blocked(
        const ql_scene_t *scene, const ql_ray_t *ray, uint16_t but, end_t end)
{
#if QL_CFG_NODE16
    if (!QL_CFG_NODE8 || scene->node_bits == 16) {
        return walk(scene, ray, NULL, but, end, 16);
    }
#endif
#if QL_CFG_NODE8
    return walk(scene, ray, NULL, but, end, 8);
#endif
}

bool ql_bvh_occluded_but(
        const ql_scene_t *scene, const ql_ray_t *ray, uint16_t but)
{
    return is_blocked(scene, ray, but, END_OPEN);
}

#if QL_CFG_CONTACT
bool ql_bvh_touches(const ql_scene_t *scene, const ql_ray_t *ray, uint16_t but)
{
    return is_blocked(scene, ray, but, END_CLOSED);
}
#endif
