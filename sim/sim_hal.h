/* sim_hal.h - ql_hal.h on a PC: memory that checks its caller */
/* SPDX-License-Identifier: MIT */

/* The application loop of the boards (firmware/app/ql_app.c) runs over this HAL
 * as over any other. Its panel and serial port are memory that a test looks at
 * afterwards. Every call is checked as the contract in ql_hal.h words it:
 * order, bounds, null pointers; the first offence is kept in words. Calls that
 * can fail do so when sim_fault.h says. */

#ifndef SIM_HAL_H
#define SIM_HAL_H

#include "ql_hal.h"

#define SIM_HAL_TICK_HZ 1000u

/* What the board has, and when its user wants to stop. */
typedef struct {
    const void *blob;
    size_t blob_size;
    ql_hal_display_t display; /* width 0: no panel */
    uint32_t stop_at;         /* the n-th question is answered yes, and all
                                 after it; 0: never */
} sim_hal_setup_t;

/* What became of it. */
typedef struct {
    uint8_t *screen; /* height lines of the display's format */
    uint8_t *shown;  /* per line: how often it was written, up to 255 */
    uint8_t *serial; /* every byte sent */
    size_t serial_size;
    uint32_t display_writes; /* those that worked */
    uint32_t serial_writes;
    uint32_t stop_questions;
    bool exited;
    ql_status_t exit_status;
    char offence[80]; /* the first wrong call; "" if none */
} sim_hal_result_t;

/* Make a board, power it up, and forget the last one. */
void sim_hal_begin(const sim_hal_setup_t *setup);

/* Look at it; valid until the next sim_hal_begin() or sim_hal_end(). */
const sim_hal_result_t *sim_hal_result(void);

/* Give its memory back. */
void sim_hal_end(void);

#endif
