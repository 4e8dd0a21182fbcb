// SPDX-License-Identifier: Apache-2.0
// sources: src/app/limiter.c specs/model/limiter.c
// covers: limiter_step model_limiter_step
#include "proof.h"

void limiter_step_harness(void)
{
    const uint16_t value = nondet_u16();
    limiter_t limiter = any_limiter();
    limiter_t expected = limiter;
    uint16_t result;

    result = limiter_step(&limiter, value);

    __CPROVER_assert(result == model_limiter_step(&expected, value),
                     "LIM_002_result: as the model says");
    __CPROVER_assert(limiter_same(&limiter, &expected), "LIM_002_model: as the model says");
}
