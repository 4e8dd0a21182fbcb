// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 9 --external-sat-solver cadical
// sources: src/flight/mixer.c specs/model/mixer.c specs/model/range.c
// covers: keel_mixer_step stop model_mixer_step
//
// Disarmed, any bit pattern of everything: the same as the model's step. Armed, a craft at idle, by
// example: three and four motors with any command have harnesses of their own.
#include "mixer_proof.h"

void keel_mixer_step_harness(void)
{
    const keel_mixer_command_t command = nondet_command();
    const keel_mixer_command_t nothing = {0.0f, 0.0f, 0.0f, 0.0f};
    keel_mixer_t mixer = nondet_mixer();
    keel_mixer_t model = mixer;
    keel_mixer_t idle = {.config = {keel_mixer_quad_x, 0.125f, 1.0f}};
    keel_mixer_t model_idle = idle;

    model_mixer_step(&model, &command, false);
    model_mixer_step(&model_idle, &nothing, true);

    keel_mixer_step(&mixer, &command, false);
    keel_mixer_step(&idle, &nothing, true);

    __CPROVER_assert(mixer_same(&mixer, &model), "MIX_003_model: stopped as the model says");
    __CPROVER_assert(mixer_same(&idle, &model_idle), "MIX_004_model: armed as the model says");
    __CPROVER_assert(idle.output[3] == 0.125f, "MIX_004_turning: armed motors idle");
}
