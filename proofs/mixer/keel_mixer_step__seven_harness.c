// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 9 --z3 --fpa
// reach: --refine
// checks: assertions
// sources: src/flight/mixer.c specs/model/mixer.c specs/model/range.c
// covers: keel_mixer_step model_mixer_step
//
// An armed mixer of seven motors, any bit pattern of everything else: as in
// keel_mixer_step__three_harness.
#include "mixer_proof.h"

void keel_mixer_step__seven_harness(void)
{
    const keel_mixer_command_t command = nondet_command();
    const bool armed = nondet_bool();
    keel_mixer_t mixer = nondet_mixer();
    keel_mixer_t model;

    mixer.config.geometry.motors = 7u;
    model = mixer;
    model_mixer_step(&model, &command, armed);

    keel_mixer_step(&mixer, &command, armed);

    /* Not before the step: z3 would not end. Disarmed: keel_mixer_step_harness. */
    __CPROVER_assume(armed);
    __CPROVER_assert(mixer_same(&mixer, &model),
                     "MIX_004_model: outputs and flags are what the model says");
}
