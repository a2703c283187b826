/* ql_config.h - every choice: default, allowed values, what it costs */
/* SPDX-License-Identifier: MIT */

/* A choice is always a number, tested with #if. Set it on the command line
 * (-DQL_CFG_PRECISION=0) or in the header qlux-scene --features writes. */

#ifndef QL_CONFIG_H
#define QL_CONFIG_H

#ifdef QL_CFG_FEATURES_HEADER
#include QL_CFG_FEATURES_HEADER
#endif

/* QL_CFG_PRECISION: 0 draft, 1 fine. Fixes the sub-grid bits f of positions
 * and the bits b of directions (QL_POS_BITS, QL_DIR_BITS below); the algorithm
 * is the same. A path costs 1.14 times the instructions in fine on a Cortex-M3,
 * 1.65 times on a Cortex-M0 (make bench). */
#ifndef QL_CFG_PRECISION
#define QL_CFG_PRECISION 1
#endif

/* QL_CFG_TABLE_BITS: 5 to 10. Cells of the warps' tables: 2^bits of the sine in
 * a quarter turn, 3 2^(bits - 1) of the reciprocal square root. Both together
 * take 900 bytes with 7 bits; each bit more doubles that.
 * QL_CFG_TABLE_LERP: 0 or 1. Refine what they hold, the sine by Taylor's
 * series, the root by Newton's method; with 0 the nearest entry must do. Then
 * directions are off by up to 2^-bits, a bias that make trade measures. */
#ifndef QL_CFG_TABLE_BITS
#define QL_CFG_TABLE_BITS 7
#endif
#ifndef QL_CFG_TABLE_LERP
#define QL_CFG_TABLE_LERP 1
#endif

/* QL_CFG_NODE16, QL_CFG_NODE8: 0 or 1. Which BVH node widths are built in; at
 * least one. The second one costs 2,900 bytes of code on a Cortex-M0 (-Os). */
#ifndef QL_CFG_NODE16
#define QL_CFG_NODE16 1
#endif
#ifndef QL_CFG_NODE8
#define QL_CFG_NODE8 1
#endif

/* QL_CFG_PAGES: 0 or 1. Scenes of more than 65,535 vertices. Two instructions a
 * triangle test. */
#ifndef QL_CFG_PAGES
#define QL_CFG_PAGES 1
#endif

/* QL_CFG_LIGHTS: 0 or 1. Direct light by points on the emitters; 0 suits only
 * scenes without any. 2,700 bytes of code on a Cortex-M0 (-Os). */
#ifndef QL_CFG_LIGHTS
#define QL_CFG_LIGHTS 1
#endif

/* QL_CFG_TWO_SIDED: 0 or 1. Emitters that shine from both sides. */
#ifndef QL_CFG_TWO_SIDED
#define QL_CFG_TWO_SIDED 1
#endif

/* What a scene may be made of beyond diffuse triangles, each 0 or 1; a scene
 * without it pays nothing for it. Bytes of code on a Cortex-M0: make size.
 *   QL_CFG_SPHERES  spheres, as surfaces and as lights
 *   QL_CFG_SMOOTH   normals interpolated between corners
 *   QL_CFG_PHONG    the normalised Phong lobe, Ks with Ns
 *   QL_CFG_MIRROR   perfect mirrors
 *   QL_CFG_GLASS    smooth dielectrics
 *   QL_CFG_SKY      light from all around; needs QL_CFG_LIGHTS
 *   QL_CFG_SKY_MAP  a picture of it; needs QL_CFG_SKY and QL_CFG_TABLES
 *   QL_CFG_TABLES   tabulated distributions
 *   QL_CFG_LENS     depth of field
 *   QL_CFG_CONTACT  surfaces that touch, which light must not pass between
 *   QL_CFG_ORDER    surfaces in one place, of which one counts
 *   QL_CFG_HULL     walls around the scene, apart from the rest */
