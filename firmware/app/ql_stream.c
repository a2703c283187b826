/* ql_stream.c - build the frames of the serial picture protocol in place */
/* SPDX-License-Identifier: MIT */

#include "app/ql_stream.h"

#include "base/ql_crc.h"

static uint8_t *put16(uint8_t *at, uint16_t value)
{
    at[0] = (uint8_t)(value & 0xffu);
    at[1] = (uint8_t)(value >> 8);
    return at + 2;
}

static uint8_t *put32(uint8_t *at, uint32_t value)
{
    at = put16(at, (uint16_t)(value & 0xffffu));
    return put16(at, (uint16_t)(value >> 16));
}

/* Put mark, type, size and CRC around a payload that is in place. */
static uint16_t seal(uint8_t *frame, uint8_t type, uint16_t size)
{
    frame[0] = QL_STREAM_MARK0;
    frame[1] = QL_STREAM_MARK1;
    frame[2] = type;
    put16(frame + 3, size);
    put32(frame + QL_STREAM_PREFIX + size,
            ql_crc32(0, frame + 2, (size_t)size + 3u));
    return (uint16_t)QL_STREAM_FRAME_BYTES(size);
}

uint16_t ql_stream_head(
        uint8_t *frame, const ql_settings_t *settings, ql_format_t format)
{
    uint8_t *at = frame + QL_STREAM_PREFIX;

    at = put16(at, settings->width);
    at = put16(at, settings->height);
    at = put32(at, (uint32_t)format); /* a byte, then three zero bytes */
    at = put32(at, settings->spp);
    put32(at, settings->seed);
    return seal(frame, QL_STREAM_HEAD, QL_STREAM_HEAD_BYTES);
}

uint16_t ql_stream_line(uint8_t *frame, uint16_t y, uint16_t size)
{
    /* A line is at most 3 * 16384 bytes, so the sum fits 16 bits. */
    put16(frame + QL_STREAM_PREFIX, y);
    return seal(
            frame, QL_STREAM_LINE, (uint16_t)(size + QL_STREAM_LINE_PREFIX));
}

uint16_t ql_stream_end(uint8_t *frame, const ql_stream_end_t *end)
{
    uint8_t *at = frame + QL_STREAM_PREFIX;

    at = put32(at, (uint32_t)(int32_t)end->status);
    at = put32(at, end->diag.paths);
    at = put32(at, end->diag.closest_rays);
    at = put32(at, end->diag.shadow_rays);
    at = put32(at, end->diag.saturated);
    at = put32(at, end->ticks);
    at = put32(at, end->tick_hz);
    put32(at, end->diag.faint);
    return seal(frame, QL_STREAM_END, QL_STREAM_END_BYTES);
}
