/* test_deflate.c - streams that zlib packed, and each reason to refuse one */
/* SPDX-License-Identifier: MIT */

#include <stdlib.h>
#include <string.h>

#include "lib/image/deflate.h"
#include "lib/program/cli.h"
#include "support/ql_test.h"

/* ---- What zlib packed --------------------------------------------------- */

enum { CODES_BYTES = 204472 }; /* of write_codes() */

typedef struct {
    uint8_t *bytes;
    size_t size;
    uint32_t state; /* of the noise */
} text_t;

static uint8_t noise(text_t *text)
{
    text->state = text->state * 1664525u + 1013904223u;
    return (uint8_t)(text->state >> 24);
}

static void add_noise(text_t *text, size_t n)
{
    while (n-- > 0) {
        text->bytes[text->size++] = noise(text);
    }
}

/* Repeat n bytes from so far behind. */
static void repeat(text_t *text, size_t n, size_t distance)
{
    for (; n > 0; n--, text->size++) {
        text->bytes[text->size] = text->bytes[text->size - distance];
    }
}

/* Noise repeated at once, so that a match of n bytes says it best. */
static void add_length(text_t *text, size_t n)
{
    add_noise(text, n);
    add_noise(text, 1);
    repeat(text, n, n + 1);
    add_noise(text, 1);
}

/* Twelve bytes repeated at this distance. */
static void add_distance(text_t *text, size_t distance)
{
    if (distance < 12) {
        add_noise(text, distance);
    } else {
        add_noise(text, 12);
        text->size += distance - 12; /* zeros */
    }
    repeat(text, 12, distance);
    add_noise(text, 1);
}

/* Every literal; the first and the last length of each code of lengths; the
 * same of distances. RFC 1951, 3.2.5, has them as ranges. */
static void write_codes(text_t *text)
{
    static const uint16_t lengths[][2] = {{3, 3}, {4, 4}, {5, 5}, {6, 6},
            {7, 7}, {8, 8}, {9, 9}, {10, 10}, {11, 12}, {13, 14}, {15, 16},
            {17, 18}, {19, 22}, {23, 26}, {27, 30}, {31, 34}, {35, 42},
            {43, 50}, {51, 58}, {59, 66}, {67, 82}, {83, 98}, {99, 114},
            {115, 130}, {131, 162}, {163, 194}, {195, 226}, {227, 257},
            {258, 258}};
    static const uint16_t distances[][2] = {{1, 1}, {2, 2}, {3, 3}, {4, 4},
            {5, 6}, {7, 8}, {9, 12}, {13, 16}, {17, 24}, {25, 32}, {33, 48},
            {49, 64}, {65, 96}, {97, 128}, {129, 192}, {193, 256}, {257, 384},
            {385, 512}, {513, 768}, {769, 1024}, {1025, 1536}, {1537, 2048},
            {2049, 3072}, {3073, 4096}, {4097, 6144}, {6145, 8192},
            {8193, 12288}, {12289, 16384}, {16385, 24576}, {24577, 32768}};

    text->bytes = cli_alloc(CODES_BYTES, 1);
    text->size = 0;
    text->state = 1;
    while (text->size < 256) {
        text->bytes[text->size] = (uint8_t)text->size;
        text->size++;
    }
    for (size_t i = 0; i < 29; i++) {
        add_length(text, lengths[i][0]);
        if (lengths[i][1] > lengths[i][0]) {
            add_length(text, lengths[i][1]);
        }
    }
    for (size_t i = 0; i < 30; i++) {
        add_distance(text, distances[i][0]);
        if (distances[i][1] > distances[i][0]) {
            add_distance(text, distances[i][1]);
        }
    }
}

