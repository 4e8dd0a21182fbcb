// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 2
// sources: specs/model/clock.c
// covers: keel_clock_elapsed_us model_clock_elapsed_us
#include "../../specs/model/clock.h"
#include "../common/keel_proof.h"

void keel_clock_elapsed_us_harness(void)
{
    const uint32_t from_us = nondet_u32();
    const uint32_t to_us = nondet_u32();
    const uint32_t elapsed_us = keel_clock_elapsed_us(from_us, to_us);

    __CPROVER_assert(elapsed_us == model_clock_elapsed_us(from_us, to_us),
                     "CLK_001_model: the difference, modulo 2^32");
}
