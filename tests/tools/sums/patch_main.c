/* patch_main.c - other bytes in a sum file or a blob, its CRC-32 made right */
/* SPDX-License-Identifier: MIT */

/* usage: patch FILE [OFFSET HEX]... > FILE
 * The bytes of HEX replace those at OFFSET; what a check value guards can so be
 * tried without it. The CRC-32 is computed here, bit by bit. */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static unsigned char data[1 << 20];
static size_t size;

static unsigned long crc32(const unsigned char *bytes, size_t n)
{
    unsigned long crc = 0xffffffff;

    for (size_t i = 0; i < 8 * n; i++) {
        const unsigned long bit = (crc ^ bytes[i / 8] >> i % 8) & 1;

        crc = crc >> 1 ^ (bit != 0 ? 0xedb88320 : 0);
    }
    return crc ^ 0xffffffff;
}

static void put_crc(size_t at, unsigned long crc)
{
    for (unsigned i = 0; i < 4; i++) {
        data[at + i] = (unsigned char)(crc >> 8 * i & 0xff);
    }
}

static int patch(size_t at, const char *hex)
{
    for (; hex[0] != '\0'; hex += 2, at++) {
        const char digits[3] = {hex[0], hex[1], '\0'};

        if (hex[1] == '\0' || at >= size) {
            return 0;
        }
        data[at] = (unsigned char)strtoul(digits, NULL, 16);
    }
    return 1;
}

int main(int argc, char **argv)
{
    FILE *file = argc > 1 ? fopen(argv[1], "rb") : NULL;

    if (file == NULL || argc % 2 != 0) {
        return 1;
    }
    size = fread(data, 1, sizeof data, file);
    fclose(file);
    for (int i = 2; i < argc; i += 2) {
        if (!patch((size_t)strtoul(argv[i], NULL, 10), argv[i + 1])) {
            return 1;
        }
    }
    if (memcmp(data, "QLUX", 4) == 0) {
        put_crc(12, crc32(data + 16, size - 16));
    } else {
        put_crc(size - 4, crc32(data, size - 4));
    }
    return fwrite(data, 1, size, stdout) == size ? 0 : 3;
}
