/* SPDX-License-Identifier: Apache-2.0 */
#include "battery.h"

/* No comparison with NaN holds. */
static bool lies_between(float value, float least, float most)
{
    return (value >= least) && (value <= most);
}

static float brought_between(float value, float least, float most)
{
    const float above = (value > least) ? value : least;

    return (above < most) ? above : most;
}

/* A number without its fraction, from 0 to a greatest one. */
static uint32_t integer_of(float value, float most)
{
    return (uint32_t)brought_between(value, 0.0f, most);
}

static bool pack_valid(const keel_battery_config_t *c)
{
    return lies_between(c->capacity_ah, KEEL_BATTERY_CAPACITY_MIN_AH,
                        KEEL_BATTERY_CAPACITY_MAX_AH) &&
           lies_between(c->resistance_ohm, 0.0f, KEEL_BATTERY_RESISTANCE_LIMIT) &&
           (c->cells > 0u) && (c->cells <= KEEL_BATTERY_CELLS_MAX);
}

static bool ranges_valid(const keel_battery_config_t *c)
{
    const float volts = KEEL_BATTERY_VOLTAGE_LIMIT;
    const float amperes = KEEL_BATTERY_CURRENT_LIMIT;

    return lies_between(c->voltage_max, 0.0f, volts) &&
           lies_between(c->voltage_min, 0.0f, c->voltage_max) &&
           lies_between(c->voltage_spread, 0.0f, volts) &&
           lies_between(c->current_min, -amperes, 0.0f) &&
           lies_between(c->current_max, 0.0f, amperes) &&
           lies_between(c->current_expected, 0.0f, KEEL_BATTERY_TOTAL_LIMIT) &&
           lies_between(c->cap_s, KEEL_BATTERY_CAP_MIN_S, KEEL_BATTERY_CAP_MAX_S) &&
           (c->modules > 0u) && (c->modules <= KEEL_BATTERY_MODULES);
}

static bool levels_valid(const keel_battery_config_t *c)
{
    const float cell = KEEL_BATTERY_CELL_LIMIT;

    return lies_between(c->low_voltage, 0.0f, cell) &&
           lies_between(c->critical_voltage, 0.0f, c->low_voltage) &&
           lies_between(c->voltage_margin, 0.0f, cell) && lies_between(c->low_charge, 0.0f, 1.0f) &&
           lies_between(c->critical_charge, 0.0f, c->low_charge) &&
           (c->smoothing_steps <= KEEL_BATTERY_SMOOTHING_MAX) &&
           (c->settle_steps >= KEEL_BATTERY_SETTLE_MIN);
}

/* BAT-003: nothing used, nothing known. */
static void start_anew(keel_battery_t *b, float part)
{
    const keel_battery_sum_t none = {0u, 0u};

    for (uint32_t i = 0u; i < KEEL_BATTERY_MODULES; i++) {
        b->module[i].current = 0.0f;
        b->module[i].age = b->config.hold_steps;
    }
    b->charge = none;
    b->energy = none;
    b->initial = integer_of(part * (float)b->scale.capacity, 3.6e9f);
    b->left = b->initial;
    b->voltage = 0.0f;
    b->current = 0.0f;
    b->smoothed = b->config.current_expected;
    b->cell_voltage = 0.0f;
    b->charge_c = 0.0f;
    b->energy_j = 0.0f;
    b->remaining = part;
    b->remaining_s = 0.0f;
    b->low.count = 0u;
    b->low.raised = false;
    b->critical.count = 0u;
    b->critical.raised = false;
    b->voltage_age = b->config.hold_steps;
    b->known = 0u;
    b->flags = 0u;
    b->count = KEEL_BATTERY_WAITING;
    b->level = KEEL_BATTERY_UNKNOWN;
}

keel_status_t model_battery_init(keel_battery_t *battery, const keel_battery_config_t *config)
{
    keel_battery_scale_t *const scale = &battery->scale;

    /* BAT-001: a refusal changes nothing. */
    if ((config->rate_hz == 0u) || (config->rate_hz > KEEL_BATTERY_RATE_MAX_HZ)) {
        return KEEL_ERR_RATE;
    }
    if (!(pack_valid(config) && ranges_valid(config) && levels_valid(config))) {
        return KEEL_ERR_LIMITS;
    }
    if (config->hold_steps == 0u) {
        return KEEL_ERR_AGE;
    }
    if (!lies_between(config->initial, 0.0f, 1.0f)) {
        return KEEL_ERR_INITIAL;
    }
    /* BAT-002: charge in A T, T = 1 / rate. */
    battery->config = *config;
    scale->step_s = 1.0f / (float)config->rate_hz;
    scale->unit_j = 256.0f / (float)config->rate_hz;
    scale->gain = 1.0f / (1.0f + (float)config->smoothing_steps);
    scale->per_cell = 1.0f / (float)config->cells;
    scale->sag = config->resistance_ohm / (float)config->cells;
    scale->capacity = integer_of(config->capacity_ah * (3600.0f * (float)config->rate_hz), 3.6e9f);
    scale->per_capacity = 1.0f / (float)scale->capacity;
    scale->low = integer_of(config->low_charge * (float)scale->capacity, 3.6e9f);
    scale->critical = integer_of(config->critical_charge * (float)scale->capacity, 3.6e9f);
    start_anew(battery, config->initial);
    return KEEL_OK;
}

