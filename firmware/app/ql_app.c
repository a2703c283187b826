/* ql_app.c - the product loop: open the scene, render lines, send and show */
/* SPDX-License-Identifier: MIT */

#include "app/ql_app.h"

#if QL_CFG_PANEL
/* Where the picture lies on the panel, in one dimension: the picture's pixel
 * crop is the first one shown, at the panel's pixel pad. One of them is 0. */
typedef struct {
    uint16_t crop;
    uint16_t pad;
} place_t;
#endif

/* What a run carries from line to line. */
typedef struct {
    ql_render_t render;
    uint8_t *frame;
    uint32_t ticks;
#if QL_CFG_PANEL
    ql_hal_display_t panel;
    uint8_t *panel_pixels;     /* the picture's line in the panel's format */
    const uint8_t *panel_line; /* what the panel shows of it */
    place_t x, y;
#endif
} run_t;

#if QL_CFG_PANEL
/* Centre. Even numbers keep pairs of pixels together where two share a byte. */
static place_t centre(uint16_t picture, uint16_t panel)
{
    place_t place = {0, 0};

    if (picture > panel) {
        place.crop = (uint16_t)((picture - panel) / 2u & ~1u);
    } else {
        place.pad = (uint16_t)((panel - picture) / 2u & ~1u);
    }
    return place;
}

/* Give the panel its part of the working memory, and blank it. */
static ql_status_t panel_begin(run_t *run, const ql_app_t *app)
{
    const uint16_t width = run->render.settings.width;
    const size_t frame_bytes = QL_APP_FRAME_BYTES(width);
    ql_status_t status = QL_OK;

    ql_hal_display_info(&run->panel);
    if (app->work_bytes <
            QL_WORK_BYTES(width, run->panel.width, run->panel.format)) {
        return QL_ERR_SETTINGS;
    }
    if (run->panel.width == 0) {
        return QL_OK;
    }
    if ((QL_CFG_FORMATS >> run->panel.format & 1) == 0) {
        return QL_ERR_DISPLAY;
    }
    run->x = centre(width, run->panel.width);
    run->y = centre(run->render.settings.height, run->panel.height);
    run->panel_pixels = run->frame + frame_bytes +
                        QL_LINE_BYTES(run->x.pad, run->panel.format);
    run->panel_line = run->frame + frame_bytes +
                      QL_LINE_BYTES(run->x.crop, run->panel.format);
    for (uint16_t row = 0; row < run->panel.height && status == QL_OK; row++) {
        status = ql_hal_display_write(row, run->frame + frame_bytes);
    }
    return status;
}

/* Show line y on the panel, and in place of the count - 1 lines below it, which
 * are still to come. */
static ql_status_t show(const run_t *run, uint16_t y, uint16_t count)
{
    ql_status_t status = QL_OK;
    uint16_t row;

    if (run->panel.width == 0) {
        return QL_OK;
    }
    for (; count > 0 && status == QL_OK; count--, y++) {
        if (y < run->y.crop || y >= run->render.settings.height) {
            continue;
        }
        row = (uint16_t)(y - run->y.crop + run->y.pad);
        if (row < run->panel.height) {
            status = ql_hal_display_write(row, run->panel_line);
        }
    }
    return status;
}
#endif

/* Divide the working memory. */
static ql_status_t set_up(run_t *run, const ql_app_t *app)
{
    if ((QL_CFG_FORMATS >> QL_FORMAT_RGB888 & 1) == 0) {
        return QL_ERR_SETTINGS;
    }
#if QL_CFG_PANEL
    return panel_begin(run, app);
#else
    return app->work_bytes < QL_APP_FRAME_BYTES(run->render.settings.width)
                   ? QL_ERR_SETTINGS
                   : QL_OK;
#endif
}

