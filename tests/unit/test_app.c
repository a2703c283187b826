/* test_app.c - the boards' application loop over the simulator's HAL */
/* SPDX-License-Identifier: MIT */

/* Renders small pictures with ql_app_run() and looks
 * at what reached the panel and the serial port, then lets every HAL call fail
 * in turn. */

#include <stdlib.h>
#include <string.h>

#include "base/ql_crc.h"
#include "support/picture/box_scene.h"
#include "lib/program/cli.h"
#include "app/ql_app.h"
#include "sim/sim_fault.h"
#include "sim/sim_hal.h"

enum { WIDTH = 22, HEIGHT = 13, SPP = 2, PANEL_MAX = 64 };

/* A panel's format that is built in. */
#define PANEL_FORMAT                                                           \
    (QL_CFG_FORMATS & 16         ? QL_FORMAT_GRAY4                             \
            : QL_CFG_FORMATS & 4 ? QL_FORMAT_RGB565_BE                         \
                                 : QL_FORMAT_RGB888)

static struct {
    void *blob;
    size_t blob_size;
    int failures;
} test;

static bool check(bool ok, const char *claim)
{
    printf("%-20s %-52s %s\n", "unit/test_app", claim, ok ? "ok" : "FAIL");
    test.failures += !ok;
    return ok;
}

/* ---- A run ------------------------------------------------------------- */

typedef struct {
    uint16_t width; /* of the panel; 0: none */
    uint16_t height;
    ql_format_t format;
    uint8_t interlace;
    uint32_t stop_at;
    size_t work_short; /* bytes of working memory withheld */
} run_t;

/* Exactly the bytes asked for, so that ASan sees one too many. */
static ql_status_t run_app(const run_t *r)
{
    const size_t n =
            QL_WORK_BYTES(WIDTH, QL_CFG_PANEL ? r->width : 0, r->format);
    const size_t bytes = n > r->work_short ? n - r->work_short : 0;
    sim_hal_setup_t setup = {
            test.blob, test.blob_size, {r->width, r->height, r->format}, 0};
    ql_app_t app = {
            QL_SETTINGS_DEFAULT, r->interlace, NULL, bytes, SIM_HAL_TICK_HZ};
    ql_status_t status;

    setup.stop_at = r->stop_at;
    app.settings.width = WIDTH;
    app.settings.height = HEIGHT;
    app.settings.spp = SPP;
    app.work = cli_alloc(bytes, 1);
    sim_hal_begin(&setup);
    status = ql_app_run(&app);
    ql_hal_exit(status);
    free(app.work);
    return status;
}

/* ---- What arrived ------------------------------------------------------ */

typedef struct {
    uint8_t pixels[HEIGHT][3 * WIDTH];
    uint8_t lines[HEIGHT]; /* how often each came */
    uint32_t line_count;
    uint32_t heads;
    uint32_t ends;
    int32_t status; /* of the last end frame */
    uint32_t paths;
    uint32_t ticks;
    bool intact; /* nothing but good frames */
} picture_t;

static uint32_t le(const uint8_t *b, unsigned n)
{
    uint32_t v = 0;

    while (n-- > 0) {
        v = v << 8 | b[n];
    }
    return v;
}

static void take_frame(picture_t *p, const uint8_t *frame, size_t size)
{
    const uint8_t *payload = frame + QL_STREAM_PREFIX;
    const uint32_t y = le(payload, 2);

    if (frame[2] == QL_STREAM_HEAD && size == QL_STREAM_HEAD_BYTES) {
        p->heads++;
        p->intact = p->intact && y == WIDTH && le(payload + 2, 2) == HEIGHT &&
                    payload[4] == QL_FORMAT_RGB888 && le(payload + 8, 4) == SPP;
    } else if (frame[2] == QL_STREAM_LINE && size == 2 + 3 * WIDTH &&
               y < HEIGHT) {
        memcpy(p->pixels[y], payload + 2, 3 * WIDTH);
        p->lines[y]++;
        p->line_count++;
    } else if (frame[2] == QL_STREAM_END && size == QL_STREAM_END_BYTES) {
        p->ends++;
        p->status = ql_i32(le(payload, 4));
        p->paths = le(payload + 4, 4);
        p->ticks = le(payload + 20, 4);
    } else {
        p->intact = false;
    }
}

