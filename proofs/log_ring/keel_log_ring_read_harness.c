// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 10 --external-sat-solver cadical
// defines: -DKEEL_LOG_RING_BYTES=8u
// sources: src/middleware/log_ring.c specs/model/log_ring.c
// covers: keel_log_ring_read keel_log_ring_held held_between place_behind
// covers: model_log_ring_read model_log_ring_held line_of lay_out
//
// Any ring of 8 bytes, room for up to 9: the same as from an array that shifts.
#include "log_ring_proof.h"

void keel_log_ring_read_harness(void)
{
    keel_log_ring_t ring = any_ring();
    keel_log_ring_t model = ring;
    uint8_t to[RECORD_MOST];
    uint8_t model_to[RECORD_MOST];
    const uint32_t most = any_size();
    uint32_t expected;
    uint32_t count;

    any_bytes(to, RECORD_MOST);
    for (uint32_t i = 0u; i < RECORD_MOST; i++) {
        model_to[i] = to[i];
    }
    expected = model_log_ring_read(&model, model_to, most);

    count = keel_log_ring_read(&ring, to, most);

    __CPROVER_assert(count == expected, "RIN_008_model: as many bytes as from the model");
    for (uint32_t i = 0u; i < RECORD_MOST; i++) {
        __CPROVER_assert(to[i] == model_to[i], "RIN_008_bytes: the same bytes");
    }
    for (uint32_t i = 0u; i < KEEL_LOG_RING_BYTES; i++) {
        __CPROVER_assert(ring_same(&ring, &model, i), "RIN_008_rest: and the same is left");
    }
    __CPROVER_assert(ring_valid_here(&ring), "RIN_008_valid: it stays valid");
}
