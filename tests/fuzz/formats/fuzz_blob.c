/* fuzz_blob.c - a scene's blob, its CRC mended: opened, drawn, dumped */
/* SPDX-License-Identifier: MIT */

#include <stdlib.h>
#include <string.h>

#include "base/ql_crc.h"
#include "blob/ql_blob_open.h"
#include "fuzz/fuzz.h"
#include "lib/program/bytes.h"
#include "lib/program/cli.h"
#include "scene/blob/dump_blob.h"
#include "scene/blob/parse_dump.h"
#include "scene/blob/read_blob.h"
#include "scene/blob/write_blob.h"
#include "scene/scene_features.h"
#include "scene/scene_info.h"

/* Whatever a program can read, it can show, and its text is the same blob. */
static void show(const uint8_t *blob, size_t size)
{
    model_t model, again;
    uint8_t *shown, *made;
    text_t text;
    size_t n;

    fuzz_file("s.qlb", blob, size);
    read_blob(&model, "s.qlb");
    print_info(fuzz_open(), &model);
    free(fuzz_close(&n));
    write_features(fuzz_open(), &model);
    free(fuzz_close(&n));
    dump_blob(fuzz_open(), &model);
    shown = fuzz_close(&n);
    fuzz_file("s.txt", shown, n);
    text_open(&text, "s.txt", KIND_SCENE);
    FUZZ_CHECK(is_dump(&text));
    parse_dump(&again, &text);
    text_close(&text);
    made = write_blob(&again, &n);
    FUZZ_CHECK(n == size && memcmp(made, blob, size) == 0);
    free(made);
    free(shown);
    model_free(&again);
    model_free(&model);
}

void fuzz_blob(const uint8_t *data, size_t size)
{
    uint8_t *blob = cli_alloc(size / 4 + 1, 4);
    ql_scene_t scene;

    if (size > 0) {
        memcpy(blob, data, size);
    }
    if (size >= QL_BLOB_CRC_FROM) {
        const uint32_t bytes = bytes_get_le32(blob + 8);

        if (bytes >= QL_BLOB_CRC_FROM && bytes <= size) {
            bytes_put_le32(blob + 12, ql_crc32(0, blob + QL_BLOB_CRC_FROM,
                                              bytes - QL_BLOB_CRC_FROM));
        }
    }
    if (ql_blob_open(&scene, blob, size) == QL_OK) {
        fuzz_draw(&scene);
        show(blob, size);
    }
    free(blob);
}
