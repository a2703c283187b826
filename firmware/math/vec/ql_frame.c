/* ql_frame.c - complete a unit vector to a frame, turn a direction by it */
/* SPDX-License-Identifier: MIT */

#include "math/vec/ql_frame.h"

#define ONE_Q29 ((int32_t)1 << 29)

/* Low word of floor(x 2^-29 + 1/2): wraps for what is no unit vector. */
static uint32_t round_q58(int64_t x)
{
    return (uint32_t)(((uint64_t)ql_asr64(x, 28) + 1) >> 1);
}

void ql_frame_from_normal(ql_frame_t *frame, ql_vec3_t n)
{
    /* 1/(1 + |z|) in [1/2, 1], u0.32: 1 + |z| = d 2^-29, 2 or fewer zeros */
    const uint32_t d = ((uint32_t)1 << 29) + ql_abs32(n.z);
    const unsigned zeros = ql_clz32(d);
    const uint32_t inverse = ql_recip_m(d << zeros) >> (2 - zeros);
    /* x and y over 1 + |z|, then the products with x and y, s2.29 */
    const int32_t x = ql_mulhi_su32(n.x, inverse);
    const int32_t y = ql_mulhi_su32(n.y, inverse);
    const uint32_t xx = round_q58((int64_t)n.x * x);
    const uint32_t xy = round_q58((int64_t)n.x * y);
    const uint32_t yy = round_q58((int64_t)n.y * y);
    const bool down = n.z < 0;

    frame->n = n;
    /* (1 - xx, -xy, -+x) and +-(-xy, 1 - yy, -+y) */
    frame->s.x = ql_i32((uint32_t)ONE_Q29 - xx);
    frame->s.y = ql_i32(0u - xy);
    frame->s.z = ql_i32(down ? (uint32_t)n.x : 0u - (uint32_t)n.x);
    frame->t.x = ql_i32(down ? xy : 0u - xy);
    frame->t.y = ql_i32(down ? yy - (uint32_t)ONE_Q29 : (uint32_t)ONE_Q29 - yy);
    frame->t.z = ql_i32(0u - (uint32_t)n.y);
}

/* Each product below 2^61 (length 2 times 1, and rounding): the sum of three
 * is that of two lengths, below 2^60. */
static ql_q29_t sum_q29(ql_vec3_t v, int32_t a, int32_t b, int32_t c)
{
    const int64_t sum = (int64_t)v.x * a + (int64_t)v.y * b + (int64_t)v.z * c;

    return ql_i32(round_q58(sum));
}

ql_vec3_t ql_frame_to_world(const ql_frame_t *frame, ql_vec3_t v)
{
    const ql_vec3_t r = {sum_q29(v, frame->s.x, frame->t.x, frame->n.x),
            sum_q29(v, frame->s.y, frame->t.y, frame->n.y),
            sum_q29(v, frame->s.z, frame->t.z, frame->n.z)};

    return r;
}
