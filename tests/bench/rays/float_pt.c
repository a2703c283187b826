/* float_pt.c - scene, traversal, sampling and paths in single precision */
/* SPDX-License-Identifier: MIT */

#include "bench/rays/float_pt.h"

#include "sample/ql_sampler.h"

#define STACK_MAX       64
#define EPSILON         0.25f /* grid units: 2^-17 of the scene's box */
#define SEGMENT_EPSILON 1e-4f /* of a segment's length, at its far end */
#define PI              3.14159265f

/* Is there an FPU? Then it has a square root and compares; else Newton's method
 * and the bits of numbers do, which are ordered as integers where not both are
 * negative. */
#if defined(__SSE__) || defined(__ARM_FP) || defined(__aarch64__) ||           \
        defined(__riscv_flen)
#define square_root(x) __builtin_sqrtf(x)
#define magnitude(x)   __builtin_fabsf(x)
#define less(a, b)     ((a) < (b))
#define opposite(a, b) ((a) < 0.0f ? (b) > 0.0f : (a) > 0.0f && (b) < 0.0f)
#else
typedef union {
    float f;
    uint32_t bits;
} float_bits_t;

QL_INLINE uint32_t bits_of(float x)
{
    float_bits_t r;

    r.f = x;
    return r.bits;
}

static float square_root(float x)
{
    float_bits_t r;

    if (x <= 0.0f) {
        return 0.0f;
    }
    r.f = x;
    r.bits = 0x5f3759dfu - (r.bits >> 1);
    r.f *= 1.5f - 0.5f * x * r.f * r.f;
    r.f *= 1.5f - 0.5f * x * r.f * r.f;
    return x * r.f * (1.5f - 0.5f * x * r.f * r.f);
}

QL_INLINE float magnitude(float x)
{
    float_bits_t r;

    r.f = x;
    r.bits &= 0x7fffffffu;
    return r.f;
}

/* Is a < b? Not both are negative. */
QL_INLINE bool less(float a, float b)
{
    return ql_i32(bits_of(a)) < ql_i32(bits_of(b));
}

/* Have two numbers opposite signs? A zero's sign counts too: a ray that meets
 * an edge belongs to one of its two triangles, by the sign of the product. */
QL_INLINE bool opposite(float a, float b)
{
    return (bits_of(a) ^ bits_of(b)) >> 31 != 0;
}
#endif

QL_INLINE fp_vec_t add(fp_vec_t a, fp_vec_t b)
{
    const fp_vec_t r = {a.x + b.x, a.y + b.y, a.z + b.z};

    return r;
}

QL_INLINE fp_vec_t sub(fp_vec_t a, fp_vec_t b)
{
    const fp_vec_t r = {a.x - b.x, a.y - b.y, a.z - b.z};

    return r;
}

QL_INLINE fp_vec_t scale(fp_vec_t a, float s)
{
    const fp_vec_t r = {a.x * s, a.y * s, a.z * s};

    return r;
}

QL_INLINE fp_vec_t mul(fp_vec_t a, fp_vec_t b)
{
    const fp_vec_t r = {a.x * b.x, a.y * b.y, a.z * b.z};

    return r;
}

QL_INLINE float dot(fp_vec_t a, fp_vec_t b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

QL_INLINE fp_vec_t cross(fp_vec_t a, fp_vec_t b)
{
    const fp_vec_t r = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
            a.x * b.y - a.y * b.x};

    return r;
}

QL_INLINE fp_vec_t from_grid(ql_vec3_t v, float unit)
{
    const fp_vec_t r = {
            (float)v.x * unit, (float)v.y * unit, (float)v.z * unit};

    return r;
}

/* ---- the scene ---- */

size_t fp_bytes(const ql_scene_t *scene)
{
    const ql_blob_header_t *h = scene->header;

    return QL_LE32(h->pairs.count) * sizeof(fp_pair_t) +
           QL_LE32(h->triangles.count) *
                   (sizeof(fp_tri_t) + sizeof(fp_shade_t)) +
           QL_LE32(h->materials.count) * sizeof(fp_material_t) +
           QL_LE32(h->lights.count) * sizeof(fp_light_t);
}

