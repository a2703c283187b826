/* ql_order.c - which of two hits is the nearer, exactly if need be */
/* SPDX-License-Identifier: MIT */

#include "trace/ql_order.h"

#if QL_CFG_ORDER

typedef struct {
    uint64_t high, low;
} ql_order_product_t;

static ql_order_product_t whole_product(uint64_t a, uint64_t b)
{
    const uint32_t ah = (uint32_t)(a >> 32), al = (uint32_t)a;
    const uint32_t bh = (uint32_t)(b >> 32), bl = (uint32_t)b;
    const uint64_t low = ql_product_u32(al, bl);
    /* each below 2^64 - 2^33, so both fit the carry */
    const uint64_t one = ql_product_u32(ah, bl) + (low >> 32);
    const uint64_t two = ql_product_u32(al, bh) + (uint32_t)one;
    ql_order_product_t p;

    p.high = ql_product_u32(ah, bh) + (one >> 32) + (two >> 32);
    p.low = two << 32 | (uint32_t)low;
    return p;
}

bool ql_order_is_before_exactly(
        const ql_scene_t *scene, const ql_hit_t *a, const ql_hit_t *b)
{
    /* t / det is before t' / det' if t det' < t' det */
    const ql_order_product_t x = whole_product(a->exact_t, b->exact_det);
    const ql_order_product_t y = whole_product(b->exact_t, a->exact_det);
    const uint16_t rank = QL_LE16(scene->ranks[a->tri_idx]);
    const uint16_t other = QL_LE16(scene->ranks[b->tri_idx]);

    if (x.high != y.high || x.low != y.low) {
        return x.high < y.high || (x.high == y.high && x.low < y.low);
    }
    if (a->front != b->front) {
        return a->front;
    }
    if (rank != other) {
        return rank < other;
    }
    return a->tri_idx < b->tri_idx;
}

#endif
