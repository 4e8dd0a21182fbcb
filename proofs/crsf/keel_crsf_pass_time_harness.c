// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 65 --external-sat-solver cadical
// sources: src/middleware/crsf.c src/middleware/framing.c specs/model/crsf.c specs/model/framing.c
// replaces: keel_crsf_crc keel_framing_drop
// covers: keel_crsf_pass_time model_crsf_pass_time
#include "crsf_proof.h"

void keel_crsf_pass_time_harness(void)
{
    const uint32_t at = any_below(KEEL_FRAMING_BYTES);
    keel_crsf_t crsf = nondet_crsf();
    keel_crsf_t model = crsf;
    const uint32_t elapsed_us = nondet_u32();

    model_crsf_pass_time(&model, elapsed_us);

    keel_crsf_pass_time(&crsf, elapsed_us);

    __CPROVER_assert(crsf_same(&crsf, &model, at),
                     "CRF_009_model: every field is what the model says");
}
