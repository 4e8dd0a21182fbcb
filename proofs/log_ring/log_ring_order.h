/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file log_ring_order.h
 * @brief The other side of the log's ring, at the two places of a call where the sides meet: where
 *        its index is read, and where ours is handed over. Harnesses build log_ring.c with calls of
 *        ring_load and ring_store for KEEL_LOG_RING_LOAD and KEEL_LOG_RING_STORE.
 *
 * The buffer has other bytes before the one place, between the two, and behind the other; only
 * those between are what the model starts from. The other side's index has its value in ring_load
 * alone. So a byte that is read too early or too late, or an index that is read past ring_load, is
 * any; a byte that is written too early is overwritten, and one that is written too late differs
 * from what was handed over.
 */
#ifndef LOG_RING_ORDER_H
#define LOG_RING_ORDER_H

#include "log_ring_proof.h"

/* What is met in ring_load: the index of the other side, and the buffer. */
static keel_log_ring_t met;
static const uint32_t *theirs;
static uint32_t loads;

/* What is handed over in ring_store, and what is in the buffer from there on. */
static keel_log_ring_t handed;
static keel_log_ring_t later;
static const uint32_t *ours;
static uint32_t stores;

/* The ring that both sides share. */
static keel_log_ring_t ring;

static void put_bytes(const keel_log_ring_t *from)
{
    for (uint32_t i = 0u; i < KEEL_LOG_RING_BYTES; i++) {
        ring.buffer[i] = from->buffer[i];
    }
}

uint32_t ring_load(const uint32_t *index)
{
    __CPROVER_assert(index == theirs, "RIN_009_theirs: the other side's index is read so");
    __CPROVER_assert((loads == 0u) && (stores == 0u), "RIN_009_load: once, and first of all");
    loads++;
    put_bytes(&met);
    return (index == &ring.head) ? met.head : met.tail;
}

void ring_store(uint32_t *index, uint32_t value)
{
    __CPROVER_assert(index == ours, "RIN_009_ours: our index is handed over so");
    __CPROVER_assert((loads == 1u) && (stores == 0u), "RIN_009_store: once, behind the other");
    stores++;
    *index = value;
    handed = ring;
    put_bytes(&later);
}

#endif
