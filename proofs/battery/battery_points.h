/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file battery_points.h
 * @brief Chosen monitors and samples: between them they reach all that a step does.
 */
#ifndef BATTERY_POINTS_H
#define BATTERY_POINTS_H

#include "battery_proof.h"

#define POINTS 33u

/* In flight with two modules, 4 cells, 1 Ah and 10 steps per second; all is known. */
static const keel_battery_t flying = {.config = {.capacity_ah = 1.0f,
                                                 .initial = 1.0f,
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
                                                 .voltage_margin = 0.25f,
                                                 .low_charge = 0.25f,
                                                 .critical_charge = 0.125f,
                                                 .rate_hz = 10u,
                                                 .smoothing_steps = 3u,
                                                 .settle_steps = 3u,
                                                 .hold_steps = 4u,
                                                 .cells = 4u,
                                                 .modules = 2u},
                                      .scale = {.step_s = 0.1f,
                                                .unit_j = 25.6f,
                                                .gain = 0.25f,
                                                .per_cell = 0.25f,
                                                .sag = 0.03125f,
                                                .per_capacity = 0.0000277777781f,
                                                .capacity = 36000u,
                                                .low = 9000u,
                                                .critical = 4500u},
                                      .module = {{.current = 2.0f}, {.current = 4.0f}},
                                      .charge = {.whole = 500u, .part = 1000u},
                                      .energy = {.whole = 30u, .part = 2000u},
                                      .initial = 36000u,
                                      .left = 35500u,
                                      .voltage = 15.5f,
                                      .current = 6.0f,
                                      .smoothed = 12.0f,
                                      .low = {.count = 1u},
                                      .critical = {.count = 1u},
                                      .known = 2u,
                                      .count = KEEL_BATTERY_COUNTED,
                                      .level = KEEL_BATTERY_UNKNOWN};

static const keel_battery_sample_t drawn = {
    .module = {{.voltage = 15.25f, .current = 3.0f, .has_voltage = true, .has_current = true},
               {.voltage = 15.5f, .current = 5.0f, .has_voltage = true, .has_current = true}},
    .running = true};

static void set_voltages(keel_battery_sample_t *sample, float voltage)
{
    sample->module[0].voltage = voltage;
    sample->module[1].voltage = voltage;
}

/* What differs in the samples. */
static void make_sample(unsigned point, keel_battery_t *battery, keel_battery_sample_t *sample)
{
    switch (point) {
    case 1u: /* A current that cannot be. */
        sample->module[0].current = 101.0f;
        break;
    case 2u: /* None, once too often. */
        sample->module[0].has_current = false;
        battery->module[0].age = 3u;
        break;
    case 3u: /* A negative one. */
        sample->module[1].current = -1.0f;
        break;
    case 4u: /* One module, with a high current. */
        battery->config.modules = 1u;
        sample->module[1].voltage = 9.0f;
        sample->module[1].current = 50.0f;
        break;
    case 5u: /* No first voltage. */
        sample->module[0].has_voltage = false;
        break;
    case 6u: /* A second voltage that cannot be. */
        sample->module[1].voltage = 21.0f;
        break;
    case 7u: /* None, once too often. */
        sample->module[0].has_voltage = false;
        sample->module[1].has_voltage = false;
        battery->voltage_age = 3u;
        break;
    case 8u: /* The second is lower, by too much. */
        sample->module[1].voltage = 14.5f;
        break;
    case 9u: /* The first is lower, by too much. */
        sample->module[0].voltage = 14.5f;
        break;
    case 10u: /* Motors stand still. */
        sample->running = false;
        break;
    case 11u: /* So large a load that it is not made up for. */
        sample->module[0].current = 40.0f;
        break;
    case 12u: /* A second module that is lost already. */
        sample->module[1].has_current = false;
        battery->module[1].age = 4u;
        break;
    case 13u: /* Held voltage, held current. */
        sample->module[0].has_voltage = false;
        sample->module[1].has_voltage = false;
        sample->module[1].has_current = false;
        battery->low.count = 2u;
        break;
    case 31u: /* Just as large a load as is made up for: 16 A, 0.5 V a cell. */
        sample->module[0].current = 8.0f;
        sample->module[1].current = 8.0f;
        break;
    default:
        break;
    }
}

