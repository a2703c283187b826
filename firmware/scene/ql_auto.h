/* ql_auto.h - what settings leave to the scene */
/* SPDX-License-Identifier: MIT */

#ifndef QL_AUTO_H
#define QL_AUTO_H

#include "base/ql_settings.h"
#include "scene/ql_blob.h"

/* Fill in the scene's own size, and what AUTO stands for.
 *
 *   settings  -  width, height, direct, lights may change
 *   header    -  of a blob that was opened
 */
QL_INLINE void ql_auto_resolve(
        ql_settings_t *settings, const ql_blob_header_t *header)
{
    if (settings->width == 0) {
        settings->width = QL_LE16(header->image_width);
    }
    if (settings->height == 0) {
        settings->height = QL_LE16(header->image_height);
    }
    if (settings->direct == QL_DIRECT_AUTO) {
        settings->direct = header->auto_direct;
    }
    if (settings->lights == QL_LIGHTS_AUTO) {
        settings->lights = header->auto_lights;
    }
}

#endif
