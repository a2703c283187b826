/* digest_main.c - one number for the pictures of some blobs, on any machine */
/* SPDX-License-Identifier: MIT */

/* Hosted: digest FILE prints the number. With DIGEST_BARE there is no library
 * and no operating system but the two Linux calls that an emulator of the user
 * mode knows, and the file is part of the program. The file holds blobs, each
 * after its size in four little-endian bytes, then a size of 0. */

#include "base/ql_crc.h"
#include "qlux.h"

enum { WIDTH = 12, HEIGHT = 9 };

static uint32_t read_word(const uint8_t *at)
{
    return at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 |
           (uint32_t)at[3] << 24;
}

static uint32_t add_sum(uint32_t crc, const ql_sum_t *sum)
{
    uint8_t bytes[24];

    for (unsigned i = 0; i < 24; i++) {
        bytes[i] = (uint8_t)(sum->rgb[i / 8] >> 8 * (i % 8) & 0xffu);
    }
    return ql_crc32(crc, bytes, sizeof bytes);
}

static uint32_t add_picture(
        uint32_t crc, const ql_scene_t *scene, const ql_settings_t *settings)
{
    uint8_t line[2 * WIDTH];
    const ql_output_t output = {QL_FORMAT_RGB565_BE, line};
    ql_render_t render;

    if (ql_render_init(&render, scene, settings) != QL_OK) {
        return crc + 1;
    }
    for (uint16_t y = 0; y < HEIGHT; y++) {
        for (uint16_t x = 0; x < WIDTH; x++) {
            ql_sum_t sum = {{0, 0, 0}};

            ql_render_pixel(&render, x, y, 0, settings->spp, &sum);
            crc = add_sum(crc, &sum);
            ql_render_encode(&render, x, y, &sum, settings->spp, &output, 1);
        }
        crc = ql_crc32(crc, line, sizeof line);
    }
    return crc;
}

/* Every strategy of both samplers; what a build lacks changes the number. */
static uint32_t digest_of(const uint8_t *file)
{
    uint32_t crc = 0;

    while (read_word(file) != 0) {
        const uint32_t size = read_word(file);
        ql_scene_t scene;

        if (ql_blob_open(&scene, file + 4, size) != QL_OK) {
            return 0;
        }
        for (uint8_t i = 0; i < 12; i++) {
            ql_settings_t s = QL_SETTINGS_DEFAULT;

            s.width = WIDTH;
            s.height = HEIGHT;
            s.spp = 2;
            s.seed = 55;
            s.direct = i % 6;
            s.sampler = i / 6;
            s.indirect = (uint8_t)(i % 6 == 2 ? QL_INDIRECT_UNIFORM
                                              : QL_INDIRECT_BRDF);
            s.lights = i % 3;
            s.roulette = i % 2;
            crc = add_picture(crc, &scene, &s);
        }
        file += 4 + size; /* a multiple of 4 */
    }
    return crc;
}

static void write_hex(uint32_t number, char text[9])
{
    for (unsigned i = 0; i < 8; i++) {
        text[i] = "0123456789abcdef"[number >> (28 - 4 * i) & 15u];
    }
    text[8] = '\n';
}

#ifdef DIGEST_BARE

__asm__(".section .rodata\n.balign 4\n.global blobs\nblobs:\n.incbin "
        "\"" DIGEST_BARE "\"\n.previous");
extern const uint8_t blobs[];

#if defined(__arm__)
static long call(long number, long a, long b, long c)
{
    register long r7 __asm__("r7") = number;
    register long r0 __asm__("r0") = a;
    register long r1 __asm__("r1") = b;
    register long r2 __asm__("r2") = c;

    __asm__ volatile("svc 0" : "+r"(r0) : "r"(r7), "r"(r1), "r"(r2) : "memory");
    return r0;
}
enum { CALL_WRITE = 4, CALL_EXIT = 1 };
#elif defined(__riscv)
static long call(long number, long a, long b, long c)
{
    register long a7 __asm__("a7") = number;
    register long a0 __asm__("a0") = a;
    register long a1 __asm__("a1") = b;
    register long a2 __asm__("a2") = c;

    __asm__ volatile("ecall" : "+r"(a0) : "r"(a7), "r"(a1), "r"(a2) : "memory");
    return a0;
}
enum { CALL_WRITE = 64, CALL_EXIT = 93 };
#endif

void _start(void);
void *memcpy(void *to, const void *from, size_t size);
void *memset(void *to, int value, size_t size);

void *memcpy(void *to, const void *from, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        ((volatile char *)to)[i] = ((const char *)from)[i];
    }
    return to;
}

void *memset(void *to, int value, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        ((volatile char *)to)[i] = (char)value;
    }
    return to;
}

void _start(void)
{
    char text[9];

    write_hex(digest_of(blobs), text);
    (void)call(CALL_WRITE, 1, (long)text, sizeof text);
    (void)call(CALL_EXIT, 0, 0, 0);
}

#else

#include <stdio.h>

static uint32_t file[1 << 16]; /* aligned as a blob must be */

int main(int argc, char **argv)
{
    FILE *in = argc == 2 ? fopen(argv[1], "rb") : NULL;
    char text[9];

    if (in == NULL || fread(file, 1, sizeof file - 4, in) == 0) {
        (void)fputs("usage: digest BLOBS\nExample: digest "
                    "build/extreme/blobs.bin\n",
                stderr);
        return 1;
    }
    (void)fclose(in);
    write_hex(digest_of((const uint8_t *)file), text);
    (void)fwrite(text, 1, sizeof text, stdout);
    return 0;
}

#endif
