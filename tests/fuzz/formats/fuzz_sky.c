/* fuzz_sky.c - the map of a sky, PFM or Radiance */
/* SPDX-License-Identifier: MIT */

#include "fuzz/fuzz.h"

void fuzz_sky(const uint8_t *data, size_t size)
{
    fuzz_text("s.scene", "mesh m.obj\nsky s.hdr rotate 30\n"
                         "camera eye 0 0 3 look 0 0 0 fov 60\nimage 3 2\n");
    fuzz_text("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    fuzz_file("s.hdr", data, size);
    fuzz_compile();
}
