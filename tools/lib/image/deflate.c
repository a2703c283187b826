/* deflate.c - compress and expand zlib streams (RFC 1950, RFC 1951) */
/* SPDX-License-Identifier: MIT */

#include "lib/image/deflate.h"

#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"

enum {
    WINDOW = 32768,
    MATCH_MIN = 3,
    MATCH_MAX = 258,
    END_OF_BLOCK = 256,
    LENGTH_CODES = 29, /* symbols 257.. */
    DISTANCE_CODES = 30,
    CODE_BITS_MAX = 15,
    BLOCK = 65535, /* bytes: the most that a stored one holds */
    HASH_BITS = 15
};

/* RFC 1951, 3.2.5: the smallest value of each code and its extra bits. */
static const uint16_t length_base[LENGTH_CODES] = {3, 4, 5, 6, 7, 8, 9, 10, 11,
        13, 15, 17, 19, 23, 27, 31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163,
        195, 227, 258};
static const uint8_t length_extra[LENGTH_CODES] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1,
        1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
static const uint16_t distance_base[DISTANCE_CODES] = {1, 2, 3, 4, 5, 7, 9, 13,
        17, 25, 33, 49, 65, 97, 129, 193, 257, 385, 513, 769, 1025, 1537, 2049,
        3073, 4097, 6145, 8193, 12289, 16385, 24577};
static const uint8_t distance_extra[DISTANCE_CODES] = {0, 0, 0, 0, 1, 1, 2, 2,
        3, 3, 4, 4, 5, 5, 6, 6, 7, 7, 8, 8, 9, 9, 10, 10, 11, 11, 12, 12, 13,
        13};

/* Go on with the check value of RFC 1950; 1 begins it. */
static uint32_t adler32(uint32_t adler, const uint8_t *data, size_t size)
{
    uint32_t a = adler & 0xffffu, b = adler >> 16;

    for (size_t i = 0; i < size; i++) {
        a = (a + data[i]) % 65521;
        b = (b + a) % 65521;
    }
    return b << 16 | a;
}

/* ---- Compress ---------------------------------------------------------- */

typedef struct {
    uint8_t *bytes;
    size_t size;
    uint32_t bits; /* waiting, first in the lowest */
    unsigned count;
} writer_t;

/* What comes waits until it is a block; what went stays for a window. Places
 * are counted from the first byte that ever came, so a picture may have more
 * bytes than memory. */
struct deflate {
    deflate_sink_t *sink;
    void *to;
    writer_t writer;
    uint8_t bytes[WINDOW + BLOCK];
    uint64_t base;  /* place of the first of them */
    size_t history; /* of them, went already */
    size_t size;    /* of them, there */
    uint32_t adler;
    uint64_t last[1 << HASH_BITS]; /* place of a hash plus one; 0 is none */
};

/* Append n <= 16 bits, lowest first. */
static void put_bits(writer_t *w, uint32_t value, unsigned n)
{
    w->bits |= value << w->count; /* count < 8 */
    w->count += n;
    while (w->count >= 8) {
        w->bytes[w->size++] = (uint8_t)w->bits;
        w->bits >>= 8;
        w->count -= 8;
    }
}

/* Append a Huffman code, which goes highest bit first. */
static void put_code(writer_t *w, uint32_t code, unsigned n)
{
    uint32_t reversed = 0;

    for (unsigned i = 0; i < n; i++) {
        reversed = reversed << 1 | (code >> i & 1u);
    }
    put_bits(w, reversed, n);
}

/* A literal, length or end symbol in the fixed code (RFC 1951, 3.2.6). */
static void put_symbol(writer_t *w, unsigned symbol)
{
    if (symbol < 144) {
        put_code(w, 0x30 + symbol, 8);
    } else if (symbol < 256) {
        put_code(w, 0x190 + symbol - 144, 9);
    } else if (symbol < 280) {
        put_code(w, symbol - 256, 7);
    } else {
        put_code(w, 0xc0 + symbol - 280, 8);
    }
}

/* The code whose range holds value: the last base not above it. */
static unsigned find_code(const uint16_t *base, unsigned count, unsigned value)
{
    unsigned code = count - 1;

    while (base[code] > value) {
        code--;
    }
    return code;
}

static void put_match(writer_t *w, unsigned length, unsigned distance)
{
    const unsigned l = find_code(length_base, LENGTH_CODES, length);
    const unsigned d = find_code(distance_base, DISTANCE_CODES, distance);

    put_symbol(w, 257 + l);
    put_bits(w, length - length_base[l], length_extra[l]);
    put_code(w, d, 5);
    put_bits(w, distance - distance_base[d], distance_extra[d]);
}

