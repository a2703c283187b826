/* mini_scene.c - build the blob of a small scene, on the grid itself */
/* SPDX-License-Identifier: MIT */

#include "support/picture/mini_scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/ql_crc.h"
#include "base/ql_settings.h"
#include "blob/ql_blob_open.h"
#include "sample/ql_table.h"
#include "support/ql_double.h"

static void give_up(const char *what)
{
    (void)fprintf(stderr, "mini_scene: %s\n", what);
    exit(2);
}

/* ---- What tests add ---------------------------------------------------- */

void mini_begin(mini_scene_t *m)
{
    memset(m, 0, sizeof *m);
    m->width = m->height = 1;
    m->node_bits = MINI_BITS_MAX;
    m->leaf_max = 4;
    m->light_weight_scale = 1;
    mini_eye(m, 16384, 16384, 16384);
    mini_look(m, 0, 0, 0.5);
}

uint16_t mini_material(mini_scene_t *m, double albedo, double emission)
{
    if (m->material_count == MINI_MATERIALS_MAX) {
        give_up("too many materials");
    }
    for (int k = 0; k < 3; k++) {
        m->materials[m->material_count].albedo[k] = albedo;
        m->materials[m->material_count].emission[k] = emission;
    }
    return (uint16_t)m->material_count++;
}

uint16_t mini_rgb(
        mini_scene_t *m, const double albedo[3], const double emission[3])
{
    const uint16_t material = mini_material(m, 0, 0);

    memcpy(m->materials[material].albedo, albedo, 3 * sizeof *albedo);
    memcpy(m->materials[material].emission, emission, 3 * sizeof *emission);
    return material;
}

static double sum3(const double v[3])
{
    return v[0] + v[1] + v[2];
}

void mini_gloss_rgb(mini_scene_t *m, uint16_t material, ql_gloss_kind_t kind,
        const double specular[3], double parameter)
{
    mini_material_t *const at = m->materials + material;

    memcpy(at->specular, specular, sizeof at->specular);
    at->gloss = (uint16_t)kind;
    at->parameter = parameter;
    at->chance = kind == QL_GLOSS_GLASS ? 1
                 : sum3(specular) > 0
                         ? sum3(specular) / (sum3(specular) + sum3(at->albedo))
                         : 0;
}

void mini_gloss(mini_scene_t *m, uint16_t material, ql_gloss_kind_t kind,
        double specular, double parameter)
{
    const double gray[3] = {specular, specular, specular};

    mini_gloss_rgb(m, material, kind, gray, parameter);
}

uint16_t mini_vertex(mini_scene_t *m, int32_t x, int32_t y, int32_t z)
{
    int32_t *const v = m->vertices[m->vertex_count];

    if (m->vertex_count == MINI_VERTICES_MAX) {
        give_up("too many vertices");
    }
    v[0] = x;
    v[1] = y;
    v[2] = z;
    return (uint16_t)m->vertex_count++;
}

void mini_face(
        mini_scene_t *m, uint16_t a, uint16_t b, uint16_t c, uint16_t material)
{
    const uint16_t vertex[3] = {a, b, c};

    if (m->triangle_count == MINI_TRIANGLES_MAX) {
        give_up("too many triangles");
    }
    memcpy(m->triangles[m->triangle_count].vertex, vertex, sizeof vertex);
    m->triangles[m->triangle_count].sphere = false;
    m->triangles[m->triangle_count].rank = (uint16_t)m->triangle_count;
    m->triangles[m->triangle_count++].material = material;
}

uint16_t mini_sphere(mini_scene_t *m, const int32_t centre[3], int32_t radius,
        uint16_t material)
{
    ql_blob_sphere_t *const sphere = m->spheres + m->sphere_count;

    if (m->sphere_count == MINI_SPHERES_MAX) {
        give_up("too many spheres");
    }
    for (int k = 0; k < 3; k++) {
        sphere->centre[k] = (uint32_t)centre[k];
    }
    sphere->radius = (uint32_t)radius;
    mini_face(m, (uint16_t)m->sphere_count, 0, 0, material);
    m->triangles[m->triangle_count - 1].sphere = true;
    return (uint16_t)m->sphere_count++;
}

void mini_normal(mini_scene_t *m, uint16_t vertex, const double normal[3])
{
    memcpy(m->normals[vertex], normal, sizeof m->normals[vertex]);
    m->smooth = true;
}

void mini_triangle(mini_scene_t *m, const int32_t a[3], const int32_t b[3],
        const int32_t c[3], uint16_t material)
{
    const uint16_t i = mini_vertex(m, a[0], a[1], a[2]);
    const uint16_t j = mini_vertex(m, b[0], b[1], b[2]);
    const uint16_t k = mini_vertex(m, c[0], c[1], c[2]);

    mini_face(m, i, j, k, material);
}

void mini_quad(mini_scene_t *m, const int32_t a[3], const int32_t b[3],
        const int32_t c[3], const int32_t d[3], uint16_t material)
{
    const uint16_t i = mini_vertex(m, a[0], a[1], a[2]);
    const uint16_t j = mini_vertex(m, b[0], b[1], b[2]);
    const uint16_t k = mini_vertex(m, c[0], c[1], c[2]);
    const uint16_t l = mini_vertex(m, d[0], d[1], d[2]);

    mini_face(m, i, j, k, material);
    mini_face(m, i, k, l, material);
}

