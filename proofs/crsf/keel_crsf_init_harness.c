// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 65 --external-sat-solver cadical
// sources: src/middleware/crsf.c src/middleware/framing.c specs/model/crsf.c specs/model/framing.c
// replaces: keel_crsf_crc keel_framing_drop
// covers: keel_crsf_init model_crsf_init
#include "../common/unchanged.h"
#include "crsf_proof.h"

void keel_crsf_init_harness(void)
{
    const uint32_t at = any_below(KEEL_FRAMING_BYTES);
    const keel_crsf_config_t config = nondet_crsf_config();
    keel_crsf_t crsf = nondet_crsf();
    keel_crsf_t model = crsf;
    const keel_crsf_t before = crsf;
    const keel_status_t expected = model_crsf_init(&model, &config);
    const keel_status_t status = keel_crsf_init(&crsf, &config);

    __CPROVER_assert(status == expected, "CRF_001_model: taken or refused as the model says");
    __CPROVER_assert(crsf_same(&crsf, &model, at),
                     "CRF_002_model: every field is what the model says");
    if (status == KEEL_OK) {
        __CPROVER_assert(crsf_valid_here(&crsf), "CRF_002_valid: what is made is valid");
    } else {
        __CPROVER_assert(unchanged(&crsf, &before, sizeof(crsf)),
                         "STA_001_kept: a refusal changes nothing");
    }
}
