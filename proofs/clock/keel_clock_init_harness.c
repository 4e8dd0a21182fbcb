// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 2
// sources: specs/model/clock.c
// covers: keel_clock_init model_clock_init
#include "../../specs/model/clock.h"
#include "../common/keel_proof.h"

void keel_clock_init_harness(void)
{
    keel_clock_t clock = {.now_us = nondet_u64(), .raw_us = nondet_u32()};
    keel_clock_t model = {.now_us = nondet_u64(), .raw_us = nondet_u32()};
    const uint32_t raw_us = nondet_u32();

    keel_clock_init(&clock, raw_us);
    model_clock_init(&model, raw_us);

    __CPROVER_assert(clock_same(&clock, &model), "CLK_002_model: whatever was there before");
}