#ifndef QL_CFG_SPHERES
#define QL_CFG_SPHERES 1
#endif
#ifndef QL_CFG_SMOOTH
#define QL_CFG_SMOOTH 1
#endif
#ifndef QL_CFG_PHONG
#define QL_CFG_PHONG 1
#endif
#ifndef QL_CFG_MIRROR
#define QL_CFG_MIRROR 1
#endif
#ifndef QL_CFG_GLASS
#define QL_CFG_GLASS 1
#endif
#ifndef QL_CFG_SKY
#define QL_CFG_SKY 1
#endif
#ifndef QL_CFG_SKY_MAP
#define QL_CFG_SKY_MAP 1
#endif
#ifndef QL_CFG_TABLES
#define QL_CFG_TABLES 1
#endif
#ifndef QL_CFG_LENS
#define QL_CFG_LENS 1
#endif
#ifndef QL_CFG_CONTACT
#define QL_CFG_CONTACT 1
#endif
#ifndef QL_CFG_ORDER
#define QL_CFG_ORDER 1
#endif
#ifndef QL_CFG_HULL
#define QL_CFG_HULL 1
#endif

/* QL_CFG_SLANTED: 0 or 1. Walls turned against the grid count for all
 * positions, not only for those far enough from them. Changes no bit. 400 bytes
 * of code on a Cortex-M0 (-Os). */
#ifndef QL_CFG_SLANTED
#define QL_CFG_SLANTED 1
#endif

/* Bytes from here on: of the Cornell box on a Cortex-M0, -Os with link-time
 * optimisation (make size BOARD=microbit, with DIRECT=mis and so on). */

/* QL_CFG_DIRECT: 1 to 63. Ways of finding light that are built in: the sum of
 * 1 << direct over those of ql_direct_t. Against area alone cosine alone costs
 * 1,150 bytes less, hemisphere 130 more, mis 1,970, solid-angle 6,950.
 * QL_CFG_LIGHT_CHOICES: 1 to 7. Likewise which emitters can be asked: the sum
 * of 1 << choice over those of ql_light_choice_t. Against power alone all alone
 * costs 280 bytes less, uniform 420 more.
 * A build that has a single one never asks which. All there is, with what
 * follows, costs 11,190 bytes more than area by power. */
#ifndef QL_CFG_DIRECT
#define QL_CFG_DIRECT 63
#endif
#ifndef QL_CFG_LIGHT_CHOICES
#define QL_CFG_LIGHT_CHOICES 7
#endif

/* What else estimators may do, each 0 or 1:
 *   QL_CFG_LIGHT_SAMPLES  more than one sample of each emitter asked; 130 bytes
 *   QL_CFG_UNIFORM        indirect light by uniform directions; 1,400
 *   QL_CFG_ROULETTE       Russian roulette; 290 */
#ifndef QL_CFG_LIGHT_SAMPLES
#define QL_CFG_LIGHT_SAMPLES 1
#endif
#ifndef QL_CFG_UNIFORM
#define QL_CFG_UNIFORM 1
#endif
#ifndef QL_CFG_ROULETTE
#define QL_CFG_ROULETTE 1
#endif

/* QL_CFG_ADAPTIVE: 0 or 1. Pixels that stop once their error is small enough:
 * error_q16 of ql_settings_t, which does not exist without. 1,600 bytes of code
 * on a Cortex-M0 (-Os). */
#ifndef QL_CFG_ADAPTIVE
#define QL_CFG_ADAPTIVE 1
#endif

/* QL_CFG_INDIRECT: 0 or 1. Paths that go on after the first hit; with 0 only
 * settings without indirect light, or of no bounces. 1,900 bytes: directions,
 * and the tables of square roots and sines. */
#ifndef QL_CFG_INDIRECT
#define QL_CFG_INDIRECT 1
#endif

/* QL_CFG_SAMPLERS: 1 random, 2 Sobol, 3 both of ql_sampler_kind_t. Sobol alone
 * costs 550 bytes more than random alone, both 90 more than that. */
#ifndef QL_CFG_SAMPLERS
#define QL_CFG_SAMPLERS 3
#endif

/* QL_CFG_FORMATS: 1 to 31. Pixel formats that lines can be encoded in: the sum
 * of 1 << format over those of ql_format_t. The stream is RGB888, 1; a panel
 * may add one. All of them cost 580 bytes more than RGB888 alone. */
#ifndef QL_CFG_FORMATS
#define QL_CFG_FORMATS 31
#endif

