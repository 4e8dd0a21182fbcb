// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// checks: assertions
// sources: src/flight/reference.c specs/model/reference.c
// covers: keel_reference_step are_sticks deflection rounded_off
// covers: model_reference_step deflected in_disc
//
// Any reference generator at all, any bit pattern for the sticks: the same as the model's, bit for
// bit. The solver sees that both compute the same only where nothing else is asked: overflow and
// NaN are checked in keel_reference_step__valid_harness.
#include "../../specs/model/reference.h"
#include "reference_proof.h"

void keel_reference_step_harness(void)
{
    keel_reference_sticks_t sticks = nondet_sticks();
    const keel_reference_sticks_t before = sticks;
    keel_reference_t reference = nondet_reference();
    keel_reference_t model = reference;
    const keel_status_t status = keel_reference_step(&reference, &sticks);

    __CPROVER_assert(status == model_reference_step(&model, &before),
                     "REF_004_model: taken or refused as the model says");
    __CPROVER_assert(reference_same(&reference, &model),
                     "REF_005_model: every field is what the model says");
    __CPROVER_assert(sticks_same(&sticks, &before), "REF_004_frame: the sticks are not written");
}
