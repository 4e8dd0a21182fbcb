// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 17 --external-sat-solver cadical
// sources: src/middleware/ppm.c specs/model/ppm.c specs/model/framing.c
// covers: keel_ppm_pass_time model_ppm_pass_time
#include "ppm_proof.h"

void keel_ppm_pass_time_harness(void)
{
    keel_ppm_t ppm = any_ppm();
    keel_ppm_t model = ppm;
    const uint32_t elapsed_us = nondet_u32();

    model_ppm_pass_time(&model, elapsed_us);

    keel_ppm_pass_time(&ppm, elapsed_us);

    for (uint32_t i = 0u; i < KEEL_PPM_CHANNELS; i++) {
        __CPROVER_assert(ppm_same(&ppm, &model, i),
                         "PPM_008_model: every field is what the model says");
    }
}
