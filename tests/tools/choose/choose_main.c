/* choose_main.c - qlux-scene's choice alone, for any compiler: blob to blob */
/* SPDX-License-Identifier: MIT */

/* usage: choose BLOB > BLOB
 *
 * The blob is one of a scene, made with --direct area, so of one with a sky the
 * chances are those by power. */

#include <stdio.h>
#include <stdlib.h>

#include "lib/program/cli.h"
#include "scene/blob/read_blob.h"
#include "scene/blob/write_blob.h"
#include "scene/choose/choose.h"

int main(int argc, char **argv)
{
    model_t model;
    uint8_t *blob;
    size_t size;

    cli_begin("choose");
    if (argc != 2) {
        return CLI_USAGE;
    }
    read_blob(&model, argv[1]);
    choose_way(&model, argv[1], true);
    blob = write_blob(&model, &size);
    size -= fwrite(blob, 1, size, stdout);
    free(blob);
    model_free(&model);
    return size == 0 && fflush(stdout) == 0 ? CLI_DONE : CLI_IO;
}
