/* test_blob.c - damaged blobs are refused, or render without reading outside */
/* SPDX-License-Identifier: MIT */

/* Every blob is opened in a block of exactly its size, so that the address
 * sanitizer sees a read of one byte too many. */

#include <math.h>
#include <stdlib.h>

#include "base/ql_crc.h"
#include "support/built.h"
#include "support/picture/mini_scene.h"
#include "support/ql_stats.h"
#include "support/ql_test.h"
#include "qlux.h"

enum { DAMAGED = MANY(20000) };

static mini_scene_t mini;
static uint64_t state;

/* A small room with two lamps and a fan of triangles: about a kilobyte, with
 * every table and a tree of several levels. */
static void build(unsigned node_bits)
{
    static const int32_t low[3] = {8, 8, 8}, high[3] = {32759, 32759, 32759};
    static const double right[3] = {0.3, 0, 0}, up[3] = {0, 0.3, 0};
    uint16_t white, lamp;
    ql_scene_t scene;

    mini_begin(&mini);
    mini.node_bits = node_bits;
    mini.leaf_max = 2;
    white = mini_material(&mini, 0.7, 0);
    lamp = mini_material(&mini, 0, 0.9);
    mini_room(&mini, low, high, white);
    for (int32_t i = 0; i < 6; i++) {
        const int32_t a[3] = {10000 + 2000 * i, 30000, 16000};
        const int32_t b[3] = {11500 + 2000 * i, 30000 - 500 * i, 16000};
        const int32_t c[3] = {10000 + 2000 * i, 30000, 18000 + 100 * i};

        mini_triangle(&mini, a, b, c, i < 2 ? lamp : white);
    }
    mini_field(&mini, right, up);
    mini.width = mini.height = 4;
    mini_open(&mini, &scene);
}

/* Is every feature of the format built in? */
#define ALL                                                                    \
    (QL_CFG_SMOOTH && QL_CFG_PHONG && QL_CFG_MIRROR && QL_CFG_GLASS &&         \
            QL_CFG_SPHERES && QL_CFG_SKY_MAP && QL_CFG_LENS &&                 \
            QL_CFG_CONTACT && QL_CFG_ORDER && QL_CFG_HULL)

/* A room with everything that is built in: spheres, smooth triangles, each
 * material, a map of the sky, a table of three dimensions, a lens. */
static void build_all(unsigned node_bits)
{
    static const int32_t balls[4][4] = {{2000000, 2000000, 5000000, 900000},
            {4000000, 2000000, 5000000, 256},
            {6000000, 4000000, 6000000, 1000000},
            {4200000, 4200000, 6500000, 1200000}};
    static const int32_t quad[4][3] = {{1000, 1000, 30000},
            {30000, 1000, 28000}, {30000, 30000, 30000}, {1000, 30000, 28000}};
    static const double right[3] = {0.3, 0, 0}, up[3] = {0, 0.3, 0};
    static const double lens[2][2][3] = {
            {{300, 0, 0}, {0, 300, 0}}, {{-0.01, 0, 0}, {0, -0.01, 0}}};
    static const double weights[16] = {
            1, 2, 0, 4, 5, 0, 7, 8, 1, 1, 1, 1, 1, 1, 1, 1};
    static const uint16_t count[3] = {2, 2, 2}, plane[2] = {8, 2};
    double rgb[32][3];
    uint16_t white, lamp, material[4];
    ql_scene_t scene;

    mini_begin(&mini);
    mini.node_bits = node_bits;
    mini.leaf_max = 2;
    white = mini_material(&mini, 0.7, 0);
    lamp = mini_material(&mini, 0.2, 0.9);
    material[0] = mini_material(&mini, 0.3, 0);
    material[1] = mini_material(&mini, 0.1, 0);
    material[2] = mini_material(&mini, 0, 0);
    material[3] = lamp;
    if (QL_CFG_PHONG) {
        mini_gloss(&mini, material[0], QL_GLOSS_PHONG, 0.5, 20.5);
    }
    if (QL_CFG_MIRROR) {
        mini_gloss(&mini, material[1], QL_GLOSS_MIRROR, 0.8, 0);
    }
    if (QL_CFG_GLASS) {
        mini_gloss(&mini, material[2], QL_GLOSS_GLASS, 0.9, 1.5);
    }
    for (int i = 0; i < 4; i++) {
        const double normal[3] = {0.2 * i - 0.3, 0.1 * i, -0.9};
        const uint16_t vertex =
                mini_vertex(&mini, quad[i][0], quad[i][1], quad[i][2]);

        if (QL_CFG_SPHERES) {
            (void)mini_sphere(&mini, balls[i], balls[i][3], material[i]);
        }
        if (QL_CFG_SMOOTH) {
            mini_normal(&mini, vertex, normal);
        }
    }
    mini_face(&mini, 0, 2, 1, white);
    mini_face(&mini, 0, 3, 2, material[0]);
    for (int i = 0; i < 32; i++) {
        rgb[i][0] = 0.9 / (1 + i);
        rgb[i][1] = i % 5 ? 0.1 : 0;
        rgb[i][2] = 0.001 * i * i;
    }
    if (QL_CFG_TABLES) {
        (void)mini_table(&mini, 3, count, weights);
        (void)mini_table(&mini, 2, plane, weights);
    }
    if (QL_CFG_SKY_MAP) {
        mini_sky_map(&mini, 8, 4, (const double(*)[3])rgb, 0.3);
    } else if (QL_CFG_SKY) {
        mini_sky(&mini, 0.1, 0.2, 0.3);
    }
    mini.contact = QL_CFG_CONTACT;
    mini.order = QL_CFG_ORDER;
    mini.hull = QL_CFG_HULL && QL_CFG_SPHERES; /* else the root is a leaf */
    if (QL_CFG_LENS) {
        mini_lens(&mini, lens[0], lens[1]);
    }
    mini_field(&mini, right, up);
    mini.width = mini.height = 4;
    mini_open(&mini, &scene);
}

