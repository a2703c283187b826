/* ssd0323.c - the SSD0323 panel controller: 128x64 pixels of 4 bits */
/* SPDX-License-Identifier: MIT */

#include "drivers/ssd0323.h"

#include "drivers/ql_bus.h"

/* Commands, from the controller's data sheet (Solomon Systech, rev. 1.3). */
#define SET_COLUMNS      0x15u /* first, last: pairs of pixels */
#define SET_ROWS         0x75u /* first, last */
#define SET_CONTRAST     0x81u /* 0..127 */
#define SET_CURRENT_FULL 0x86u
#define SET_REMAP        0xa0u
#define SET_START_LINE   0xa1u
#define SET_OFFSET       0xa2u
#define MODE_NORMAL      0xa4u
#define SET_MULTIPLEX    0xa8u /* rows - 1 */
#define DISPLAY_OFF      0xaeu
#define DISPLAY_ON       0xafu
#define SET_CLOCK        0xb3u /* divider - 1; oscillator << 4 */
#define SET_GREY_TABLE   0xb8u

/* High nibble left; rows from the far end, odd and even ones split: so the
 * 128x64 glass is wired. */
#define REMAP 0x52u

/* Steps between neighbouring grey levels, 3 bits each: short in the dark, long
 * in the bright, near the sRGB curve that the pixels carry (half way up the
 * levels is 0.29 of full light; sRGB says 0.25). */
/* clang-format off */
static const uint8_t set_up[] = {
    DISPLAY_OFF,
    SET_CONTRAST, 0x40,
    SET_CURRENT_FULL,
    SET_REMAP, REMAP,
    SET_START_LINE, 0,
    SET_OFFSET, 0,
    MODE_NORMAL,
    SET_MULTIPLEX, SSD0323_HEIGHT - 1,
    SET_CLOCK, 0x91,
    SET_GREY_TABLE, 0x01, 0x11, 0x22, 0x32, 0x43, 0x54, 0x65, 0x76,
    DISPLAY_ON,
};
/* clang-format on */

static ql_status_t finish(bool done)
{
    ql_bus_select(QL_BUS_NOBODY);
    return done ? QL_OK : QL_ERR_DISPLAY;
}

ql_status_t ssd0323_init(void)
{
    ql_bus_select(QL_BUS_PANEL);
    return finish(ql_bus_command(set_up, sizeof set_up));
}

ql_status_t ssd0323_write(uint16_t row, const uint8_t *pixels)
{
    uint8_t window[6] = {SET_COLUMNS, 0, SSD0323_WIDTH / 2 - 1, SET_ROWS};

    if (row >= SSD0323_HEIGHT) {
        return QL_ERR_DISPLAY;
    }
    window[4] = (uint8_t)row;
    window[5] = (uint8_t)row;
    ql_bus_select(QL_BUS_PANEL);
    return finish(ql_bus_command(window, sizeof window) &&
                  ql_bus_data(pixels, SSD0323_WIDTH / 2));
}
