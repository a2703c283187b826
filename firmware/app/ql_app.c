/* ql_app.c - the product loop: open the scene, render lines, send and show */
/* SPDX-License-Identifier: MIT */

#include "app/ql_app.h"

/* What a run carries from line to line. */
typedef struct {
    ql_render_t render;
    ql_panel_t panel;
    uint8_t *frame;
    uint32_t ticks;
} run_t;

/* Divide the working memory: a frame, then what the panel needs. */
static ql_status_t set_up(run_t *run, const ql_app_t *app)
{
    const ql_settings_t *settings = &run->render.settings;
    const size_t frame_bytes = QL_APP_FRAME_BYTES(settings->width);

    if ((QL_CFG_FORMATS >> QL_FORMAT_RGB888 & 1) == 0 ||
            app->work_bytes < frame_bytes) {
        return QL_ERR_SETTINGS;
    }
    return ql_panel_begin(&run->panel, settings, run->frame + frame_bytes,
            app->work_bytes - frame_bytes);
}

/* Render line y, show it, also in place of the rows - 1 lines below it, which
 * are still to come, and send it. */
static ql_status_t render_line(run_t *run, uint16_t y, uint16_t rows)
{
    const uint16_t bytes = (uint16_t)QL_LINE_BYTES(
            run->render.settings.width, QL_FORMAT_RGB888);
    const uint32_t before = ql_hal_ticks();
    ql_output_t outputs[1 + QL_CFG_PANEL] = {
            {QL_FORMAT_RGB888, run->frame + QL_STREAM_PIXELS}};
    const uint8_t shown = ql_panel_output(&run->panel, outputs + 1);
    ql_status_t status;

    ql_render_line(&run->render, y, outputs, (uint8_t)(1 + shown));
    run->ticks += ql_hal_ticks() - before;
    status = ql_panel_line(&run->panel, y, rows);
    if (status != QL_OK) {
        return status;
    }
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

/* Say which feature is missing: a line of text between two frames. */
#if QL_CFG_DIAG
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
#else
static void report_missing(const void *blob)
{
    (void)blob;
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
    if (status == QL_ERR_FEATURE) {
        report_missing(blob);
    }
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

    if (QL_CFG_DIAG) {
        end.diag = run.render.diag;
    }
    end.ticks = run.ticks;
    end.tick_hz = app->tick_hz;
    if (ql_hal_serial_write(run.frame, ql_stream_end(run.frame, &end)) !=
                    QL_OK &&
            end.status == QL_OK) {
        end.status = QL_ERR_SERIAL;
    }
    return end.status;
}
