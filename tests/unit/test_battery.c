/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/flight/battery.h. Expected values are worked out by hand. The usual battery
 * has 1 Ah, 3600 C, and 10 steps per second: 36000 A T, of which 9000 are low and 4500 critical.
 * Its four cells and 0.125 ohm give back 1/32 V per cell and ampere. */
#include "keel/flight/battery.h"
#include "unity.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const keel_battery_config_t usual = {.capacity_ah = 1.0f,
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
                                            .modules = 2u};

/* 16 V, 4 V per cell, from both, and no current. */
static const keel_battery_sample_t idle = {
    .module = {{16.0f, 0.0f, true, true}, {16.0f, 0.0f, true, true}}};

static keel_battery_config_t config;
static keel_battery_sample_t sample;
static keel_battery_t battery;

static void make(void)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_battery_init(&battery, &config));
}

void setUp(void)
{
    config = usual;
    sample = idle;
    memset(&battery, 0x55, sizeof battery);
    make();
}

void tearDown(void)
{
}

static void steps(uint32_t n)
{
    for (; n > 0u; n--) {
        keel_battery_step(&battery, &sample);
    }
}

static void volts(float first, float second)
{
    sample.module[0].voltage = first;
    sample.module[1].voltage = second;
}

static void amperes(float first, float second)
{
    sample.module[0].current = first;
    sample.module[1].current = second;
}

static void no_voltage(void)
{
    sample.module[0].has_voltage = false;
    sample.module[1].has_voltage = false;
}

static void flags_are(uint32_t expected)
{
    TEST_ASSERT_EQUAL_HEX32(expected, battery.flags);
}

static void level_is(keel_battery_level_t expected)
{
    TEST_ASSERT_EQUAL(expected, battery.level);
}

/* As it is once all has been known for three steps. */
static void run(void)
{
    steps(3u);
    level_is(KEEL_BATTERY_OK);
}

static void refused(keel_status_t status)
{
    keel_battery_t before;

    memcpy(&before, &battery, sizeof before);
    TEST_ASSERT_EQUAL(status, keel_battery_init(&battery, &config));
    TEST_ASSERT_EQUAL_MEMORY(&before, &battery, sizeof battery);
    config = usual;
}

static void taken(void)
{
    make();
    config = usual;
}

/* NaN, just outside both ends, and both ends. */
static void bounded_by(float *field, float least, float most, keel_status_t status)
{
    *field = NAN;
    refused(status);
    *field = nextafterf(least, -INFINITY);
    refused(status);
    *field = nextafterf(most, INFINITY);
    refused(status);
    *field = least;
    taken();
    *field = most;
    taken();
}

static void BAT_001_each_number_has_a_range(void)
{
    bounded_by(&config.capacity_ah, 0.25f, 1000.0f, KEEL_ERR_LIMITS);
    bounded_by(&config.resistance_ohm, 0.0f, 1.0f, KEEL_ERR_LIMITS);
    bounded_by(&config.voltage_max, 8.0f, 64.0f, KEEL_ERR_LIMITS);
    bounded_by(&config.voltage_min, 0.0f, 20.0f, KEEL_ERR_LIMITS);
    bounded_by(&config.voltage_spread, 0.0f, 64.0f, KEEL_ERR_LIMITS);
    bounded_by(&config.current_min, -512.0f, 0.0f, KEEL_ERR_LIMITS);
    bounded_by(&config.current_max, 0.0f, 512.0f, KEEL_ERR_LIMITS);
    bounded_by(&config.current_expected, 0.0f, 1024.0f, KEEL_ERR_LIMITS);
    bounded_by(&config.cap_s, 1.0f, 100000.0f, KEEL_ERR_LIMITS);
    bounded_by(&config.low_voltage, 3.25f, 5.0f, KEEL_ERR_LIMITS);
    bounded_by(&config.critical_voltage, 0.0f, 3.5f, KEEL_ERR_LIMITS);
    bounded_by(&config.voltage_margin, 0.0f, 5.0f, KEEL_ERR_LIMITS);
    bounded_by(&config.low_charge, 0.125f, 1.0f, KEEL_ERR_LIMITS);
    bounded_by(&config.critical_charge, 0.0f, 0.25f, KEEL_ERR_LIMITS);
    bounded_by(&config.initial, 0.0f, 1.0f, KEEL_ERR_INITIAL);
}

static void BAT_001_the_greatest_voltage_is_not_negative(void)
{
    config.voltage_max = -1.0f;
    config.voltage_min = -2.0f;
    refused(KEEL_ERR_LIMITS);
}

static void BAT_001_low_thresholds_have_limits_of_their_own(void)
{
    config.low_voltage = 5.5f;
    config.critical_voltage = 5.25f;
    refused(KEEL_ERR_LIMITS);
    config.low_charge = 2.0f;
    config.critical_charge = 1.5f;
    refused(KEEL_ERR_LIMITS);
}

static void BAT_001_each_number_of_steps_has_a_range(void)
{
    config.rate_hz = 0u;
    refused(KEEL_ERR_RATE);
    config.rate_hz = 1001u;
    refused(KEEL_ERR_RATE);
    config.rate_hz = 1u;
    taken();
    config.rate_hz = 1000u;
    taken();
    config.smoothing_steps = 16385u;
    refused(KEEL_ERR_LIMITS);
    config.smoothing_steps = 16384u;
    taken();
    config.smoothing_steps = 0u;
    taken();
    config.settle_steps = 1u;
    refused(KEEL_ERR_LIMITS);
    config.settle_steps = 2u;
    taken();
    config.settle_steps = UINT16_MAX;
    taken();
    config.hold_steps = 0u;
    refused(KEEL_ERR_AGE);
    config.hold_steps = 1u;
    taken();
}

