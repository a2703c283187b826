/* cli.c - what every program shares: messages, exit codes, safe output */
/* SPDX-License-Identifier: MIT */

#ifndef _XOPEN_SOURCE
#define _XOPEN_SOURCE 700 /* realpath() */
#endif
#define _FILE_OFFSET_BITS 64

#include "lib/program/cli.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#define OUT_MAX   16 /* files written at the same time */
#define READ_MAX  (((size_t)3 << 30) + 65536) /* a PFM of 2^28 pixels */
#define READ_STEP ((size_t)1 << 16)

enum { LINKS_MAX = 40, LINK_BYTES = 4096 };

static const char *program_name = "qlux";
static volatile sig_atomic_t holding; /* a signal only sets the next one */
static volatile sig_atomic_t interrupted;
static bool progress_open; /* the cursor stands behind a progress bar */

/* Temporary files that exist now. A signal handler reads this, so a slot is
 * filled by one pointer store after its file exists and emptied likewise. */
static char *volatile temporaries[OUT_MAX];

/* Async-signal-safe. */
static void remove_temporaries(void)
{
    for (int i = 0; i < OUT_MAX; i++) {
        if (temporaries[i] != NULL) {
            unlink(temporaries[i]);
        }
    }
}

/* Async-signal-safe. Nothing can be said to a stderr that takes nothing. */
static void say_interrupted(void)
{
    static const char text[] = ": interrupted\n";

    if ((progress_open && write(STDERR_FILENO, "\n", 1) < 0) ||
            write(STDERR_FILENO, program_name, strlen(program_name)) < 0 ||
            write(STDERR_FILENO, text, sizeof text - 1) < 0) {
        return;
    }
}

/* A signal ends the program at once, whatever it computes or waits for. One
 * that holds them is asked by the first and ended by the second. */
static void on_signal(int number)
{
    (void)number;
    if (holding && !interrupted) {
        interrupted = 1;
        return;
    }
    remove_temporaries();
    say_interrupted();
    _exit(CLI_IO);
}

/* A full disk behind stdout is known only when it is flushed. */
static void close_stdout(void)
{
    const bool failed = ferror(stdout) != 0;

    if (fflush(stdout) != 0 || failed) {
        if (errno != EPIPE) { /* the reader of a pipe may well have enough */
            fprintf(stderr, "%s: cannot write to stdout: %s\n", program_name,
                    strerror(errno));
        }
        _exit(CLI_IO);
    }
}

void cli_begin(const char *program)
{
    struct sigaction stop, ignore, hangup;

    program_name = program;
    memset(&stop, 0, sizeof stop);
    stop.sa_handler = on_signal; /* no SA_RESTART: waiting reads give up */
    sigemptyset(&stop.sa_mask);
    ignore = stop;
    ignore.sa_handler = SIG_IGN;
    sigaction(SIGINT, &stop, NULL);
    sigaction(SIGTERM, &stop, NULL);
    sigaction(SIGHUP, NULL, &hangup);
    if (hangup.sa_handler != SIG_IGN) { /* nohup must keep working */
        sigaction(SIGHUP, &stop, NULL);
    }
    /* Writes that cannot succeed shall return an error, not kill. */
    sigaction(SIGPIPE, &ignore, NULL);
#ifdef SIGXFSZ
    sigaction(SIGXFSZ, &ignore, NULL);
#endif
    atexit(close_stdout);
}

void cli_below_progress(void)
{
    if (progress_open) {
        fputc('\n', stderr);
        progress_open = false;
    }
}

void cli_hold_signals(void)
{
    holding = 1;
}

bool cli_interrupted(void)
{
    return interrupted != 0;
}

bool cli_release_signals(void)
{
    const bool stopped = interrupted != 0;

    holding = 0;
    interrupted = 0;
    return stopped;
}

void cli_fail(int code, const char *format, ...)
{
    va_list arguments;

    cli_below_progress();
    fprintf(stderr, "%s: ", program_name);
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fputc('\n', stderr);
    remove_temporaries();
    exit(code);
}

void cli_warn(const char *format, ...)
{
    va_list arguments;

    cli_below_progress();
    fprintf(stderr, "%s: warning: ", program_name);
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fputc('\n', stderr);
}

void *cli_alloc(size_t count, size_t size)
{
    /* calloc checks the product; a request for 0 bytes must not fail. */
    void *memory = calloc(count != 0 ? count : 1, size != 0 ? size : 1);

    if (memory == NULL) {
        cli_fail(CLI_IO, "out of memory for %zu x %zu bytes", count, size);
    }
    return memory;
}

