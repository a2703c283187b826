/* notes.h - what a reader leaves out of a file, said once and counted */
/* SPDX-License-Identifier: MIT */

#ifndef NOTES_H
#define NOTES_H

#include <stdbool.h>
#include <stddef.h>

/* A message that came count times, first in a line. message is NULL for those
 * of a kind beyond NOTES_MOST. */
typedef struct {
    const char *kind;
    char *message;
    unsigned line;
    size_t count;
} note_t;

/* The notes of one file. All zero but the path is none. */
typedef struct {
    const char *path; /* for messages */
    note_t *notes;
    size_t count, capacity;
    bool quiet; /* nothing is taken down */
} notes_t;

#define NOTES_MOST 10 /* different messages of a kind; the rest are counted */

/* Take down a message; one that is there already is counted.
 *
 *   notes   -  in, out
 *   line    -  of the file, from 1
 *   kind    -  what the message is about, in words; it must outlive the notes
 *   format  -  the message, as printf() has it
 */
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
void notes_add(notes_t *notes, unsigned line, const char *kind,
        const char *format, ...);

/* Print the notes as warnings, kind by kind, with file, line and count; then
 * there are none. */
void notes_report(notes_t *notes);

#endif
