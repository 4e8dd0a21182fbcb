/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file battery_proof.h
 * @brief What the harnesses of the battery monitor share: arbitrary monitors, valid ones, and when
 *        two are the same.
 */
#ifndef BATTERY_PROOF_H
#define BATTERY_PROOF_H

#include "../common/same.h"
#include "keel/flight/battery.h"

#include <stdbool.h>

bool nondet_bool(void);
float nondet_float(void);
keel_battery_t nondet_battery(void);
keel_battery_config_t nondet_battery_config(void);
keel_battery_sample_t nondet_battery_sample(void);

static bool battery_config_same(const keel_battery_config_t *a, const keel_battery_config_t *b)
{
    return float_same(a->capacity_ah, b->capacity_ah) && float_same(a->initial, b->initial) &&
           float_same(a->resistance_ohm, b->resistance_ohm) &&
           float_same(a->voltage_min, b->voltage_min) &&
           float_same(a->voltage_max, b->voltage_max) &&
           float_same(a->voltage_spread, b->voltage_spread) &&
           float_same(a->current_min, b->current_min) &&
           float_same(a->current_max, b->current_max) &&
           float_same(a->current_expected, b->current_expected) && float_same(a->cap_s, b->cap_s) &&
           float_same(a->low_voltage, b->low_voltage) &&
           float_same(a->critical_voltage, b->critical_voltage) &&
           float_same(a->voltage_margin, b->voltage_margin) &&
           float_same(a->low_charge, b->low_charge) &&
           float_same(a->critical_charge, b->critical_charge) && (a->rate_hz == b->rate_hz) &&
           (a->smoothing_steps == b->smoothing_steps) && (a->settle_steps == b->settle_steps) &&
           (a->hold_steps == b->hold_steps) && (a->cells == b->cells) && (a->modules == b->modules);
}

static bool battery_scale_same(const keel_battery_scale_t *a, const keel_battery_scale_t *b)
{
    return float_same(a->step_s, b->step_s) && float_same(a->unit_j, b->unit_j) &&
           float_same(a->gain, b->gain) && float_same(a->per_cell, b->per_cell) &&
           float_same(a->sag, b->sag) && float_same(a->per_capacity, b->per_capacity) &&
           (a->capacity == b->capacity) && (a->low == b->low) && (a->critical == b->critical);
}

static bool battery_module_same(const keel_battery_module_t *a, const keel_battery_module_t *b)
{
    return float_same(a->current, b->current) && (a->age == b->age);
}

static bool battery_sum_same(const keel_battery_sum_t *a, const keel_battery_sum_t *b)
{
    return (a->whole == b->whole) && (a->part == b->part);
}

static bool battery_alarm_same(const keel_battery_alarm_t *a, const keel_battery_alarm_t *b)
{
    return (a->count == b->count) && (a->raised == b->raised);
}

static bool battery_same(const keel_battery_t *a, const keel_battery_t *b)
{
    return battery_config_same(&a->config, &b->config) &&
           battery_scale_same(&a->scale, &b->scale) && battery_sum_same(&a->charge, &b->charge) &&
           battery_sum_same(&a->energy, &b->energy) && (a->initial == b->initial) &&
           (a->left == b->left) && float_same(a->voltage, b->voltage) &&
           float_same(a->current, b->current) && float_same(a->smoothed, b->smoothed) &&
           float_same(a->cell_voltage, b->cell_voltage) && float_same(a->charge_c, b->charge_c) &&
           float_same(a->energy_j, b->energy_j) && float_same(a->remaining, b->remaining) &&
           float_same(a->remaining_s, b->remaining_s) && battery_alarm_same(&a->low, &b->low) &&
           battery_alarm_same(&a->critical, &b->critical) && (a->voltage_age == b->voltage_age) &&
           (a->known == b->known) && (a->flags == b->flags) && (a->count == b->count) &&
           (a->level == b->level) && battery_module_same(&a->module[0u], &b->module[0u]) &&
           battery_module_same(&a->module[1u], &b->module[1u]);
}

static bool reading_same(const keel_battery_reading_t *a, const keel_battery_reading_t *b)
{
    return float_same(a->voltage, b->voltage) && float_same(a->current, b->current) &&
           (a->has_voltage == b->has_voltage) && (a->has_current == b->has_current);
}

static bool battery_sample_same(const keel_battery_sample_t *a, const keel_battery_sample_t *b)
{
    return (a->running == b->running) && reading_same(&a->module[0u], &b->module[0u]) &&
           reading_same(&a->module[1u], &b->module[1u]);
}

static bool within(float value, float least, float most)
{
    return (least <= value) && (value <= most);
}

/* battery_rate */
static bool battery_rate_here(const keel_battery_config_t *c)
{
    return (1u <= c->rate_hz) && (c->rate_hz <= KEEL_BATTERY_RATE_MAX_HZ);
}

/* battery_ranges */
static bool battery_ranges_here(const keel_battery_config_t *c)
{
    return within(c->voltage_max, 0.0f, KEEL_BATTERY_VOLTAGE_LIMIT) &&
           within(c->voltage_min, 0.0f, c->voltage_max) &&
           within(c->voltage_spread, 0.0f, KEEL_BATTERY_VOLTAGE_LIMIT) &&
           within(c->current_min, -KEEL_BATTERY_CURRENT_LIMIT, 0.0f) &&
           within(c->current_max, 0.0f, KEEL_BATTERY_CURRENT_LIMIT) &&
           within(c->current_expected, 0.0f, KEEL_BATTERY_TOTAL_LIMIT) &&
           within(c->cap_s, KEEL_BATTERY_CAP_MIN_S, KEEL_BATTERY_CAP_MAX_S) && (1u <= c->modules) &&
           (c->modules <= KEEL_BATTERY_MODULES);
}

