/* sim_judge.c - is the picture one that shows anything? */
/* SPDX-License-Identifier: MIT */

#include "sim/sim_judge.h"

#include <math.h>

#define BLACK       (0.5 / 255 / 12.92) /* sRGB rounds less to 0 */
#define MIDDLE_GREY 0.18
#define STOPS_MAX   64

typedef struct {
    uint64_t pixels, lit, black, white;
    double stops; /* of display white, a sum over what is lit */
} tally_t;

/* The channel that is brightest, in units of display white. */
static double brightest(const ql_sum_t *sum, double scale)
{
    uint64_t most = sum->rgb[0];

    most = sum->rgb[1] > most ? sum->rgb[1] : most;
    most = sum->rgb[2] > most ? sum->rgb[2] : most;
    return (double)most * scale;
}

static double darkest(const ql_sum_t *sum, double scale)
{
    uint64_t least = sum->rgb[0];

    least = sum->rgb[1] < least ? sum->rgb[1] : least;
    least = sum->rgb[2] < least ? sum->rgb[2] : least;
    return (double)least * scale;
}

static void count_row(tally_t *tally, const sums_t *sums, uint32_t y,
        double unit, double white)
{
    const ql_sum_t *row = sums_pixels(sums, y);

    for (uint32_t x = 0; x < sums->field[SUMS_WIDTH]; x++) {
        const double scale = unit / sums_count(sums, x, y);
        const double most = brightest(row + x, scale);

        tally->pixels++;
        tally->black += most < BLACK;
        tally->white += darkest(row + x, scale) >= white;
        tally->lit += most > 0;
        tally->stops += most > 0 ? log2(most) : 0;
    }
}

/* A hundredth may be a lamp, or what it does not reach. */
static bool nearly_all(uint64_t some, uint64_t all)
{
    return all - some <= all / 100;
}

void sim_judge(const sums_t *sums, int16_t exposure_q8, ql_curve_t curve)
{
    const double stops = exposure_q8 / 256.0;
    const double unit =
            exp2((double)sums_field_value(sums, SUMS_RADIANCE_EXP) +
                    (double)sums_field_value(sums, SUMS_EXPOSURE_Q8) / 256 +
                    stops - QL_SUM_BITS);
    tally_t tally = {0};
    bool black, white;
    double wanted;

    for (uint32_t y = sums->row_first; y < sums->row_end; y++) {
        if (sums_row_count(sums, y) != 0) {
            count_row(&tally, sums, y, unit,
                    curve == QL_CURVE_SRGB ? 1 : QL_CURVE_WHITE);
        }
    }
    black = nearly_all(tally.black, tally.pixels);
    white = tally.lit > 0 && nearly_all(tally.white, tally.lit);
    if (tally.lit == 0) {
        cli_warn("the picture is black: no light reaches the camera");
    } else if (black || white) {
        wanted = stops + log2(MIDDLE_GREY) - tally.stops / (double)tally.lit;
        wanted = fmax(-STOPS_MAX, fmin(STOPS_MAX, round(2 * wanted) / 2));
        cli_warn("the picture is %s; --exposure %g would do",
                white ? "white" : "black", wanted);
    }
}
