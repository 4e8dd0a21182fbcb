// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 3 --external-sat-solver cadical
// sources: src/flight/battery.c
// covers: keel_battery_init is_pack are_battery_ranges are_battery_levels set_battery_scale
// covers: begin_battery clear_sum clear_alarm whole_of
//
// Any bit pattern for all of a configuration: it is taken or refused as its clauses say, a refusal
// changes nothing, and what is made is valid, as every step keeps it
// (keel_battery_step__valid_harness).
#include "../common/unchanged.h"
#include "battery_proof.h"

void keel_battery_init__valid_harness(void)
{
    const keel_battery_config_t config = nondet_battery_config();
    keel_battery_t battery = any_battery_at_all();
    const keel_battery_t before = battery;
    const keel_status_t status = keel_battery_init(&battery, &config);
    const bool rate = battery_rate_here(&config);
    const bool limits = battery_limits_here(&config);
    const bool age = config.hold_steps > 0u;

    __CPROVER_assert(rate || (status == KEEL_ERR_RATE), "BAT_001_rate: a wrong rate is named");
    __CPROVER_assert(!rate || limits || (status == KEEL_ERR_LIMITS),
                     "BAT_001_limits: a number out of its range is named");
    __CPROVER_assert(!rate || !limits || age || (status == KEEL_ERR_AGE),
                     "BAT_001_age: a sample must be held for a step at least");
    __CPROVER_assert(!rate || !limits || !age || within(config.initial, 0.0f, 1.0f) ||
                         (status == KEEL_ERR_INITIAL),
                     "BAT_001_initial: a part of the charge is from 0 to 1");
    __CPROVER_assert((status == KEEL_OK) == battery_config_valid(&config),
                     "BAT_001_taken: all else is taken");
    if (status == KEEL_OK) {
        __CPROVER_assert(battery_config_same(&battery.config, &config),
                         "BAT_002_taken: the configuration is kept");
        __CPROVER_assert((900u <= battery.scale.capacity) &&
                             (battery.scale.capacity <= 3600000000u),
                         "BAT_002_capacity: a capacity is there, and no more than is counted");
        __CPROVER_assert(battery.scale.capacity == (uint32_t)(float)battery.scale.capacity,
                         "BAT_015_capacity: it is exact as a float");
        __CPROVER_assert(battery_scale_valid(&battery.scale),
                         "BAT_015_scale: what follows from a configuration is bounded");
        __CPROVER_assert(battery_counts_valid(&battery) && battery_values_valid(&battery) &&
                             battery_products_valid(&battery),
                         "BAT_015_made: what is made is valid");
    } else {
        __CPROVER_assert(unchanged(&battery, &before, sizeof(battery)),
                         "STA_001_kept: a refusal changes nothing");
        __CPROVER_assert(battery_same(&battery, &before), "BAT_001_kept: in no field");
    }
}
