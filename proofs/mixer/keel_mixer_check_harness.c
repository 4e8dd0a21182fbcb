// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 9 --external-sat-solver cadical
// sources: src/flight/mixer.c specs/model/mixer.c specs/model/range.c
// covers: keel_mixer_check has_factors is_factor turns_about_axes model_mixer_check
//
// Any bit pattern of a configuration.
#include "mixer_proof.h"

void keel_mixer_check_harness(void)
{
    const keel_mixer_config_t config = nondet_config();
    const keel_mixer_config_t before = config;
    const keel_status_t expected = model_mixer_check(&config);
    const keel_status_t status = keel_mixer_check(&config);

    __CPROVER_assert(status == expected, "MIX_001_model: as the model says");
    __CPROVER_assert(config_same(&config, &before), "MIX_001_read: it is only read");
    __CPROVER_assert((status != KEEL_OK) || config_valid_here(&config),
                     "MIX_001_ok: what is taken is valid");
}
