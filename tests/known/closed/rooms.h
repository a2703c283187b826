/* rooms.h - closed rooms, turned and shrunk, that no light may leave */
/* SPDX-License-Identifier: MIT */

#ifndef ROOMS_H
#define ROOMS_H

#include "scene/world/world.h"

/* Every room is white, lies around its camera, and stands under a sky of 1: a
 * path that sees any of it has passed through a wall. */
typedef struct {
    const char *name;
    void (*build)(world_t *world);
} room_t;

extern const room_t rooms[];
extern const unsigned room_count;

/* Build a room.
 *
 *   world  -  out; world_free() it
 *   room   -  which
 *   turn   -  number of a turn; 0 is none
 *   part   -  how much of the grid the room takes: 1/part
 */
void room_open(world_t *world, const room_t *room, unsigned turn, double part);

#endif
