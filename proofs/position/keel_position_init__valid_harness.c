// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/position.c src/flight/axis.c
// covers: keel_position_init accuracies_fit
//
// Any bit pattern for all of a configuration: the contract of init, clause by clause; what is made
// is valid.
#include "../common/unchanged.h"
#include "position_proof.h"

void keel_position_init__valid_harness(void)
{
    const keel_position_config_t config = nondet_position_config();
    keel_position_t position = any_position_at_all();
    const keel_position_t before = position;
    const keel_status_t status = keel_position_init(&position, &config);
    const bool accurate = accuracies_valid(&config);
    const bool valid = accurate && axis_config_valid(&config.axis);

    __CPROVER_assert(accurate || (status == KEEL_ERR_LIMITS),
                     "POS_001_accuracies: an accuracy out of range is refused");
    __CPROVER_assert(!accurate || rate_fits(&config.axis) || (status == KEEL_ERR_RATE),
                     "POS_001_rate: then a rate out of range");
    __CPROVER_assert(!accurate || !rate_fits(&config.axis) || gains_fit(&config.axis) ||
                         (status == KEEL_ERR_GAIN),
                     "POS_001_gains: then a gain out of range");
    __CPROVER_assert(!accurate || !rate_fits(&config.axis) || !gains_fit(&config.axis) || valid ||
                         (status == KEEL_ERR_LIMITS),
                     "POS_001_limits: then limits, gates and numbers");
    __CPROVER_assert((status == KEEL_OK) || unchanged(&position, &before, sizeof(position)),
                     "POS_001_kept: a refusal changes nothing");
    __CPROVER_assert(!valid ||
                         ((status == KEEL_OK) && position_config_same(&position.config, &config) &&
                          position_valid(&position)),
                     "POS_002_taken: all others are taken, and what is made is valid");
    __CPROVER_assert((status != KEEL_OK) ||
                         (!position.has_origin && (position.quality == KEEL_AXIS_NONE)),
                     "POS_002_unknown: nothing is known");
}