static void BAT_001_cells_and_modules_have_ranges(void)
{
    config.cells = 0u;
    refused(KEEL_ERR_LIMITS);
    config.cells = 15u;
    refused(KEEL_ERR_LIMITS);
    config.cells = 1u;
    taken();
    config.cells = 14u;
    taken();
    config.modules = 0u;
    refused(KEEL_ERR_LIMITS);
    config.modules = 3u;
    refused(KEEL_ERR_LIMITS);
    config.modules = 1u;
    taken();
}

static void BAT_001_the_first_reason_is_told(void)
{
    config.rate_hz = 0u;
    config.cells = 0u;
    refused(KEEL_ERR_RATE);
    config.cells = 0u;
    config.hold_steps = 0u;
    refused(KEEL_ERR_LIMITS);
    config.hold_steps = 0u;
    config.initial = 2.0f;
    refused(KEEL_ERR_AGE);
}

static void BAT_002_scale(void)
{
    TEST_ASSERT_EQUAL_FLOAT(0.1f, battery.scale.step_s);
    TEST_ASSERT_EQUAL_FLOAT(25.6f, battery.scale.unit_j);
    TEST_ASSERT_EQUAL_FLOAT(0.25f, battery.scale.gain);
    TEST_ASSERT_EQUAL_FLOAT(0.25f, battery.scale.per_cell);
    TEST_ASSERT_EQUAL_FLOAT(0.03125f, battery.scale.sag);
    TEST_ASSERT_EQUAL_FLOAT(1.0f / 36000.0f, battery.scale.per_capacity);
    TEST_ASSERT_EQUAL_UINT32(36000u, battery.scale.capacity);
    TEST_ASSERT_EQUAL_UINT32(9000u, battery.scale.low);
    TEST_ASSERT_EQUAL_UINT32(4500u, battery.scale.critical);
}

static void BAT_002_greatest_capacity(void)
{
    config.capacity_ah = 1000.0f;
    config.rate_hz = 1000u;
    config.low_charge = 1.0f;
    config.critical_charge = 1.0f;
    make();
    TEST_ASSERT_EQUAL_UINT32(3600000000u, battery.scale.capacity);
    TEST_ASSERT_EQUAL_UINT32(3600000000u, battery.scale.low);
    TEST_ASSERT_EQUAL_UINT32(3600000000u, battery.scale.critical);
    TEST_ASSERT_EQUAL_UINT32(3600000000u, battery.initial);
}

static void is_new(uint32_t initial, float part)
{
    for (uint32_t i = 0u; i < KEEL_BATTERY_MODULES; i++) {
        TEST_ASSERT_EQUAL_FLOAT(0.0f, battery.module[i].current);
        TEST_ASSERT_EQUAL_UINT16(4u, battery.module[i].age);
    }
    TEST_ASSERT_EQUAL_UINT32(0u, battery.charge.whole);
    TEST_ASSERT_EQUAL_UINT32(0u, battery.charge.part);
    TEST_ASSERT_EQUAL_UINT32(0u, battery.energy.whole);
    TEST_ASSERT_EQUAL_UINT32(0u, battery.energy.part);
    TEST_ASSERT_EQUAL_UINT32(initial, battery.initial);
    TEST_ASSERT_EQUAL_UINT32(initial, battery.left);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, battery.voltage);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, battery.current);
    TEST_ASSERT_EQUAL_FLOAT(8.0f, battery.smoothed);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, battery.cell_voltage);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, battery.charge_c);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, battery.energy_j);
    TEST_ASSERT_EQUAL_FLOAT(part, battery.remaining);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, battery.remaining_s);
    TEST_ASSERT_EQUAL_UINT16(0u, battery.low.count);
    TEST_ASSERT_FALSE(battery.low.raised);
    TEST_ASSERT_EQUAL_UINT16(0u, battery.critical.count);
    TEST_ASSERT_FALSE(battery.critical.raised);
    TEST_ASSERT_EQUAL_UINT16(4u, battery.voltage_age);
    TEST_ASSERT_EQUAL_UINT16(0u, battery.known);
    TEST_ASSERT_EQUAL_HEX32(0u, battery.flags);
    TEST_ASSERT_EQUAL(KEEL_BATTERY_WAITING, battery.count);
    TEST_ASSERT_EQUAL(KEEL_BATTERY_UNKNOWN, battery.level);
}

static void BAT_003_begins_with_nothing_known(void)
{
    is_new(36000u, 1.0f);
    config.initial = 0.75f;
    make();
    is_new(27000u, 0.75f);
}

static void BAT_003_a_restart_forgets_all(void)
{
    sample.running = true;
    volts(10.0f, 10.25f);
    amperes(50.0f, 40.0f);
    steps(100u);
    level_is(KEEL_BATTERY_CRITICAL);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_battery_restart(&battery, 0.5f));
    is_new(18000u, 0.5f);
}

static void BAT_003_a_restart_with_no_part_is_refused(void)
{
    const float wrong[] = {NAN, -FLT_MIN, 1.0000001f, INFINITY};
    keel_battery_t before;

    run();
    memcpy(&before, &battery, sizeof before);
    for (uint32_t i = 0u; i < 4u; i++) {
        TEST_ASSERT_EQUAL(KEEL_ERR_INITIAL, keel_battery_restart(&battery, wrong[i]));
        TEST_ASSERT_EQUAL_MEMORY(&before, &battery, sizeof battery);
    }
    TEST_ASSERT_EQUAL(KEEL_OK, keel_battery_restart(&battery, 0.0f));
    TEST_ASSERT_EQUAL_UINT32(0u, battery.initial);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_battery_restart(&battery, 1.0f));
    TEST_ASSERT_EQUAL_UINT32(36000u, battery.initial);
}

