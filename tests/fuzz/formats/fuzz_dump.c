/* fuzz_dump.c - the text of a blob: parsed, written, opened, drawn */
/* SPDX-License-Identifier: MIT */

#include <stdlib.h>

#include "fuzz/fuzz.h"
#include "lib/render/open_blob.h"
#include "scene/blob/parse_dump.h"
#include "scene/blob/write_blob.h"

void fuzz_dump(const uint8_t *data, size_t size)
{
    ql_scene_t scene;
    model_t model;
    uint8_t *blob;
    text_t text;
    size_t bytes;

    fuzz_file("s.txt", data, size);
    text_open(&text, "s.txt", KIND_SCENE);
    if (is_dump(&text)) {
        parse_dump(&model, &text);
        blob = write_blob(&model, &bytes);
        open_blob_bytes(&scene, blob, bytes, "s.txt");
        fuzz_draw(&scene);
        free(blob);
        model_free(&model);
    }
    text_close(&text);
}