static void convert_child(
        fp_pair_t *pair, unsigned i, const ql_scene_t *scene, uint32_t index)
{
    unsigned meta;

    for (unsigned k = 0; k < 3; k++) {
        int32_t centre, half;

        if (scene->node_bits == 16) {
            const ql_blob_node16_t *n =
                    (const ql_blob_node16_t *)scene->pairs + 2 * index + i;

            centre = (int32_t)QL_LE16(n->centre[k]);
            half = (int32_t)QL_LE16(n->half[k]);
            meta = QL_LE16(n->meta);
            pair->link[i] = QL_LE16(n->link);
        } else {
            const ql_blob_pair8_t *n =
                    (const ql_blob_pair8_t *)scene->pairs + index;

            centre = (int32_t)QL_LE16(n->base[k]) +
                     ((int32_t)n->centre[i][k] << n->shift);
            half = (int32_t)n->half[i][k] << n->shift;
            meta = i ? n->meta >> 4 : n->meta & 15u;
            pair->link[i] = QL_LE16(n->link[i]);
        }
        pair->box[i][2 * k] = (float)(centre - half);
        pair->box[i][2 * k + 1] = (float)(centre + half);
        pair->count[i] = (uint16_t)(meta < 3 ? 0 : meta - 3);
    }
}

static void convert_tri(fp_tri_t *tri, fp_shade_t *shade,
        const ql_scene_t *scene, const ql_blob_tri_t *from)
{
    const fp_vec_t v1 = from_grid(ql_scene_corner(scene, from, 1), 1.0f);
    const fp_vec_t v2 = from_grid(ql_scene_corner(scene, from, 2), 1.0f);
    fp_vec_t n;

    tri->v0 = from_grid(ql_scene_corner(scene, from, 0), 1.0f);
    tri->e1 = sub(v1, tri->v0);
    tri->e2 = sub(v2, tri->v0);
    n = cross(tri->e1, tri->e2);
    shade->n = scale(n, 1.0f / square_root(dot(n, n)));
    shade->material = QL_LE16(from->material) & 0x3fffu;
}

static fp_vec_t convert_colour(const uint32_t rgb[3], float unit)
{
    const fp_vec_t r = {(float)QL_LE32(rgb[0]) * unit,
            (float)QL_LE32(rgb[1]) * unit, (float)QL_LE32(rgb[2]) * unit};

    return r;
}

static void convert_light(fp_light_t *light, const fp_scene_t *fp,
        const ql_blob_light_t *from, bool last)
{
    const uint32_t begin = QL_LE32(from->cum);
    const uint32_t end = last ? 0u : QL_LE32(from[1].cum); /* 0: 2^32 */
    const float chance = end == begin ? 1.0f : (float)(end - begin) * 0x1p-32f;
    fp_vec_t n;

    light->triangle = QL_LE16(from->triangle);
    n = cross(fp->tris[light->triangle].e1, fp->tris[light->triangle].e2);
    light->weight = 0.5f * square_root(dot(n, n)) / (PI * chance);
    light->cdf = last ? 1.0f : (float)end * 0x1p-32f;
}

static fp_vec_t convert_wide(const uint32_t field[3][2])
{
    fp_vec_t r;

    r.x = (float)ql_i32(QL_LE32(field[0][1])) +
          (float)QL_LE32(field[0][0]) * 0x1p-32f;
    r.y = (float)ql_i32(QL_LE32(field[1][1])) +
          (float)QL_LE32(field[1][0]) * 0x1p-32f;
    r.z = (float)ql_i32(QL_LE32(field[2][1])) +
          (float)QL_LE32(field[2][0]) * 0x1p-32f;
    return r;
}

static fp_vec_t convert_narrow(const uint32_t field[3])
{
    const fp_vec_t r = {(float)ql_i32(QL_LE32(field[0])),
            (float)ql_i32(QL_LE32(field[1])), (float)ql_i32(QL_LE32(field[2]))};

    return scale(r, 0x1p-30f);
}

