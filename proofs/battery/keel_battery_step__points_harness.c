// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --external-sat-solver cadical
// checks: assertions
// sources: src/flight/battery.c specs/model/battery.c
// covers: keel_battery_step model_battery_step
//
// Chosen monitors and samples, each in a case of its own: the same as the model's. All of them are
// dealt with in keel_battery_step_harness; wrong bodies are refuted here, for where floats differ
// z3 finds no example.
#include "../../specs/model/battery.h"
#include "battery_points.h"

void keel_battery_step__points_harness(void)
{
    for (unsigned point = 0u; point < POINTS; point++) {
        keel_battery_t battery;
        keel_battery_t model;
        keel_battery_sample_t sample;

        make_point(point, &battery, &sample);
        model = battery;

        keel_battery_step(&battery, &sample);
        model_battery_step(&model, &sample);

        __CPROVER_assert(battery_same(&battery, &model),
                         "BAT_016_points: every field is what the model says");
    }
}