/* A copy of the blob, with nothing readable behind it. */
static uint8_t *copy_of(size_t size)
{
    uint8_t *copy = malloc(size ? size : 1);

    if (copy == NULL) {
        exit(2);
    }
    memcpy(copy, mini.blob, size);
    return copy;
}

static bool all_zero(const ql_scene_t *scene)
{
    static const ql_scene_t zero;

    return scene->header == zero.header && scene->camera == zero.camera &&
           scene->vertices == zero.vertices &&
           scene->triangles == zero.triangles && scene->pairs == zero.pairs &&
           scene->materials == zero.materials && scene->lights == zero.lights &&
           scene->light_count == 0 && scene->root_link == 0 &&
           scene->root_meta == 0 && scene->node_bits == 0
#if QL_CFG_SMOOTH
           && scene->normals == NULL
#endif
#if QL_GLOSS
           && scene->gloss == NULL && scene->gloss_count == 0
#endif
#if QL_CFG_SPHERES
           && scene->spheres == NULL
#endif
#if QL_CFG_SKY
           && scene->sky == NULL
#endif
#if QL_CFG_SKY_MAP
           && scene->texels == NULL
#endif
#if QL_CFG_TABLES
           && scene->tables == NULL && scene->words == NULL &&
           scene->table_count == 0
#endif
#if QL_CFG_LENS
           && scene->lens == NULL
#endif
#if QL_CFG_CONTACT
           && scene->contacts == NULL
#endif
#if QL_CFG_ORDER
           && scene->ranks == NULL
#endif
#if QL_CFG_HULL
           && scene->hull == NULL && scene->sides == NULL &&
           scene->side_count == 0 && scene->hull_first == 0
#endif
            ;
}

/* Open a copy; a refusal must leave nothing in the scene. */
static ql_status_t open_copy(
        ql_scene_t *scene, const uint8_t *copy, size_t size)
{
    ql_status_t status;

    memset(scene, 0x5a, sizeof *scene);
    status = ql_blob_open(scene, copy, size);
    CHECK(status == QL_OK || all_zero(scene), "status %d left a view", status);
    return status;
}

static void repair(uint8_t *copy, size_t size)
{
    const uint32_t crc =
            ql_crc32(0, copy + QL_BLOB_CRC_FROM, size - QL_BLOB_CRC_FROM);

    for (unsigned i = 0; i < 4; i++) {
        copy[12 + i] = (uint8_t)(crc >> 8 * i);
    }
}

/* ---- Refusals ---------------------------------------------------------- */

TEST(a_good_blob_opens)
{
    for (unsigned bits = MINI_BITS_MIN; bits <= MINI_BITS_MAX; bits += 8) {
        ql_scene_t scene;
        uint8_t *copy;

        build(bits);
        copy = copy_of(mini.size_bytes);
        CHECK(open_copy(&scene, copy, mini.size_bytes) == QL_OK, "%u bits",
                bits);
        CHECK(scene.node_bits == bits &&
                        scene.light_count == 2 * QL_CFG_LIGHTS &&
                        (const uint8_t *)scene.header == copy,
                "%u bits: %u lights", bits, scene.light_count);
        CHECK(*ql_blob_missing(copy) == '\0', "%u bits: misses %s", bits,
                ql_blob_missing(copy));
        free(copy);
    }
}

static void cut_anywhere(void)
{
    for (size_t size = 0; size < mini.size_bytes; size++) {
        uint8_t *copy = copy_of(size);
        ql_scene_t scene;
        const ql_status_t status = open_copy(&scene, copy, size);

        CHECK(status == QL_ERR_TRUNCATED, "%u of %u bytes: status %d",
                (unsigned)size, (unsigned)mini.size_bytes, status);
        free(copy);
    }
    NOTE("%u lengths", (unsigned)mini.size_bytes);
}

