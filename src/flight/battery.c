/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/flight/battery.h"

#include "keel/middleware/range.h"

/* Quanta in 1 A T, and in 1 W T: the unit of the sum of energy is 256 W T. */
#define PER_AMPERE 1048576.0f
#define PER_WATT   4096.0f
#define WATTS      256.0f

#define PER_QUANTUM 0.00000095367431640625f

#define SECONDS_PER_HOUR 3600.0f

/* The greatest of each number that becomes an integer: the quanta of a step, and the capacity. */
#define CHARGE_MOST   1073741824.0f
#define ENERGY_MOST   268435456.0f
#define CAPACITY_MOST 3600000000.0f

/* A number without its fraction. None is above its limit but by a fault: the clamp makes sure that
 * there is an integer. */
/*@ requires battery_number(most, 0, 4294967040);
  @ assigns \nothing;
  @ ensures \result <= most;
  @*/
static uint32_t whole_of(float value, float most)
{
    return (uint32_t)keel_range_clamp(value, 0.0f, most);
}

/*@ requires \valid_read(config);
  @ assigns \nothing;
  @ ensures \result <==> battery_pack(*config);
  @*/
static bool is_pack(const keel_battery_config_t *config)
{
    return keel_range_contains(config->capacity_ah, KEEL_BATTERY_CAPACITY_MIN_AH,
                               KEEL_BATTERY_CAPACITY_MAX_AH) &&
           keel_range_contains(config->resistance_ohm, 0.0f, KEEL_BATTERY_RESISTANCE_LIMIT) &&
           (config->cells > 0u) && (config->cells <= KEEL_BATTERY_CELLS_MAX);
}

/*@ requires \valid_read(config);
  @ assigns \nothing;
  @ ensures \result <==> battery_ranges(*config);
  @*/
static bool are_battery_ranges(const keel_battery_config_t *config)
{
    return keel_range_contains(config->voltage_max, 0.0f, KEEL_BATTERY_VOLTAGE_LIMIT) &&
           keel_range_contains(config->voltage_min, 0.0f, config->voltage_max) &&
           keel_range_contains(config->voltage_spread, 0.0f, KEEL_BATTERY_VOLTAGE_LIMIT) &&
           keel_range_contains(config->current_min, -KEEL_BATTERY_CURRENT_LIMIT, 0.0f) &&
           keel_range_contains(config->current_max, 0.0f, KEEL_BATTERY_CURRENT_LIMIT) &&
           keel_range_contains(config->current_expected, 0.0f, KEEL_BATTERY_TOTAL_LIMIT) &&
           keel_range_contains(config->cap_s, KEEL_BATTERY_CAP_MIN_S, KEEL_BATTERY_CAP_MAX_S) &&
           (config->modules > 0u) && (config->modules <= KEEL_BATTERY_MODULES);
}

/*@ requires \valid_read(config);
  @ assigns \nothing;
  @ ensures \result <==> battery_levels(*config);
  @*/
static bool are_battery_levels(const keel_battery_config_t *config)
{
    return keel_range_contains(config->low_voltage, 0.0f, KEEL_BATTERY_CELL_LIMIT) &&
           keel_range_contains(config->critical_voltage, 0.0f, config->low_voltage) &&
           keel_range_contains(config->voltage_margin, 0.0f, KEEL_BATTERY_CELL_LIMIT) &&
           keel_range_contains(config->low_charge, 0.0f, 1.0f) &&
           keel_range_contains(config->critical_charge, 0.0f, config->low_charge) &&
           (config->smoothing_steps <= KEEL_BATTERY_SMOOTHING_MAX) &&
           (config->settle_steps >= KEEL_BATTERY_SETTLE_MIN);
}

/* All quotients but that of the time left. The capacity is at most 3.6e9, and exact as a float: it
 * was one. */
/*@ requires \valid(scale) && \valid_read(config) && \separated(scale, config);
  @ assigns *scale;
  @*/
static void set_battery_scale(keel_battery_scale_t *scale, const keel_battery_config_t *config)
{
    const float rate = (float)config->rate_hz;
    const float cells = (float)config->cells;
    float capacity;

    scale->step_s = 1.0f / rate;
    scale->unit_j = WATTS / rate;
    scale->gain = 1.0f / (1.0f + (float)config->smoothing_steps);
    scale->per_cell = 1.0f / cells;
    scale->sag = config->resistance_ohm / cells;
    scale->capacity = whole_of(config->capacity_ah * (SECONDS_PER_HOUR * rate), CAPACITY_MOST);
    capacity = (float)scale->capacity;
    scale->per_capacity = 1.0f / capacity;
    scale->low = whole_of(config->low_charge * capacity, CAPACITY_MOST);
    scale->critical = whole_of(config->critical_charge * capacity, CAPACITY_MOST);
}