/* Read the stream as a strict receiver would. */
static void receive(picture_t *p)
{
    const sim_hal_result_t *r = sim_hal_result();
    size_t at = 0;

    memset(p, 0, sizeof *p);
    p->intact = true;
    while (p->intact && at < r->serial_size) {
        const uint8_t *frame = r->serial + at;
        const size_t left = r->serial_size - at;
        size_t size;
        p->intact = left >= QL_STREAM_FRAME_BYTES(0u) &&
                    frame[0] == QL_STREAM_MARK0 && frame[1] == QL_STREAM_MARK1;
        size = p->intact ? le(frame + 3, 2) : 0;
        p->intact = p->intact && left >= QL_STREAM_FRAME_BYTES(size) &&
                    le(frame + QL_STREAM_PREFIX + size, 4) ==
                            ql_crc32(0, frame + 2, 3 + size);
        if (p->intact) {
            take_frame(p, frame, size);
            at += QL_STREAM_FRAME_BYTES(size);
        }
    }
}

/* The picture as the core alone renders it, in any format. Returns its paths:
 * a camera outside the scene misses it in some. */
static uint32_t render_directly(uint8_t *lines, ql_format_t format)
{
    ql_settings_t settings = QL_SETTINGS_DEFAULT;
    ql_scene_t scene;
    ql_render_t render;

    settings.width = WIDTH;
    settings.height = HEIGHT;
    settings.spp = SPP;
    if (ql_blob_open(&scene, test.blob, test.blob_size) != QL_OK ||
            ql_render_init(&render, &scene, &settings) != QL_OK) {
        cli_fail(CLI_INPUT, "the scene does not open");
    }
    for (uint16_t y = 0; y < HEIGHT; y++) {
        const ql_output_t output = {
                format, lines + (size_t)y * QL_LINE_BYTES(WIDTH, format)};
        ql_render_line(&render, y, &output, 1);
    }
    return render.diag.paths;
}

/* Every line once, and equal to the core's. */
static bool complete(const picture_t *p)
{
    static uint8_t wanted[HEIGHT][3 * WIDTH];
    const uint32_t paths = render_directly(wanted[0], QL_FORMAT_RGB888);
    bool ok = p->intact && p->heads == 1 && p->ends == 1 &&
              p->status == QL_OK && p->paths == paths &&
              (paths > 0) == QL_CFG_DIAG;

    for (unsigned y = 0; y < HEIGHT; y++) {
        ok = ok && p->lines[y] == 1;
    }
    return ok && memcmp(p->pixels, wanted, sizeof wanted) == 0;
}

/* ---- Claims ------------------------------------------------------------ */

static void test_stream(void)
{
    static const uint8_t interlaces[] = {1, 2, 8, 128};
    const run_t plain = {0, 0, QL_FORMAT_RGB888, 1, 0, 0};
    picture_t p;
    bool ok = run_app(&plain) == QL_OK;

    receive(&p);
    check(ok && complete(&p), "the_stream_holds_the_core's_picture");
    /* the simulator's clock goes on by one with every question */
    check(p.ticks == HEIGHT, "the_time_is_that_of_every_line");
    check(sim_hal_result()->display_writes == 0,
            "a_board_without_panel_is_not_written_to");
    for (unsigned i = 0; i < sizeof interlaces; i++) {
        run_t r = plain;
        r.interlace = interlaces[i];
        ok = ok && run_app(&r) == QL_OK;
        receive(&p);
        ok = ok && complete(&p);
    }
    check(ok, "interlacing_changes_no_bit");
}

/* Panels smaller, equal and larger than the picture: where both are, the panel
 * shows the core's line of its format; elsewhere it is black. */
static bool panel_matches(const run_t *r)
{
    static uint8_t wanted[HEIGHT * 3 * WIDTH];
    const size_t from = QL_LINE_BYTES(WIDTH, r->format);
    const size_t to = QL_LINE_BYTES(r->width, r->format);
    const long left = r->width >= WIDTH ? (r->width - WIDTH) / 2 & ~1
                                        : -((WIDTH - r->width) / 2 & ~1);
    const long top = r->height >= HEIGHT ? (r->height - HEIGHT) / 2 & ~1
                                         : -((HEIGHT - r->height) / 2 & ~1);
    const long shift = left >= 0
                               ? (long)QL_LINE_BYTES((size_t)left, r->format)
                               : -(long)QL_LINE_BYTES((size_t)-left, r->format);
    const uint8_t *screen = sim_hal_result()->screen;

    (void)render_directly(wanted, r->format);
    for (long y = 0; y < r->height; y++) {
        for (long i = 0; i < (long)to; i++) {
            const long py = y - top, pi = i - shift;
            const bool inside =
                    py >= 0 && py < HEIGHT && pi >= 0 && pi < (long)from;
            const uint8_t want =
                    inside ? wanted[(size_t)py * from + (size_t)pi] : 0;
            if (screen[(size_t)y * to + (size_t)i] != want) {
                return false;
            }
        }
    }
    return true;
}

