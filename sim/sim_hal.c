/* sim_hal.c - ql_hal.h on a PC: memory that checks its caller */
/* SPDX-License-Identifier: MIT */

#include "sim/sim_hal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"
#include "sim/sim_fault.h"

/* The HAL has no context argument, as a board needs none. */
static struct {
    sim_hal_setup_t setup;
    sim_hal_result_t result;
    size_t serial_room;
    uint32_t ticks;
    bool ready; /* ql_hal_init() was called */
} board;

void sim_hal_end(void)
{
    free(board.result.screen);
    free(board.result.shown);
    free(board.result.serial);
    memset(&board, 0, sizeof board);
}

static size_t line_bytes(void)
{
    const ql_hal_display_t *d = &board.setup.display;

    return QL_LINE_BYTES((size_t)d->width, d->format);
}

void sim_hal_begin(const sim_hal_setup_t *setup)
{
    sim_hal_end();
    board.setup = *setup;
    board.result.screen = cli_alloc(setup->display.height, line_bytes());
    board.result.shown = cli_alloc(setup->display.height, 1);
}

const sim_hal_result_t *sim_hal_result(void)
{
    return &board.result;
}

/* Keep the first offence. Returns ok. */
static bool expect(bool ok, const char *call, const char *claim)
{
    if (!ok && board.result.offence[0] == '\0') {
        snprintf(board.result.offence, sizeof board.result.offence,
                "%s: expected %s", call, claim);
    }
    return ok;
}

static bool expect_ready(const char *call)
{
    return expect(board.ready, call, "ql_hal_init() first") &&
           expect(!board.result.exited, call, "nothing after ql_hal_exit()");
}

ql_status_t ql_hal_init(void)
{
    (void)expect(!board.ready, "init", "to be called once");
    board.ready = true;
    return sim_fault_here() ? QL_ERR_DISPLAY : QL_OK;
}

void ql_hal_display_info(ql_hal_display_t *info)
{
    (void)expect_ready("display_info");
    *info = board.setup.display;
}

ql_status_t ql_hal_display_write(uint16_t y, const uint8_t *pixels)
{
    const size_t n = line_bytes();

    if (!expect_ready("display_write") ||
            !expect(board.setup.display.width != 0, "display_write",
                    "a board with a panel") ||
            !expect(y < board.setup.display.height, "display_write",
                    "y below the panel's height") ||
            !expect(pixels != NULL, "display_write", "pixels") ||
            sim_fault_here()) {
        return QL_ERR_DISPLAY;
    }
    memcpy(board.result.screen + n * y, pixels, n);
    board.result.shown[y] =
            (uint8_t)(board.result.shown[y] + (board.result.shown[y] < 255));
    board.result.display_writes++;
    return QL_OK;
}

/* Room for size more bytes. */
static void grow_serial(size_t size)
{
    size_t room = board.serial_room != 0 ? board.serial_room : 4096;
    uint8_t *grown;

    while (room < board.result.serial_size + size) {
        room *= 2;
    }
    if (room == board.serial_room) {
        return;
    }
    grown = cli_alloc(room, 1);
    if (board.result.serial != NULL) {
        memcpy(grown, board.result.serial, board.result.serial_size);
    }
    free(board.result.serial);
    board.result.serial = grown;
    board.serial_room = room;
}

ql_status_t ql_hal_serial_write(const uint8_t *bytes, uint16_t size)
{
    if (!expect_ready("serial_write") ||
            !expect(bytes != NULL && size != 0, "serial_write", "bytes") ||
            sim_fault_here()) {
        return QL_ERR_SERIAL;
    }
    grow_serial(size);
    memcpy(board.result.serial + board.result.serial_size, bytes, size);
    board.result.serial_size += size;
    board.result.serial_writes++;
    return QL_OK;
}

/* Time is the number of questions: runs are repeatable. */
uint32_t ql_hal_ticks(void)
{
    (void)expect_ready("ticks");
    return board.ticks++;
}

void ql_hal_scene_blob(const void **blob, size_t *size)
{
    (void)expect_ready("scene_blob");
    *blob = board.setup.blob;
    *size = board.setup.blob_size;
}

bool ql_hal_stop_requested(void)
{
    (void)expect_ready("stop_requested");
    board.result.stop_questions++;
    return cli_interrupted() ||
           (board.setup.stop_at != 0 &&
                   board.result.stop_questions >= board.setup.stop_at);
}

void ql_hal_exit(ql_status_t status)
{
    (void)expect(!board.result.exited, "exit", "to be called once");
    board.result.exited = true;
    board.result.exit_status = status;
}

void ql_hal_panic(uint16_t code, uint16_t line)
{
    fprintf(stderr, "sim_hal: panic, code %u line %u\n", (unsigned)code,
            (unsigned)line);
    abort();
}
