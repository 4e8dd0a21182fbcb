// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/middleware/framing.c specs/model/framing.c
// covers: keel_framing_sum keel_framing_pass_time model_framing_sum
//
// Any two numbers, added here and where time passes: each file has a copy of what is inline.
#include "../../specs/model/framing.h"
#include "../common/framing_contracts.h"

void keel_framing_sum_harness(void)
{
    const uint32_t a = nondet_u32();
    const uint32_t b = nondet_u32();
    const uint32_t sum = keel_framing_sum(a, b);
    keel_framing_t framing = {.quiet_us = a};

    keel_framing_pass_time(&framing, b);

    __CPROVER_assert(sum == model_framing_sum(a, b), "FRG_001_model: as the model says");
    __CPROVER_assert(framing.quiet_us == sum, "FRG_003_sum: silence is such a sum");
}
