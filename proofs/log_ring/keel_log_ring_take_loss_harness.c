// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 10 --external-sat-solver cadical
// defines: -DKEEL_LOG_RING_BYTES=8u
// sources: src/middleware/log_ring.c specs/model/log_ring.c
// covers: keel_log_ring_take_loss has_room model_log_ring_take_loss
//
// A ring of 8 bytes, as copying one into an array that shifts is what costs the solver time; WP
// proves the clauses for any size.
#include "../common/unchanged.h"
#include "log_ring_proof.h"

void keel_log_ring_take_loss_harness(void)
{
    keel_log_ring_t ring = any_ring();
    const keel_log_ring_t before = ring;
    keel_log_ring_t model = ring;
    keel_log_ring_loss_t loss = nondet_loss();
    keel_log_ring_loss_t model_loss = loss;
    const uint32_t size = nondet_u32();
    bool expected;
    bool told;

    expected = model_log_ring_take_loss(&model, size, &model_loss);

    told = keel_log_ring_take_loss(&ring, size, &loss);

    __CPROVER_assert(told == expected, "RIN_007_model: told when the model tells it");
    __CPROVER_assert(loss_same(&loss, &model_loss), "RIN_007_loss: what the model tells");
    for (uint32_t i = 0u; i < KEEL_LOG_RING_BYTES; i++) {
        __CPROVER_assert(ring_same(&ring, &model, i), "RIN_007_left: and not once more");
    }
    if (!told) {
        __CPROVER_assert(unchanged(&ring, &before, sizeof(ring)),
                         "RIN_007_nothing: otherwise nothing is changed");
    }
}
