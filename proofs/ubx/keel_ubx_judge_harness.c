// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/middleware/ubx.c specs/model/ubx.c
// covers: keel_ubx_judge model_ubx_judge
//
// Any decoder, whatever it holds.
#include "ubx_proof.h"

void keel_ubx_judge_harness(void)
{
    const keel_ubx_t ubx = any_ubx();

    __CPROVER_assert(keel_ubx_judge(&ubx) == model_ubx_judge(&ubx),
                     "UBX_013_model: the first reason, as the model says");
}
