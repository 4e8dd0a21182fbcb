/* SPDX-License-Identifier: Apache-2.0 */
/* The battery monitor beside its executable specification (specs/model): random and adversarial
 * samples to both, after each of which every bit of the monitor must be the same; and beside sums
 * in double precision and 64 bits. */
#include "any.h"
#include "keel/flight/battery.h"
#include "unity.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* The model is part of this test: the kernel that it is linked with has none. */
#include "../../specs/model/battery.c"

#define STEPS       1000000u
#define SETUP_EVERY 4096u
#define SEED        20261123u

static keel_battery_t battery;
static keel_battery_t model;
static double charge; /* In A T. */
static double energy; /* In W T. */
static uint64_t quanta;

void setUp(void)
{
    any_from(SEED);
    memset(&battery, 0, sizeof battery);
    memset(&model, 0, sizeof model);
}

void tearDown(void)
{
}

/* What breaks arithmetic that did not expect it. */
static float awkward(void)
{
    const float values[] = {NAN,     INFINITY, -INFINITY, 0.0f,       -0.0f,      0x1p-149f,
                            FLT_MAX, -FLT_MAX, 1.0e6f,    any_bits(), any_bits(), -1.0f};

    return values[any() % (sizeof values / sizeof values[0])];
}

static float usually(float value)
{
    return one_in(512u) ? awkward() : value;
}

/* Mostly good ones: whether a configuration is taken is the model's to say, too. */
static void set_up(void)
{
    const float critical = between(0.0f, 0.5f);
    const keel_battery_config_t config = {.capacity_ah = usually(between(0.3f, 8.0f)),
                                          .initial = usually(between(0.5f, 1.0f)),
                                          .resistance_ohm = usually(between(0.0f, 0.1f)),
                                          .voltage_min = 8.0f,
                                          .voltage_max = usually(20.0f),
                                          .voltage_spread = usually(0.5f),
                                          .current_min = -1.0f,
                                          .current_max = usually(120.0f),
                                          .current_expected = between(0.0f, 30.0f),
                                          .cap_s = usually(between(1.0f, 4000.0f)),
                                          .low_voltage = 3.5f,
                                          .critical_voltage = usually(3.25f),
                                          .voltage_margin = between(0.0f, 0.5f),
                                          .low_charge = usually(critical + 0.2f),
                                          .critical_charge = usually(critical),
                                          .rate_hz = (uint16_t)(1u + (any() % 100u)),
                                          .smoothing_steps = (uint16_t)(any() % 64u),
                                          .settle_steps = (uint16_t)(2u + (any() % 16u)),
                                          .hold_steps = (uint16_t)(any() % 32u),
                                          .cells = 4u,
                                          .modules = (uint8_t)(1u + (any() % 2u))};
    const keel_status_t expected = model_battery_init(&model, &config);

    TEST_ASSERT_EQUAL(expected, keel_battery_init(&battery, &config));
    if (expected == KEEL_OK) {
        charge = 0.0;
        energy = 0.0;
        quanta = 0u;
    }
}

static keel_battery_reading_t any_reading(float voltage, float current)
{
    const keel_battery_reading_t reading = {.voltage = usually(voltage + between(-0.2f, 0.2f)),
                                            .current = usually(current + between(-0.5f, 0.5f)),
                                            .has_voltage = !one_in(16u),
                                            .has_current = !one_in(64u)};

    return reading;
}

/* A battery that empties and recovers, with modules that fall silent now and then. */
static keel_battery_sample_t any_sample(uint32_t step)
{
    const float voltage = 14.5f + (2.0f * sinf((float)(step % 1024u) * 0.00613592f));
    const float current = one_in(64u) ? 100.0f : 5.0f;
    const bool silent = (step % 8192u) < 64u;
    keel_battery_sample_t sample = {
        .module = {any_reading(voltage, current), any_reading(voltage, current)},
        .running = one_in(2u)};

    if (silent) {
        sample.module[1].has_current = false;
        sample.module[0].has_voltage = false;
        sample.module[1].has_voltage = false;
    }
    return sample;
}

/* Added up beside it: the currents that the monitor tells, each cut to quanta. */
static void add_beside(void)
{
    charge += (double)battery.current;
    energy += (double)battery.current * (double)battery.voltage;
    quanta += (uint64_t)((double)battery.current * 1048576.0);
}

