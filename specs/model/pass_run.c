/* SPDX-License-Identifier: Apache-2.0 */
#include "pass.h"

#include <stddef.h>

keel_status_t model_pass_run(keel_scheduler_t *scheduler)
{
    keel_status_t status = KEEL_OK;

    /* SCH-023: a real-time task at most once each, then one other task, or the end of the pass. */
    for (uint32_t i = 0u; i <= KEEL_QUEUE_CAPACITY; i++) {
        const keel_task_config_t *const task = model_pass_next(scheduler);

        if (task != NULL) {
            task->run(task->context);
            status = model_pass_finish(scheduler, scheduler->config
                                                      .read_clock(scheduler->config.clock_context));
        }
    }
    return status;
}
