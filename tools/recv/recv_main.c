/* recv_main.c - qlux-recv: a board's serial stream to a picture */
/* SPDX-License-Identifier: MIT */

#define _DEFAULT_SOURCE /* cfmakeraw, rates above 38400 */

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <termios.h>
#include <unistd.h>

#include "base/ql_crc.h"
#include "lib/files/kind.h"
#include "lib/image/image_file.h"
#include "lib/program/bytes.h"
#include "lib/program/options.h"
#include "lib/render/widen.h"
#include "lib/terminal/blocks.h"
#include "app/ql_stream.h"

typedef struct {
    const char *from, *to;
    uint32_t baud;
    bool partial, stats, show, quiet;
} options_t;

#define AT(field) OPTION_FIELD(options_t, field)

static const char *const pictures[] = {".ppm", ".png", NULL};

static const option_t options[] = {
        {"DEVICE-or-FILE", OPTION_TEXT, AT(from), .required = true,
                .help = "a serial device, a FIFO, a file, or - for stdin"},
        {"-o FILE", OPTION_FILE, AT(to), .words = pictures, .required = true,
                .help = ".ppm or .png; lines that did not arrive intact are "
                        "black"},
        {"--partial", OPTION_FLAG, AT(partial), .help = "they are grey"},
        {"--baud N", OPTION_NUMBER, AT(baud), .min = 1, .max = INT32_MAX,
                .help = "of a serial device"},
        {"--stats", OPTION_FLAG, AT(stats),
                .help = "print the board's counters as lines of \"key: "
                        "value\""},
        {"--show", OPTION_FLAG, AT(show),
                .help = "draw the picture in the terminal, in place of a bar"},
        {"--quiet", OPTION_FLAG, AT(quiet), .help = "no progress bar"},
        OPTION_END};

static const option_section_t sections[] = {{NULL, options}, {NULL, NULL}};

static const program_t program = {.name = "qlux-recv",
        .about = "receive a picture that a board sends, until its last frame",
        .usage = "DEVICE-or-FILE -o OUT.{ppm,png} [options]",
        .sections = sections,
        .notes = "Bytes between frames are skipped; text lines among them that "
                 "begin with \"qlux:\" are shown. A board sends what its "
                 "display shows, so there is no .pfm. Whatever arrived is "
                 "written, and the exit code is 0 if that is all of it: 2 if "
                 "lines or the last frame are missing, 3 after Ctrl-C. Lines "
                 "of two pictures in one stream are refused. Under QEMU's "
                 "-icount shift=0 one of the nanoseconds that --stats prints "
                 "is one instruction.",
        .exits = "2 if the picture is not whole",
        .example = "qlux-recv /dev/ttyACM0 -o picture.png --stats"};

/* Room for the longest frame twice, so that one is always whole in it. */
#define BUFFER_BYTES (2u * QL_STREAM_FRAME_BYTES(UINT16_MAX))

typedef struct {
    int fd;
    const char *path;
    bool ended;
    int error; /* why reading ended early: an errno, EINTR after Ctrl-C; or 0 */
    uint8_t bytes[BUFFER_BYTES];
    size_t begin, end; /* what is read and not yet used */
    char text[80];     /* a line among the skipped bytes */
    size_t text_size;
    uint64_t skipped; /* bytes that belong to no frame */
} input_t;

/* What is known of a line. A board that begins again with the same header sends
 * the same picture: good lines from before it count until one differs. */
enum { LINE_MISSING, LINE_BAD, LINE_OLD, LINE_GOOD };

#define GREY 128u /* of a line that is not there */

typedef struct {
    uint16_t width, height; /* 0 until the header arrives */
    ql_format_t format;
    uint8_t head[QL_STREAM_HEAD_BYTES];
    uint32_t spp, seed;
    size_t line_bytes;
    image_t image;           /* as bytes */
    uint8_t *lines;          /* LINE_ of each */
    uint32_t good;           /* lines, the old ones too */
    uint32_t old, confirmed; /* lines from before the header; come again */
    uint32_t duplicates, bad_frames;
    bool ended;
    uint32_t end[QL_STREAM_END_BYTES / 4];
} picture_t;

/* ---- the input ---------------------------------------------------------- */

