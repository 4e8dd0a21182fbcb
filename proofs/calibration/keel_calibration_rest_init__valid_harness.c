// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --external-sat-solver cadical
// sources: src/flight/calibration.c
// covers: keel_calibration_rest_init rest_limits_fit are_within set_axes
// covers: keel_calibration_rest_begin
//
// Any bit pattern for all of a configuration: the contract of init, clause by clause; what is made
// is valid, as every step keeps it (keel_calibration_rest_step__valid_harness).
#include "../common/unchanged.h"
#include "calibration_proof.h"

void keel_calibration_rest_init__valid_harness(void)
{
    const keel_calibration_rest_config_t config = nondet_rest_config();
    keel_calibration_rest_t rest = any_rest_at_all();
    const keel_calibration_rest_t before = rest;
    const keel_status_t status = keel_calibration_rest_init(&rest, &config);
    const bool valid = expected_fits(&config) && rest_limits(&config);

    __CPROVER_assert(expected_fits(&config) || (status == KEEL_ERR_VALUE),
                     "CAL_001_expected: what cannot be measured is refused");
    __CPROVER_assert(!expected_fits(&config) || rest_limits(&config) || (status == KEEL_ERR_LIMITS),
                     "CAL_001_limits: then the other numbers");
    __CPROVER_assert((status == KEEL_OK) || unchanged(&rest, &before, sizeof(rest)),
                     "CAL_001_kept: a refusal changes nothing");
    __CPROVER_assert(!valid || ((status == KEEL_OK) && rest_config_same(&rest.config, &config) &&
                                rest_valid(&rest) && rest_counts(&rest)),
                     "CAL_002_taken: all others are taken, and what is made is valid");
    __CPROVER_assert((status != KEEL_OK) || rest_valid(&rest),
                     "CAL_013_made: and so within bounds");
    __CPROVER_assert((status != KEEL_OK) || ((rest.state == KEEL_CALIBRATION_IDLE) &&
                                             three_within(rest.offset, 0.0f, 0.0f)),
                     "CAL_003_idle: nothing is begun, nothing taken off");
}
