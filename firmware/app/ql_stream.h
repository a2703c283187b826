/* ql_stream.h - the serial picture protocol: frames with a CRC each */
/* SPDX-License-Identifier: MIT */

/* A frame on the wire, numbers little-endian:
 *
 *     0  2  mark    0xA5 0x5A
 *     2  1  type    'H', 'L' or 'E'
 *     3  2  size    bytes of payload
 *     5  n  payload
 *   5+n  4  crc32   of type, size and payload
 *
 * H begins a picture: width u16, height u16, format u8 (ql_format_t), 3 zero
 *   bytes, spp u32, seed u32.
 * L is one line: y u16, then QL_LINE_BYTES(width, format) bytes. Any order.
 * E ends it: status i32, paths u32, closest rays u32, shadow rays u32,
 *   saturated u32, ticks u32, tick_hz u32, faint u32.
 *
 * Bytes between frames (boot messages, noise) are skipped by the receiver. */

#ifndef QL_STREAM_H
#define QL_STREAM_H

#include "render/ql_line.h"

QL_C_BEGIN

#define QL_STREAM_MARK0                0xa5u
#define QL_STREAM_MARK1                0x5au
#define QL_STREAM_HEAD                 'H'
#define QL_STREAM_LINE                 'L'
#define QL_STREAM_END                  'E'
#define QL_STREAM_HEAD_BYTES           16u
#define QL_STREAM_LINE_PREFIX          2u
#define QL_STREAM_END_BYTES            32u
#define QL_STREAM_PREFIX               5u /* bytes before the payload */
#define QL_STREAM_FRAME_BYTES(payload) (QL_STREAM_PREFIX + (payload) + 4u)

/* Frames are built in place: the caller has put a line's pixels, or leaves room
 * for the fields, at frame + QL_STREAM_PREFIX; each function fills in the rest
 * and returns the bytes to send. */

/* Where a line's pixels go in its frame, and the size of that frame. */
#define QL_STREAM_PIXELS (QL_STREAM_PREFIX + QL_STREAM_LINE_PREFIX)
#define QL_STREAM_LINE_FRAME(width, format)                                    \
    QL_STREAM_FRAME_BYTES(QL_STREAM_LINE_PREFIX + QL_LINE_BYTES(width, format))

/* Build the frame that begins a picture.
 *
 *   frame     -  out: QL_STREAM_FRAME_BYTES(QL_STREAM_HEAD_BYTES) bytes
 *   settings  -  with width and height resolved, as in ql_render_t
 *   format    -  of the lines that follow
 *   return    bytes of the frame
 */
uint16_t ql_stream_head(
        uint8_t *frame, const ql_settings_t *settings, ql_format_t format);

/* Build a frame around a line's pixels, which lie at frame + QL_STREAM_PIXELS.
 *
 *   frame   -      in and out: QL_STREAM_LINE_FRAME(width, format) bytes
 *   y       px     the line's number
 *   size    bytes  of its pixels, QL_LINE_BYTES(width, format)
 *   return  bytes of the frame
 */
uint16_t ql_stream_line(uint8_t *frame, uint16_t y, uint16_t size);

/* What the last frame of a picture says. */
typedef struct {
    ql_status_t status;
    ql_diag_t diag;
    uint32_t ticks; /* spent rendering, not sending */
    uint32_t tick_hz;
} ql_stream_end_t;

/* Build the frame that ends a picture.
 *
 *   frame   -  out: QL_STREAM_FRAME_BYTES(QL_STREAM_END_BYTES) bytes
 *   end     -  what it says
 *   return  bytes of the frame
 */
uint16_t ql_stream_end(uint8_t *frame, const ql_stream_end_t *end);

QL_C_END

#endif
