// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 10 --external-sat-solver cadical
// defines: -DKEEL_LOG_RING_BYTES=8u
// sources: src/middleware/log_ring.c specs/model/log_ring.c
// covers: keel_log_ring_held held_between model_log_ring_held
//
// A ring of 8 bytes, as copying one into an array that shifts is what costs the solver time; WP
// proves the clauses for any size.
#include "log_ring_proof.h"

void keel_log_ring_held_harness(void)
{
    const keel_log_ring_t ring = any_ring();
    const uint32_t expected = model_log_ring_held(&ring);
    const uint32_t held = keel_log_ring_held(&ring);

    __CPROVER_assert(held == expected, "RIN_002_model: as many as the model says");
}
