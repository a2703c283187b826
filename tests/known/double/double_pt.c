/* double_pt.c - a path tracer in double precision that shares nothing */
/* SPDX-License-Identifier: MIT */

#include "known/double/double_pt.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "support/ql_stats.h"

#define PI      3.14159265358979323846
#define EPSILON 1e-4 /* scene units; the Cornell box is 550 wide */

/* ---- Vectors ----------------------------------------------------------- */

static dpt_vec_t add(dpt_vec_t a, dpt_vec_t b)
{
    for (int k = 0; k < 3; k++) {
        a.v[k] += b.v[k];
    }
    return a;
}

static dpt_vec_t scale(dpt_vec_t a, double by)
{
    for (int k = 0; k < 3; k++) {
        a.v[k] *= by;
    }
    return a;
}

static dpt_vec_t sub(dpt_vec_t a, dpt_vec_t b)
{
    return add(a, scale(b, -1));
}

static double dot(dpt_vec_t a, dpt_vec_t b)
{
    return a.v[0] * b.v[0] + a.v[1] * b.v[1] + a.v[2] * b.v[2];
}

static dpt_vec_t cross(dpt_vec_t a, dpt_vec_t b)
{
    dpt_vec_t c;

    c.v[0] = a.v[1] * b.v[2] - a.v[2] * b.v[1];
    c.v[1] = a.v[2] * b.v[0] - a.v[0] * b.v[2];
    c.v[2] = a.v[0] * b.v[1] - a.v[1] * b.v[0];
    return c;
}

static dpt_vec_t unit(dpt_vec_t a)
{
    return scale(a, 1 / sqrt(dot(a, a)));
}

/* ---- Random numbers: xorshift64* (Vigna 2014), seeded by splitmix64 ------ */

typedef struct {
    uint64_t state;
} rng_t;

static void rng_seed(rng_t *rng, uint64_t seed)
{
    seed = (seed + 0x9e3779b97f4a7c15u) ^ stats_seed;
    seed = (seed ^ seed >> 30) * 0xbf58476d1ce4e5b9u;
    seed = (seed ^ seed >> 27) * 0x94d049bb133111ebu;
    rng->state = (seed ^ seed >> 31) | 1u;
}

static double rng_next(rng_t *rng)
{
    uint64_t x = rng->state;

    x ^= x >> 12;
    x ^= x << 25;
    x ^= x >> 27;
    rng->state = x;
    return ((double)((x * 0x2545f4914f6cdd1du) >> 11) + 0.5) / 9007199254740992;
}

static unsigned rng_below(rng_t *rng, unsigned count)
{
    return (unsigned)(rng_next(rng) * count);
}

/* ---- The scene --------------------------------------------------------- */

static const char *read_materials(dpt_scene_t *scene, const char *path)
{
    FILE *file = fopen(path, "r");
    dpt_material_t *m = NULL;
    char line[256];

    if (file == NULL) {
        return "cannot read the MTL";
    }
    while (fgets(line, sizeof line, file) != NULL) {
        double rgb[3];
        char name[32];

        if (sscanf(line, " newmtl %31s", name) == 1 &&
                scene->material_count < DPT_MATERIALS_MAX) {
            m = scene->materials + scene->material_count++;
            memset(m, 0, sizeof *m);
            memcpy(m->name, name, sizeof name);
        } else if (m != NULL && sscanf(line, " Kd %lf %lf %lf", rgb, rgb + 1,
                                        rgb + 2) == 3) {
            memcpy(m->albedo, rgb, sizeof rgb);
        } else if (m != NULL && sscanf(line, " Ke %lf %lf %lf", rgb, rgb + 1,
                                        rgb + 2) == 3) {
            memcpy(m->emission, rgb, sizeof rgb);
        }
    }
    (void)fclose(file);
    return scene->material_count > 0 ? NULL : "the MTL holds no material";
}

/* The name of the MTL beside the OBJ. */
static const char *read_library(
        dpt_scene_t *scene, const char *obj, const char *name)
{
    const char *slash = strrchr(obj, '/');
    const int folder = slash != NULL ? (int)(slash - obj) + 1 : 0;
    char path[512];

    (void)snprintf(path, sizeof path, "%.*s%s", folder, obj, name);
    return read_materials(scene, path);
}

