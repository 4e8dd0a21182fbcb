/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/middleware/log_ring.h
 * @brief The contracts of log_ring.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_MIDDLEWARE_LOG_RING_H
#define KEEL_INTERNAL_MIDDLEWARE_LOG_RING_H

#include "keel/c_declarations.h"
#include "keel/middleware/log_ring.h"

KEEL_C_BEGIN

/*@ // Between any two calls.
  @ predicate ring_valid(keel_log_ring_t *r) =
  @     r->head < KEEL_LOG_RING_BYTES && r->tail < KEEL_LOG_RING_BYTES;
  @
  @ logic integer ring_held(keel_log_ring_t *r) =
  @     r->head >= r->tail ? r->head - r->tail : KEEL_LOG_RING_BYTES - (r->tail - r->head);
  @
  @ logic integer ring_room(keel_log_ring_t *r) = KEEL_LOG_RING_BYTES - 1 - ring_held(r);
  @
  @ // So many places behind another one.
  @ logic integer ring_place(integer index, integer n) =
  @     index + n < KEEL_LOG_RING_BYTES ? index + n : index + n - KEEL_LOG_RING_BYTES;
  @
  @ logic integer ring_lost(integer records) = records < UINT32_MAX ? records + 1 : records;
  @*/

/*@ requires \valid(ring);
  @ assigns ring->head, ring->tail, ring->loss.records, ring->loss.since_us;
  @ ensures RIN_001_empty: ring_valid(ring) && ring_held(ring) == 0;
  @ ensures RIN_001_none: ring->loss.records == 0 && ring->loss.since_us == 0;
  @*/
void keel_log_ring_init(keel_log_ring_t *ring);

/*@ requires \valid_read(ring) && ring_valid(ring);
  @ assigns \nothing;
  @ ensures RIN_002_held: \result == ring_held(ring);
  @ ensures RIN_002_most: \result < KEEL_LOG_RING_BYTES;
  @*/
uint32_t keel_log_ring_held(const keel_log_ring_t *ring);

/*@ requires \valid(ring) && ring_valid(ring);
  @ requires \valid_read(record + (0 .. size - 1));
  @ requires \separated(record + (0 .. size - 1), ring);
  @ assigns ring->head, ring->loss.records, ring->loss.since_us,
  @     ring->buffer[0 .. KEEL_LOG_RING_BYTES - 1];
  @ ensures RIN_003_valid: ring_valid(ring);
  @ ensures RIN_003_whole: \result ==> ring_held(ring) == \old(ring_held(ring)) + size;
  @ ensures RIN_003_bytes: \result ==> \forall integer k; 0 <= k < size ==>
  @     ring->buffer[ring_place(\at(ring->head, Pre), k)] == record[k];
  @ ensures RIN_003_head: \result ==> ring->head == ring_place(\old(ring->head), size);
  @ ensures RIN_004_kept: \forall integer k; 0 <= k < \old(ring_held(ring)) ==>
  @     ring->buffer[ring_place(ring->tail, k)] ==
  @         \at(ring->buffer[ring_place(\at(ring->tail, Pre), k)], Pre);
  @ ensures RIN_004_none: !\result ==> ring->head == \old(ring->head) &&
  @     \forall integer k; 0 <= k < KEEL_LOG_RING_BYTES ==>
  @         ring->buffer[k] == \at(ring->buffer[k], Pre);
  @ ensures RIN_005_room: \result <==> size <= \old(ring_room(ring));
  @ ensures RIN_006_none: \result ==> ring->loss.records == \old(ring->loss.records) &&
  @     ring->loss.since_us == \old(ring->loss.since_us);
  @ ensures RIN_006_counted: !\result ==>
  @     ring->loss.records == ring_lost(\old(ring->loss.records));
  @ ensures RIN_006_since: !\result ==> ring->loss.since_us ==
  @     (\old(ring->loss.records) == 0 ? now_us : \old(ring->loss.since_us));
  @*/
bool keel_log_ring_write(keel_log_ring_t *ring, const uint8_t *record, uint32_t size,
                         uint64_t now_us);

/*@ requires \valid(ring) && ring_valid(ring) && \valid(loss) && \separated(ring, loss);
  @ assigns ring->loss.records, ring->loss.since_us, loss->records, loss->since_us;
  @ ensures RIN_007_when: \result <==>
  @     \old(ring->loss.records) > 0 && size <= ring_room(ring);
  @ ensures RIN_007_told: \result ==> loss->records == \old(ring->loss.records) &&
  @     loss->since_us == \old(ring->loss.since_us);
  @ ensures RIN_007_once: \result ==> ring->loss.records == 0 && ring->loss.since_us == 0;
  @ ensures RIN_007_kept: !\result ==> ring->loss.records == \old(ring->loss.records) &&
  @     ring->loss.since_us == \old(ring->loss.since_us) &&
  @     loss->records == \old(loss->records) && loss->since_us == \old(loss->since_us);
  @*/
bool keel_log_ring_take_loss(keel_log_ring_t *ring, uint32_t size, keel_log_ring_loss_t *loss);

/*@ requires \valid(ring) && ring_valid(ring);
  @ requires \valid(to + (0 .. most - 1));
  @ requires \separated(to + (0 .. most - 1), ring);
  @ assigns ring->tail, to[0 .. most - 1];
  @ ensures RIN_008_valid: ring_valid(ring);
  @ ensures RIN_008_count: \result ==
  @     (most < \old(ring_held(ring)) ? most : \old(ring_held(ring)));
  @ ensures RIN_008_first: \result > 0 ==> *to == ring->buffer[\at(ring->tail, Pre)];
  @ ensures RIN_008_bytes: \forall integer k; 0 <= k < \result ==>
  @     to[k] == ring->buffer[ring_place(\at(ring->tail, Pre), k)];
  @ ensures RIN_008_taken: ring_held(ring) == \old(ring_held(ring)) - \result;
  @ ensures RIN_008_tail: ring->tail == ring_place(\old(ring->tail), \result);
  @ ensures RIN_008_rest: \forall integer k; \result <= k < most ==> to[k] == \at(to[k], Pre);
  @*/
uint32_t keel_log_ring_read(keel_log_ring_t *ring, uint8_t *to, uint32_t most);

KEEL_C_END

#endif
