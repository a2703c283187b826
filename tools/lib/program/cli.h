/* cli.h - what every program shares: messages, exit codes, safe output */
/* SPDX-License-Identifier: MIT */

/* Exit codes are a contract: 0 done, 1 wrong usage, 2 bad input, 3 could not
 * read or write, or interrupted, 4 above a limit that was given. Output goes to
 * a temporary name beside its target and is renamed when complete, so nothing
 * half-written is ever left behind: not by an error, not by a full disk, not by
 * Ctrl-C. options.h takes the command line. */

#ifndef CLI_H
#define CLI_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum { CLI_DONE = 0, CLI_USAGE = 1, CLI_INPUT = 2, CLI_IO = 3, CLI_ABOVE = 4 };

/* Begin: remembers the program's name for messages. From here on SIGINT and
 * SIGTERM remove temporary files, say "program: interrupted" and end it at once
 * with CLI_IO. Call first in main(). */
void cli_begin(const char *program);

/* Print "program: message" to stderr, remove temporary files, exit(code). */
#if defined(__GNUC__)
__attribute__((noreturn, format(printf, 2, 3)))
#endif
void cli_fail(int code, const char *format, ...);

/* Print "program: warning: message" to stderr and go on. */
#if defined(__GNUC__)
__attribute__((format(printf, 1, 2)))
#endif
void cli_warn(const char *format, ...);

/* calloc() that cannot fail: it ends in cli_fail(CLI_IO). */
void *cli_alloc(size_t count, size_t size);

/* Read a whole file into malloc'd, 8-byte aligned memory with a zero byte
 * after the end; cli_fail(CLI_IO) if it cannot be read. "-" is stdin, which can
 * be read once: cli_fail(CLI_USAGE). */
void *cli_read(const char *path, size_t *size);

/* A file being written. */
typedef struct {
    FILE *file;
    const char *path;
    char *temporary;
    char *target; /* where path leads, if links do */
} cli_out_t;

/* Open a temporary file beside what path leads to, which need not be there yet;
 * cli_fail(CLI_IO) if that is impossible. A device or a pipe is written itself,
 * and so is stdout, as "-": what is printed from then on goes to stderr. */
void cli_out_open(cli_out_t *out, const char *path);

/* Would two outputs of these names be one file? Devices and pipes never are. */
bool cli_same_output(const char *a, const char *b);

/* Flush, check every error so far, rename to the final name. On any failure the
 * temporary file is removed and cli_fail(CLI_IO) names path and reason. */
void cli_out_commit(cli_out_t *out);

/* Progress on a terminal: "label [####..] 42 % 0:31 left", or as much as fits.
 * Silent when stderr is not a terminal or quiet is set. Redraws at most ten
 * times a second; done == total finishes the line. */
void cli_progress(const char *label, uint64_t done, uint64_t total, bool quiet);

/* Columns and lines of the terminal that stderr is; 80 and 24 if it is none. */
void cli_terminal_size(unsigned *columns, unsigned *lines);

/* Begin a new line if the cursor stands behind a progress bar. What writes to
 * stderr by other means than the two above calls this first. */
void cli_below_progress(void);

/* Seconds of a clock that only goes forward. */
double cli_seconds(void);

/* From here on the first SIGINT or SIGTERM does no more than make
 * cli_interrupted() true; a second one ends the program all the same. */
void cli_hold_signals(void);

/* True once a signal arrived that is held: stop soon. */
bool cli_interrupted(void);

/* Signals end the program again. True if one arrived while they were held. */
bool cli_release_signals(void);

#endif
