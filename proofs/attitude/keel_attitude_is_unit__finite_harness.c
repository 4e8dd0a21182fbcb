// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// checks: assertions
// sources: src/flight/attitude.c
// covers: keel_attitude_is_unit
//
// Any bit pattern: what is taken for a unit quaternion is finite, and its components are within
// 1 + 2^-10. Squares of what is no unit quaternion may overflow, and NaN is compared, on purpose.
#include "attitude_proof.h"

keel_attitude_quaternion_t nondet_quaternion(void);

void keel_attitude_is_unit__finite_harness(void)
{
    const keel_attitude_quaternion_t q = nondet_quaternion();
    bool is_unit;

    __CPROVER_assume(keel_attitude_is_unit_may());

    is_unit = keel_attitude_is_unit(q);

    __CPROVER_assert(keel_attitude_is_unit_does(is_unit, q),
                     "ATT_011_unit: a unit quaternion is finite and bounded");
}
