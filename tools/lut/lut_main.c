/* lut_main.c - qlux-lut: write ql_lut_data.c and each table's worst error */
/* SPDX-License-Identifier: MIT */

/* rsqrt and recip are rounded in integers. The others come from libm, and
 * every entry is proved further from a rounding tie than any libm errs (2^-40
 * of the entry's range), so every host writes the same. */

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "film/ql_curve.h"
#include "lib/program/options.h"
#include "math/lut/ql_lut.h"

#define TIE_MARGIN 1e-5 /* ulp of the entry: libm errs by less than 2e-6 */

/* Nearest integer of x, refusing to guess near a tie. */
static long round_far_from_tie(double x)
{
    const double fraction = x - floor(x);

    if (fabs(fraction - 0.5) < TIE_MARGIN) {
        cli_fail(CLI_INPUT, "%.9f is too close to a rounding tie", x);
    }
    return (long)floor(x + 0.5);
}

static double srgb(double x)
{
    return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055;
}

/* QL_CFG_TABLE_BITS of the table being written. */
static unsigned bits;

static long sin_entry(unsigned i)
{
    const double pi = 3.14159265358979323846;

    if (i == 0 || i == 1u << bits) { /* exact, and no tie in sight */
        return i == 0 ? 0 : 1L << 30;
    }
    return round_far_from_tie(
            ldexp(sin(ldexp(pi / 2 * (double)i, -(int)bits)), 30));
}

/* round(2^15 / sqrt(m)), m = (2 i + 2^bits + 1) / 2^(bits + 2): the largest v
 * with (2v - 1)^2 m <= 2^32. */
static long rsqrt_entry(unsigned i)
{
    const uint64_t m = 2u * i + (1u << bits) + 1;
    uint64_t v = 32768;

    while ((2 * v + 1) * (2 * v + 1) * m <= (uint64_t)1 << (34 + bits)) {
        v++;
    }
    return (long)v;
}

/* round(2^15 / m), m = (2 i + 257) / 512. */
static long recip_entry(unsigned i)
{
    const long m = 2 * (long)i + 2 * QL_RECIP_CELLS + 1;

    return ((1L << 25) / m + 1) / 2;
}

/* Display value of step i % 16 of octave i / 16, u8.8. */
static long srgb_entry(unsigned i)
{
    const unsigned octave = i / QL_SRGB_STEPS, step = i % QL_SRGB_STEPS;
    const double x = ldexp(
            1.0 + (double)step / QL_SRGB_STEPS, (int)octave - QL_SRGB_OCTAVES);

    if (i == QL_SRGB_OCTAVES * QL_SRGB_STEPS) { /* white, exactly */
        return 65280;
    }
    return round_far_from_tie(255 * 256 * srgb(x));
}

/* Of a channel x: film/ql_curve.h has the formulas. */
static double narkowicz(double v)
{
    return v * (2.51 * v + 0.03) / (v * (2.43 * v + 0.59) + 0.14);
}

static double filmic(double x)
{
    return narkowicz(0.72 * x) / narkowicz(0.72 * QL_CURVE_WHITE);
}

static double reinhard(double x)
{
    const double l = 1.2 * x, white = 1.2 * QL_CURVE_WHITE;

    return l * (1 + l / (white * white)) / (1 + l);
}

/* x at a place of the table: step i % 16 of octave i / 16 and beyond. */
static double curve_place(double i)
{
    const double octave = floor(i / QL_CURVE_STEPS);

    return ldexp(1 + i / QL_CURVE_STEPS - octave, (int)octave - 9);
}

static long curve_entry(unsigned i, double (*curve)(double))
{
    if (i == QL_CURVE_OCTAVES * QL_CURVE_STEPS) { /* white */
        return 65535;
    }
    return round_far_from_tie(65536 * curve(curve_place(i)));
}

static long filmic_entry(unsigned i)
{
    return curve_entry(i, filmic);
}

static long reinhard_entry(unsigned i)
{
    return curve_entry(i, reinhard);
}

/* log2 of a reciprocal of the table, u0.32. */
static long log2_entry(unsigned i)
{
    return round_far_from_tie(
            ldexp(log2(ldexp((double)recip_entry(i), -15)), 32));
}