static void BAT_004_a_current_that_cannot_be_is_told(void)
{
    const float wrong[] = {NAN, INFINITY, -INFINITY, -2.0000002f, 100.00001f};

    amperes(3.0f, 5.0f);
    steps(1u);
    flags_are(0u);
    for (uint32_t i = 0u; i < 5u; i++) {
        amperes(wrong[i], 5.0f);
        steps(1u);
        flags_are(KEEL_BATTERY_NO_CURRENT);
        TEST_ASSERT_EQUAL_FLOAT(8.0f, battery.current);
        amperes(3.0f, wrong[i]);
        steps(1u);
        flags_are(KEEL_BATTERY_NO_CURRENT << 1);
        TEST_ASSERT_EQUAL_FLOAT(8.0f, battery.current);
    }
    amperes(100.0f, 100.0f);
    steps(1u);
    flags_are(KEEL_BATTERY_SAG);
    TEST_ASSERT_EQUAL_FLOAT(200.0f, battery.current);
}

static void BAT_004_a_current_that_does_not_come_is_told(void)
{
    sample.module[0].has_current = false;
    steps(1u);
    flags_are(KEEL_BATTERY_NO_CURRENT | KEEL_BATTERY_LOST);
    sample = idle;
    sample.module[1].has_current = false;
    steps(1u);
    flags_are(KEEL_BATTERY_NO_CURRENT << 1);
}

static void BAT_004_a_voltage_that_cannot_be_is_told(void)
{
    const float wrong[] = {NAN, INFINITY, -INFINITY, 7.9999995f, 20.000002f};

    for (uint32_t i = 0u; i < 5u; i++) {
        volts(wrong[i], 15.0f);
        steps(1u);
        flags_are(KEEL_BATTERY_NO_VOLTAGE);
        TEST_ASSERT_EQUAL_FLOAT(15.0f, battery.voltage);
        volts(14.0f, wrong[i]);
        steps(1u);
        flags_are(KEEL_BATTERY_NO_VOLTAGE << 1);
        TEST_ASSERT_EQUAL_FLOAT(14.0f, battery.voltage);
    }
    volts(8.0f, 8.0f);
    steps(1u);
    flags_are(0u);
    volts(20.0f, 20.0f);
    steps(1u);
    flags_are(0u);
}

static void BAT_004_a_negative_current_is_told_and_none(void)
{
    amperes(-2.0f, 3.0f);
    steps(1u);
    flags_are(KEEL_BATTERY_REVERSED);
    TEST_ASSERT_EQUAL_FLOAT(3.0f, battery.current);
    amperes(4.0f, -FLT_MIN);
    steps(1u);
    flags_are(KEEL_BATTERY_REVERSED << 1);
    TEST_ASSERT_EQUAL_FLOAT(4.0f, battery.current);
    amperes(0.0f, -0.0f);
    steps(1u);
    flags_are(0u);
}

static void BAT_004_a_module_that_there_is_not_counts_nothing(void)
{
    config.modules = 1u;
    make();
    volts(16.0f, 10.0f);
    amperes(2.0f, 50.0f);
    steps(3u);
    flags_are(0u);
    level_is(KEEL_BATTERY_OK);
    TEST_ASSERT_EQUAL_FLOAT(16.0f, battery.voltage);
    TEST_ASSERT_EQUAL_FLOAT(2.0f, battery.current);
    sample.module[1].has_voltage = false;
    sample.module[1].has_current = false;
    steps(20u);
    flags_are(0u);
    level_is(KEEL_BATTERY_OK);
    sample.module[0].has_voltage = false;
    sample.module[1].has_voltage = true;
    steps(1u);
    flags_are(KEEL_BATTERY_NO_VOLTAGE);
}

static void BAT_005_the_lower_voltage_counts(void)
{
    volts(15.0f, 15.25f);
    steps(1u);
    flags_are(0u);
    TEST_ASSERT_EQUAL_FLOAT(15.0f, battery.voltage);
    volts(15.0f, 14.75f);
    steps(1u);
    flags_are(0u);
    TEST_ASSERT_EQUAL_FLOAT(14.75f, battery.voltage);
}

static void BAT_005_voltages_that_differ_are_told(void)
{
    volts(15.0f, 15.5f);
    steps(1u);
    flags_are(0u);
    volts(15.0f, 15.500001f);
    steps(1u);
    flags_are(KEEL_BATTERY_SPREAD);
    TEST_ASSERT_EQUAL_FLOAT(15.0f, battery.voltage);
    volts(15.500001f, 15.0f);
    steps(1u);
    flags_are(KEEL_BATTERY_SPREAD);
    TEST_ASSERT_EQUAL_FLOAT(15.0f, battery.voltage);
}