static void convert_camera(fp_camera_t *camera, const ql_blob_camera_t *from)
{
    camera->p = convert_wide(from->at[QL_CAMERA_BASE]);
    camera->pr = convert_wide(from->at[QL_CAMERA_RIGHT]);
    camera->pu = convert_wide(from->at[QL_CAMERA_UP]);
    camera->d = convert_narrow(from->towards[QL_CAMERA_BASE]);
    camera->dr = convert_narrow(from->towards[QL_CAMERA_RIGHT]);
    camera->du = convert_narrow(from->towards[QL_CAMERA_UP]);
}

/* The first child of the root is what lies inside the hull. */
#if QL_CFG_HULL
static void convert_hull(fp_scene_t *fp, const ql_scene_t *scene)
{
    for (unsigned i = 0; i < 6; i++) {
        fp->hull_box[i] =
                scene->hull_first == 0
                        ? 0.0f
                        : (float)QL_LE16(scene->hull->box[i / 2][i % 2]);
    }
    if (scene->hull_first == 0) {
        return;
    }
    fp->inner_link = fp->pairs[fp->root_link].link[0];
    fp->inner_count = fp->pairs[fp->root_link].count[0];
    fp->hull_first = scene->hull_first;
}
#else
static void convert_hull(fp_scene_t *fp, const ql_scene_t *scene)
{
    (void)scene;
    for (unsigned i = 0; i < 6; i++) {
        fp->hull_box[i] = 0.0f;
    }
}
#endif

void fp_open(fp_scene_t *fp, const ql_scene_t *scene, void *memory)
{
    const ql_blob_header_t *h = scene->header;
    const uint32_t pair_count = QL_LE32(h->pairs.count);
    const uint32_t tri_count = QL_LE32(h->triangles.count);
    const uint32_t material_count = QL_LE32(h->materials.count);
    fp_pair_t *pairs = memory;
    fp_tri_t *tris = (fp_tri_t *)(void *)(pairs + pair_count);
    fp_shade_t *shades = (fp_shade_t *)(void *)(tris + tri_count);
    fp_material_t *materials = (fp_material_t *)(void *)(shades + tri_count);
    fp_light_t *lights = (fp_light_t *)(void *)(materials + material_count);

    for (uint32_t i = 0; i < pair_count; i++) {
        convert_child(pairs + i, 0, scene, i);
        convert_child(pairs + i, 1, scene, i);
    }
    for (uint32_t i = 0; i < tri_count; i++) {
        convert_tri(tris + i, shades + i, scene, scene->triangles + i);
    }
    for (uint32_t i = 0; i < material_count; i++) {
        const ql_blob_material_t *m = scene->materials + i;

        materials[i].albedo = convert_colour(m->albedo, 0x1p-31f);
        materials[i].emission = convert_colour(m->emission, 0x1p-32f);
    }
    fp->pairs = pairs;
    fp->tris = tris;
    fp->shades = shades;
    fp->materials = materials;
    fp->lights = lights;
    fp->light_count = scene->light_count;
    for (uint32_t i = 0; i < fp->light_count; i++) {
        convert_light(
                lights + i, fp, scene->lights + i, i + 1 == fp->light_count);
    }
    fp->root_link = scene->root_link;
    fp->root_count =
            (uint16_t)(scene->root_meta < 3 ? 0 : scene->root_meta - 3);
    fp->hull_first = tri_count;
    fp->tri_count = tri_count;
    convert_hull(fp, scene);
    fp->two_sided = scene->two_sided;
    convert_camera(&fp->camera, scene->camera);
}

fp_ray_t fp_ray(const ql_ray_t *ray, bool segment)
{
    const float unit = 1.0f / (float)(1 << QL_POS_BITS);
    fp_ray_t r;

    r.origin = from_grid(ray->origin, unit);
    r.direction = from_grid(ray->direction, unit);
    if (segment) {
        r.t_min = SEGMENT_EPSILON;
        r.t_max = 1.0f - SEGMENT_EPSILON;
    } else {
        r.direction = scale(
                r.direction, 1.0f / square_root(dot(r.direction, r.direction)));
        r.t_min = EPSILON;
        r.t_max = FP_FAR;
    }
    return r;
}