/* QL_CFG_PANEL: 0 or 1. Show the picture on the board's panel too. With a
 * format of its own 530 bytes. */
#ifndef QL_CFG_PANEL
#define QL_CFG_PANEL 1
#endif

/* QL_CFG_CURVES: 0 to 3. Curves that a picture can be shown by beside the
 * display's own, sRGB: 1 filmic, 2 Reinhard's, 3 both of ql_curve_t. The first
 * one costs 500 bytes, 386 of them its table. */
#ifndef QL_CFG_CURVES
#define QL_CFG_CURVES 3
#endif

/* QL_CFG_METER: 0 or 1. Meter the exposure before the picture: meter of
 * ql_settings_t, which does not exist without. 1,360 bytes, and 512 paths. */
#ifndef QL_CFG_METER
#define QL_CFG_METER 1
#endif

/* QL_CFG_CLAMP: 0 or 1. Cut bright contributions: clamp_q16 of ql_settings_t,
 * which does not exist without. 660 bytes. */
#ifndef QL_CFG_CLAMP
#define QL_CFG_CLAMP 1
#endif

/* QL_CFG_SMALL: 0 or 1. Short code where fast and short code differ; results
 * are the same bits. Saves 4,700 bytes of 16,400, and a path costs 2.6 times
 * the instructions on a Cortex-M0: products, real numbers, hashes, the
 * triangle test and the walk through the tree are functions, once each;
 * reciprocals and CRCs need no table. */
#ifndef QL_CFG_SMALL
#define QL_CFG_SMALL 0
#endif

/* QL_CFG_DIAG: 0 or 1. Count rays, paths and saturations in ql_diag_t, and name
 * the feature that a blob needs and the build lacks. 310 bytes. */
#ifndef QL_CFG_DIAG
#define QL_CFG_DIAG 1
#endif

/* QL_CFG_BVH_STACK: 4 to 64. Deepest BVH that can be traversed; four bytes of
 * stack each. qlux-scene never builds deeper than 32. */
#ifndef QL_CFG_BVH_STACK
#define QL_CFG_BVH_STACK 32
#endif

/* QL_CFG_ASSERT: 0 or 1. Check our own claims at run time; needs a host. */
#ifndef QL_CFG_ASSERT
#define QL_CFG_ASSERT 0
#endif

/* Bits that QL_CFG_PRECISION stands for. */
#if QL_CFG_PRECISION == 0
#define QL_POS_BITS 0
#define QL_DIR_BITS 15
#elif QL_CFG_PRECISION == 1
#define QL_POS_BITS 8
#define QL_DIR_BITS 22
#else
#error "QL_CFG_PRECISION: use 0 (draft) or 1 (fine)"
#endif

