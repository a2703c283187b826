/* fuzz_deflate.c - a zlib stream: expanded; bytes: packed and expanded again */
/* SPDX-License-Identifier: MIT */

#include <stdlib.h>
#include <string.h>

#include "fuzz/fuzz.h"
#include "lib/image/deflate.h"
#include "lib/program/bytes.h"
#include "lib/program/cli.h"

enum { MOST = 1 << 16 };

/* A stream as it comes. */
typedef struct {
    uint8_t *bytes;
    size_t size;
} packed_t;

static void append(void *to, const uint8_t *bytes, size_t size)
{
    packed_t *packed = to;

    packed->bytes = realloc(packed->bytes, packed->size + size);
    FUZZ_CHECK(packed->bytes != NULL);
    memcpy(packed->bytes + packed->size, bytes, size);
    packed->size += size;
}

static void pack(packed_t *packed, const uint8_t *data, size_t size)
{
    deflate_t *stream = deflate_begin(append, packed);
    const size_t first = size / 3;

    deflate_put(stream, data, first);
    deflate_put(stream, data + first, size - first);
    deflate_end(stream);
}

void fuzz_deflate(const uint8_t *data, size_t size)
{
    /* The first two bytes say how much shall come out. */
    const size_t wanted = size >= 2 ? bytes_get_le16(data) : 0;
    uint8_t *out = cli_alloc(MOST, 1);
    packed_t packed = {NULL, 0};
    size_t where;

    if (size < 2 || size > MOST) {
        free(out);
        return;
    }
    if (deflate_unpack(data + 2, size - 2, out, wanted, &where) != NULL) {
        FUZZ_CHECK(where <= size - 2);
    }
    pack(&packed, data, size);
    FUZZ_CHECK(deflate_unpack(packed.bytes, packed.size, out, size, &where) ==
               NULL);
    FUZZ_CHECK(memcmp(out, data, size) == 0);
    free(packed.bytes);
    free(out);
}