/* ---- rays ---- */

/* Inverse direction, and which bound of a box is met first on each axis. */
typedef struct {
    fp_vec_t origin, inverse;
    unsigned x, y, z; /* 0 low, 1 high */
} slabs_t;

static inline slabs_t slabs_begin(const fp_ray_t *ray)
{
    slabs_t s;

    s.origin = ray->origin;
    s.inverse.x = 1.0f / ray->direction.x;
    s.inverse.y = 1.0f / ray->direction.y;
    s.inverse.z = 1.0f / ray->direction.z;
    s.x = ray->direction.x < 0.0f;
    s.y = ray->direction.y < 0.0f;
    s.z = ray->direction.z < 0.0f;
    return s;
}

/* Where a ray enters a box, or FP_FAR if it does not before t_max. t_min is not
 * negative. A PC computes all six planes without a branch; a microcontroller
 * stops at the first pair of planes that leaves nothing. A ray along a face may
 * make 0 * infinity: a comparison with that is false, or leaves the box in. */
#if defined(__SSE__) || defined(__aarch64__)
QL_INLINE float enter_box(
        const float box[6], const slabs_t *s, float t_min, float t_max)
{
    const float x0 = (box[s->x] - s->origin.x) * s->inverse.x;
    const float x1 = (box[s->x ^ 1] - s->origin.x) * s->inverse.x;
    const float y0 = (box[2 + s->y] - s->origin.y) * s->inverse.y;
    const float y1 = (box[2 + (s->y ^ 1)] - s->origin.y) * s->inverse.y;
    const float z0 = (box[4 + s->z] - s->origin.z) * s->inverse.z;
    const float z1 = (box[4 + (s->z ^ 1)] - s->origin.z) * s->inverse.z;
    float near = t_min, far = t_max;

    near = x0 > near ? x0 : near;
    near = y0 > near ? y0 : near;
    near = z0 > near ? z0 : near;
    far = x1 < far ? x1 : far;
    far = y1 < far ? y1 : far;
    far = z1 < far ? z1 : far;
    return near <= far ? near : FP_FAR;
}
#else
/* Cut [near, far] by a pair of planes; false if nothing is left. */
QL_INLINE bool cut(float *near, float *far, float low, float high, float origin,
        float inverse)
{
    const float enter = (low - origin) * inverse;
    float leave;

    if (less(*near, enter)) {
        *near = enter;
        if (less(*far, *near)) {
            return false;
        }
    }
    leave = (high - origin) * inverse;
    if (less(leave, *far)) {
        *far = leave;
    }
    return !less(*far, *near);
}

QL_INLINE float enter_box(
        const float box[6], const slabs_t *s, float t_min, float t_max)
{
    float near = t_min, far = t_max;

    return cut(&near, &far, box[s->x], box[s->x ^ 1], s->origin.x,
                   s->inverse.x) &&
                           cut(&near, &far, box[2 + s->y], box[2 + (s->y ^ 1)],
                                   s->origin.y, s->inverse.y) &&
                           cut(&near, &far, box[4 + s->z], box[4 + (s->z ^ 1)],
                                   s->origin.z, s->inverse.z)
                   ? near
                   : FP_FAR;
}
#endif

/* Moeller and Trumbore, divided by the determinant only what hits. */
QL_INLINE bool hit_tri(const fp_tri_t *tri, const fp_ray_t *ray, float t_max,
        float *t_out, float *det_out)
{
    const fp_vec_t p = cross(ray->direction, tri->e2);
    const fp_vec_t s = sub(ray->origin, tri->v0);
    const float det = dot(tri->e1, p);
    const float size = magnitude(det);
    const float u = dot(s, p);
    fp_vec_t q;
    float v, t;

    if (opposite(u, det) || less(size, magnitude(u))) {
        return false;
    }
    q = cross(s, tri->e1);
    v = dot(ray->direction, q);
    if (opposite(v, det) || less(size, magnitude(u + v))) {
        return false;
    }
    t = dot(tri->e2, q) / det; /* not a number if det is 0 */
    if (!(t > ray->t_min && t < t_max)) {
        return false;
    }
    *t_out = t;
    *det_out = det;
    return true;
}