static void set_up_tty(int fd, uint32_t baud)
{
    static const struct {
        uint32_t baud;
        speed_t code;
    } rates[] = {
            {9600, B9600},
            {19200, B19200},
            {38400, B38400},
            {57600, B57600},
            {115200, B115200},
            {230400, B230400},
#ifdef B460800
            {460800, B460800},
            {921600, B921600},
            {1000000, B1000000},
#endif
    };
    struct termios tty;

    for (size_t i = 0; i < sizeof rates / sizeof *rates; i++) {
        if (rates[i].baud == baud && tcgetattr(fd, &tty) == 0) {
            cfmakeraw(&tty);
            tty.c_cflag |= CLOCAL | CREAD;
            cfsetispeed(&tty, rates[i].code);
            cfsetospeed(&tty, rates[i].code);
            if (tcsetattr(fd, TCSANOW, &tty) == 0) {
                return;
            }
        }
    }
    options_fail("'--baud %lu': the device does not have this rate",
            (unsigned long)baud);
}

static const char *reason(int error)
{
    return error == EINTR ? "interrupted; nothing was written"
                          : strerror(error);
}

static void open_input(input_t *in, const char *path, uint32_t baud)
{
    memset(in, 0, sizeof *in);
    in->path = path;
    in->fd = strcmp(path, "-") == 0 ? 0 : open(path, O_RDONLY | O_NOCTTY);
    if (in->fd < 0) {
        cli_fail(CLI_IO, "%s: %s", path, reason(errno));
    }
    if (isatty(in->fd)) {
        set_up_tty(in->fd, baud);
    }
}

/* Wait for more bytes, at most half a second. False: none came. After Ctrl-C
 * only what came already is taken. */
static bool read_more(input_t *in)
{
    struct pollfd wait = {in->fd, POLLIN, 0};
    const bool stopped = cli_interrupted();
    ssize_t n;

    if (stopped) {
        in->error = EINTR;
        in->ended = true;
    }
    if (poll(&wait, 1, stopped ? 0 : 500) <= 0) {
        return false;
    }
    memmove(in->bytes, in->bytes + in->begin, in->end - in->begin);
    in->end -= in->begin;
    in->begin = 0;
    n = read(in->fd, in->bytes + in->end, BUFFER_BYTES - in->end);
    if (n < 0 && errno != EINTR && errno != EAGAIN) {
        in->error = errno;
    }
    in->ended = n == 0 || in->error != 0;
    in->end += n > 0 ? (size_t)n : 0;
    return n > 0;
}

/* Pass over bytes that are no frame, and show a board's own text in them. */
static void skip(input_t *in, size_t count)
{
    static const char mine[] = "qlux: ";

    in->skipped += count;
    for (; count > 0; count--) {
        const char c = (char)in->bytes[in->begin++];
        const bool fits = in->text_size + 1 < sizeof in->text;
        const bool starts =
                in->text_size >= sizeof mine - 1 || c == mine[in->text_size];
        if (c == '\n' && in->text_size > sizeof mine - 1) {
            in->text[in->text_size] = '\0';
            cli_below_progress();
            fprintf(stderr, "board: %s\n", in->text + sizeof mine - 1);
        }
        if (c >= ' ' && c <= '~' && fits && starts) {
            in->text[in->text_size++] = c;
        } else {
            in->text_size = 0;
        }
    }
}

/* ---- frames ------------------------------------------------------------- */

typedef enum { NO_FRAME, PART_OF_FRAME, BAD_FRAME, GOOD_FRAME } verdict_t;

/* Payload that a frame of this type has now; 0 if it makes no sense. */
static size_t payload_bytes(const picture_t *picture, uint8_t type)
{
    switch (type) {
    case QL_STREAM_HEAD:
        return QL_STREAM_HEAD_BYTES;
    case QL_STREAM_LINE:
        return picture->width == 0
                       ? 0
                       : QL_STREAM_LINE_PREFIX + picture->line_bytes;
    case QL_STREAM_END:
        return QL_STREAM_END_BYTES;
    default:
        return 0;
    }
}

static verdict_t judge(
        const picture_t *picture, const uint8_t *at, size_t left, size_t *size)
{
    if (at[0] != QL_STREAM_MARK0 || (left > 1 && at[1] != QL_STREAM_MARK1)) {
        return NO_FRAME;
    }
    if (left < QL_STREAM_PREFIX) {
        return PART_OF_FRAME;
    }
    *size = payload_bytes(picture, at[2]);
    if (*size == 0 || bytes_get_le16(at + 3) != *size) {
        return NO_FRAME;
    }
    if (left < QL_STREAM_FRAME_BYTES(*size)) {
        return PART_OF_FRAME;
    }
    return ql_crc32(0, at + 2, *size + 3) ==
                           bytes_get_le32(at + QL_STREAM_PREFIX + *size)
                   ? GOOD_FRAME
                   : BAD_FRAME;
}

/* Nothing comes any more, but what lies here looks like the start of a frame.
 * If a whole good one follows, it was not: skip to that. */
