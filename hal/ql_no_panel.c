/* ql_no_panel.c - the display functions of boards that have no panel */
/* SPDX-License-Identifier: MIT */

#include "board.h"
#include "ql_hal.h"

#if QL_PORT_PANEL_WIDTH == 0

void ql_hal_display_info(ql_hal_display_t *info)
{
    info->width = 0;
    info->height = 0;
    info->format = QL_FORMAT_GRAY8;
}

ql_status_t ql_hal_display_write(uint16_t y, const uint8_t *pixels)
{
    (void)y;
    (void)pixels;
    return QL_ERR_DISPLAY;
}

#endif