void mini_room(mini_scene_t *m, const int32_t low[3], const int32_t high[3],
        uint16_t material)
{
    /* corner i is high on axis k where bit k is set */
    static const uint8_t faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5},
            {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    uint16_t v[8];

    for (unsigned i = 0; i < 8; i++) {
        v[i] = mini_vertex(m, i & 1 ? high[0] : low[0],
                i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]);
    }
    /* listed counter-clockwise from outside, so turned around here */
    for (unsigned f = 0; f < 6; f++) {
        const uint8_t *const c = faces[f];

        mini_face(m, v[c[0]], v[c[2]], v[c[1]], material);
        mini_face(m, v[c[0]], v[c[3]], v[c[2]], material);
    }
}

static uint16_t point_on_ball(mini_scene_t *m, const double v[3])
{
    enum { RADIUS = 16000, CENTRE = 16384 };
    const double size = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);

    return mini_vertex(m, CENTRE + (int32_t)lround(RADIUS * v[0] / size),
            CENTRE + (int32_t)lround(RADIUS * v[1] / size),
            CENTRE + (int32_t)lround(RADIUS * v[2] / size));
}

/* One face of an octahedron, its sides cut into parts, blown up. Fronts look
 * inward. Corners on the sides are there twice, but equal, so it is closed. */
static void blow_up(mini_scene_t *m, const double corner[3][3], int parts,
        uint16_t material)
{
    uint16_t row[2][64];

    for (int i = 0; i <= parts; i++) {
        for (int j = 0; j <= i; j++) {
            double v[3];

            for (int k = 0; k < 3; k++) {
                v[k] = corner[0][k] * (parts - i) + corner[1][k] * (i - j) +
                       corner[2][k] * j;
            }
            row[i & 1][j] = point_on_ball(m, v);
        }
        for (int j = 0; i > 0 && j < i; j++) {
            const uint16_t *const above = row[(i - 1) & 1], *const below =
                                                                    row[i & 1];

            mini_face(m, above[j], below[j + 1], below[j], material);
            if (j + 1 < i) {
                mini_face(m, above[j], above[j + 1], below[j + 1], material);
            }
        }
    }
}

void mini_ball(mini_scene_t *m, int parts, uint16_t material)
{
    for (int octant = 0; octant < 8; octant++) {
        const double x = octant & 1 ? -1 : 1, y = octant & 2 ? -1 : 1;
        const double z = octant & 4 ? -1 : 1;
        const bool odd = x * y * z < 0;
        const double corner[3][3] = {{x, 0, 0}, {0, odd ? 0 : y, odd ? z : 0},
                {0, odd ? y : 0, odd ? 0 : z}};

        blow_up(m, corner, parts, material);
    }
}

/* A corner of a ball with its normal: where it is around, in turns, and how far
 * from the pole, in half turns. */
static uint16_t corner_of_ball(mini_scene_t *m, const int32_t centre[3],
        int32_t radius, double turns, double from_pole)
{
    const double around = 2 * 3.14159265358979323846 * turns;
    const double down = 3.14159265358979323846 * from_pole;
    const double n[3] = {
            sin(down) * cos(around), sin(down) * sin(around), cos(down)};
    const uint16_t v =
            mini_vertex(m, centre[0] + (int32_t)lround(radius * n[0]),
                    centre[1] + (int32_t)lround(radius * n[1]),
                    centre[2] + (int32_t)lround(radius * n[2]));

    mini_normal(m, v, n);
    return v;
}

void mini_smooth_ball(mini_scene_t *m, const int32_t centre[3], int32_t radius,
        int parts, uint16_t material)
{
    const int around = 3 * parts, down = 2 * parts;

    for (int i = 0; i < down; i++) {
        for (int j = 0; j < around; j++) {
            uint16_t v[4];

            for (int k = 0; k < 4; k++) {
                v[k] = corner_of_ball(m, centre, radius,
                        (double)((j + (k == 1 || k == 2)) % around) / around,
                        (double)(i + k / 2) / down);
            }
            if (i < down - 1) {
                mini_face(m, v[0], v[3], v[2], material);
            }
            if (i > 0) {
                mini_face(m, v[0], v[2], v[1], material);
            }
        }
    }
}

static void put_wide(uint32_t words[2], double value)
{
    const int64_t q32 = (int64_t)floor(ldexp(value, 32) + 0.5);

    words[0] = (uint32_t)((uint64_t)q32 & 0xffffffffu);
    words[1] = (uint32_t)((uint64_t)q32 >> 32);
}

static uint32_t q30(double value)
{
    return (uint32_t)(int32_t)floor(ldexp(value, 30) + 0.5);
}

void mini_eye(mini_scene_t *m, double x, double y, double z)
{
    put_wide(m->camera.at[QL_CAMERA_BASE][0], x);
    put_wide(m->camera.at[QL_CAMERA_BASE][1], y);
    put_wide(m->camera.at[QL_CAMERA_BASE][2], z);
}

void mini_look(mini_scene_t *m, double x, double y, double z)
{
    m->camera.towards[QL_CAMERA_BASE][0] = q30(x);
    m->camera.towards[QL_CAMERA_BASE][1] = q30(y);
    m->camera.towards[QL_CAMERA_BASE][2] = q30(z);
}