static void check_stream(const uint8_t *packed, size_t size, const text_t *text,
        const char *name)
{
    uint8_t *back = cli_alloc(text->size, 1);
    size_t where;
    const char *error = deflate_unpack(packed, size, back, text->size, &where);

    CHECK(error == NULL && where == size, "%s: byte %zu of %zu: %s", name,
            where, size, error);
    CHECK(memcmp(back, text->bytes, text->size) == 0, "%s: other bytes", name);
    free(back);
}

TEST(every_code_that_zlib_writes_is_read)
{
    static const char *const names[] = {"tests/tools/foreign/dynamic.zlib",
            "tests/tools/foreign/fixed.zlib"};
    text_t text;

    write_codes(&text);
    CHECK(text.size == CODES_BYTES, "%zu bytes", text.size);
    for (unsigned i = 0; i < 2; i++) {
        size_t size;
        uint8_t *packed = cli_read(names[i], &size);

        check_stream(packed, size, &text, names[i]);
        free(packed);
    }
    free(text.bytes);
}

/* What a stream writes into memory. */
typedef struct {
    uint8_t bytes[1 << 18];
    size_t size;
} packed_t;

static void collect(void *to, const uint8_t *bytes, size_t size)
{
    packed_t *packed = to;

    CHECK(size <= sizeof packed->bytes - packed->size, "%zu more bytes", size);
    memcpy(packed->bytes + packed->size, bytes, size);
    packed->size += size;
}

/* By a reader that another program's streams have shown to be right; handed
 * over a piece at a time. */
static size_t check_comes_back(const text_t *text, size_t piece)
{
    packed_t *packed = cli_alloc(1, sizeof *packed);
    deflate_t *stream = deflate_begin(collect, packed);
    size_t size;

    for (size_t at = 0; at < text->size; at += piece) {
        const size_t left = text->size - at;

        deflate_put(stream, text->bytes + at, left < piece ? left : piece);
    }
    deflate_end(stream);
    check_stream(packed->bytes, packed->size, text, "packed by ourselves");
    size = packed->size;
    free(packed);
    return size;
}

TEST(every_code_comes_back)
{
    text_t text;
    size_t size;

    write_codes(&text);
    size = check_comes_back(&text, text.size);
    CHECK(size < 7500, "packed to %zu bytes", size);
    CHECK(check_comes_back(&text, 1) == size &&
                    check_comes_back(&text, 49152) == size,
            "%s", "pieces change the stream");
    free(text.bytes);
}

/* Noise, which is stored, and what repeats. */
TEST(data_of_every_length_come_back)
{
    text_t text = {cli_alloc(1 << 18, 1), 0, 1};

    for (size_t n = 0; n < 200000; n = n < 600 ? n + 1 : n * 2 + 1) {
        text.size = 0;
        if (n % 3 == 0) {
            add_noise(&text, n);
        }
        for (; text.size < n; text.size++) {
            text.bytes[text.size] = (uint8_t)(text.size / 7 % (n % 5 + 1));
        }
        (void)check_comes_back(&text, n / 3 + 1);
    }
    free(text.bytes);
}

/* What is a window away from its like is found there, one byte farther is not,
 * in whatever block it is. Noise of seven bits costs its bytes. */
TEST(matches_reach_back_a_window_across_blocks)
{
    enum { NOISE = 32768 + 65000, HEAD = 2, TAIL = 4 };
    text_t text = {cli_alloc(1 << 18, 1), 0, 7};
    size_t near, far;

    add_noise(&text, NOISE);
    for (size_t i = 0; i < NOISE; i++) {
        text.bytes[i] &= 0x7f;
    }
    repeat(&text, 258, 32768);
    near = check_comes_back(&text, 1000);
    text.size = NOISE;
    repeat(&text, 258, 32769);
    far = check_comes_back(&text, 1000);
    CHECK(near < far - 200 && far <= NOISE + 258 + HEAD + 2 * 5 + TAIL,
            "%zu and %zu bytes", near, far);
    free(text.bytes);
}

/* ---- Streams bit by bit ------------------------------------------------- */

