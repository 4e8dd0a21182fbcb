// cbmc: --z3
// checks: assertions
// sources: src/rtos/admission.c specs/model/admission.c
// covers: keel_admission_admit minimum utilisation_of gap_of model_admission_admit
//
// Every number; keel_admission_admit_harness makes the other checks.
#include "../../specs/model/admission.h"
#include "../common/admission_proof.h"

void keel_admission_admit__any_harness(void)
{
    keel_admission_t totals = any_totals();
    keel_admission_t expected = totals;
    const uint32_t priority = nondet_u32();
    const uint32_t period_us = nondet_u32();
    const uint32_t budget_us = nondet_u32();
    keel_status_t modelled;
    keel_status_t status;

    __CPROVER_assume(keel_admission_admit_may(&totals, period_us, budget_us));
    modelled = model_admission_admit(&expected, priority, period_us, budget_us);

    status = keel_admission_admit(&totals, priority, period_us, budget_us);

    __CPROVER_assert((status == modelled) && totals_same(&totals, &expected),
                     "ADM_002_model: as the model says");
}