static void BAT_005_without_a_voltage_the_last_stays(void)
{
    volts(15.0f, 15.25f);
    steps(1u);
    no_voltage();
    volts(9.0f, 9.0f);
    for (uint16_t age = 1u; age < 4u; age++) {
        steps(1u);
        flags_are(KEEL_BATTERY_NO_VOLTAGE | (KEEL_BATTERY_NO_VOLTAGE << 1));
        TEST_ASSERT_EQUAL_UINT16(age, battery.voltage_age);
        TEST_ASSERT_EQUAL_FLOAT(15.0f, battery.voltage);
    }
    for (uint16_t more = 0u; more < 3u; more++) {
        steps(1u);
        flags_are(KEEL_BATTERY_NO_VOLTAGE | (KEEL_BATTERY_NO_VOLTAGE << 1) |
                  KEEL_BATTERY_VOLTAGE_LOST);
        TEST_ASSERT_EQUAL_UINT16(4u, battery.voltage_age);
    }
    sample.module[1].has_voltage = true;
    steps(1u);
    flags_are(KEEL_BATTERY_NO_VOLTAGE);
    TEST_ASSERT_EQUAL_UINT16(0u, battery.voltage_age);
    TEST_ASSERT_EQUAL_FLOAT(9.0f, battery.voltage);
}

static void BAT_006_a_current_is_held_and_then_lost(void)
{
    amperes(3.0f, 5.0f);
    run();
    sample.module[1].has_current = false;
    for (uint16_t age = 1u; age < 4u; age++) {
        steps(1u);
        flags_are(KEEL_BATTERY_NO_CURRENT << 1);
        TEST_ASSERT_EQUAL_FLOAT(8.0f, battery.current);
        TEST_ASSERT_EQUAL(KEEL_BATTERY_COUNTED, battery.count);
        level_is(KEEL_BATTERY_OK);
    }
    steps(1u);
    flags_are((KEEL_BATTERY_NO_CURRENT | KEEL_BATTERY_LOST) << 1);
    TEST_ASSERT_EQUAL_FLOAT(8.0f, battery.current);
    TEST_ASSERT_EQUAL(KEEL_BATTERY_UNCOUNTED, battery.count);
    level_is(KEEL_BATTERY_UNKNOWN);
}

static void BAT_006_what_was_not_counted_stays_unknown(void)
{
    run();
    sample.module[0].has_current = false;
    steps(4u);
    TEST_ASSERT_EQUAL(KEEL_BATTERY_UNCOUNTED, battery.count);
    sample = idle;
    steps(100u);
    flags_are(0u);
    TEST_ASSERT_EQUAL(KEEL_BATTERY_UNCOUNTED, battery.count);
    level_is(KEEL_BATTERY_UNKNOWN);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_battery_restart(&battery, 1.0f));
    run();
}

static void BAT_006_modules_may_come_late_while_no_motor_runs(void)
{
    sample.module[1].has_current = false;
    steps(50u);
    TEST_ASSERT_EQUAL(KEEL_BATTERY_WAITING, battery.count);
    level_is(KEEL_BATTERY_UNKNOWN);
    sample.module[1].has_current = true;
    run();
    TEST_ASSERT_EQUAL(KEEL_BATTERY_COUNTED, battery.count);
}

static void BAT_006_a_motor_that_runs_before_them_is_not_counted(void)
{
    sample.module[1].has_current = false;
    sample.running = true;
    steps(1u);
    TEST_ASSERT_EQUAL(KEEL_BATTERY_UNCOUNTED, battery.count);
    sample.module[1].has_current = true;
    steps(50u);
    TEST_ASSERT_EQUAL(KEEL_BATTERY_UNCOUNTED, battery.count);
}

/* 1.5 A for 7 steps of 0.1 s: 10.5 A T, 1.05 C. */
static void BAT_007_charge_is_the_sum_of_the_currents(void)
{
    amperes(1.0f, 0.5f);
    steps(7u);
    TEST_ASSERT_EQUAL_UINT32(10u, battery.charge.whole);
    TEST_ASSERT_EQUAL_UINT32(KEEL_BATTERY_QUANTA / 2u, battery.charge.part);
    TEST_ASSERT_FLOAT_WITHIN(2e-7f, 1.05f, battery.charge_c);
}

/* 1 mA is 1048.576 quanta, of which 1048 count; beside 3 000 000 C no float would take them. */
static void BAT_007_small_currents_are_not_lost_beside_large_sums(void)
{
    config.rate_hz = 1000u;
    config.capacity_ah = 1000.0f;
    make();
    battery.charge.whole = 3000000000u;
    amperes(0.001f, 0.0f);
    steps(2000u);
    TEST_ASSERT_EQUAL_UINT32(3000000001u, battery.charge.whole);
    TEST_ASSERT_EQUAL_UINT32((2000u * 1048u) - KEEL_BATTERY_QUANTA, battery.charge.part);
    TEST_ASSERT_EQUAL_UINT32(599999999u, battery.left);
}

static void BAT_007_the_greatest_sum_stays(void)
{
    battery.charge.whole = UINT32_MAX;
    battery.charge.part = KEEL_BATTERY_QUANTA - 2u;
    amperes(0x1p-20f, 0.0f);
    steps(1u);
    flags_are(0u);
    TEST_ASSERT_EQUAL_UINT32(KEEL_BATTERY_QUANTA - 1u, battery.charge.part);
    steps(1u);
    flags_are(KEEL_BATTERY_FULL);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, battery.charge.whole);
    TEST_ASSERT_EQUAL_UINT32(KEEL_BATTERY_QUANTA - 1u, battery.charge.part);
    TEST_ASSERT_EQUAL_UINT32(0u, battery.left);
    TEST_ASSERT_EQUAL_FLOAT(4294967296.0f * 0.1f, battery.charge_c);
    battery.charge.whole = UINT32_MAX - 1u;
    battery.charge.part = 0u;
    amperes(2.0f, 0.0f);
    steps(1u);
    flags_are(KEEL_BATTERY_FULL);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, battery.charge.whole);
    TEST_ASSERT_EQUAL_UINT32(KEEL_BATTERY_QUANTA - 1u, battery.charge.part);
}