typedef struct {
    uint8_t bytes[512];
    size_t bits;
} stream_t;

static void put(stream_t *s, uint32_t value, unsigned n)
{
    for (unsigned i = 0; i < n; i++, s->bits++) {
        s->bytes[s->bits / 8] |= (uint8_t)((value >> i & 1u) << s->bits % 8);
    }
}

/* A Huffman code, whose highest bit comes first. */
static void put_code(stream_t *s, uint32_t code, unsigned n)
{
    while (n-- > 0) {
        put(s, code >> n & 1u, 1);
    }
}

/* A zlib stream whose first block, the last one, is of this kind. */
static stream_t begin(unsigned kind)
{
    stream_t s = {{0}, 0};

    put(&s, 0x78, 8);
    put(&s, 0x01, 8);
    put(&s, 1, 1);
    put(&s, kind, 2);
    return s;
}

enum { STORED, FIXED, DYNAMIC, NO_KIND };

/* Symbols of the code of code lengths that begin_dynamic() writes: 3 bits each,
 * in the order of what they stand for. */
enum { LENGTH_0, LENGTH_1, LENGTH_2, LENGTH_8, AGAIN, ZEROS, MANY_ZEROS };

static stream_t begin_dynamic(unsigned literals, unsigned distances)
{
    static const uint8_t has[18] = {1, 1, 1, 1, 1, [15] = 1, [17] = 1};
    stream_t s = begin(DYNAMIC);

    put(&s, literals - 257, 5);
    put(&s, distances - 1, 5);
    put(&s, 18 - 4, 4);
    for (unsigned i = 0; i < 18; i++) {
        put(&s, has[i] ? 3 : 0, 3);
    }
    return s;
}

static void put_zeros(stream_t *s, unsigned n)
{
    put_code(s, MANY_ZEROS, 3);
    put(s, n - 11, 7); /* 11 to 138 */
}

/* Is it refused for this reason, where so many bytes out are wanted? Sixteen
 * bits follow it, or none. */
static void check_refused(
        stream_t *s, unsigned follow, size_t wanted, const char *reason)
{
    uint8_t out[64];
    size_t size, where;
    const char *error;

    s->bits += follow;
    size = (s->bits + 7) / 8;
    error = deflate_unpack(s->bytes, size, out, wanted, &where);
    CHECK(error != NULL && strcmp(error, reason) == 0, "%s, wanted %s",
            error != NULL ? error : "(nothing)", reason);
    CHECK(where <= size, "at %zu of %zu", where, size);
}

TEST(other_headers_are_refused)
{
    static const uint8_t heads[][2] = {
            {0x77, 0x03}, {0x88, 0x1c}, {0x78, 0x02}, {0x78, 0x20}};

    for (unsigned i = 0; i < 5; i++) {
        stream_t s = begin(STORED);

        if (i < 4) {
            memcpy(s.bytes, heads[i], 2);
        } else {
            s.bits = 8;
        }
        check_refused(&s, 0, 1, "expected a zlib stream without dictionary");
    }
}

TEST(a_block_of_no_kind_is_refused)
{
    stream_t s = begin(NO_KIND);

    check_refused(&s, 16, 1, "a block of no known kind");
}

/* LEN, its complement, then the bytes. */
TEST(stored_blocks_are_checked)
{
    static const char early[] = "the compressed data end too early";
    static const uint16_t lengths[][2] = {
            {2, 0xfffc}, {2, 0xfffd}, {2, 0xfffd}, {9, 0xfff6}};
    static const char *const reasons[] = {
            "a stored block's length and its complement differ",
            "more data than the picture has", early, early};

    for (unsigned i = 0; i < 4; i++) {
        stream_t s = begin(STORED);

        s.bits = 24; /* to a whole byte */
        put(&s, lengths[i][0], 16);
        put(&s, lengths[i][1], 16);
        check_refused(&s, i == 2 ? 8 : 64, i == 1 ? 1 : 9, reasons[i]);
    }
    for (unsigned bits = 19; bits < 48; bits += 8) {
        stream_t s = begin(STORED);

        s.bytes[5] = s.bytes[6] = 0xff;
        s.bits = bits;
        check_refused(&s, 0, 9, early);
    }
}

