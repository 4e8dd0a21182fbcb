/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/flight/battery.h
 * @brief The contracts of battery.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_FLIGHT_BATTERY_H
#define KEEL_INTERNAL_FLIGHT_BATTERY_H

#include "keel/c_declarations.h"
#include "keel/flight/battery.h"

KEEL_C_BEGIN

/*@ predicate battery_number(float value, real least, real most) =
  @     \is_finite(value) && least <= value <= most;
  @
  @ predicate battery_rate(keel_battery_config_t c) =
  @     1 <= c.rate_hz <= KEEL_BATTERY_RATE_MAX_HZ;
  @
  @ predicate battery_pack(keel_battery_config_t c) =
  @     battery_number(c.capacity_ah, KEEL_BATTERY_CAPACITY_MIN_AH,
  @         KEEL_BATTERY_CAPACITY_MAX_AH) &&
  @     battery_number(c.resistance_ohm, 0, KEEL_BATTERY_RESISTANCE_LIMIT) &&
  @     1 <= c.cells <= KEEL_BATTERY_CELLS_MAX;
  @
  @ predicate battery_ranges(keel_battery_config_t c) =
  @     battery_number(c.voltage_max, 0, KEEL_BATTERY_VOLTAGE_LIMIT) &&
  @     battery_number(c.voltage_min, 0, c.voltage_max) &&
  @     battery_number(c.voltage_spread, 0, KEEL_BATTERY_VOLTAGE_LIMIT) &&
  @     battery_number(c.current_min, -KEEL_BATTERY_CURRENT_LIMIT, 0) &&
  @     battery_number(c.current_max, 0, KEEL_BATTERY_CURRENT_LIMIT) &&
  @     battery_number(c.current_expected, 0, KEEL_BATTERY_TOTAL_LIMIT) &&
  @     battery_number(c.cap_s, KEEL_BATTERY_CAP_MIN_S, KEEL_BATTERY_CAP_MAX_S) &&
  @     1 <= c.modules <= KEEL_BATTERY_MODULES;
  @
  @ predicate battery_levels(keel_battery_config_t c) =
  @     battery_number(c.low_voltage, 0, KEEL_BATTERY_CELL_LIMIT) &&
  @     battery_number(c.critical_voltage, 0, c.low_voltage) &&
  @     battery_number(c.voltage_margin, 0, KEEL_BATTERY_CELL_LIMIT) &&
  @     battery_number(c.low_charge, 0, 1) &&
  @     battery_number(c.critical_charge, 0, c.low_charge) &&
  @     c.smoothing_steps <= KEEL_BATTERY_SMOOTHING_MAX &&
  @     KEEL_BATTERY_SETTLE_MIN <= c.settle_steps;
  @
  @ predicate battery_limits(keel_battery_config_t c) =
  @     battery_pack(c) && battery_ranges(c) && battery_levels(c);
  @
  @ // An alarm that is raised ends with its count.
  @ predicate battery_alarm(keel_battery_alarm_t a, integer most) =
  @     a.count <= most && (a.raised ==> 0 < a.count);
  @
  @ // A step asks this of a monitor; init establishes it and every step keeps it.
  @ predicate battery_counts(keel_battery_t b) =
  @     0 < b.config.hold_steps && 0 < b.config.settle_steps &&
  @     b.charge.part < KEEL_BATTERY_QUANTA && b.energy.part < KEEL_BATTERY_QUANTA &&
  @     battery_alarm(b.low, b.config.settle_steps) &&
  @     battery_alarm(b.critical, b.config.settle_steps);
  @
  @ logic integer battery_quanta(keel_battery_sum_t s) =
  @     s.whole * KEEL_BATTERY_QUANTA + s.part;
  @
  @ // Not down to 0 by one step, nor up to settle_steps.
  @ predicate battery_steady(keel_battery_alarm_t was, keel_battery_alarm_t is, integer most) =
  @     (is.raised && !was.raised ==> is.count == most && most - 1 <= was.count) &&
  @     (!is.raised && was.raised ==> is.count == 0 && was.count <= 1);
  @*/

