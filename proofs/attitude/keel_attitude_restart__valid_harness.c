// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/attitude.c
// covers: keel_attitude_restart
//
// Any estimator with a valid configuration: a restart leaves all of it valid, as every step keeps
// it (keel_attitude_step__valid_harness). The quaternion is (1, 0, 0, 0), of length 1.
#include "attitude_proof.h"

void keel_attitude_restart__valid_harness(void)
{
    keel_attitude_t attitude = any_attitude_at_all();

    __CPROVER_assume(attitude_config_valid(&attitude.config));

    keel_attitude_restart(&attitude);

    __CPROVER_assert(is_level(attitude.quaternion), "ATT_003_level: the quaternion is level");
    __CPROVER_assert(vector_within(attitude.bias, 0.0f), "ATT_003_unbiased: there is no bias");
    __CPROVER_assert(vector_within(attitude.down, 0.0f) && vector_within(attitude.field, 0.0f),
                     "ATT_003_forgets: nothing was low-passed");
    __CPROVER_assert((attitude.phase == KEEL_ATTITUDE_STILL) && !attitude.heading_valid,
                     "ATT_003_still: it waits for rest, and nothing is valid");
    __CPROVER_assert(attitude_rest_valid(&attitude), "ATT_011_begins: all else is in bounds");
}
