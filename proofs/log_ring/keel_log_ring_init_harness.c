// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 10 --external-sat-solver cadical
// defines: -DKEEL_LOG_RING_BYTES=8u
// sources: src/middleware/log_ring.c specs/model/log_ring.c
// covers: keel_log_ring_init model_log_ring_init
//
// Whatever was there.
#include "log_ring_proof.h"

void keel_log_ring_init_harness(void)
{
    keel_log_ring_t ring = nondet_ring();
    keel_log_ring_t model = ring;

    model_log_ring_init(&model);

    keel_log_ring_init(&ring);

    for (uint32_t i = 0u; i < KEEL_LOG_RING_BYTES; i++) {
        __CPROVER_assert(ring_same(&ring, &model, i),
                         "RIN_001_model: every field is what the model says");
    }
    __CPROVER_assert(ring_valid_here(&ring), "RIN_001_valid: what is made is valid");
}