/* Is a position inside the hull? No coordinate is negative. */
QL_INLINE bool is_inside(const fp_scene_t *fp, fp_vec_t p)
{
    const float *box = fp->hull_box;

    return less(box[0], p.x) && less(p.x, box[1]) && less(box[2], p.y) &&
           less(p.y, box[3]) && less(box[4], p.z) && less(p.z, box[5]);
}

/* The triangle of the hull through which a ray leaves. */
static bool leave_hull(const fp_scene_t *fp, const fp_ray_t *ray, fp_hit_t *hit)
{
    for (uint32_t i = fp->hull_first; i < fp->tri_count; i++) {
        float det;

        if (dot(fp->shades[i].n, ray->direction) < 0.0f &&
                hit_tri(fp->tris + i, ray, ray->t_max, &hit->t, &det)) {
            hit->triangle = i;
            hit->front = det > 0.0f;
            return true;
        }
    }
    return false;
}

bool fp_closest(const fp_scene_t *fp, const fp_ray_t *ray, fp_hit_t *hit)
{
    const bool inside = is_inside(fp, ray->origin);
    struct {
        float t;
        uint16_t link, count;
    } stack[STACK_MAX];
    const slabs_t s = slabs_begin(ray);
    unsigned depth = 0, link = inside ? fp->inner_link : fp->root_link;
    unsigned count = inside ? fp->inner_count : fp->root_count;
    float nearest = ray->t_max;
    const float t_min = ray->t_min;

    for (;;) {
        if (count == 0) {
            const fp_pair_t *pair = fp->pairs + link;
            const float t0 = enter_box(pair->box[0], &s, t_min, nearest);
            const float t1 = enter_box(pair->box[1], &s, t_min, nearest);
            const unsigned near = less(t1, t0), far = near ^ 1u;

            if (less(near ? t0 : t1, FP_FAR)) {
                stack[depth].t = near ? t0 : t1;
                stack[depth].link = pair->link[far];
                stack[depth].count = pair->count[far];
                depth++;
            }
            if (less(near ? t1 : t0, FP_FAR)) {
                link = pair->link[near];
                count = pair->count[near];
                continue;
            }
        } else {
            for (const unsigned end = link + count; link < end; link++) {
                float t, det;

                if (hit_tri(fp->tris + link, ray, nearest, &t, &det)) {
                    nearest = t;
                    hit->triangle = link;
                    hit->front = det > 0.0f;
                }
            }
        }
        do {
            if (depth == 0) {
                if (inside && !(nearest < ray->t_max)) {
                    return leave_hull(fp, ray, hit);
                }
                hit->t = nearest;
                return nearest < ray->t_max;
            }
            depth--;
        } while (!less(stack[depth].t, nearest));
        link = stack[depth].link;
        count = stack[depth].count;
    }
}

bool fp_occluded(const fp_scene_t *fp, const fp_ray_t *ray)
{
    struct {
        uint16_t link, count;
    } stack[STACK_MAX];
    const slabs_t s = slabs_begin(ray);
    const bool inside = is_inside(fp, ray->origin) &&
                        is_inside(fp, add(ray->origin, ray->direction));
    unsigned depth = 0, link = inside ? fp->inner_link : fp->root_link;
    unsigned count = inside ? fp->inner_count : fp->root_count;
    const float t_min = ray->t_min, t_max = ray->t_max;

    for (;;) {
        if (count == 0) {
            const fp_pair_t *pair = fp->pairs + link;
            const float t0 = enter_box(pair->box[0], &s, t_min, t_max);
            const float t1 = enter_box(pair->box[1], &s, t_min, t_max);

            if (less(t0, FP_FAR)) {
                link = pair->link[0];
                count = pair->count[0];
                if (less(t1, FP_FAR)) {
                    stack[depth].link = pair->link[1];
                    stack[depth].count = pair->count[1];
                    depth++;
                }
                continue;
            }
            if (less(t1, FP_FAR)) {
                link = pair->link[1];
                count = pair->count[1];
                continue;
            }
        } else {
            for (const unsigned end = link + count; link < end; link++) {
                float t, det;

                if (hit_tri(fp->tris + link, ray, t_max, &t, &det)) {
                    return true;
                }
            }
        }
        if (depth == 0) {
            return false;
        }
        depth--;
        link = stack[depth].link;
        count = stack[depth].count;
    }
}

