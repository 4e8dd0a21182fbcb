// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 15 --external-sat-solver cadical
// sources: src/flight/mode.c
// checks: assertions
// covers: keel_mode_step change_state
//
// From every valid machine whose motors may turn, three frames with the kill switch on, just within
// the longest silence of each other, lead to TERMINATED. kill_us is such that three frames suffice:
// with a longer one it takes more of them.
#include "mode_proof.h"

void keel_mode_step__exit_harness(void)
{
    keel_mode_input_t input = nondet_mode_input();
    keel_mode_t mode = any_mode();

    __CPROVER_assume(valid_here(&mode) && mode.motors);
    __CPROVER_assume(mode.config.kill_us <= (2u * (mode.config.loss_us - 1u)));
    for (uint32_t n = 0u; n < 3u; n++) {
        input = nondet_mode_input();
        __CPROVER_assume(input.asked < KEEL_MODE_NONE);
        input.facts |= KEEL_MODE_RC_LINKED | KEEL_MODE_KILL_SWITCH_ON;
        input.elapsed_us = mode.config.loss_us - 1u;
        keel_mode_step(&mode, &input);
    }

    __CPROVER_assert(!mode.motors, "MOD_012_exit: whatever the state, the pilot can end it");
}
