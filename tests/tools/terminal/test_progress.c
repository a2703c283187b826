/* test_progress.c - the progress bar, letter by letter, on a terminal */
/* SPDX-License-Identifier: MIT */

#define _XOPEN_SOURCE 700 /* posix_openpt() and its kin */

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

#include "lib/program/cli.h"
#include "support/ql_test.h"

/* The clock of cli.c, in milliseconds. */
static long now_ms = 1000;

int clock_gettime(clockid_t id, struct timespec *now)
{
    (void)id;
    now->tv_sec = now_ms / 1000;
    now->tv_nsec = now_ms % 1000 * 1000000;
    return 0;
}

static int screen; /* the other end of the terminal that stderr is */
static int saved;  /* stderr as it was */

static void open_terminal(void)
{
    struct termios tty;
    int end;

    screen = posix_openpt(O_RDWR | O_NOCTTY);
    if (screen < 0 || grantpt(screen) != 0 || unlockpt(screen) != 0) {
        cli_fail(CLI_IO, "no pseudo terminal");
    }
    end = open(ptsname(screen), O_RDWR | O_NOCTTY);
    if (end < 0 || tcgetattr(end, &tty) != 0) {
        cli_fail(CLI_IO, "no end of a pseudo terminal");
    }
    tty.c_oflag &= ~(tcflag_t)OPOST; /* newlines as they are written */
    (void)tcsetattr(end, TCSANOW, &tty);
    saved = dup(STDERR_FILENO);
    (void)dup2(end, STDERR_FILENO);
    close(end);
}

static void close_terminal(void)
{
    (void)dup2(saved, STDERR_FILENO);
    close(saved);
    close(screen);
}

/* What was drawn since the last look. */
static const char *drawn(void)
{
    static char text[400];
    struct pollfd wait = {screen, POLLIN, 0};
    size_t size = 0;

    while (size < sizeof text - 1 && poll(&wait, 1, 0) > 0) {
        const ssize_t n = read(screen, text + size, sizeof text - 1 - size);

        if (n <= 0) {
            break;
        }
        size += (size_t)n;
    }
    text[size] = '\0';
    return text;
}

static void check_drawn(const char *want)
{
    const char *text = drawn();

    CHECK(strcmp(text, want) == 0, "drew '%s', wanted '%s'", text, want);
}

/* Call it after so many milliseconds; want is what it draws. */
static void step(long ms, uint64_t done, uint64_t total, const char *want)
{
    now_ms += ms;
    cli_progress("label", done, total, false);
    check_drawn(want);
}

#define BAR_0   "................................"
#define BAR_10  "####............................"
#define BAR_25  "########........................"
#define BAR_50  "################................"
#define BAR_100 "################################"
#define DONE    "] 100 % "

TEST(a_bar_shows_its_part_and_the_time_that_is_left)
{
    open_terminal();
    step(0, 0, 8, "\rlabel [" BAR_0 "]   0 %             ");
    step(90, 1, 8, "");
    step(20, 1, 8, "\rlabel [" BAR_10 "]  12 %             ");
    step(380, 2, 8, "\rlabel [" BAR_25 "]  25 %             ");
    step(110, 2, 8, "\rlabel [" BAR_25 "]  25 % 0:01 left   "); /* 1.8 s */
    step(59400, 4, 8, "\rlabel [" BAR_50 "]  50 % 1:00 left   ");
    step(59, 5, 8, "");
    step(0, 8, 8, "\rlabel [" BAR_100 DONE "1:00        \n");
    close_terminal();
}

/* Seconds of two digits, minutes of any, none above a hundred hours. */
TEST(times_are_minutes_and_seconds)
{
    open_terminal();
    step(0, 0, 8, "\rlabel [" BAR_0 "]   0 %             ");
    step(9000, 4, 8, "\rlabel [" BAR_50 "]  50 % 0:09 left   ");
    step(3591000, 4, 8, "\rlabel [" BAR_50 "]  50 % 60:00 left  ");
    step(59999 * 6000 - 3600000, 4, 8,
            "\rlabel [" BAR_50 "]  50 % 5999:54 left");
    step(6000, 4, 8, "\rlabel [" BAR_50 "]  50 %             ");
    step(0, 8, 8, "\rlabel [" BAR_100 DONE "            \n");
    close_terminal();
}

static void set_columns(unsigned short columns)
{
    const struct winsize size = {.ws_row = 4, .ws_col = columns};

    (void)ioctl(screen, TIOCSWINSZ, &size);
}