/*@ requires \valid(sum);
  @ assigns *sum;
  @ ensures sum->whole == 0 && sum->part == 0;
  @*/
static void clear_sum(keel_battery_sum_t *sum)
{
    sum->whole = 0u;
    sum->part = 0u;
}

/*@ requires \valid(alarm);
  @ assigns *alarm;
  @ ensures alarm->count == 0 && !alarm->raised;
  @*/
static void clear_alarm(keel_battery_alarm_t *alarm)
{
    alarm->count = 0u;
    alarm->raised = false;
}

/* With this part of its charge. No module has come yet. */
/*@ requires \valid(battery);
  @ assigns battery->module[0 .. KEEL_BATTERY_MODULES - 1], battery->charge, battery->energy,
  @     battery->initial, battery->left, battery->voltage, battery->current, battery->smoothed,
  @     battery->cell_voltage, battery->charge_c, battery->energy_j, battery->remaining,
  @     battery->remaining_s, battery->low, battery->critical, battery->voltage_age,
  @     battery->known, battery->flags, battery->count, battery->level;
  @*/
static void begin_battery(keel_battery_t *battery, float part)
{
    battery->module[0].current = 0.0f;
    battery->module[0].age = battery->config.hold_steps;
    battery->module[1].current = 0.0f;
    battery->module[1].age = battery->config.hold_steps;
    clear_sum(&battery->charge);
    clear_sum(&battery->energy);
    battery->initial = whole_of(part * (float)battery->scale.capacity, CAPACITY_MOST);
    battery->left = battery->initial;
    battery->voltage = 0.0f;
    battery->current = 0.0f;
    battery->smoothed = battery->config.current_expected;
    battery->cell_voltage = 0.0f;
    battery->charge_c = 0.0f;
    battery->energy_j = 0.0f;
    battery->remaining = part;
    battery->remaining_s = 0.0f;
    clear_alarm(&battery->low);
    clear_alarm(&battery->critical);
    battery->voltage_age = battery->config.hold_steps;
    battery->known = 0u;
    battery->flags = 0u;
    battery->count = KEEL_BATTERY_WAITING;
    battery->level = KEEL_BATTERY_UNKNOWN;
}

keel_status_t keel_battery_init(keel_battery_t *battery, const keel_battery_config_t *config)
{
    if ((config->rate_hz == 0u) || (config->rate_hz > KEEL_BATTERY_RATE_MAX_HZ)) {
        return KEEL_ERR_RATE;
    }
    if (!(is_pack(config) && are_battery_ranges(config) && are_battery_levels(config))) {
        return KEEL_ERR_LIMITS;
    }
    if (config->hold_steps == 0u) {
        return KEEL_ERR_AGE;
    }
    if (!keel_range_contains(config->initial, 0.0f, 1.0f)) {
        return KEEL_ERR_INITIAL;
    }
    battery->config = *config;
    set_battery_scale(&battery->scale, config);
    begin_battery(battery, config->initial);
    return KEEL_OK;
}

keel_status_t keel_battery_restart(keel_battery_t *battery, float part)
{
    if (!keel_range_contains(part, 0.0f, 1.0f)) {
        return KEEL_ERR_INITIAL;
    }
    begin_battery(battery, part);
    return KEEL_OK;
}

/*@ assigns \nothing;
  @ ensures count < most ==> \result == count + 1;
  @ ensures count >= most ==> \result == most;
  @*/
static uint16_t counted_up(uint16_t count, uint16_t most)
{
    return (count < most) ? (uint16_t)(count + 1u) : most;
}

/* Whether the module is lost. The flags of module 1 are twice those of module 0. */
/*@ requires \valid(battery) && \valid_read(reading) && \separated(battery, reading);
  @ requires index < KEEL_BATTERY_MODULES;
  @ requires \is_finite(battery->config.current_min) && \is_finite(battery->config.current_max);
  @ assigns battery->module[index], battery->flags;
  @*/
