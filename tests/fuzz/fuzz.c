/* fuzz.c - run one input in this process, though a program would end */
/* SPDX-License-Identifier: MIT */

/* The linker takes calls of exit(), of the heap and of files here (--wrap, in
 * fuzz.mk). */

#include "fuzz/fuzz.h"

#include <setjmp.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"

/* The tests' own calls, and what a linker makes of those in programs. */
void __real_exit(int code) __attribute__((noreturn));
void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
void __real_free(void *memory);
FILE *__real_fopen(const char *path, const char *mode);
void *__real_cli_read(const char *path, size_t *size);
void __real_cli_out_open(cli_out_t *out, const char *path);
void __real_cli_out_commit(cli_out_t *out);
void __wrap_exit(int code) __attribute__((noreturn));
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t size);
void __wrap_free(void *memory);
FILE *__wrap_fopen(const char *path, const char *mode);
void *__wrap_cli_read(const char *path, size_t *size);
void __wrap_cli_out_open(cli_out_t *out, const char *path);
void __wrap_cli_out_commit(cli_out_t *out);

#if defined(__SANITIZE_ADDRESS__)
#define HAS_ASAN 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define HAS_ASAN 1
#endif
#endif
#ifdef HAS_ASAN
void __asan_describe_address(void *address);
#define DESCRIBE(address) __asan_describe_address(address)
#else
#define DESCRIBE(address) ((void)(address))
#endif

/* What the harness does is no way through a program. */
#ifdef __clang__
#define UNSEEN __attribute__((no_sanitize("coverage"), noinline))
#else
#define UNSEEN
#endif

static bool running;
static jmp_buf ended;

/* ---- the heap ----------------------------------------------------------- */

/* Blocks of this input, by open addressing. Numbers, not pointers, so that who
 * looks for leaks does not find them here. */
enum { SLOTS_LOG2 = 16, SLOTS = 1 << SLOTS_LOG2 };
typedef struct {
    uintptr_t block; /* complemented; 0: free */
    size_t bytes;
} slot_t;
static slot_t slots[SLOTS];
static size_t blocks, used; /* how many, their bytes */

UNSEEN static size_t home(uintptr_t block)
{
    return (size_t)((uint64_t)block * 0x9e3779b97f4a7c15u >> (64 - SLOTS_LOG2));
}

UNSEEN static void enter(void *memory, size_t bytes)
{
    const uintptr_t block = ~(uintptr_t)memory;
    size_t i = home(block);

    if (!running || memory == NULL) {
        return;
    }
    while (slots[i].block != 0) {
        i = (i + 1) % SLOTS;
    }
    slots[i] = (slot_t){block, bytes};
    blocks++;
    used += bytes;
}

/* Bytes of a block, which is forgotten; 0 if it is of before the input. */
UNSEEN static size_t forget(void *memory)
{
    const uintptr_t block = ~(uintptr_t)memory;
    size_t i = home(block), bytes;

    while (slots[i].block != block) {
        if (slots[i].block == 0) {
            return 0;
        }
        i = (i + 1) % SLOTS;
    }
    bytes = slots[i].bytes;
    blocks--;
    used -= bytes;
    /* What follows without a gap, and belongs before here, moves up. */
    for (size_t k = (i + 1) % SLOTS; slots[k].block != 0; k = (k + 1) % SLOTS) {
        if ((k - home(slots[k].block)) % SLOTS >= (k - i) % SLOTS) {
            slots[i] = slots[k];
            i = k;
        }
    }
    slots[i].block = 0;
    return bytes;
}

/* Is there so much more memory? */
UNSEEN static bool has_room(size_t bytes)
{
    return !running ||
           (bytes <= FUZZ_MEMORY - used && blocks < (size_t)SLOTS / 2);
}

void *__wrap_malloc(size_t size)
{
    void *memory = has_room(size) ? __real_malloc(size) : NULL;

    enter(memory, size);
    return memory;
}

void *__wrap_calloc(size_t count, size_t size)
{
    const bool fits = count == 0 || size <= SIZE_MAX / count;
    void *memory =
            fits && has_room(count * size) ? __real_calloc(count, size) : NULL;

    enter(memory, count * size);
    return memory;
}

void *__wrap_realloc(void *old, size_t size)
{
    void *memory;
    size_t before;

    if (!has_room(size)) {
        return NULL;
    }
    before = old != NULL ? forget(old) : 0;
    memory = __real_realloc(old, size);
    if (memory == NULL) {
        enter(old, before);
    }
    enter(memory, size);
    return memory;
}

