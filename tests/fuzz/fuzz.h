/* fuzz.h - one input of a format, as a program takes it, in this process */
/* SPDX-License-Identifier: MIT */

#ifndef FUZZ_H
#define FUZZ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "scene/ql_scene.h"

/* Every format has a file formats/fuzz_NAME.c with its function. */
#define FUZZ_LIST(X)                                                           \
    X(blob)                                                                    \
    X(deflate)                                                                 \
    X(dump)                                                                    \
    X(image)                                                                   \
    X(mtl)                                                                     \
    X(obj)                                                                     \
    X(scene)                                                                   \
    X(sky)                                                                     \
    X(stream)                                                                  \
    X(sums)                                                                    \
    X(table)

/* Take the bytes of a file. What is wrong in them may end in cli_fail(). */
typedef void fuzz_take_t(const uint8_t *data, size_t size);
#define FUZZ_FUNCTION(name) fuzz_take_t fuzz_##name;
FUZZ_LIST(FUZZ_FUNCTION)
#undef FUZZ_FUNCTION

/* A format by its name; NULL if there is none of it. */
fuzz_take_t *fuzz_format(const char *name);

/* Take an input to its end, or to the exit() of a program that refuses it. Then
 * what it allocated is freed; a process that ends does so. Memory that is still
 * there at the function's own end is a leak: it is reported, and abort(). An
 * input gets FUZZ_MEMORY bytes. */
void fuzz_run(fuzz_take_t *take, const uint8_t *data, size_t size);
#define FUZZ_MEMORY ((size_t)64 << 20)

/* For the rest of the input there is a file of this name, and no other that was
 * not named so. data must stay. */
void fuzz_file(const char *name, const void *data, size_t size);

/* The same of a text. */
void fuzz_text(const char *name, const char *text);

/* Write to memory: one file at a time, and what came of it, to be freed. */
FILE *fuzz_open(void);
uint8_t *fuzz_close(size_t *size);

/* A claim about the program; a false one is reported, and abort(). */
#define FUZZ_CHECK(claim) ((claim) ? (void)0 : fuzz_broken(#claim))
void fuzz_broken(const char *claim);

/* Render a few pixels by every estimator: whatever the core has opened, it can
 * draw. */
void fuzz_draw(const ql_scene_t *scene);

/* Compile the file "s.scene" with nodes of both widths, open what comes of it;
 * draw the one of 16 bits. */
void fuzz_compile(void);

/* Compile the scene that the file "m.obj" stands for; draw it. */
void fuzz_compile_bare(bool is_up_z);

#endif
