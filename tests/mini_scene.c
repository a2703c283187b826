/* mini_scene.c - build the blob of a small scene, on the grid itself */
/* SPDX-License-Identifier: MIT */

#include "mini_scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/ql_crc.h"

#define PI 3.14159265358979323846

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
    m->node_bits = 16;
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
    m->triangles[m->triangle_count++].material = material;
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
    put_wide(m->camera.p[0], x);
    put_wide(m->camera.p[1], y);
    put_wide(m->camera.p[2], z);
}

void mini_look(mini_scene_t *m, double x, double y, double z)
{
    m->camera.d[0] = q30(x);
    m->camera.d[1] = q30(y);
    m->camera.d[2] = q30(z);
}

void mini_field(mini_scene_t *m, const double right[3], const double up[3])
{
    for (int k = 0; k < 3; k++) {
        m->camera.dr[k] = q30(right[k]);
        m->camera.du[k] = q30(up[k]);
    }
}

void mini_window(mini_scene_t *m, const double right[3], const double up[3])
{
    for (int k = 0; k < 3; k++) {
        put_wide(m->camera.pr[k], right[k]);
        put_wide(m->camera.pu[k], up[k]);
    }
}

void mini_move(mini_scene_t *m, int32_t x, int32_t y, int32_t z)
{
    const int32_t by[3] = {x, y, z};

    for (int k = 0; k < 3; k++) {
        m->camera.p[k][1] += (uint32_t)by[k];
        for (unsigned i = 0; i < m->vertex_count; i++) {
            m->vertices[i][k] += by[k];
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

static box_t bounds(const mini_scene_t *m, unsigned first, unsigned count)
{
    box_t box = {{QL_GRID_MAX, QL_GRID_MAX, QL_GRID_MAX}, {0, 0, 0}};

    for (unsigned i = 3 * first; i < 3 * (first + count); i++) {
        const int32_t *v = m->vertices[m->triangles[i / 3].vertex[i % 3]];

        for (int k = 0; k < 3; k++) {
            box.low[k] = v[k] < box.low[k] ? v[k] : box.low[k];
            box.high[k] = v[k] > box.high[k] ? v[k] : box.high[k];
        }
    }
    return box;
}

static int32_t middle(const mini_scene_t *m, unsigned triangle, unsigned axis)
{
    const uint16_t *v = m->triangles[triangle].vertex;

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

static node_t build(
        mini_scene_t *m, unsigned first, unsigned count, unsigned level)
{
    const box_t box = bounds(m, first, count);
    node_t node = {first, 3 + count, box};
    unsigned axis = 0;

    if (count <= m->leaf_max) {
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

static void pad(writer_t *w)
{
    while (w->at % 4 != 0) {
        put(w, 0, 1);
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

/* |e1 x e2| */
static double twice_area(const mini_scene_t *m, unsigned triangle)
{
    const uint16_t *v = m->triangles[triangle].vertex;
    double e[2][3], sum = 0;

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
    const uint32_t(*const wide[3])[2] = {c->p, c->pr, c->pu};
    const uint32_t *const narrow[3] = {c->d, c->dr, c->du};

    for (int i = 0; i < 18; i++) {
        put(w, wide[i / 6][i % 6 / 2][i % 2], 4);
    }
    for (int i = 0; i < 9; i++) {
        put(w, narrow[i / 3][i % 3], 4);
    }
}

static void put_triangles(writer_t *w)
{
    const mini_scene_t *m = w->m;

    for (unsigned i = 0; i < m->triangle_count; i++) {
        const double area = twice_area(m, i);
        uint32_t mantissa;
        int e;

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
        put(w, m->triangles[i].material, 2);
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

static void put_materials(writer_t *w)
{
    const mini_scene_t *m = w->m;

    for (unsigned i = 0; i < m->material_count; i++) {
        for (int k = 0; k < 3; k++) {
            put(w, (uint32_t)(ldexp(m->materials[i].albedo[k], 31) + 0.5), 4);
        }
        for (int k = 0; k < 3; k++) {
            const double e = m->materials[i].emission[k];

            put(w, (uint32_t)(ldexp(e, 32 - m->radiance_exp) + 0.5), 4);
        }
    }
}

/* Emitters, each with a chance by its area and radiance. */
static unsigned put_lights(writer_t *w)
{
    const mini_scene_t *m = w->m;
    double total = 0, before = 0;
    unsigned count = 0;

    for (unsigned i = 0; i < m->triangle_count; i++) {
        total += twice_area(m, i) *
                 m->materials[m->triangles[i].material].emission[0];
    }
    for (unsigned i = 0; i < m->triangle_count; i++) {
        const double power = twice_area(m, i) *
                             m->materials[m->triangles[i].material].emission[0];
        const double low = floor(ldexp(before / total, 32) + 0.5);
        double high, p;
        uint32_t mantissa;
        int e;

        if (!(power > 0)) {
            continue;
        }
        before += power;
        high = before < total * (1 - 1e-12)
                       ? floor(ldexp(before / total, 32) + 0.5)
                       : ldexp(1, 32);
        p = m->forget_light_pmf ? 1 : ldexp(high - low, -32);
        split(m->light_weight_scale / (2 * PI * p), &mantissa, &e);
        put(w, (uint32_t)low, 4);
        put(w, mantissa, 4);
        put(w, (uint16_t)e, 2);
        put(w, i, 2);
        count++;
    }
    return count;
}

/* The header, without the CRC at first, and where the tables lie. */
static void put_header(writer_t *w, const node_t *root,
        const uint32_t tables[6][2], uint32_t size, uint32_t crc)
{
    const mini_scene_t *m = w->m;

    w->at = 0;
    put(w, QL_BLOB_MAGIC, 4);
    put(w, QL_BLOB_VERSION, 2);
    put(w, sizeof(ql_blob_header_t), 2);
    put(w, size, 4);
    put(w, crc, 4);
    put(w,
            (uint32_t)(m->node_bits == 16 ? QL_FEATURE_NODE16
                                          : QL_FEATURE_NODE8) |
                    (tables[5][1] > 0 ? (uint32_t)QL_FEATURE_LIGHTS : 0u) |
                    (m->two_sided ? (uint32_t)QL_FEATURE_TWO_SIDED : 0u),
            4);
    put(w, tree.depth, 2);
    put(w, root->meta, 2);
    put(w, root->link, 2);
    put(w, (uint16_t)m->radiance_exp, 2);
    put(w, 0, 2); /* exposure */
    put(w, m->width, 2);
    put(w, m->height, 2);
    put(w, 0, 2); /* a grid unit is a scene unit */
    put(w, 1, 4);
    for (unsigned i = 0; i < 12; i++) {
        put(w, tables[i / 2][i % 2], 4);
    }
}

static uint32_t begin_table(writer_t *w)
{
    pad(w);
    return (uint32_t)w->at;
}

void mini_open(mini_scene_t *m, ql_scene_t *scene)
{
    writer_t w = {m, sizeof(ql_blob_header_t)};
    uint32_t tables[6][2];
    node_t root;

    tree.pair_count = tree.depth = 0;
    root = build(m, 0, m->triangle_count, 0);
    tables[0][0] = begin_table(&w);
    tables[0][1] = 1;
    put_camera(&w);
    tables[1][0] = begin_table(&w);
    tables[1][1] = m->vertex_count;
    for (unsigned i = 0; i < 3 * m->vertex_count; i++) {
        put(&w, (uint32_t)m->vertices[i / 3][i % 3], 2);
    }
    tables[2][0] = begin_table(&w);
    tables[2][1] = m->triangle_count;
    put_triangles(&w);
    tables[3][0] = begin_table(&w);
    tables[3][1] = tree.pair_count;
    for (unsigned i = 0; i < tree.pair_count; i++) {
        if (m->node_bits == 16) {
            put_node16(&w, tree.child + 2 * i);
            put_node16(&w, tree.child + 2 * i + 1);
        } else {
            put_pair8(&w, tree.child + 2 * i);
        }
    }
    tables[4][0] = begin_table(&w);
    tables[4][1] = m->material_count;
    put_materials(&w);
    tables[5][0] = begin_table(&w);
    tables[5][1] = put_lights(&w);
    pad(&w);
    m->size_bytes = w.at;
    put_header(&w, &root, (const uint32_t(*)[2])tables, (uint32_t)m->size_bytes,
            0);
    put_header(&w, &root, (const uint32_t(*)[2])tables, (uint32_t)m->size_bytes,
            ql_crc32(0, (const uint8_t *)m->blob + QL_BLOB_CRC_FROM,
                    m->size_bytes - QL_BLOB_CRC_FROM));
    if (ql_blob_open(scene, m->blob, m->size_bytes) != QL_OK) {
        give_up("the core refuses the blob");
    }
}