/* 16 V and 20 A are 320 W: 32 J in a step, and 1.25 units of 256 W T. */
static void BAT_008_energy_is_the_sum_of_the_powers(void)
{
    amperes(12.0f, 8.0f);
    steps(3u);
    TEST_ASSERT_EQUAL_UINT32(3u, battery.energy.whole);
    TEST_ASSERT_EQUAL_UINT32((KEEL_BATTERY_QUANTA / 4u) * 3u, battery.energy.part);
    TEST_ASSERT_EQUAL_FLOAT(96.0f, battery.energy_j);
}

static void BAT_008_the_greatest_sum_stays(void)
{
    battery.energy.whole = UINT32_MAX;
    battery.energy.part = KEEL_BATTERY_QUANTA - 1u;
    steps(1u);
    flags_are(0u);
    amperes(1.0f, 0.0f);
    steps(1u);
    flags_are(KEEL_BATTERY_FULL);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, battery.energy.whole);
    TEST_ASSERT_EQUAL_UINT32(KEEL_BATTERY_QUANTA - 1u, battery.energy.part);
}

/* 100 A for 90 steps: 9000 of 36000 A T. */
static void BAT_009_what_is_left_is_what_is_not_used(void)
{
    amperes(50.0f, 50.0f);
    steps(90u);
    TEST_ASSERT_EQUAL_UINT32(27000u, battery.left);
    TEST_ASSERT_EQUAL_FLOAT(0.75f, battery.remaining);
    steps(269u);
    TEST_ASSERT_EQUAL_UINT32(100u, battery.left);
    TEST_ASSERT_EQUAL_FLOAT(100.0f / 36000.0f, battery.remaining);
    steps(1u);
    TEST_ASSERT_EQUAL_UINT32(0u, battery.left);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, battery.remaining);
    steps(10u);
    TEST_ASSERT_EQUAL_UINT32(0u, battery.left);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, battery.remaining);
}

/* Above the critical part are 31500 A T, 3150 C; at 8 A they last for 393.75 s. */
static void BAT_010_time_is_charge_over_smoothed_current(void)
{
    steps(1u);
    TEST_ASSERT_EQUAL_FLOAT(393.75f, battery.remaining_s);
    amperes(100.0f, 0.0f);
    steps(15u);
    TEST_ASSERT_EQUAL_FLOAT(375.0f, battery.remaining_s);
}

/* 3150 C last for the cap of 2000 s at 1.575 A. */
static void BAT_010_the_time_is_capped(void)
{
    config.current_expected = 1.576f;
    make();
    steps(1u);
    TEST_ASSERT_TRUE((battery.remaining_s > 1998.0f) && (battery.remaining_s < 2000.0f));
    config.current_expected = 1.574f;
    make();
    steps(1u);
    TEST_ASSERT_EQUAL_FLOAT(2000.0f, battery.remaining_s);
    config.current_expected = 0.0f;
    make();
    steps(1u);
    TEST_ASSERT_EQUAL_FLOAT(2000.0f, battery.remaining_s);
}

static void BAT_010_no_time_is_left_at_the_critical_part(void)
{
    config.current_expected = 0.0f;
    config.initial = 0.125f;
    make();
    steps(1u);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, battery.remaining_s);
    config.initial = 0.12503f;
    make();
    steps(1u);
    TEST_ASSERT_EQUAL_UINT32(4501u, battery.left);
    TEST_ASSERT_EQUAL_FLOAT(2000.0f, battery.remaining_s);
}

/* 4 V per cell, and 8 A give back 8/32 V. */
static void BAT_011_a_cell_without_load(void)
{
    amperes(5.0f, 3.0f);
    steps(1u);
    TEST_ASSERT_EQUAL_FLOAT(4.25f, battery.cell_voltage);
    flags_are(0u);
    amperes(16.0f, 0.0f);
    steps(1u);
    TEST_ASSERT_EQUAL_FLOAT(4.5f, battery.cell_voltage);
    flags_are(0u);
    amperes(17.0f, 0.0f);
    steps(1u);
    TEST_ASSERT_EQUAL_FLOAT(4.5f, battery.cell_voltage);
    flags_are(KEEL_BATTERY_SAG);
}

static void BAT_011_a_load_that_is_not_known_is_not_made_up_for(void)
{
    amperes(5.0f, 20.0f);
    run();
    sample.module[1].has_current = false;
    steps(3u);
    TEST_ASSERT_EQUAL_FLOAT(4.5f, battery.cell_voltage);
    steps(1u);
    TEST_ASSERT_EQUAL_FLOAT(25.0f, battery.current);
    TEST_ASSERT_EQUAL_FLOAT(4.0f, battery.cell_voltage);
    sample = idle;
    amperes(20.0f, 5.0f);
    steps(1u);
    sample.module[0].has_current = false;
    steps(4u);
    TEST_ASSERT_EQUAL_FLOAT(4.0f, battery.cell_voltage);
}

static void BAT_012_low_voltage_raises_after_settle_steps(void)
{
    run();
    volts(14.0f, 14.0f);
    steps(2u);
    level_is(KEEL_BATTERY_OK);
    steps(1u);
    level_is(KEEL_BATTERY_LOW);
    volts(13.0f, 13.0f);
    steps(2u);
    level_is(KEEL_BATTERY_LOW);
    steps(1u);
    level_is(KEEL_BATTERY_CRITICAL);
}

