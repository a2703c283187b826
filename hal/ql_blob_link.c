/* ql_blob_link.c - the scene of a board whose blob is linked into its flash */
/* SPDX-License-Identifier: MIT */

#include "ql_hal.h"

/* ql_blob_data.S; the last byte is the one before ql_blob_end. As words, which
 * a compiler that sees this far takes for their alignment. */
extern const uint32_t ql_blob_begin[];
extern const uint32_t ql_blob_end[];

void ql_hal_scene_blob(const void **blob, size_t *size)
{
    *blob = ql_blob_begin;
    *size = sizeof(uint32_t) * (size_t)(ql_blob_end - ql_blob_begin);
}
