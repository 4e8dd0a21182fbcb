// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/rtos/deviation.c
// covers: keel_deviation_add distance_us
//
// Bounded to deviations below 2^10 us or beyond the limit of 2^32 us, for the solver's sake: the
// square of any is in the harness of equality with the model, and in the contract under WP.
#include "deviation_proof.h"

void keel_deviation_add__exact_harness(void)
{
    keel_deviation_t deviation;
    keel_deviation_t before;
    const uint64_t start_us = nondet_u64();
    const uint32_t period_us = nondet_u32();
    uint64_t last_us;
    uint64_t off_us;
    keel_status_t status;

    deviation.sum_us2 = nondet_u64();
    deviation.starts = nondet_u32();
    deviation.start_us = nondet_u64();
    __CPROVER_assume((deviation.starts == 0u) || (deviation.start_us <= start_us));
    last_us = start_us - ((deviation.starts == 0u) ? start_us : deviation.start_us);
    off_us = (last_us >= period_us) ? (last_us - period_us) : (period_us - last_us);
    /* Small enough for the solver, or beyond the limit. */
    __CPROVER_assume((off_us < (1u << 10)) || (off_us > UINT32_MAX));
    before = deviation;

    status = keel_deviation_add(&deviation, start_us, period_us);

    if (before.starts == 0u) {
        __CPROVER_assert((status == KEEL_OK) && (deviation.starts == 1u) &&
                             (deviation.start_us == start_us) &&
                             (deviation.sum_us2 == before.sum_us2),
                         "DEV_001_first: the first start ends no period");
    } else if ((before.starts == UINT32_MAX) || (off_us > UINT32_MAX) ||
               (before.sum_us2 > (UINT64_MAX - ((off_us & 0x3FFu) * (off_us & 0x3FFu))))) {
        __CPROVER_assert(status == KEEL_ERR_STATE, "DEV_002: what would overflow is refused");
        __CPROVER_assert((deviation.starts == before.starts) &&
                             (deviation.start_us == before.start_us) &&
                             (deviation.sum_us2 == before.sum_us2),
                         "DEV_002_unchanged: a refusal adds nothing");
    } else {
        __CPROVER_assert(status == KEEL_OK, "DEV_001_ok: a start is taken");
        __CPROVER_assert((deviation.sum_us2 - before.sum_us2) ==
                             ((off_us & 0x3FFu) * (off_us & 0x3FFu)),
                         "DEV_001_sum: the square of the deviation is added");
        __CPROVER_assert(deviation.start_us == start_us, "DEV_001_start: the start is kept");
        __CPROVER_assert(deviation.starts == (before.starts + 1u), "DEV_001_starts: and counted");
    }
}
