/* ql_nasty.h - numbers that break arithmetic: ends, powers of two and next */
/* SPDX-License-Identifier: MIT */

#ifndef QL_NASTY_H
#define QL_NASTY_H

#include <stddef.h>
#include <stdint.h>

/* 32-bit patterns; tests read them as signed or unsigned. */
static const uint32_t nasty32[] = {0x00000000u, 0x00000001u, 0x00000002u,
        0x00000003u, 0x00000005u, 0x0000007fu, 0x00000080u, 0x000000ffu,
        0x00000100u, 0x00000101u, 0x00007ffeu, 0x00007fffu, 0x00008000u,
        0x00008001u, 0x0000fffeu, 0x0000ffffu, 0x00010000u, 0x00010001u,
        0x0001ffffu, 0x00800000u, 0x00ffffffu, 0x01000000u, 0x12345678u,
        0x1fffffffu, 0x20000000u, 0x33333333u, 0x3fffffffu, 0x40000000u,
        0x40000001u, 0x55555555u, 0x5a827999u, 0x7fff0000u, 0x7ffffffeu,
        0x7fffffffu, 0x80000000u, 0x80000001u, 0x8000ffffu, 0x80010000u,
        0x87654321u, 0x9e3779b9u, 0xaaaaaaaau, 0xb504f334u, 0xbfffffffu,
        0xc0000000u, 0xc0000001u, 0xcafebabeu, 0xdeadbeefu, 0xe0000000u,
        0xf0f0f0f0u, 0xfffeffffu, 0xffff0000u, 0xffff0001u, 0xffff7fffu,
        0xffff8000u, 0xffffff00u, 0xffffff01u, 0xfffffffdu, 0xfffffffeu,
        0xffffffffu};

#define NASTY_COUNT (sizeof nasty32 / sizeof nasty32[0])

#endif
