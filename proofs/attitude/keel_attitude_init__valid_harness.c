// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/attitude.c
// covers: keel_attitude_init attitude_gains_fit attitude_limits_fit is_field set_scale
// covers: keel_attitude_restart
//
// Any bit pattern for all of a configuration: what is made is valid, as every step keeps it
// (keel_attitude_step__valid_harness), and what follows from the configuration is finite and
// bounded; a refusal changes nothing. What is computed: keel_attitude_init_harness.
#include "../common/unchanged.h"
#include "attitude_proof.h"

void keel_attitude_init__valid_harness(void)
{
    const keel_attitude_config_t config = nondet_attitude_config();
    keel_attitude_t attitude = any_attitude_at_all();
    const keel_attitude_t before = attitude;
    const keel_status_t status = keel_attitude_init(&attitude, &config);

    if (status == KEEL_OK) {
        __CPROVER_assert(is_level(attitude.quaternion) && attitude_rest_valid(&attitude),
                         "ATT_011_made: what is made is valid");
        __CPROVER_assert(attitude_scale_valid(&attitude.scale),
                         "ATT_011_scale: what follows from a configuration is finite and bounded");
    } else {
        __CPROVER_assert(unchanged(&attitude, &before, sizeof(attitude)),
                         "STA_001_kept: a refusal changes nothing");
    }
}
