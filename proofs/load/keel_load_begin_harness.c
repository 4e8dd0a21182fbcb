// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 2
// sources: src/rtos/load.c specs/model/load.c
// covers: keel_load_begin model_load_begin
#include "../../specs/model/load.h"
#include "load_proof.h"

void keel_load_begin_harness(void)
{
    keel_load_t load = {.start_us = nondet_u64(), .busy_us = nondet_u64()};
    keel_load_t model = {.start_us = nondet_u64(), .busy_us = nondet_u64()};
    const uint64_t now_us = nondet_u64();
    const uint64_t busy_us = nondet_u64();

    keel_load_begin(&load, now_us, busy_us);
    model_load_begin(&model, now_us, busy_us);

    __CPROVER_assert(load_same(&load, &model), "LOD_006_model: whatever was there before");
}
