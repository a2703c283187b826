/* fuzz_image.c - pictures: PPM, PFM, PNG with its CRCs mended, written again */
/* SPDX-License-Identifier: MIT */

#include <stdlib.h>
#include <string.h>

#include "base/ql_crc.h"
#include "fuzz/fuzz.h"
#include "lib/image/image_file.h"
#include "lib/program/bytes.h"

/* Every chunk's CRC-32, as far as there are chunks. */
static void mend(uint8_t *data, size_t size)
{
    size_t at = 8;

    while (size >= 12 && at <= size - 12) {
        const uint32_t n = bytes_get_be32(data + at);

        if (n > size - at - 12) {
            return;
        }
        bytes_put_be32(data + at + 8 + n, ql_crc32(0, data + at + 4, n + 4u));
        at += n + 12u;
    }
}

/* What was read is read again from what is written of it. */
static void write_again(const image_t *image, image_kind_t kind)
{
    const size_t pixels = (size_t)image->width * image->height;
    cli_out_t out = {.file = fuzz_open()};
    image_t again;
    uint8_t *file;
    size_t size, where;

    image_write(image, kind, &out);
    file = fuzz_close(&size);
    FUZZ_CHECK(image_decode(&again, file, size, &where) == NULL);
    FUZZ_CHECK(image->bytes == NULL ||
               memcmp(image->bytes, again.bytes, 3 * pixels) == 0);
    FUZZ_CHECK(
            image->floats == NULL || memcmp(image->floats, again.floats,
                                             3 * pixels * sizeof(float)) == 0);
    image_free(&again);
    free(file);
}

void fuzz_image(const uint8_t *data, size_t size)
{
    uint8_t *copy = cli_alloc(size, 1);
    image_t image;
    size_t where;

    if (size > 0) {
        memcpy(copy, data, size);
    }
    if (size > 0 && copy[0] == 0x89) {
        mend(copy, size);
    }
    if (image_decode(&image, copy, size, &where) == NULL) {
        if (image.floats != NULL) {
            write_again(&image, IMAGE_PFM);
        } else {
            write_again(&image, IMAGE_PPM);
            write_again(&image, IMAGE_PNG);
        }
        image_free(&image);
    } else {
        FUZZ_CHECK(where <= size);
    }
    free(copy);
}