void mini_field(mini_scene_t *m, const double right[3], const double up[3])
{
    for (int k = 0; k < 3; k++) {
        m->camera.towards[QL_CAMERA_RIGHT][k] = q30(right[k]);
        m->camera.towards[QL_CAMERA_UP][k] = q30(up[k]);
    }
}

void mini_window(mini_scene_t *m, const double right[3], const double up[3])
{
    for (int k = 0; k < 3; k++) {
        put_wide(m->camera.at[QL_CAMERA_RIGHT][k], right[k]);
        put_wide(m->camera.at[QL_CAMERA_UP][k], up[k]);
    }
}

void mini_lens(mini_scene_t *m, const double p[2][3], const double d[2][3])
{
    for (int i = 0; i < 6; i++) {
        put_wide(m->lens.p[i / 3][i % 3], p[i / 3][i % 3]);
        m->lens.d[i / 3][i % 3] = q30(d[i / 3][i % 3]);
    }
    m->has_lens = true;
}

void mini_sky(mini_scene_t *m, double r, double g, double b)
{
    m->has_sky = true;
    m->sky[0] = r;
    m->sky[1] = g;
    m->sky[2] = b;
}

/* A row of a table: 2^16 shared out by largest remainder, every cell that has
 * weight getting one at least. */
static void table_row(uint16_t *row, const double *weights, unsigned count)
{
    uint32_t mass[MINI_TEXELS_MAX], bound = 0;
    double total = 0;
    int32_t left = QL_TABLE_WHOLE;
    unsigned used = 0;

    for (unsigned i = 0; i < count; i++) {
        total += weights[i];
    }
    for (unsigned i = 0; i < count; i++) {
        mass[i] = total > 0 ? (uint32_t)(weights[i] / total * left) : 0;
        mass[i] += weights[i] > 0 && mass[i] == 0;
        used = weights[i] > 0 ? i + 1 : used;
    }
    for (unsigned i = 0; i < count; i++) {
        left -= (int32_t)mass[i];
    }
    while (used > 0 && left != 0) {
        const int step = left > 0 ? 1 : -1;
        double most = -1e30;
        unsigned at = used - 1;

        for (unsigned i = 0; i < used; i++) {
            const double due = (weights[i] / total * QL_TABLE_WHOLE - mass[i]);

            if (weights[i] > 0 && step * due > most &&
                    (mass[i] > 1 || step > 0)) {
                most = step * due;
                at = i;
            }
        }
        mass[at] += (uint32_t)step;
        left -= step;
    }
    memset(row, 0, count * sizeof *row);
    for (unsigned i = 0; i < used; i++) {
        row[i] = (uint16_t)bound;
        bound += mass[i];
    }
    row[0] = (uint16_t)used;
}

/* The rows of one dimension: sums over all that is below each of its cells. */
static void table_level(mini_scene_t *m, const double *weights, unsigned rows,
        unsigned count, unsigned below)
{
    double sums[MINI_TEXELS_MAX];

    if (m->word_count + rows * count > MINI_WORDS_MAX ||
            count > MINI_TEXELS_MAX) {
        give_up("too many words of tables");
    }
    for (unsigned r = 0; r < rows; r++) {
        for (unsigned i = 0; i < count; i++) {
            sums[i] = 0;
            for (unsigned k = 0; k < below; k++) {
                sums[i] += weights[(r * count + i) * below + k];
            }
        }
        table_row(m->words + m->word_count, sums, count);
        m->word_count += count;
    }
}

uint16_t mini_table(mini_scene_t *m, unsigned dims, const uint16_t *count,
        const double *weights)
{
    ql_blob_distribution_t *const d = m->tables + m->table_count;
    unsigned rows = 1, below = 1;

    if (m->table_count == MINI_TABLES_MAX) {
        give_up("too many tables");
    }
    d->first = m->word_count;
    d->dims = (uint16_t)dims;
    for (unsigned k = 0; k < QL_TABLE_DIMS_MAX; k++) {
        d->count[k] = k < dims ? count[k] : 1;
        below *= d->count[k];
    }
    for (unsigned k = dims; k-- > 0;) {
        below /= count[k];
        table_level(m, weights, rows, count[k], below);
        rows *= count[k];
    }
    return (uint16_t)m->table_count++;
}

/* m << e for each channel, as ql_blob_texel_t packs them. */
static uint32_t rgb9e5(const double rgb[3], int radiance_exp)
{
    uint32_t packed = 0;
    unsigned e = 0;

    for (int k = 0; k < 3; k++) {
        while (ldexp(rgb[k], 32 - radiance_exp - (int)e) >= 511.5) {
            e++;
        }
    }
    if (e > 23) {
        give_up("a texel is too bright");
    }
    for (int k = 0; k < 3; k++) {
        packed |= (uint32_t)(ldexp(rgb[k], 32 - radiance_exp - (int)e) + 0.5)
                  << 9 * k;
    }
    return packed | (uint32_t)e << 27;
}

/* The radiance of a packed texel. */
static double texel_part(uint32_t packed, int k, int radiance_exp)
{
    return ldexp(
            packed >> 9 * k & 511u, (int)(packed >> 27) - 32 + radiance_exp);
}

