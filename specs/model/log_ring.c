/* SPDX-License-Identifier: Apache-2.0 */
#include "log_ring.h"

/* All but one of the ring's bytes (RIN-005). */
#define MOST (KEEL_LOG_RING_BYTES - 1u)

/* What is held, the oldest first. */
typedef struct line {
    uint32_t held;
    uint8_t byte[MOST];
} line_t;

static void line_of(const keel_log_ring_t *ring, line_t *line)
{
    line->held = model_log_ring_held(ring);
    for (uint32_t i = 0u; i < line->held; i++) {
        line->byte[i] = ring->buffer[(ring->tail + i) % KEEL_LOG_RING_BYTES];
    }
}

/* From tail on, round the end; what is not held stays as it is. */
static void lay_out(keel_log_ring_t *ring, uint32_t tail, const line_t *line)
{
    for (uint32_t i = 0u; i < line->held; i++) {
        ring->buffer[(tail + i) % KEEL_LOG_RING_BYTES] = line->byte[i];
    }
    ring->tail = tail;
    ring->head = (tail + line->held) % KEEL_LOG_RING_BYTES;
}

/* RIN-001 */
void model_log_ring_init(keel_log_ring_t *ring)
{
    const keel_log_ring_loss_t none = {0u, 0u};

    ring->head = 0u;
    ring->tail = 0u;
    ring->loss = none;
}

/* RIN-002 */
uint32_t model_log_ring_held(const keel_log_ring_t *ring)
{
    return ((ring->head + KEEL_LOG_RING_BYTES) - ring->tail) % KEEL_LOG_RING_BYTES;
}

/* RIN-003 to RIN-006 */
bool model_log_ring_write(keel_log_ring_t *ring, const uint8_t *record, uint32_t size,
                          uint64_t now_us)
{
    line_t line;

    line_of(ring, &line);
    if (((uint64_t)line.held + size) > MOST) { /* RIN-005 */
        if (ring->loss.records == 0u) {        /* RIN-006 */
            ring->loss.since_us = now_us;
        }
        if (ring->loss.records != UINT32_MAX) {
            ring->loss.records = ring->loss.records + 1u;
        }
        return false;
    }
    for (uint32_t i = 0u; i < size; i++) { /* RIN-003 */
        line.byte[line.held + i] = record[i];
    }
    line.held += size;
    lay_out(ring, ring->tail, &line);
    return true;
}

/* RIN-007 */
bool model_log_ring_take_loss(keel_log_ring_t *ring, uint32_t size, keel_log_ring_loss_t *loss)
{
    const keel_log_ring_loss_t none = {0u, 0u};

    if ((ring->loss.records == 0u) || (((uint64_t)model_log_ring_held(ring) + size) > MOST)) {
        return false;
    }
    *loss = ring->loss;
    ring->loss = none;
    return true;
}

/* RIN-008: what is taken goes out at the front, and the rest moves up. */
uint32_t model_log_ring_read(keel_log_ring_t *ring, uint8_t *to, uint32_t most)
{
    line_t line;
    uint32_t count;

    line_of(ring, &line);
    count = (most > line.held) ? line.held : most;
    for (uint32_t i = 0u; i < count; i++) {
        to[i] = line.byte[i];
    }
    for (uint32_t i = count; i < line.held; i++) {
        line.byte[i - count] = line.byte[i];
    }
    line.held -= count;
    lay_out(ring, (ring->tail + count) % KEEL_LOG_RING_BYTES, &line);
    return count;
}
