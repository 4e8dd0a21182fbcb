// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 9 --z3 --fpa
// checks: assertions
// sources: src/flight/mixer.c specs/model/mixer.c specs/model/range.c
// covers: keel_mixer_step turn stop is_command tame tamed set_tilt scale_tilt fit_thrust fits fit_yaw
// covers: fitting model_mixer_step
//
// Every number of motors, armed or not, any bit pattern of everything else: the same as the model's
// step, bit for bit. Each number is a case of its own, so that both sides are the same terms, which
// the solver sees at once. Overflow and NaN are checked in keel_mixer_step__valid_harness.
#include "mixer_proof.h"

#ifndef FROM
#define FROM KEEL_MIXER_MOTORS_MIN
#define TO KEEL_MIXER_MOTORS
#endif

void keel_mixer_step_harness(void)
{
    for (uint8_t motors = FROM; motors <= TO; motors++) {
        const keel_mixer_command_t command = nondet_command();
        const bool armed = nondet_bool();
        keel_mixer_t mixer = nondet_mixer();
        keel_mixer_t model;

        __CPROVER_assume(armed);
        mixer.config.geometry.motors = motors;
        model = mixer;
        model_mixer_step(&model, &command, armed);

        keel_mixer_step(&mixer, &command, armed);

        __CPROVER_assert(mixer_same(&mixer, &model),
                         "MIX_004_model: outputs and flags are what the model says");
    }
}
