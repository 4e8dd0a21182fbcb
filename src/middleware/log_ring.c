/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/middleware/log_ring.h"

/* How an index is read that the other side writes, and how one's own is handed to it. */
#ifndef KEEL_LOG_RING_LOAD
#define KEEL_LOG_RING_LOAD(index) (*(index))
#endif
#ifndef KEEL_LOG_RING_STORE
#define KEEL_LOG_RING_STORE(index, value) (*(index) = (value))
#endif

/*@ requires head < KEEL_LOG_RING_BYTES && tail < KEEL_LOG_RING_BYTES;
  @ assigns \nothing;
  @ ensures \result ==
  @     (head >= tail ? head - tail : KEEL_LOG_RING_BYTES - (tail - head));
  @ ensures \result < KEEL_LOG_RING_BYTES;
  @*/
static uint32_t held_between(uint32_t tail, uint32_t head)
{
    return (head >= tail) ? (head - tail) : (KEEL_LOG_RING_BYTES - (tail - head));
}

/*@ requires index < KEEL_LOG_RING_BYTES;
  @ assigns \nothing;
  @ ensures \result == ring_place(index, 1);
  @ ensures \result < KEEL_LOG_RING_BYTES;
  @*/
static uint32_t place_behind(uint32_t index)
{
    return ((index + 1u) < KEEL_LOG_RING_BYTES) ? (index + 1u) : 0u;
}

/* Whether so many bytes fit into what is free. */
/*@ requires \valid_read(ring) && ring_valid(ring);
  @ assigns \nothing;
  @ ensures \result <==> size <= ring_room(ring);
  @*/
static bool has_room(const keel_log_ring_t *ring, uint32_t size)
{
    const uint32_t tail = KEEL_LOG_RING_LOAD(&ring->tail);

    return size <= ((KEEL_LOG_RING_BYTES - 1u) - held_between(tail, ring->head));
}

/* A record that does not fit. */
/*@ requires \valid(loss);
  @ assigns loss->records, loss->since_us;
  @ ensures loss->records == ring_lost(\old(loss->records));
  @ ensures loss->since_us == (\old(loss->records) == 0 ? now_us : \old(loss->since_us));
  @*/
static void count_lost(keel_log_ring_loss_t *loss, uint64_t now_us)
{
    if (loss->records == 0u) {
        loss->since_us = now_us;
    }
    if (loss->records < UINT32_MAX) {
        loss->records++;
    }
}

/* Into what is free; nothing of it is the reader's before head says so. */
/*@ requires \valid(ring) && ring_valid(ring) && size <= ring_room(ring);
  @ requires \valid_read(record + (0 .. size - 1));
  @ requires \separated(record + (0 .. size - 1), ring);
  @ assigns ring->head, ring->buffer[0 .. KEEL_LOG_RING_BYTES - 1];
  @ ensures ring->head == ring_place(\old(ring->head), size) && ring_valid(ring);
  @ ensures ring_held(ring) == \old(ring_held(ring)) + size;
  @ ensures \forall integer k; 0 <= k < size ==>
  @     ring->buffer[ring_place(\at(ring->head, Pre), k)] == record[k];
  @ ensures \forall integer k; 0 <= k < \old(ring_held(ring)) ==>
  @     ring->buffer[ring_place(ring->tail, k)] ==
  @         \at(ring->buffer[ring_place(\at(ring->tail, Pre), k)], Pre);
  @*/
static void put_record(keel_log_ring_t *ring, const uint8_t *record, uint32_t size)
{
    uint32_t at = ring->head;

    /*@ loop invariant 0 <= i <= size;
      @ loop invariant at == ring_place(\at(ring->head, Pre), i) && at < KEEL_LOG_RING_BYTES;
      @ loop invariant \forall integer k; 0 <= k < i ==>
      @     ring->buffer[ring_place(\at(ring->head, Pre), k)] == record[k];
      @ loop invariant \forall integer k; 0 <= k < \at(ring_held(ring), Pre) ==>
      @     ring->buffer[ring_place(ring->tail, k)] ==
      @         \at(ring->buffer[ring_place(\at(ring->tail, Pre), k)], Pre);
      @ loop assigns i, at, ring->buffer[0 .. KEEL_LOG_RING_BYTES - 1];
      @ loop variant size - i;
      @*/
    for (uint32_t i = 0u; i < size; i++) {
        ring->buffer[at] = record[i];
        at = place_behind(at);
    }
    KEEL_LOG_RING_STORE(&ring->head, at);
}

void keel_log_ring_init(keel_log_ring_t *ring)
{
    ring->head = 0u;
    ring->tail = 0u;
    ring->loss.records = 0u;
    ring->loss.since_us = 0u;
}

uint32_t keel_log_ring_held(const keel_log_ring_t *ring)
{
    const uint32_t head = KEEL_LOG_RING_LOAD(&ring->head);

    return held_between(ring->tail, head);
}

bool keel_log_ring_write(keel_log_ring_t *ring, const uint8_t *record, uint32_t size,
                         uint64_t now_us)
{
    const bool fits = has_room(ring, size);

    if (fits) {
        put_record(ring, record, size);
    } else {
        count_lost(&ring->loss, now_us);
    }
    return fits;
}

bool keel_log_ring_take_loss(keel_log_ring_t *ring, uint32_t size, keel_log_ring_loss_t *loss)
{
    const bool told = (ring->loss.records > 0u) && has_room(ring, size);

    if (told) {
        loss->records = ring->loss.records;
        loss->since_us = ring->loss.since_us;
        ring->loss.records = 0u;
        ring->loss.since_us = 0u;
    }
    return told;
}

uint32_t keel_log_ring_read(keel_log_ring_t *ring, uint8_t *to, uint32_t most)
{
    const uint32_t held = keel_log_ring_held(ring);
    const uint32_t count = (most < held) ? most : held;
    uint32_t at = ring->tail;

    /*@ loop invariant 0 <= i <= count;
      @ loop invariant at == ring_place(\at(ring->tail, Pre), i) && at < KEEL_LOG_RING_BYTES;
      @ loop invariant \forall integer k; 0 <= k < i ==>
      @     to[k] == ring->buffer[ring_place(\at(ring->tail, Pre), k)];
      @ loop invariant \forall integer k; i <= k < most ==> to[k] == \at(to[k], Pre);
      @ loop assigns i, at, to[0 .. most - 1];
      @ loop variant count - i;
      @*/
    for (uint32_t i = 0u; i < count; i++) {
        to[i] = ring->buffer[at];
        at = place_behind(at);
    }
    KEEL_LOG_RING_STORE(&ring->tail, at);
    return count;
}
