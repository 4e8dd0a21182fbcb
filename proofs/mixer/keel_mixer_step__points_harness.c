// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 13 --external-sat-solver cadical
// sources: src/flight/mixer.c specs/model/mixer.c specs/model/range.c
// covers: keel_mixer_step turn_motors is_command is_factor tamed_command tame_part
// covers: set_tilt fit_tilt fit_thrust put_out_all
// covers: with_yaw with_part without_yaw part_of_yaw fitting_part put_out_part
// covers: stop_motors model_mixer_step
//
// Chosen commands to four motors, with all that can give way: the same as the model's, and no
// operation overflows or gives a NaN: that is shown for these commands alone. For every command
// the step is the model's in keel_mixer_step__three_harness and its like; wrong bodies are refuted
// here, for where floats differ z3 finds no example.
#include "mixer_proof.h"

#define POINTS 12u

/* Nothing gives way; yaw upwards, downwards and with the other sign; thrust is raised and lowered,
 * alone and with yaw; roll and pitch are scaled; parts that are no numbers or out of range; full
 * thrust; disarmed. */
static const keel_mixer_command_t points[POINTS] = {
    {0.11f, 0.07f, 0.03f, 0.45f},  {0.13f, 0.01f, 0.43f, 0.7f},   {0.13f, -0.01f, 0.43f, 0.2f},
    {-0.13f, 0.01f, -0.6f, 0.5f},  {0.21f, -0.1f, 0.0f, 0.05f},   {0.21f, -0.1f, 0.3f, 0.95f},
    {0.71f, -0.37f, 0.3f, 0.5f},   {-0.91f, 0.77f, -0.9f, 0.95f}, {0x1p+100f, -2.0f, 3.0f, -1.0f},
    {0.1f, 0x1p-140f, 0.1f, 7.0f}, {0.0f, 0.0f, 0.0f, 1.0f},      {0.11f, 0.07f, 0.03f, 0.45f},
};

void keel_mixer_step__points_harness(void)
{
    const float infinity = __builtin_inff();

    for (uint32_t n = 0u; n < POINTS; n++) {
        keel_mixer_command_t command = points[n];
        keel_mixer_t mixer = four_motors(0.055f);
        keel_mixer_t model;

        if (n == 8u) {
            command.roll = infinity;
        }
        model = mixer;
        model_mixer_step(&model, &command, n != (POINTS - 1u));

        keel_mixer_step(&mixer, &command, n != (POINTS - 1u));

        __CPROVER_assert(mixer_same(&mixer, &model),
                         "MIX_004_model: outputs and flags are what the model says");
        __CPROVER_assert(mixer_valid_here(&mixer), "MIX_004_valid: the mixer stays valid");
    }
}
