/* sim_fault.h - make the HAL of the simulator fail at call N */
/* SPDX-License-Identifier: MIT */

#ifndef SIM_FAULT_H
#define SIM_FAULT_H

#include <stdbool.h>
#include <stdint.h>

typedef enum {
    SIM_FAULT_ONCE, /* call N fails, later ones work again: a glitch */
    SIM_FAULT_STAYS /* call N and every later one: something broke */
} sim_fault_t;

/* Arm: the call-th call that can fail shall fail, counted from 1; 0 is never.
 * Starts the count again. */
void sim_fault_arm(uint32_t call, sim_fault_t fault);

/* Count one call that can fail; true if it shall. For sim_hal.c. */
bool sim_fault_here(void);

/* Calls that could fail since sim_fault_arm(). */
uint32_t sim_fault_calls(void);

#endif