#if QL_CFG_TABLE_BITS < 5 || QL_CFG_TABLE_BITS > 10
#error "QL_CFG_TABLE_BITS: use 5 to 10"
#endif
#if QL_CFG_TABLE_LERP != 0 && QL_CFG_TABLE_LERP != 1
#error "QL_CFG_TABLE_LERP: use 0 or 1"
#endif
#if QL_CFG_NODE16 != 0 && QL_CFG_NODE16 != 1
#error "QL_CFG_NODE16: use 0 or 1"
#endif
#if QL_CFG_NODE8 != 0 && QL_CFG_NODE8 != 1
#error "QL_CFG_NODE8: use 0 or 1"
#endif
#if !QL_CFG_NODE16 && !QL_CFG_NODE8
#error "QL_CFG_NODE16 and QL_CFG_NODE8 are both 0: set one of them to 1"
#endif
#if QL_CFG_BVH_STACK < 4 || QL_CFG_BVH_STACK > 64
#error "QL_CFG_BVH_STACK: use 4 to 64"
#endif
#if QL_CFG_PAGES != 0 && QL_CFG_PAGES != 1
#error "QL_CFG_PAGES: use 0 or 1"
#endif
#if QL_CFG_LIGHTS != 0 && QL_CFG_LIGHTS != 1
#error "QL_CFG_LIGHTS: use 0 or 1"
#endif
#if QL_CFG_TWO_SIDED != 0 && QL_CFG_TWO_SIDED != 1
#error "QL_CFG_TWO_SIDED: use 0 or 1"
#endif
#if (QL_CFG_SLANTED | QL_CFG_INDIRECT | QL_CFG_PANEL | QL_CFG_SMALL) & ~1
#error "QL_CFG_SLANTED .. QL_CFG_SMALL: use 0 or 1 for each"
#endif
#if QL_CFG_SAMPLERS < 1 || QL_CFG_SAMPLERS > 3
#error "QL_CFG_SAMPLERS: use 1 (random), 2 (Sobol) or 3 (both)"
#endif
#if QL_CFG_FORMATS < 1 || QL_CFG_FORMATS > 31
#error "QL_CFG_FORMATS: use 1 to 31, the sum of 1 << format"
#endif
#if QL_CFG_CURVES < 0 || QL_CFG_CURVES > 3
#error "QL_CFG_CURVES: use 0, 1 (filmic), 2 (Reinhard) or 3 (both)"
#endif
#if (QL_CFG_METER | QL_CFG_CLAMP) & ~1
#error "QL_CFG_METER, QL_CFG_CLAMP: use 0 or 1 for each"
#endif
#if QL_CFG_DIAG != 0 && QL_CFG_DIAG != 1
#error "QL_CFG_DIAG: use 0 or 1"
#endif
#if (QL_CFG_SPHERES | QL_CFG_SMOOTH | QL_CFG_PHONG | QL_CFG_MIRROR |           \
        QL_CFG_GLASS | QL_CFG_SKY | QL_CFG_SKY_MAP | QL_CFG_TABLES |           \
        QL_CFG_LENS | QL_CFG_CONTACT | QL_CFG_ORDER | QL_CFG_HULL) &           \
        ~1
#error "QL_CFG_SPHERES .. QL_CFG_HULL: use 0 or 1 for each"
#endif
#if QL_CFG_DIRECT < 1 || QL_CFG_DIRECT > 63
#error "QL_CFG_DIRECT: use 1 to 63, the sum of 1 << direct"
#endif
#if QL_CFG_LIGHT_CHOICES < 1 || QL_CFG_LIGHT_CHOICES > 7
#error "QL_CFG_LIGHT_CHOICES: use 1 to 7, the sum of 1 << choice"
#endif
#if (QL_CFG_LIGHT_SAMPLES | QL_CFG_UNIFORM | QL_CFG_ROULETTE) & ~1
#error "QL_CFG_LIGHT_SAMPLES .. QL_CFG_ROULETTE: use 0 or 1 for each"
#endif
#if QL_CFG_SKY && !QL_CFG_LIGHTS
#error "QL_CFG_SKY needs QL_CFG_LIGHTS: set it to 1"
#endif
#if QL_CFG_SKY_MAP && !(QL_CFG_SKY && QL_CFG_TABLES)
#error "QL_CFG_SKY_MAP needs QL_CFG_SKY and QL_CFG_TABLES: set them to 1"
#endif
#if QL_CFG_ADAPTIVE != 0 && QL_CFG_ADAPTIVE != 1
#error "QL_CFG_ADAPTIVE: use 0 or 1"
#endif
#if QL_CFG_ASSERT != 0 && QL_CFG_ASSERT != 1
#error "QL_CFG_ASSERT: use 0 or 1"
#endif

/* Program and core must have the same gates: with others structs have other
 * members, and inline functions give other bits. So the functions of qlux.h
 * have the gates in their names, and a program with others does not link:
 *
 *     undefined reference to `ql_blob_open_precision071_nodes111_lights11_...'
 *
 * The digits are the gates in the order of this file, in groups that begin with
 * the one named; nm shows those of the core. So a gate is a plain number. */
#define QL_GATED(name)                                                         \
    QL_JOIN(name, QL_GATES_1, QL_GATES_2, QL_GATES_3, QL_GATES_4, QL_GATES_5,  \
            QL_GATES_6, QL_GATES_7, QL_GATES_8)
#define QL_GATES_1                                                             \
    QL_JOIN(_precision, QL_CFG_PRECISION, QL_CFG_TABLE_BITS,                   \
            QL_CFG_TABLE_LERP, , , , , )
#define QL_GATES_2                                                             \
    QL_JOIN(_nodes, QL_CFG_NODE16, QL_CFG_NODE8, QL_CFG_PAGES, , , , , )
