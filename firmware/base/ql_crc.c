/* ql_crc.c - CRC-32 by half bytes from a table, or bit by bit */
/* SPDX-License-Identifier: MIT */

#include "base/ql_crc.h"

/* The CRC after eight more bits, which are in its lowest eight. */
#if QL_CFG_SMALL
static uint32_t byte_step(uint32_t crc)
{
    for (unsigned k = 0; k < 8; k++) {
        crc = crc & 1u ? crc >> 1 ^ 0xedb88320u : crc >> 1;
    }
    return crc;
}
#else
/* Entry n is n shifted through four steps of the reflected polynomial
 * 0xEDB88320; tests/unit/test_crc.c derives them again. */
static const uint32_t crc_nibble[16] = {
        0x00000000u,
        0x1db71064u,
        0x3b6e20c8u,
        0x26d930acu,
        0x76dc4190u,
        0x6b6b51f4u,
        0x4db26158u,
        0x5005713cu,
        0xedb88320u,
        0xf00f9344u,
        0xd6d6a3e8u,
        0xcb61b38cu,
        0x9b64c2b0u,
        0x86d3d2d4u,
        0xa00ae278u,
        0xbdbdf21cu,
};

static uint32_t byte_step(uint32_t crc)
{
    crc = crc >> 4 ^ crc_nibble[crc & 15u];
    return crc >> 4 ^ crc_nibble[crc & 15u];
}
#endif

uint32_t ql_crc32(uint32_t crc, const void *data, size_t size)
{
    const uint8_t *bytes = data;

    crc = ~crc;
    for (size_t i = 0; i < size; i++) {
        crc = byte_step(crc ^ bytes[i]);
    }
    return ~crc;
}