static bool take_current(keel_battery_t *battery, uint32_t index,
                         const keel_battery_reading_t *reading)
{
    keel_battery_module_t *const module = &battery->module[index];
    const keel_battery_config_t *const config = &battery->config;
    const uint32_t own = index + 1u;
    bool is_lost;

    if (reading->has_current &&
        keel_range_contains(reading->current, config->current_min, config->current_max)) {
        const bool reversed = reading->current < 0.0f;

        module->current = reversed ? 0.0f : reading->current;
        module->age = 0u;
        battery->flags |= reversed ? (KEEL_BATTERY_REVERSED * own) : 0u;
    } else {
        module->age = counted_up(module->age, config->hold_steps);
        battery->flags |= KEEL_BATTERY_NO_CURRENT * own;
    }
    is_lost = module->age >= config->hold_steps;
    battery->flags |= is_lost ? (KEEL_BATTERY_LOST * own) : 0u;
    return is_lost;
}

/* Whether a module is lost. One that there is not draws nothing. */
/*@ requires \valid(battery) && \valid_read(sample) && \separated(battery, sample);
  @ requires \is_finite(battery->config.current_min) && \is_finite(battery->config.current_max);
  @ assigns battery->module[0 .. KEEL_BATTERY_MODULES - 1], battery->flags, battery->current;
  @*/
static bool take_currents(keel_battery_t *battery, const keel_battery_sample_t *sample)
{
    bool is_lost = take_current(battery, 0u, &sample->module[0]);
    float second = 0.0f;

    if (battery->config.modules > 1u) {
        const bool is_second_lost = take_current(battery, 1u, &sample->module[1]);

        is_lost = is_lost || is_second_lost;
        second = battery->module[1].current;
    }
    battery->current = keel_range_clamp(battery->module[0].current + second, 0.0f,
                                        KEEL_BATTERY_TOTAL_LIMIT);
    return is_lost;
}

/*@ requires \valid_read(config) && \valid_read(reading);
  @ requires \is_finite(config->voltage_min) && \is_finite(config->voltage_max);
  @ assigns \nothing;
  @ ensures \result <==> reading->has_voltage && battery_number(reading->voltage,
  @     config->voltage_min, config->voltage_max);
  @*/
static bool has_voltage(const keel_battery_config_t *config, const keel_battery_reading_t *reading)
{
    return reading->has_voltage &&
           keel_range_contains(reading->voltage, config->voltage_min, config->voltage_max);
}

/* The lower one. */
/*@ requires \valid(battery) && \is_finite(battery->config.voltage_spread);
  @ assigns battery->voltage, battery->flags;
  @*/
static void take_lower(keel_battery_t *battery, float first, float second)
{
    const float spread = battery->config.voltage_spread;

    battery->voltage = (first < second) ? first : second;
    if (!keel_range_contains(first - second, -spread, spread)) {
        battery->flags |= KEEL_BATTERY_SPREAD;
    }
}

/* Whether there is a new voltage; without one the last stays. */
/*@ requires \valid(battery) && \valid_read(sample) && \separated(battery, sample);
  @ requires \is_finite(battery->config.voltage_min) && \is_finite(battery->config.voltage_max) &&
  @     \is_finite(battery->config.voltage_spread);
  @ assigns battery->voltage, battery->voltage_age, battery->flags;
  @*/
static bool take_voltage(keel_battery_t *battery, const keel_battery_sample_t *sample)
{
    const keel_battery_config_t *const config = &battery->config;
    const bool both = config->modules > 1u;
    const bool first = has_voltage(config, &sample->module[0]);
    const bool second = both && has_voltage(config, &sample->module[1]);

    battery->flags |= first ? 0u : KEEL_BATTERY_NO_VOLTAGE;
    battery->flags |= (second || !both) ? 0u : (KEEL_BATTERY_NO_VOLTAGE << 1u);
    if (first && second) {
        take_lower(battery, sample->module[0].voltage, sample->module[1].voltage);
    } else if (first) {
        battery->voltage = sample->module[0].voltage;
    } else if (second) {
        battery->voltage = sample->module[1].voltage;
    } else {
        /* The last stays. */
    }
    battery->voltage_age = (first || second) ? 0u
                                             : counted_up(battery->voltage_age, config->hold_steps);
    if (battery->voltage_age >= config->hold_steps) {
        battery->flags |= KEEL_BATTERY_VOLTAGE_LOST;
    }
    return first || second;
}