/*@ requires \valid(battery) && \valid_read(config) && \separated(battery, config);
  @ assigns *battery;
  @ ensures BAT_001_rate: !battery_rate(*config) ==> \result == KEEL_ERR_RATE;
  @ ensures BAT_001_limits: battery_rate(*config) && !battery_limits(*config) ==>
  @     \result == KEEL_ERR_LIMITS;
  @ ensures BAT_001_age: battery_rate(*config) && battery_limits(*config) &&
  @     config->hold_steps == 0 ==> \result == KEEL_ERR_AGE;
  @ ensures BAT_001_initial: battery_rate(*config) && battery_limits(*config) &&
  @     config->hold_steps > 0 && !battery_number(config->initial, 0, 1) ==>
  @     \result == KEEL_ERR_INITIAL;
  @ ensures BAT_001_kept: \result != KEEL_OK ==> *battery == \old(*battery);
  @ ensures BAT_002_taken: \result == KEEL_OK ==> battery->config == *config;
  @ ensures BAT_002_capacity: \result == KEEL_OK ==>
  @     900 <= battery->scale.capacity <= 3600000000;
  @*/
keel_status_t keel_battery_init(keel_battery_t *battery, const keel_battery_config_t *config);

/*@ requires \valid(battery);
  @ assigns battery->module[0 .. KEEL_BATTERY_MODULES - 1], battery->charge, battery->energy,
  @     battery->initial, battery->left, battery->voltage, battery->current, battery->smoothed,
  @     battery->cell_voltage, battery->charge_c, battery->energy_j, battery->remaining,
  @     battery->remaining_s, battery->low, battery->critical, battery->voltage_age,
  @     battery->known, battery->flags, battery->count, battery->level;
  @ ensures BAT_003_refused: !battery_number(part, 0, 1) ==>
  @     \result == KEEL_ERR_INITIAL && *battery == \old(*battery);
  @ ensures BAT_003_unused: battery_number(part, 0, 1) ==> \result == KEEL_OK &&
  @     battery->charge.whole == 0 && battery->charge.part == 0 &&
  @     battery->energy.whole == 0 && battery->energy.part == 0;
  @ ensures BAT_003_unknown: battery_number(part, 0, 1) ==>
  @     battery->level == KEEL_BATTERY_UNKNOWN && battery->count == KEEL_BATTERY_WAITING &&
  @     !battery->low.raised && !battery->critical.raised;
  @*/
keel_status_t keel_battery_restart(keel_battery_t *battery, float part);

