// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// checks: assertions
// sources: src/flight/battery.c
// covers: keel_battery_init
//
// What follows from a configuration whose quotients are exact in single precision. Wrong bodies are
// refuted here: where floats differ, z3 finds no example.
#include "battery_proof.h"

void keel_battery_init__exact_harness(void)
{
    const bool rate = nondet_bool();
    const bool cells = nondet_bool();
    const bool hold = nondet_bool();
    const bool initial = nondet_bool();
    const keel_battery_config_t config = {.capacity_ah = 2.0f,
                                          .initial = initial ? 0.75f : 1.5f,
                                          .resistance_ohm = 0.125f,
                                          .voltage_min = 8.0f,
                                          .voltage_max = 20.0f,
                                          .voltage_spread = 0.5f,
                                          .current_min = -2.0f,
                                          .current_max = 100.0f,
                                          .current_expected = 8.0f,
                                          .cap_s = 2000.0f,
                                          .low_voltage = 3.5f,
                                          .critical_voltage = 3.25f,
                                          .voltage_margin = 0.375f,
                                          .low_charge = 0.25f,
                                          .critical_charge = 0.125f,
                                          .rate_hz = rate ? 16u : 0u,
                                          .smoothing_steps = 3u,
                                          .settle_steps = 3u,
                                          .hold_steps = hold ? 5u : 0u,
                                          .cells = cells ? 4u : 0u,
                                          .modules = 2u};
    keel_battery_t battery = any_battery_at_all();
    const keel_status_t status = keel_battery_init(&battery, &config);

    __CPROVER_assert(status == (!rate      ? KEEL_ERR_RATE
                                : !cells   ? KEEL_ERR_LIMITS
                                : !hold    ? KEEL_ERR_AGE
                                : !initial ? KEEL_ERR_INITIAL
                                           : KEEL_OK),
                     "BAT_001_exact: the first that is wrong is named");
    if (status == KEEL_OK) {
        __CPROVER_assert((battery.scale.step_s == 0.0625f) && (battery.scale.unit_j == 16.0f) &&
                             (battery.scale.gain == 0.25f) && (battery.scale.per_cell == 0.25f) &&
                             (battery.scale.sag == 0.03125f) &&
                             (battery.scale.capacity == (2u * 3600u * 16u)) &&
                             (battery.scale.low == 28800u) && (battery.scale.critical == 14400u),
                         "BAT_002_exact: what follows from it");
        __CPROVER_assert((battery.initial == 86400u) && (battery.left == 86400u) &&
                             (battery.smoothed == 8.0f) && (battery.voltage_age == 5u) &&
                             (battery.module[0].age == 5u) && (battery.module[1].age == 5u),
                         "BAT_003_exact: what it begins with");
    }
}
