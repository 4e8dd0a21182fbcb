// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/rtos/queue.c
// defines: -DKEEL_QUEUE_CAPACITY=4u
// covers: keel_queue_advance add_saturating
//
// Bounded to periods up to 2^4 us, and up to 2^8 us of lateness, where the solver comes to the end
// of the division; keel_queue_advance__on_time_harness has numbers of their full width. The
// contract under WP has no such bound.
#include "../common/keel_proof.h"
#include "../common/queue_contracts.h"

void keel_queue_advance_harness(void)
{
    keel_queue_t queue = nondet_queue();
    const uint32_t slot = any_below(CAPACITY);
    const uint32_t x = any_below(CAPACITY);
    const uint64_t late_us = any_bits64(8u);
    uint64_t now_us;
    uint32_t period_us;
    uint64_t periods;
    keel_queue_t before;

    queue.period_us[slot] = any_bits(4u) + 1u;
    queue.release_us[slot] = any_bits64(62u);
    now_us = queue.release_us[slot] + late_us;
    before = queue;
    period_us = before.period_us[slot];

    __CPROVER_assume(keel_queue_advance_may(&queue, slot, now_us));
    keel_queue_advance(&queue, slot, now_us);

    __CPROVER_assert(keel_queue_advance_does(&before, &queue, slot, now_us, x),
                     "QUE_009_next: the next release lies ahead, by at most a period");
    /* With the release ahead by at most a period, this point of the grid is the only one. */
    periods = (uint64_t)queue.skipped[slot] - before.skipped[slot] + 1u;
    __CPROVER_assert((queue.skipped[slot] == UINT16_MAX) ||
                         ((queue.release_us[slot] - before.release_us[slot]) ==
                          (periods * period_us)),
                     "QUE_009_grid: the release moves on by whole periods, the skipped and one");
    __CPROVER_assert((queue.skipped[slot] >= before.skipped[slot]) &&
                         ((queue.skipped[slot] < UINT16_MAX) ||
                          ((before.skipped[slot] + (late_us / period_us)) >= UINT16_MAX)),
                     "QUE_009_skipped: the count stops at its limit, and only there");
    __CPROVER_assert(((queue.release_us[slot] - before.release_us[slot]) % period_us) == 0u,
                     "QUE_009_grid: the release moves on by whole periods at the limit, too");
}
