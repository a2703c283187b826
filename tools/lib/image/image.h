/* image.h - read and write pictures: PPM, PFM and PNG */
/* SPDX-License-Identifier: MIT */

#ifndef IMAGE_H
#define IMAGE_H

#include "lib/program/cli.h"

#define IMAGE_SIDE_MAX   65535u
#define IMAGE_PIXELS_MAX (1u << 28)

/* A picture, rows from the top, RGB. Exactly one of bytes and floats is set:
 * bytes are display values (PPM, PNG), floats are linear radiance (PFM). */
typedef struct {
    uint32_t width; /* px, 1..IMAGE_SIDE_MAX */
    uint32_t height;
    uint8_t *bytes; /* 3 * width * height */
    float *floats;
} image_t;

typedef enum { IMAGE_PPM, IMAGE_PFM, IMAGE_PNG } image_kind_t;

/* What kind of file a name asks for, by its extension in either case;
 * cli_fail(CLI_USAGE) if none. option names the option it came from. */
image_kind_t image_kind(const char *option, const char *path);

/* A black picture. Ends in cli_fail(CLI_IO) if there is no memory. */
void image_new(image_t *image, uint32_t width, uint32_t height, bool floats);
void image_free(image_t *image);

/* Decode a file's bytes, the kind told by how they begin.
 *
 *   image   -      out: to be freed if this succeeds, zero if it fails
 *   data    -      size bytes; any content is safe
 *   where   bytes  out: offset of what is wrong
 *   return  NULL, or what was expected there
 *
 * PPM: P6 of maximum 255. PFM: PF or Pf, both byte orders; the size of the
 * scale is ignored. PNG: 8 bits, RGB or gray, not interlaced.
 */
const char *image_decode(
        image_t *image, const uint8_t *data, size_t size, size_t *where);

/* Read a file; cli_fail(CLI_IO) or cli_fail(CLI_INPUT) with the byte offset. */
void image_read(image_t *image, const char *path);

/* Write into an open file; errors show when the file is committed. PFM wants
 * floats, the others bytes. */
void image_write(const image_t *image, image_kind_t kind, cli_out_t *out);

#endif