TEST(a_blob_cut_at_any_byte_is_truncated)
{
    build(MINI_BITS_MIN);
    cut_anywhere();
    build_all(MINI_BITS_MIN);
    cut_anywhere();
}

/* A byte to three more at its end, which no table holds. */
TEST(a_size_that_is_no_multiple_of_4_is_refused)
{
    build(MINI_BITS_MAX);
    for (uint32_t more = 0; more < 4; more++) {
        const size_t size = mini.size_bytes + more;
        uint8_t *copy = calloc(size, 1);
        ql_scene_t scene;
        ql_status_t status;

        if (copy == NULL) {
            exit(2);
        }
        memcpy(copy, mini.blob, mini.size_bytes);
        copy[8] = (uint8_t)(size & 0xffu);
        copy[9] = (uint8_t)(size >> 8 & 0xffu);
        repair(copy, size);
        status = open_copy(&scene, copy, size);
        CHECK(status == (more == 0 ? QL_OK : QL_ERR_RANGE),
                "%u bytes more: status %d", (unsigned)more, status);
        free(copy);
    }
}

TEST(an_unaligned_blob_is_refused)
{
    build(MINI_BITS_MAX);
    for (unsigned shift = 1; shift < 4; shift++) {
        uint8_t *copy = malloc(mini.size_bytes + 4);
        ql_scene_t scene;

        if (copy == NULL) {
            exit(2);
        }
        memcpy(copy + shift, mini.blob, mini.size_bytes);
        CHECK(open_copy(&scene, copy + shift, mini.size_bytes) == QL_ERR_ALIGN,
                "off by %u", shift);
        free(copy);
    }
}

/* What a flip of one bit of byte i must be called. */
static bool right_status(size_t i, ql_status_t status)
{
    if (i < 4) {
        return status == QL_ERR_MAGIC;
    }
    if (i < 8) {
        return status == QL_ERR_VERSION;
    }
    if (i < 12) { /* longer, shorter, or no multiple of 4 */
        return status == QL_ERR_TRUNCATED || status == QL_ERR_RANGE ||
               status == QL_ERR_CHECKSUM;
    }
    return status == QL_ERR_CHECKSUM;
}

TEST(any_flipped_bit_is_refused_with_the_right_status)
{
    for (unsigned bits = MINI_BITS_MIN; bits <= MINI_BITS_MAX; bits += 8) {
        uint8_t *copy;

        build(bits);
        copy = copy_of(mini.size_bytes);
        for (size_t i = 0; i < 8 * mini.size_bytes; i++) {
            ql_scene_t scene;
            ql_status_t status;

            copy[i / 8] ^= (uint8_t)(1u << i % 8);
            status = open_copy(&scene, copy, mini.size_bytes);
            CHECK(right_status(i / 8, status), "bit %u of byte %u: status %d",
                    (unsigned)(i % 8), (unsigned)(i / 8), status);
            copy[i / 8] ^= (uint8_t)(1u << i % 8);
        }
        free(copy);
    }
    NOTE("%u bits", 8 * (unsigned)mini.size_bytes);
}

TEST(a_feature_of_tomorrow_is_named_unknown)
{
    uint8_t *copy;
    ql_scene_t scene;

    build(MINI_BITS_MAX);
    copy = copy_of(mini.size_bytes);
    copy[19] |= 0x80; /* bit 31 of features */
    repair(copy, mini.size_bytes);
    CHECK(open_copy(&scene, copy, mini.size_bytes) == QL_ERR_FEATURE,
            "status %d", open_copy(&scene, copy, mini.size_bytes));
    CHECK(strcmp(ql_blob_missing(copy), "unknown") == 0, "it is \"%s\"",
            ql_blob_missing(copy));
    free(copy);
}

TEST(a_deeper_tree_than_the_stack_is_refused)
{
    uint8_t *copy;
    ql_scene_t scene;

    build(MINI_BITS_MAX);
    copy = copy_of(mini.size_bytes);
    copy[20] = QL_CFG_BVH_STACK + 1;
    repair(copy, mini.size_bytes);
    CHECK(open_copy(&scene, copy, mini.size_bytes) == QL_ERR_CAPACITY,
            "status %d", open_copy(&scene, copy, mini.size_bytes));
    free(copy);
}

/* ---- Damage that the checksum does not show ---------------------------- */

static unsigned long accepted, refused;

/* Open, and if it opens render every kind of line: corner pixels, all light.
 * The sanitizers watch; here only the end of it is checked. */
