// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 15 --external-sat-solver cadical
// sources: src/flight/mode.c specs/model/mode.c
// covers: keel_mode_step look_at_facts forget_stale_facts settle_facts read_frame has_frame add_us
// covers: has_settled exit_of wanted_by needs_of instead_of heed_mode_switch heed_arm_switch
// covers: is_piloted arming_refusal try_to_arm event_when is_time_up pilot_requests events_of
// covers: is_failsafe take_exit change_state choose_mode model_mode_step
//
// Every valid machine, every input of any bit pattern.
#include "mode_proof.h"

void keel_mode_step_harness(void)
{
    const keel_mode_input_t input = nondet_mode_input();
    keel_mode_t mode = any_mode();
    keel_mode_t model = mode;

    __CPROVER_assume(valid_here(&mode));
    model_mode_step(&model, &input);

    keel_mode_step(&mode, &input);

    for (uint32_t i = 0u; i < FACTS; i++) {
        __CPROVER_assert(mode_same(&mode, &model, i), "MOD_003_model: in every field");
    }
    __CPROVER_assert(valid_here(&mode), "MOD_003_valid: it stays valid");
}
