/* text.h - lines and words of a text file, errors with file and line */
/* SPDX-License-Identifier: MIT */

/* Lines may end in LF, CR LF or CR; a backslash before the end continues them,
 * with blanks behind it or without. A '#' at the start of a word begins a
 * comment, unless the line's key is one whose lines are kept whole. Words are
 * separated by blanks and tabs. */

#ifndef TEXT_H
#define TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "lib/files/kind.h"
#include "scene/foreign/notes.h"

typedef struct {
    const char *path;         /* for messages */
    char *data;               /* the whole file; words point into it */
    char *next;               /* first character not read yet */
    char *rest;               /* what is left of the line */
    char *end;                /* of the file */
    unsigned line;            /* number of the line, from 1 */
    unsigned next_line;       /* of the first character not read yet */
    notes_t *notes;           /* of a file of another program; or NULL */
    const char *const *whole; /* keys whose lines keep a '#'; or NULL */
} text_t;

/* Read a whole file, of a kind. Fails with exit 3 if it cannot be read, 2 if it
 * is not text, or known to be of another kind. path must outlive the text. */
void text_open(text_t *text, const char *path, kind_t wanted);

/* Read a text that is in memory, malloc'd, as if it were the file at a path;
 * text_close() frees it. */
void text_of(text_t *text, const char *path, char *data);

/* Read an OBJ or MTL file, which may have what foreign_clean() takes.
 *
 *   text   -  out
 *   path   -  must outlive the text
 *   notes  -  in, out: what is noted of the file; must outlive the text
 *   whole  -  keys whose lines are kept whole, NULL at the end: names that may
 *             have a '#'
 */
void text_open_foreign(text_t *text, const char *path, notes_t *notes,
        const char *const *whole);

/* Free it. */
void text_close(text_t *text);

/* Go to the next line that is not empty; false at the end of the file. */
bool text_line(text_t *text);

/* The next word of the line, zero-terminated; NULL at its end. */
char *text_word(text_t *text);

/* All that is left of the line without blanks around it; NULL if nothing is. */
char *text_rest(text_t *text);

/* The next word as a finite number. Fails naming what was expected. */
double text_number(text_t *text, const char *what);

/* The next word as a coordinate: a number, or NAN for what is no finite one, as
 * "nan", "-inf" and "1.#QNAN". Fails as text_number() does. */
double text_coordinate(text_t *text, const char *what);

/* Is the next word a finite number? Then *value is set. */
bool text_try_number(text_t *text, double *value);

/* The next word as an integer in [min, max], decimal or 0x. Fails as
 * text_number() does. */
int64_t text_integer(text_t *text, const char *what, int64_t min, int64_t max);

/* Fail unless the line is at its end. */
void text_finish(text_t *text);

/* End a name from a line that was kept whole where the last comment may begin:
 * at a '#' that begins a word. False if there is none. */
bool text_cut_comment(char *name);

/* Is a name the other, but for comments behind them? Here a comment begins with
 * a '#' that is a word of its own: "Material #1" is a name. */
bool text_is_same_name(const char *name, const char *other);

/* Print what is noted, then "program: file:line: message", and exit 2. */
#if defined(__GNUC__)
__attribute__((noreturn, format(printf, 2, 3)))
#endif
void text_fail(const text_t *text, const char *format, ...);

/* name as seen from the folder that path is in; malloc'd. */
char *text_beside(const char *path, const char *name);

#endif
