/* sim_files.h - what qlux-sim reads and writes beside the scene */
/* SPDX-License-Identifier: MIT */

#ifndef SIM_FILES_H
#define SIM_FILES_H

#include "lib/render/render_options.h"
#include "lib/terminal/blocks.h"

/* The outputs of a run. */
typedef struct {
    const render_options_t *options;
    cli_out_t picture;
    cli_out_t save;
    cli_out_t map;
    blocks_t blocks; /* --show */
} sim_files_t;

/* Open them before the work, so that a bad path fails at once. */
void sim_files_open(sim_files_t *files, const render_options_t *options);

/* Write them, complete. */
void sim_files_write(sim_files_t *files, const sums_t *sums);

/* Renew the picture: its file with --progressive, the terminal with --show.
 *   files  -  a sim_files_t */
void sim_files_renew(void *files, const sums_t *sums);

/* Write what an interrupted run has: its files, and the sums beside the picture
 * as PICTURE.qls unless they have a file already. Says how to go on, and ends
 * in cli_fail(CLI_IO). Old files stay if there is nothing. */
void sim_files_write_part(sim_files_t *files, const sums_t *sums);

/* Take the sums that a file holds of this run, or cli_fail(CLI_INPUT).
 *
 *   sums   -  in and out: black pixels, fields; then settled
 *   path   -  of a sum file
 *   whole  -  the samples of this run; others are refused
 */
void sim_files_resume(
        sums_t *sums, const char *path, const sums_range_t *whole);

/* Samples of a pixel, the mean of the rows in memory. */
double sim_files_mean_count(const sums_t *sums);

#endif