static unsigned hash3(const uint8_t *p)
{
    const uint32_t v = p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16;

    return (uint32_t)(v * 2654435761u) >> (32 - HASH_BITS);
}

static unsigned match_length(const uint8_t *a, const uint8_t *b, size_t limit)
{
    unsigned n = 0;

    while (n < limit && n < MATCH_MAX && a[n] == b[n]) {
        n++;
    }
    return n;
}

/* Do blocks follow it? As a stream has it. */
typedef enum { MORE = 0, LAST = 1 } block_t;

/* A block of fixed codes; matches with the last place of equal hash. */
static void put_fixed_block(deflate_t *d, block_t kind)
{
    writer_t *w = &d->writer;
    size_t at = d->history;

    put_bits(w, kind, 1);
    put_bits(w, 1, 2); /* of fixed codes */
    while (at < d->size) {
        const uint64_t place = d->base + at;
        uint64_t distance = 0;
        unsigned length = 0;

        if (d->size - at >= MATCH_MIN) {
            const unsigned h = hash3(d->bytes + at);

            distance = d->last[h] != 0 ? place - (d->last[h] - 1) : 0;
            if (distance != 0 && distance <= WINDOW) { /* and so in bytes */
                length = match_length(d->bytes + at - (size_t)distance,
                        d->bytes + at, d->size - at);
            }
            d->last[h] = place + 1;
        }
        if (length >= MATCH_MIN) {
            put_match(w, length, (unsigned)distance); /* at most WINDOW */
            at += length;
        } else {
            put_symbol(w, d->bytes[at++]);
        }
    }
    put_symbol(w, END_OF_BLOCK);
}

/* What waits as it is. */
static void put_stored_block(deflate_t *d, block_t kind)
{
    const size_t n = d->size - d->history;
    writer_t *w = &d->writer;

    put_bits(w, kind, 1);
    put_bits(w, 0, 2); /* stored */
    put_bits(w, 0, (8 - w->count) % 8);
    put_bits(w, (uint32_t)n, 16);
    put_bits(w, (uint32_t)~n & 0xffffu, 16);
    memcpy(w->bytes + w->size, d->bytes + d->history, n);
    w->size += n;
}

/* All that waits as one block, whichever is shorter; keep a window of it. */
static void put_block(deflate_t *d, block_t kind)
{
    const size_t n = d->size - d->history;
    const writer_t before = d->writer;
    size_t keep;

    d->adler = adler32(d->adler, d->bytes + d->history, n);
    put_fixed_block(d, kind);
    if (d->writer.size - before.size > n + 5) {
        d->writer = before;
        put_stored_block(d, kind);
    }
    if (kind == LAST) {
        put_bits(&d->writer, 0, (8 - d->writer.count) % 8);
        for (unsigned i = 0; i < 4; i++) {
            put_bits(&d->writer, d->adler >> (24 - 8 * i) & 0xffu, 8);
        }
    }
    d->sink(d->to, d->writer.bytes, d->writer.size);
    d->writer.size = 0;
    keep = d->size < WINDOW ? d->size : WINDOW;
    memmove(d->bytes, d->bytes + d->size - keep, keep);
    d->base += d->size - keep;
    d->history = d->size = keep;
}

deflate_t *deflate_begin(deflate_sink_t *sink, void *to)
{
    deflate_t *d = cli_alloc(1, sizeof *d);

    d->sink = sink;
    d->to = to;
    d->adler = 1;
    /* A literal has at most 9 bits, a match fewer a byte. */
    d->writer.bytes = cli_alloc(BLOCK + BLOCK / 8 + 32, 1);
    put_bits(&d->writer, 0x78, 8); /* deflate, 32 KiB window */
    put_bits(&d->writer, 0x01, 8); /* makes the two a multiple of 31 */
    return d;
}

void deflate_put(deflate_t *d, const uint8_t *data, size_t size)
{
    while (size > 0) {
        const size_t room = BLOCK - (d->size - d->history);
        const size_t n = size < room ? size : room;

        if (n == 0) {
            put_block(d, MORE);
        }
        memcpy(d->bytes + d->size, data, n);
        d->size += n;
        data += n;
        size -= n;
    }
}

void deflate_end(deflate_t *d)
{
    put_block(d, LAST);
    free(d->writer.bytes);
    free(d);
}

