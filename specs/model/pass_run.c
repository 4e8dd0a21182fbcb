/* SPDX-License-Identifier: Apache-2.0 */
#include "pass.h"

keel_status_t model_pass_run(keel_scheduler_t *scheduler)
{
    keel_status_t status = KEEL_OK;

    /* SCH-023: a turn for each real-time task at most, then one for another task, or for the end of
     * the pass. SCH-026: when the pass is over, a turn does nothing, and nothing is refused. */
    for (uint32_t i = 0u; i <= KEEL_QUEUE_CAPACITY; i++) {
        const keel_status_t turned = model_pass_turn(scheduler);

        if (status == KEEL_OK) {
            status = turned;
        }
    }
    return status;
}
