// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/flight/battery.c specs/model/battery.c
// covers: keel_battery_step take_current take_currents has_voltage take_lower take_voltage
// covers: counted_up whole_of add_quanta amount_of_sum add_up_step less_or_zero time_left
// covers: estimate_rest unload_cell weigh_evidence judge_alarm judge_count judge_level
// covers: model_battery_step current_of_module voltage_counts voltage_of_modules one_step_older
// covers: integer_of sum_up value_of less_by rest_and_time alarm_step alarm_with level_step
// covers: lies_between brought_between
//
// Chosen monitors and samples, each in a case of its own: all that a step does is reached, and no
// operation on them overflows, gives a NaN or leaves an object. Of all others WP proves the latter,
// and keel_battery_step__valid_harness that nothing but numbers is kept.
#include "../../specs/model/battery.h"
#include "battery_points.h"

void keel_battery_step__reached_harness(void)
{
    for (unsigned point = 0u; point < POINTS; point++) {
        keel_battery_t battery;
        keel_battery_t model;
        keel_battery_sample_t sample;

        make_point(point, &battery, &sample);
        model = battery;

        keel_battery_step(&battery, &sample);
        model_battery_step(&model, &sample);

        __CPROVER_assert(battery.flags == model.flags, "BAT_016_reached: its flags");
    }
}