void mini_sky_map(mini_scene_t *m, unsigned width, unsigned height,
        const double (*rgb)[3], double rotate)
{
    static double weights[MINI_TEXELS_MAX];
    const uint16_t count[2] = {(uint16_t)width, (uint16_t)height};

    if (width * height > MINI_TEXELS_MAX) {
        give_up("too many texels");
    }
    mini_sky(m, 0, 0, 0);
    for (unsigned i = 0; i < width * height; i++) {
        const double row = i / width;
        const uint32_t packed = rgb9e5(rgb[i], m->radiance_exp);
        const double part =
                cos(PI * row / height) - cos(PI * (row + 1) / height);

        weights[i] = 0;
        for (int k = 0; k < 3; k++) {
            const double radiance = texel_part(packed, k, m->radiance_exp);

            weights[i] += radiance * part;
            m->sky[k] += radiance * part / (2 * width);
            m->texels[i][k] = radiance;
        }
    }
    m->sky_entry.width = count[0];
    m->sky_entry.height = count[1];
    m->sky_entry.rotate =
            (uint32_t)(uint64_t)floor(ldexp(rotate - floor(rotate), 32) + 0.5);
    m->sky_entry.table = mini_table(m, 2, count, weights);
}

void mini_move(mini_scene_t *m, int32_t x, int32_t y, int32_t z)
{
    const int32_t by[3] = {x, y, z};

    for (int k = 0; k < 3; k++) {
        m->camera.at[QL_CAMERA_BASE][k][1] += (uint32_t)by[k];
        for (unsigned i = 0; i < m->vertex_count; i++) {
            m->vertices[i][k] += by[k];
        }
        for (unsigned i = 0; i < m->sphere_count; i++) {
            m->spheres[i].centre[k] += (uint32_t)(by[k] * 256);
        }
    }
}

/* ---- The tree: halves at the median of the longest side ------------------ */

typedef struct {
    int32_t low[3], high[3];
} box_t;

/* Where a node leads, as root_link and root_meta say it. */
typedef struct {
    unsigned link, meta;
    box_t box;
} node_t;

static struct {
    node_t child[2 * MINI_TRIANGLES_MAX];
    unsigned pair_count, depth;
} tree;

static void widen(box_t *box, int k, int32_t low, int32_t high)
{
    box->low[k] = low < box->low[k] ? low : box->low[k];
    box->high[k] = high > box->high[k] ? high : box->high[k];
}

static box_t bounds(const mini_scene_t *m, unsigned first, unsigned count)
{
    box_t box = {{QL_GRID_MAX, QL_GRID_MAX, QL_GRID_MAX}, {0, 0, 0}};

    for (unsigned i = 3 * first; i < 3 * (first + count); i++) {
        const mini_triangle_t *const t = m->triangles + i / 3;
        const int32_t *v = m->vertices[t->vertex[i % 3]];
        const ql_blob_sphere_t *const s = m->spheres + t->vertex[0];

        for (int k = 0; k < 3; k++) {
            if (t->sphere) {
                widen(&box, k, (int32_t)((s->centre[k] - s->radius) / 256),
                        (int32_t)((s->centre[k] + s->radius + 255) / 256));
            } else {
                widen(&box, k, v[k], v[k]);
            }
        }
    }
    return box;
}

/* Three times the centre. */
static int32_t middle(const mini_scene_t *m, unsigned triangle, unsigned axis)
{
    const uint16_t *v = m->triangles[triangle].vertex;

    if (m->triangles[triangle].sphere) {
        return (int32_t)(3 * m->spheres[v[0]].centre[axis] / 256);
    }
    return m->vertices[v[0]][axis] + m->vertices[v[1]][axis] +
           m->vertices[v[2]][axis];
}

static void sort(mini_scene_t *m, unsigned first, unsigned count, unsigned axis)
{
    for (unsigned i = first + 1; i < first + count; i++) {
        for (unsigned j = i;
                j > first && middle(m, j - 1, axis) > middle(m, j, axis); j--) {
            const mini_triangle_t swap = m->triangles[j];

            m->triangles[j] = m->triangles[j - 1];
            m->triangles[j - 1] = swap;
        }
    }
}

/* As deep as the core's stack allows; leaves are larger then. */
static node_t build(
        mini_scene_t *m, unsigned first, unsigned count, unsigned level)
{
    const box_t box = bounds(m, first, count);
    node_t node = {first, 3 + count, box};
    unsigned axis = 0;

    if (count <= m->leaf_max || level == QL_CFG_BVH_STACK) {
        if (count > (m->node_bits == 8 ? QL_LEAF_MAX - 1 : QL_LEAF_MAX)) {
            give_up("the tree is too deep");
        }
        return node;
    }
    for (unsigned k = 1; k < 3; k++) {
        if (box.high[k] - box.low[k] > box.high[axis] - box.low[axis]) {
            axis = k;
        }
    }
    sort(m, first, count, axis);
    node.link = tree.pair_count++;
    node.meta = axis;
    tree.depth = level + 1 > tree.depth ? level + 1 : tree.depth;
    tree.child[2 * node.link] = build(m, first, count / 2, level + 1);
    tree.child[2 * node.link + 1] =
            build(m, first + count / 2, count - count / 2, level + 1);
    return node;
}

