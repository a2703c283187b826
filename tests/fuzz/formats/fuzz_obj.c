/* fuzz_obj.c - a mesh: read, compiled, opened, drawn */
/* SPDX-License-Identifier: MIT */

#include "fuzz/fuzz.h"

void fuzz_obj(const uint8_t *data, size_t size)
{
    fuzz_text("s.scene", "mesh m.obj\nsky 1 1 1\nsmooth 40\n"
                         "camera eye 0 0 3 look 0 0 0 fov 60\nimage 3 2\n");
    fuzz_text("m.mtl", "newmtl a\nKd 0.5 0.5 0.5\nnewmtl b\nKe 1 1 1\n");
    fuzz_file("m.obj", data, size);
    fuzz_compile();
    fuzz_compile_bare(size % 2 != 0);
}
