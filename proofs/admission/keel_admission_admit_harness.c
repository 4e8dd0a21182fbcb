// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/rtos/admission.c specs/model/admission.c
// covers: keel_admission_admit lesser_of utilisation_of gap_of model_admission_admit
//
// Totals, guard and limit have their full width. Bounded to periods up to 2^3 us and budgets below
// 2^6 us, as the utilisation divides. The contract under WP has no such bound and determines every
// field.
#include "../../specs/model/admission.h"
#include "admission_proof.h"

void keel_admission_admit_harness(void)
{
    keel_admission_t totals = any_totals();
    keel_admission_t expected = totals;
    const uint32_t priority = nondet_u32();
    const uint32_t period_us = any_bits(3u) + 1u;
    const uint32_t budget_us = any_bits(6u);
    keel_status_t modelled;
    keel_status_t status;

    __CPROVER_assume(keel_admission_admit_may(&totals, period_us, budget_us));
    modelled = model_admission_admit(&expected, priority, period_us, budget_us);

    status = keel_admission_admit(&totals, priority, period_us, budget_us);

    __CPROVER_assert(keel_admission_admit_does(status, &totals, &expected),
                     "ADM_003_model: as the model says");
    __CPROVER_assert(status == modelled, "ADM_003_model: for the reason that it says");
}
