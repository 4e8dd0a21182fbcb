// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/axis.c
// covers: keel_axis_init axis_gains_fit axis_limits_fit keel_axis_restart
//
// Any bit pattern for all of a configuration: the contract of init, clause by clause; what is made
// is valid, as every step keeps it (keel_axis_step__valid_harness). What is computed:
// keel_axis_init_harness.
#include "../common/unchanged.h"
#include "axis_proof.h"

void keel_axis_init__valid_harness(void)
{
    const keel_axis_config_t config = nondet_axis_config();
    keel_axis_t axis = any_axis_at_all();
    const keel_axis_t before = axis;
    const keel_status_t status = keel_axis_init(&axis, &config);
    const bool valid = axis_config_valid(&config);

    __CPROVER_assert(rate_fits(&config) || (status == KEEL_ERR_RATE),
                     "AXI_001_rate: a rate out of range is refused");
    __CPROVER_assert(!rate_fits(&config) || gains_fit(&config) || (status == KEEL_ERR_GAIN),
                     "AXI_001_gains: then a gain out of range");
    __CPROVER_assert(!rate_fits(&config) || !gains_fit(&config) || valid ||
                         (status == KEEL_ERR_LIMITS),
                     "AXI_001_limits: then limits, gates and numbers");
    __CPROVER_assert((status == KEEL_OK) || unchanged(&axis, &before, sizeof(axis)),
                     "AXI_001_kept: a refusal changes nothing");
    __CPROVER_assert(!valid || ((status == KEEL_OK) && axis_config_same(&axis.config, &config) &&
                                axis_valid(&axis)),
                     "AXI_002_taken: all others are taken, and what is made is valid");
    __CPROVER_assert((status != KEEL_OK) || (axis.quality == KEEL_AXIS_NONE),
                     "AXI_003_none: nothing is known");
}