static void skip_to_whole_frame(input_t *in, const picture_t *picture)
{
    size_t size;

    for (size_t i = in->begin + 1; i < in->end; i++) {
        if (judge(picture, in->bytes + i, in->end - i, &size) == GOOD_FRAME) {
            skip(in, i - in->begin);
            return;
        }
    }
}

/* ---- the picture -------------------------------------------------------- */

static bool is_head(const uint8_t *payload)
{
    const uint16_t width = bytes_get_le16(payload),
                   height = bytes_get_le16(payload + 2);

    return width != 0 && width <= QL_IMAGE_MAX && height != 0 &&
           height <= QL_IMAGE_MAX && payload[4] < QL_FORMAT_COUNT;
}

static void begin_picture(picture_t *picture, const uint8_t *payload)
{
    if (picture->good > 0) {
        cli_warn("another header: %lu of %u lines before it are left out",
                (unsigned long)picture->good, picture->height);
    }
    image_free(&picture->image);
    free(picture->lines);
    memset(picture, 0, sizeof *picture);
    memcpy(picture->head, payload, sizeof picture->head);
    picture->width = bytes_get_le16(payload);
    picture->height = bytes_get_le16(payload + 2);
    picture->format = (ql_format_t)payload[4];
    picture->spp = bytes_get_le32(payload + 8);
    picture->seed = bytes_get_le32(payload + 12);
    picture->line_bytes = QL_LINE_BYTES(picture->width, picture->format);
    image_new_bytes(&picture->image, picture->width, picture->height);
    picture->lines = cli_alloc(picture->height, 1);
}

static void take_head(picture_t *picture, const uint8_t *payload)
{
    if (!is_head(payload) && picture->height == 0) {
        cli_fail(CLI_INPUT,
                "header: %u x %u pixels of format %u: expected sides of 1 to "
                "%u and a format below %u",
                bytes_get_le16(payload), bytes_get_le16(payload + 2),
                payload[4], QL_IMAGE_MAX, QL_FORMAT_COUNT);
    }
    if (!is_head(payload)) {
        picture->bad_frames++;
    } else if (memcmp(payload, picture->head, sizeof picture->head) != 0) {
        begin_picture(picture, payload);
    } else {
        for (unsigned y = 0; y < picture->height; y++) {
            if (picture->lines[y] == LINE_GOOD) {
                picture->lines[y] = LINE_OLD;
            }
        }
        picture->old = picture->good;
        picture->confirmed = 0;
    }
}

/* The lines from before a header are of another picture: nothing is theirs. */
static void drop_old_lines(picture_t *picture)
{
    const size_t bytes = 3 * (size_t)picture->width;
    uint32_t dropped = 0;

    for (unsigned y = 0; y < picture->height; y++) {
        if (picture->lines[y] == LINE_OLD) {
            picture->lines[y] = LINE_MISSING;
            memset(picture->image.bytes + bytes * y, 0, bytes);
            dropped++;
        }
    }
    picture->good -= dropped;
    picture->old = 0;
    if (dropped > 0) {
        cli_warn("another header: %lu of %u lines before it are left out",
                (unsigned long)dropped, picture->height);
    }
}

static void take_line(picture_t *picture, const uint8_t *payload)
{
    const uint16_t y = bytes_get_le16(payload);
    const size_t bytes = 3 * (size_t)picture->width;
    uint8_t *row, *fresh;
    bool same;

    if (y >= picture->height) {
        picture->bad_frames++;
        return;
    }
    row = picture->image.bytes + bytes * y;
    fresh = cli_alloc(bytes, 1);
    widen_line(fresh, payload + QL_STREAM_LINE_PREFIX, picture->format,
            picture->width);
    same = memcmp(fresh, row, bytes) == 0;
    if (picture->lines[y] == LINE_OLD && !same && picture->confirmed == 0) {
        drop_old_lines(picture);
    }
    if (picture->lines[y] >= LINE_OLD && !same) {
        cli_fail(CLI_INPUT,
                "line %u came twice and differs: the stream has lines of two "
                "pictures; nothing was written",
                y);
    }
    memcpy(row, fresh, bytes);
    free(fresh);
    picture->confirmed += picture->lines[y] == LINE_OLD;
    picture->duplicates += picture->lines[y] >= LINE_OLD;
    picture->good += picture->lines[y] < LINE_OLD;
    picture->lines[y] = LINE_GOOD;
}

