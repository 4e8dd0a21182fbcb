// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 17 --external-sat-solver cadical
// sources: src/middleware/ppm.c
// checks: assertions
// covers: keel_ppm_init
//
// Each clause of the contract, without the model, for every configuration.
#include "ppm_proof.h"

void keel_ppm_init__clauses_harness(void)
{
    const keel_ppm_config_t config = nondet_ppm_config();
    const bool in_order = ppm_limits_here(&config) && (1u <= config.least) && (config.least <= 16u);
    const bool made = in_order && (config.frames_to_take > 0u);
    keel_ppm_t ppm = any_ppm();
    const keel_status_t status = keel_ppm_init(&ppm, &config);

    __CPROVER_assert(in_order || (status == KEEL_ERR_LIMITS),
                     "PPM_001_limits: limits that are not in order are named first");
    __CPROVER_assert(!in_order || (config.frames_to_take != 0u) || (status == KEEL_ERR_LATCH),
                     "PPM_001_frames: then a row of no frames");
    __CPROVER_assert(!made || ((status == KEEL_OK) && ppm_valid_here(&ppm) && (ppm.row == 0u) &&
                               !ppm.begun),
                     "PPM_002_made: what is made is valid, without a row or a frame");
    __CPROVER_assert(!made || ppm_config_same(&ppm.config, &config),
                     "PPM_002_config: the configuration is copied");
    __CPROVER_assert(!made || ((ppm.age_us == UINT32_MAX) && (ppm.channels == 0u) &&
                               (ppm.count.frames == 0u)),
                     "PPM_002_none: no frame came yet");
}