static ql_status_t render_line(run_t *run, uint16_t y, uint16_t rows)
{
    const uint16_t bytes = (uint16_t)QL_LINE_BYTES(
            run->render.settings.width, QL_FORMAT_RGB888);
    const uint32_t before = ql_hal_ticks();
    const ql_output_t outputs[] = {
        {QL_FORMAT_RGB888, run->frame + QL_STREAM_PIXELS},
#if QL_CFG_PANEL
        {run->panel.format, run->panel_pixels},
#endif
    };
#if QL_CFG_PANEL
    const uint8_t count = run->panel.width > 0 ? 2 : 1;
    ql_status_t status;
#else
    const uint8_t count = 1;
#endif

    ql_render_line(&run->render, y, outputs, count);
    run->ticks += ql_hal_ticks() - before;
#if QL_CFG_PANEL
    status = show(run, y, rows);
    if (status != QL_OK) {
        return status;
    }
#else
    (void)rows;
#endif
    return ql_hal_serial_write(
            run->frame, ql_stream_line(run->frame, y, bytes));
}

/* Every line once. The first pass takes lines 0, step, 2 step, ..; each later
 * one halves step and takes those half way between. */
static ql_status_t render_lines(run_t *run, uint8_t interlace)
{
    const uint32_t height = run->render.settings.height;
    uint32_t first = 0;
    uint32_t stride = interlace;

    for (uint32_t step = interlace; step > 0; step /= 2) {
        for (uint32_t y = first; y < height; y += stride) {
            ql_status_t status = QL_ERR_STOPPED;
            if (!ql_hal_stop_requested()) {
                status = render_line(run, (uint16_t)y, (uint16_t)step);
            }
            if (status != QL_OK) {
                return status;
            }
        }
        first = step / 2;
        stride = step;
    }
    return QL_OK;
}

static bool is_power_of_two(uint8_t x)
{
    return x != 0 && (x & (x - 1u)) == 0;
}

#if QL_CFG_DIAG
/* Say which feature is missing: a line of text between two frames. */
static void report_missing(const void *blob)
{
    static const char begin[] = "qlux: this build lacks ";
    const char *name = ql_blob_missing(blob);
    uint16_t size = 0;

    while (name[size] != '\0') {
        size++;
    }
    if (ql_hal_serial_write((const uint8_t *)begin, sizeof begin - 1) ==
                    QL_OK &&
            ql_hal_serial_write((const uint8_t *)name, size) == QL_OK) {
        /* A line that cannot be sent has nowhere to be reported either. */
        (void)(ql_hal_serial_write((const uint8_t *)"\n", 1) == QL_OK);
    }
}
#endif

static ql_status_t render_picture(run_t *run, const ql_app_t *app)
{
    ql_scene_t scene;
    const void *blob;
    size_t size;
    ql_status_t status;

    ql_hal_scene_blob(&blob, &size);
    status = ql_blob_open(&scene, blob, size);
#if QL_CFG_DIAG
    if (status == QL_ERR_FEATURE) {
        report_missing(blob);
    }
#endif
    if (status == QL_OK) {
        status = ql_render_init(&run->render, &scene, &app->settings);
    }
    if (status == QL_OK) {
        status = set_up(run, app);
    }
    if (status == QL_OK) {
        status = ql_hal_serial_write(
                run->frame, ql_stream_head(run->frame, &run->render.settings,
                                    QL_FORMAT_RGB888));
    }
    if (status == QL_OK) {
        status = render_lines(run, app->interlace);
    }
    return status;
}

ql_status_t ql_app_run(const ql_app_t *app)
{
    run_t run = {0};
    ql_stream_end_t end = {0};

    end.status = ql_hal_init();
    if (app->work_bytes < QL_APP_FRAME_BYTES(1u) ||
            !is_power_of_two(app->interlace)) {
        return QL_ERR_SETTINGS;
    }
    run.frame = app->work;
    if (end.status == QL_OK) {
        end.status = render_picture(&run, app);
    }

#if QL_CFG_DIAG
    end.diag = run.render.diag;
#endif
    end.ticks = run.ticks;
    end.tick_hz = app->tick_hz;
    if (ql_hal_serial_write(run.frame, ql_stream_end(run.frame, &end)) !=
                    QL_OK &&
            end.status == QL_OK) {
        end.status = QL_ERR_SERIAL;
    }
    return end.status;
}
