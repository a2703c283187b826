/* ql_status.c - status code to text; left out of small builds */
/* SPDX-License-Identifier: MIT */

#include "base/ql_base.h"

const char *ql_status_text(ql_status_t status)
{
    switch (status) {
#define QL_STATUS_TEXT(name, number, text)                                     \
    case name:                                                                 \
        return text;
        QL_STATUS_LIST(QL_STATUS_TEXT)
#undef QL_STATUS_TEXT
    default:
        return "unknown status";
    }
}
