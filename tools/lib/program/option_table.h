/* option_table.h - what a program takes, as one table of its options */
/* SPDX-License-Identifier: MIT */

#ifndef OPTION_TABLE_H
#define OPTION_TABLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What an option takes, and the type of the field it is stored in. */
typedef enum {
    OPTION_FLAG,   /* bool: true if given; takes no value */
    OPTION_TEXT,   /* const char * */
    OPTION_FILE,   /* const char *; ends in one of the words, if it has any */
    OPTION_LIST,   /* option_list_t; given any number of times */
    OPTION_LABEL,  /* option_list_t, an argument: LABEL=IN, and a label may
                        begin with '-' */
    OPTION_WORD,   /* unsigned integer of any size: which of the words */
    OPTION_NUMBER, /* unsigned integer of any size, min to max */
    OPTION_REAL,   /* double, min to max; a max of HUGE_VAL is none. With words
                       also the first of them, which is HUGE_VAL */
    OPTION_POSITIVE, /* double, above 0 and finite */
    OPTION_SIZE,     /* option_size_t: WxH, both min to max */
    OPTION_RANGE     /* option_range_t: A:B, min <= A < B <= max */
} option_kind_t;

/* What was given, in the order of the command line; items lies in memory that
 * is never freed. */
typedef struct {
    const char **items;
    unsigned count;
} option_list_t;

typedef struct {
    uint32_t width;
    uint32_t height;
} option_size_t;

/* first to end - 1. */
typedef struct {
    uint32_t first;
    uint32_t end;
} option_range_t;

/* An option, or an argument: those fill up in the order of their list. */
typedef struct {
    const char *name; /* with its value: "--spp N"; or "SCENE.qlb" */
    option_kind_t kind;
    struct {
        size_t at, bytes;
    } field;                  /* OPTION_FIELD() */
    const char *help;         /* NULL: --help does not list it; what is taken
                                 is told before a semicolon, or at the end */
    const char *preset;       /* what holds otherwise, in words; NULL: what the
                                 field of a word or a number held before */
    const char *const *words; /* NULL ends them */
    double min, max;          /* whole for whole numbers, 0 to 2^32 - 1 */
    bool required;
} option_t;

/* Where an option of a program is stored: a field of its struct. */
#define OPTION_FIELD(type, field)                                              \
    {                                                                          \
        offsetof(type, field), sizeof(((type *)0)->field)                      \
    }

/* Behind the last of a list. */
#define OPTION_END                                                             \
    {                                                                          \
        .name = NULL                                                           \
    }

/* Options under a title of their own, or NULL. A section without options ends
 * a list of sections. */
typedef struct {
    const char *title;
    const option_t *options;
} option_section_t;

/* A program, for its help. In usage and notes each line stands for itself, is
 * wrapped if it is long, and is two columns if it has a tab. */
typedef struct {
    const char *name;
    const char *about; /* "qlux-x: about" */
    const char *usage; /* a line for each form, without the program's name */
    const option_section_t *sections;
    const char *notes;   /* or NULL */
    const char *exits;   /* what exit codes mean here besides, or NULL */
    const char *example; /* lines, printed as they are */
} program_t;

#endif
