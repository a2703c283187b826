/* sky_share.h - how often the sky is chosen among the lights */
/* SPDX-License-Identifier: MIT */

#ifndef SKY_SHARE_H
#define SKY_SHARE_H

#include "scene/blob/model.h"

/* Are there a sky and surfaces that shine? */
bool sky_share_matters(const model_t *model);

/* Choose the sky with the chance 1 / n, other lights as often as before in
 * comparison with each other.
 *
 *   model  -  changed: cum and weights of its lights; sky_share_matters()
 *   n      -  2 or more
 *
 * The chances are quantised as build_lights() does, none is 0, and the weights
 * are theirs: no picture changes its mean.
 */
void sky_share_set(model_t *model, unsigned n);

#endif
