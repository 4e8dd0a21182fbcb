// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// reach: --refine
// checks: assertions
// sources: src/flight/reference.c
// covers: keel_reference_step
//
// Any valid reference generator, any bit pattern for the sticks: the contract of a step, clause by
// clause, with the formulas of the header in the order in which they are rounded. Set-points are
// compared bit for bit, which z3 sees at once. Overflow and NaN are checked in
// keel_reference_step__valid_harness.
#include "step_clauses.h"

/* The limit by the deflection's sign, which is the stick's, or the deflection is 0
 * (keel_reference_step__sign_harness). The factors are in the order of the code: z3 sees one
 * term. */
static bool is_climb(const keel_reference_t *reference, const keel_reference_sticks_t *sticks)
{
    const float climb = deflection_of(&reference->climb, sticks->climb);

    return is_asked(reference->setpoints.climb_rate, climb,
                    (climb < 0.0f) ? reference->limits.descent_rate : reference->limits.climb_rate);
}

void keel_reference_step__clauses_harness(void)
{
    const keel_reference_sticks_t sticks = nondet_sticks();
    keel_reference_t reference = nondet_reference();
    const bool taken = sticks_here(&sticks);
    keel_status_t status;

    __CPROVER_assume(reference_valid_here(&reference));

    status = keel_reference_step(&reference, &sticks);

    __CPROVER_assert(taken || (status == KEEL_ERR_INPUT),
                     "REF_004_refused: a bad stick is refused");
    __CPROVER_assert(!taken || are_rates(&reference, &sticks),
                     "REF_005_rates: a limit times the deflection");
    __CPROVER_assert(!taken || are_angles(&reference, &sticks),
                     "REF_005_angles: the tilt times what the stick across leaves");
    __CPROVER_assert(!taken || is_climb(&reference, &sticks),
                     "REF_005_climb: one limit upwards, another downwards");
}