static void try_damaged(const uint8_t *copy, size_t size)
{
    ql_settings_t settings = QL_SETTINGS_DEFAULT;
    ql_scene_t scene;
    ql_render_t render;

    if (open_copy(&scene, copy, size) != QL_OK) {
        refused++;
        return;
    }
    accepted++;
    settings.spp = 2;
    settings.bounces = BUILT_BOUNCES(3);
    settings.seed = (uint32_t)accepted;
#if QL_CFG_DIRECT == 63 && QL_CFG_LIGHT_CHOICES == 7 && QL_CFG_UNIFORM &&      \
        QL_CFG_ROULETTE
    settings.direct = (uint8_t)(accepted % (QL_DIRECT_AUTO + 1));
    settings.indirect = (uint8_t)(accepted / 8 % (QL_INDIRECT_BRDF + 1));
    settings.lights = (uint8_t)(accepted / 4 % (QL_LIGHTS_AUTO + 1));
    settings.roulette = accepted / 2 % 2;
#endif
    if (ql_render_init(&render, &scene, &settings) == QL_OK) {
        const uint16_t right = (uint16_t)(render.settings.width - 1);
        const uint16_t bottom = (uint16_t)(render.settings.height - 1);
        uint8_t pixel[3];
        const ql_output_t output = {BUILT_FORMAT, pixel};
        ql_sum_t sum = {{0, 0, 0}};

        ql_render_pixel(&render, 0, 0, 0, 2, &sum);
        ql_render_pixel(&render, right, bottom, 0, 2, &sum);
        ql_render_pixel(&render, right / 2, bottom / 2, 0, 2, &sum);
        ql_render_encode(&render, 0, 0, &sum, 6, &output, 1);
    }
}

static void flip_every_bit(void)
{
    for (size_t i = 0; i < 8 * mini.size_bytes; i++) {
        uint8_t *copy = copy_of(mini.size_bytes);

        copy[i / 8] ^= (uint8_t)(1u << i % 8);
        if (i / 8 < 12 || i / 8 >= 16) {
            repair(copy, mini.size_bytes);
        }
        try_damaged(copy, mini.size_bytes);
        free(copy);
    }
}

static void report(void)
{
    CHECK(accepted > 0 && refused > 0, "%lu opened, %lu refused", accepted,
            refused);
    NOTE("%lu opened and rendered, %lu refused", accepted, refused);
}

TEST(any_flipped_bit_with_the_crc_repaired_stays_inside)
{
    accepted = refused = 0;
    for (unsigned bits = MINI_BITS_MIN; bits <= MINI_BITS_MAX; bits += 8) {
        build(bits);
        flip_every_bit();
    }
    report();
}

/* Replace a few bytes, words or runs; interesting values more often. */
static void damage(uint8_t *copy, size_t size)
{
    static const uint8_t favourites[] = {0, 1, 0x7f, 0x80, 0xff, 3, 16, 64};
    const unsigned places = 1 + stats_random_below(&state, 8);

    for (unsigned i = 0; i < places; i++) {
        const size_t first = 16,
                     at = first + stats_random_below(&state, size - first);
        const size_t run = 1 + stats_random_below(&state, 4);
        const bool favourite = stats_random_below(&state, 2) != 0;
        const uint8_t value = favourites[stats_random_below(&state, 8)];

        for (size_t k = at; k < at + run && k < size; k++) {
            copy[k] = favourite ? value : (uint8_t)stats_random(&state);
        }
    }
}

static void damage_often(unsigned times)
{
    for (unsigned i = 0; i < times; i++) {
        uint8_t *copy = copy_of(mini.size_bytes);

        damage(copy, mini.size_bytes);
        repair(copy, mini.size_bytes);
        try_damaged(copy, mini.size_bytes);
        free(copy);
    }
}

TEST(random_damage_with_the_crc_repaired_stays_inside)
{
    accepted = refused = 0;
    state = 1;
    for (unsigned bits = MINI_BITS_MIN; bits <= MINI_BITS_MAX; bits += 8) {
        build(bits);
        damage_often(DAMAGED);
    }
    report();
}

static void try_nasty_values(void)
{
    static const uint16_t values[] = {0, 1, 2, 3, 4, 7, 8, 15, 16, 17, 0x7fff,
            0x8000, 0x8001, 0xfffe, 0xffff};

    for (size_t at = 16; at + 2 <= mini.size_bytes; at += 2) {
        for (size_t v = 0; v < sizeof values / sizeof values[0]; v++) {
            uint8_t *copy = copy_of(mini.size_bytes);

            copy[at] = (uint8_t)(values[v] & 0xffu);
            copy[at + 1] = (uint8_t)(values[v] >> 8);
            repair(copy, mini.size_bytes);
            try_damaged(copy, mini.size_bytes);
            free(copy);
        }
    }
}

/* Aimed at what indices and counts lead to: every 16-bit field in turn takes
 * every nasty value. */
TEST(nasty_values_in_every_field_stay_inside)
{
    accepted = refused = 0;
    for (unsigned bits = MINI_BITS_MIN; bits <= MINI_BITS_MAX; bits += 8) {
        build(bits);
        try_nasty_values();
    }
    report();
}

