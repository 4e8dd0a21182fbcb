// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 2
// sources: specs/model/clock.c
// covers: keel_clock_advance keel_clock_elapsed_us model_clock_advance model_clock_elapsed_us
#include "../../specs/model/clock.h"
#include "../common/keel_proof.h"

void keel_clock_advance_harness(void)
{
    keel_clock_t clock = {.now_us = nondet_u64(), .raw_us = nondet_u32()};
    keel_clock_t model = clock;
    const uint32_t raw_us = nondet_u32();
    keel_status_t status;

    __CPROVER_assume(clock.now_us <= KEEL_CLOCK_TIME_LIMIT_US);

    status = keel_clock_advance(&clock, raw_us);

    __CPROVER_assert(status == model_clock_advance(&model, raw_us),
                     "CLK_004_model: taken or refused as the model says");
    __CPROVER_assert(clock_same(&clock, &model),
                     "CLK_003_model: time and reading are what the model says");
}
