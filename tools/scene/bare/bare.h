/* bare.h - the .scene that an OBJ alone stands for */
/* SPDX-License-Identifier: MIT */

#ifndef BARE_H
#define BARE_H

#include <stdbool.h>

#include "scene/read/text.h"

typedef struct {
    const char *path;   /* of the OBJ */
    const char *beside; /* the .scene to be written, or NULL: beside the OBJ */
    bool is_up_z;
    bool floor; /* the model stands on one */
} bare_t;

/* Is a file an OBJ? It is by its name, or by the first word of its text. */
bool bare_is_name(const char *path);
bool bare_is_text(const text_t *text);

/* Describe a scene that shows all of an OBJ.
 *
 * The camera stands in front (at +z; of files whose up is z at -y), 30 degrees
 * to the right and 20 above. If it sees few fronts there, and nearly only
 * fronts in a straight view from the front, the back, the right or the left,
 * the model is a room that is open to there, and that is the view. If backs are
 * seen from everywhere and something shines, it is a closed room with the
 * camera inside. A soft sky shines if nothing does, on an object a lamp too.
 *
 *   return  the text; free() it
 *
 * Fails: exit 2 if the OBJ is wrong or has no face with an area; exit 3 if it
 *        cannot be read.
 */
char *bare_describe(const bare_t *bare);

#endif