TEST(a_tree_that_doubles_back_is_refused)
{
    for (unsigned bits = MINI_BITS_MIN; bits <= MINI_BITS_MAX; bits += 8) {
        uint8_t *copy;
        const ql_blob_header_t *header;
        ql_scene_t scene;

        build(bits);
        copy = copy_of(mini.size_bytes);
        header = (const ql_blob_header_t *)(void *)copy;
        /* every second link is copied over the first: the larger half of
         * each pair would be walked twice */
        for (uint32_t i = 0; i < QL_LE32(header->pairs.count); i++) {
            uint8_t *pair = copy + QL_LE32(header->pairs.offset) +
                            i * (bits == 16 ? 32 : 24);

            if (bits == 16) {
                memcpy(pair + 12, pair + 28, 4);
            } else {
                pair[7] = (uint8_t)((pair[7] >> 4) * 17u);
                memcpy(pair + 20, pair + 22, 2);
            }
        }
        repair(copy, mini.size_bytes);
        CHECK(open_copy(&scene, copy, mini.size_bytes) == QL_ERR_RANGE,
                "%u-bit nodes: status %d", bits,
                open_copy(&scene, copy, mini.size_bytes));
        free(copy);
    }
}

/* Put a 32-bit field where the blob has one. */
static void put32(uint8_t *at, uint32_t value)
{
    for (unsigned i = 0; i < 4; i++) {
        at[i] = (uint8_t)(value >> 8 * i);
    }
}

/* 1/|n| with any mantissa and exponent, whatever the triangle is. */
TEST(any_packed_normal_stays_inside)
{
    static const uint32_t mantissas[] = {
            0x80000000u, 0xa0000000u, 0xc0000000u, 0xe0000000u, 0xffffffe0u};

    accepted = refused = 0;
    build(MINI_BITS_MAX);
    for (unsigned i = 0; i < 32 * 5 * 20; i++) {
        uint8_t *copy = copy_of(mini.size_bytes);
        const ql_blob_header_t *header = (const ql_blob_header_t *)(void *)copy;
        uint8_t *tri = copy + QL_LE32(header->triangles.offset);

        for (uint32_t k = 0; k < QL_LE32(header->triangles.count); k++) {
            put32(tri + k * sizeof(ql_blob_tri_t) + 8,
                    mantissas[i / 32 % 5] | i % 32);
        }
        repair(copy, mini.size_bytes);
        try_damaged(copy, mini.size_bytes);
        free(copy);
    }
    NOTE("%lu opened and rendered, %lu refused", accepted, refused);
}

/* 1/|e1 x e2| of a triangle as it lies in a blob, packed; 0 without area. */
static uint32_t inverse_of(const uint8_t *vertices, const uint8_t *tri)
{
    double v[3][3], n[3], m;
    int e;

    for (unsigned i = 0; i < 9; i++) {
        const unsigned index = tri[2 * (i / 3)] | (unsigned)tri[2 * (i / 3) + 1]
                                                          << 8;
        const uint8_t *at = vertices + 6 * index + 2 * (i % 3);

        v[i / 3][i % 3] = at[0] | at[1] << 8;
    }
    for (unsigned k = 0; k < 3; k++) {
        const unsigned i = (k + 1) % 3, j = (k + 2) % 3;

        n[k] = (v[1][i] - v[0][i]) * (v[2][j] - v[0][j]) -
               (v[1][j] - v[0][j]) * (v[2][i] - v[0][i]);
    }
    m = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (!(m > 0)) {
        return 0;
    }
    m = floor(ldexp(frexp(1 / m, &e), 27) + 0.5);
    if (m >= 134217728.0) {
        m /= 2;
        e++;
    }
    return (uint32_t)m << 5 | (uint32_t)(1 - e);
}

