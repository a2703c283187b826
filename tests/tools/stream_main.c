/* stream_main.c - write a serial picture stream, whole or damaged */
/* SPDX-License-Identifier: MIT */

/* usage: stream FORMAT WIDTH HEIGHT [status N] [flip BYTE] [cut BYTE]
 *               [drop LINE] [twice LINE] [noise] [ticks N] [hz N] [beyond Y]
 *               [shade N] [seed N] [paths N] > stream
 * The picture is red = x, green = y, blue = x ^ y in RGB888; in other formats
 * byte i of line y is 16 y + i; shade adds N to each. The paths are those of
 * its pixels unless told. flip inverts a byte of the stream, cut ends it before
 * one, noise puts half frames and false marks between frames, beyond sends a
 * line of a number that the picture does not have. */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "app/ql_stream.h"

static uint8_t stream[1 << 20];
static size_t stream_size;
static unsigned shade;

static void append(const uint8_t *bytes, size_t size)
{
    memcpy(stream + stream_size, bytes, size);
    stream_size += size;
}

/* The start of a line's frame, a mark, and text that is not for people. */
static void append_noise(const uint8_t *frame)
{
    append(frame, 6);
    append((const uint8_t *)"\xa5\xa5\x5a"
                            "E\nnoise\n",
            11);
}

static void append_line(
        uint8_t *frame, ql_format_t format, uint16_t width, uint16_t y)
{
    const uint16_t size = (uint16_t)QL_LINE_BYTES(width, format);

    for (unsigned i = 0; i < size; i++) {
        const unsigned x = i / 3;
        const unsigned rgb[3] = {x, y, x ^ y};
        frame[QL_STREAM_PIXELS + i] =
                (uint8_t)(shade + (format == QL_FORMAT_RGB888 ? rgb[i % 3]
                                                              : 16u * y + i));
    }
    append(frame, ql_stream_line(frame, y, size));
}

int main(int argc, char **argv)
{
    static uint8_t frame[QL_STREAM_FRAME_BYTES(UINT16_MAX)];
    ql_settings_t settings = QL_SETTINGS_DEFAULT;
    ql_stream_end_t end = {QL_OK, {0, 6, 5, 4, 3}, 3000, 1000000};
    uint32_t paths = 0;
    long flip = -1, cut = -1, drop = -1, twice = -1, beyond = -1;
    bool noise = false;
    ql_format_t format;

    if (argc < 4) {
        return 1;
    }
    format = (ql_format_t)atoi(argv[1]);
    settings.width = (uint16_t)atoi(argv[2]);
    settings.height = (uint16_t)atoi(argv[3]);
    for (int i = 4; i < argc; i++) {
        const long n = i + 1 < argc ? atol(argv[i + 1]) : 0;
        flip = strcmp(argv[i], "flip") == 0 ? n : flip;
        cut = strcmp(argv[i], "cut") == 0 ? n : cut;
        drop = strcmp(argv[i], "drop") == 0 ? n : drop;
        twice = strcmp(argv[i], "twice") == 0 ? n : twice;
        beyond = strcmp(argv[i], "beyond") == 0 ? n : beyond;
        noise = strcmp(argv[i], "noise") == 0 || noise;
        end.ticks = strcmp(argv[i], "ticks") == 0 ? (uint32_t)n : end.ticks;
        end.tick_hz = strcmp(argv[i], "hz") == 0 ? (uint32_t)n : end.tick_hz;
        shade = strcmp(argv[i], "shade") == 0 ? (unsigned)n : shade;
        paths = strcmp(argv[i], "paths") == 0 ? (uint32_t)n : paths;
        settings.seed =
                strcmp(argv[i], "seed") == 0 ? (uint32_t)n : settings.seed;
        end.status =
                strcmp(argv[i], "status") == 0 ? (ql_status_t)n : end.status;
    }

    end.diag.paths = paths != 0 ? paths
                                : (uint32_t)settings.width * settings.height *
                                          settings.spp;

    append(frame, ql_stream_head(frame, &settings, format));
    for (uint16_t y = 0; y < settings.height; y++) {
        if (y != drop) {
            append_line(frame, format, settings.width, y);
        }
        if (y == twice) {
            append_line(frame, format, settings.width, y);
        }
        if (noise) {
            append_noise(frame);
        }
    }
    if (beyond >= 0) {
        append_line(frame, format, settings.width, (uint16_t)beyond);
    }
    append(frame, ql_stream_end(frame, &end));

    if (cut >= 0 && (size_t)cut < stream_size) {
        stream_size = (size_t)cut;
    }
    if (flip >= 0 && (size_t)flip < stream_size) {
        stream[flip] = (uint8_t)~stream[flip];
    }
    return fwrite(stream, 1, stream_size, stdout) == stream_size ? 0 : 3;
}
