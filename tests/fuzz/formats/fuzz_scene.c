/* fuzz_scene.c - the text of a scene, and files that it may name */
/* SPDX-License-Identifier: MIT */

#include "fuzz/fuzz.h"

void fuzz_scene(const uint8_t *data, size_t size)
{
    fuzz_file("s.scene", data, size);
    fuzz_text("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\n"
                       "f 1 2 3\n");
    fuzz_text("m.mtl", "newmtl a\nKd 0.5 0.5 0.5\nnewmtl b\nKe 1 1 1\n");
    fuzz_file("s.pfm", "Pf 2 1 -1.0\n\0\0\200\77\0\0\0\77", 20);
    fuzz_text("t.txt", "dims 2\ncells 2 2\n1 2 3 4\n");
    fuzz_compile();
}