/* Any camera within the limits of its fields, and any corners. */
TEST(any_camera_and_any_triangles_stay_inside)
{
    accepted = refused = 0;
    state = 2;
    for (unsigned i = 0; i < DAMAGED; i++) {
        uint8_t *copy;
        const ql_blob_header_t *header;
        uint8_t *camera, *vertex, *tri;

        if (i % (DAMAGED / 4) == 0) {
            build(i % (DAMAGED / 2) == 0 ? MINI_BITS_MAX : MINI_BITS_MIN);
        }
        copy = copy_of(mini.size_bytes);
        header = (const ql_blob_header_t *)(void *)copy;
        camera = copy + QL_LE32(header->camera.offset);
        vertex = copy + QL_LE32(header->vertices.offset);
        tri = copy + QL_LE32(header->triangles.offset);
        for (unsigned k = 0; k < 27; k++) {
            const unsigned shift = stats_random_below(&state, 31);
            const uint32_t size = (uint32_t)1 << shift;
            const uint32_t value = stats_random_below(&state, 8) == 0
                                           ? size
                                           : stats_random_below(&state, size);

            /* low words of the wide fields keep what they have */
            if (k >= 18 || k % 2 == 1) {
                put32(camera + 4 * k,
                        stats_random_below(&state, 2) ? value : 0u - value);
            }
        }
        for (uint32_t k = 0; k < 3 * QL_LE32(header->vertices.count); k++) {
            if (stats_random_below(&state, 8) == 0) {
                const uint32_t c =
                        stats_random_below(&state, 3)
                                ? 8 + stats_random_below(&state, 32752)
                                : 32759;

                vertex[2 * k] = (uint8_t)(c & 0xffu);
                vertex[2 * k + 1] = (uint8_t)(c >> 8);
            }
        }
        for (uint32_t k = 0; k < QL_LE32(header->triangles.count); k++) {
            put32(tri + 12 * k + 8, inverse_of(vertex, tri + 12 * k));
        }
        repair(copy, mini.size_bytes);
        try_damaged(copy, mini.size_bytes);
        free(copy);
    }
    CHECK(accepted > DAMAGED / 2, "%lu opened, %lu refused", accepted, refused);
    NOTE("%lu opened, %lu refused", accepted, refused);
}

TEST(every_status_has_a_text)
{
#define CHECK_TEXT(name, number, text)                                         \
    CHECK(strcmp(ql_status_text(name), text) == 0 && (name) == (number),       \
            "status %d", name);
    QL_STATUS_LIST(CHECK_TEXT)
    CHECK(strcmp(ql_status_text((ql_status_t)-99), "unknown status") == 0,
            "of -99: %s", ql_status_text((ql_status_t)-99));
}

/* A bit of a feature that is not built in is refused by the feature's name. */
TEST(features_that_are_not_built_in_are_named)
{
    unsigned named = 0;

#define CHECK_NAME(name, bit, text)                                            \
    {                                                                          \
        ql_blob_header_t *header;                                              \
        ql_scene_t scene;                                                      \
        uint8_t *copy;                                                         \
        ql_status_t status;                                                    \
        build(MINI_BITS_MAX);                                                  \
        copy = copy_of(mini.size_bytes);                                       \
        header = (ql_blob_header_t *)(void *)copy;                             \
        header->features |= QL_LE32((uint32_t)(name));                         \
        repair(copy, mini.size_bytes);                                         \
        status = open_copy(&scene, copy, mini.size_bytes);                     \
        CHECK((status == QL_ERR_FEATURE) == (*ql_blob_missing(copy) != 0),     \
                "%s: status %d, missing \"%s\"", text, status,                 \
                ql_blob_missing(copy));                                        \
        CHECK(*ql_blob_missing(copy) == 0 ||                                   \
                        strcmp(ql_blob_missing(copy), text) == 0,              \
                "%s is called %s", text, ql_blob_missing(copy));               \
        named += *ql_blob_missing(copy) != 0;                                  \
        free(copy);                                                            \
    }
    QL_FEATURE_LIST(CHECK_NAME)
#undef CHECK_NAME
    NOTE("%u named", named);
}

/* ---- Tables of features ------------------------------------------------ */

TEST(flipped_bits_of_every_table_stay_inside)
{
    accepted = refused = 0;
    build_all(MINI_BITS_MIN);
    flip_every_bit();
    report();
}

TEST(random_damage_to_every_table_stays_inside)
{
    accepted = refused = 0;
    state = 3;
    build_all(MINI_BITS_MAX);
    damage_often(DAMAGED);
    report();
}

TEST(nasty_values_in_every_table_stay_inside)
{
    accepted = refused = 0;
    build_all(MINI_BITS_MAX);
    try_nasty_values();
    report();
}

#if ALL

TEST(a_blob_with_every_table_opens)
{
    for (unsigned bits = MINI_BITS_MIN; bits <= MINI_BITS_MAX; bits += 8) {
        ql_scene_t scene;
        uint8_t *copy;

        build_all(bits);
        copy = copy_of(mini.size_bytes);
        CHECK(open_copy(&scene, copy, mini.size_bytes) == QL_OK, "%u bits",
                bits);
        CHECK(scene.gloss_count == 3 && scene.light_count == 2 &&
                        scene.table_count == 3 && scene.lens != NULL &&
                        scene.normals != NULL &&
                        QL_LE16(scene.lights[1].triangle) == QL_LIGHT_SKY,
                "%u bits: %u glossy, %u lights, %u tables", bits,
                scene.gloss_count, scene.light_count, scene.table_count);
        free(copy);
    }
}

enum {
#define OPTIONAL_INDEX(name, entry, needs) OPTIONAL_##name,
    QL_BLOB_OPTIONAL_LIST(OPTIONAL_INDEX)
#undef OPTIONAL_INDEX
            CORE_triangles,
    CORE_materials,
    CORE_lights
};

