/* image_file.c - which reader or writer a picture file wants */
/* SPDX-License-Identifier: MIT */

#include "lib/image/image_file.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "lib/files/kind.h"
#include "lib/image/png.h"
#include "lib/image/pnm.h"

image_kind_t image_kind(const char *path)
{
    const size_t n = strlen(path);
    const char *end = n > 4 ? path + n - 4 : "";

    return strcasecmp(end, ".png") == 0   ? IMAGE_PNG
           : strcasecmp(end, ".pfm") == 0 ? IMAGE_PFM
                                          : IMAGE_PPM;
}

const char *image_decode(
        image_t *image, const uint8_t *data, size_t size, size_t *where)
{
    const char *error = "expected a PPM (P6), PFM (PF) or PNG file";

    memset(image, 0, sizeof *image);
    *where = 0;
    if (size >= 2 &&
            (memcmp(data, "P6", 2) == 0 || memcmp(data, "PF", 2) == 0 ||
                    memcmp(data, "Pf", 2) == 0)) {
        error = pnm_decode(image, data, size, where);
    } else if (size >= 2 && memcmp(data, "\x89P", 2) == 0) {
        error = png_decode(image, data, size, where);
    }
    if (error != NULL) {
        image_free(image);
    }
    return error;
}

void image_read(image_t *image, const char *path)
{
    size_t size, where;
    uint8_t *data = cli_read(path, &size);
    const char *error = image_decode(image, data, size, &where);

    if (error != NULL) {
        kind_refuse(path, data, size, KIND_PICTURE);
        cli_fail(CLI_INPUT, "%s: byte %zu: %s", path, where, error);
    }
    free(data);
}

void image_begin(image_writer_t *writer, image_kind_t kind, uint32_t width,
        uint32_t height, cli_out_t *out)
{
    writer->kind = kind;
    writer->width = width;
    writer->height = height;
    writer->file = out->file;
    writer->png = NULL;
    if (kind == IMAGE_PNG) {
        writer->png = png_begin(width, height, out->file);
    } else {
        pnm_write_head(
                kind == IMAGE_PFM ? "PF" : "P6", width, height, out->file);
    }
}

uint32_t image_row_at(const image_writer_t *writer, uint32_t i)
{
    return writer->kind == IMAGE_PFM ? writer->height - 1 - i : i;
}

void image_row(image_writer_t *writer, const image_t *line)
{
    switch (writer->kind) {
    case IMAGE_PPM:
        pnm_write_bytes(line->bytes, writer->width, writer->file);
        break;
    case IMAGE_PFM:
        pnm_write_floats(line->floats, writer->width, writer->file);
        break;
    case IMAGE_PNG:
        png_row(writer->png, line->bytes);
        break;
    }
}

void image_end(image_writer_t *writer)
{
    if (writer->png != NULL) {
        png_end(writer->png);
    }
}

void image_write(const image_t *image, image_kind_t kind, cli_out_t *out)
{
    image_writer_t writer;
    image_t line = *image;

    image_begin(&writer, kind, image->width, image->height, out);
    for (uint32_t i = 0; i < image->height; i++) {
        const size_t at = 3 * (size_t)image->width * image_row_at(&writer, i);

        line.bytes = image->bytes != NULL ? image->bytes + at : NULL;
        line.floats = image->floats != NULL ? image->floats + at : NULL;
        image_row(&writer, &line);
    }
    image_end(&writer);
}
