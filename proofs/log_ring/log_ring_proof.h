/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file log_ring_proof.h
 * @brief What the harnesses of the log's ring share: arbitrary valid rings, and when two are the
 *        same.
 */
#ifndef LOG_RING_PROOF_H
#define LOG_RING_PROOF_H

#include "../../specs/model/log_ring.h"

#include <stdbool.h>

/* A record that never fits is among those that are tried. */
#define RECORD_MOST (KEEL_LOG_RING_BYTES + 1u)

uint8_t nondet_u8(void);
uint32_t nondet_u32(void);
uint64_t nondet_u64(void);
keel_log_ring_t nondet_ring(void);
keel_log_ring_loss_t nondet_loss(void);

/* ring_valid */
static bool ring_valid_here(const keel_log_ring_t *ring)
{
    return (ring->head < KEEL_LOG_RING_BYTES) && (ring->tail < KEEL_LOG_RING_BYTES);
}

static keel_log_ring_t any_ring(void)
{
    keel_log_ring_t ring = nondet_ring();

    __CPROVER_assume(ring_valid_here(&ring));
    return ring;
}

static void any_bytes(uint8_t *bytes, uint32_t count)
{
    for (uint32_t i = 0u; i < count; i++) {
        bytes[i] = nondet_u8();
    }
}

static uint32_t any_size(void)
{
    const uint32_t size = nondet_u32();

    __CPROVER_assume(size <= RECORD_MOST);
    return size;
}

static bool loss_same(const keel_log_ring_loss_t *a, const keel_log_ring_loss_t *b)
{
    return (a->records == b->records) && (a->since_us == b->since_us);
}

static bool ring_same(const keel_log_ring_t *a, const keel_log_ring_t *b, uint32_t i)
{
    return (a->head == b->head) && (a->tail == b->tail) && loss_same(&a->loss, &b->loss) &&
           (a->buffer[i] == b->buffer[i]);
}

static bool bytes_equal(const uint8_t *a, const uint8_t *b, uint32_t count)
{
    bool same = true;

    for (uint32_t i = 0u; i < count; i++) {
        same = same && (a[i] == b[i]);
    }
    return same;
}

#endif
