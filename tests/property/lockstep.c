/* SPDX-License-Identifier: Apache-2.0 */
#include "lockstep.h"

#include "../../specs/model/pass.h"
#include "../../specs/model/scheduler.h"

#include <stdbool.h>
#include <string.h>

static const char *difference;

const char *lockstep_difference(void)
{
    const char *const found = difference;

    difference = NULL;
    return found;
}

static bool stats_are_same(const keel_stats_t *a, const keel_stats_t *b)
{
    return (a->total_us == b->total_us) && (a->runs == b->runs) && (a->last_us == b->last_us) &&
           (a->longest_us == b->longest_us) && (a->remembered_us == b->remembered_us) &&
           (a->forgotten_in == b->forgotten_in) && (a->overruns == b->overruns) &&
           (a->promotions == b->promotions);
}

static bool queues_are_same(const keel_queue_t *a, const keel_queue_t *b)
{
    bool same = (a->count == b->count) && (a->realtime_count == b->realtime_count) &&
                (memcmp(a->order, b->order, sizeof a->order) == 0) &&
                (memcmp(a->priority, b->priority, sizeof a->priority) == 0) &&
                (memcmp(a->skipped, b->skipped, sizeof a->skipped) == 0) &&
                (memcmp(a->period_us, b->period_us, sizeof a->period_us) == 0) &&
                (memcmp(a->budget_us, b->budget_us, sizeof a->budget_us) == 0) &&
                (memcmp(a->release_us, b->release_us, sizeof a->release_us) == 0) &&
                (memcmp(a->task, b->task, sizeof a->task) == 0);

    for (uint32_t x = 0u; x < KEEL_QUEUE_CAPACITY; x++) {
        same = same && stats_are_same(&a->stats[x], &b->stats[x]);
    }
    return same;
}

static bool are_same(const keel_scheduler_t *a, const keel_scheduler_t *b)
{
    return (a->clock.now_us == b->clock.now_us) && (a->clock.raw_us == b->clock.raw_us) &&
           (a->wake_us == b->wake_us) && (a->busy_us == b->busy_us) &&
           (a->earliest_realtime_us == b->earliest_realtime_us) &&
           (a->earliest_other_us == b->earliest_other_us) &&
           (a->config.read_clock == b->config.read_clock) &&
           (a->config.clock_context == b->config.clock_context) &&
           (a->config.guard_us == b->config.guard_us) &&
           (a->config.utilisation_limit_ppm == b->config.utilisation_limit_ppm) &&
           (a->config.without_promotion == b->config.without_promotion) &&
           (a->cursor == b->cursor) && (a->pass_end == b->pass_end) && (a->running == b->running) &&
           (a->stage == b->stage) && queues_are_same(&a->queue, &b->queue);
}

static void compare(const char *function, bool answered_same, const keel_scheduler_t *kernel,
                    const keel_scheduler_t *specified)
{
    if ((difference == NULL) && !(answered_same && are_same(kernel, specified))) {
        difference = function;
    }
}

keel_status_t lockstep_check(const keel_scheduler_t *scheduler, uint32_t *admitted)
{
    const keel_scheduler_t before = *scheduler;
    uint32_t specified = 0u;
    const keel_status_t expected = model_scheduler_check(&before, &specified);
    const keel_status_t status = keel_scheduler_check(scheduler, admitted);

    compare("keel_scheduler_check", (status == expected) && (*admitted == specified), scheduler,
            &before);
    return status;
}

/* The body of a wrapper: the specification on a copy, the kernel's function on the scheduler, each
 * with its arguments in parentheses; what they answer and leave must be the same. */
#define LOCKSTEP(answer_t, function, on_copy, on_scheduler)                                        \
    keel_scheduler_t copy = *scheduler;                                                            \
    answer_t const expected = model_##function on_copy;                                            \
    answer_t const answer = keel_##function on_scheduler;                                          \
                                                                                                   \
    compare("keel_" #function, answer == expected, scheduler, &copy);                              \
    return answer

keel_status_t lockstep_add(keel_scheduler_t *scheduler, const keel_task_config_t *task)
{
    LOCKSTEP(keel_status_t, scheduler_add, (&copy, task), (scheduler, task));
}

keel_status_t lockstep_remove(keel_scheduler_t *scheduler, const keel_task_config_t *task)
{
    LOCKSTEP(keel_status_t, scheduler_remove, (&copy, task), (scheduler, task));
}

keel_status_t lockstep_start(keel_scheduler_t *scheduler)
{
    LOCKSTEP(keel_status_t, scheduler_start, (&copy), (scheduler));
}

keel_status_t lockstep_resync(keel_scheduler_t *scheduler)
{
    LOCKSTEP(keel_status_t, scheduler_resync, (&copy), (scheduler));
}

uint32_t lockstep_idle(keel_scheduler_t *scheduler, uint32_t latency_us, uint32_t longest_us)
{
    LOCKSTEP(uint32_t, scheduler_idle_us, (&copy, latency_us, longest_us),
             (scheduler, latency_us, longest_us));
}

keel_status_t lockstep_begin(keel_scheduler_t *scheduler, uint32_t raw_us)
{
    LOCKSTEP(keel_status_t, pass_begin, (&copy, raw_us), (scheduler, raw_us));
}

const keel_task_config_t *lockstep_next(keel_scheduler_t *scheduler)
{
    LOCKSTEP(const keel_task_config_t *, pass_next, (&copy), (scheduler));
}

keel_status_t lockstep_finish(keel_scheduler_t *scheduler, uint32_t raw_us)
{
    LOCKSTEP(keel_status_t, pass_finish, (&copy, raw_us), (scheduler, raw_us));
}
