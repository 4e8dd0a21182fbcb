// SPDX-License-Identifier: Apache-2.0
// wp: theorem
/**
 * A loop that sleeps as long as keel_pass_idle_us says loses nothing (requirement SCH-027).
 *
 * The function `sleeping` is such a loop between two steps: it reads the clock, asks how long it
 * may sleep, and steps again after that time and the latency at most. The proof knows the contracts
 * of keel_pass_idle_us and keel_pass_begin and nothing else. Of a step at any moment of the sleep,
 * and of the latency behind it:
 *
 *   - its reading of the clock is told from a step backwards;
 *   - it comes no later than any release of a real-time task;
 *   - before the last of these moments nothing is due, so it runs no task.
 *
 * That the isolation theorems hold with such sleeps is proved in isolation.c.
 */
#include "keel/internal/rtos/pass.h"

#include <stdint.h>

/*@ requires memory: \valid(s) && scheduler_valid(s) && in_uptime(s);
  @ requires wake: wake_right(s);
  @ requires slept: clock_elapsed(raw_us, then_us) <=
  @     \max(0, \min(longest_us, sleep_left(s, raw_us, latency_us))) + latency_us;
  @ assigns s->clock.now_us, s->clock.raw_us, s->wake_us, s->stage, s->cursor, s->pass_end;
  @*/
void sleeping(keel_scheduler_t *s, uint32_t raw_us, uint32_t latency_us, uint32_t longest_us,
              uint32_t then_us)
{
    const uint32_t idle_us = keel_pass_idle_us(s, raw_us, latency_us, longest_us);
    keel_status_t status;

    if (idle_us == 0u) {
        return;
    }
    /*@ assert elapsed: clock_elapsed(s->clock.raw_us, then_us) ==
      @     clock_elapsed(s->clock.raw_us, raw_us) + clock_elapsed(raw_us, then_us);
      @*/
    status = keel_pass_begin(s, then_us);
    (void)status;
    //@ assert SCH_027_known: status == KEEL_OK;
    //@ assert SCH_027_end: s->clock.now_us <= \at(s->wake_us, Pre);
    /*@ assert SCH_027_release: \forall integer j; 0 <= j < s->queue.realtime_count ==>
      @     s->clock.now_us <= s->queue.release_us[s->queue.order[j]];
      @*/
    /*@ assert SCH_027_nothing: s->clock.now_us < \at(s->wake_us, Pre) ==>
      @     s->stage == KEEL_STAGE_READY && nothing_due(s);
      @*/
}