static bool add_face(dpt_scene_t *scene, const dpt_vec_t *vertices,
        unsigned vertex_count, const char *text, unsigned material)
{
    unsigned corner[8], count = 0;
    int used;

    while (count < 8 && sscanf(text, "%u%n", corner + count, &used) == 1) {
        if (corner[count] < 1 || corner[count] > vertex_count) {
            return false;
        }
        count++;
        text += used;
    }
    for (unsigned i = 2; i < count; i++) {
        dpt_triangle_t *t = scene->triangles + scene->triangle_count;
        dpt_vec_t n;

        if (scene->triangle_count == DPT_TRIANGLES_MAX) {
            return false;
        }
        scene->triangle_count++;
        t->corner = vertices[corner[0] - 1];
        t->e1 = sub(vertices[corner[i - 1] - 1], t->corner);
        t->e2 = sub(vertices[corner[i] - 1], t->corner);
        n = cross(t->e1, t->e2);
        t->area = sqrt(dot(n, n)) / 2;
        t->normal = unit(n);
        t->material = material;
    }
    return count >= 3;
}

static const char *read_object(dpt_scene_t *scene, FILE *file, const char *path)
{
    static dpt_vec_t vertices[DPT_TRIANGLES_MAX];
    unsigned vertex_count = 0, material = 0;
    char line[256], name[64];

    while (fgets(line, sizeof line, file) != NULL) {
        if (line[0] == 'v' && line[1] == ' ') {
            double *v = vertices[vertex_count].v;

            if (vertex_count == DPT_TRIANGLES_MAX ||
                    sscanf(line, "v %lf %lf %lf", v, v + 1, v + 2) != 3) {
                return "a vertex that is not three numbers";
            }
            vertex_count++;
        } else if (sscanf(line, "mtllib %63s", name) == 1) {
            const char *error = read_library(scene, path, name);

            if (error != NULL) {
                return error;
            }
        } else if (sscanf(line, "usemtl %63s", name) == 1) {
            for (material = 0; material < scene->material_count; material++) {
                if (strcmp(scene->materials[material].name, name) == 0) {
                    break;
                }
            }
            if (material == scene->material_count) {
                return "a material the MTL lacks";
            }
        } else if (line[0] == 'f' && !add_face(scene, vertices, vertex_count,
                                             line + 1, material)) {
            return "a face that is not three to eight vertex numbers";
        }
    }
    return scene->triangle_count > 0 ? NULL : "no faces";
}

/* ---- The tree: halves at the median of the longest side ------------------ */

static double centre_of(const dpt_triangle_t *t, int axis)
{
    return t->corner.v[axis] + (t->e1.v[axis] + t->e2.v[axis]) / 3;
}

static void node_bounds(const dpt_scene_t *scene, dpt_node_t *node)
{
    for (int k = 0; k < 3; k++) {
        node->low.v[k] = HUGE_VAL;
        node->high.v[k] = -HUGE_VAL;
        for (unsigned i = node->first; i < node->first + node->count; i++) {
            const dpt_triangle_t *t = scene->triangles + i;
            const double c = t->corner.v[k];
            const double a = c + t->e1.v[k], b = c + t->e2.v[k];

            node->low.v[k] = fmin(node->low.v[k], fmin(c, fmin(a, b)));
            node->high.v[k] = fmax(node->high.v[k], fmax(c, fmax(a, b)));
        }
        node->low.v[k] -= EPSILON;
        node->high.v[k] += EPSILON;
    }
}

static void sort_by_centre(dpt_triangle_t *t, unsigned count, int axis)
{
    for (unsigned i = 1; i < count; i++) {
        const dpt_triangle_t moving = t[i];
        unsigned j = i;

        for (; j > 0 && centre_of(t + j - 1, axis) > centre_of(&moving, axis);
                j--) {
            t[j] = t[j - 1];
        }
        t[j] = moving;
    }
}

static void build_tree(dpt_scene_t *scene)
{
    scene->node_count = 1;
    scene->nodes[0].first = 0;
    scene->nodes[0].count = scene->triangle_count;
    for (unsigned i = 0; i < scene->node_count; i++) {
        dpt_node_t *node = scene->nodes + i;
        dpt_node_t *child = scene->nodes + scene->node_count;
        dpt_vec_t size;
        int axis = 0;

        node_bounds(scene, node);
        if (node->count <= 2) {
            continue;
        }
        size = sub(node->high, node->low);
        axis = size.v[1] > size.v[axis] ? 1 : axis;
        axis = size.v[2] > size.v[axis] ? 2 : axis;
        node->axis = axis;
        sort_by_centre(scene->triangles + node->first, node->count, axis);
        child[0].first = node->first;
        child[0].count = node->count / 2;
        child[1].first = node->first + node->count / 2;
        child[1].count = node->count - node->count / 2;
        node->first = scene->node_count;
        node->count = 0;
        scene->node_count += 2;
    }
}

