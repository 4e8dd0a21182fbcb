// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 2 --z3
// checks: assertions
// sources: src/rtos/load.c specs/model/load.c
// covers: keel_load_ppm model_load_ppm
//
// For all numbers. The solver sees that both compute the same only where nothing else is asked:
// overflow is checked in keel_load_ppm__exact_harness, and for all numbers by WP.
#include "../../specs/model/load.h"
#include "load_proof.h"

void keel_load_ppm_harness(void)
{
    keel_load_t load = {.start_us = nondet_u64(), .busy_us = nondet_u64()};
    const keel_load_t before = load;
    const uint64_t now_us = nondet_u64();
    const uint64_t busy_us = nondet_u64();
    uint32_t load_ppm;

    __CPROVER_assume((load.start_us <= now_us) && ((now_us - load.start_us) <= UINT32_MAX));
    __CPROVER_assume((load.busy_us <= busy_us) &&
                     ((busy_us - load.busy_us) <= (now_us - load.start_us)));

    load_ppm = keel_load_ppm(&load, now_us, busy_us);

    __CPROVER_assert(load_ppm == model_load_ppm(&before, now_us, busy_us),
                     "LOD_007_model: the share of the window, rounded down");
    __CPROVER_assert(load_same(&load, &before), "LOD_007_frame: nothing changes");
}
