// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// checks: assertions
// sources: src/flight/reference.c
// covers: keel_reference_step
//
// Any valid reference generator, any bit pattern for the sticks: a stick and its deflection choose
// the same limit of the climb rate, or the deflection is 0, and so is its product with any limit.
// With keel_reference_step__clauses_harness it is the whole clause.
#include "step_clauses.h"

void keel_reference_step__sign_harness(void)
{
    const keel_reference_sticks_t sticks = nondet_sticks();
    keel_reference_t reference = nondet_reference();
    float climb;

    __CPROVER_assume(reference_valid_here(&reference));

    (void)keel_reference_step(&reference, &sticks);
    climb = deflection_of(&reference.climb, sticks.climb);

    __CPROVER_assert(!sticks_here(&sticks) || (climb == 0.0f) ||
                         ((climb < 0.0f) == (sticks.climb < 0.0f)),
                     "REF_005_climb: the stick says which limit");
}