/* Each step cuts off less than a quantum; and single precision tells the sums. */
static void sums_are_right(uint32_t steps)
{
    const double is = (double)battery.charge.whole + ((double)battery.charge.part / 1048576.0);
    const double power = ((double)battery.energy.whole +
                          ((double)battery.energy.part / 1048576.0)) *
                         256.0;
    const double rate = (double)battery.config.rate_hz;

    TEST_ASSERT_EQUAL_UINT64(quanta, ((uint64_t)battery.charge.whole << 20) + battery.charge.part);
    TEST_ASSERT_TRUE((is <= charge) && (is >= (charge - ((double)steps / 1048576.0))));
    TEST_ASSERT_TRUE(fabs(power - energy) <= ((energy * 0x1p-23) + ((double)steps / 4096.0)));
    TEST_ASSERT_TRUE(fabs((double)battery.charge_c - (is / rate)) <= (is * 0x1p-21 / rate));
    TEST_ASSERT_TRUE(fabs((double)battery.energy_j - (power / rate)) <= (power * 0x1p-21 / rate));
}

static void is_bounded(void)
{
    TEST_ASSERT_TRUE((battery.voltage >= 0.0f) && (battery.voltage <= 64.0f));
    TEST_ASSERT_TRUE((battery.current >= 0.0f) && (battery.current <= 1024.0f));
    TEST_ASSERT_TRUE((battery.smoothed >= 0.0f) && (battery.smoothed <= 1024.0f));
    TEST_ASSERT_TRUE((battery.cell_voltage >= 0.0f) && (battery.cell_voltage <= 64.5f));
    TEST_ASSERT_TRUE((battery.remaining >= 0.0f) && (battery.remaining <= 1.0f));
    TEST_ASSERT_TRUE((battery.remaining_s >= 0.0f) &&
                     (battery.remaining_s <= battery.config.cap_s));
}

static void BAT_016_every_step_is_the_specified_one(void)
{
    uint32_t seen[4] = {0u};
    uint32_t counted[3] = {0u};
    uint32_t told = 0u;
    uint32_t steps = 0u;

    set_up();
    for (uint32_t i = 0u; i < STEPS; i++) {
        const keel_battery_sample_t sample = any_sample(i);

        if ((i % SETUP_EVERY) == 0u) {
            set_up();
        }
        if (one_in(16384u)) {
            const float part = usually(between(0.0f, 1.0f));
            const keel_status_t expected = model_battery_restart(&model, part);

            TEST_ASSERT_EQUAL(expected, keel_battery_restart(&battery, part));
        }
        if ((battery.charge.whole == 0u) && (battery.charge.part == 0u)) {
            charge = 0.0;
            energy = 0.0;
            quanta = 0u;
            steps = 0u;
        }
        keel_battery_step(&battery, &sample);
        model_battery_step(&model, &sample);
        TEST_ASSERT_EQUAL_MEMORY(&model, &battery, sizeof battery);
        add_beside();
        steps++;
        sums_are_right(steps);
        is_bounded();
        seen[battery.level]++;
        counted[battery.count]++;
        told |= battery.flags;
    }
    for (uint32_t i = 0u; i < 4u; i++) {
        TEST_ASSERT_GREATER_THAN_UINT32(STEPS / 100u, seen[i]);
    }
    for (uint32_t i = 1u; i < 3u; i++) {
        TEST_ASSERT_GREATER_THAN_UINT32(STEPS / 100u, counted[i]);
    }
    TEST_ASSERT_GREATER_THAN_UINT32(0u, counted[KEEL_BATTERY_WAITING]);
    TEST_ASSERT_EQUAL_HEX32(0x07FFu, told);
}

/* With the longest smoothing, too, a current that lasts is reached to within 2^-9 of it. */
static void BAT_016_the_longest_smoothing_arrives(void)
{
    const keel_battery_config_t config = {.capacity_ah = 1000.0f,
                                          .initial = 1.0f,
                                          .voltage_max = 20.0f,
                                          .current_max = 100.0f,
                                          .current_expected = 10.0f,
                                          .cap_s = 2000.0f,
                                          .low_voltage = 3.5f,
                                          .rate_hz = 10u,
                                          .smoothing_steps = 16384u,
                                          .settle_steps = 3u,
                                          .hold_steps = 4u,
                                          .cells = 4u,
                                          .modules = 1u};
    keel_battery_sample_t sample = {.module = {{16.0f, 20.0f, true, true}}, .running = true};

    TEST_ASSERT_EQUAL(KEEL_OK, keel_battery_init(&battery, &config));
    for (uint32_t i = 0u; i < 400000u; i++) {
        keel_battery_step(&battery, &sample);
    }
    TEST_ASSERT_FLOAT_WITHIN(20.0f / 512.0f, 20.0f, battery.smoothed);
    sample.module[0].current = 10.0f;
    for (uint32_t i = 0u; i < 400000u; i++) {
        keel_battery_step(&battery, &sample);
    }
    TEST_ASSERT_FLOAT_WITHIN(10.0f / 512.0f, 10.0f, battery.smoothed);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(BAT_016_every_step_is_the_specified_one);
    RUN_TEST(BAT_016_the_longest_smoothing_arrives);
    return UNITY_END();
}
