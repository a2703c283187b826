/* image.h - a picture in memory: bytes of a display, or floats of light */
/* SPDX-License-Identifier: MIT */

#ifndef IMAGE_H
#define IMAGE_H

#include <stdint.h>

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

/* A black picture. Ends in cli_fail(CLI_IO) if there is no memory. */
void image_new_bytes(image_t *image, uint32_t width, uint32_t height);
void image_new_floats(image_t *image, uint32_t width, uint32_t height);
void image_free(image_t *image);

#endif
