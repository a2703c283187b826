/* parse_dump.h - the text of a dump back to a model */
/* SPDX-License-Identifier: MIT */

#ifndef PARSE_DUMP_H
#define PARSE_DUMP_H

#include "scene/blob/model.h"
#include "scene/read/text.h"

/* Does a text begin as a dump does? Leaves it at its start. */
bool is_dump(const text_t *text);

/* Read a dump.
 *
 *   model  -  out; model_free() it
 *   text   -  open and at its start; is_dump()
 *
 * Fails: exit 2 with file and line of a number that is missing or does not fit
 *        its field. Whether the blob makes sense, ql_blob_open() says.
 */
void parse_dump(model_t *model, text_t *text);

#endif