/* ---- The bytes --------------------------------------------------------- */

typedef struct {
    mini_scene_t *m;
    size_t at;
    uint16_t material[MINI_MATERIALS_MAX]; /* where each is written */
} writer_t;

static void put(writer_t *w, uint64_t value, unsigned bytes)
{
    if (w->at + bytes > sizeof w->m->blob) {
        give_up("the blob is too large");
    }
    for (unsigned i = 0; i < bytes; i++) {
        ((uint8_t *)w->m->blob)[w->at++] = (uint8_t)(value >> 8 * i & 0xffu);
    }
}

/* value = *mantissa 2^*exponent, the mantissa's top bit set */
static void split(double value, uint32_t *mantissa, int *exponent)
{
    uint64_t rounded = (uint64_t)(ldexp(frexp(value, exponent), 32) + 0.5);

    if (rounded >> 32 != 0) {
        rounded >>= 1;
        (*exponent)++;
    }
    *mantissa = (uint32_t)rounded;
    *exponent -= 32;
}

/* |e1 x e2|; of a sphere 8 pi r^2 */
static double twice_area(const mini_scene_t *m, unsigned triangle)
{
    const uint16_t *v = m->triangles[triangle].vertex;
    double e[2][3], sum = 0;

    if (m->triangles[triangle].sphere) {
        const double r = m->spheres[v[0]].radius / 256.0;

        return 8 * PI * r * r;
    }

    for (int k = 0; k < 3; k++) {
        e[0][k] = m->vertices[v[1]][k] - m->vertices[v[0]][k];
        e[1][k] = m->vertices[v[2]][k] - m->vertices[v[0]][k];
    }
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const double n = e[0][i] * e[1][j] - e[0][j] * e[1][i];

        sum += n * n;
    }
    return sqrt(sum);
}

static void put_camera(writer_t *w)
{
    const ql_blob_camera_t *c = &w->m->camera;

    for (int i = 0; i < 18; i++) {
        put(w, c->at[i / 6][i % 6 / 2][i % 2], 4);
    }
    for (int i = 0; i < 9; i++) {
        put(w, c->towards[i / 3][i % 3], 4);
    }
}

static void put_triangles(writer_t *w)
{
    const mini_scene_t *m = w->m;

    for (unsigned i = 0; i < m->triangle_count; i++) {
        const double area = twice_area(m, i);
        uint32_t mantissa;
        int e;

        if (m->triangles[i].sphere) {
            put(w, m->triangles[i].vertex[0], 2);
            put(w, 0, 4);
            put(w, w->material[m->triangles[i].material], 2);
            put(w, 0, 4);
            continue;
        }
        if (!(area > 0)) {
            give_up("a triangle without area");
        }
        split(1 / area, &mantissa, &e);
        if (mantissa > 0xffffffe0u) { /* would round up to 2^32 */
            mantissa = 0x80000000u;
            e++;
        }
        for (int k = 0; k < 3; k++) {
            put(w, m->triangles[i].vertex[k], 2);
        }
        put(w, w->material[m->triangles[i].material], 2);
        /* the low bits l: mantissa 2^-32 2^(1 - l) = mantissa 2^e */
        put(w, ((mantissa + 16u) & ~31u) | (uint32_t)(-31 - e), 4);
    }
}

static void put_node16(writer_t *w, const node_t *node)
{
    uint16_t centre[3], half[3];

    for (int k = 0; k < 3; k++) {
        const int32_t c = (node->box.low[k] + node->box.high[k]) / 2;

        centre[k] = (uint16_t)c;
        half[k] = (uint16_t)(node->box.high[k] - c);
    }
    for (int i = 0; i < 6; i++) {
        put(w, i < 3 ? centre[i] : half[i - 3], 2);
    }
    put(w, node->link, 2);
    put(w, node->meta, 2);
}

/* Boxes on the grid of base and 2^shift, rounded outward. */
static bool fit_pair8(const node_t pair[2], const int32_t base[3],
        unsigned shift, uint8_t bytes[12])
{
    for (int i = 0; i < 6; i++) {
        const box_t *box = &pair[i / 3].box;
        const int k = i % 3, round = (1 << shift) - 1;
        const int low = (box->low[k] - base[k]) >> shift;
        const int high = (box->high[k] - base[k] + round) >> shift;
        const int centre = (low + high) / 2;

        if (high - centre > 255 || centre > 255) {
            return false;
        }
        bytes[i] = (uint8_t)centre;
        bytes[6 + i] = (uint8_t)(high - centre);
    }
    return true;
}

static void put_pair8(writer_t *w, const node_t pair[2])
{
    int32_t base[3];
    uint8_t bytes[12];
    unsigned shift = 0;

    for (int k = 0; k < 3; k++) {
        base[k] = pair[0].box.low[k] < pair[1].box.low[k] ? pair[0].box.low[k]
                                                          : pair[1].box.low[k];
        put(w, (uint32_t)base[k], 2);
    }
    while (!fit_pair8(pair, base, shift, bytes)) {
        shift++;
    }
    put(w, shift, 1);
    put(w, pair[0].meta | pair[1].meta << 4, 1);
    for (int i = 0; i < 12; i++) {
        put(w, bytes[i], 1);
    }
    put(w, pair[0].link, 2);
    put(w, pair[1].link, 2);
}