/* 1 - 2^(-i / 64), u0.32. */
static long exp2_entry(unsigned i)
{
    if (i == 0) { /* exact */
        return 0;
    }
    return round_far_from_tie(ldexp(1 - exp2(-(double)i / QL_EXP2_CELLS), 32));
}

/* Worst errors, measured between the entries too. */

static double sin_error(void)
{
    const double pi = 3.14159265358979323846;
    double worst = 0;

    for (unsigned i = 0; i <= 1u << bits; i++) {
        const double exact = sin(ldexp(pi / 2 * (double)i, -(int)bits));
        worst = fmax(worst, fabs(ldexp((double)sin_entry(i), -30) - exact));
    }
    return worst;
}

static double rsqrt_error(void)
{
    double worst = 0;

    for (unsigned i = 0; i < 96u << bits; i++) {
        const double m = ldexp((i + 0.5) / 64, -(int)bits - 1) + 0.25;
        const double t = ldexp((double)rsqrt_entry(i / 64), -15);
        worst = fmax(worst, fabs(t * sqrt(m) - 1));
    }
    return worst;
}

static double recip_error(void)
{
    double worst = 0;

    for (unsigned i = 0; i < 64 * QL_RECIP_CELLS; i++) {
        const double m = (128.0 + (i + 0.5) / 64) / 256;
        const double t = ldexp((double)recip_entry(i / 64), -15);
        worst = fmax(worst, fabs(t * m - 1));
    }
    return worst;
}

static double srgb_error(void)
{
    double worst = 0;

    for (unsigned i = 0; i < 64 * QL_SRGB_OCTAVES * QL_SRGB_STEPS; i++) {
        const unsigned cell = i / 64, octave = cell / QL_SRGB_STEPS;
        const double f = (i % 64 + 0.5) / 64;
        const double x = ldexp(1.0 + (cell % QL_SRGB_STEPS + f) / QL_SRGB_STEPS,
                (int)octave - QL_SRGB_OCTAVES);
        const double y = (1 - f) * (double)srgb_entry(cell) +
                         f * (double)srgb_entry(cell + 1);
        worst = fmax(worst, fabs(y / 256 - 255 * srgb(x)));
    }
    return worst;
}

static double curve_error(double (*curve)(double))
{
    double worst = 0;

    for (unsigned i = 0; i < 64 * QL_CURVE_OCTAVES * QL_CURVE_STEPS; i++) {
        const double f = (i % 64 + 0.5) / 64;
        const double y = (1 - f) * (double)curve_entry(i / 64, curve) +
                         f * (double)curve_entry(i / 64 + 1, curve);
        worst = fmax(worst, fabs(y / 65536 - curve(curve_place(i / 64 + f))));
    }
    return worst;
}

static double filmic_error(void)
{
    return curve_error(filmic);
}

static double reinhard_error(void)
{
    return curve_error(reinhard);
}

static double log2_error(void)
{
    double worst = 0;

    for (unsigned i = 0; i < QL_RECIP_CELLS; i++) {
        const double exact = log2(ldexp((double)recip_entry(i), -15));
        worst = fmax(worst, fabs(ldexp((double)log2_entry(i), -32) - exact));
    }
    return worst;
}

static double exp2_error(void)
{
    double worst = 0;

    for (unsigned i = 0; i < QL_EXP2_CELLS; i++) {
        const double exact = 1 - exp2(-(double)i / QL_EXP2_CELLS);
        worst = fmax(worst, fabs(ldexp((double)exp2_entry(i), -32) - exact));
    }
    return worst;
}

typedef struct {
    const char *type;
    const char *name;
    const char *size;
    unsigned count; /* if the table has bits: times 2^bits / 2 and plus */
    unsigned plus;
    bool has_bits; /* of QL_CFG_TABLE_BITS */
    long (*entry)(unsigned);
    double (*error)(void);
    const char *about;
} table_t;

