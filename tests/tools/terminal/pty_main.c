/* pty_main.c - run a program on a pseudo terminal, as people or a board do */
/* SPDX-License-Identifier: MIT */

/* usage: pty watch COMMAND...         its stderr is a terminal
 *        pty stop COMMAND...          the same; Ctrl-C once something is drawn
 *        pty send FILE COMMAND...     @ in it is a serial port that sends FILE
 *        pty part N FILE COMMAND...   the first N bytes of it, then Ctrl-C
 *
 * What the terminal shows goes to stdout, newlines as they are. The settings
 * that the program chose for a serial port come first. Exits as the program
 * does; it is ended after 20 s: everything here takes milliseconds. */

#define _XOPEN_SOURCE 700 /* posix_openpt() and its kin */
#ifndef _DEFAULT_SOURCE
#define _DEFAULT_SOURCE /* rates above 38400 */
#endif

#include <fcntl.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

static void fail(const char *what)
{
    perror(what);
    exit(99);
}

static int open_master(void)
{
    const int master = posix_openpt(O_RDWR | O_NOCTTY);

    if (master < 0 || grantpt(master) != 0 || unlockpt(master) != 0) {
        fail("pty");
    }
    return master;
}

static int exit_code(int status)
{
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/* In the child: a session of its own, whose terminal is stderr and gives it
 * signals; newlines as they are. */
static void become_watched(int master, char **command)
{
    struct termios tty;
    int end;

    setsid();
    end = open(ptsname(master), O_RDWR); /* becomes the session's terminal */
    if (end < 0 || tcgetattr(end, &tty) != 0) {
        fail("terminal");
    }
    tty.c_oflag &= ~(tcflag_t)OPOST;
    tty.c_lflag &= ~(tcflag_t)ECHO;
    (void)tcsetattr(end, TCSANOW, &tty);
    (void)dup2(end, STDERR_FILENO);
    close(end);
    close(master);
    execvp(command[0], command);
    fail(command[0]);
}

static int watch(char **command, int stops)
{
    const int master = open_master();
    /* Held open, so that the terminal outlives the program. */
    const int end = open(ptsname(master), O_RDWR | O_NOCTTY);
    const pid_t child = fork();
    int status = 0;
    char text[4096];
    ssize_t n;

    if (child == 0) {
        become_watched(master, command);
    }
    close(end);
    while ((n = read(master, text, sizeof text)) > 0) {
        (void)fwrite(text, 1, (size_t)n, stdout);
        if (stops) {
            (void)!write(master, "\003", 1);
            stops = 0;
        }
    }
    (void)waitpid(child, &status, 0); /* EIO: nobody has the terminal open */
    return exit_code(status);
}

/* ---- Serial ports -------------------------------------------------------- */

static unsigned long rate_of(speed_t code)
{
    static const struct {
        speed_t code;
        unsigned long rate;
    } rates[] = {{B9600, 9600}, {B19200, 19200}, {B38400, 38400},
            {B57600, 57600}, {B115200, 115200}, {B230400, 230400},
#ifdef B460800
            {B460800, 460800}, {B921600, 921600}, {B1000000, 1000000},
#endif
            {B1200, 1200}};

    for (size_t i = 0; i < sizeof rates / sizeof *rates; i++) {
        if (rates[i].code == code) {
            return rates[i].rate;
        }
    }
    return 0;
}

/* All that would change or hold up bytes: none of it may be set. */
static int is_raw(const struct termios *tty)
{
    const tcflag_t in =
            IGNBRK | BRKINT | PARMRK | ISTRIP | INLCR | IGNCR | ICRNL | IXON;

    return (tty->c_iflag & in) == 0 &&
           (tty->c_lflag & (tcflag_t)(ICANON | ECHO | ISIG | IEXTEN)) == 0 &&
           (tty->c_cflag & CSIZE) == CS8 && (tty->c_cflag & PARENB) == 0 &&
           tty->c_cc[VMIN] == 1 && tty->c_cc[VTIME] == 0;
}

/* A line discipline for people, at a rate that no board has. */
static int open_port(int master)
{
    const int end = open(ptsname(master), O_RDWR | O_NOCTTY);
    struct termios tty;

    if (end < 0 || tcgetattr(end, &tty) != 0) {
        fail("port");
    }
    tty.c_iflag |= ICRNL | IXON | ISTRIP | BRKINT;
    tty.c_lflag |= ICANON | ISIG | IEXTEN;
    tty.c_lflag &= ~(tcflag_t)ECHO;
    tty.c_cflag = (tty.c_cflag & ~(tcflag_t)(CSIZE | CLOCAL)) | CS7 | PARENB;
    (void)cfsetispeed(&tty, B1200);
    (void)cfsetospeed(&tty, B1200);
    (void)tcsetattr(end, TCSANOW, &tty);
    return end;
}

/* Wait until the program has chosen settings, or has ended; or two seconds. */
static void await_settings(int port, pid_t child, struct termios *tty)
{
    const struct timespec nap = {0, 2000000};

    for (unsigned i = 0; i < 1000; i++) {
        siginfo_t info;

        memset(&info, 0, sizeof info);
        (void)waitid(P_PID, (id_t)child, &info, WEXITED | WNOHANG | WNOWAIT);
        (void)tcgetattr(port, tty);
        if (cfgetospeed(tty) != B1200 || info.si_pid == child) {
            return;
        }
        nanosleep(&nap, NULL);
    }
}

static void send_file(int master, const char *path, size_t most)
{
    static char data[1 << 16];
    FILE *file = fopen(path, "rb");
    size_t size, at = 0;

    if (file == NULL) {
        fail(path);
    }
    size = fread(data, 1, sizeof data, file);
    fclose(file);
    size = size < most ? size : most;
    while (at < size) {
        const ssize_t n = write(master, data + at, size - at);

        if (n <= 0) {
            return; /* nobody reads any more */
        }
        at += (size_t)n;
    }
}

static int serve(const char *path, size_t most, char **command)
{
    const int master = open_master(), port = open_port(master);
    struct termios tty;
    pid_t child;
    int status = 0;

    for (char **word = command; *word != NULL; word++) {
        *word = strcmp(*word, "@") == 0 ? ptsname(master) : *word;
    }
    child = fork();
    if (child == 0) {
        close(master);
        close(port);
        execvp(command[0], command);
        fail(command[0]);
    }
    await_settings(port, child, &tty);
    printf("%s, in %lu, out %lu, %s modem\n", is_raw(&tty) ? "raw" : "cooked",
            rate_of(cfgetispeed(&tty)), rate_of(cfgetospeed(&tty)),
            (tty.c_cflag & (tcflag_t)(CLOCAL | CREAD)) == (CLOCAL | CREAD)
                    ? "no"
                    : "a");
    (void)fflush(stdout);
    send_file(master, path, most);
    if (most != SIZE_MAX) {
        (void)kill(child, SIGINT);
    }
    (void)waitpid(child, &status, 0);
    return exit_code(status);
}

int main(int argc, char **argv)
{
    const char *how = argc > 2 ? argv[1] : "";

    (void)alarm(20);
    if (strcmp(how, "watch") == 0 || strcmp(how, "stop") == 0) {
        return watch(argv + 2, strcmp(how, "stop") == 0);
    }
    if (strcmp(how, "send") == 0 && argc > 3) {
        return serve(argv[2], SIZE_MAX, argv + 3);
    }
    if (strcmp(how, "part") == 0 && argc > 4) {
        return serve(argv[3], (size_t)atol(argv[2]), argv + 4);
    }
    return 98;
}