/* Two blocks, the second stored, wherever the first one ends in its byte. */
TEST(a_stored_block_begins_at_a_whole_byte)
{
    for (unsigned n = 1; n <= 9; n++) {
        stream_t s = begin(FIXED);
        uint8_t out[16];
        uint32_t a = 1, b = 0;
        size_t where;
        const char *error;

        s.bytes[2] &= 0xfe; /* not the last block */
        for (unsigned i = 0; i < n; i++) {
            put_code(&s, 0x190 + 0xf0 - 144, 9); /* the byte 0xf0 */
            a += 0xf0;
            b += a;
        }
        put_code(&s, 0, 7);
        put(&s, 1, 1);
        put(&s, STORED, 2);
        s.bits = (s.bits + 7) / 8 * 8;
        put(&s, 1, 16);
        put(&s, 0xfffe, 16);
        put(&s, 'z', 8);
        a += 'z';
        b += a;
        for (unsigned i = 0; i < 4; i++) {
            put(&s, (b << 16 | a) >> (24 - 8 * i), 8);
        }
        error = deflate_unpack(s.bytes, s.bits / 8, out, n + 1, &where);
        CHECK(error == NULL && where == s.bits / 8 && out[0] == 0xf0 &&
                        out[n - 1] == 0xf0 && out[n] == 'z',
                "%u bytes before: %s at %zu", n, error, where);
    }
}

/* The symbols of fixed codes: literal 0 is 0x30 of 8 bits, 257 is 1 of 7. */
TEST(matches_are_checked)
{
    stream_t s = begin(FIXED);

    put_code(&s, 0xc0 + 286 - 280, 8);
    check_refused(&s, 16, 9, "a length code out of range");
    for (unsigned distance = 30; distance < 32; distance++) {
        s = begin(FIXED);
        put_code(&s, 0x30, 8);
        put_code(&s, 1, 7);
        put_code(&s, distance, 5);
        check_refused(&s, 16, 9, "a code that the block does not define");
    }
    s = begin(FIXED);
    put_code(&s, 0x30, 8);
    put_code(&s, 1, 7);
    put_code(&s, 1, 5); /* two back, after one */
    check_refused(&s, 16, 9, "a match before the beginning");
    s = begin(FIXED);
    put_code(&s, 0x30, 8);
    put_code(&s, 1, 7);
    put_code(&s, 0, 5);
    check_refused(&s, 16, 3, "more data than the picture has");
    s = begin(FIXED);
    put_code(&s, 0x30, 8);
    check_refused(&s, 16, 0, "more data than the picture has");
    s = begin(FIXED);
    put_code(&s, 0x30, 8);
    check_refused(&s, 0, 9, "the compressed data end too early");
    s = begin(FIXED);
    put_code(&s, 0x30, 8);
    put_code(&s, 0, 7);
    check_refused(&s, 32, 2, "less data than the picture has");
    s = begin(FIXED);
    put_code(&s, 0x30, 8);
    put_code(&s, 0, 7);
    check_refused(&s, 38, 1, "the Adler-32 does not match");
}

/* Each repeat at its least and its most: where a code stands says which byte it
 * is. Codes of 8 bits follow the one of 1 bit, which ends the block. */