static const table_t tables[] = {
        {"int32_t", "ql_lut_sin", "QL_SIN_CELLS + 1", 2, 1, true, sin_entry,
                sin_error,
                "sine of a quarter turn, s1.30. Worst error %.2e, absolute."},
        {"uint16_t", "ql_lut_rsqrt", "QL_RSQRT_CELLS", 3, 0, true, rsqrt_entry,
                rsqrt_error,
                "1/sqrt, u1.15. Worst error %.2e over a cell, relative."},
        {"uint16_t", "ql_lut_recip", "QL_RECIP_CELLS", QL_RECIP_CELLS, 0, false,
                recip_entry, recip_error,
                "1/m, u1.15. Worst error %.2e over a cell, relative."},
        {"uint16_t", "ql_lut_srgb", "QL_SRGB_OCTAVES * QL_SRGB_STEPS + 1",
                QL_SRGB_OCTAVES *QL_SRGB_STEPS, 1, false, srgb_entry,
                srgb_error,
                "sRGB curve, u8.8. Worst error %.2e of 255, interpolated."},
        {"uint16_t", "ql_lut_filmic", "QL_CURVE_OCTAVES * QL_CURVE_STEPS + 1",
                QL_CURVE_OCTAVES *QL_CURVE_STEPS, 1, false, filmic_entry,
                filmic_error,
                "Filmic curve, u0.16. Worst error %.2e, interpolated."},
        {"uint16_t", "ql_lut_reinhard", "QL_CURVE_OCTAVES * QL_CURVE_STEPS + 1",
                QL_CURVE_OCTAVES *QL_CURVE_STEPS, 1, false, reinhard_entry,
                reinhard_error,
                "Reinhard's curve, u0.16. Worst error %.2e, interpolated."},
        {"uint32_t", "ql_lut_log2", "QL_RECIP_CELLS", QL_RECIP_CELLS, 0, false,
                log2_entry, log2_error,
                "log2 of the reciprocals, u0.32. Worst error %.2e, absolute."},
        {"uint32_t", "ql_lut_exp2", "QL_EXP2_CELLS", QL_EXP2_CELLS, 0, false,
                exp2_entry, exp2_error,
                "1 - 2^-x for x in [0, 1), u0.32. Worst error %.2e, absolute."},
};

static void write_entries(FILE *file, const table_t *table)
{
    const unsigned count =
            (table->has_bits ? table->count << bits >> 1 : table->count) +
            table->plus;

    fprintf(file, "/* ");
    fprintf(file, table->about, table->error());
    fprintf(file, " */\nconst %s %s[%s] = {", table->type, table->name,
            table->size);
    for (unsigned i = 0; i < count; i++) {
        fprintf(file, "%s%ld,", i % 6 == 0 ? "\n    " : " ", table->entry(i));
    }
    fprintf(file, "\n};\n");
}

static void write_table(FILE *file, const table_t *table)
{
    fputs("\n", file);
    if (!table->has_bits) {
        write_entries(file, table);
        return;
    }
    for (bits = 5; bits <= 10; bits++) {
        fprintf(file, "#%s QL_CFG_TABLE_BITS == %u\n",
                bits == 5 ? "if" : "elif", bits);
        write_entries(file, table);
    }
    fputs("#endif\n", file);
}

typedef struct {
    const char *output;
} options_t;

static const option_t options[] = {
        {"-o FILE", OPTION_FILE, OPTION_FIELD(options_t, output),
                .required = true,
                .help = "where to write; the tree keeps it as "
                        "firmware/math/lut/ql_lut_data.c and the tests "
                        "compare"},
        OPTION_END};

static const option_section_t sections[] = {{NULL, options}, {NULL, NULL}};

static const program_t program = {.name = "qlux-lut",
        .about = "write the core's tables as C",
        .usage = "-o FILE.c",
        .sections = sections,
        .example = "qlux-lut -o firmware/math/lut/ql_lut_data.c"};

int main(int argc, char **argv)
{
    options_t o;
    cli_out_t out;

    options_parse(&program, argc, argv, &o);
    cli_out_open(&out, o.output);
    fprintf(out.file,
            "/* ql_lut_data.c - GENERATED by qlux-lut: the core's "
            "tables */\n/* SPDX-License-Identifier: MIT */\n\n"
            "#include \"math/lut/ql_lut.h\"\n\n/* clang-format off */\n");
    for (size_t i = 0; i < sizeof tables / sizeof tables[0]; i++) {
        write_table(out.file, &tables[i]);
    }
    cli_out_commit(&out);
    return CLI_DONE;
}
