/* bytes.h - numbers in files: little-endian ones, and big-endian as in PNG */
/* SPDX-License-Identifier: MIT */

/* Every function reads or writes exactly the bytes of its number at an address
 * of any alignment; the byte order of this machine does not matter. */

#ifndef BYTES_H
#define BYTES_H

#include <stdint.h>

static inline uint16_t bytes_get_le16(const uint8_t *at)
{
    return (uint16_t)(at[0] | at[1] << 8);
}

static inline uint32_t bytes_get_le32(const uint8_t *at)
{
    return bytes_get_le16(at) | (uint32_t)bytes_get_le16(at + 2) << 16;
}

static inline uint64_t bytes_get_le64(const uint8_t *at)
{
    return bytes_get_le32(at) | (uint64_t)bytes_get_le32(at + 4) << 32;
}

static inline uint32_t bytes_get_be32(const uint8_t *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 |
           (uint32_t)at[2] << 8 | at[3];
}

static inline void bytes_put_le16(uint8_t *at, uint16_t value)
{
    at[0] = (uint8_t)value;
    at[1] = (uint8_t)(value >> 8);
}

static inline void bytes_put_le32(uint8_t *at, uint32_t value)
{
    bytes_put_le16(at, (uint16_t)value);
    bytes_put_le16(at + 2, (uint16_t)(value >> 16));
}

static inline void bytes_put_be32(uint8_t *at, uint32_t value)
{
    at[0] = (uint8_t)(value >> 24);
    at[1] = (uint8_t)(value >> 16);
    at[2] = (uint8_t)(value >> 8);
    at[3] = (uint8_t)value;
}

#endif
