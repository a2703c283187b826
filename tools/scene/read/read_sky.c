/* read_sky.c - maps of the sky from PFM files */
/* SPDX-License-Identifier: MIT */

#include "scene/read/read_sky.h"

#include "lib/program/cli.h"
#include "lib/image/image_file.h"

#define SIDE_MAX 4096

static void check_radiance(const image_t *image, const char *path)
{
    const size_t n = 3 * (size_t)image->width * image->height;
    bool any = false;

    for (size_t i = 0; i < n; i++) {
        const float x = image->floats[i];

        /* so that a NaN fails too */
        if (!(x >= 0 && (double)x <= SKY_RADIANCE_MAX)) {
            cli_fail(CLI_INPUT,
                    "%s: pixel %zu of row %zu from the top: expected a "
                    "radiance from 0 to %g, found %g",
                    path, i / 3 % image->width, i / 3 / image->width,
                    SKY_RADIANCE_MAX, (double)x);
        }
        any = any || x > 0;
    }
    if (!any) {
        cli_fail(CLI_INPUT, "%s: expected a radiance above 0 somewhere", path);
    }
}

void read_sky(world_sky_t *sky, const char *path)
{
    image_t image;

    image_read(&image, path);
    if (image.floats == NULL) {
        cli_fail(CLI_INPUT, "%s: byte 0: expected a PFM file (PF or Pf)", path);
    }
    if (image.width > SIDE_MAX || image.height > SIDE_MAX) {
        cli_fail(CLI_INPUT,
                "%s: expected at most %d by %d pixels, found %lu "
                "by %lu",
                path, SIDE_MAX, SIDE_MAX, (unsigned long)image.width,
                (unsigned long)image.height);
    }
    check_radiance(&image, path);
    sky->width = image.width;
    sky->height = image.height;
    sky->map = image.floats;
}
