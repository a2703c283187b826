/* ref_trace.c - rays against triangles, spheres and the boxes around them */
/* SPDX-License-Identifier: MIT */

/* In the core a point is on the exact side of its surface; here it is on the
 * surface, up to the rounding of a double, 1e-11 grid units. So a ray does not
 * meet the triangle or the side of the sphere that it leaves, and what is
 * within NEAR of either end does not count: those are surfaces that lie in the
 * same place, the only ones that are met there but by chance. */

#include "ref/ref_parts.h"

#define NEAR 1e-7  /* grid units; a fine position has 4e-3 */
#define EDGE 1e-11 /* barycentric: neighbours overlap, so that none is missed */
#define PAD  1e-3  /* grid units: boxes are larger, by more than they err */
#define DEEP 65    /* the blob is 64 levels deep at most */

static bool meet_triangle(
        const ref_shape_t *shape, const ref_ray_t *ray, ref_hit_t *hit)
{
    const ref_vec_t s = ref_sub(ray->origin, shape->corner);
    const ref_vec_t q = ref_cross(s, ray->direction);
    const double det = -ref_dot(ray->direction, shape->n);

    if (det == 0) {
        return false;
    }
    hit->u = ref_dot(q, shape->e2) / det;
    hit->v = -ref_dot(q, shape->e1) / det;
    hit->t = ref_dot(s, shape->n) / det;
    hit->front = det > 0;
    return hit->u >= -EDGE && hit->v >= -EDGE && hit->u + hit->v <= 1 + EDGE &&
           hit->t > NEAR;
}

static bool meet_sphere(const ref_shape_t *shape, const ref_ray_t *ray,
        bool leaves, ref_hit_t *hit)
{
    const ref_vec_t s = ref_sub(ray->origin, shape->corner);
    const double r2 = shape->radius * shape->radius;
    const double way = ref_dot(s, ray->direction);
    const double side = leaves ? 0 : ref_dot(s, s) - r2;
    const ref_vec_t aside = ref_along(s, ray->direction, -way);
    const double root = r2 - ref_dot(aside, aside); /* squared */

    hit->front = leaves ? !ray->inside : side > 0;
    if (hit->front) {
        if (leaves || way >= 0 || root <= 0) {
            return false;
        }
        hit->t = side / (sqrt(root) - way);
    } else {
        hit->t = sqrt(root > 0 ? root : 0) - way;
    }
    return hit->t > NEAR;
}

static bool meet(const ref_scene_t *scene, uint32_t index, const ref_ray_t *ray,
        ref_hit_t *hit)
{
    const ref_shape_t *shape = scene->shapes + index;
    const bool leaves = index == ray->from;

    hit->shape = index;
    if (shape->radius > 0) {
        return meet_sphere(shape, ray, leaves, hit);
    }
    return !leaves && meet_triangle(shape, ray, hit);
}

/* Cut [*near, *far] to what a slab holds of a line. */
static void cut(double low, double high, double origin, double direction,
        double *near, double *far)
{
    double a, b;

    if (direction == 0) {
        *far = origin < low - PAD || origin > high + PAD ? -1 : *far;
        return;
    }
    a = ((direction > 0 ? low - PAD : high + PAD) - origin) / direction;
    b = ((direction > 0 ? high + PAD : low - PAD) - origin) / direction;
    *near = a > *near ? a : *near;
    *far = b < *far ? b : *far;
}

static bool box_hit(const ref_node_t *node, const ref_ray_t *ray, double end)
{
    double near = 0, far = end + PAD;

    cut(node->low[0], node->high[0], ray->origin.x, ray->direction.x, &near,
            &far);
    cut(node->low[1], node->high[1], ray->origin.y, ray->direction.y, &near,
            &far);
    cut(node->low[2], node->high[2], ray->origin.z, ray->direction.z, &near,
            &far);
    return near <= far;
}

