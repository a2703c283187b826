/* plot.c - a picture of a warp: the unit square, its domain, the verdict */
/* SPDX-License-Identifier: MIT */

#include "warp/plot_domain.h"

#include <stdlib.h>
#include <string.h>

#include "lib/image/image_file.h"

#define PNG_SCALE 2.0

static const figure_style_t style_ink = {
        .colour = 0x20242c, .opacity = 1, .size = 18, .bold = true};
static const figure_style_t style_alarm_text = {
        .colour = 0xb91c1c, .opacity = 1, .size = 12, .bold = true};

static unsigned group_of(const plot_t *p, const plot_sample_t *s)
{
    if (p->warp->kind == WARP_ENTRY) {
        return (unsigned)s->point.x[0];
    }
    if (p->warp->numbers == 1) {
        return s->u[0] >> 27;
    }
    return (s->u[0] >> 30) * CLASSES_2 + (s->u[1] >> 29);
}

static void draw_samples(plot_t *p)
{
    p->n_groups = p->warp->kind == WARP_ENTRY ? p->setup->cells.n : CLASSES;
    for (uint32_t i = 0; i < p->n; i++) {
        plot_sample_t *s = &p->samples[i];

        warp_numbers(QL_SAMPLER_SOBOL, 1, i, s->u);
        warp_draw(p->warp, p->setup, s->u, &s->point);
        s->group = group_of(p, s);
    }
}

/* The unit square on the left. */

static void put_square_lines(plot_t *p)
{
    const figure_style_t style = {
            .colour = 0x4b5563, .opacity = 0.3, .size = 0.6};
    const warp_cells_t *c = &p->setup->cells;
    figure_t *f = &p->figure;

    if (c->alias.count > 0) {
        for (uint32_t j = 0; j < c->n; j++) {
            const uint32_t *column = c->alias_words + j * QL_ALIAS_WORDS;
            const double t = (double)QL_LE32(column[QL_ALIAS_THRESHOLD]) /
                             c->alias.total;
            const double x0 = plot_square_x((double)j / c->n);
            const double x1 = plot_square_x((j + 1.0) / c->n);

            figure_line(f, style, x1, plot_square_y(0), x1, plot_square_y(1));
            if (t > 0 && t < 1) {
                figure_line(f, style_frame, x0, plot_square_y(t), x1,
                        plot_square_y(t));
            }
        }
    } else if (p->warp->numbers == 1) {
        double sum = 0;

        for (uint32_t i = 0; i + 1 < c->n; i++) {
            sum += c->mass[i];
            if (c->mass[i] > 0 && sum < 0.9999) {
                figure_line(f, style, plot_square_x(sum), plot_square_y(0),
                        plot_square_x(sum), plot_square_y(1));
            }
        }
    } else {
        for (int k = 1; k < CLASSES_2; k++) {
            const double part = (double)k / CLASSES_2;

            figure_line(f, style, plot_square_x(0), plot_square_y(part),
                    plot_square_x(1), plot_square_y(part));
            if (k < CLASSES_1) {
                figure_line(f, style, plot_square_x((double)k / CLASSES_1),
                        plot_square_y(0), plot_square_x((double)k / CLASSES_1),
                        plot_square_y(1));
            }
        }
    }
}

static void put_square(plot_t *p)
{
    figure_t *f = &p->figure;

    put_square_lines(p);
    for (unsigned group = 0; group < p->n_groups; group++) {
        const figure_style_t style = {.colour = plot_colour(p, group),
                .opacity = 1,
                .size = plot_dot_size(p)};
        bool begun = false;

        for (uint32_t i = 0; i < p->n; i++) {
            if (p->samples[i].group == group) {
                if (!begun) {
                    figure_add(f, FIGURE_DOTS, style);
                    begun = true;
                }
                figure_point(f, plot_square_x(plot_unit(p->samples[i].u[0])),
                        plot_square_y(plot_unit(p->samples[i].u[1])));
            }
        }
    }
    figure_box(f, FIGURE_PATH, style_frame, plot_square_x(0), plot_square_y(0),
            plot_square_x(1), plot_square_y(1));
    figure_text(f, style_tick, FIGURE_MIDDLE, plot_square_x(0),
            plot_square_y(0) + 16, "0");
    figure_text(f, style_tick, FIGURE_MIDDLE, plot_square_x(1),
            plot_square_y(0) + 16, "1");
    figure_text(f, style_note, FIGURE_MIDDLE, plot_square_x(0.5),
            plot_square_y(0) + 17, "u1");
    figure_text(f, style_tick, FIGURE_RIGHT, plot_square_x(0) - 7,
            plot_square_y(0) + 4, "0");
    figure_text(f, style_tick, FIGURE_RIGHT, plot_square_x(0) - 7,
            plot_square_y(1) + 4, "1");
    if (p->warp->numbers > 1) {
        figure_text(f, style_note, FIGURE_RIGHT, plot_square_x(0) - 7,
                plot_square_y(0.5) + 4, "u2");
    }
}