void __wrap_free(void *memory)
{
    if (memory != NULL) {
        (void)forget(memory);
    }
    __real_free(memory);
}

/* Free what the input has left; say where the first block is from, if told. */
UNSEEN static void free_rest(bool report)
{
    for (size_t i = 0; i < SLOTS && blocks > 0; i++) {
        while (slots[i].block != 0) {
            void *memory = (void *)~slots[i].block;

            if (report) {
                (void)fprintf(stderr, "leak of %zu bytes\n", slots[i].bytes);
                DESCRIBE(memory);
                abort();
            }
            (void)forget(memory);
            __real_free(memory);
        }
    }
}

/* ---- files -------------------------------------------------------------- */

enum { FILES_MAX = 8 };
static struct {
    const char *name;
    const void *data;
    size_t size;
} files[FILES_MAX];
static unsigned file_count;

void fuzz_file(const char *name, const void *data, size_t size)
{
    FUZZ_CHECK(file_count < FILES_MAX);
    files[file_count].name = name;
    files[file_count].data = data;
    files[file_count++].size = size;
}

void fuzz_text(const char *name, const char *text)
{
    fuzz_file(name, text, strlen(text));
}

/* The number of a file; file_count if it is not there. */
static unsigned find(const char *path)
{
    unsigned i = 0;

    while (i < file_count && strcmp(files[i].name, path) != 0) {
        i++;
    }
    return i;
}

/* Whether a file can be read is all that programs ask. libFuzzer, which writes
 * what it has found, comes here too. */
FILE *__wrap_fopen(const char *path, const char *mode)
{
    if (running && mode[0] == 'r') {
        path = find(path) < file_count ? "/dev/null" : "/dev/null/none";
    }
    return __real_fopen(path, mode);
}

static FILE *output;
static char *written;
static size_t written_size;

FILE *fuzz_open(void)
{
    FUZZ_CHECK(output == NULL);
    output = open_memstream(&written, &written_size);
    FUZZ_CHECK(output != NULL);
    return output;
}

/* The library has allocated it, so that __wrap_malloc() has not seen it. */
static void drop_output(void)
{
    if (output != NULL) {
        FUZZ_CHECK(fclose(output) == 0);
        output = NULL;
    }
    __real_free(written);
    written = NULL;
}

uint8_t *fuzz_close(size_t *size)
{
    uint8_t *data;

    FUZZ_CHECK(fflush(output) == 0);
    *size = written_size;
    data = cli_alloc(written_size, 1);
    memcpy(data, written, written_size);
    drop_output();
    return data;
}

void *__wrap_cli_read(const char *path, size_t *size)
{
    const unsigned i = find(path);
    uint8_t *data;

    if (!running) {
        return __real_cli_read(path, size);
    }
    if (i == file_count) {
        cli_fail(CLI_IO, "cannot read %s", path);
    }
    *size = files[i].size;
    data = cli_alloc(*size + 1, 1);
    memcpy(data, files[i].data, *size);
    return data;
}

void __wrap_cli_out_open(cli_out_t *out, const char *path)
{
    if (!running) {
        __real_cli_out_open(out, path);
        return;
    }
    *out = (cli_out_t){.file = fuzz_open(), .path = path};
}

void __wrap_cli_out_commit(cli_out_t *out)
{
    size_t size;

    if (!running) {
        __real_cli_out_commit(out);
        return;
    }
    free(fuzz_close(&size));
}

/* ---- an input ----------------------------------------------------------- */

void __wrap_exit(int code)
{
    if (running) {
        longjmp(ended, 1);
    }
    __real_exit(code);
}

void fuzz_broken(const char *claim)
{
    (void)fprintf(stderr, "not true: %s\n", claim);
    abort();
}

fuzz_take_t *fuzz_format(const char *name)
{
#define FUZZ_ROW(format)                                                       \
    if (strcmp(name, #format) == 0) {                                          \
        return fuzz_##format;                                                  \
    }
    FUZZ_LIST(FUZZ_ROW)
#undef FUZZ_ROW
    return NULL;
}

void fuzz_run(fuzz_take_t *take, const uint8_t *data, size_t size)
{
    volatile bool refused = true;

    file_count = 0;
    running = true;
    if (setjmp(ended) == 0) {
        take(data, size);
        refused = false;
    }
    running = false;
    drop_output();
    free_rest(!refused);
}