/* Adds; whether the sum came to its end, where it stays. */
/*@ requires \valid(sum) && sum->part < KEEL_BATTERY_QUANTA && quanta <= 0x40000000;
  @ assigns *sum;
  @ ensures sum->part < KEEL_BATTERY_QUANTA;
  @ ensures !\result ==>
  @     battery_quanta(*sum) == battery_quanta(\old(*sum)) + quanta;
  @ ensures \result ==> battery_quanta(*sum) == 4294967296 * KEEL_BATTERY_QUANTA - 1 &&
  @     battery_quanta(*sum) < battery_quanta(\old(*sum)) + quanta;
  @*/
static bool add_quanta(keel_battery_sum_t *sum, uint32_t quanta)
{
    const uint32_t part = sum->part + quanta;
    const uint32_t more = part / KEEL_BATTERY_QUANTA;
    const bool at_end = more > (UINT32_MAX - sum->whole);

    if (at_end) {
        sum->whole = UINT32_MAX;
        sum->part = KEEL_BATTERY_QUANTA - 1u;
    } else {
        sum->whole += more;
        sum->part = part % KEEL_BATTERY_QUANTA;
    }
    return at_end;
}

/* The value of a sum. */
/*@ requires \valid_read(sum);
  @ assigns \nothing;
  @*/
static float amount_of_sum(const keel_battery_sum_t *sum, float unit)
{
    return ((float)sum->whole + ((float)sum->part * PER_QUANTUM)) * unit;
}

/* Charge and energy of a step. */
/*@ requires \valid(battery) && battery->charge.part < KEEL_BATTERY_QUANTA &&
  @     battery->energy.part < KEEL_BATTERY_QUANTA;
  @ assigns battery->charge, battery->energy, battery->charge_c, battery->energy_j,
  @     battery->flags;
  @*/
static void add_up_step(keel_battery_t *battery)
{
    const float power = battery->voltage * battery->current;
    const bool charge = add_quanta(&battery->charge,
                                   whole_of(battery->current * PER_AMPERE, CHARGE_MOST));
    const bool energy = add_quanta(&battery->energy, whole_of(power * PER_WATT, ENERGY_MOST));

    battery->flags |= (charge || energy) ? KEEL_BATTERY_FULL : 0u;
    battery->charge_c = amount_of_sum(&battery->charge, battery->scale.step_s);
    battery->energy_j = amount_of_sum(&battery->energy, battery->scale.unit_j);
}

/*@ assigns \nothing;
  @ ensures \result == (whole > part ? whole - part : 0);
  @*/
static uint32_t less_or_zero(uint32_t whole, uint32_t part)
{
    return (whole > part) ? (whole - part) : 0u;
}

/* The time for which the charge above the critical part lasts. It is divided only where the result
 * is below the cap, so never by 0. */
/*@ requires \valid_read(battery);
  @ requires battery_number(battery->config.cap_s, KEEL_BATTERY_CAP_MIN_S,
  @     KEEL_BATTERY_CAP_MAX_S);
  @ assigns \nothing;
  @*/
static float time_left(const keel_battery_t *battery)
{
    const float cap = battery->config.cap_s;
    const uint32_t usable = less_or_zero(battery->left, battery->scale.critical);
    const float charge = (float)usable * battery->scale.step_s;
    float time = cap;

    if (usable == 0u) {
        time = 0.0f;
    } else if (charge < (cap * battery->smoothed)) {
        time = keel_range_clamp(charge / battery->smoothed, 0.0f, cap);
    } else {
        /* The cap. */
    }
    return time;
}

/* The charge left, and for how long. */
/*@ requires \valid(battery);
  @ requires battery_number(battery->config.cap_s, KEEL_BATTERY_CAP_MIN_S,
  @     KEEL_BATTERY_CAP_MAX_S);
  @ assigns battery->left, battery->remaining, battery->smoothed, battery->remaining_s;
  @*/
static void estimate_rest(keel_battery_t *battery, bool running)
{
    const float change = battery->scale.gain * (battery->current - battery->smoothed);

    battery->left = less_or_zero(battery->initial, battery->charge.whole);
    battery->remaining = keel_range_clamp((float)battery->left * battery->scale.per_capacity, 0.0f,
                                          1.0f);
    battery->smoothed = keel_range_clamp(battery->smoothed + (running ? change : 0.0f), 0.0f,
                                         KEEL_BATTERY_TOTAL_LIMIT);
    battery->remaining_s = time_left(battery);
}

/* A cell's voltage without load. Where the current is not known, the load is not made up for. */
/*@ requires \valid(battery);
  @ assigns battery->cell_voltage, battery->flags;
  @*/