TEST(repeated_code_lengths_are_counted)
{
    static const char want[] = "abcdefghijny\x85";
    static const struct {
        unsigned symbol, repeat, bits;
    } lengths[] = {{MANY_ZEROS, 97 - 11, 7}, {LENGTH_8, 0, 0}, {AGAIN, 0, 2},
            {AGAIN, 3, 2}, {ZEROS, 0, 3}, {LENGTH_8, 0, 0}, {ZEROS, 7, 3},
            {LENGTH_8, 0, 0}, {MANY_ZEROS, 0, 7}, {LENGTH_8, 0, 0},
            {MANY_ZEROS, 256 - 134 - 11, 7}, {LENGTH_1, 0, 0},
            {LENGTH_0, 0, 0}};
    stream_t s = begin_dynamic(257, 1);
    uint32_t a = 1, b = 0;
    uint8_t out[13];
    size_t where;
    const char *error;

    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        put_code(&s, lengths[i].symbol, 3);
        put(&s, lengths[i].repeat, lengths[i].bits);
    }
    for (unsigned i = 0; i < 13; i++) {
        put_code(&s, 128 + i, 8);
        a += (uint8_t)want[i];
        b += a;
    }
    put_code(&s, 0, 1);
    s.bits = (s.bits + 7) / 8 * 8;
    for (unsigned i = 0; i < 4; i++) {
        put(&s, (b << 16 | a) >> (24 - 8 * i), 8);
    }
    error = deflate_unpack(s.bytes, s.bits / 8, out, 13, &where);
    CHECK(error == NULL && memcmp(out, want, 13) == 0, "%s at %zu", error,
            where);
}

TEST(code_lengths_are_checked)
{
    static const char misfit[] = "code lengths that do not fit";
    static const char range[] = "code lengths out of range";
    stream_t s = begin(DYNAMIC);

    put(&s, 287 - 257, 5);
    check_refused(&s, 200, 9, "too many codes");
    s = begin(DYNAMIC);
    put(&s, 0, 5);
    put(&s, 31 - 1, 5);
    check_refused(&s, 200, 9, "too many codes");
    s = begin(DYNAMIC);
    put(&s, 0, 10);
    put(&s, 0, 4);
    put(&s, 011111, 12); /* four codes of one bit */
    check_refused(&s, 16, 9, misfit);
    s = begin_dynamic(257, 1);
    put_code(&s, AGAIN, 3); /* again what? */
    check_refused(&s, 16, 9, range);
    s = begin_dynamic(257, 1);
    put_zeros(&s, 138);
    put_zeros(&s, 121);
    check_refused(&s, 16, 9, range);
    s = begin_dynamic(257, 1);
    for (unsigned i = 0; i < 3; i++) {
        put_code(&s, LENGTH_1, 3);
    }
    put_zeros(&s, 138);
    put_zeros(&s, 117);
    check_refused(&s, 16, 9, misfit);
    s = begin_dynamic(257, 3);
    put_zeros(&s, 138);
    put_zeros(&s, 119);
    for (unsigned i = 0; i < 3; i++) {
        put_code(&s, LENGTH_1, 3);
    }
    check_refused(&s, 16, 9, misfit);
    s = begin_dynamic(257, 1);
    put_code(&s, LENGTH_1, 3);
    put_zeros(&s, 138);
    put_zeros(&s, 119);
    put_code(&s, 1, 1); /* only 0 is a code */
    check_refused(&s, 16, 9, "a code that the block does not define");
}

int main(int argc, char **argv)
{
    cli_begin("test_deflate");
    TEST_BEGIN("tools/test_deflate", argc, argv);
    RUN(every_code_that_zlib_writes_is_read);
    RUN(every_code_comes_back);
    RUN(data_of_every_length_come_back);
    RUN(matches_reach_back_a_window_across_blocks);
    RUN(other_headers_are_refused);
    RUN(a_block_of_no_kind_is_refused);
    RUN(stored_blocks_are_checked);
    RUN(a_stored_block_begins_at_a_whole_byte);
    RUN(matches_are_checked);
    RUN(repeated_code_lengths_are_counted);
    RUN(code_lengths_are_checked);
    return TEST_END();
}
