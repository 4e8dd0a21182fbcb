// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 9 --z3 --fpa
// checks: assertions
// sources: src/flight/mixer.c specs/model/mixer.c specs/model/range.c
// covers: keel_mixer_step turn stop taken tilt ends_of fit_tilt fit_thrust fit_yaw fitting
// covers: model_mixer_step
//
// Any mixer with a number of motors in range, any bit pattern of everything else: the same as the
// model's step, bit for bit. Overflow and NaN are checked in keel_mixer_step__valid_harness.
#include "mixer_proof.h"

void keel_mixer_step_harness(void)
{
    const keel_mixer_command_t command = nondet_command();
    const bool armed = nondet_bool();
    keel_mixer_t mixer = nondet_mixer();
    keel_mixer_t model;

    __CPROVER_assume(mixer_valid_here(&mixer));
    model = mixer;
    model_mixer_step(&model, &command, armed);

    keel_mixer_step(&mixer, &command, armed);

    __CPROVER_assert(mixer_same(&mixer, &model),
                     "MIX_004_model: outputs and flags are what the model says");
}