keel_status_t model_battery_restart(keel_battery_t *battery, float part)
{
    if (!lies_between(part, 0.0f, 1.0f)) {
        return KEEL_ERR_INITIAL;
    }
    start_anew(battery, part);
    return KEEL_OK;
}

static uint16_t one_step_older(uint16_t age, uint16_t oldest)
{
    return (age < oldest) ? (uint16_t)(age + 1u) : oldest;
}

/* BAT-004, BAT-006: a current in its range counts, a negative one as none; without one the last is
 * held, for less than hold_steps. Whether the module is lost. */
static bool current_of_module(keel_battery_t *b, uint32_t i, const keel_battery_reading_t *reading)
{
    bool lost;

    if (reading->has_current &&
        lies_between(reading->current, b->config.current_min, b->config.current_max)) {
        const bool negative = reading->current < 0.0f;

        b->module[i].current = negative ? 0.0f : reading->current;
        b->module[i].age = 0u;
        b->flags |= negative ? (KEEL_BATTERY_REVERSED * (i + 1u)) : 0u;
    } else {
        b->module[i].age = one_step_older(b->module[i].age, b->config.hold_steps);
        b->flags |= KEEL_BATTERY_NO_CURRENT * (i + 1u);
    }
    lost = b->module[i].age >= b->config.hold_steps;
    b->flags |= lost ? (KEEL_BATTERY_LOST * (i + 1u)) : 0u;
    return lost;
}

static bool voltage_counts(const keel_battery_t *b, const keel_battery_reading_t *reading)
{
    return reading->has_voltage &&
           lies_between(reading->voltage, b->config.voltage_min, b->config.voltage_max);
}

/* BAT-005: the lower of the voltages that came. Whether one came. */
static bool voltage_of_modules(keel_battery_t *b, const keel_battery_sample_t *sample)
{
    const float v0 = sample->module[0].voltage;
    const float v1 = sample->module[1].voltage;
    const bool two = b->config.modules > 1u;
    const bool came0 = voltage_counts(b, &sample->module[0]);
    const bool came1 = two && voltage_counts(b, &sample->module[1]);

    b->flags |= came0 ? 0u : KEEL_BATTERY_NO_VOLTAGE;
    b->flags |= (came1 || !two) ? 0u : (KEEL_BATTERY_NO_VOLTAGE << 1u);
    if (came0 && came1) {
        b->voltage = (v0 < v1) ? v0 : v1;
        if (!lies_between(v0 - v1, -b->config.voltage_spread, b->config.voltage_spread)) {
            b->flags |= KEEL_BATTERY_SPREAD;
        }
    } else if (came0) {
        b->voltage = v0;
    } else if (came1) {
        b->voltage = v1;
    }
    b->voltage_age = (came0 || came1) ? 0u : one_step_older(b->voltage_age, b->config.hold_steps);
    if (b->voltage_age >= b->config.hold_steps) {
        b->flags |= KEEL_BATTERY_VOLTAGE_LOST;
    }
    return came0 || came1;
}

/* BAT-007, BAT-008: 2^20 quanta make a whole one; the greatest sum is not left. Whether it would
 * have been. */
static bool sum_up(keel_battery_sum_t *sum, uint32_t quanta)
{
    const uint32_t part = sum->part + quanta;
    const bool over = (part / KEEL_BATTERY_QUANTA) > (UINT32_MAX - sum->whole);

    if (over) {
        sum->whole = UINT32_MAX;
        sum->part = KEEL_BATTERY_QUANTA - 1u;
    } else {
        sum->whole += part / KEEL_BATTERY_QUANTA;
        sum->part = part % KEEL_BATTERY_QUANTA;
    }
    return over;
}

static float value_of(keel_battery_sum_t sum, float unit)
{
    return ((float)sum.whole + ((float)sum.part * 0x1p-20f)) * unit;
}

static uint32_t less_by(uint32_t whole, uint32_t part)
{
    return (whole > part) ? (whole - part) : 0u;
}