/* The rest of file, grown as it comes, so pipes work too. */
static void *read_all(FILE *file, const char *path, size_t *size)
{
    size_t room = READ_STEP, used = 0;
    char *data = cli_alloc(room + 1, 1);

    for (;;) {
        used += fread(data + used, 1, room - used, file);
        if (used < room) {
            break;
        }
        if (room == READ_MAX) {
            cli_fail(CLI_IO, "%s: too large to read (above %zu bytes)", path,
                    READ_MAX);
        }
        room = room < READ_MAX / 2 ? 2 * room : READ_MAX;
        data = realloc(data, room + 1);
        if (data == NULL) {
            cli_fail(CLI_IO, "%s: out of memory for %zu bytes", path, room);
        }
    }
    if (ferror(file)) {
        free(data);
        cli_fail(CLI_IO, "cannot read %s: %s", path, strerror(errno));
    }
    data[used] = '\0';
    *size = used;
    return data;
}

void *cli_read(const char *path, size_t *size)
{
    static bool stdin_read;
    const bool is_stdin = strcmp(path, "-") == 0;
    FILE *file = is_stdin ? stdin : fopen(path, "rb");
    void *data;

    if (is_stdin && stdin_read) {
        cli_fail(CLI_USAGE, "'-' is given twice, but stdin is read once");
    }
    stdin_read = stdin_read || is_stdin;
    if (file == NULL) {
        cli_fail(CLI_IO, "cannot read %s: %s", path, strerror(errno));
    }
    data = read_all(file, path, size);
    if (!is_stdin) {
        fclose(file);
    }
    return data;
}

/* The bytes of a name up to its last slash, that included. */
static size_t folder_size(const char *path)
{
    const char *slash = strrchr(path, '/');

    return slash != NULL ? (size_t)(slash - path) + 1 : 0;
}

/* Size bytes of a name and then another, in new memory. */
static char *join_names(const char *folder, size_t size, const char *name)
{
    char *path = cli_alloc(size + strlen(name) + 1, 1);

    memcpy(path, folder, size);
    strcpy(path + size, name);
    return path;
}

/* The same file in a folder without links or dots, if there is that folder. */
static char *resolve_folder(char *path)
{
    const size_t size = folder_size(path);
    char *name = join_names(path, size, ".");
    char *folder = realpath(name, NULL), *full = path;

    free(name);
    if (folder != NULL) {
        name = join_names(folder, strlen(folder), "/");
        full = join_names(name, strlen(name), path + size);
        free(name);
        free(folder);
        free(path);
    }
    return full;
}

/* Where a name leads, through links to what is not there yet as well; NULL and
 * errno if they go round. */
static char *follow_links(const char *path)
{
    char *at = join_names(path, strlen(path), ""), *next;
    char link[LINK_BYTES];

    for (unsigned i = 0; i < LINKS_MAX; i++) {
        const ssize_t n = readlink(at, link, sizeof link - 1);

        if (n < 0) {
            return resolve_folder(at);
        }
        link[n] = '\0';
        next = join_names(at, link[0] == '/' ? 0 : folder_size(at), link);
        free(at);
        at = next;
    }
    free(at);
    errno = ELOOP;
    return NULL;
}

bool cli_same_output(const char *a, const char *b)
{
    struct stat info;
    char *to_a, *to_b;
    bool same;

    if (strcmp(a, "-") == 0 || strcmp(b, "-") == 0) {
        return strcmp(a, b) == 0;
    }
    if (stat(a, &info) == 0 && !S_ISREG(info.st_mode)) {
        return false; /* a device or a pipe takes both */
    }
    to_a = follow_links(a);
    to_b = follow_links(b);
    same = to_a != NULL && to_b != NULL && strcmp(to_a, to_b) == 0;
    free(to_a);
    free(to_b);
    return same;
}

/* Create a file of a new name in the folder of path. */
static FILE *create_beside(const char *path, char **name)
{
    const size_t folder = folder_size(path);
    const size_t room = folder + 64;
    int fd = -1;

    *name = cli_alloc(room, 1);
    memcpy(*name, path, folder);
    for (unsigned i = 0; fd < 0 && i < 1000; i++) {
        snprintf(*name + folder, room - folder, "qlux-%ld-%u.tmp",
                (long)getpid(), i);
        fd = open(*name, O_WRONLY | O_CREAT | O_EXCL, 0666);
        if (fd < 0 && errno != EEXIST) {
            return NULL;
        }
    }
    return fd >= 0 ? fdopen(fd, "wb") : NULL; /* fails for want of memory */
}

/* Create a temporary file and enter it, without a signal in between. */
static void create_temporary(cli_out_t *out)
{
    sigset_t all, before;
    int slot = 0;

    while (slot < OUT_MAX - 1 && temporaries[slot] != NULL) {
        slot++;
    }
    sigfillset(&all);
    sigprocmask(SIG_BLOCK, &all, &before);
    out->file = create_beside(out->target, &out->temporary);
    if (out->file != NULL) {
        temporaries[slot] = out->temporary;
    }
    sigprocmask(SIG_SETMASK, &before, NULL);
}

