/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file log_ring.h
 * @brief A ring of bytes between those who log and the one who stores, which loses whole records.
 *
 * One side writes records: it never waits, and a record is in the ring as a whole or not at all.
 * The other side reads bytes, as many as its medium takes, in the order in which they were written.
 * When the medium is slow and the ring full, records are lost and counted. As soon as there is room
 * again the count is handed out, once, with the time of the first that was lost, so that the writer
 * can say in the log itself what is missing, before it goes on.
 *
 * Each side writes its own: the writer writes head, loss and the buffer's free bytes, the reader
 * writes tail alone. The order: the writer reads tail, writes its bytes, and last of all head; the
 * reader reads head, copies bytes out, and last of all writes tail. Each index is read once and
 * written once in a call. So the sides need no lock: what the one has not seen yet of the other is
 * room, or bytes, that it gets in a later call.
 *
 * Sides that do not interrupt one another (two tasks of Keel) need nothing else. When one of them
 * is an interrupt or another thread, compiler and processor have to keep that order, which C99 has
 * no word for: build log_ring.c with KEEL_LOG_RING_LOAD(index), which reads through a pointer and
 * which no later access overtakes (acquire), and KEEL_LOG_RING_STORE(index, value), which overtakes
 * no earlier one (release). With GCC:
 *
 *     -D'KEEL_LOG_RING_LOAD(index)=__atomic_load_n((index), __ATOMIC_ACQUIRE)'
 *     -D'KEEL_LOG_RING_STORE(index, value)=__atomic_store_n((index), (value), __ATOMIC_RELEASE)'
 */
#ifndef KEEL_MIDDLEWARE_LOG_RING_H
#define KEEL_MIDDLEWARE_LOG_RING_H

#include "keel/c_declarations.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

/** Bytes of the buffer; one stays free, so that a full ring is not taken for an empty one. */
#ifndef KEEL_LOG_RING_BYTES
#define KEEL_LOG_RING_BYTES 8192u
#endif

#if (KEEL_LOG_RING_BYTES < 2u) || (KEEL_LOG_RING_BYTES > 0x40000000u)
#error "KEEL_LOG_RING_BYTES: 2 to 2^30"
#endif

/** The loss since the last report. */
typedef struct keel_log_ring_loss {
    uint32_t records;  /**< How many records; stays at UINT32_MAX. */
    uint64_t since_us; /**< The time of the first of them; 0 when none is lost. */
} keel_log_ring_loss_t;

/** A ring. Only the functions below write it. */
typedef struct keel_log_ring {
    uint32_t head;                       /**< Where the next byte goes; the writer's. */
    uint32_t tail;                       /**< Where the next byte comes from; the reader's. */
    keel_log_ring_loss_t loss;           /**< Not reported yet; the writer's. */
    uint8_t buffer[KEEL_LOG_RING_BYTES]; /**< From tail up to head: held; else: the writer's. */
} keel_log_ring_t;

/**
 * Makes a ring: empty, and nothing is lost (requirement RIN-001).
 *
 * @param ring the ring; what its buffer has is left as it is
 */
void keel_log_ring_init(keel_log_ring_t *ring);

/**
 * How many bytes are held, for the reader (requirement RIN-002).
 *
 * @param ring the ring, initialised
 * @return 0 to KEEL_LOG_RING_BYTES - 1
 */
uint32_t keel_log_ring_held(const keel_log_ring_t *ring);

/**
 * Writes a record, or counts it as lost; for the writer (requirements RIN-003 to RIN-006).
 *
 * @param ring   the ring, initialised
 * @param record its bytes, none of them in the ring
 * @param size   how many; more than KEEL_LOG_RING_BYTES - 1 never fit
 * @param now_us the time, in us
 * @return whether it is in the ring, behind all that is held. Otherwise none of its bytes is
 */
bool keel_log_ring_write(keel_log_ring_t *ring, const uint8_t *record, uint32_t size,
                         uint64_t now_us);

/**
 * Hands out what was lost, once, when there is room again; for the writer (requirement RIN-007).
 *
 * @param ring the ring, initialised
 * @param size the bytes for which there must be room: of the record that tells the loss, and of the
 *             one behind it. A write of no more than these succeeds after true
 * @param loss what was lost since the last time
 * @return whether records were lost and there is room. Otherwise nothing is changed
 */
bool keel_log_ring_take_loss(keel_log_ring_t *ring, uint32_t size, keel_log_ring_loss_t *loss);

/**
 * Takes bytes out, the oldest first; for the reader (requirement RIN-008).
 *
 * @param ring the ring, initialised
 * @param to   where they go, none of it in the ring
 * @param most how many at most
 * @return how many: as many as are held, up to most
 */
uint32_t keel_log_ring_read(keel_log_ring_t *ring, uint8_t *to, uint32_t most);

KEEL_C_END

#endif
