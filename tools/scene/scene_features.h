/* scene_features.h - the gates of a core for one scene */
/* SPDX-License-Identifier: MIT */

#ifndef SCENE_FEATURES_H
#define SCENE_FEATURES_H

#include <stdio.h>

#include "scene/blob/model.h"

/* Write a header of QL_CFG_ gates that builds exactly what a scene needs.
 *
 *   file   -  open for writing
 *   model  -  complete
 */
void write_features(FILE *file, const model_t *model);

#endif
