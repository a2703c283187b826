/* kind.h - what a file is that is not what a program wants, and what to do */
/* SPDX-License-Identifier: MIT */

#ifndef KIND_H
#define KIND_H

#include <stddef.h>

/* What a file may be. A program wants one of the first nine. */
typedef enum {
    KIND_SCENE, /* a .scene; an OBJ or a dump serves as well */
    KIND_MODEL, /* an OBJ or MTL, which may be hard to tell */
    KIND_SKY,   /* a PFM or a Radiance picture */
    KIND_TEXT,  /* weights */
    KIND_BLOB,
    KIND_SUMS,
    KIND_PICTURE, /* PPM, PFM or PNG */
    KIND_STREAM,  /* of a board's serial port */
    KIND_TABLE,   /* of qlux-trade */
    KIND_OBJ,
    KIND_MTL,
    KIND_DUMP,
    KIND_PFM,
    KIND_RADIANCE,
    KIND_OTHER_PICTURE, /* JPEG and so on */
    KIND_OTHER_MODEL,   /* STL and so on */
    KIND_PACKED,        /* zip and so on */
    KIND_OTHER_TEXT,    /* UTF-16 */
    KIND_UNKNOWN
} kind_t;

/* If a file is known as something else than what is wanted, say so in a line
 * that tells what to do, and exit 2; else return. Contents decide, then the end
 * of the name.
 *
 *   path    -  of the file, for the message and for its name
 *   data    -  what it begins with
 *   size    -  bytes of that
 *   wanted  -  what the program reads
 */
void kind_refuse(
        const char *path, const void *data, size_t size, kind_t wanted);

/* The same of a file that is not in memory; what is no file is not refused. */
void kind_refuse_file(const char *path, kind_t wanted);

#endif