/* battery_limits */
static bool battery_limits_here(const keel_battery_config_t *c)
{
    return within(c->capacity_ah, KEEL_BATTERY_CAPACITY_MIN_AH, KEEL_BATTERY_CAPACITY_MAX_AH) &&
           within(c->resistance_ohm, 0.0f, KEEL_BATTERY_RESISTANCE_LIMIT) && (1u <= c->cells) &&
           (c->cells <= KEEL_BATTERY_CELLS_MAX) && battery_ranges_here(c) &&
           within(c->low_voltage, 0.0f, KEEL_BATTERY_CELL_LIMIT) &&
           within(c->critical_voltage, 0.0f, c->low_voltage) &&
           within(c->voltage_margin, 0.0f, KEEL_BATTERY_CELL_LIMIT) &&
           within(c->low_charge, 0.0f, 1.0f) && within(c->critical_charge, 0.0f, c->low_charge) &&
           (c->smoothing_steps <= KEEL_BATTERY_SMOOTHING_MAX) &&
           (KEEL_BATTERY_SETTLE_MIN <= c->settle_steps);
}

/* What init takes. */
static bool battery_config_valid(const keel_battery_config_t *c)
{
    return battery_rate_here(c) && battery_limits_here(c) && (1u <= c->hold_steps) &&
           within(c->initial, 0.0f, 1.0f);
}

/* What init computes. A capacity is at least 900 A T. */
static bool battery_scale_valid(const keel_battery_scale_t *s)
{
    return within(s->step_s, 0.0009f, 1.0f) && within(s->unit_j, 0.25f, 256.0f) &&
           within(s->gain, 0x1p-15f, 1.0f) && within(s->per_cell, 0x1p-4f, 1.0f) &&
           within(s->sag, 0.0f, KEEL_BATTERY_RESISTANCE_LIMIT) &&
           within(s->per_capacity, 0x1p-32f, 0x1p-9f) && (900u <= s->capacity) &&
           (s->capacity <= 3600000000u);
}

/* battery_alarm */
static bool battery_alarm_here(const keel_battery_alarm_t *a, uint32_t most)
{
    return (a->count <= most) && (!a->raised || (0u < a->count));
}

/* battery_counts */
static bool battery_counts_here(const keel_battery_t *b)
{
    return (0u < b->config.hold_steps) && (0u < b->config.settle_steps) &&
           (b->charge.part < KEEL_BATTERY_QUANTA) && (b->energy.part < KEEL_BATTERY_QUANTA) &&
           battery_alarm_here(&b->low, b->config.settle_steps) &&
           battery_alarm_here(&b->critical, b->config.settle_steps);
}

static bool battery_counts_valid(const keel_battery_t *b)
{
    return battery_counts_here(b) && (b->left <= b->initial) &&
           (b->known <= b->config.settle_steps) && (b->module[0].age <= b->config.hold_steps) &&
           (b->module[1].age <= b->config.hold_steps) && (b->voltage_age <= b->config.hold_steps) &&
           (b->count <= KEEL_BATTERY_UNCOUNTED) && (b->level <= KEEL_BATTERY_CRITICAL);
}

/* What came, and what is told of it. */
static bool battery_values_valid(const keel_battery_t *b)
{
    return within(b->module[0].current, 0.0f, KEEL_BATTERY_CURRENT_LIMIT) &&
           within(b->module[1].current, 0.0f, KEEL_BATTERY_CURRENT_LIMIT) &&
           within(b->voltage, 0.0f, KEEL_BATTERY_VOLTAGE_LIMIT) &&
           within(b->current, 0.0f, KEEL_BATTERY_TOTAL_LIMIT) &&
           within(b->smoothed, 0.0f, KEEL_BATTERY_TOTAL_LIMIT) &&
           within(b->remaining, 0.0f, 1.0f) && within(b->remaining_s, 0.0f, b->config.cap_s);
}

/* Of what is computed with products: a cell's voltage, and what was used. */
static bool battery_products_valid(const keel_battery_t *b)
{
    return within(b->cell_voltage, 0.0f, KEEL_BATTERY_VOLTAGE_LIMIT + KEEL_BATTERY_SAG_LIMIT) &&
           within(b->charge_c, 0.0f, 0x1p32f) && within(b->energy_j, 0.0f, 0x1p40f);
}

/* What init establishes and every step keeps. */
static bool battery_valid(const keel_battery_t *b)
{
    return battery_config_valid(&b->config) && battery_scale_valid(&b->scale) &&
           battery_counts_valid(b) && battery_values_valid(b);
}

/* Any monitor at all. A truth value is true or false. */
static keel_battery_t any_battery_at_all(void)
{
    keel_battery_t battery = nondet_battery();

    battery.low.raised = nondet_bool();
    battery.critical.raised = nondet_bool();
    return battery;
}

/* Any bit pattern for all that was measured. */
static keel_battery_sample_t any_battery_sample(void)
{
    keel_battery_sample_t sample = nondet_battery_sample();

    sample.module[0].has_voltage = nondet_bool();
    sample.module[0].has_current = nondet_bool();
    sample.module[1].has_voltage = nondet_bool();
    sample.module[1].has_current = nondet_bool();
    sample.running = nondet_bool();
    return sample;
}

#endif
