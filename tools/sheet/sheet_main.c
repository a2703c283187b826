/* sheet_main.c - qlux-sheet: labelled pictures in a grid */
/* SPDX-License-Identifier: MIT */

#include <stdlib.h>
#include <string.h>

#include "lib/image/font.h"
#include "lib/image/image_file.h"
#include "lib/program/options.h"

enum { ZOOM_MAX = 16, TEXT_MAX = 16, TITLES_MAX = 8 };

typedef struct {
    char *label; /* lines, each ended by a zero byte */
    unsigned lines;
    const char *path;
    image_t image;
} picture_t;

typedef struct {
    const char *output;
    option_list_t titles, inputs;
    unsigned columns;
    unsigned zoom, text;
    picture_t *pictures; /* of the inputs */
    unsigned count;
} sheet_t;

/* In pixels of the sheet. */
typedef struct {
    size_t margin;      /* around everything and between cells */
    size_t gap;         /* between a picture and its label */
    size_t line;        /* from one line of a label to the next */
    size_t head;        /* height of the titles */
    size_t cell_width;  /* of the widest picture or line */
    size_t view_height; /* of the highest picture */
    size_t cell_height; /* the label included */
    size_t width, height;
} layout_t;

enum { PAPER = 255 }; /* white */
static const uint8_t black[3] = {24, 24, 28}, gray[3] = {96, 96, 104};

/* ---- The command line ---------------------------------------------------- */

/* "first|second=IN": the label's lines, and where the picture is. */
static void take_picture(sheet_t *s, const char *text)
{
    picture_t *p = s->pictures + s->count++;
    const char *equals = strrchr(text, '=');
    size_t size;

    size = (size_t)(equals - text);
    p->path = equals + 1;
    p->label = cli_alloc(size + 1, 1);
    memcpy(p->label, text, size);
    p->lines = 1;
    for (size_t i = 0; i < size; i++) {
        if (p->label[i] == '|') {
            p->label[i] = '\0';
            p->lines++;
        }
    }
}

#define AT(field) OPTION_FIELD(sheet_t, field)

static const char *const pages[] = {".png", ".ppm", NULL};

static const option_t options[] = {
        {"LABEL=IN", OPTION_LABEL, AT(inputs), .required = true,
                .help = "a picture, .png or .ppm, and the text below it; '|' "
                        "begins a new line; the last '=' is the one that "
                        "counts"},
        {"-o FILE", OPTION_FILE, AT(output), .words = pages, .required = true,
                .help = "the sheet, .png or .ppm"},
        {"--columns N", OPTION_NUMBER, AT(columns), .min = 1,
                .max = IMAGE_SIDE_MAX, .preset = "all of them",
                .help = "pictures side by side"},
        {"--title TEXT", OPTION_LIST, AT(titles),
                .help = "a line above the pictures; may be given again"},
        {"--zoom N", OPTION_NUMBER, AT(zoom), .min = 1, .max = ZOOM_MAX,
                .help = "show a pixel as N x N"},
        {"--text N", OPTION_NUMBER, AT(text), .min = 1, .max = TEXT_MAX,
                .help = "size of the letters"},
        OPTION_END};

static const option_section_t sections[] = {{NULL, options}, {NULL, NULL}};

static const program_t program = {.name = "qlux-sheet",
        .about = "labelled pictures in a grid",
        .usage = "-o OUT.{png,ppm} [options] LABEL=IN ...",
        .sections = sections,
        .notes = "Letters are printable ASCII, six pixels wide at size 1. The "
                 "first title is half as large again, the first line of a "
                 "label is darker than the rest. All cells are as large as the "
                 "largest picture and the longest line need.",
        .example = "qlux-sheet -o sheet.png --columns 2 --title 'One sample a "
                   "pixel' \\\n"
                   "    'area|by points'=a.ppm 'cosine|by directions'=b.ppm"};

static void parse(sheet_t *s, int argc, char **argv)
{
    memset(s, 0, sizeof *s);
    s->zoom = 1;
    s->text = 2;
    options_parse(&program, argc, argv, s);
    if (s->titles.count > TITLES_MAX) {
        options_fail("'--title': at most %d of them", TITLES_MAX);
    }
    s->pictures = cli_alloc(s->inputs.count, sizeof *s->pictures);
    for (unsigned i = 0; i < s->inputs.count; i++) {
        take_picture(s, s->inputs.items[i]);
    }
    if (s->columns == 0 || s->columns > s->count) {
        s->columns = s->count;
    }
}

/* ---- Where things go ----------------------------------------------------- */

static size_t larger(size_t a, size_t b)
{
    return a > b ? a : b;
}

/* Size of the letters of a title: the first one is a heading. */
static unsigned title_scale(const sheet_t *s, unsigned i)
{
    return i == 0 ? s->text + (s->text + 1) / 2 : s->text;
}

static const char *next_line(const char *line)
{
    return line + strlen(line) + 1;
}

