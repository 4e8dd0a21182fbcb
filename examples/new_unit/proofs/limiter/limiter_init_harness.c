// SPDX-License-Identifier: Apache-2.0
// sources: src/app/limiter.c specs/model/limiter.c
// covers: limiter_init model_limiter_init
#include "proof.h"

void limiter_init_harness(void)
{
    const uint16_t limit = nondet_u16();
    limiter_t limiter = nondet_limiter();
    limiter_t expected = limiter;

    limiter_init(&limiter, limit);

    model_limiter_init(&expected, limit);
    __CPROVER_assert(limiter_same(&limiter, &expected), "LIM_001_model: as the model says");
}