#define QL_GATES_3 QL_JOIN(_lights, QL_CFG_LIGHTS, QL_CFG_TWO_SIDED, , , , , , )
#define QL_GATES_4                                                             \
    QL_JOIN(_spheres, QL_CFG_SPHERES, QL_CFG_SMOOTH, QL_CFG_PHONG,             \
            QL_CFG_MIRROR, QL_CFG_GLASS, , , )
#define QL_GATES_5                                                             \
    QL_JOIN(_sky, QL_CFG_SKY, QL_CFG_SKY_MAP, QL_CFG_TABLES, QL_CFG_LENS,      \
            QL_CFG_CONTACT, QL_CFG_ORDER, QL_CFG_HULL, QL_CFG_SLANTED)
#define QL_GATES_6                                                             \
    QL_JOIN(_direct, QL_CFG_DIRECT, QL_CFG_LIGHT_CHOICES,                      \
            QL_CFG_LIGHT_SAMPLES, QL_CFG_UNIFORM, QL_CFG_ROULETTE, , , )
#define QL_GATES_7                                                             \
    QL_JOIN(_adaptive, QL_CFG_ADAPTIVE, QL_CFG_INDIRECT, QL_CFG_SAMPLERS,      \
            QL_CFG_FORMATS, QL_CFG_PANEL, , , )
#define QL_GATES_8                                                             \
    QL_JOIN(_curves, QL_CFG_CURVES, QL_CFG_METER, QL_CFG_CLAMP, QL_CFG_SMALL,  \
            QL_CFG_DIAG, QL_CFG_BVH_STACK, QL_CFG_ASSERT, )
#define QL_JOIN(a, b, c, d, e, f, g, h, i)  QL_JOIN_(a, b, c, d, e, f, g, h, i)
#define QL_JOIN_(a, b, c, d, e, f, g, h, i) a##b##c##d##e##f##g##h##i

/* Does anything rely on unit normals? Points of triangles, seen from flat
 * diffuse surfaces, do not. */
#define QL_UNIT_NORMALS                                                        \
    (QL_CFG_INDIRECT || QL_GLOSS || QL_CFG_SMOOTH || QL_CFG_SPHERES ||         \
            QL_CFG_SKY || QL_CFG_DIRECT > 3)

/* Strategies that more than one part of the core asks for; ql_settings.h checks
 * that they are those bits. */
#if QL_CFG_DIRECT & 32
#define QL_MIS 1
#else
#define QL_MIS 0
#endif
#if QL_CFG_DIRECT & 16
#define QL_SOLID_ANGLE 1
#else
#define QL_SOLID_ANGLE 0
#endif

/* Directions that may meet an emitter, weighed by nothing. */
#define QL_DIRECTIONS ((QL_CFG_DIRECT & 12) != 0)

/* Directions that are uniform on the hemisphere, for whatever light. */
#define QL_UNIFORM_DIRECTIONS (QL_CFG_UNIFORM || QL_CFG_DIRECT & 4)

/* Materials that are more than diffuse. */
#if QL_CFG_PHONG || QL_CFG_MIRROR || QL_CFG_GLASS
#define QL_GLOSS 1
#else
#define QL_GLOSS 0
#endif

/* Materials with a lobe of a single direction. */
#define QL_SPECULAR (QL_CFG_MIRROR || QL_CFG_GLASS)

/* Curves that are more than the display's own. */
#if QL_CFG_CURVES == 0
#define QL_ROLL_OFF 0
#else
#define QL_ROLL_OFF 1
#endif

/* A member of a struct, or its initialiser and a comma, that exists only if a
 * gate is 1, so that a board keeps no RAM for what it was built without. Only
 * for members: the header of a feature has one-line stubs for functions that
 * are not built, and who calls them asks for no gate. */
#define QL_IF_BUILT(gate, ...)  QL_IF_BUILT_(gate, __VA_ARGS__)
#define QL_IF_BUILT_(gate, ...) QL_IF_BUILT_##gate(__VA_ARGS__)
#define QL_IF_BUILT_0(...)
#define QL_IF_BUILT_1(...) __VA_ARGS__

#endif
