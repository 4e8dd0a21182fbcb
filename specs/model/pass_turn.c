/* SPDX-License-Identifier: Apache-2.0 */
#include "pass.h"

#include <stddef.h>

keel_status_t model_pass_turn(keel_scheduler_t *scheduler)
{
    const keel_task_config_t *const task = model_pass_next(scheduler);
    uint32_t raw_us;

    if (task == NULL) {
        return KEEL_OK; /* SCH-026: the pass is over, or none is open */
    }
    /* SCH-026: the body, then the clock, then finish. */
    task->run(task->context);
    raw_us = scheduler->config.read_clock(scheduler->config.clock_context);
    return model_pass_finish(scheduler, raw_us);
}
