// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 9 --external-sat-solver cadical
// checks: assertions
// sources: src/flight/mixer.c specs/model/mixer.c specs/model/range.c
// covers: keel_mixer_step stop_motors model_mixer_step
//
// Disarmed, any bit pattern of everything but the number of motors: the same as the model's step.
// There is no motor here, which makes the armed step short, and would show if only motors were
// stopped. Armed: keel_mixer_step__three_harness.
#include "mixer_proof.h"

void keel_mixer_step_harness(void)
{
    const keel_mixer_command_t command = nondet_command();
    const bool armed = nondet_bool();
    keel_mixer_t mixer = nondet_mixer();
    keel_mixer_t model;

    mixer.config.geometry.motors = 0u;
    model = mixer;
    model_mixer_step(&model, &command, armed);

    keel_mixer_step(&mixer, &command, armed);

    __CPROVER_assume(!armed);
    __CPROVER_assert(mixer_same(&mixer, &model), "MIX_003_model: stopped as the model says");
}