/* Is direction negative on an axis? */
static unsigned backward(const ref_ray_t *ray, unsigned axis)
{
    const double d[3] = {ray->direction.x, ray->direction.y, ray->direction.z};

    return d[axis] < 0 ? 1 : 0;
}

/* Which shapes a walk is for. */
typedef struct {
    bool any;     /* the first that is found will do */
    uint32_t but; /* is left out */
} wanted_t;

/* Is a the hit that counts of two in one place? */
static bool is_first(
        const ref_scene_t *scene, const ref_hit_t *a, const ref_hit_t *b)
{
    const uint16_t *ranks = scene->blob->ranks;

    if (ranks != NULL && b->shape != REF_NOWHERE) {
        const uint16_t rank = QL_LE16(ranks[a->shape]);
        const uint16_t other = QL_LE16(ranks[b->shape]);

        if (a->front != b->front) {
            return a->front;
        }
        if (rank != other) {
            return rank < other;
        }
    }
    return a->shape < b->shape;
}

/* Test the shapes of a leaf. True if that ends the walk. */
static bool visit(const ref_scene_t *scene, const ref_ray_t *ray,
        unsigned first, unsigned count, wanted_t wanted, ref_hit_t *nearest)
{
    for (unsigned i = first; i < first + count; i++) {
        ref_hit_t hit;

        if (i == wanted.but || !meet(scene, i, ray, &hit)) {
            continue;
        }
        if (hit.t < nearest->t - NEAR ||
                (!wanted.any && hit.t < nearest->t + NEAR &&
                        is_first(scene, &hit, nearest))) {
            *nearest = hit;
            if (wanted.any) {
                return true;
            }
        }
    }
    return false;
}

/* The nearest hit before end, or some hit. */
static bool walk(const ref_scene_t *scene, const ref_ray_t *ray, double end,
        wanted_t wanted, ref_hit_t *nearest)
{
    unsigned stack[DEEP], depth = 0;
    unsigned link = scene->blob->root_link, meta = scene->blob->root_meta;

    nearest->t = end;
    nearest->shape = REF_NOWHERE;
    for (;;) {
        const ref_node_t *node = NULL;

        if (meta < 3) {
            const unsigned near = 2 * link + backward(ray, meta);

            stack[depth++] = near ^ 1u;
            stack[depth++] = near;
        } else if (visit(scene, ray, link, meta - 3, wanted, nearest)) {
            return true;
        }
        do {
            if (depth == 0) {
                return nearest->shape != REF_NOWHERE;
            }
            node = scene->nodes + stack[--depth];
        } while (!box_hit(node, ray, nearest->t));
        link = node->link;
        meta = node->meta;
    }
}

bool ref_closest(const ref_scene_t *scene, const ref_ray_t *ray, ref_hit_t *hit)
{
    const wanted_t nearest = {false, REF_NOWHERE};

    return walk(scene, ray, HUGE_VAL, nearest, hit);
}

bool ref_blocked(const ref_scene_t *scene, const ref_ray_t *ray,
        double distance, uint32_t but)
{
    const wanted_t some = {true, but};
    ref_hit_t hit;

    return walk(scene, ray, distance, some, &hit);
}

static void surface_of_sphere(const ref_shape_t *shape, ref_vec_t p, bool front,
        ref_surface_t *surface)
{
    const ref_vec_t out = ref_unit(ref_sub(p, shape->corner));

    surface->p = ref_along(shape->corner, out, shape->radius);
    surface->n = ref_scale(out, front ? 1 : -1);
    surface->shade = surface->n;
    surface->inside = !front;
}