const char *dpt_read(dpt_scene_t *scene, const char *path)
{
    FILE *file = fopen(path, "r");
    const char *error;

    memset(scene, 0, sizeof *scene);
    if (file == NULL) {
        return "cannot read the OBJ";
    }
    error = read_object(scene, file, path);
    (void)fclose(file);
    if (error != NULL) {
        return error;
    }
    build_tree(scene);
    for (unsigned i = 0; i < scene->triangle_count; i++) {
        const dpt_triangle_t *t = scene->triangles + i;
        const double *e = scene->materials[t->material].emission;

        if (e[0] > 0 || e[1] > 0 || e[2] > 0) {
            scene->lights[scene->light_count++] = i;
            scene->light_area += t->area;
        }
    }
    return NULL;
}

/* ---- Rays -------------------------------------------------------------- */

typedef struct {
    dpt_vec_t origin, direction;
    dpt_vec_t inverse; /* 1 / direction */
} ray_t;

static ray_t ray_from(dpt_vec_t origin, dpt_vec_t direction)
{
    ray_t ray;

    ray.origin = origin;
    ray.direction = direction;
    for (int k = 0; k < 3; k++) {
        ray.inverse.v[k] = 1 / (direction.v[k] != 0 ? direction.v[k] : 1e-300);
    }
    return ray;
}

static bool box_hit(const dpt_node_t *node, const ray_t *ray, double end)
{
    double near = 0, far = end;

    for (int k = 0; k < 3; k++) {
        const double a =
                (node->low.v[k] - ray->origin.v[k]) * ray->inverse.v[k];
        const double b =
                (node->high.v[k] - ray->origin.v[k]) * ray->inverse.v[k];

        near = a < b ? (a > near ? a : near) : (b > near ? b : near);
        far = a < b ? (b < far ? b : far) : (a < far ? a : far);
    }
    return near <= far;
}

/* The distance at which a ray meets a triangle, or a negative number. */
static double triangle_hit(const dpt_triangle_t *t, const ray_t *ray)
{
    const dpt_vec_t p = cross(ray->direction, t->e2);
    const double det = dot(t->e1, p);
    const dpt_vec_t s = sub(ray->origin, t->corner);
    double u, v, inverse;
    dpt_vec_t q;

    if (fabs(det) < 1e-12) {
        return -1;
    }
    inverse = 1 / det;
    u = dot(s, p) * inverse;
    if (u < 0 || u > 1) {
        return -1;
    }
    q = cross(s, t->e1);
    v = dot(ray->direction, q) * inverse;
    return v < 0 || u + v > 1 ? -1 : dot(t->e2, q) * inverse;
}

/* The nearest triangle before *distance, which is updated; NULL if none. */
static const dpt_triangle_t *trace(
        const dpt_scene_t *scene, const ray_t *ray, double *distance)
{
    const dpt_triangle_t *nearest = NULL;
    unsigned stack[64], depth = 0;

    stack[depth++] = 0;
    while (depth > 0) {
        const dpt_node_t *node = scene->nodes + stack[--depth];

        if (!box_hit(node, ray, *distance)) {
            continue;
        }
        if (node->count == 0) {
            /* the nearer child on top; a level adds one: 14 at most */
            const unsigned far = ray->direction.v[node->axis] > 0 ? 1 : 0;

            stack[depth++] = node->first + far;
            stack[depth++] = node->first + 1 - far;
        }
        for (unsigned i = 0; i < node->count; i++) {
            const dpt_triangle_t *t = scene->triangles + node->first + i;
            const double at = triangle_hit(t, ray);

            if (at > EPSILON && at < *distance) {
                *distance = at;
                nearest = t;
            }
        }
    }
    return nearest;
}

/* ---- Light transport --------------------------------------------------- */

typedef struct {
    double u1, u2;
} pair_t;

static pair_t random_pair(rng_t *rng)
{
    pair_t u;

    u.u1 = rng_next(rng);
    u.u2 = rng_next(rng);
    return u;
}

/* Irradiance / pi from the emitters at p, by one point on their area. */
static void direct_light(const dpt_scene_t *scene, dpt_vec_t p, dpt_vec_t n,
        pair_t u, double choice, double light[3])
{
    double area = choice * scene->light_area, root, distance, end, cosines, g;
    const dpt_triangle_t *t = NULL;
    dpt_vec_t w;
    ray_t ray;

    for (unsigned i = 0; i < scene->light_count; i++) {
        t = scene->triangles + scene->lights[i];
        area -= t->area;
        if (area < 0) {
            break;
        }
    }
    memset(light, 0, 3 * sizeof *light);
    root = sqrt(u.u1);
    w = add(t->corner,
            add(scale(t->e1, root * (1 - u.u2)), scale(t->e2, root * u.u2)));
    w = sub(w, p);
    distance = sqrt(dot(w, w));
    w = scale(w, 1 / distance);
    cosines = dot(w, n) > 0 ? -dot(w, n) * dot(w, t->normal) : 0;
    if (cosines <= 0) {
        return;
    }
    end = distance - EPSILON;
    ray = ray_from(p, w);
    g = cosines * scene->light_area / (PI * distance * distance);
    if (trace(scene, &ray, &end) == NULL) {
        for (int k = 0; k < 3; k++) {
            light[k] = g * scene->materials[t->material].emission[k];
        }
    }
}

