// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 3 --z3 --fpa
// checks: assertions
// sources: src/flight/battery.c specs/model/battery.c
// covers: keel_battery_step model_battery_step
//
// Any monitor at all, any bit pattern for all that was measured: the same as the model's, bit for
// bit. The solver sees that both compute the same only where nothing else is asked: all that a
// step calls is reached in keel_battery_step__reached_harness.
#include "../../specs/model/battery.h"
#include "battery_proof.h"

void keel_battery_step_harness(void)
{
    keel_battery_sample_t sample = any_battery_sample();
    const keel_battery_sample_t before = sample;
    keel_battery_t battery = any_battery_at_all();
    keel_battery_t model = battery;

    keel_battery_step(&battery, &sample);
    model_battery_step(&model, &before);

    __CPROVER_assert(battery_same(&battery, &model),
                     "BAT_016_model: every field is what the model says");
    __CPROVER_assert(battery_sample_same(&sample, &before),
                     "BAT_016_frame: the sample is not written");
}
