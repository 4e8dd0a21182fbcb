/* SPDX-License-Identifier: Apache-2.0 */
#include "clock.h"
#include "pass.h"

/* What is left of a time when another is taken from it. */
static uint64_t rest(uint64_t time_us, uint64_t taken_us)
{
    return (time_us < taken_us) ? 0u : (time_us - taken_us);
}

static uint64_t least(uint64_t one_us, uint64_t other_us)
{
    return (other_us < one_us) ? other_us : one_us;
}

/* SCH-027: what is left, when the step comes so long after the last reading, until a task may be
 * due, and until the counter's turns cannot be told; or the longest sleep. */
uint32_t model_pass_idle_us(const keel_scheduler_t *scheduler, uint32_t raw_us, uint32_t latency_us,
                            uint32_t longest_us)
{
    const uint64_t since_us = (uint64_t)model_clock_elapsed_us(scheduler->clock.raw_us, raw_us) +
                              latency_us;
    const uint64_t due_us = rest(scheduler->wake_us, scheduler->clock.now_us + since_us);
    const uint64_t told_us = rest(0x7FFFFFFFu, since_us);

    if (scheduler->stage != KEEL_STAGE_READY) {
        return 0u;
    }
    return (uint32_t)least(longest_us, least(due_us, told_us));
}
