// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// checks: assertions
// sources: src/flight/attitude.c specs/model/attitude.c
// covers: keel_attitude_is_unit model_attitude_is_unit
//
// Any quaternion at all: the same as the model's.
#include "../../specs/model/attitude.h"
#include "attitude_proof.h"

keel_attitude_quaternion_t nondet_quaternion(void);

void keel_attitude_is_unit_harness(void)
{
    const keel_attitude_quaternion_t q = nondet_quaternion();
    const bool is_unit = keel_attitude_is_unit(q);

    __CPROVER_assert(is_unit == model_attitude_is_unit(q),
                     "ATT_016_model: a unit quaternion as the model says");
}
