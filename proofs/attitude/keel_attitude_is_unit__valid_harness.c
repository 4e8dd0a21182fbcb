// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/attitude.c
// covers: keel_attitude_is_unit
//
// Any quaternion of components up to 2^62, the squares of which are finite: no operation overflows
// or gives a NaN. Those beyond, and what is no number: keel_attitude_is_unit__finite_harness.
#include "attitude_proof.h"

#define LARGEST 0x1p+62f

keel_attitude_quaternion_t nondet_quaternion(void);

void keel_attitude_is_unit__valid_harness(void)
{
    const keel_attitude_quaternion_t q = nondet_quaternion();
    bool is_unit;

    __CPROVER_assume(within(q.w, -LARGEST, LARGEST) && within(q.x, -LARGEST, LARGEST) &&
                     within(q.y, -LARGEST, LARGEST) && within(q.z, -LARGEST, LARGEST));

    is_unit = keel_attitude_is_unit(q);

    __CPROVER_assert(!is_unit || keel_attitude_is_unit_does(true, q),
                     "ATT_011_unit: a unit quaternion is finite and bounded");
}
