/* ql_blob_open.h - check a blob completely, once, and open it */
/* SPDX-License-Identifier: MIT */

#ifndef QL_BLOB_OPEN_H
#define QL_BLOB_OPEN_H

#include "scene/ql_scene.h"

QL_C_BEGIN

/* Links with a core of the same gates only (ql_config.h). */
#define ql_blob_open QL_GATED(ql_blob_open)

/* Check a scene blob and open a read-only view of it, in place.
 *
 *   scene   -      out: the view; all zero if this fails
 *   blob    -      start of the blob, 4-byte aligned; flash is fine
 *   size    bytes  bytes readable at blob
 *   return  QL_OK, or the first reason found:
 *           QL_ERR_ALIGN      blob is not 4-byte aligned
 *           QL_ERR_MAGIC      not a qlux blob
 *           QL_ERR_VERSION    another version of the format (see BLOB.md)
 *           QL_ERR_TRUNCATED  the blob says it is longer than size
 *           QL_ERR_CHECKSUM   contents changed since qlux-scene wrote them
 *           QL_ERR_FEATURE    needs a feature this build lacks, see
 *                             ql_blob_missing()
 *           QL_ERR_RANGE      an offset, index, count or value is outside its
 *                             table or limit
 *           QL_ERR_CAPACITY   deeper than QL_CFG_BVH_STACK
 *
 * Every offset, index, count and enum is checked here, once. Code in trace/ and
 * render/ relies on that and checks nothing again. The length of a normal is
 * checked in builds that use it (QL_UNIT_NORMALS).
 *
 * Memory: copies nothing; the blob must stay mapped and unchanged while in use.
 * Cost:   one pass over the blob.
 */
QL_MUST_CHECK ql_status_t ql_blob_open(
        ql_scene_t *scene, const void *blob, size_t size);

/* Name the first feature that a blob needs and this build lacks.
 *
 *   blob    -      as for ql_blob_open(), which returned QL_ERR_FEATURE
 *   return  the feature's name, "unknown" for a bit without one; "" if none
 */
const char *ql_blob_missing(const void *blob);

QL_C_END

#endif