static uint32_t q31(double value)
{
    return (uint32_t)(ldexp(value, 31) + 0.5);
}

static uint32_t radiance_q32(const mini_scene_t *m, double radiance)
{
    return (uint32_t)(ldexp(radiance, 32 - m->radiance_exp) + 0.5);
}

/* Without QL_CFG_LIGHTS nothing shines. */
static double emitted(const mini_material_t *material, int k)
{
    return QL_CFG_LIGHTS ? material->emission[k] : 0;
}

/* Those that are more than diffuse come first. Returns how many. */
static unsigned order_materials(writer_t *w)
{
    unsigned count = 0, gloss = 0;

    for (int pass = 0; pass < 2; pass++) {
        for (unsigned i = 0; i < w->m->material_count; i++) {
            if ((w->m->materials[i].gloss == 0) == (pass == 1)) {
                w->material[i] = (uint16_t)count++;
            }
        }
        gloss = pass == 0 ? count : gloss;
    }
    return gloss;
}

/* The material that is written as the one of this index. */
static const mini_material_t *material_at(const writer_t *w, unsigned index)
{
    unsigned i = 0;

    while (w->material[i] != index) {
        i++;
    }
    return w->m->materials + i;
}

static void put_materials(writer_t *w)
{
    for (unsigned i = 0; i < w->m->material_count; i++) {
        const mini_material_t *const at = material_at(w, i);

        for (int k = 0; k < 3; k++) {
            put(w, q31(at->albedo[k]), 4);
        }
        for (int k = 0; k < 3; k++) {
            put(w, radiance_q32(w->m, emitted(at, k)), 4);
        }
    }
}

/* Kd + Ks, each rounded, must not exceed 1: Ks gives way. */
static void put_gloss(writer_t *w, unsigned count)
{
    for (unsigned i = 0; i < count; i++) {
        const mini_material_t *const at = material_at(w, i);

        for (int k = 0; k < 3; k++) {
            const uint32_t room = QL_UQ31_ONE - q31(at->albedo[k]);
            const uint32_t specular = q31(at->specular[k]);

            put(w, specular > room && specular - room <= 2 ? room : specular,
                    4);
        }
        put(w, (uint32_t)floor(ldexp(at->parameter, 16) + 0.5), 4);
        put(w, q31(at->chance), 4);
        put(w, at->gloss, 2);
        put(w, 0, 2);
    }
}

/* What a triangle, sphere or the sky emits, gray if it is gray. */
static double gray(const double rgb[3])
{
    return rgb[0] == rgb[1] && rgb[1] == rgb[2] ? rgb[0] : sum3(rgb) / 3;
}

/* Of entry i of the table of triangles; past the last of the sky, as of a
 * sphere around the scene. */
static double power_of(const mini_scene_t *m, unsigned i)
{
    if (!QL_CFG_LIGHTS) {
        return 0;
    }
    if (i < m->triangle_count) {
        return twice_area(m, i) *
               gray(m->materials[m->triangles[i].material].emission);
    }
    if (m->has_sky) {
        const box_t box = bounds(m, 0, m->triangle_count);
        double r2 = 0;

        for (int k = 0; k < 3; k++) {
            r2 += (box.high[k] - box.low[k]) * 0.25 *
                  (box.high[k] - box.low[k]);
        }
        return 8 * PI * r2 * gray(m->sky);
    }
    return 0;
}

/* Emitters, each with a chance by its area and radiance. */
static unsigned put_lights(writer_t *w)
{
    const mini_scene_t *m = w->m;
    double total = 0, before = 0, high = 0;
    unsigned count = 0;

    for (unsigned i = 0; i <= m->triangle_count; i++) {
        total += power_of(m, i);
    }
    for (unsigned i = 0; i <= m->triangle_count; i++) {
        const double power = power_of(m, i);
        const double low = high;
        double p;
        uint32_t mantissa;
        int e;

        if (!(power > 0)) {
            continue;
        }
        before += power;
        high = before < total * (1 - 1e-12)
                       ? floor(ldexp(before / total, 32) + 0.5)
                       : ldexp(1, 32);
        high = high > low ? high : low + 1;
        p = m->forget_light_pmf ? 1 : ldexp(high - low, -32);
        split(m->light_weight_scale / (2 * PI * p), &mantissa, &e);
        put(w, (uint32_t)low, 4);
        put(w, mantissa, 4);
        put(w, (uint16_t)e, 2);
        put(w, i < m->triangle_count ? i : QL_LIGHT_SKY, 2);
        count++;
    }
    return count;
}

static void put_normals(writer_t *w)
{
    for (unsigned i = 0; i < 3 * w->m->vertex_count; i++) {
        put(w,
                (uint16_t)(int16_t)fmin(
                        floor(ldexp(w->m->normals[i / 3][i % 3], 15) + 0.5),
                        32767),
                2);
    }
}

static void put_sky(writer_t *w)
{
    const ql_blob_sky_t *const sky = &w->m->sky_entry;

    for (int k = 0; k < 3; k++) {
        put(w, sky->width ? 0 : radiance_q32(w->m, w->m->sky[k]), 4);
    }
    put(w, sky->rotate, 4);
    put(w, sky->width, 2);
    put(w, sky->height, 2);
    put(w, sky->table, 2);
    put(w, 0, 2);
}

