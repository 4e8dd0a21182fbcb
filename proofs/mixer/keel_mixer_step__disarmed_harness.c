// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 9 --external-sat-solver cadical
// sources: src/flight/mixer.c specs/model/mixer.c specs/model/range.c
// covers: stop keel_mixer_step model_mixer_step
//
// A disarmed mixer, any bit pattern of everything, the number of motors included: the same as the
// model's step.
#include "mixer_proof.h"

void keel_mixer_step__disarmed_harness(void)
{
    const keel_mixer_command_t command = nondet_command();
    keel_mixer_t mixer = nondet_mixer();
    keel_mixer_t model = mixer;

    model_mixer_step(&model, &command, false);

    keel_mixer_step(&mixer, &command, false);

    __CPROVER_assert(mixer_same(&mixer, &model), "MIX_003_model: stopped, all else as it was");
}