/* A column is always left; what does not fit is left out: cells of the bar, the
 * bar, the label, the time. It may become wider or narrower meanwhile. */
TEST(a_bar_is_never_wider_than_the_terminal)
{
    open_terminal();
    set_columns(60);
    step(0, 2, 8,
            "\rlabel [########........................]  25 %             ");
    set_columns(59);
    step(600, 2, 8,
            "\rlabel [########.......................]  25 % 0:01 left   ");
    set_columns(32);
    step(600, 4, 8, "\rlabel [##..]  50 % 0:01 left   ");
    set_columns(31);
    step(200, 4, 8, "\rlabel  50 % 0:01 left   ");
    set_columns(25);
    step(200, 4, 8, "\rlabel  50 % 0:01 left   ");
    set_columns(24);
    step(200, 4, 8, "\r 50 % 0:01 left   ");
    set_columns(20);
    step(200, 4, 8, "\r 50 % 0:02 left   ");
    set_columns(6);
    step(200, 4, 8, "\r 50 %");
    set_columns(1);
    step(200, 4, 8, "\r");
    set_columns(20);
    step(200, 8, 8, "\r100 % 0:02        \n");
    close_terminal();
}

TEST(the_next_bar_begins_anew)
{
    open_terminal();
    step(0, 8, 8, "\rlabel [" BAR_100 DONE "0:00        \n");
    step(1, 2, 8, "\rlabel [" BAR_25 "]  25 %             ");
    step(7000, 8, 8, "\rlabel [" BAR_100 DONE "0:07        \n");
    step(1, 0, 0, "\rlabel [" BAR_100 DONE "0:00        \n"); /* of nothing */
    close_terminal();
}

TEST(numbers_of_64_bits_have_parts_too)
{
    const uint64_t whole = (uint64_t)1 << 40;

    open_terminal();
    step(0, 0, whole, "\rlabel [" BAR_0 "]   0 %             ");
    step(600, 0, whole, "\rlabel [" BAR_0 "]   0 %             ");
    step(200, whole / 4, whole, "\rlabel [" BAR_25 "]  25 % 0:02 left   ");
    step(200, whole - 1, whole, "\rlabel [" BAR_100 "]  99 % 0:00 left   ");
    step(0, whole, whole, "\rlabel [" BAR_100 DONE "0:01        \n");
    close_terminal();
}

TEST(nothing_is_drawn_where_nobody_looks)
{
    int ends[2];
    char byte;

    open_terminal();
    cli_progress("label", 1, 2, true);
    cli_progress("label", 2, 2, true);
    check_drawn("");
    CHECK(pipe(ends) == 0, "%s", "no pipe");
    (void)dup2(ends[1], STDERR_FILENO);
    cli_progress("label", 1, 2, false);
    cli_progress("label", 2, 2, false);
    (void)dup2(saved, STDERR_FILENO);
    close(ends[1]);
    CHECK(read(ends[0], &byte, 1) == 0, "%s", "a pipe got a bar");
    close(ends[0]);
    check_drawn("");
    close_terminal();
}

/* The bar stays, the message has a line of its own. */
TEST(messages_begin_below_the_bar)
{
    int status = 0;
    pid_t child;

    open_terminal();
    step(0, 4, 8, "\rlabel [" BAR_50 "]  50 %             ");
    cli_warn("%s", "one");
    check_drawn("\ntest_progress: warning: one\n");
    cli_warn("%s", "two");
    check_drawn("test_progress: warning: two\n");
    step(0, 4, 8, "\rlabel [" BAR_50 "]  50 %             ");
    (void)fflush(stdout);
    child = fork();
    if (child == 0) {
        cli_fail(CLI_INPUT, "%s", "three");
    }
    (void)waitpid(child, &status, 0);
    check_drawn("\ntest_progress: three\n");
    CHECK(WIFEXITED(status) && WEXITSTATUS(status) == CLI_INPUT, "status %d",
            status);
    step(0, 8, 8, "\rlabel [" BAR_100 DONE "0:00        \n");
    close_terminal();
}

int main(int argc, char **argv)
{
    cli_begin("test_progress");
    TEST_BEGIN("tools/test_progress", argc, argv);
    RUN(a_bar_shows_its_part_and_the_time_that_is_left);
    RUN(times_are_minutes_and_seconds);
    RUN(a_bar_is_never_wider_than_the_terminal);
    RUN(the_next_bar_begins_anew);
    RUN(numbers_of_64_bits_have_parts_too);
    RUN(nothing_is_drawn_where_nobody_looks);
    RUN(messages_begin_below_the_bar);
    return TEST_END();
}
