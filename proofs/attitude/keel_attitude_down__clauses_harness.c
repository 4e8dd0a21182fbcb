// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// checks: assertions
// sources: src/flight/attitude.c
// covers: keel_attitude_down axes_of
//
// Any estimator at all: the contract of keel_attitude_down, bit for bit.
#include "attitude_clauses.h"

void keel_attitude_down__clauses_harness(void)
{
    const keel_attitude_t attitude = any_attitude_at_all();
    const keel_attitude_vector_t down = keel_attitude_down(&attitude);

    __CPROVER_assert(!components_here(attitude.quaternion) ||
                         float_same(down.z, down_here(attitude.quaternion)),
                     "ATT_019_down: 1 less twice the squares of x and y");
}