/* A cosine-distributed direction about n. */
static dpt_vec_t reflect(dpt_vec_t n, pair_t u)
{
    const dpt_vec_t x = {{1, 0, 0}}, y = {{0, 1, 0}};
    const dpt_vec_t s = unit(cross(n, fabs(n.v[0]) > 0.5 ? y : x));
    const dpt_vec_t t = cross(n, s);
    const double r = sqrt(u.u1), phi = 2 * PI * u.u2;

    return unit(add(scale(n, sqrt(1 - u.u1)),
            add(scale(s, r * cos(phi)), scale(t, r * sin(phi)))));
}

static void add_path(const dpt_scene_t *scene, ray_t ray, unsigned bounces,
        const pair_t strata[2], rng_t *rng, double rgb[3])
{
    double weight[3] = {1, 1, 1};

    for (unsigned bounce = 0; bounce <= bounces; bounce++) {
        double distance = HUGE_VAL, light[3];
        const dpt_triangle_t *t = trace(scene, &ray, &distance);
        const dpt_material_t *m;
        dpt_vec_t p, n;
        bool front;

        if (t == NULL) {
            return;
        }
        m = scene->materials + t->material;
        front = dot(t->normal, ray.direction) < 0;
        n = front ? t->normal : scale(t->normal, -1);
        p = add(ray.origin, scale(ray.direction, distance));
        direct_light(scene, p, n, bounce == 0 ? strata[0] : random_pair(rng),
                rng_next(rng), light);
        for (int k = 0; k < 3; k++) {
            rgb[k] += bounce == 0 && front ? m->emission[k] : 0;
            weight[k] *= m->albedo[k];
            rgb[k] += weight[k] * light[k];
        }
        ray = ray_from(
                p, reflect(n, bounce == 0 ? strata[1] : random_pair(rng)));
    }
}

static void shuffle(unsigned *order, unsigned count, rng_t *rng)
{
    for (unsigned i = 0; i < count; i++) {
        const unsigned j = rng_below(rng, i + 1);

        order[i] = order[j];
        order[j] = i;
    }
}

static pair_t stratum(unsigned cell, unsigned side, rng_t *rng)
{
    pair_t u = random_pair(rng);

    u.u1 = (cell % side + u.u1) / side;
    u.u2 = (cell / side + u.u2) / side;
    return u;
}

enum { SIDE_MAX = 64 };

static void render_pixel(const dpt_scene_t *scene, const dpt_vec_t frame[4],
        double x, double y, double pixel, unsigned side, unsigned bounces,
        rng_t *rng, double rgb[3])
{
    static unsigned order[2][SIDE_MAX * SIDE_MAX];
    const unsigned count = side * side;

    shuffle(order[0], count, rng);
    shuffle(order[1], count, rng);
    memset(rgb, 0, 3 * sizeof *rgb);
    for (unsigned i = 0; i < count; i++) {
        const pair_t in = stratum(i, side, rng);
        const pair_t strata[2] = {stratum(order[0][i], side, rng),
                stratum(order[1][i], side, rng)};
        dpt_vec_t d = frame[1];

        d = add(d, scale(frame[2], x + in.u1 * pixel));
        d = add(d, scale(frame[3], y - in.u2 * pixel));
        add_path(scene, ray_from(frame[0], unit(d)), bounces, strata, rng, rgb);
    }
    for (int k = 0; k < 3; k++) {
        rgb[k] /= count;
    }
}

void dpt_render(const dpt_scene_t *scene, const dpt_camera_t *camera,
        unsigned width, unsigned height, unsigned side, unsigned bounces,
        uint64_t seed, double *rgb)
{
    const double tangent = tan(camera->fov * PI / 360);
    const double pixel = 2.0 / height;
    dpt_vec_t frame[4]; /* eye, forward, right, up */

    frame[0] = camera->eye;
    frame[1] = unit(sub(camera->look, camera->eye));
    frame[2] = unit(cross(frame[1], camera->up));
    frame[3] = scale(cross(frame[2], frame[1]), tangent);
    frame[2] = scale(frame[2], tangent);
    side = side < SIDE_MAX ? side : SIDE_MAX;
    for (unsigned y = 0; y < height; y++) {
        for (unsigned x = 0; x < width; x++, rgb += 3) {
            rng_t rng;

            rng_seed(&rng, seed + (uint64_t)y * width + x);
            render_pixel(scene, frame, x * pixel - (double)width / height,
                    1 - y * pixel, pixel, side, bounces, &rng, rgb);
        }
    }
}