/* ---- Expand ------------------------------------------------------------ */

typedef struct {
    const uint8_t *in;
    size_t in_size;
    size_t at;
    uint32_t bits;
    unsigned count;
    uint8_t *out;
    size_t out_size;
    size_t done;
    const char *error; /* the first; everything stops */
} reader_t;

/* A canonical Huffman code: how many codes of each length, and the symbols in
 * the order of their codes. */
typedef struct {
    uint16_t count[CODE_BITS_MAX + 1];
    uint16_t symbol[288];
} huffman_t;

/* Take n <= 16 bits; zeros past the end, with the error set. */
static uint32_t take_bits(reader_t *r, unsigned n)
{
    uint32_t value;

    while (r->count < n) { /* count < 16, so bits < 2^24 */
        if (r->at == r->in_size) {
            r->error = "the compressed data end too early";
            return 0;
        }
        r->bits |= (uint32_t)r->in[r->at++] << r->count;
        r->count += 8;
    }
    value = r->bits & ((1u << n) - 1u);
    r->bits >>= n;
    r->count -= n;
    return value;
}

/* Build a code from the length of each symbol; false if they do not fit. An
 * incomplete code is fine: a code that is not there is an error when it comes.
 * (One distance code alone is incomplete and common.) */
static bool build_huffman(huffman_t *h, const uint8_t *lengths, unsigned n)
{
    uint16_t offset[CODE_BITS_MAX + 2] = {0};
    long left = 1;

    memset(h, 0, sizeof *h);
    for (unsigned i = 0; i < n; i++) {
        h->count[lengths[i]]++;
    }
    h->count[0] = 0;
    for (unsigned b = 1; b <= CODE_BITS_MAX; b++) {
        left = 2 * left - h->count[b];
        if (left < 0) {
            return false;
        }
        offset[b + 1] = (uint16_t)(offset[b] + h->count[b]);
    }
    for (unsigned i = 0; i < n; i++) {
        if (lengths[i] != 0) {
            h->symbol[offset[lengths[i]]++] = (uint16_t)i;
        }
    }
    return true;
}

/* Take one symbol: codes of each length are consecutive. */
static unsigned take_symbol(reader_t *r, const huffman_t *h)
{
    unsigned code = 0, first = 0, index = 0;

    for (unsigned b = 1; b <= CODE_BITS_MAX && r->error == NULL; b++) {
        code |= take_bits(r, 1);
        if (code - first < h->count[b]) { /* code >= first always */
            return h->symbol[index + code - first];
        }
        index += h->count[b];
        first = (first + h->count[b]) << 1;
        code <<= 1;
    }
    if (r->error == NULL) {
        r->error = "a code that the block does not define";
    }
    return END_OF_BLOCK;
}

static void take_stored(reader_t *r)
{
    size_t n;

    r->bits = 0; /* skip to a whole byte: fewer than 8 bits wait */
    r->count = 0;
    n = take_bits(r, 16);
    if (take_bits(r, 16) != (~n & 0xffffu) && r->error == NULL) {
        r->error = "a stored block's length and its complement differ";
    }
    if (r->error != NULL) {
        return;
    }
    if (n > r->in_size - r->at) {
        r->error = "the compressed data end too early";
    } else if (n > r->out_size - r->done) {
        r->error = "more data than the picture has";
    } else {
        memcpy(r->out + r->done, r->in + r->at, n);
        r->at += n;
        r->done += n;
    }
}

static void take_match(reader_t *r, unsigned length_code, const huffman_t *dist)
{
    unsigned length, d;
    size_t distance;

    if (length_code >= LENGTH_CODES) {
        r->error = "a length code out of range";
        return;
    }
    length = length_base[length_code] + take_bits(r, length_extra[length_code]);
    d = take_symbol(r, dist); /* < DISTANCE_CODES: no block has more */
    if (r->error != NULL) {
        return;
    }
    distance = distance_base[d] + (size_t)take_bits(r, distance_extra[d]);
    if (distance > r->done) {
        r->error = "a match before the beginning";
    } else if (length > r->out_size - r->done) {
        r->error = "more data than the picture has";
    } else {
        for (; length > 0; length--, r->done++) { /* may overlap itself */
            r->out[r->done] = r->out[r->done - distance];
        }
    }
}