/* stdout for the output alone: what else is printed goes to stderr. */
static FILE *take_stdout(void)
{
    int fd;

    fflush(stdout);
    fd = dup(STDOUT_FILENO);
    if (fd < 0 || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) {
        return NULL;
    }
    return fdopen(fd, "wb");
}

void cli_out_open(cli_out_t *out, const char *path)
{
    struct stat info;
    const bool exists = stat(path, &info) == 0;

    memset(out, 0, sizeof *out);
    out->path = path;
    if (strcmp(path, "-") == 0) {
        out->path = "stdout";
        out->file = take_stdout();
    } else if (exists && !S_ISREG(info.st_mode)) {
        /* /dev/null, a pipe: written directly; renaming would replace it. */
        out->file = S_ISDIR(info.st_mode) ? NULL : fopen(path, "wb");
        errno = S_ISDIR(info.st_mode) ? EISDIR : errno;
    } else if (!exists || access(path, W_OK) == 0) {
        /* A symbolic link shall keep pointing at what is written. */
        out->target = follow_links(path);
        if (out->target != NULL) {
            create_temporary(out);
        }
    }
    if (out->file == NULL) {
        cli_fail(CLI_IO, "cannot write %s: %s", out->path, strerror(errno));
    }
    if (out->temporary != NULL && exists) {
        (void)fchmod(fileno(out->file), info.st_mode & 0777);
    }
}

void cli_out_commit(cli_out_t *out)
{
    bool ok = ferror(out->file) == 0;
    int reason = ok ? 0 : errno;

    if (fclose(out->file) != 0 && ok) {
        ok = false;
        reason = errno;
    }
    if (ok && out->temporary != NULL &&
            rename(out->temporary, out->target) != 0) {
        ok = false;
        reason = errno;
    }
    if (!ok) {
        cli_fail(CLI_IO, "cannot write %s: %s", out->path, strerror(reason));
    }
    for (int i = 0; i < OUT_MAX; i++) {
        if (temporaries[i] == out->temporary) {
            temporaries[i] = NULL;
        }
    }
    free(out->temporary);
    free(out->target);
    memset(out, 0, sizeof *out);
}

double cli_seconds(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void cli_terminal_size(unsigned *columns, unsigned *lines)
{
    *columns = 80;
    *lines = 24;
#ifdef TIOCGWINSZ
    {
        struct winsize size;

        if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
            *columns = size.ws_col;
            *lines = size.ws_row;
        }
    }
#endif
}

/* "label [####....] text", without what does not fit. The last column stays
 * free: some terminals go on to the next line behind it. */
static void draw_progress(const char *label, double part, const char *text)
{
    enum { MOST = 32, LEAST = 4 }; /* of the bar */
    unsigned columns, lines;
    int room, rest, width;
    char bar[MOST + 1];

    cli_terminal_size(&columns, &lines);
    room = (int)columns - 1;
    rest = room - (int)strlen(label) - (int)strlen(text);
    width = rest - 4 < MOST ? rest - 4 : MOST;
    for (int i = 0; i < width; i++) {
        bar[i] = i < part * width ? '#' : '.';
    }
    if (width >= LEAST) {
        fprintf(stderr, "\r%s [%.*s] %s", label, width, bar, text);
    } else if (rest > 0) {
        fprintf(stderr, "\r%s %s", label, text);
    } else {
        fprintf(stderr, "\r%.*s", room, text);
    }
}

void cli_progress(const char *label, uint64_t done, uint64_t total, bool quiet)
{
    static double begun, drawn;
    const double now = cli_seconds();
    const double part = total != 0 ? (double)done / (double)total : 1;
    const bool last = done >= total;
    char left[32] = "", text[64];

    if (quiet || !isatty(STDERR_FILENO)) {
        return;
    }
    if (!progress_open) {
        begun = now;
        drawn = now - 1;
        progress_open = true;
    }
    if (now - drawn < 0.1 && !last) {
        return;
    }
    drawn = now;
    if (last || now - begun > 0.5) { /* too early to tell before that */
        const double s = last ? now - begun : (now - begun) * (1 / part - 1);
        if (s < 360000) {
            snprintf(left, sizeof left, "%d:%02d %s", (int)s / 60, (int)s % 60,
                    last ? "   " : "left");
        }
    }
    snprintf(text, sizeof text, "%3d %% %-12s", (int)(part * 100), left);
    draw_progress(label, part, text);
    if (last) {
        fputc('\n', stderr);
        progress_open = false;
    }
    fflush(stderr);
}
