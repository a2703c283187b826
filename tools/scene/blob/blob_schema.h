/* blob_schema.h - every struct and table of a blob, described once */
/* SPDX-License-Identifier: MIT */

/* Writing, reading, dumping and parsing a blob all walk these descriptions. A
 * new field needs a member of its struct in ql_blob.h, a row in blob_schema.c
 * and a row of BLOB.md. Without its row it does not compile; a test compares
 * rows with BLOB.md. */

#ifndef BLOB_SCHEMA_H
#define BLOB_SCHEMA_H

#include <stddef.h>

#include "scene/ql_blob.h"

typedef ql_blob_node16_t blob_pair16_t[2];

/* The tables in the order of the blob: name, entry, features. A table is there
 * if one of its features is set, or if it has none. */
#define BLOB_TABLE_LIST(X)                                                     \
    X(camera, ql_blob_camera_t, 0)                                             \
    X(vertices, ql_blob_vertex_t, 0)                                           \
    X(triangles, ql_blob_tri_t, 0)                                             \
    X(pairs16, blob_pair16_t, QL_FEATURE_NODE16)                               \
    X(pairs8, ql_blob_pair8_t, QL_FEATURE_NODE8)                               \
    X(materials, ql_blob_material_t, 0)                                        \
    X(lights, ql_blob_light_t, 0)                                              \
    QL_BLOB_OPTIONAL_LIST(X)

enum {
#define BLOB_TABLE_ENUM(name, type, features) BLOB_TABLE_##name,
    BLOB_TABLE_LIST(BLOB_TABLE_ENUM)
#undef BLOB_TABLE_ENUM
            BLOB_TABLE_COUNT
};

/* Kinds of numbers: name, bytes. An X says how a dump shows the number. */
#define BLOB_KIND_LIST(X)                                                      \
    X(U8, 1)                                                                   \
    X(U16, 2)                                                                  \
    X(S16, 2) /* signed */                                                     \
    X(X16, 2) /* hexadecimal */                                                \
    X(U32, 4)                                                                  \
    X(X32, 4)      /* hexadecimal */                                           \
    X(WIDE, 8)     /* s31.32 as {low, high} */                                 \
    X(FEATURES, 4) /* QL_FEATURE_ bits; names in a dump */                     \
    X(PLACE, 8)    /* a ql_blob_table_t, written with the table itself */

typedef enum {
#define BLOB_KIND_ENUM(name, bytes) BLOB_##name,
    BLOB_KIND_LIST(BLOB_KIND_ENUM)
#undef BLOB_KIND_ENUM
} blob_kind_t;

/* A field: count numbers in a row. Where a dump shows some bits of a number by
 * themselves, a row of this part follows the row of the number. */
typedef struct {
    const char *name; /* as in ql_blob.h */
    uint16_t offset;  /* bytes from the start of the struct */
    uint8_t kind;     /* blob_kind_t */
    uint8_t count;
    uint8_t shift, bits; /* of a part; bits 0: not a part */
    uint8_t gap;         /* blanks before it in a dump; 0: not shown */
    const char *key;     /* begins a line of the dump; NULL: goes on with it */
    const char *what;    /* its name in messages */
} blob_field_t;

/* A struct: fields in the order of a dump. */
typedef struct {
    const blob_field_t *fields;
    unsigned field_count;
    size_t bytes;
} blob_struct_t;

typedef struct {
    const char *name;
    blob_struct_t entry;
    unsigned repeat;    /* such structs make an entry */
    unsigned per_line;  /* entries on a line of a dump */
    uint32_t count_min; /* entries, if the table is there */
    uint32_t count_max; /* 1: the lines of a dump may have any order */
    uint32_t features;  /* as in BLOB_TABLE_LIST */
    const char *title;  /* in a dump, after the count if there may be several */
} blob_table_t;

/* Where the places of the tables begin: one for each table that is there. */
#define BLOB_PLACES_FROM offsetof(ql_blob_header_t, camera)

extern const blob_struct_t blob_place; /* a ql_blob_table_t */
extern const blob_table_t blob_header; /* one entry, in no list of tables */
extern const blob_table_t blob_tables[BLOB_TABLE_COUNT];

/* Is a table in the blob of a scene that has these features? */
bool blob_has_table(const blob_table_t *table, uint32_t features);

/* Bytes of an entry, below 2^8. */
uint64_t blob_entry_bytes(const blob_table_t *table);

/* Bytes of one number of a field. */
unsigned blob_number_bytes(const blob_field_t *field);

/* Bytes that the field itself has in a blob: none for a part or a PLACE. */
unsigned blob_field_bytes(const blob_field_t *field);

/* Number i of a field, or the part of it.
 *
 *   field   -  describes it
 *   from    -  the struct, in the byte order of this machine
 *   i       -  0 to count - 1
 *   return  its bits: of WIDE and PLACE the second word is in 32..63
 */
uint64_t blob_get(const blob_field_t *field, const void *from, unsigned i);

/* Set number i of a field, or the part of it, to the low bits of value; the
 * rest of the number stays. Parameters are those of blob_get(). */
void blob_set(const blob_field_t *field, void *to, unsigned i, uint64_t value);

#endif
