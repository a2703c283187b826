/* test_dump_damage.c - a damaged dump is refused, or is the same blob */
/* SPDX-License-Identifier: MIT */

#define _XOPEN_SOURCE 700 /* fork() */

#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "lib/program/cli.h"
#include "lib/render/open_blob.h"
#include "scene/blob/dump_blob.h"
#include "scene/blob/parse_dump.h"
#include "scene/blob/write_blob.h"
#include "support/ql_test.h"

static char *dump; /* that of the specification */
static size_t dump_size;
static uint8_t *blob; /* which it is of */
static size_t blob_size;

static void read_specification(void)
{
    size_t size;
    char *text = cli_read("firmware/BLOB.md", &size);
    const char *begin = strstr(text, "```dump\n");
    const char *end = begin != NULL ? strstr(begin + 8, "```") : NULL;

    if (end == NULL) {
        cli_fail(CLI_INPUT, "firmware/BLOB.md has no dump");
    }
    dump_size = (size_t)(end - begin) - 8;
    dump = cli_alloc(dump_size + 1, 1);
    memcpy(dump, begin + 8, dump_size);
    free(text);
}

/* The blob of a dump; does not return if there is none. */
static uint8_t *blob_of(const char *bytes, size_t bytes_size, size_t *size)
{
    char *copy = cli_alloc(bytes_size + 1, 1);
    text_t text = {.path = "dump",
            .data = copy,
            .next = copy,
            .rest = copy + bytes_size,
            .end = copy + bytes_size,
            .next_line = 1};
    model_t model;
    ql_scene_t scene;
    uint8_t *made;

    memcpy(copy, bytes, bytes_size);
    if (!is_dump(&text)) {
        cli_fail(CLI_INPUT, "dump:1: not a dump");
    }
    parse_dump(&model, &text);
    made = write_blob(&model, size);
    open_blob_bytes(&scene, made, *size, "dump");
    model_free(&model);
    free(copy);
    return made;
}

/* cli_fail() ends a child here, before what looks for leaks at an exit. */
static void leave(void)
{
    _exit(CLI_INPUT);
}

/* What a child says of other bytes, and whether it makes the same blob. */
typedef struct {
    int code; /* 0: the same blob; 10: another one; CLI_INPUT: refused */
    char text[200];
} verdict_t;

static verdict_t try(const char *bytes, size_t size)
{
    verdict_t verdict = {0, ""};
    int ends[2], status = 0;
    size_t used = 0;
    ssize_t n;
    pid_t child;

    (void)fflush(stdout);
    if (pipe(ends) != 0 || (child = fork()) < 0) {
        cli_fail(CLI_IO, "no child");
    }
    if (child == 0) {
        size_t made_size;
        uint8_t *made;

        (void)atexit(leave);
        (void)dup2(ends[1], STDERR_FILENO);
        made = blob_of(bytes, size, &made_size);
        _exit(made_size == blob_size && memcmp(made, blob, blob_size) == 0
                        ? 0
                        : 10);
    }
    close(ends[1]);
    while ((n = read(ends[0], verdict.text + used,
                    sizeof verdict.text - 1 - used)) > 0) {
        used += (size_t)n;
    }
    verdict.text[used] = '\0';
    close(ends[0]);
    (void)waitpid(child, &status, 0);
    verdict.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
    return verdict;
}

/* No letter of a dump has its highest bit set. */
TEST(a_highest_bit_set_anywhere_changes_no_blob)
{
    unsigned refused = 0;

    for (size_t i = 0; i < dump_size; i++) {
        verdict_t v;

        dump[i] = (char)(dump[i] ^ 0x80);
        v = try(dump, dump_size);
        CHECK(v.code == 0 || (v.code == CLI_INPUT &&
                                     strncmp(v.text, "test_dump_damage: dump:",
                                             23) == 0),
                "byte %zu: exit %d: %s", i, v.code, v.text);
        refused += v.code != 0;
        dump[i] = (char)(dump[i] ^ 0x80);
    }
    NOTE("%u of %zu bytes are refused", refused, dump_size);
}

/* With the line of n bytes at this one so many times. */
static verdict_t try_lines(size_t at, size_t n, unsigned times)
{
    char *other = cli_alloc(dump_size + n, 1);
    size_t size = at;
    verdict_t v;

    memcpy(other, dump, at);
    for (unsigned i = 0; i < times; i++, size += n) {
        memcpy(other + size, dump + at, n);
    }
    memcpy(other + size, dump + at + n, dump_size - at - n);
    v = try(other, size + dump_size - at - n);
    free(other);
    return v;
}

/* Who edits a dump may add an entry to a table, if nothing contradicts, and
 * take the last light away; nothing else comes twice or is missing. */
TEST(lines_are_needed_and_not_twice)
{
    size_t at = (size_t)(strchr(dump, '\n') + 1 - dump), next;
    const size_t tables = (size_t)(strstr(dump, "# 8 vertices") - dump);
    unsigned lines = 0;

    for (; at < dump_size; at = next, lines++) {
        const int want = dump[at] == '#' ? 0 : CLI_INPUT;
        verdict_t v;

        next = (size_t)(strchr(dump + at, '\n') + 1 - dump);
        v = try_lines(at, next - at, 0);
        CHECK(v.code == want || strcmp(dump + next, "end\n") == 0,
                "without line %u: exit %d: %s", lines + 2, v.code, v.text);
        if (at < tables) {
            v = try_lines(at, next - at, 2);
            CHECK(v.code == want, "twice line %u: exit %d: %s", lines + 2,
                    v.code, v.text);
        }
    }
    NOTE("%u lines", lines);
}

/* All but the newline at the end. */
TEST(a_dump_that_is_cut_is_refused)
{
    for (size_t n = 0; n < dump_size; n++) {
        const verdict_t v = try(dump, n);

        CHECK(v.code == (n == dump_size - 1 ? 0 : CLI_INPUT),
                "%zu of %zu bytes: exit %d: %s", n, dump_size, v.code, v.text);
    }
}

int main(int argc, char **argv)
{
    cli_begin("test_dump_damage");
    read_specification();
    blob = blob_of(dump, dump_size, &blob_size);
    TEST_BEGIN("tools/dump_damage", argc, argv);
    RUN(a_highest_bit_set_anywhere_changes_no_blob);
    RUN(lines_are_needed_and_not_twice);
    RUN(a_dump_that_is_cut_is_refused);
    return TEST_END();
}
