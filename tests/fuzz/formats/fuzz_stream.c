/* fuzz_stream.c - what a serial port brings, the CRCs of its frames mended */
/* SPDX-License-Identifier: MIT */

/* The receiver is one file, so it is taken whole, but for its main(). */
#define main recv_main
int recv_main(int argc, char **argv);
#include "recv/recv_main.c"
#undef main

#include "fuzz/fuzz.h"

/* The CRC of whatever looks like a frame. */
static void mend(uint8_t *data, size_t size)
{
    size_t at = 0;

    while (size >= QL_STREAM_PREFIX && at <= size - QL_STREAM_PREFIX) {
        const size_t n = bytes_get_le16(data + at + 3);

        if (data[at] != QL_STREAM_MARK0 || data[at + 1] != QL_STREAM_MARK1 ||
                QL_STREAM_FRAME_BYTES(n) > size - at) {
            at++;
            continue;
        }
        bytes_put_le32(data + at + QL_STREAM_PREFIX + n,
                ql_crc32(0, data + at + 2, n + 3));
        at += QL_STREAM_FRAME_BYTES(n);
    }
}

void fuzz_stream(const uint8_t *data, size_t size)
{
    static FILE *file;
    static char path[32];
    static input_t in;
    static picture_t picture;
    static const options_t o = {
            .from = path, .to = "picture.ppm", .partial = true, .quiet = true};
    uint8_t *copy = cli_alloc(size, 1);

    if (size > 0) {
        memcpy(copy, data, size);
    }
    mend(copy, size);
    if (file == NULL) {
        file = tmpfile();
        FUZZ_CHECK(file != NULL);
        snprintf(path, sizeof path, "/dev/fd/%d", fileno(file));
    }
    FUZZ_CHECK(ftruncate(fileno(file), 0) == 0 &&
               pwrite(fileno(file), copy, size, 0) == (ssize_t)size);
    free(copy);
    if (in.fd > 0) { /* that of the last input */
        (void)close(in.fd);
    }
    memset(&in, 0, sizeof in);
    memset(&picture, 0, sizeof picture);
    run(&in, &picture, &o);
}
