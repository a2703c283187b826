/* fuzz_table.c - a tabulated distribution */
/* SPDX-License-Identifier: MIT */

#include "fuzz/fuzz.h"

void fuzz_table(const uint8_t *data, size_t size)
{
    fuzz_text("s.scene", "mesh m.obj\ntable t.txt\n"
                         "camera eye 0 0 3 look 0 0 0 fov 60\nimage 3 2\n");
    fuzz_text("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    fuzz_file("t.txt", data, size);
    fuzz_compile();
}