static void take_block(
        reader_t *r, const huffman_t *literals, const huffman_t *distances)
{
    while (r->error == NULL) {
        const unsigned symbol = take_symbol(r, literals);
        if (symbol == END_OF_BLOCK) {
            return;
        }
        if (symbol > END_OF_BLOCK) {
            take_match(r, symbol - END_OF_BLOCK - 1, distances);
        } else if (r->done == r->out_size) {
            r->error = "more data than the picture has";
        } else {
            r->out[r->done++] = (uint8_t)symbol;
        }
    }
}

static void take_fixed(reader_t *r)
{
    huffman_t literals, distances;
    uint8_t lengths[288];

    for (unsigned i = 0; i < 288; i++) {
        lengths[i] = i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8;
    }
    (void)build_huffman(&literals, lengths, 288);
    memset(lengths, 5, DISTANCE_CODES);
    (void)build_huffman(&distances, lengths, DISTANCE_CODES);
    take_block(r, &literals, &distances);
}

/* The code lengths of a dynamic block, themselves run-length coded. */
static void take_lengths(
        reader_t *r, const huffman_t *code, uint8_t *lengths, unsigned n)
{
    unsigned at = 0;

    while (at < n && r->error == NULL) {
        const unsigned symbol = take_symbol(r, code);
        unsigned repeat = 1;
        uint8_t value = (uint8_t)symbol;
        if (r->error != NULL) {
            return;
        }
        if (symbol >= 16) {
            value = symbol == 16 && at > 0 ? lengths[at - 1] : 0;
            repeat = symbol == 16   ? 3 + take_bits(r, 2)
                     : symbol == 17 ? 3 + take_bits(r, 3)
                                    : 11 + take_bits(r, 7);
        }
        if (repeat > n - at || (symbol == 16 && at == 0)) {
            r->error = "code lengths out of range";
            return;
        }
        memset(lengths + at, value, repeat);
        at += repeat;
    }
}

static void take_dynamic(reader_t *r)
{
    static const uint8_t order[19] = {
            16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};
    const unsigned literal_count = 257 + take_bits(r, 5);
    const unsigned distance_count = 1 + take_bits(r, 5);
    const unsigned code_count = 4 + take_bits(r, 4);
    uint8_t lengths[288 + 32] = {0};
    huffman_t code, literals, distances;

    if (literal_count > 286 || distance_count > DISTANCE_CODES) {
        r->error = "too many codes";
    }
    for (unsigned i = 0; i < code_count; i++) { /* at most 19 */
        lengths[order[i]] = (uint8_t)take_bits(r, 3);
    }
    if (r->error == NULL && !build_huffman(&code, lengths, 19)) {
        r->error = "code lengths that do not fit";
    }
    if (r->error != NULL) {
        return;
    }
    memset(lengths, 0, sizeof lengths);
    take_lengths(r, &code, lengths, literal_count + distance_count);
    if (r->error == NULL &&
            (!build_huffman(&literals, lengths, literal_count) ||
                    !build_huffman(&distances, lengths + literal_count,
                            distance_count))) {
        r->error = "code lengths that do not fit";
    }
    if (r->error == NULL) {
        take_block(r, &literals, &distances);
    }
}

static void take_blocks(reader_t *r)
{
    bool last = false;

    while (!last && r->error == NULL) {
        unsigned kind;
        last = take_bits(r, 1) != 0;
        kind = take_bits(r, 2);
        if (r->error != NULL) {
            return;
        }
        if (kind == 0) {
            take_stored(r);
        } else if (kind == 1) {
            take_fixed(r);
        } else if (kind == 2) {
            take_dynamic(r);
        } else {
            r->error = "a block of no known kind";
        }
    }
}

const char *deflate_unpack(const uint8_t *packed, size_t packed_size,
        uint8_t *data, size_t size, size_t *where)
{
    reader_t r = {.in = packed,
            .in_size = packed_size,
            .at = 2,
            .out = data,
            .out_size = size};
    uint32_t adler = 0;

    *where = 0;
    if (packed_size < 2 || (packed[0] & 15) != 8 || packed[0] >> 4 > 7 ||
            (packed[0] * 256 + packed[1]) % 31 != 0 || packed[1] & 0x20) {
        return "expected a zlib stream without dictionary";
    }
    take_blocks(&r);
    if (r.error == NULL && r.done != size) {
        r.error = "less data than the picture has";
    }
    r.bits = 0;
    r.count = 0;
    for (unsigned i = 0; i < 4 && r.error == NULL; i++) {
        adler = adler << 8 | take_bits(&r, 8);
    }
    if (r.error == NULL && adler != adler32(1, data, size)) {
        r.error = "the Adler-32 does not match";
    }
    *where = r.at;
    return r.error;
}
