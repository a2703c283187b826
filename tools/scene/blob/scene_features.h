/* scene_features.h - which parts of the core a scene needs */
/* SPDX-License-Identifier: MIT */

#ifndef SCENE_FEATURES_H
#define SCENE_FEATURES_H

#include <stdio.h>

#include "scene/blob/model.h"

/* The QL_FEATURE_ bits of a scene.
 *
 *   model  -  its tables are filled in, and QL_FEATURE_TWO_SIDED if the scene
 *             asks for it
 */
uint32_t features_of(const model_t *model);

/* Write a header of QL_CFG_ gates that builds exactly what a scene needs.
 *
 *   file   -  open for writing
 *   model  -  complete
 */
void features_write(FILE *file, const model_t *model);

#endif
