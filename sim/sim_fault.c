/* sim_fault.c - make the HAL of the simulator fail at call N */
/* SPDX-License-Identifier: MIT */

#include "sim/sim_fault.h"

static struct {
    uint32_t at;
    uint32_t calls;
    sim_fault_t fault;
} state;

void sim_fault_arm(uint32_t call, sim_fault_t fault)
{
    state.at = call;
    state.calls = 0;
    state.fault = fault;
}

bool sim_fault_here(void)
{
    state.calls++;
    if (state.at == 0) {
        return false;
    }
    return state.fault == SIM_FAULT_ONCE ? state.calls == state.at
                                         : state.calls >= state.at;
}

uint32_t sim_fault_calls(void)
{
    return state.calls;
}