static void test_panel(void)
{
    static const uint16_t sizes[][2] = {{WIDTH, HEIGHT},
            {WIDTH + 8, HEIGHT + 6}, {WIDTH - 6, HEIGHT - 4}, {PANEL_MAX, 1},
            {2, PANEL_MAX}};
    bool equal = true, refused = true, same_stream = true;
    picture_t p;

    for (unsigned f = 0; f < QL_FORMAT_COUNT; f++) {
        for (unsigned i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
            const run_t r = {sizes[i][0], sizes[i][1], (ql_format_t)f,
                    (uint8_t)(1u << i), 0, 0};
            if (QL_CFG_PANEL && (QL_CFG_FORMATS >> f & 1) == 0) {
                refused = refused && run_app(&r) == QL_ERR_DISPLAY;
                continue;
            }
            equal = equal && run_app(&r) == QL_OK &&
                    sim_hal_result()->offence[0] == '\0' &&
                    (QL_CFG_PANEL ? panel_matches(&r)
                                  : sim_hal_result()->display_writes == 0);
            receive(&p);
            same_stream = same_stream && complete(&p);
        }
    }
    check(equal, QL_CFG_PANEL ? "every_panel_shows_the_core's_picture_centred"
                              : "a_panel_is_left_alone");
    check(refused, "a_panel_of_a_format_not_built_in_is_refused");
    check(same_stream, "a_panel_changes_no_bit_of_the_stream");
}

static void test_stop(void)
{
    bool ok = true, partial = true;
    picture_t p;

    for (uint32_t n = 1; n <= HEIGHT; n++) {
        const run_t r = {8, 8, PANEL_FORMAT, 4, n, 0};
        ok = ok && run_app(&r) == QL_ERR_STOPPED;
        receive(&p);
        ok = ok && p.intact && p.ends == 1 && p.status == QL_ERR_STOPPED;
        partial = partial && p.line_count == n - 1;
    }
    check(ok, "a_stop_ends_the_stream_and_says_so");
    check(partial, "a_stop_keeps_the_lines_before_it");
}

static void test_refusals(void)
{
    run_t r = {8, 8, PANEL_FORMAT, 1, 0, 0};
    uint8_t *bytes = test.blob;
    bool ok = true;
    picture_t p;

    for (r.work_short = 1; r.work_short < 256; r.work_short++) {
        ok = ok && run_app(&r) == QL_ERR_SETTINGS;
    }
    check(ok, "too_little_memory_is_refused");
    r.work_short = 0;
    r.interlace = 3;
    check(run_app(&r) == QL_ERR_SETTINGS, "an_interlace_of_3_is_refused");
    r.interlace = 0;
    check(run_app(&r) == QL_ERR_SETTINGS, "an_interlace_of_0_is_refused");
    r.interlace = 1;
    bytes[test.blob_size - 1] ^= 1;
    ok = run_app(&r) == QL_ERR_CHECKSUM;
    bytes[test.blob_size - 1] ^= 1;
    receive(&p);
    check(ok && p.ends == 1 && p.heads == 0 && p.status == QL_ERR_CHECKSUM,
            "a_damaged_blob_is_named_in_the_stream");
}

/* Put a feature into the blob that no build has, and mend its checksum. */
static void change_features(void)
{
    ql_blob_header_t *const h = test.blob;

    h->features ^= QL_LE32(0x80000000u);
    h->crc32 = QL_LE32(ql_crc32(0, (uint8_t *)test.blob + QL_BLOB_CRC_FROM,
            test.blob_size - QL_BLOB_CRC_FROM));
}

/* A line of text goes before the last frame, if the build has texts; wherever
 * the port fails, nothing but a part of it was sent. */
static void test_missing(void)
{
    static const char said[] = "qlux: this build lacks unknown\n";
    const size_t size = QL_CFG_DIAG ? sizeof said - 1 : 0;
    const run_t r = {8, 8, PANEL_FORMAT, 1, 0, 0};
    const sim_hal_result_t *const got = sim_hal_result();
    bool ok, parts = true;
    uint32_t calls;

    change_features();
    sim_fault_arm(0, SIM_FAULT_ONCE);
    ok = run_app(&r) == QL_ERR_FEATURE;
    calls = sim_fault_calls();
    ok = ok &&
         got->serial_size == size + QL_STREAM_FRAME_BYTES(QL_STREAM_END_BYTES);
    ok = ok && memcmp(got->serial, said, size) == 0 &&
         got->serial[size] == QL_STREAM_MARK0 &&
         got->serial[size + 2] == QL_STREAM_END &&
         ql_i32(le(got->serial + size + QL_STREAM_PREFIX, 4)) == QL_ERR_FEATURE;
    check(ok, "a_feature_that_is_missing_is_named_in_a_line");
    for (uint32_t at = 2; at <= calls; at++) { /* the first sets the HAL up */
        sim_fault_arm(at, SIM_FAULT_STAYS);
        parts = parts && run_app(&r) == QL_ERR_FEATURE &&
                got->serial_size <= size &&
                (got->serial_size == 0 ||
                        memcmp(got->serial, said, got->serial_size) == 0);
    }
    sim_fault_arm(0, SIM_FAULT_STAYS);
    check(parts && calls > QL_CFG_DIAG,
            "a_line_that_cannot_be_sent_ends_there");
    change_features();
}