static void BAT_012_above_the_threshold_nothing_is_raised(void)
{
    run();
    volts(14.000001f, 14.000001f);
    steps(100u);
    level_is(KEEL_BATTERY_OK);
    TEST_ASSERT_EQUAL_UINT16(0u, battery.low.count);
}

static void BAT_012_what_flutters_does_not_raise(void)
{
    run();
    for (uint32_t i = 0u; i < 100u; i++) {
        volts(13.0f, 13.0f);
        steps(1u);
        volts(15.0f, 15.0f);
        steps(1u);
        level_is(KEEL_BATTERY_OK);
    }
    TEST_ASSERT_EQUAL_UINT16(0u, battery.low.count);
    TEST_ASSERT_EQUAL_UINT16(0u, battery.critical.count);
}

static void BAT_012_a_voltage_that_is_held_is_no_evidence(void)
{
    run();
    volts(12.0f, 12.0f);
    steps(2u);
    no_voltage();
    steps(50u);
    TEST_ASSERT_EQUAL_UINT16(2u, battery.low.count);
    TEST_ASSERT_EQUAL_UINT16(2u, battery.critical.count);
    level_is(KEEL_BATTERY_UNKNOWN);
    sample = idle;
    volts(12.0f, 12.0f);
    steps(1u);
    level_is(KEEL_BATTERY_CRITICAL);
}

static void BAT_012_a_short_sag_raises_nothing_and_load_is_made_up_for(void)
{
    run();
    amperes(16.0f, 0.0f);
    volts(13.0f, 13.0f); /* 3.25 V, without load 3.75 V. */
    steps(20u);
    level_is(KEEL_BATTERY_OK);
    volts(12.0f, 12.0f); /* 3 V, without load 3.5 V. */
    steps(3u);
    level_is(KEEL_BATTERY_LOW);
}

/* 100 A T in a step: 27000 A T after 270 steps leave 9000. */
static void BAT_012_low_charge_raises_after_settle_steps(void)
{
    volts(20.0f, 20.0f);
    amperes(100.0f, 0.0f);
    steps(269u);
    TEST_ASSERT_EQUAL_UINT16(0u, battery.low.count);
    steps(2u);
    level_is(KEEL_BATTERY_OK);
    steps(1u);
    level_is(KEEL_BATTERY_LOW);
    steps(42u);
    TEST_ASSERT_EQUAL_UINT16(0u, battery.critical.count);
    steps(3u);
    level_is(KEEL_BATTERY_CRITICAL);
}

/* 3.375 V per cell raise; 3.75 V, the margin above the threshold, take back. */
static void BAT_013_is_taken_back_above_the_margin_only(void)
{
    volts(13.5f, 13.5f);
    steps(3u);
    level_is(KEEL_BATTERY_LOW);
    volts(14.999999f, 14.999999f);
    steps(100u);
    level_is(KEEL_BATTERY_LOW);
    TEST_ASSERT_EQUAL_UINT16(3u, battery.low.count);
    volts(15.0f, 15.0f);
    steps(2u);
    level_is(KEEL_BATTERY_LOW);
    no_voltage();
    steps(3u);
    level_is(KEEL_BATTERY_LOW);
    sample = idle;
    volts(15.0f, 15.0f);
    steps(1u);
    level_is(KEEL_BATTERY_OK);
}

static void BAT_013_critical_is_taken_back_by_its_own_threshold(void)
{
    volts(12.5f, 12.5f);
    steps(3u);
    level_is(KEEL_BATTERY_CRITICAL);
    volts(13.999999f, 13.999999f);
    steps(100u);
    level_is(KEEL_BATTERY_CRITICAL);
    volts(14.0f, 14.0f);
    steps(3u);
    level_is(KEEL_BATTERY_LOW);
    volts(15.0f, 15.0f);
    steps(3u);
    level_is(KEEL_BATTERY_OK);
}

static void BAT_013_a_charge_that_is_low_stays(void)
{
    config.initial = 0.25f;
    make();
    volts(20.0f, 20.0f);
    steps(1000u);
    level_is(KEEL_BATTERY_LOW);
    TEST_ASSERT_EQUAL_UINT16(3u, battery.low.count);
}

static void BAT_014_ok_needs_all_known_for_settle_steps(void)
{
    steps(2u);
    level_is(KEEL_BATTERY_UNKNOWN);
    steps(1u);
    level_is(KEEL_BATTERY_OK);
    no_voltage();
    steps(3u);
    level_is(KEEL_BATTERY_OK);
    steps(1u);
    level_is(KEEL_BATTERY_UNKNOWN);
    TEST_ASSERT_EQUAL_UINT16(0u, battery.known);
    sample = idle;
    steps(2u);
    level_is(KEEL_BATTERY_UNKNOWN);
    steps(1u);
    level_is(KEEL_BATTERY_OK);
}

static void BAT_014_a_low_battery_is_never_ok(void)
{
    volts(13.5f, 13.5f);
    steps(2u);
    level_is(KEEL_BATTERY_UNKNOWN);
    steps(1u);
    level_is(KEEL_BATTERY_LOW);
}

static void BAT_014_an_alarm_outlives_all_modules(void)
{
    volts(13.5f, 13.5f);
    steps(3u);
    memset(&sample, 0, sizeof sample);
    steps(1000u);
    level_is(KEEL_BATTERY_LOW);
    flags_are(0x0133u | (KEEL_BATTERY_NO_CURRENT * 3u));
}

