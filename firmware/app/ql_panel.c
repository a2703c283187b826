/* ql_panel.c - centre the picture on the panel, or crop it */
/* SPDX-License-Identifier: MIT */

#include "app/ql_panel.h"

#if QL_CFG_PANEL

/* Even numbers keep pairs of pixels together where two share a byte. */
static ql_panel_place_t centre(uint16_t picture, uint16_t panel)
{
    ql_panel_place_t place = {0, 0};

    if (picture > panel) {
        place.crop = (uint16_t)((picture - panel) / 2u & ~1u);
    } else {
        place.pad = (uint16_t)((panel - picture) / 2u & ~1u);
    }
    return place;
}

ql_status_t ql_panel_begin(ql_panel_t *panel, const ql_settings_t *settings,
        uint8_t *work, size_t work_bytes)
{
    const ql_hal_display_t *const display = &panel->display;
    ql_status_t status = QL_OK;

    ql_hal_display_info(&panel->display);
    if (display->width == 0) {
        return QL_OK;
    }
    if (work_bytes <
            QL_PANEL_BYTES(settings->width, display->width, display->format)) {
        return QL_ERR_SETTINGS;
    }
    if ((QL_CFG_FORMATS >> display->format & 1) == 0) {
        return QL_ERR_DISPLAY;
    }
    panel->height = settings->height;
    panel->x = centre(settings->width, display->width);
    panel->y = centre(settings->height, display->height);
    panel->pixels = work + QL_LINE_BYTES(panel->x.pad, display->format);
    panel->line = work + QL_LINE_BYTES(panel->x.crop, display->format);
    for (uint16_t row = 0; row < display->height && status == QL_OK; row++) {
        status = ql_hal_display_write(row, work);
    }
    return status;
}

uint8_t ql_panel_output(const ql_panel_t *panel, ql_output_t *output)
{
    if (panel->display.width == 0) {
        return 0;
    }
    output->format = panel->display.format;
    output->pixels = panel->pixels;
    return 1;
}

ql_status_t ql_panel_line(const ql_panel_t *panel, uint16_t y, uint16_t rows)
{
    ql_status_t status = QL_OK;
    uint16_t row;

    if (panel->display.width == 0) {
        return QL_OK;
    }
    for (; rows > 0 && status == QL_OK; rows--, y++) {
        if (y < panel->y.crop || y >= panel->height) {
            continue;
        }
        row = (uint16_t)(y - panel->y.crop + panel->y.pad);
        if (row < panel->display.height) {
            status = ql_hal_display_write(row, panel->line);
        }
    }
    return status;
}

#endif
