/* test_crc.c - CRC-32 against its check value and a bit-by-bit one */
/* SPDX-License-Identifier: MIT */

#include "base/ql_crc.h"
#include "support/ql_stats.h"
#include "support/ql_test.h"

#define POLYNOMIAL 0xedb88320u /* 0x04c11db7 reflected */

/* The definition: one bit at a time, no table. */
static uint32_t crc_by_bits(uint32_t crc, const uint8_t *bytes, size_t size)
{
    crc = ~crc;
    for (size_t i = 0; i < size; i++) {
        crc ^= bytes[i];
        for (unsigned k = 0; k < 8; k++) {
            crc = crc >> 1 ^ (crc & 1u ? POLYNOMIAL : 0);
        }
    }
    return ~crc;
}

TEST(check_value_is_cbf43926)
{
    const uint32_t crc = ql_crc32(0, "123456789", 9);

    CHECK(crc == 0xcbf43926u, "got %08lx", (unsigned long)crc);
}

TEST(nothing_added_changes_nothing)
{
    CHECK(ql_crc32(0, "", 0) == 0, "of no bytes");
    CHECK(ql_crc32(0x12345678u, "", 0) == 0x12345678u, "continued");
}

/* Every byte from each of 256 states reaches all pairs of table entries. */
TEST(table_equals_the_polynomial_for_every_byte)
{
    for (unsigned first = 0; first < 256; first++) {
        for (unsigned second = 0; second < 256; second++) {
            const uint8_t bytes[2] = {(uint8_t)first, (uint8_t)second};

            CHECK(ql_crc32(0, bytes, 2) == crc_by_bits(0, bytes, 2),
                    "bytes %02x %02x", first, second);
        }
    }
    NOTE("65536 inputs");
}

TEST(any_split_of_the_bytes_gives_the_same_crc)
{
    uint8_t bytes[97];
    uint64_t state = 1;
    uint32_t whole;

    for (size_t i = 0; i < sizeof bytes; i++) {
        bytes[i] = (uint8_t)stats_random(&state);
    }
    whole = crc_by_bits(0, bytes, sizeof bytes);
    for (size_t i = 0; i <= sizeof bytes; i++) {
        for (size_t j = i; j <= sizeof bytes; j++) {
            uint32_t crc = ql_crc32(0, bytes, i);

            crc = ql_crc32(crc, bytes + i, j - i);
            crc = ql_crc32(crc, bytes + j, sizeof bytes - j);
            CHECK(crc == whole, "split at %u, %u", (unsigned)i, (unsigned)j);
        }
    }
}

TEST(every_flip_of_one_or_two_bits_is_noticed)
{
    uint8_t bytes[32] = {0};
    const uint32_t whole = ql_crc32(0, bytes, sizeof bytes);

    for (unsigned i = 0; i < 8 * sizeof bytes; i++) {
        bytes[i / 8] ^= (uint8_t)(1u << i % 8);
        CHECK(ql_crc32(0, bytes, sizeof bytes) != whole, "bit %u", i);
        for (unsigned j = i + 1; j < 8 * sizeof bytes; j++) {
            bytes[j / 8] ^= (uint8_t)(1u << j % 8);
            CHECK(ql_crc32(0, bytes, sizeof bytes) != whole, "bits %u, %u", i,
                    j);
            bytes[j / 8] ^= (uint8_t)(1u << j % 8);
        }
        bytes[i / 8] ^= (uint8_t)(1u << i % 8);
    }
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_crc", argc, argv);
    RUN(check_value_is_cbf43926);
    RUN(nothing_added_changes_nothing);
    RUN(table_equals_the_polynomial_for_every_byte);
    RUN(any_split_of_the_bytes_gives_the_same_crc);
    RUN(every_flip_of_one_or_two_bits_is_noticed);
    return TEST_END();
}
