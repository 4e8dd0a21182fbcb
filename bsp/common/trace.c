/* SPDX-License-Identifier: Apache-2.0 */
#include "common/trace.h"

#include <stddef.h>

static uint32_t up_to_end(uint64_t time_us)
{
    return (time_us < UINT32_MAX) ? (uint32_t)time_us : UINT32_MAX;
}

/* How often something happened since the last look. */
static uint16_t newly(uint16_t *seen, uint16_t count)
{
    const uint16_t more = (uint16_t)(count - *seen);

    *seen = count;
    return more;
}

void keel_trace_start(keel_trace_t *trace, const keel_scheduler_t *scheduler)
{
    *trace = (keel_trace_t){0};
    for (uint32_t i = 0u; i < scheduler->queue.count; i++) {
        const uint32_t slot = scheduler->queue.order[i];

        trace->skipped[slot] = scheduler->queue.skipped[slot];
        trace->promotions[slot] = scheduler->queue.stats[slot].promotions;
    }
}

void keel_trace_begin(keel_trace_t *trace, const keel_scheduler_t *scheduler)
{
    const keel_queue_t *const queue = &scheduler->queue;
    const uint8_t slot = queue->order[scheduler->running];
    const keel_stats_t *const stats = &queue->stats[slot];
    keel_trace_run_t run = {.start_us = scheduler->clock.now_us, .slot = slot};

    if (stats->runs == 0u) { /* A slot's counters begin anew with its task. */
        trace->skipped[slot] = 0u;
        trace->promotions[slot] = 0u;
        run.flags = KEEL_TRACE_FIRST;
    }
    run.skipped = newly(&trace->skipped[slot], queue->skipped[slot]);
    if (newly(&trace->promotions[slot], stats->promotions) > 0u) {
        run.flags |= KEEL_TRACE_PROMOTED;
    }
    /* The release lies as many periods ahead of the one that is served as have passed, and one. */
    run.late_us = up_to_end(run.start_us + ((run.skipped + UINT64_C(1)) * queue->period_us[slot]) -
                            queue->release_us[slot]);
    trace->run = run;
}

void keel_trace_end(keel_trace_t *trace, const keel_scheduler_t *scheduler)
{
    const keel_scheduler_config_t *const config = &scheduler->config;

    trace->run.length_us = config->read_clock(config->clock_context) - scheduler->clock.raw_us;
}

void keel_trace_store(const keel_trace_t *trace, keel_log_ring_t *ring)
{
    const keel_trace_run_t *const run = &trace->run;
    keel_log_ring_loss_t loss;

    if (keel_log_ring_take_loss(ring, 2u * KEEL_TRACE_RUN_BYTES, &loss)) {
        const keel_trace_run_t lost = {.start_us = loss.since_us,
                                       .length_us = up_to_end(run->start_us - loss.since_us),
                                       .flags = KEEL_TRACE_LOST};

        (void)keel_log_ring_write(ring, (const uint8_t *)&lost, KEEL_TRACE_RUN_BYTES,
                                  run->start_us);
    }
    (void)keel_log_ring_write(ring, (const uint8_t *)run, KEEL_TRACE_RUN_BYTES, run->start_us);
}
