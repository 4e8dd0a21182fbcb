// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 2
// sources: src/rtos/decision.c src/rtos/priority.c specs/model/decision.c specs/model/priority.c
// covers: keel_decision_room_us model_decision_room_us
#include "../../specs/model/decision.h"
#include "../common/keel_proof.h"

void keel_decision_room_us_harness(void)
{
    const uint64_t earliest_us = nondet_u64();
    const uint64_t now_us = nondet_u64();
    const uint32_t guard_us = nondet_u32();
    const uint32_t room_us = keel_decision_room_us(earliest_us, now_us, guard_us);

    __CPROVER_assert(room_us == model_decision_room_us(earliest_us, now_us, guard_us),
                     "DEC_005_model: as the model says");
}
