// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// checks: assertions
// sources: src/flight/attitude.c
// covers: keel_attitude_is_unit
//
// Any bit pattern: where no component is beyond a unit's, |q|^2 says whether it is one.
#include "attitude_clauses.h"

keel_attitude_quaternion_t nondet_quaternion(void);

void keel_attitude_is_unit__clauses_harness(void)
{
    const keel_attitude_quaternion_t q = nondet_quaternion();
    const bool is_unit = keel_attitude_is_unit(q);

    __CPROVER_assert(!components_here(q) || (is_unit == is_unit_here(q)),
                     "ATT_016_unit: its length says whether it is a unit");
}