static void take_frame(picture_t *picture, const uint8_t *frame)
{
    const uint8_t *payload = frame + QL_STREAM_PREFIX;

    switch (frame[2]) {
    case QL_STREAM_HEAD:
        take_head(picture, payload);
        break;
    case QL_STREAM_LINE:
        take_line(picture, payload);
        break;
    default:
        picture->ended = true;
        for (unsigned i = 0; i < QL_STREAM_END_BYTES / 4; i++) {
            picture->end[i] = bytes_get_le32(payload + 4 * i);
        }
    }
}

/* A frame whose CRC is wrong: its line number may be wrong too, but helps. */
static void note_bad_frame(picture_t *picture, const uint8_t *frame)
{
    const uint16_t y = bytes_get_le16(frame + QL_STREAM_PREFIX);

    picture->bad_frames++;
    if (frame[2] == QL_STREAM_LINE && y < picture->height &&
            picture->lines[y] == LINE_MISSING) {
        picture->lines[y] = LINE_BAD;
    }
}

/* ---- on the terminal ---------------------------------------------------- */

#define SHOW_S 0.25 /* between two drawings */

static void show(const picture_t *picture, blocks_t *blocks)
{
    const size_t bytes = 3 * (size_t)picture->width;

    if (blocks->width != picture->width || blocks->height != picture->height) {
        blocks_free(blocks);
        blocks_begin(blocks, picture->width, picture->height);
    }
    for (uint32_t y = 0; y < picture->height; y++) {
        blocks_row(blocks, y, picture->image.bytes + bytes * y);
    }
    blocks_draw(blocks, stderr);
}

/* A bar or the picture itself, while lines come. */
static void report_progress(
        const picture_t *picture, const options_t *o, blocks_t *blocks)
{
    static double shown;
    const double now = cli_seconds();

    if (!o->show) {
        cli_progress("receiving", picture->good, picture->height, o->quiet);
    } else if (picture->good > 0 && now - shown >= SHOW_S) {
        show(picture, blocks);
        shown = now;
    }
}

/* ---- all of it ---------------------------------------------------------- */

static void receive(
        input_t *in, picture_t *picture, const options_t *o, blocks_t *blocks)
{
    while (!picture->ended) {
        verdict_t verdict = PART_OF_FRAME;
        size_t size = 0;

        if (in->begin < in->end) {
            verdict = judge(
                    picture, in->bytes + in->begin, in->end - in->begin, &size);
        } else if (in->ended) {
            return;
        }
        if (verdict == PART_OF_FRAME && !in->ended) {
            if (!read_more(in) && !in->ended) {
                skip_to_whole_frame(in, picture);
            }
        } else if (verdict == GOOD_FRAME) {
            take_frame(picture, in->bytes + in->begin);
            in->begin += QL_STREAM_FRAME_BYTES(size);
            if (!picture->ended) { /* the last line has ended the bar */
                report_progress(picture, o, blocks);
            }
        } else {
            if (verdict == BAD_FRAME) {
                note_bad_frame(picture, in->bytes + in->begin);
            }
            skip(in, 1);
        }
    }
}

/* ---- what comes of it --------------------------------------------------- */

/* "lines 3, 17-20 missing", on stderr. */
static void list_lines(const picture_t *picture, int state, const char *what)
{
    const char *separator = "lines ";

    for (unsigned y = 0; y < picture->height; y++) {
        const unsigned first = y;
        if (picture->lines[y] != state) {
            continue;
        }
        while (y + 1 < picture->height && picture->lines[y + 1] == state) {
            y++;
        }
        cli_below_progress();
        fprintf(stderr, "%s%u", separator, first);
        if (y > first) {
            fprintf(stderr, "-%u", y);
        }
        separator = ", ";
    }
    if (separator[0] == ',') {
        fprintf(stderr, " %s\n", what);
    }
}

/* The board counts its paths, unless it has no counters. A pixel has spp of
 * them at most: a camera ray that passes the scene by begins none. */
static void check_paths(const picture_t *picture, const char *path)
{
    const uint32_t paths = picture->end[1];
    /* < 2^53; the board's counter goes round at 2^32 */
    const uint64_t all =
            (uint64_t)picture->width * picture->height * picture->spp;

    if (picture->ended && paths > all) {
        cli_fail(CLI_INPUT,
                "%s: the last frame counts %lu paths, but %u x %u pixels of "
                "%lu samples have %llu at most: the stream has parts of two "
                "pictures; "
                "nothing was written",
                path, (unsigned long)paths, picture->width, picture->height,
                (unsigned long)picture->spp, (unsigned long long)all);
    }
}

