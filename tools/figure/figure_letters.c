/* figure_letters.c - an alphabet of strokes for text in pixels */
/* SPDX-License-Identifier: MIT */

#include "figure/figure.h"

#include <string.h>

/* A stroke is a list of points, two letters each: x with a = 0, y with e = 0
 * on the baseline, o = 10 the height of an x, s = 14 that of a capital. A ~
 * before it bends it into an open curve, an @ into a closed one: they touch
 * the middles of the lines between the points. The letter before the first
 * stroke is the width. */
typedef struct {
    const char *character;
    const char *strokes;
} glyph_t;

enum { EM = 20, CURVE_STEPS = 5 };

static const glyph_t glyphs[] = {
        {" ", "f"}, {"a", "k @beboioie ioie"}, {"b", "k bsbe @beboioie"},
        {"c", "j ~imhobobeheig"}, {"d", "k @beboioie isie"},
        {"e", "k bjij ~ijiobobeheig"}, {"f", "h ~gsdsdode bogo"},
        {"g", "k @beboioie ~ioiciaeabb"}, {"h", "k bsbe ~bkcofoioikie"},
        {"i", "d bobe brbs"}, {"j", "e ~cocccaaa crcs"},
        {"k", "j bsbe hobi dkhe"}, {"l", "d bsbe"},
        {"m", "n bobe ~bkcoeogogkge ~gkhojololkle"},
        {"n", "k bobe ~bkcofoioikie"}, {"o", "k @beboioie"},
        {"p", "k boba @beboioie"}, {"q", "k ioia @beboioie"},
        {"r", "h bobe ~bkcoeogo"}, {"s", "j ~hmhobobjhjhebebg"},
        {"t", "h ~drdgdege bogo"}, {"u", "k ~bobibeeeheii ioie"},
        {"v", "i boeeho"}, {"w", "m boeegoielo"}, {"x", "i bohe beho"},
        {"y", "i boee hoda"}, {"z", "i bohobehe"}, {"A", "m begsle djjj"},
        {"B", "l bsbe ~bsesisilelbl ~blfljljefebe"}, {"C", "l ~kpjsbsbejekh"},
        {"D", "m bsbe ~bsfskskefebe"}, {"E", "k isbsbeie blhl"},
        {"F", "j isbsbe blhl"}, {"G", "m ~kpjsbsbekekl klgl"},
        {"H", "l bsbe jsje bljl"}, {"I", "d bsbe"}, {"J", "j ~hshihebebi"},
        {"K", "k bsbe jsbj elke"}, {"L", "j bsbeie"}, {"M", "n bebsgflsle"},
        {"N", "l bebsjejs"}, {"O", "n @bslslebe"},
        {"P", "k bsbe ~bsfsjsjkfkbk"}, {"Q", "n @bslslebe hild"},
        {"R", "l bsbe ~bsfsjsjkfkbk fkje"}, {"S", "k ~jpjsbsbljljebebh"},
        {"T", "k bsjs fsfe"}, {"U", "l ~bsbibejejijs"}, {"V", "k bsfejs"},
        {"W", "o bseehskens"}, {"X", "k bsje bejs"}, {"Y", "k bsfljs flfe"},
        {"Z", "k bsjsbeje"}, {"0", "k @bsisiebe"}, {"1", "k cpfsfe"},
        {"2", "k ~bpbsisingkbe beie"}, {"3", "k ~bpbsisilel ~eliliebebh"},
        {"4", "k gegsbiji"}, {"5", "k hscsbm ~bmdniniebebh"},
        {"6", "k ~hscsbnbi @bebninie"}, {"7", "k bsisde"},
        {"8", "k @cshshlcl @bliliebe"}, {"9", "k @bjbsisij ~ioijhece"},
        {".", "e cecf"}, {",", "e dfcc"}, {":", "e cecf cncm"},
        {"(", "g ~ftcpcffb"}, {")", "g ~btepefbb"}, {"[", "f etctcbeb"},
        {"]", "f btdtdbbb"}, {"+", "l bjjj fnff"}, {"-", "h bjgj"},
        {"=", "l bhjh bljl"}, {"/", "i bchs"}, {"<", "l jnbjjf"},
        {">", "l bnjjbf"}, {"|", "e ctcb"}, {"%", "o @bsfsfmbm @hklklehe kscd"},
        {"'", "d bsbp"}, {"*", "j epeh bnhj hnbj"},
        {"\xce\xb8", "k @bsisiebe blil"},          /* theta */
        {"\xcf\x80", "l bojo dode ~hohgheje"},     /* pi */
        {"\xcf\x86", "l @bebojoje fsfa"},          /* phi */
        {"\xcf\x87", "k boia ioba"},               /* chi */
        {"\xc2\xb0", "h @bsfsfobo"},               /* degree */
        {"\xc3\x97", "k cnif cfin"},               /* times */
        {"\xc2\xb7", "e cjck"},                    /* middle dot */
        {"\xe2\x88\x92", "l bjjj"},                /* minus */
        {"\xe2\x88\x9e", "o @bgbngngg @ggngnmgm"}, /* infinity */
        {"", "k bsisiebebs"},                      /* any other */
};

