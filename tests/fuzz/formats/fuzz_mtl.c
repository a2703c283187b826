/* fuzz_mtl.c - a library of materials, whose every kind is on a face */
/* SPDX-License-Identifier: MIT */

#include "fuzz/fuzz.h"

void fuzz_mtl(const uint8_t *data, size_t size)
{
    fuzz_text("s.scene", "mesh m.obj\n"
                         "sphere 0.2 0.2 0.3 radius 0.1 material b\n"
                         "camera eye 0 0 3 look 0 0 0 fov 60\nimage 3 2\n");
    fuzz_text("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                       "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 4\n"
                       "usemtl c #1\nf 1 3 4\nusemtl\nf 2 3 4\n");
    fuzz_file("m.mtl", data, size);
    fuzz_compile();
}
