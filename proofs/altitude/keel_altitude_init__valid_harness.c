// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/altitude.c src/flight/axis.c
// covers: keel_altitude_init
//
// Any bit pattern for all of a configuration: the contract of init, clause by clause; what is made
// is valid.
#include "../common/unchanged.h"
#include "altitude_proof.h"

void keel_altitude_init__valid_harness(void)
{
    const keel_axis_config_t config = nondet_axis_config();
    keel_altitude_t altitude = any_altitude_at_all();
    const keel_altitude_t before = altitude;
    const keel_status_t status = keel_altitude_init(&altitude, &config);
    const bool valid = axis_config_valid(&config);

    __CPROVER_assert(rate_fits(&config) || (status == KEEL_ERR_RATE),
                     "ALT_001_rate: a rate out of range is refused");
    __CPROVER_assert(!rate_fits(&config) || gains_fit(&config) || (status == KEEL_ERR_GAIN),
                     "ALT_001_gains: then a gain out of range");
    __CPROVER_assert(!rate_fits(&config) || !gains_fit(&config) || valid ||
                         (status == KEEL_ERR_LIMITS),
                     "ALT_001_limits: then limits, gates and numbers");
    __CPROVER_assert((status == KEEL_OK) || unchanged(&altitude, &before, sizeof(altitude)),
                     "ALT_001_kept: a refusal changes nothing");
    __CPROVER_assert(!valid ||
                         ((status == KEEL_OK) && axis_config_same(&altitude.axis.config, &config) &&
                          altitude_valid(&altitude)),
                     "ALT_002_taken: all others are taken, and what is made is valid");
    __CPROVER_assert((status != KEEL_OK) || ((altitude.axis.quality == KEEL_AXIS_NONE) &&
                                             !altitude.has_reference && (altitude.height == 0.0f)),
                     "ALT_002_unknown: nothing is known");
}
