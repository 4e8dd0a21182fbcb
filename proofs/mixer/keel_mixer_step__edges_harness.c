// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 11 --external-sat-solver cadical
// sources: src/flight/mixer.c specs/model/mixer.c specs/model/range.c
// covers: keel_mixer_step part_of_yaw fitting_part put_out_part
//
// Chosen commands to four motors at the edges between what fits and what does not: the same as the
// model's. Every command is dealt with as keel_mixer_step__points_harness says; wrong bodies that
// differ at an edge alone are refuted here.
#include "mixer_proof.h"

#define EDGES    10u
#define INFINITE __builtin_inff()

/* All fits, though the room for yaw is rounded to less than is asked for; a motor is beyond its
 * range by rounding alone, with no yaw to give way; all motors are beyond it; the first motor alone
 * leaves little room for yaw; one part alone of a command is out of range, each in turn; full
 * thrust that is rounded to more than that; disarmed, and no number. */
static const keel_mixer_command_t edges[EDGES] = {
    {-0.06f, -0.22f, 0.17f, 0.86f}, {0.4f, 0.25f, 0.0f, 0.99f},
    {0.0f, 0.0f, 1.0f, 0.5f},       {-0.2f, 0.2f, 0.3f, 0.5f},
    {-1.5f, 0.2f, 0.1f, 0.5f},      {0.3f, INFINITE, 0.1f, 0.5f},
    {0.2f, 0.1f, -INFINITE, 0.5f},  {0.1f, 0.2f, 0.05f, INFINITE},
    {0.0f, 0.0f, 0.0f, 1.0f},       {INFINITE, INFINITE, INFINITE, INFINITE},
};

void keel_mixer_step__edges_harness(void)
{
    for (uint32_t n = 0u; n < EDGES; n++) {
        keel_mixer_t mixer = four_motors((n == 8u) ? 0.067f : 0.055f);
        keel_mixer_t model = mixer;
        const bool armed = n != (EDGES - 1u);

        model_mixer_step(&model, &edges[n], armed);

        keel_mixer_step(&mixer, &edges[n], armed);

        __CPROVER_assert(mixer_same(&mixer, &model),
                         "MIX_004_model: outputs and flags are what the model says");
    }
}