static void widen_for(layout_t *l, const sheet_t *s, const picture_t *p)
{
    const char *line = p->label;

    l->cell_width = larger(l->cell_width, (size_t)p->image.width * s->zoom);
    l->view_height = larger(l->view_height, (size_t)p->image.height * s->zoom);
    for (unsigned i = 0; i < p->lines; i++, line = next_line(line)) {
        l->cell_width = larger(l->cell_width, font_text_width(line, s->text));
    }
}

static layout_t lay_out(const sheet_t *s)
{
    const size_t rows = (s->count + s->columns - 1) / s->columns;
    unsigned lines = 0;
    layout_t l;

    memset(&l, 0, sizeof l);
    l.margin = 8u * s->text;
    l.gap = 3u * s->text;
    l.line = (FONT_HEIGHT + 2u) * s->text;
    for (unsigned i = 0; i < s->count; i++) {
        widen_for(&l, s, s->pictures + i);
        lines = s->pictures[i].lines > lines ? s->pictures[i].lines : lines;
    }
    l.cell_height = l.view_height + l.gap + lines * l.line;
    l.width = l.margin + s->columns * (l.cell_width + l.margin);
    for (unsigned i = 0; i < s->titles.count; i++) {
        const unsigned scale = title_scale(s, i);

        l.head += (FONT_HEIGHT + 3u) * scale;
        l.width = larger(l.width,
                2 * l.margin + font_text_width(s->titles.items[i], scale));
    }
    l.head += s->titles.count > 0 ? l.gap : 0;
    l.height = l.margin + l.head + rows * (l.cell_height + l.margin);
    if (l.width > IMAGE_SIDE_MAX || l.height > IMAGE_SIDE_MAX ||
            l.width * l.height > IMAGE_PIXELS_MAX) {
        cli_fail(CLI_USAGE, "the sheet would be %lux%lu pixels: too large",
                (unsigned long)l.width, (unsigned long)l.height);
    }
    return l;
}

/* ---- Drawing ------------------------------------------------------------- */

static void write_line(image_t *sheet, size_t x, size_t y, unsigned scale,
        const char *text, const uint8_t ink[3])
{
    font_draw(sheet->bytes, sheet->width, sheet->height, (long)x, (long)y,
            scale, text, ink);
}

static void draw_titles(image_t *sheet, const sheet_t *s, const layout_t *l)
{
    size_t y = l->margin;

    for (unsigned i = 0; i < s->titles.count; i++) {
        const unsigned scale = title_scale(s, i);

        write_line(sheet, l->margin, y, scale, s->titles.items[i],
                i == 0 ? black : gray);
        y += (FONT_HEIGHT + 3u) * scale;
    }
}

static void draw_view(image_t *sheet, const image_t *view, size_t left,
        size_t top, unsigned zoom)
{
    for (size_t y = 0; y < (size_t)view->height * zoom; y++) {
        uint8_t *to = sheet->bytes + 3 * (left + sheet->width * (top + y));
        const uint8_t *from = view->bytes + 3 * (y / zoom * view->width);

        for (size_t x = 0; x < (size_t)view->width * zoom; x++) {
            memcpy(to + 3 * x, from + 3 * (x / zoom), 3);
        }
    }
}

static void draw_cell(
        image_t *sheet, const sheet_t *s, const layout_t *l, unsigned i)
{
    const picture_t *p = s->pictures + i;
    const size_t left =
            l->margin + i % s->columns * (l->cell_width + l->margin);
    const size_t top =
            l->margin + l->head + i / s->columns * (l->cell_height + l->margin);
    const char *line = p->label;

    draw_view(sheet, &p->image, left, top, s->zoom);
    for (unsigned k = 0; k < p->lines; k++, line = next_line(line)) {
        write_line(sheet, left, top + l->view_height + l->gap + k * l->line,
                s->text, line, k == 0 ? black : gray);
    }
}

static void write_sheet(const sheet_t *s)
{
    const layout_t l = lay_out(s);
    image_t sheet;
    cli_out_t out;

    image_new_bytes(&sheet, (uint32_t)l.width, (uint32_t)l.height);
    memset(sheet.bytes, PAPER, 3 * l.width * l.height);
    draw_titles(&sheet, s, &l);
    for (unsigned i = 0; i < s->count; i++) {
        draw_cell(&sheet, s, &l, i);
    }
    cli_out_open(&out, s->output);
    image_write(&sheet, image_kind(s->output), &out);
    cli_out_commit(&out);
    image_free(&sheet);
}

int main(int argc, char **argv)
{
    sheet_t s;

    parse(&s, argc, argv);
    for (unsigned i = 0; i < s.count; i++) {
        picture_t *p = s.pictures + i;

        image_read(&p->image, p->path);
        if (p->image.bytes == NULL) {
            cli_fail(CLI_INPUT,
                    "%s: linear radiance: a sheet is made of .png "
                    "and .ppm pictures",
                    p->path);
        }
    }
    write_sheet(&s);
    for (unsigned i = 0; i < s.count; i++) {
        image_free(&s.pictures[i].image);
        free(s.pictures[i].label);
    }
    free(s.pictures);
    return CLI_DONE;
}