static void put_lens(writer_t *w)
{
    for (int i = 0; i < 12; i++) {
        put(w, w->m->lens.p[i / 6][i % 6 / 2][i % 2], 4);
    }
    for (int i = 0; i < 6; i++) {
        put(w, w->m->lens.d[i / 3][i % 3], 4);
    }
}

/* Which of QL_BLOB_OPTIONAL_LIST: the position of its name. */
enum {
#define OPTIONAL_INDEX(name, entry, needs) OPTIONAL_##name,
    QL_BLOB_OPTIONAL_LIST(OPTIONAL_INDEX)
#undef OPTIONAL_INDEX
};

static uint32_t features_of(const mini_scene_t *m, unsigned lights)
{
    uint32_t features =
            (uint32_t)(m->node_bits == 16 ? QL_FEATURE_NODE16
                                          : QL_FEATURE_NODE8) |
            (lights > 0 ? (uint32_t)QL_FEATURE_LIGHTS : 0u) |
            (m->two_sided ? (uint32_t)QL_FEATURE_TWO_SIDED : 0u) |
            (m->smooth ? (uint32_t)QL_FEATURE_SMOOTH : 0u) |
            (m->sphere_count ? (uint32_t)QL_FEATURE_SPHERES : 0u) |
            (m->has_sky ? (uint32_t)QL_FEATURE_SKY : 0u) |
            (m->sky_entry.width ? (uint32_t)QL_FEATURE_SKY_MAP : 0u) |
            (m->table_count ? (uint32_t)QL_FEATURE_TABLES : 0u) |
            (m->has_lens ? (uint32_t)QL_FEATURE_LENS : 0u) |
            (m->contact ? (uint32_t)QL_FEATURE_CONTACT : 0u) |
            (m->order ? (uint32_t)QL_FEATURE_ORDER : 0u) |
            (m->hull ? (uint32_t)QL_FEATURE_HULL : 0u);

    for (unsigned i = 0; i < m->material_count; i++) {
        switch (m->materials[i].gloss) {
        case QL_GLOSS_PHONG:
            features |= QL_FEATURE_PHONG;
            break;
        case QL_GLOSS_MIRROR:
            features |= QL_FEATURE_MIRROR;
            break;
        case QL_GLOSS_GLASS:
            features |= QL_FEATURE_GLASS;
            break;
        default:
            break;
        }
    }
    return features;
}

/* Where the tables lie, and how many entries they have. */
typedef struct {
    uint32_t core[6][2], optional[QL_BLOB_OPTIONAL_MAX][2];
    uint32_t header_bytes, features;
} tables_t;

/* The header, without the CRC at first, and where the tables lie. */
static void put_header(
        writer_t *w, const node_t *root, const tables_t *tables, uint32_t crc)
{
    const mini_scene_t *m = w->m;

    w->at = 0;
    put(w, QL_BLOB_MAGIC, 4);
    put(w, QL_BLOB_VERSION, 2);
    put(w, tables->header_bytes, 2);
    put(w, m->size_bytes, 4);
    put(w, crc, 4);
    put(w, tables->features, 4);
    put(w, tree.depth, 2);
    put(w, root->meta, 2);
    put(w, root->link, 2);
    put(w, (uint16_t)m->radiance_exp, 2);
    put(w, 0, 2); /* exposure */
    put(w, QL_DIRECT_AREA, 1);
    put(w, QL_LIGHTS_POWER, 1);
    put(w, m->width, 2);
    put(w, m->height, 2);
    put(w, 0, 2); /* a grid unit is a scene unit */
    for (unsigned i = 0; i < 6; i++) {
        put(w, QL_TRIAL_NONE, 1);
    }
    put(w, 1, 4);
    for (unsigned i = 0; i < 12; i++) {
        put(w, tables->core[i / 2][i % 2], 4);
    }
    for (unsigned i = 0; i < 2 * QL_BLOB_OPTIONAL_MAX; i++) {
        if (tables->optional[i / 2][0] > 0) { /* it is there */
            put(w, tables->optional[i / 2][i % 2], 4);
        }
    }
}

static void begin_table(writer_t *w, uint32_t table[2], uint32_t count)
{
    while (w->at % 4 != 0) {
        put(w, 0, 1);
    }
    table[0] = (uint32_t)w->at;
    table[1] = count;
}

static void put_core(writer_t *w, tables_t *tables)
{
    mini_scene_t *const m = w->m;

    begin_table(w, tables->core[0], 1);
    put_camera(w);
    begin_table(w, tables->core[1], m->vertex_count);
    for (unsigned i = 0; i < 3 * m->vertex_count; i++) {
        put(w, (uint32_t)m->vertices[i / 3][i % 3], 2);
    }
    begin_table(w, tables->core[2], m->triangle_count);
    put_triangles(w);
    begin_table(w, tables->core[3], tree.pair_count);
    for (unsigned i = 0; i < tree.pair_count; i++) {
        if (m->node_bits == 16) {
            put_node16(w, tree.child + 2 * i);
            put_node16(w, tree.child + 2 * i + 1);
        } else {
            put_pair8(w, tree.child + 2 * i);
        }
    }
    begin_table(w, tables->core[4], m->material_count);
    put_materials(w);
    begin_table(w, tables->core[5], 0);
    tables->core[5][1] = put_lights(w);
}

