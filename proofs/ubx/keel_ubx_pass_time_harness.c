// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/middleware/ubx.c specs/model/ubx.c
// covers: keel_ubx_pass_time sum_up_to_end model_ubx_pass_time ubx_end
#include "ubx_proof.h"

void keel_ubx_pass_time_harness(void)
{
    keel_ubx_t ubx = any_ubx();
    keel_ubx_t model = ubx;
    const uint32_t elapsed_us = nondet_u32();

    model_ubx_pass_time(&model, elapsed_us);

    keel_ubx_pass_time(&ubx, elapsed_us);

    __CPROVER_assert(ubx_same(&ubx, &model), "UBX_008_model: every field is what the model says");
}