typedef struct {
    void (*emit)(void *context, double x0, double y0, double x1, double y1);
    void *context;
    double x, y; /* where the pen is */
} pen_t;

static void line_to(pen_t *pen, double x, double y)
{
    pen->emit(pen->context, pen->x, pen->y, x, y);
    pen->x = x;
    pen->y = y;
}

/* A parabola from the pen to x, y that leaves towards cx, cy. */
static void curve_to(pen_t *pen, double cx, double cy, double x, double y)
{
    const double x0 = pen->x, y0 = pen->y;

    for (int i = 1; i <= CURVE_STEPS; i++) {
        const double t = (double)i / CURVE_STEPS, s = 1 - t;

        line_to(pen, s * s * x0 + 2 * s * t * cx + t * t * x,
                s * s * y0 + 2 * s * t * cy + t * t * y);
    }
}

static void point_of(const char *stroke, size_t i, double *x, double *y)
{
    *x = (double)(stroke[2 * i] - 'a') / EM;
    *y = (double)(stroke[2 * i + 1] - 'e') / EM;
}

/* A curve through the middles of the lines between n points. */
static void draw_curve(pen_t *pen, const char *stroke, size_t n, bool closed)
{
    double x, y, next_x, next_y;

    point_of(stroke, 0, &x, &y);
    if (closed) {
        point_of(stroke, n - 1, &next_x, &next_y);
        x = (x + next_x) / 2;
        y = (y + next_y) / 2;
    }
    pen->x = x;
    pen->y = y;
    for (size_t i = closed ? 0 : 1; i < (closed ? n : n - 1); i++) {
        point_of(stroke, i, &x, &y);
        point_of(stroke, (i + 1) % n, &next_x, &next_y);
        if (closed || i + 2 < n) {
            next_x = (x + next_x) / 2;
            next_y = (y + next_y) / 2;
        }
        curve_to(pen, x, y, next_x, next_y);
    }
}

static void draw_stroke(pen_t *pen, const char *stroke, size_t length)
{
    if (stroke[0] == '~' || stroke[0] == '@') {
        draw_curve(pen, stroke + 1, length / 2, stroke[0] == '@');
        return;
    }
    point_of(stroke, 0, &pen->x, &pen->y);
    for (size_t i = 1; i < length / 2; i++) {
        double x, y;

        point_of(stroke, i, &x, &y);
        line_to(pen, x, y);
    }
}

unsigned figure_letter_bytes(const char *text)
{
    const unsigned char c = (unsigned char)text[0];
    const unsigned bytes = c < 0xc0 ? 1 : c < 0xe0 ? 2 : c < 0xf0 ? 3 : 4;

    return strlen(text) < bytes ? 1 : bytes;
}

double figure_letter(const char *text,
        void (*emit)(void *context, double x0, double y0, double x1, double y1),
        void *context)
{
    const unsigned bytes = figure_letter_bytes(text);
    const glyph_t *g = glyphs;
    pen_t pen = {emit, context, 0, 0};
    const char *at;

    while (g->character[0] != '\0' &&
            (strlen(g->character) != bytes ||
                    strncmp(g->character, text, bytes) != 0)) {
        g++;
    }
    at = g->strokes + 1;
    while (*at == ' ') {
        const size_t length = strcspn(at + 1, " ");

        draw_stroke(&pen, at + 1, length);
        at += 1 + length;
    }
    return (double)(g->strokes[0] - 'a') / EM;
}
