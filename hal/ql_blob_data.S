/* ql_blob_data.S - the scene blob, 4-byte aligned, in flash */
/* SPDX-License-Identifier: MIT */

    .section .rodata.ql_blob, "a"
    .balign 4
    .global ql_blob_begin
    .global ql_blob_end
ql_blob_begin:
    .incbin QL_BLOB_FILE
    .balign 4
ql_blob_end:

#ifdef __linux__
    .section .note.GNU-stack, "", %progbits
#endif
