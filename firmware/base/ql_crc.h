/* ql_crc.h - CRC-32 of blobs, sum files and serial lines */
/* SPDX-License-Identifier: MIT */

#ifndef QL_CRC_H
#define QL_CRC_H

#include "base/ql_base.h"

/* Continue a CRC-32 (ISO-HDLC, polynomial 0x04C11DB7 reflected, as in zlib).
 *
 *   crc     -      result of the previous call; 0 to begin
 *   data    -      the next bytes
 *   size    bytes  how many
 *   return  the CRC of everything so far
 *
 * Cost: 64 bytes of table, two look-ups a byte; with QL_CFG_SMALL no table and
 *       eight shifts a byte.
 * From: check value of "123456789" is 0xCBF43926.
 */
uint32_t ql_crc32(uint32_t crc, const void *data, size_t size);

#endif