static void unload_cell(keel_battery_t *battery, bool is_lost)
{
    const float drop = is_lost ? 0.0f : (battery->current * battery->scale.sag);
    const float sag = keel_range_clamp(drop, 0.0f, KEEL_BATTERY_SAG_LIMIT);

    battery->cell_voltage = (battery->voltage * battery->scale.per_cell) + sag;
    battery->flags |= (drop > KEEL_BATTERY_SAG_LIMIT) ? KEEL_BATTERY_SAG : 0u;
}

/*@ requires \valid(alarm);
  @ assigns *alarm;
  @ ensures 0 < most && battery_alarm(\old(*alarm), most) ==>
  @     battery_alarm(*alarm, most) && battery_steady(\old(*alarm), *alarm, most) &&
  @     (\old(alarm->raised) && !alarm->raised ==> against && !speaks);
  @*/
static void weigh_evidence(keel_battery_alarm_t *alarm, bool speaks, bool against, uint16_t most)
{
    if (speaks) {
        alarm->count = counted_up(alarm->count, most);
    } else if (against) {
        alarm->count = (alarm->count > 0u) ? (uint16_t)(alarm->count - 1u) : 0u;
    } else {
        /* No evidence. */
    }
    alarm->raised = alarm->raised ? (alarm->count > 0u) : (alarm->count >= most);
}

/* The evidence for and against an alarm with these thresholds, and what it makes of it. */
/*@ requires \valid(alarm) && \valid_read(battery);
  @ assigns *alarm;
  @*/
static void judge_alarm(keel_battery_alarm_t *alarm, const keel_battery_t *battery, bool fresh,
                        float voltage, uint32_t charge)
{
    const float unloaded = battery->cell_voltage;
    const float margin = alarm->raised ? battery->config.voltage_margin : 0.0f;
    const bool is_spent = battery->left <= charge;
    const bool is_below = is_spent || (fresh && (unloaded <= voltage));

    weigh_evidence(alarm, is_below, fresh && (unloaded >= (voltage + margin)),
                   battery->config.settle_steps);
}

/* Whether all that was used is known: from when the modules have all come, until one is lost. */
/*@ requires \valid(battery);
  @ assigns battery->count;
  @ ensures \old(battery->count) == KEEL_BATTERY_UNCOUNTED ==>
  @     battery->count == KEEL_BATTERY_UNCOUNTED;
  @ ensures battery->count == KEEL_BATTERY_COUNTED ==> !is_lost;
  @ ensures is_lost && running ==> battery->count == KEEL_BATTERY_UNCOUNTED;
  @*/
static void judge_count(keel_battery_t *battery, bool is_lost, bool running)
{
    const bool waiting = battery->count == KEEL_BATTERY_WAITING;

    if (!is_lost) {
        if (waiting) {
            battery->count = KEEL_BATTERY_COUNTED;
        }
    } else if (running || !waiting) {
        battery->count = KEEL_BATTERY_UNCOUNTED;
    } else {
        /* It still waits. */
    }
}

/* An alarm that is raised stays the level when nothing is known any more. */
/*@ requires \valid(battery);
  @ assigns battery->known, battery->level;
  @*/
static void judge_level(keel_battery_t *battery)
{
    const uint16_t most = battery->config.settle_steps;
    const bool known = (battery->count == KEEL_BATTERY_COUNTED) &&
                       ((battery->flags & KEEL_BATTERY_VOLTAGE_LOST) == 0u);

    battery->known = known ? counted_up(battery->known, most) : 0u;
    if (battery->critical.raised) {
        battery->level = KEEL_BATTERY_CRITICAL;
    } else if (battery->low.raised) {
        battery->level = KEEL_BATTERY_LOW;
    } else if (known && (battery->known >= most)) {
        battery->level = KEEL_BATTERY_OK;
    } else {
        battery->level = KEEL_BATTERY_UNKNOWN;
    }
}

void keel_battery_step(keel_battery_t *battery, const keel_battery_sample_t *sample)
{
    const keel_battery_config_t *const config = &battery->config;
    bool is_lost;
    bool fresh;

    battery->flags = 0u;
    is_lost = take_currents(battery, sample);
    fresh = take_voltage(battery, sample);
    add_up_step(battery);
    estimate_rest(battery, sample->running);
    unload_cell(battery, is_lost);
    judge_alarm(&battery->low, battery, fresh, config->low_voltage, battery->scale.low);
    judge_alarm(&battery->critical, battery, fresh, config->critical_voltage,
                battery->scale.critical);
    judge_count(battery, is_lost, sample->running);
    judge_level(battery);
}
