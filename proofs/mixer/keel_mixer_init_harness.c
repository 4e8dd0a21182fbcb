// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 9 --external-sat-solver cadical
// sources: src/flight/mixer.c specs/model/mixer.c specs/model/range.c
// covers: keel_mixer_init keel_mixer_check stop_motors has_factors is_factor turns_about_axes
// covers: model_mixer_init
//
// Any bit pattern of a configuration, and of what was there before.
#include "../common/unchanged.h"
#include "mixer_proof.h"

void keel_mixer_init_harness(void)
{
    const keel_mixer_config_t config = nondet_config();
    keel_mixer_t mixer = nondet_mixer();
    const keel_mixer_t before = mixer;
    keel_mixer_t model = mixer;
    const keel_status_t expected = model_mixer_init(&model, &config);
    const keel_status_t status = keel_mixer_init(&mixer, &config);

    __CPROVER_assert(status == expected, "MIX_002_model: as the model says");
    __CPROVER_assert(mixer_same(&mixer, &model), "MIX_002_model: in every field");
    if (status != KEEL_OK) {
        __CPROVER_assert(unchanged(&mixer, &before, sizeof(mixer)),
                         "STA_001_kept: a refusal changes nothing");
    } else {
        __CPROVER_assert(mixer_valid_here(&mixer), "MIX_002_valid: it is valid");
    }
}
