/* assert_fail.c - a broken claim of the core ends the test program */
/* SPDX-License-Identifier: MIT */

#include <stdio.h>
#include <stdlib.h>

#include "base/ql_base.h"

#if QL_CFG_ASSERT
void ql_assert_fail(const char *file, int line, const char *claim)
{
    fprintf(stderr, "%s:%d: broken claim: %s\n", file, line, claim);
    abort();
}
#else
typedef int assert_fail_unused; /* C wants a declaration */
#endif
