// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 17 --external-sat-solver cadical
// sources: src/middleware/ppm.c specs/model/ppm.c specs/model/framing.c
// covers: keel_ppm_is_lost model_ppm_is_lost
//
// Any state at all.
#include "ppm_proof.h"

void keel_ppm_is_lost_harness(void)
{
    const keel_ppm_t ppm = any_ppm();
    const bool lost = keel_ppm_is_lost(&ppm);

    __CPROVER_assert(lost == model_ppm_is_lost(&ppm), "PPM_011_model: as the model says");
}
