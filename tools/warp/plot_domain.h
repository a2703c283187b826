/* plot_domain.h - where samples go, drawn for each kind of warp */
/* SPDX-License-Identifier: MIT */

#ifndef PLOT_DOMAIN_H
#define PLOT_DOMAIN_H

#include "warp/plot_page.h"

/* Of the sphere: plot_sphere.c. */
void plot_axial(plot_t *p);
void plot_direction(plot_t *p);

/* Of the plane, and cells: plot_plane.c. */
void plot_disk(plot_t *p);
void plot_triangle(plot_t *p);
void plot_tent(plot_t *p);
void plot_cells(plot_t *p);
void plot_line_dots(plot_t *p);
void plot_table(plot_t *p);

#endif