static void surface_of_triangle(
        const ref_shape_t *shape, const ref_hit_t *hit, ref_surface_t *surface)
{
    const double side = hit->front ? 1 : -1;
    ref_vec_t shade;

    surface->p = ref_along(
            ref_along(shape->corner, shape->e1, hit->u), shape->e2, hit->v);
    surface->n = ref_scale(ref_unit(shape->n), side);
    surface->shade = surface->n;
    if (!shape->smooth) {
        return;
    }
    shade = ref_scale(shape->normal[0], 1 - hit->u - hit->v);
    shade = ref_along(shade, shape->normal[1], hit->u);
    shade = ref_scale(ref_along(shade, shape->normal[2], hit->v), side);
    if (ref_dot(shade, surface->n) > 0) {
        surface->smooth = true;
        surface->shade = ref_unit(shade);
    }
}

/* How far a point of a smooth triangle is below the tangent planes of its
 * corners, in the mean, by the weights that the normals have. */
static ref_vec_t lift_of(const ref_shape_t *shape, const ref_hit_t *hit,
        const ref_surface_t *surface)
{
    const double weight[3] = {1 - hit->u - hit->v, hit->u, hit->v};
    const ref_vec_t corner[3] = {shape->corner,
            ref_along(shape->corner, shape->e1, 1),
            ref_along(shape->corner, shape->e2, 1)};
    ref_vec_t lift = {0, 0, 0};

    for (unsigned i = 0; i < 3; i++) {
        const ref_vec_t n =
                ref_scale(shape->normal[i], (hit->front ? 1 : -1) / 32768.0);
        const double height = ref_dot(ref_sub(surface->p, corner[i]), n);

        lift = ref_along(lift, n, -weight[i] * height);
    }
    return lift;
}

/* A component that does not leave the box if it is taken twice. */
static double cut_lift(double lift, double p)
{
    return fmax(-p / 2, fmin(lift, (QL_GRID_MAX - p) / 2));
}

/* As ql_smooth_lift() does. */
static void lift(const ref_scene_t *scene, const ref_shape_t *shape,
        const ref_hit_t *hit, ref_surface_t *surface)
{
    ref_vec_t up = lift_of(shape, hit, surface);
    double length;
    ref_ray_t ray;

    up.x = cut_lift(up.x, surface->p.x);
    up.y = cut_lift(up.y, surface->p.y);
    up.z = cut_lift(up.z, surface->p.z);
    length = sqrt(ref_dot(up, up));
    if (length * (1 << QL_POS_BITS) < 0.5 || ref_dot(up, surface->n) <= 0) {
        return;
    }
    ray = ref_leave(surface, ref_unit(up), REF_ABOVE);
    if (!ref_blocked(scene, &ray, 2 * length, REF_NOWHERE)) {
        surface->p = ref_along(surface->p, up, 1);
        surface->n = surface->shade;
        surface->smooth = false;
        surface->shape = REF_NOWHERE; /* it may be met from there */
    }
}

void ref_surface_at(const ref_scene_t *scene, const ref_ray_t *ray,
        const ref_hit_t *hit, ref_surface_t *surface)
{
    const ref_shape_t *shape = scene->shapes + hit->shape;

    surface->shape = hit->shape;
    surface->smooth = false;
    surface->inside = false;
    if (shape->radius > 0) {
        surface_of_sphere(shape, ref_along(ray->origin, ray->direction, hit->t),
                hit->front, surface);
    } else {
        surface_of_triangle(shape, hit, surface);
    }
    if (scene->rounding != NULL && scene->rounding->point != NULL) {
        scene->rounding->point(scene->rounding->data, ray, hit, surface);
    }
    if (surface->smooth && shape->material->kind != QL_GLOSS_MIRROR &&
            shape->material->kind != QL_GLOSS_GLASS) {
        lift(scene, shape, hit, surface);
    }
}

ref_ray_t ref_leave(
        const ref_surface_t *surface, ref_vec_t direction, ref_side_t side)
{
    ref_ray_t ray;

    ray.origin = surface->p;
    ray.direction = direction;
    ray.from = surface->shape;
    ray.inside = surface->inside != (side == REF_BELOW);
    return ray;
}