/*@ requires \valid(battery) && \valid_read(sample) && \separated(battery, sample);
  @ requires battery_ranges(battery->config) && battery_counts(*battery);
  @ assigns battery->module[0 .. KEEL_BATTERY_MODULES - 1], battery->charge, battery->energy,
  @     battery->left, battery->voltage, battery->current, battery->smoothed,
  @     battery->cell_voltage, battery->charge_c, battery->energy_j, battery->remaining,
  @     battery->remaining_s, battery->low, battery->critical, battery->voltage_age,
  @     battery->known, battery->flags, battery->count, battery->level;
  @ ensures BAT_004_told: (battery->flags & KEEL_BATTERY_NO_CURRENT) == 0 ==>
  @     sample->module[0].has_current && battery_number(sample->module[0].current,
  @         battery->config.current_min, battery->config.current_max);
  @ ensures BAT_005_fresh: battery->voltage_age == 0 ==>
  @     battery_number(battery->voltage, battery->config.voltage_min, battery->config.voltage_max);
  @ ensures BAT_005_held: battery->voltage_age != 0 && \is_finite(\old(battery->voltage)) ==>
  @     battery->voltage == \old(battery->voltage);
  @ ensures BAT_006_lost: (battery->flags & KEEL_BATTERY_LOST) != 0 <==>
  @     battery->module[0].age >= battery->config.hold_steps;
  @ ensures BAT_007_forward: battery_quanta(\old(battery->charge)) <=
  @     battery_quanta(battery->charge);
  @ ensures BAT_007_whole: battery->charge.part < KEEL_BATTERY_QUANTA;
  @ ensures BAT_008_forward: battery_quanta(\old(battery->energy)) <=
  @     battery_quanta(battery->energy);
  @ ensures BAT_008_whole: battery->energy.part < KEEL_BATTERY_QUANTA;
  @ ensures BAT_009_left: battery->left == (battery->initial > battery->charge.whole
  @     ? battery->initial - battery->charge.whole : 0);
  @ ensures BAT_009_part: battery_number(battery->remaining, 0, 1);
  @ ensures BAT_010_range: battery_number(battery->remaining_s, 0, KEEL_BATTERY_CAP_MAX_S);
  @ ensures BAT_010_cap: battery->remaining_s <= battery->config.cap_s;
  @ ensures BAT_010_none: battery->left <= battery->scale.critical ==> battery->remaining_s == 0;
  @ ensures BAT_011_known: (battery->flags & KEEL_BATTERY_SAG) != 0 ==> (battery->flags &
  @     (KEEL_BATTERY_LOST | KEEL_BATTERY_LOST << 1)) == 0;
  @ ensures BAT_012_low: battery_steady(\old(battery->low), battery->low,
  @     battery->config.settle_steps);
  @ ensures BAT_012_critical: battery_steady(\old(battery->critical), battery->critical,
  @     battery->config.settle_steps);
  @ ensures BAT_013_low: \old(battery->low.raised) && !battery->low.raised ==>
  @     battery->voltage_age == 0 && battery->left > battery->scale.low;
  @ ensures BAT_013_critical: \old(battery->critical.raised) && !battery->critical.raised ==>
  @     battery->voltage_age == 0 && battery->left > battery->scale.critical;
  @ ensures BAT_014_alarm: (battery->level == KEEL_BATTERY_CRITICAL <==>
  @     battery->critical.raised) && (battery->level == KEEL_BATTERY_LOW <==>
  @     battery->low.raised && !battery->critical.raised);
  @ ensures BAT_014_ok: battery->level == KEEL_BATTERY_OK ==>
  @     battery->count == KEEL_BATTERY_COUNTED &&
  @     battery->voltage_age < battery->config.hold_steps &&
  @     battery->known == battery->config.settle_steps && (battery->flags &
  @         (KEEL_BATTERY_LOST | KEEL_BATTERY_LOST << 1 | KEEL_BATTERY_VOLTAGE_LOST)) == 0;
  @ ensures BAT_014_one: battery->level <= KEEL_BATTERY_CRITICAL &&
  @     (\old(battery->count) <= KEEL_BATTERY_UNCOUNTED ==>
  @     battery->count <= KEEL_BATTERY_UNCOUNTED);
  @ ensures BAT_014_latched: \old(battery->count) == KEEL_BATTERY_UNCOUNTED ==>
  @     battery->count == KEEL_BATTERY_UNCOUNTED;
  @ ensures BAT_015_bounded: battery_number(battery->current, 0, KEEL_BATTERY_TOTAL_LIMIT) &&
  @     battery_number(battery->smoothed, 0, KEEL_BATTERY_TOTAL_LIMIT);
  @ ensures BAT_016_rests: !sample->running &&
  @     battery_number(\old(battery->smoothed), 0, KEEL_BATTERY_TOTAL_LIMIT) ==>
  @     battery->smoothed == \old(battery->smoothed);
  @*/
void keel_battery_step(keel_battery_t *battery, const keel_battery_sample_t *sample);

KEEL_C_END

#endif