static void BAT_014_an_estimate_is_enough_for_an_alarm(void)
{
    amperes(100.0f, 0.0f);
    volts(20.0f, 20.0f);
    run();
    sample.module[0].has_current = false;
    sample.module[1].has_current = false;
    steps(400u);
    TEST_ASSERT_EQUAL(KEEL_BATTERY_UNCOUNTED, battery.count);
    level_is(KEEL_BATTERY_CRITICAL);
    TEST_ASSERT_EQUAL_UINT32(0u, battery.left);
}

static void BAT_015_whatever_comes_all_stays_finite(void)
{
    const float odd[] = {NAN, INFINITY, -INFINITY, FLT_MAX, -FLT_MAX, FLT_MIN, 0x1p-149f, -0.0f};

    config.voltage_min = 0.0f;
    config.voltage_max = 64.0f;
    config.current_max = 512.0f;
    config.cells = 1u;
    make();
    sample.running = true;
    for (uint32_t i = 0u; i < 4096u; i++) {
        volts(odd[i % 8u], odd[(i / 8u) % 8u]);
        amperes(odd[(i / 64u) % 8u], odd[(i / 512u) % 8u]);
        steps(1u);
        TEST_ASSERT_TRUE(isfinite(battery.voltage) && isfinite(battery.cell_voltage));
        TEST_ASSERT_TRUE(isfinite(battery.charge_c) && isfinite(battery.energy_j));
        TEST_ASSERT_TRUE((battery.current >= 0.0f) && (battery.current <= 1024.0f));
        TEST_ASSERT_TRUE((battery.smoothed >= 0.0f) && (battery.smoothed <= 1024.0f));
        TEST_ASSERT_TRUE((battery.remaining >= 0.0f) && (battery.remaining <= 1.0f));
        TEST_ASSERT_TRUE((battery.remaining_s >= 0.0f) && (battery.remaining_s <= 2000.0f));
    }
}

/* A quarter of the way in each step: 8, 14, 18.5 on the way to 32. */
static void BAT_016_the_smoothed_current_follows_while_motors_run(void)
{
    amperes(20.0f, 12.0f);
    steps(5u);
    TEST_ASSERT_EQUAL_FLOAT(8.0f, battery.smoothed);
    sample.running = true;
    steps(1u);
    TEST_ASSERT_EQUAL_FLOAT(14.0f, battery.smoothed);
    steps(1u);
    TEST_ASSERT_EQUAL_FLOAT(18.5f, battery.smoothed);
    steps(100u);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 32.0f, battery.smoothed);
    amperes(0.0f, 0.0f);
    steps(1u);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 24.0f, battery.smoothed);
}

/* 64 V and 512 A from both: all that there can be. */
static void BAT_015_the_greatest_of_all(void)
{
    config.capacity_ah = 1000.0f;
    config.initial = 1.0f;
    config.voltage_max = 64.0f;
    config.voltage_min = 64.0f;
    config.current_max = 512.0f;
    config.smoothing_steps = 0u;
    config.rate_hz = 1000u;
    make();
    TEST_ASSERT_EQUAL(KEEL_OK, keel_battery_restart(&battery, 1.0f));
    TEST_ASSERT_EQUAL_UINT32(3600000000u, battery.initial);
    volts(64.0f, 64.0f);
    amperes(512.0f, 512.0f);
    sample.running = true;
    steps(1u);
    TEST_ASSERT_EQUAL_FLOAT(1024.0f, battery.current);
    TEST_ASSERT_EQUAL_FLOAT(1024.0f, battery.smoothed);
    TEST_ASSERT_EQUAL_FLOAT(1.024f, battery.charge_c);
    TEST_ASSERT_EQUAL_FLOAT(65.536f, battery.energy_j);
}

/* Nothing drawn of a full battery, and one that is empty with thresholds of 0. */
static void BAT_015_the_least_of_all(void)
{
    config.initial = 1.0f;
    config.smoothing_steps = 0u;
    make();
    sample.running = true;
    steps(1u);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, battery.remaining);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, battery.smoothed);
    config.initial = 0.0f;
    config.low_charge = 0.0f;
    config.critical_charge = 0.0f;
    make();
    TEST_ASSERT_EQUAL_UINT32(0u, battery.scale.low);
    TEST_ASSERT_EQUAL_UINT32(0u, battery.scale.critical);
    steps(1u);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, battery.remaining);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, battery.remaining_s);
}

/* What is told of a first step, whatever came: bits of `came` are the voltages and currents. */
static void first_step_tells(uint8_t modules, uint32_t came, bool running)
{
    uint32_t expected = 0u;

    config.modules = modules;
    make();
    for (uint32_t i = 0u; i < 2u; i++) {
        sample.module[i].has_voltage = ((came >> i) & 1u) != 0u;
        sample.module[i].has_current = ((came >> (i + 2u)) & 1u) != 0u;
        if (i < modules) {
            expected |= sample.module[i].has_voltage ? 0u : (KEEL_BATTERY_NO_VOLTAGE << i);
            expected |= sample.module[i].has_current
                            ? 0u
                            : ((KEEL_BATTERY_NO_CURRENT | KEEL_BATTERY_LOST) << i);
        }
    }
    if (!sample.module[0].has_voltage && ((modules == 1u) || !sample.module[1].has_voltage)) {
        expected |= KEEL_BATTERY_VOLTAGE_LOST;
    }
    sample.running = running;
    steps(1u);
    TEST_ASSERT_EQUAL_HEX32(expected, battery.flags);
}

static void BAT_004_whatever_comes_is_told(void)
{
    for (uint32_t came = 0u; came < 16u; came++) {
        first_step_tells(1u, came, false);
        first_step_tells(1u, came, true);
        first_step_tells(2u, came, false);
        first_step_tells(2u, came, true);
    }
}

