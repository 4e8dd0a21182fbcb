// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 65 --external-sat-solver cadical
// sources: src/middleware/crsf.c src/middleware/framing.c specs/model/crsf.c specs/model/framing.c
// replaces: keel_crsf_crc keel_framing_drop
// covers: keel_crsf_is_lost model_crsf_is_lost
//
// Any state at all.
#include "crsf_proof.h"

void keel_crsf_is_lost_harness(void)
{
    const keel_crsf_t crsf = nondet_crsf();
    const bool lost = keel_crsf_is_lost(&crsf);

    __CPROVER_assert(lost == model_crsf_is_lost(&crsf), "CRF_012_model: as the model says");
}