/* Refuse what is no picture, or not one. */
static void check_picture(picture_t *picture, const input_t *in)
{
    const int32_t status = ql_i32(picture->end[0]);

    if (picture->old > 0 && picture->confirmed == 0) {
        drop_old_lines(picture);
    }
    if (picture->height > 0) {
        check_paths(picture, in->path);
    }
    if (picture->good > 0) {
        return;
    }
    if (in->error != 0) {
        cli_fail(CLI_IO, "%s: %s", in->path, reason(in->error));
    }
    if (picture->ended && status != QL_OK) {
        cli_fail(CLI_INPUT, "%s: the board stopped with status %ld: %s",
                in->path, (long)status, ql_status_text((ql_status_t)status));
    }
    if (picture->height == 0) {
        kind_refuse_file(in->path, KIND_STREAM);
        cli_fail(CLI_INPUT, "%s: no picture header found", in->path);
    }
    cli_fail(CLI_INPUT, "%s: none of %u lines arrived; nothing was written",
            in->path, picture->height);
}

/* Say what is missing of a picture that was written; return if nothing is. */
static void report_gaps(const picture_t *picture, const input_t *in)
{
    const int32_t status = ql_i32(picture->end[0]);

    list_lines(picture, LINE_BAD, "have a wrong CRC");
    list_lines(picture, LINE_MISSING, "are missing");
    if (picture->ended && status != QL_OK) {
        cli_fail(CLI_INPUT, "%s: the board stopped with status %ld: %s",
                in->path, (long)status, ql_status_text((ql_status_t)status));
    }
    if (in->error != 0) {
        cli_fail(CLI_IO, "%s: %s; %lu of %u lines were written", in->path,
                in->error == EINTR ? "interrupted" : strerror(in->error),
                (unsigned long)picture->good, picture->height);
    }
    if (picture->good < picture->height) {
        cli_fail(CLI_INPUT, "%s: %lu of %u lines arrived", in->path,
                (unsigned long)picture->good, picture->height);
    }
    if (!picture->ended) {
        cli_fail(CLI_INPUT, "%s: ends without the end frame", in->path);
    }
}

static void print_stats(const picture_t *picture, const input_t *in)
{
    static const char *const keys[QL_STREAM_END_BYTES / 4] = {"status", "paths",
            "closest-rays", "shadow-rays", "saturated", "ticks", "tick-hz",
            "faint"};
    const uint32_t ticks = picture->end[5], hz = picture->end[6];

    printf("width: %u\nheight: %u\nspp: %lu\nseed: %lu\n", picture->width,
            picture->height, (unsigned long)picture->spp,
            (unsigned long)picture->seed);
    for (unsigned i = 0; i < QL_STREAM_END_BYTES / 4; i++) {
        printf("%s: %lu\n", keys[i], (unsigned long)picture->end[i]);
    }
    /* ticks < 2^32 and 10^9 < 2^30, so the product is < 2^62. */
    printf("nanoseconds: %llu\n", hz == 0 ? 0ull : ticks * 1000000000ull / hz);
    printf("duplicate-lines: %lu\nbad-frames: %lu\nskipped-bytes: %llu\n",
            (unsigned long)picture->duplicates,
            (unsigned long)picture->bad_frames,
            (unsigned long long)in->skipped);
}

static void make_gaps_grey(picture_t *picture)
{
    const size_t bytes = 3 * (size_t)picture->width;

    for (unsigned y = 0; y < picture->height; y++) {
        if (picture->lines[y] < LINE_OLD) {
            memset(picture->image.bytes + bytes * y, GREY, bytes);
        }
    }
}

/* Receive into an output that is open, so that what cannot be written is known
 * before a board has sent for hours. */
static void run(input_t *in, picture_t *picture, const options_t *o)
{
    blocks_t blocks = {0};
    cli_out_t out;

    cli_out_open(&out, o->to);
    cli_hold_signals();
    open_input(in, o->from, o->baud);
    receive(in, picture, o, &blocks);
    (void)cli_release_signals(); /* one that came is in->error, or too late */
    check_picture(picture, in);
    if (o->partial) {
        make_gaps_grey(picture);
    }
    if (o->show) {
        show(picture, &blocks);
        blocks_free(&blocks);
    }
    image_write(&picture->image, image_kind(o->to), &out);
    cli_out_commit(&out);
    if (o->stats) {
        print_stats(picture, in);
    }
    report_gaps(picture, in);
    image_free(&picture->image);
    free(picture->lines);
}

int main(int argc, char **argv)
{
    static input_t in;
    static picture_t picture;
    options_t o = {.baud = 115200};

    options_parse(&program, argc, argv, &o);
    run(&in, &picture, &o);
    return CLI_DONE;
}
