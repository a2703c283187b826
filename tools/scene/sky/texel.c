/* texel.c - a texel of a map of the sky, three numbers of nine bits */
/* SPDX-License-Identifier: MIT */

#include "scene/sky/texel.h"

#include "lib/math/soft.h"

void texel_unpack(ql_blob_texel_t texel, uint32_t channels[3])
{
    for (unsigned k = 0; k < 3; k++) {
        channels[k] = (texel.rgb9e5 >> TEXEL_BITS * k & TEXEL_MOST)
                      << (texel.rgb9e5 >> 27);
    }
}

/* The largest channel keeps nine bits if it has them. */
ql_blob_texel_t texel_round(const float rgb[3], int radiance_exp)
{
    ql_blob_texel_t texel = {0};
    soft_t most = soft_int(0, 0);
    int e = 0;

    for (int k = 0; k < 3; k++) {
        const soft_t x = soft_from((double)rgb[k]);

        most = soft_compare(x, most) > 0 ? x : most;
    }
    while (e < TEXEL_SCALE_MOST &&
            soft_round(most, 32 - radiance_exp - e) > TEXEL_MOST) {
        e++;
    }
    texel.rgb9e5 = (uint32_t)e << 27;
    for (int k = 0; k < 3; k++) {
        const int64_t m =
                soft_round(soft_from((double)rgb[k]), 32 - radiance_exp - e);

        texel.rgb9e5 |= (uint32_t)m << TEXEL_BITS * k; /* m <= 511 */
    }
    return texel;
}