/* Where a table is described: the entry in the header. */
static ql_blob_table_t *described(uint8_t *copy, unsigned table)
{
    ql_blob_header_t *const h = (ql_blob_header_t *)(void *)copy;

    return table == CORE_triangles   ? &h->triangles
           : table == CORE_materials ? &h->materials
           : table == CORE_lights    ? &h->lights
                                  : (ql_blob_table_t *)(void *)(h + 1) + table;
}

typedef struct {
    const char *rule;
    unsigned table;
    size_t at;      /* bytes into the table; COUNT is its count */
    unsigned bytes; /* of the field */
    uint32_t value;
} broken_t;

#define COUNT ((size_t)-1)
#define IN(entry, i, field)                                                    \
    ((i) * sizeof(entry) + offsetof(entry, field)), sizeof(((entry *)0)->field)

/* The triangles are sorted by the tree; entry 0 here is the first sphere. */
static size_t sphere_entry(const uint8_t *copy, const ql_blob_table_t *table)
{
    const ql_blob_tri_t *tri =
            (const ql_blob_tri_t *)(const void *)(copy +
                                                  QL_LE32(table->offset));
    size_t i = 0;

    while (tri[i].inv_n != 0) {
        i++;
    }
    return i * sizeof *tri;
}

TEST(every_rule_of_every_table_is_checked)
{
    /* materials as written: Phong, mirror, glass, then diffuse ones */
    static const broken_t broken[] = {
        {"as many normals as vertices", OPTIONAL_normals, COUNT, 4, 3},
        {"no more gloss than materials", OPTIONAL_gloss, COUNT, 4, 6},
        {"a kind", OPTIONAL_gloss, IN(ql_blob_gloss_t, 0, kind), 0},
        {"a known kind", OPTIONAL_gloss, IN(ql_blob_gloss_t, 0, kind), 4},
        {"zero is zero", OPTIONAL_gloss, IN(ql_blob_gloss_t, 0, zero), 1},
        {"Ks <= 1", OPTIONAL_gloss, IN(ql_blob_gloss_t, 1, specular[2]),
                0x80000001u},
        {"Kd + Ks <= 1", OPTIONAL_gloss, IN(ql_blob_gloss_t, 1, specular[0]),
                0x7fffffffu},
        {"chance <= 1", OPTIONAL_gloss, IN(ql_blob_gloss_t, 0, chance),
                0x80000001u},
        {"a mirror has no exponent", OPTIONAL_gloss,
                IN(ql_blob_gloss_t, 1, parameter), 1},
        {"glass always refracts", OPTIONAL_gloss,
                IN(ql_blob_gloss_t, 2, chance), 0x7fffffffu},
        {"Ni >= 1/16", OPTIONAL_gloss, IN(ql_blob_gloss_t, 2, parameter), 4095},
        {"Ni <= 64", OPTIONAL_gloss, IN(ql_blob_gloss_t, 2, parameter),
                4194305},
        {"glass has no Kd", CORE_materials,
                IN(ql_blob_material_t, 2, albedo[1]), 1},
        {"a unit of radius", OPTIONAL_spheres, IN(ql_blob_sphere_t, 1, radius),
                255},
        {"not too large", OPTIONAL_spheres, IN(ql_blob_sphere_t, 0, radius),
                2000000 - 2047},
        {"not past 0", OPTIONAL_spheres, IN(ql_blob_sphere_t, 1, centre[2]),
                256 + 2047},
        {"not past the end", OPTIONAL_spheres,
                IN(ql_blob_sphere_t, 1, centre[0]), 32759 * 256 - 255},
        {"one sky", OPTIONAL_sky, COUNT, 4, 0},
        {"a wide map", OPTIONAL_sky, IN(ql_blob_sky_t, 0, width), 0},
        {"a map of its size", OPTIONAL_sky, IN(ql_blob_sky_t, 0, height), 3},
        {"a table", OPTIONAL_sky, IN(ql_blob_sky_t, 0, table), 3},
        {"a table of its height", OPTIONAL_sky, IN(ql_blob_sky_t, 0, table), 1},
        {"a table of its size", OPTIONAL_sky, IN(ql_blob_sky_t, 0, table), 0},
        {"all texels", OPTIONAL_texels, COUNT, 4, 31},
        {"exponents to 23", OPTIONAL_texels, IN(ql_blob_texel_t, 3, rgb9e5),
                24ul << 27},
        {"1 to 3 dimensions", OPTIONAL_tables,
                IN(ql_blob_distribution_t, 0, dims), 4},
        {"1 beyond them", OPTIONAL_tables,
                IN(ql_blob_distribution_t, 1, count[2]), 2},
        {"rows among the words", OPTIONAL_tables,
                IN(ql_blob_distribution_t, 2, first), 33},
        {"a first word", OPTIONAL_tables, IN(ql_blob_distribution_t, 0, first),
                1000000},
        {"all words", OPTIONAL_words, COUNT, 4, 67},
        {"rows that are not empty", OPTIONAL_words, 0, 2, 0},
        {"one lens", OPTIONAL_lens, COUNT, 4, 0},
        {"a lens within reach", OPTIONAL_lens,
                IN(ql_blob_lens_t, 0, p[1][2][1]), 0x40000001u},
        {"rays within reach", OPTIONAL_lens, IN(ql_blob_lens_t, 0, d[0][1]),
                0xbfffffffu},
        {"a mark for each triangle", OPTIONAL_contacts, COUNT, 4, 0},
        {"no mark more", OPTIONAL_contacts, COUNT, 4, 2},
        {"a rank for each triangle", OPTIONAL_ranks, COUNT, 4, 5},
        {"one hull", OPTIONAL_hull, COUNT, 4, 0},
        {"no hull more", OPTIONAL_hull, COUNT, 4, 2},
        {"the sky is the last light", CORE_lights,
                IN(ql_blob_light_t, 1, triangle), 0},
        {"lights in order", CORE_lights, IN(ql_blob_light_t, 0, triangle),
                65535},
#if !QL_CFG_SMALL
        {"a node there is", OPTIONAL_sides, IN(ql_blob_side_t, 0, node), 6},
        {"all sides", OPTIONAL_sides, COUNT, 4, 65536},
#endif
#if QL_CFG_SLANTED && !QL_CFG_SMALL
        {"a side's triangle there is", OPTIONAL_sides,
                IN(ql_blob_side_t, 0, triangle), 6},
#endif
        {"a sphere there is", CORE_triangles, IN(ql_blob_tri_t, 0, vertex[0]),
                4},
        {"a sphere has one index", CORE_triangles,
                IN(ql_blob_tri_t, 0, vertex[2]), 1},
        {"a sphere is on page 0", CORE_triangles,
                IN(ql_blob_tri_t, 0, material), 0x4000},
    };
    const size_t count = sizeof broken / sizeof broken[0];

    build_all(MINI_BITS_MAX);
    for (size_t i = 0; i < count; i++) {
        const broken_t *const b = broken + i;
        uint8_t *copy = copy_of(mini.size_bytes);
        ql_blob_table_t *const table = described(copy, b->table);
        uint8_t *at = b->at == COUNT ? (uint8_t *)&table->count
                                     : copy + QL_LE32(table->offset) + b->at;
        ql_scene_t scene;
        ql_status_t status;

        at += b->table == CORE_triangles ? sphere_entry(copy, table) : 0;
        for (unsigned k = 0; k < b->bytes; k++) {
            at[k] = (uint8_t)(b->value >> 8 * k & 0xffu);
        }
        repair(copy, mini.size_bytes);
        status = open_copy(&scene, copy, mini.size_bytes);
        CHECK(status == QL_ERR_RANGE, "%s: status %d", b->rule, status);
        free(copy);
    }
    NOTE("%u rules", (unsigned)count);
}

