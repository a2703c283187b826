/* notes.c - what a reader leaves out of a file, said once and counted */
/* SPDX-License-Identifier: MIT */

#include "scene/foreign/notes.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/program/alloc.h"
#include "lib/program/cli.h"

/* The note that a message counts for: that of the same message, or that of the
 * rest of its kind. NULL: a new one is needed, and *of_kind are there. */
static note_t *find_note(const notes_t *notes, const char *kind,
        const char *message, unsigned *of_kind)
{
    note_t *rest = NULL;

    *of_kind = 0;
    for (size_t i = 0; i < notes->count; i++) {
        note_t *note = notes->notes + i;

        if (strcmp(note->kind, kind) != 0) {
            continue;
        }
        if (note->message == NULL) {
            rest = note;
        } else if (strcmp(note->message, message) == 0) {
            return note;
        }
        ++*of_kind;
    }
    return rest;
}

void notes_add(notes_t *notes, unsigned line, const char *kind,
        const char *format, ...)
{
    char message[512];
    va_list arguments;
    unsigned of_kind;
    note_t *note;

    if (notes->quiet) {
        return;
    }
    va_start(arguments, format);
    (void)vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    note = find_note(notes, kind, message, &of_kind);
    if (note == NULL) {
        notes->notes = alloc_grow(notes->notes, notes->count, &notes->capacity,
                sizeof *notes->notes);
        note = notes->notes + notes->count++;
        note->kind = kind;
        note->message = of_kind < NOTES_MOST
                                ? alloc_text(message, strlen(message))
                                : NULL;
        note->line = line;
        note->count = 0;
    }
    note->count++;
}

static void report_note(const notes_t *notes, const note_t *note)
{
    char times[40] = "";

    if (note->message == NULL) {
        cli_warn("%s:%u: %s: %zu more from this line on", notes->path,
                note->line, note->kind, note->count);
        return;
    }
    if (note->count > 1) {
        (void)snprintf(times, sizeof times, " (%zu times)", note->count);
    }
    cli_warn("%s:%u: %s%s", notes->path, note->line, note->message, times);
}

void notes_report(notes_t *notes)
{
    for (size_t i = 0; i < notes->count; i++) {
        const char *kind = notes->notes[i].kind;

        for (size_t k = i; k < notes->count && kind != NULL; k++) {
            note_t *note = notes->notes + k;

            if (note->kind != NULL && strcmp(note->kind, kind) == 0) {
                report_note(notes, note);
                note->kind = NULL; /* reported */
            }
        }
    }
    for (size_t i = 0; i < notes->count; i++) {
        free(notes->notes[i].message);
    }
    free(notes->notes);
    notes->notes = NULL;
    notes->count = notes->capacity = 0;
}