/* ---- sampling ---- */

/* Sine and cosine of u turns, u in [0, 1): polynomials on an eighth of a turn
 * each way of the nearest quarter. Error: 3e-7. */
static void sincos_turns(float u, float *sine, float *cosine)
{
    const int quarter = (int)(4.0f * u + 0.5f);
    const float x = (u - 0.25f * (float)quarter) * (2.0f * PI);
    const float xx = x * x;
    const float s =
            x *
            (1.0f + xx * (-1.6666667e-1f +
                                 xx * (8.3333310e-3f + xx * -1.9840874e-4f)));
    const float c =
            1.0f +
            xx * (-0.5f + xx * (4.1666642e-2f +
                                       xx * (-1.3888397e-3f +
                                                    xx * 2.4760495e-5f)));

    switch (quarter & 3) {
    case 0:
        *sine = s;
        *cosine = c;
        break;
    case 1:
        *sine = c;
        *cosine = -s;
        break;
    case 2:
        *sine = -s;
        *cosine = -c;
        break;
    default:
        *sine = -c;
        *cosine = s;
        break;
    }
}

/* The frame is that of Duff et al., "Building an Orthonormal Basis, Revisited",
 * JCGT 6(1), 2017. */
QL_NOINLINE fp_vec_t fp_cosine_hemisphere(fp_vec_t n, float u1, float u2)
{
    const float sign = n.z < 0.0f ? -1.0f : 1.0f;
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    const fp_vec_t tangent = {
            1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x};
    const fp_vec_t bitangent = {b, sign + n.y * n.y * a, -n.y};
    const float r = square_root(u1);
    float sine, cosine;

    sincos_turns(u2, &sine, &cosine);
    return add(add(scale(tangent, r * cosine), scale(bitangent, r * sine)),
            scale(n, square_root(1.0f - u1)));
}

/* The very numbers that qlux draws, in [0, 1). */
QL_INLINE float unit(uint32_t u)
{
    return (float)(u >> 8) * 0x1p-24f;
}

/* ---- paths ---- */

/* Light that a point reflects from a point on an emitter. */
static fp_vec_t direct(const fp_scene_t *fp, fp_vec_t p, fp_vec_t n,
        fp_vec_t reflected, const ql_sampler_t *sampler, uint32_t dim)
{
    static const fp_vec_t black = {0.0f, 0.0f, 0.0f};
    const fp_light_t *light = fp->lights;
    const fp_tri_t *tri;
    ql_uniform2_t u;
    float u1, u2, cos_n, cos_light, inverse;
    fp_ray_t ray;

    if (fp->light_count > 1) {
        const float pick =
                unit(ql_sampler_1d(sampler, dim + QL_DIM_LIGHT_PICK));
        uint32_t low = 0, high = fp->light_count - 1;

        while (low < high) {
            const uint32_t mid = (low + high) / 2;

            if (fp->lights[mid].cdf <= pick) {
                low = mid + 1;
            } else {
                high = mid;
            }
        }
        light += low;
    }
    u = ql_sampler_2d(sampler, dim + QL_DIM_LIGHT_POINT);
    u1 = unit(u.u1);
    u2 = unit(u.u2);
    if (u1 + u2 > 1.0f) {
        u1 = 1.0f - u1;
        u2 = 1.0f - u2;
    }
    tri = fp->tris + light->triangle;
    ray.origin = p;
    ray.direction =
            sub(add(tri->v0, add(scale(tri->e1, u1), scale(tri->e2, u2))), p);
    cos_n = dot(ray.direction, n);
    cos_light = -dot(ray.direction, fp->shades[light->triangle].n);
    if (fp->two_sided && cos_light < 0.0f) {
        cos_light = -cos_light;
    }
    if (cos_n <= 0.0f || cos_light <= 0.0f) {
        return black;
    }
    ray.t_min = SEGMENT_EPSILON;
    ray.t_max = 1.0f - SEGMENT_EPSILON;
    if (fp_occluded(fp, &ray)) {
        return black;
    }
    inverse = 1.0f / dot(ray.direction, ray.direction);
    return scale(
            mul(reflected, fp->materials[fp->shades[light->triangle].material]
                                   .emission),
            cos_n * cos_light * inverse * inverse * light->weight);
}

