// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 2
// sources: src/rtos/admission.c specs/model/admission.c
// covers: keel_admission_init model_admission_init
//
// For every guard and limit that the precondition allows: a guard is below 2^31 us.
#include "../../specs/model/admission.h"
#include "../common/admission_contracts.h"

keel_admission_t nondet_admission(void);

void keel_admission_init_harness(void)
{
    keel_admission_t totals = nondet_admission();
    keel_admission_t expected = totals;
    const uint32_t guard_us = any_bits(31u);
    const uint32_t limit = any_below(KEEL_UTILISATION_FULL_PPM + 1u);

    model_admission_init(&expected, guard_us, limit);
    keel_admission_init(&totals, guard_us, limit);

    __CPROVER_assert(totals_same(&totals, &expected), "ADM_001_model: as the model says");
}
