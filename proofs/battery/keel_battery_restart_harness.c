// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 3 --z3 --fpa
// checks: assertions
// sources: src/flight/battery.c specs/model/battery.c
// covers: keel_battery_restart begin_battery clear_sum clear_alarm whole_of
// covers: model_battery_restart start_anew lies_between
//
// Any monitor at all, any bit pattern for the part: the same as the model's, bit for bit. All other
// checks are in keel_battery_restart__valid_harness.
#include "../../specs/model/battery.h"
#include "battery_proof.h"

void keel_battery_restart_harness(void)
{
    const float part = nondet_float();
    keel_battery_t battery = any_battery_at_all();
    keel_battery_t model = battery;
    const keel_status_t status = keel_battery_restart(&battery, part);

    __CPROVER_assert(status == model_battery_restart(&model, part),
                     "BAT_003_status: done or refused as the model says");
    __CPROVER_assert(battery_same(&battery, &model),
                     "BAT_003_model: every field is what the model says");
}
