// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 26 --external-sat-solver cadical
// sources: src/middleware/sbus.c specs/model/sbus.c
// covers: keel_sbus_pass_time add_up_to_end model_sbus_pass_time sum_to_end
#include "sbus_proof.h"

void keel_sbus_pass_time_harness(void)
{
    const uint32_t at = any_below(KEEL_SBUS_BYTES);
    keel_sbus_t sbus = any_sbus();
    keel_sbus_t model = sbus;
    const uint32_t elapsed_us = nondet_u32();

    model_sbus_pass_time(&model, elapsed_us);

    keel_sbus_pass_time(&sbus, elapsed_us);

    __CPROVER_assert(sbus_same(&sbus, &model, at),
                     "RAD_008_model: every field is what the model says");
}
