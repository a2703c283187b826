/* replay_main.c - every input of the corpus once more, under sanitizers */
/* SPDX-License-Identifier: MIT */

/* usage: replay [CORPUS], which has a folder for each format */

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "fuzz/fuzz.h"
#include "lib/program/cli.h"

/* Of the sanitizers, whose reports go where stderr went. */
void __sanitizer_set_report_fd(void *fd);
void __sanitizer_set_death_callback(void (*tell)(void));

static int failures, reports;
static char path[1024]; /* of the input that is taken */

static void say(const char *claim, bool holds, const char *note)
{
    printf("%-20s %-52s %-4s %s\n", "fuzz/replay", claim, holds ? "ok" : "FAIL",
            note);
    failures += !holds;
}

static void tell(void)
{
    (void)!write(reports, path, strlen(path));
    (void)!write(reports, "\n", 1);
}

static void on_abort(int number)
{
    tell();
    (void)signal(number, SIG_DFL);
    (void)raise(number);
}

/* What programs say of bad inputs goes nowhere. */
static void silence(void)
{
    const int nowhere = open("/dev/null", O_WRONLY);

    reports = dup(STDERR_FILENO);
    (void)dup2(nowhere, STDERR_FILENO);
    __sanitizer_set_report_fd((void *)(intptr_t)reports);
    __sanitizer_set_death_callback(tell);
    (void)signal(SIGABRT, on_abort);
}

/* ---- what the harness sees ---------------------------------------------- */

/* The first byte says what a program does. */
enum { HARMLESS, END, FAIL_TO_READ, LEAK, WRITE_BEYOND };

static void misbehave(const uint8_t *data, size_t size)
{
    static uint8_t *volatile block;

    block = cli_alloc(8, 1);
    switch (data[0]) {
    case END:
        cli_fail(CLI_INPUT, "refused");
    case FAIL_TO_READ:
        (void)cli_read("no such file", &size);
        break;
    case LEAK:
        block = NULL;
        break;
    case WRITE_BEYOND:
        block[8] = 0;
        break;
    default:
        break;
    }
    free(block);
}

/* Does a child survive it? Nobody reads its report. */
static bool survives(uint8_t kind)
{
    int status = -1;
    pid_t child;

    (void)fflush(stdout);
    child = fork();
    if (child == 0) {
        (void)dup2(STDERR_FILENO, reports);
        __sanitizer_set_report_fd((void *)(intptr_t)STDERR_FILENO);
        fuzz_run(misbehave, &kind, 1);
        _exit(0);
    }
    return child > 0 && waitpid(child, &status, 0) == child &&
           WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

static void try_faults(void)
{
    say("an_input_that_ends_the_program_is_no_fault",
            survives(HARMLESS) && survives(END) && survives(FAIL_TO_READ), "");
    say("a_leak_and_a_byte_beyond_a_block_are_seen",
            !survives(LEAK) && !survives(WRITE_BEYOND), "");
}

/* ---- the corpus --------------------------------------------------------- */

/* A file's bytes, in a block of their size. */
static uint8_t *read_input(size_t *size)
{
    uint8_t *data = cli_read(path, size);

    return realloc(data, *size != 0 ? *size : 1);
}

/* Take all inputs of a format; return how many there are. */
static unsigned replay(const char *corpus, const char *name, fuzz_take_t *take)
{
    DIR *folder;
    const struct dirent *entry;
    unsigned count = 0;

    (void)snprintf(path, sizeof path, "%s/%s", corpus, name);
    folder = opendir(path);
    while (folder != NULL && (entry = readdir(folder)) != NULL) {
        uint8_t *data;
        size_t size;

        if (entry->d_name[0] == '.') {
            continue;
        }
        (void)snprintf(
                path, sizeof path, "%s/%s/%s", corpus, name, entry->d_name);
        data = read_input(&size);
        fuzz_run(take, data, size);
        free(data);
        count++;
    }
    if (folder != NULL) {
        closedir(folder);
    }
    return count;
}

int main(int argc, char **argv)
{
    static const char *const names[] = {
#define FUZZ_NAME(name) #name,
            FUZZ_LIST(FUZZ_NAME)
#undef FUZZ_NAME
    };
    const char *corpus = argc == 2 ? argv[1] : "tests/fuzz/corpus";

    silence();
    try_faults();
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const unsigned count = replay(corpus, names[i], fuzz_format(names[i]));
        char claim[64], note[32];

        (void)snprintf(claim, sizeof claim, "every_%s_ends_well", names[i]);
        (void)snprintf(note, sizeof note, "%u inputs", count);
        say(claim, count > 0, note);
    }
    return failures > 0;
}
