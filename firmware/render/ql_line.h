/* ql_line.h - settings of a picture; render one pixel or one scanline */
/* SPDX-License-Identifier: MIT */

#ifndef QL_LINE_H
#define QL_LINE_H

#include "film/ql_clamp.h"
#include "film/ql_film.h"
#include "film/ql_tonemap.h"
#include "scene/ql_camera.h"
#include "base/ql_settings.h"

QL_C_BEGIN

/* They link with a core of the same gates only (ql_config.h). */
#define ql_render_init     QL_GATED(ql_render_init)
#define ql_render_meter    QL_GATED(ql_render_meter)
#define ql_render_pixel    QL_GATED(ql_render_pixel)
#define ql_render_adaptive QL_GATED(ql_render_adaptive)
#define ql_render_encode   QL_GATED(ql_render_encode)
#define ql_render_line     QL_GATED(ql_render_line)

/* A scene made ready to render with some settings. */
typedef struct {
    const ql_scene_t *scene;
    ql_settings_t settings;
    ql_camera_t camera;
    ql_real_t exposure; /* display value of one radiance unit */
    ql_diag_t diag;     /* counters; zeroed by ql_render_init() */
    QL_IF_BUILT(QL_CFG_CLAMP, ql_clamp_t clamp;) /* likewise what it cut */
} ql_render_t;

/* One encoding of a scanline that ql_render_line() writes. */
typedef struct {
    ql_format_t format;
    uint8_t *pixels; /* QL_LINE_BYTES(width, format) bytes */
} ql_output_t;

/* Make a scene ready to render.
 *
 *   render    -  out: all zero if this fails
 *   scene     -  from ql_blob_open(); must outlive render
 *   settings  -  copied; what they leave to the scene is filled in (ql_auto.h).
 *                With meter exposure_q8 becomes what was metered and what it
 *                was
 *   return    QL_OK, or QL_ERR_SETTINGS: a field outside its range, or one
 *             that needs a part this build lacks (ql_config.h)
 */
QL_MUST_CHECK ql_status_t ql_render_init(ql_render_t *render,
        const ql_scene_t *scene, const ql_settings_t *settings);

/* Meter the exposure: by two samples of four pixels in each of 64 cells.
 *
 *   render  -     from ql_render_init(); its counters begin again
 *   return  s7.8  stops brighter than the scene's exposure, within 64
 *
 * A function of blob and settings, spp and exposure left out: parts of a
 * picture, and those with more samples, have the same. Cost: 512 paths.
 */
#if QL_CFG_METER
int16_t ql_render_meter(ql_render_t *render);
#else
QL_INLINE int16_t ql_render_meter(ql_render_t *render)
{
    return (void)render, 0;
}
#endif

/* Add samples of one pixel to its sums.
 *
 *   render  -   from ql_render_init()
 *   x, y    px  0..width-1 from the left, 0..height-1 from the top
 *   first   -   index of the first sample, 0..2^24-1
 *   count   -   how many; first + count <= 2^24
 *   sum     u40.24 radiance units of the blob: linear RGB, added to, saturating
 *
 * Exact: sums of integers, so any split of the samples adds up to the same
 * bits. A picture of n samples is first = 0, count = n.
 */
void ql_render_pixel(ql_render_t *render, uint16_t x, uint16_t y,
        uint32_t first, uint32_t count, ql_sum_t *sum);

/* Render one pixel until its error is small enough (ql_adaptive.h).
 *
 *   render  -       from ql_render_init(); error_q16 0 asks for all samples
 *   x, y    px      as above
 *   sum     u40.24  out: its mean times the samples returned
 *   return  -       how many samples were taken: QL_ADAPTIVE_MIN times a power
 *                   of two, or spp, an odd one left out; spp if that is less
 *
 * A function of (blob, settings, x, y). The error is estimated from single
 * samples: with Sobol points, which vary less together, it is overestimated.
 */
#if QL_CFG_ADAPTIVE
uint32_t ql_render_adaptive(
        ql_render_t *render, uint16_t x, uint16_t y, ql_sum_t *sum);
#else
QL_INLINE uint32_t ql_render_adaptive(
        ql_render_t *render, uint16_t x, uint16_t y, ql_sum_t *sum)
{
    sum->rgb[0] = sum->rgb[1] = sum->rgb[2] = 0;
    ql_render_pixel(render, x, y, 0, render->settings.spp, sum);
    return render->settings.spp;
}
#endif

/* Encode one pixel from its sums.
 *
 *   render   -   from ql_render_init(): exposure
 *   x, y     px  position
 *   sum      -   its sums
 *   samples  -   how many samples they hold; 0 gives black
 *   outputs  -   array of count encodings, each with its own line of pixels
 *   count    -   1 or more
 */
void ql_render_encode(const ql_render_t *render, uint16_t x, uint16_t y,
        const ql_sum_t *sum, uint32_t samples, const ql_output_t *outputs,
        uint8_t count);

/* Render one scanline in one or more encodings.
 *
 *   render   -   from ql_render_init()
 *   y        px  0..height-1 from the top; any order gives the same bits
 *   outputs  -   array of count encodings, each with its own pixels
 *   count    -   1 or more
 */
void ql_render_line(ql_render_t *render, uint16_t y, const ql_output_t *outputs,
        uint8_t count);

QL_C_END

#endif
