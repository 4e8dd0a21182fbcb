// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/attitude.c
// covers: keel_attitude_down axes_of
//
// Any quaternion that a step leaves: no operation overflows or gives a NaN.
#include "attitude_proof.h"

void keel_attitude_down__valid_harness(void)
{
    const keel_attitude_t attitude = any_attitude_at_all();
    keel_attitude_vector_t down;

    __CPROVER_assume(keel_attitude_is_unit_does(true, attitude.quaternion));

    down = keel_attitude_down(&attitude);

    __CPROVER_assert(vector_within(down, 8.0f), "ATT_019_finite: the direction is finite");
}
