/* ql_bus.h - the three functions a panel driver needs of a board */
/* SPDX-License-Identifier: MIT */

/* A board links one panel driver and defines these for it. They are functions,
 * not pointers to functions, so that the worst case of the stack is known. */

#ifndef QL_BUS_H
#define QL_BUS_H

#include "base/ql_base.h"

/* Who listens to the bus. */
typedef enum { QL_BUS_NOBODY, QL_BUS_PANEL } ql_bus_listener_t;

/* Select the panel or release it, once everything sent has left. */
void ql_bus_select(ql_bus_listener_t listener);

/* Send bytes as commands. Returns false if the bus did not take them. */
QL_MUST_CHECK bool ql_bus_command(const uint8_t *bytes, uint16_t size);

/* Send bytes as pixels. */
QL_MUST_CHECK bool ql_bus_data(const uint8_t *bytes, uint16_t size);

#endif
