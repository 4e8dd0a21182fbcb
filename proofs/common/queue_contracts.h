/**
 * @file queue_contracts.h
 * @brief What keel_queue_advance asks for and does, as expressions of C without a division.
 *
 * Its own harness proves that it keeps the contract; in the harness of a pass it stands in for the
 * function, with all numbers of their full width.
 */
#ifndef QUEUE_CONTRACTS_H
#define QUEUE_CONTRACTS_H

#include "keel_proof.h"

static bool keel_queue_advance_may(const keel_queue_t *queue, uint32_t slot, uint64_t now_us)
{
    return (slot < CAPACITY) && (0u < queue->period_us[slot]) &&
           (queue->period_us[slot] < KEEL_PERIOD_LIMIT_US) && (queue->release_us[slot] <= now_us) &&
           (now_us <= KEEL_CLOCK_TIME_LIMIT_US);
}

/* Whether it did, as seen at a slot x. */
static bool keel_queue_advance_does(const keel_queue_t *before, const keel_queue_t *after,
                                    uint32_t slot, uint64_t now_us, uint32_t x)
{
    const uint64_t next_us = before->release_us[slot] + before->period_us[slot];
    keel_queue_t expected = *before;

    expected.release_us[slot] = after->release_us[slot];
    expected.skipped[slot] = after->skipped[slot];
    return (now_us < after->release_us[slot]) &&
           (after->release_us[slot] <= (now_us + before->period_us[slot])) &&
           ((now_us >= next_us) || ((after->release_us[slot] == next_us) &&
                                    (after->skipped[slot] == before->skipped[slot]))) &&
           ((now_us < next_us) || (after->skipped[slot] > before->skipped[slot]) ||
            (after->skipped[slot] == UINT16_MAX)) &&
           queue_same(after, &expected, x);
}

#endif
