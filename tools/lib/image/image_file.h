/* image_file.h - read and write picture files: PPM, PFM and PNG */
/* SPDX-License-Identifier: MIT */

#ifndef IMAGE_FILE_H
#define IMAGE_FILE_H

#include "lib/image/image.h"
#include "lib/image/png.h"
#include "lib/program/cli.h"

typedef enum { IMAGE_PPM, IMAGE_PFM, IMAGE_PNG } image_kind_t;

/* What kind of file a name asks for, by its extension in either case; a PPM if
 * by none, but options refuse such names (OPTION_FILE). */
image_kind_t image_kind(const char *path);

/* Decode a file's bytes, the kind told by how they begin.
 *
 *   image   -      out: to be freed if this succeeds, zero if it fails
 *   data    -      size bytes; any content is safe
 *   where   bytes  out: offset of what is wrong
 *   return  NULL, or what was expected there
 *
 * PPM and PFM: as pnm_decode() says. PNG: as png_decode() says.
 */
const char *image_decode(
        image_t *image, const uint8_t *data, size_t size, size_t *where);

/* Read a file; cli_fail(CLI_IO) or cli_fail(CLI_INPUT) with the byte offset. */
void image_read(image_t *image, const char *path);

/* Write into an open file; errors show when the file is committed. PFM wants
 * floats, the others bytes. */
void image_write(const image_t *image, image_kind_t kind, cli_out_t *out);

/* The same a row at a time: a picture may be larger than memory. */
typedef struct {
    image_kind_t kind;
    uint32_t width;
    uint32_t height;
    FILE *file;
    png_writer_t *png; /* or NULL */
} image_writer_t;

void image_begin(image_writer_t *writer, image_kind_t kind, uint32_t width,
        uint32_t height, cli_out_t *out);

/* Which row, from the top, is to be written as the i-th. */
uint32_t image_row_at(const image_writer_t *writer, uint32_t i);

/* Write it: the first row of floats or bytes of line. */
void image_row(image_writer_t *writer, const image_t *line);

/* After all rows. */
void image_end(image_writer_t *writer);

#endif