/* What differs in the sums. */
static void make_sums(unsigned point, keel_battery_t *battery, keel_battery_sample_t *sample)
{
    switch (point) {
    case 14u: /* The sum of charge is at its end. */
        battery->charge.whole = UINT32_MAX - 2u;
        break;
    case 15u: /* The sum of energy is at its end. */
        battery->energy.whole = UINT32_MAX;
        battery->energy.part = KEEL_BATTERY_QUANTA - 1u;
        break;
    case 16u: /* All is used. */
        battery->charge.whole = 36000u;
        break;
    case 17u: /* The critical part is reached, a little later than it is read. */
        battery->charge.whole = 31492u;
        battery->critical.count = 2u;
        break;
    case 18u: /* No current for long. */
        battery->smoothed = 0.0f;
        sample->running = false;
        break;
    case 19u: /* A part that carries. */
        battery->charge.part = KEEL_BATTERY_QUANTA - 1u;
        sample->module[0].current = 0.000001f;
        sample->module[1].current = 0.000001f;
        break;
    default:
        break;
    }
}

/* What differs in alarms and level. */
static void make_alarms(unsigned point, keel_battery_t *battery, keel_battery_sample_t *sample)
{
    switch (point) {
    case 20u: /* Low for long enough: 3.25 V, without load 3.5 V. */
        set_voltages(sample, 13.0f);
        battery->low.count = 2u;
        break;
    case 21u: /* Critical, too. */
        set_voltages(sample, 12.0f);
        battery->low.count = 3u;
        battery->low.raised = true;
        battery->critical.count = 2u;
        break;
    case 22u: /* Not above by the margin. */
        set_voltages(sample, 13.5f);
        battery->low.count = 1u;
        battery->low.raised = true;
        battery->critical.count = 0u;
        break;
    case 23u: /* Above by the margin: taken back. */
        battery->low.count = 1u;
        battery->low.raised = true;
        battery->critical.count = 1u;
        battery->critical.raised = true;
        break;
    case 24u: /* Above, but low in charge. */
        battery->charge.whole = 30000u;
        battery->low.count = 3u;
        battery->low.raised = true;
        break;
    case 25u: /* The modules have come. */
        battery->count = KEEL_BATTERY_WAITING;
        battery->module[1].age = 4u;
        battery->voltage_age = 4u;
        break;
    case 26u: /* One has not, and no motor runs. */
        battery->count = KEEL_BATTERY_WAITING;
        battery->module[1].age = 4u;
        sample->module[1].has_current = false;
        sample->running = false;
        break;
    case 27u: /* One has not, and motors run. */
        battery->count = KEEL_BATTERY_WAITING;
        battery->module[1].age = 4u;
        sample->module[1].has_current = false;
        break;
    case 28u: /* It was lost before. */
        battery->count = KEEL_BATTERY_UNCOUNTED;
        break;
    case 29u: /* Known for not long enough. */
        battery->known = 1u;
        break;
    case 30u: /* The critical alarm's count is left alone by a held voltage. */
        sample->module[0].has_voltage = false;
        sample->module[1].has_voltage = false;
        battery->voltage = 9.0f;
        battery->critical.count = 2u;
        break;
    case 32u: /* Above by just the margin: 3.5 V, without load 3.75 V. Taken back. */
        set_voltages(sample, 14.0f);
        battery->low.count = 1u;
        battery->low.raised = true;
        break;
    default:
        break;
    }
}

/* One thing is different in each; the first is as it is. */
static void make_point(unsigned point, keel_battery_t *battery, keel_battery_sample_t *sample)
{
    *battery = flying;
    *sample = drawn;
    make_sample(point, battery, sample);
    make_sums(point, battery, sample);
    make_alarms(point, battery, sample);
}

#endif