/* Below and above what can be, of the only module. */
static void BAT_004_a_voltage_out_of_range_of_one_module(void)
{
    config.modules = 1u;
    make();
    volts(0.0f, 16.0f);
    steps(1u);
    flags_are(KEEL_BATTERY_NO_VOLTAGE | KEEL_BATTERY_VOLTAGE_LOST);
    volts(64.0f, 16.0f);
    steps(1u);
    flags_are(KEEL_BATTERY_NO_VOLTAGE | KEEL_BATTERY_VOLTAGE_LOST);
}

/* 2050518 A s over 49.5027 A are less than the cap, and the cap when rounded. */
static void BAT_010_a_time_that_is_rounded_to_the_cap(void)
{
    config.capacity_ah = 1000.0f;
    config.rate_hz = 1000u;
    config.initial = 1.0f;
    config.low_charge = 0.0f;
    config.critical_charge = 0.0f;
    config.current_expected = 49.5027008f;
    config.cap_s = 41422.3477f;
    make();
    battery.charge.whole = 3600000000u - 2050517835u;
    steps(1u);
    TEST_ASSERT_EQUAL_UINT32(2050517835u, battery.left);
    TEST_ASSERT_EQUAL_FLOAT(config.cap_s, battery.remaining_s);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(BAT_001_each_number_has_a_range);
    RUN_TEST(BAT_001_the_greatest_voltage_is_not_negative);
    RUN_TEST(BAT_001_low_thresholds_have_limits_of_their_own);
    RUN_TEST(BAT_001_each_number_of_steps_has_a_range);
    RUN_TEST(BAT_001_cells_and_modules_have_ranges);
    RUN_TEST(BAT_001_the_first_reason_is_told);
    RUN_TEST(BAT_002_scale);
    RUN_TEST(BAT_002_greatest_capacity);
    RUN_TEST(BAT_003_begins_with_nothing_known);
    RUN_TEST(BAT_003_a_restart_forgets_all);
    RUN_TEST(BAT_003_a_restart_with_no_part_is_refused);
    RUN_TEST(BAT_004_a_current_that_cannot_be_is_told);
    RUN_TEST(BAT_004_a_current_that_does_not_come_is_told);
    RUN_TEST(BAT_004_a_voltage_that_cannot_be_is_told);
    RUN_TEST(BAT_004_a_negative_current_is_told_and_none);
    RUN_TEST(BAT_004_a_module_that_there_is_not_counts_nothing);
    RUN_TEST(BAT_005_the_lower_voltage_counts);
    RUN_TEST(BAT_005_voltages_that_differ_are_told);
    RUN_TEST(BAT_005_without_a_voltage_the_last_stays);
    RUN_TEST(BAT_006_a_current_is_held_and_then_lost);
    RUN_TEST(BAT_006_what_was_not_counted_stays_unknown);
    RUN_TEST(BAT_006_modules_may_come_late_while_no_motor_runs);
    RUN_TEST(BAT_006_a_motor_that_runs_before_them_is_not_counted);
    RUN_TEST(BAT_007_charge_is_the_sum_of_the_currents);
    RUN_TEST(BAT_007_small_currents_are_not_lost_beside_large_sums);
    RUN_TEST(BAT_007_the_greatest_sum_stays);
    RUN_TEST(BAT_008_energy_is_the_sum_of_the_powers);
    RUN_TEST(BAT_008_the_greatest_sum_stays);
    RUN_TEST(BAT_009_what_is_left_is_what_is_not_used);
    RUN_TEST(BAT_010_time_is_charge_over_smoothed_current);
    RUN_TEST(BAT_010_the_time_is_capped);
    RUN_TEST(BAT_010_no_time_is_left_at_the_critical_part);
    RUN_TEST(BAT_011_a_cell_without_load);
    RUN_TEST(BAT_011_a_load_that_is_not_known_is_not_made_up_for);
    RUN_TEST(BAT_012_low_voltage_raises_after_settle_steps);
    RUN_TEST(BAT_012_above_the_threshold_nothing_is_raised);
    RUN_TEST(BAT_012_what_flutters_does_not_raise);
    RUN_TEST(BAT_012_a_voltage_that_is_held_is_no_evidence);
    RUN_TEST(BAT_012_a_short_sag_raises_nothing_and_load_is_made_up_for);
    RUN_TEST(BAT_012_low_charge_raises_after_settle_steps);
    RUN_TEST(BAT_013_is_taken_back_above_the_margin_only);
    RUN_TEST(BAT_013_critical_is_taken_back_by_its_own_threshold);
    RUN_TEST(BAT_013_a_charge_that_is_low_stays);
    RUN_TEST(BAT_014_ok_needs_all_known_for_settle_steps);
    RUN_TEST(BAT_014_a_low_battery_is_never_ok);
    RUN_TEST(BAT_014_an_alarm_outlives_all_modules);
    RUN_TEST(BAT_014_an_estimate_is_enough_for_an_alarm);
    RUN_TEST(BAT_015_whatever_comes_all_stays_finite);
    RUN_TEST(BAT_016_the_smoothed_current_follows_while_motors_run);
    RUN_TEST(BAT_015_the_greatest_of_all);
    RUN_TEST(BAT_015_the_least_of_all);
    RUN_TEST(BAT_004_whatever_comes_is_told);
    RUN_TEST(BAT_004_a_voltage_out_of_range_of_one_module);
    RUN_TEST(BAT_010_a_time_that_is_rounded_to_the_cap);
    return UNITY_END();
}