/* BAT-009, BAT-010. */
static void rest_and_time(keel_battery_t *b, bool running)
{
    const float change = b->scale.gain * (b->current - b->smoothed);
    float charge;

    b->left = less_by(b->initial, b->charge.whole);
    b->remaining = brought_between((float)b->left * b->scale.per_capacity, 0.0f, 1.0f);
    b->smoothed = brought_between(b->smoothed + (running ? change : 0.0f), 0.0f,
                                  KEEL_BATTERY_TOTAL_LIMIT);
    charge = (float)less_by(b->left, b->scale.critical) * b->scale.step_s;
    if (b->left <= b->scale.critical) {
        b->remaining_s = 0.0f;
    } else if (charge < (b->config.cap_s * b->smoothed)) {
        b->remaining_s = brought_between(charge / b->smoothed, 0.0f, b->config.cap_s);
    } else {
        b->remaining_s = b->config.cap_s;
    }
}

/* BAT-012, BAT-013. */
static void alarm_step(keel_battery_alarm_t *alarm, bool pro, bool contra, uint16_t most)
{
    if (pro) {
        alarm->count = (alarm->count < most) ? (uint16_t)(alarm->count + 1u) : most;
    } else if (contra) {
        alarm->count = (alarm->count > 0u) ? (uint16_t)(alarm->count - 1u) : 0u;
    }
    alarm->raised = alarm->raised ? (alarm->count > 0u) : (alarm->count >= most);
}

static void alarm_with(keel_battery_t *b, keel_battery_alarm_t *alarm, bool fresh, float voltage,
                       uint32_t charge)
{
    const float margin = alarm->raised ? b->config.voltage_margin : 0.0f;
    const bool spent = b->left <= charge;

    alarm_step(alarm, spent || (fresh && (b->cell_voltage <= voltage)),
               fresh && (b->cell_voltage >= (voltage + margin)), b->config.settle_steps);
}

/* BAT-014. */
static void level_step(keel_battery_t *b, bool lost, bool running)
{
    bool known;

    if (!lost) {
        if (b->count == KEEL_BATTERY_WAITING) {
            b->count = KEEL_BATTERY_COUNTED;
        }
    } else if (running || (b->count != KEEL_BATTERY_WAITING)) {
        b->count = KEEL_BATTERY_UNCOUNTED;
    }
    known = (b->count == KEEL_BATTERY_COUNTED) && ((b->flags & KEEL_BATTERY_VOLTAGE_LOST) == 0u);
    b->known = known ? one_step_older(b->known, b->config.settle_steps) : 0u;
    if (b->critical.raised) {
        b->level = KEEL_BATTERY_CRITICAL;
    } else if (b->low.raised) {
        b->level = KEEL_BATTERY_LOW;
    } else if (known && (b->known >= b->config.settle_steps)) {
        b->level = KEEL_BATTERY_OK;
    } else {
        b->level = KEEL_BATTERY_UNKNOWN;
    }
}

/* BAT-016 */
void model_battery_step(keel_battery_t *battery, const keel_battery_sample_t *sample)
{
    keel_battery_t *const b = battery;
    float second = 0.0f;
    bool over_charge;
    bool over_energy;
    bool fresh;
    bool lost;
    float drop;

    b->flags = 0u;
    lost = current_of_module(b, 0u, &sample->module[0]);
    if (b->config.modules > 1u) {
        const bool other = current_of_module(b, 1u, &sample->module[1]);

        lost = lost || other;
        second = b->module[1].current;
    }
    b->current = brought_between(b->module[0].current + second, 0.0f, KEEL_BATTERY_TOTAL_LIMIT);
    fresh = voltage_of_modules(b, sample);
    over_charge = sum_up(&b->charge, integer_of(b->current * 0x1p20f, 0x1p30f));
    over_energy = sum_up(&b->energy, integer_of((b->voltage * b->current) * 0x1p12f, 0x1p28f));
    b->flags |= (over_charge || over_energy) ? KEEL_BATTERY_FULL : 0u;
    b->charge_c = value_of(b->charge, b->scale.step_s);
    b->energy_j = value_of(b->energy, b->scale.unit_j);
    rest_and_time(b, sample->running);
    /* BAT-011: what the load takes off a cell's voltage, where the load is known. */
    drop = lost ? 0.0f : (b->current * b->scale.sag);
    b->cell_voltage = (b->voltage * b->scale.per_cell) +
                      brought_between(drop, 0.0f, KEEL_BATTERY_SAG_LIMIT);
    b->flags |= (drop > KEEL_BATTERY_SAG_LIMIT) ? KEEL_BATTERY_SAG : 0u;
    alarm_with(b, &b->low, fresh, b->config.low_voltage, b->scale.low);
    alarm_with(b, &b->critical, fresh, b->config.critical_voltage, b->scale.critical);
    level_step(b, lost, sample->running);
}
