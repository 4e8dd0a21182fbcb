// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 9 --z3 --fpa
// checks: assertions
// sources: src/flight/mixer.c specs/model/mixer.c specs/model/range.c
// covers: keel_mixer_step turn is_command is_factor tame tamed
// covers: set_tilt fit_tilt fit_thrust put_out_all
// covers: with_yaw with_part without_yaw part_of_yaw fitting_part put_out_part stop
// covers: model_mixer_step
//
// An armed mixer of three motors, any bit pattern of everything else: the same as the model's step,
// bit for bit. Each number of motors has a harness of its own: with one number both sides are the
// same terms, and z3 sees at once that they are equal. Disarmed: keel_mixer_step_harness; all
// other checks: keel_mixer_step__points_harness.
#include "mixer_proof.h"

void keel_mixer_step__three_harness(void)
{
    const keel_mixer_command_t command = nondet_command();
    const bool armed = nondet_bool();
    keel_mixer_t mixer = nondet_mixer();
    keel_mixer_t model;

    mixer.config.geometry.motors = 3u;
    model = mixer;
    model_mixer_step(&model, &command, armed);

    keel_mixer_step(&mixer, &command, armed);

    if (armed) {
        __CPROVER_assert(mixer_same(&mixer, &model),
                         "MIX_004_model: outputs and flags are what the model says");
    }
}
