// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34
// sources: src/rtos/decision.c src/rtos/priority.c specs/model/decision.c specs/model/priority.c
// covers: keel_decision_realtime model_decision_realtime
// defines: -DKEEL_QUEUE_CAPACITY=4u
//
// Bounded to a capacity of 4 tasks, with which the solver comes to an end in a minute; the contract
// under WP has no bound and determines the position.
#include "../../specs/model/decision.h"
#include "../common/decision_contracts.h"

void keel_decision_realtime_harness(void)
{
    keel_queue_t queue;
    const uint64_t now_us = nondet_u64();
    const uint32_t from = nondet_u32();
    const uint32_t to = nondet_u32();
    const uint32_t x = any_below(CAPACITY);
    uint32_t found;
    keel_queue_t before;

    any_queue(&queue, CAPACITY);
    __CPROVER_assume(keel_decision_realtime_may(&queue, from, to));
    before = queue;

    found = keel_decision_realtime(&queue, from, to, now_us);

    __CPROVER_assert(keel_decision_realtime_does(found, &queue, from, to, now_us),
                     "DEC_001_due: as the pass takes it to do");
    __CPROVER_assert(found == model_decision_realtime(&before, from, to, now_us),
                     "DEC_001_model: as the model says");
    __CPROVER_assert(queue_same(&queue, &before, x), "DEC_001_frame: nothing is written");
}
