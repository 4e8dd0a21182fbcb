// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 3 --z3 --fpa
// checks: assertions
// sources: src/flight/battery.c specs/model/battery.c
// covers: keel_battery_init is_pack are_battery_ranges are_battery_levels set_battery_scale
// covers: begin_battery clear_sum clear_alarm whole_of
// covers: model_battery_init pack_valid ranges_valid levels_valid start_anew integer_of
//
// Any bit pattern for all of a configuration: the same as the model's, bit for bit. The solver sees
// that both compute the same only where nothing else is asked: all other checks are in
// keel_battery_init__valid_harness.
#include "../../specs/model/battery.h"
#include "battery_proof.h"

void keel_battery_init_harness(void)
{
    keel_battery_config_t config = nondet_battery_config();
    const keel_battery_config_t before = config;
    keel_battery_t battery = any_battery_at_all();
    keel_battery_t model = battery;
    const keel_status_t status = keel_battery_init(&battery, &config);

    __CPROVER_assert(status == model_battery_init(&model, &before),
                     "BAT_001_model: taken or refused as the model says");
    __CPROVER_assert(battery_same(&battery, &model),
                     "BAT_002_model: every field is what the model says");
    __CPROVER_assert(battery_config_same(&config, &before),
                     "BAT_002_frame: the configuration is not written");
}