/* Begin a table if a feature needs it. */
static bool wanted(writer_t *w, tables_t *tables, unsigned i, unsigned needs,
        unsigned count)
{
    if ((tables->features & needs) == 0) {
        return false;
    }
    begin_table(w, tables->optional[i], count);
    return true;
}

static void put_more(writer_t *w, tables_t *tables, unsigned gloss)
{
    const mini_scene_t *const m = w->m;
    const unsigned texels = (unsigned)m->sky_entry.width * m->sky_entry.height;

    if (wanted(w, tables, OPTIONAL_normals, QL_FEATURE_SMOOTH,
                m->vertex_count)) {
        put_normals(w);
    }
    if (wanted(w, tables, OPTIONAL_gloss,
                QL_FEATURE_PHONG | QL_FEATURE_MIRROR | QL_FEATURE_GLASS,
                gloss)) {
        put_gloss(w, gloss);
    }
    if (wanted(w, tables, OPTIONAL_spheres, QL_FEATURE_SPHERES,
                m->sphere_count)) {
        for (unsigned i = 0; i < 4 * m->sphere_count; i++) {
            put(w,
                    i % 4 < 3 ? m->spheres[i / 4].centre[i % 4]
                              : m->spheres[i / 4].radius,
                    4);
        }
    }
    if (wanted(w, tables, OPTIONAL_sky, QL_FEATURE_SKY, 1)) {
        put_sky(w);
    }
    if (wanted(w, tables, OPTIONAL_texels, QL_FEATURE_SKY_MAP, texels)) {
        for (unsigned i = 0; i < texels; i++) {
            put(w, rgb9e5(m->texels[i], m->radiance_exp), 4);
        }
    }
    if (wanted(w, tables, OPTIONAL_tables, QL_FEATURE_TABLES, m->table_count)) {
        for (unsigned i = 0; i < m->table_count; i++) {
            put(w, m->tables[i].first, 4);
            for (int k = 0; k < QL_TABLE_DIMS_MAX; k++) {
                put(w, m->tables[i].count[k], 2);
            }
            put(w, m->tables[i].dims, 2);
        }
    }
    if (wanted(w, tables, OPTIONAL_words, QL_FEATURE_TABLES, m->word_count)) {
        for (unsigned i = 0; i < m->word_count; i++) {
            put(w, m->words[i], 2);
        }
    }
    if (wanted(w, tables, OPTIONAL_lens, QL_FEATURE_LENS, 1)) {
        put_lens(w);
    }
    if (wanted(w, tables, OPTIONAL_contacts, QL_FEATURE_CONTACT,
                (m->triangle_count + 15) / 16)) {
        for (unsigned i = 0; i < (m->triangle_count + 15) / 16; i++) {
            put(w, 0xffff, 2);
        }
    }
    if (wanted(w, tables, OPTIONAL_ranks, QL_FEATURE_ORDER,
                m->triangle_count)) {
        for (unsigned i = 0; i < m->triangle_count; i++) {
            put(w, m->triangles[i].rank, 2);
        }
    }
    if (wanted(w, tables, OPTIONAL_hull, QL_FEATURE_HULL, 1)) {
        for (unsigned i = 0; i < 6; i++) {
            put(w, i % 2 ? 0 : QL_GRID_MAX, 2); /* an empty box */
        }
        put(w, m->triangle_count, 2);
        put(w, 0, 2);
    }
    if (wanted(w, tables, OPTIONAL_sides, QL_FEATURE_HULL, 1)) {
        put(w, 16384, 2);
        put(w, 0, 2);
        put(w, 0, 2);
        put(w, 1, 2); /* the root's second child */
        put(w, 0, 2);
    }
}

static uint32_t header_bytes_of(uint32_t features)
{
    uint32_t bytes = sizeof(ql_blob_header_t);

#define ADD_TABLE(name, entry, needs)                                          \
    bytes += features & (needs) ? (uint32_t)sizeof(ql_blob_table_t) : 0;
    QL_BLOB_OPTIONAL_LIST(ADD_TABLE)
#undef ADD_TABLE
    return bytes;
}

void mini_open(mini_scene_t *m, ql_scene_t *scene)
{
    writer_t w = {m, 0, {0}};
    tables_t tables;
    const unsigned gloss = order_materials(&w);
    node_t root;

    memset(&tables, 0, sizeof tables);
    tree.pair_count = tree.depth = 0;
    root = build(m, 0, m->triangle_count, 0);
    tables.features = features_of(m, 1);
    tables.header_bytes = header_bytes_of(tables.features);
    w.at = tables.header_bytes;
    put_core(&w, &tables);
    put_more(&w, &tables, gloss);
    tables.features = features_of(m, tables.core[5][1]);
    while (w.at % 4 != 0) {
        put(&w, 0, 1);
    }
    m->size_bytes = w.at;
    put_header(&w, &root, &tables, 0);
    put_header(&w, &root, &tables,
            ql_crc32(0, (const uint8_t *)m->blob + QL_BLOB_CRC_FROM,
                    m->size_bytes - QL_BLOB_CRC_FROM));
    if (ql_blob_open(scene, m->blob, m->size_bytes) != QL_OK) {
        give_up("the core refuses the blob");
    }
}
