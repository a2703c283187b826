/* ql_test.h - the harness: one line a claim; failures say how to repeat */
/* SPDX-License-Identifier: MIT */

/* A test program is a list of claims:
 *
 *     TEST(zero_mass_entry_is_never_chosen)
 *     {
 *         for (...) {
 *             CHECK(i != 3, "u=%lu chose entry 3", u);
 *         }
 *         NOTE("%lu inputs", n);
 *     }
 *
 *     int main(int argc, char **argv)
 *     {
 *         TEST_BEGIN("unit/test_cdf", argc, argv);
 *         RUN(zero_mass_entry_is_never_chosen);
 *         return TEST_END();
 *     }
 *
 * Each claim prints "suite  claim  ok  note" or FAIL with the first failed
 * check, and the program's exit status is 1 if any failed. With an argument
 * only the claims whose name contains it run. */

#ifndef QL_TEST_H
#define QL_TEST_H

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static struct {
    const char *suite;
    const char *program;
    const char *only;
    unsigned passed, failed;
    unsigned long failures; /* of the running claim */
    char first[400];        /* its first failed check */
    char note[120];
} ql_test;

#define TEST(claim) static void test_##claim(void)

/* Check one fact; the message says the inputs, what came out, what should. */
#define CHECK(fact, ...)                                                       \
    do {                                                                       \
        if (!(fact)) {                                                         \
            ql_test_failed(__FILE__, __LINE__, #fact, __VA_ARGS__);            \
        }                                                                      \
    } while (0)

/* What the line of a passed claim says: how many inputs, which figure. */
#define NOTE(...) (void)snprintf(ql_test.note, sizeof ql_test.note, __VA_ARGS__)

#define TEST_BEGIN(suite_name, argc, argv)                                     \
    (ql_test.suite = (suite_name), ql_test.program = (argv)[0],                \
            ql_test.only = (argc) > 1 ? (argv)[1] : "")

/* How many of n random inputs are tried. The two builds of everything try all;
 * those of other gates, and those with sanitizers, one in QL_TEST_SHARE: the
 * gates change no bit of what is drawn, which tests/golden/some.sh shows. */
#ifndef QL_TEST_SHARE
#define QL_TEST_SHARE 1
#endif
#define MANY(n) ((n) / QL_TEST_SHARE)

/* The same of a loop through all inputs in steps of n: an odd number. */
#define STRIDE(n) ((n)*QL_TEST_SHARE | 1)

#define RUN(claim) ql_test_run(#claim, test_##claim)

/* A claim that is not true of every build: of which, the condition says. */
#define RUN_IF(condition, claim) ((condition) ? RUN(claim) : (void)0)

#define TEST_END() (ql_test.failed > 0 ? 1 : 0)

static void ql_test_failed(
        const char *file, int line, const char *fact, const char *format, ...)
{
    va_list args;
    int n;

    if (ql_test.failures++ > 0) {
        return;
    }
    n = snprintf(ql_test.first, sizeof ql_test.first, "%s:%d: %s: ", file, line,
            fact);
    va_start(args, format);
    if (n >= 0 && (size_t)n < sizeof ql_test.first) {
        (void)vsnprintf(ql_test.first + n, sizeof ql_test.first - (size_t)n,
                format, args);
    }
    va_end(args);
}

static void ql_test_run(const char *claim, void (*test)(void))
{
    if (strstr(claim, ql_test.only) == NULL) {
        return;
    }
    ql_test.failures = 0;
    ql_test.note[0] = '\0';
    test();
    if (ql_test.failures == 0) {
        ql_test.passed++;
        printf("%-20s %-52s ok   %s\n", ql_test.suite, claim, ql_test.note);
    } else {
        ql_test.failed++;
        printf("%-20s %-52s FAIL %lu checks; first: %s\n    repeat: %s %s\n",
                ql_test.suite, claim, ql_test.failures, ql_test.first,
                ql_test.program, claim);
    }
    (void)fflush(stdout);
}

#endif