static fp_vec_t trace_path(const fp_scene_t *fp, fp_ray_t ray, unsigned bounces,
        const ql_sampler_t *sampler)
{
    fp_vec_t carried = {1.0f, 1.0f, 1.0f};
    fp_vec_t light = {0.0f, 0.0f, 0.0f};

    for (unsigned bounce = 0;; bounce++) {
        const fp_material_t *material;
        fp_vec_t n;
        fp_hit_t hit;
        ql_uniform2_t u;
        const uint32_t dim = QL_DIM_BOUNCE(bounce);

        if (!fp_closest(fp, &ray, &hit)) {
            return light;
        }
        material = fp->materials + fp->shades[hit.triangle].material;
        if (bounce == 0 && (hit.front || fp->two_sided)) {
            light = material->emission;
        }
        carried = mul(carried, material->albedo);
        if (carried.x + carried.y + carried.z <= 0.0f) {
            return light;
        }
        n = fp->shades[hit.triangle].n;
        if (!hit.front) {
            n = scale(n, -1.0f);
        }
        ray.origin = add(add(ray.origin, scale(ray.direction, hit.t)),
                scale(n, EPSILON));
        if (fp->light_count > 0) {
            light = add(
                    light, direct(fp, ray.origin, n, carried, sampler, dim));
        }
        if (bounce >= bounces) {
            return light;
        }
        u = ql_sampler_2d(sampler, dim + QL_DIM_DIRECTION);
        ray.direction = fp_cosine_hemisphere(n, unit(u.u1), unit(u.u2));
        ray.t_min = 0.0f;
        ray.t_max = FP_FAR;
    }
}

void fp_pixel(const fp_scene_t *fp, unsigned x, unsigned y, unsigned width,
        unsigned height, uint32_t first, uint32_t count, unsigned bounces,
        float rgb[3])
{
    const fp_camera_t *c = &fp->camera;
    const float step = 2.0f / (float)height;
    const float left = (float)x - 0.5f * (float)width;
    ql_sampler_t sampler;

    ql_sampler_begin(&sampler, QL_SAMPLER_SOBOL, 0, (uint16_t)x, (uint16_t)y);
    for (uint32_t i = first; i < first + count; i++) {
        ql_uniform2_t u;
        float px, py;
        fp_ray_t ray;
        fp_vec_t light;

        ql_sampler_start(&sampler, i);
        u = ql_sampler_2d(&sampler, QL_DIM_PIXEL);
        px = (left + unit(u.u1)) * step;
        py = 1.0f - ((float)y + unit(u.u2)) * step;
        ray.origin = add(c->p, add(scale(c->pr, px), scale(c->pu, py)));
        ray.direction = add(c->d, add(scale(c->dr, px), scale(c->du, py)));
        ray.direction = scale(ray.direction,
                1.0f / square_root(dot(ray.direction, ray.direction)));
        ray.t_min = 0.0f;
        ray.t_max = FP_FAR;
        light = trace_path(fp, ray, bounces, &sampler);
        rgb[0] += light.x;
        rgb[1] += light.y;
        rgb[2] += light.z;
    }
}
