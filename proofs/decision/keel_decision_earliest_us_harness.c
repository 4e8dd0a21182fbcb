// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34
// sources: src/rtos/decision.c src/rtos/priority.c specs/model/decision.c specs/model/priority.c
// covers: keel_decision_earliest_us model_decision_earliest_us
// defines: -DKEEL_QUEUE_CAPACITY=8u
//
// Bounded to a capacity of 8 tasks, with which the solver comes to an end in a minute; the contract
// under WP has no bound and determines the time.
#include "../../specs/model/decision.h"
#include "../common/decision_contracts.h"

void keel_decision_earliest_us_harness(void)
{
    keel_queue_t queue;
    const uint32_t x = any_below(CAPACITY);
    uint64_t earliest_us;
    keel_queue_t before;

    any_queue(&queue, CAPACITY);
    __CPROVER_assume(keel_decision_earliest_us_may(&queue));
    before = queue;

    earliest_us = keel_decision_earliest_us(&queue);

    __CPROVER_assert(keel_decision_earliest_us_does(earliest_us, &queue),
                     "DEC_002_earliest: as the pass takes it to do");
    __CPROVER_assert(earliest_us == model_decision_earliest_us(&before),
                     "DEC_002_model: as the model says");
    __CPROVER_assert(queue_same(&queue, &before, x), "DEC_002_frame: nothing is written");
}