/* Without spheres an entry of the table of triangles must be a triangle. */
TEST(a_sphere_without_a_table_of_spheres_is_refused)
{
    ql_scene_t scene;
    uint8_t *copy;

    build(MINI_BITS_MAX);
    copy = copy_of(mini.size_bytes);
    memset(copy + QL_LE32(described(copy, CORE_triangles)->offset), 0, 12);
    repair(copy, mini.size_bytes);
    CHECK(open_copy(&scene, copy, mini.size_bytes) == QL_ERR_RANGE, "status %d",
            open_copy(&scene, copy, mini.size_bytes));
    free(copy);
}

#endif

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_blob", argc, argv);
    RUN(a_good_blob_opens);
    RUN(a_blob_cut_at_any_byte_is_truncated);
    RUN(a_size_that_is_no_multiple_of_4_is_refused);
    RUN(an_unaligned_blob_is_refused);
    RUN(any_flipped_bit_is_refused_with_the_right_status);
    RUN(a_feature_of_tomorrow_is_named_unknown);
    RUN(a_deeper_tree_than_the_stack_is_refused);
    RUN(any_flipped_bit_with_the_crc_repaired_stays_inside);
    RUN(random_damage_with_the_crc_repaired_stays_inside);
    RUN(nasty_values_in_every_field_stay_inside);
    RUN(any_packed_normal_stays_inside);
    RUN(any_camera_and_any_triangles_stay_inside);
    RUN(a_tree_that_doubles_back_is_refused);
    RUN(every_status_has_a_text);
    RUN(features_that_are_not_built_in_are_named);
    RUN(flipped_bits_of_every_table_stay_inside);
    RUN(random_damage_to_every_table_stays_inside);
    RUN(nasty_values_in_every_table_stay_inside);
#if ALL
    RUN(a_blob_with_every_table_opens);
    RUN(every_rule_of_every_table_is_checked);
    RUN(a_sphere_without_a_table_of_spheres_is_refused);
#endif
    return TEST_END();
}
