// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 17 --external-sat-solver cadical
// sources: src/middleware/ppm.c specs/model/ppm.c specs/model/framing.c
// covers: keel_ppm_init model_ppm_init
#include "../common/unchanged.h"
#include "ppm_proof.h"

void keel_ppm_init_harness(void)
{
    const keel_ppm_config_t config = nondet_ppm_config();
    keel_ppm_t ppm = any_ppm();
    keel_ppm_t model = ppm;
    const keel_ppm_t before = ppm;
    const keel_status_t expected = model_ppm_init(&model, &config);
    const keel_status_t status = keel_ppm_init(&ppm, &config);

    __CPROVER_assert(status == expected, "PPM_001_model: taken or refused as the model says");
    for (uint32_t i = 0u; i < KEEL_PPM_CHANNELS; i++) {
        __CPROVER_assert(ppm_same(&ppm, &model, i),
                         "PPM_002_model: every field is what the model says");
    }
    if (status == KEEL_OK) {
        __CPROVER_assert(ppm_valid_here(&ppm), "PPM_002_valid: what is made is valid");
    } else {
        __CPROVER_assert(unchanged(&ppm, &before, sizeof(ppm)),
                         "STA_001_kept: a refusal changes nothing");
    }
}