static void put_arrow(plot_t *p)
{
    const double y = plot_square_y(0.5), x0 = plot_square_x(1) + 16,
                 x1 = x0 + 28;
    const figure_style_t line = {.colour = 0x8b94a3, .opacity = 1, .size = 1.5};

    figure_line(&p->figure, line, x0, y, x1, y);
    figure_add(&p->figure, FIGURE_PATH, line);
    figure_point(&p->figure, x1 - 6, y - 4);
    figure_point(&p->figure, x1, y);
    figure_point(&p->figure, x1 - 6, y + 4);
}

/* A formula in letters of its own: theta and pi in Greek. */
static void write_formula(const char *plain, char *text, size_t size)
{
    static const char *const words[][2] = {
            {"theta", "\xce\xb8"}, {"pi", "\xcf\x80"}};
    size_t used = 0;

    while (*plain != '\0' && used + 4 < size) {
        size_t k = 0;

        while (k < 2 && strncmp(plain, words[k][0], strlen(words[k][0])) != 0) {
            k++;
        }
        if (k < 2) {
            memcpy(text + used, words[k][1], 2);
            used += 2;
            plain += strlen(words[k][0]);
        } else {
            text[used++] = *plain++;
        }
    }
    text[used] = '\0';
}

static void put_title(plot_t *p)
{
    const warp_t *w = p->warp;
    char label[32] = "", formula[96];

    if (w->label != NULL) {
        snprintf(label, sizeof label, w->label, p->setup->parameter);
    }
    write_formula(w->density, formula, sizeof formula);
    figure_text(&p->figure, style_ink, FIGURE_LEFT, 24, 34, "%s%s%s", w->name,
            label[0] != '\0' ? ", " : "", label);
    figure_text(&p->figure, style_note, FIGURE_LEFT, 24, 56,
            "%s %s  \xc2\xb7  %s%s%lu samples",
            w->kind == WARP_ENTRY ? "pmf" : "pdf", formula,
            w->source[0] != '-' ? w->source : "",
            w->source[0] != '-' ? "  \xc2\xb7  " : "", (unsigned long)p->n);
}

static void write_p(double p, char *text, size_t size)
{
    snprintf(text, size, p > 0 ? "= %.2g" : "< 1e-300", p);
}

/* The verdict of the test, below. */
static void put_fit(plot_t *p)
{
    warp_fit_t fit;
    char text[24];

    warp_measure(p->warp, p->setup, p->warp, &fit);
    write_p(fit.chi2_p, text, sizeof text);
    figure_text(&p->figure, style_note, FIGURE_LEFT, 24, HEIGHT - 16,
            "\xcf\x87^2 of 2^{20} random samples%s: %.0f, %.0f degrees of "
            "freedom, p %s",
            plot_is_naive(p) ? " against this pdf" : "", fit.chi2, fit.dof,
            text);
    if (plot_is_naive(p)) {
        warp_measure(p->warp, p->setup, warp_find("uniform-hemisphere"), &fit);
        write_p(fit.chi2_p, text, sizeof text);
        figure_text(&p->figure, style_alarm_text, FIGURE_LEFT, 24, HEIGHT - 34,
                "NOT UNIFORM: \xcf\x87^2 against 1/(2\xcf\x80): %.0f, %.0f "
                "degrees of freedom, p %s",
                fit.chi2, fit.dof, text);
    }
}

static void put_domain(plot_t *p)
{
    switch (p->warp->kind) {
    case WARP_AXIAL:
        plot_axial(p);
        break;
    case WARP_DIRECTION:
        plot_direction(p);
        break;
    case WARP_DISK:
        plot_disk(p);
        break;
    case WARP_TRIANGLE:
        plot_triangle(p);
        break;
    case WARP_TENT:
        plot_tent(p);
        break;
    case WARP_ENTRY:
        plot_cells(p);
        break;
    default:
        if (p->warp->dims > 1) {
            plot_table(p);
        } else {
            plot_cells(p);
            plot_line_dots(p);
        }
        break;
    }
}

static void write_picture(const figure_t *figure, const char *path)
{
    const char *dot = strrchr(path, '.');
    image_t image;
    cli_out_t out;

    cli_out_open(&out, path);
    if (dot != NULL && strcmp(dot, ".svg") == 0) {
        figure_write_svg(figure, out.file);
    } else {
        figure_draw(figure, &image, PNG_SCALE);
        image_write(&image, image_kind(path), &out);
        image_free(&image);
    }
    cli_out_commit(&out);
}

void warp_plot(const warp_t *warp, double parameter, uint32_t n_samples,
        const char *path)
{
    static warp_setup_t setup;
    plot_t p;

    memset(&p, 0, sizeof p);
    p.warp = warp;
    p.setup = &setup;
    p.n = n_samples;
    p.samples = cli_alloc(n_samples, sizeof *p.samples);
    warp_begin(warp, &setup, parameter);
    figure_begin(&p.figure, WIDTH, HEIGHT);
    draw_samples(&p);
    put_title(&p);
    put_square(&p);
    put_arrow(&p);
    put_domain(&p);
    put_fit(&p);
    write_picture(&p.figure, path);
    figure_free(&p.figure);
    free(p.samples);
}