/* One fault at every place where one can be. */
static void test_faults(sim_fault_t fault, const char *claim)
{
    const run_t r = {WIDTH, HEIGHT + 2, PANEL_FORMAT, 2, 0, 0};
    uint32_t calls, line_count = 0;
    bool ok = true;
    picture_t p;

    sim_fault_arm(0, fault);
    ok = run_app(&r) == QL_OK;
    calls = sim_fault_calls();
    for (uint32_t at = 1; at <= calls && ok; at++) {
        ql_status_t status;
        sim_fault_arm(at, fault);
        status = run_app(&r);
        receive(&p);
        ok = (status == QL_ERR_DISPLAY || status == QL_ERR_SERIAL) &&
             p.intact && p.line_count >= line_count &&
             sim_hal_result()->offence[0] == '\0' &&
             (p.ends == 0 || p.status == status);
        /* After a glitch the port works: the stream ends properly unless the
         * end itself was hit. */
        ok = ok && (fault == SIM_FAULT_STAYS || at == calls || p.ends == 1);
        line_count = p.line_count;
    }
    sim_fault_arm(0, fault);
    check(ok && calls > (1 + QL_CFG_PANEL) * HEIGHT, claim);
}

/* A port that stays broken, too, so that the end cannot be sent. */
static void test_first_error(void)
{
    const run_t r = {WIDTH, HEIGHT + 2, PANEL_FORMAT, 2, 0, 0};
    uint32_t calls;
    bool ok;

    sim_fault_arm(0, SIM_FAULT_ONCE);
    ok = run_app(&r) == QL_OK;
    calls = sim_fault_calls();
    for (uint32_t at = 1; at <= calls; at++) {
        ql_status_t first;

        sim_fault_arm(at, SIM_FAULT_ONCE);
        first = run_app(&r);
        sim_fault_arm(at, SIM_FAULT_STAYS);
        ok = ok && run_app(&r) == first;
    }
    sim_fault_arm(0, SIM_FAULT_ONCE);
    check(ok, "the_first_error_is_the_one_reported");
}

/* The simulator's port takes more than it has room for at first. */
static void test_port(void)
{
    const sim_hal_setup_t setup = {
            test.blob, test.blob_size, {0, 0, QL_FORMAT_RGB888}, 0};
    const sim_hal_result_t *got = sim_hal_result();
    uint8_t bytes[97];
    bool ok = true;

    sim_hal_begin(&setup);
    ok = ql_hal_init() == QL_OK;
    for (unsigned i = 0; i < 200; i++) {
        memset(bytes, (int)i, sizeof bytes);
        ok = ok && ql_hal_serial_write(bytes, sizeof bytes) == QL_OK;
    }
    ok = ok && got->serial_size == 200 * sizeof bytes;
    for (unsigned i = 0; i < 200 && ok; i++) {
        memset(bytes, (int)i, sizeof bytes);
        ok = memcmp(got->serial + i * sizeof bytes, bytes, sizeof bytes) == 0;
    }
    check(ok, "the_port_keeps_every_byte");
}

/* A build that cannot encode the stream says so in its last frame. */
static void test_no_stream(void)
{
    const run_t plain = {0, 0, QL_FORMAT_RGB888, 1, 0, 0};
    picture_t p;
    const bool refused = run_app(&plain) == QL_ERR_SETTINGS;

    receive(&p);
    check(refused && p.intact && p.heads == 0 && p.line_count == 0 &&
                    p.ends == 1 && p.status == QL_ERR_SETTINGS,
            "a_stream_of_a_format_not_built_in_is_refused");
}

int main(void)
{
    cli_begin("test_app");
    test.blob = box_scene(&test.blob_size);
    if (QL_CFG_FORMATS & 1) {
        test_stream();
        test_panel();
        test_stop();
        test_refusals();
        test_missing();
        test_faults(SIM_FAULT_ONCE, "every_glitch_of_the_hal_is_reported");
        test_faults(SIM_FAULT_STAYS, "every_breakdown_of_the_hal_is_survived");
        test_first_error();
        test_port();
    } else {
        test_no_stream();
    }
    check(sim_hal_result()->offence[0] == '\0', "no_call_breaks_the_contract");
    sim_hal_end();
    return test.failures != 0;
}
