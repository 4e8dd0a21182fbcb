/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/flight/pid.h. Expected values are worked out by hand. */
#include "keel/internal/flight/pid.h"
#include "unity.h"

#include <math.h>
#include <string.h>

static keel_pid_config_t config;
static keel_pid_t pid;

/* 100 Hz, so that T = 1/100 s; the low-pass at a quarter of that, where the first two values of its
 * step response are 1 / (2 + sqrt(2)) = 0.29289322 and three times that. */
void setUp(void)
{
    memset(&pid, 0x55, sizeof pid);
    config = (keel_pid_config_t){.rate_hz = 100.0f,
                                 .cutoff_hz = 25.0f,
                                 .output_min = -50.0f,
                                 .output_max = 100.0f,
                                 .integral_min = -20.0f,
                                 .integral_max = 30.0f};
}

void tearDown(void)
{
}

static void make(float kp, float ki, float kd, float kff)
{
    config.gains = (keel_pid_gains_t){kp, ki, kd, kff};
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pid_init(&pid, &config));
}

static void step_to(float expected, float setpoint, float measurement)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pid_step(&pid, setpoint, measurement));
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, expected, pid.output);
}

static void init_refuses(keel_status_t status)
{
    keel_pid_t before;

    memcpy(&before, &pid, sizeof before);
    TEST_ASSERT_EQUAL(status, keel_pid_init(&pid, &config));
    TEST_ASSERT_EQUAL_MEMORY(&before, &pid, sizeof pid);
}

static void refuses_gain(float *gain)
{
    const float good = *gain;
    const float bad[] = {-1.0f, 1000001.0f, INFINITY, NAN};

    for (size_t i = 0u; i < (sizeof bad / sizeof bad[0]); i++) {
        *gain = bad[i];
        init_refuses(KEEL_ERR_GAIN);
    }
    *gain = 1.0e6f;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pid_init(&pid, &config));
    *gain = good;
}

static void PID_001_bad_gains_are_refused(void)
{
    refuses_gain(&config.gains.kp);
    refuses_gain(&config.gains.ki);
    refuses_gain(&config.gains.kd);
    refuses_gain(&config.gains.kff);
}

static void refuses_limit(float *limit, float value)
{
    const float good = *limit;

    *limit = value;
    init_refuses(KEEL_ERR_LIMITS);
    *limit = NAN;
    init_refuses(KEEL_ERR_LIMITS);
    *limit = good;
}

static void PID_001_bad_limits_are_refused(void)
{
    refuses_limit(&config.output_min, 100.0f); /* not below output_max */
    refuses_limit(&config.output_min, -1.1e9f);
    refuses_limit(&config.output_min, 1.1e9f);
    refuses_limit(&config.output_min, -INFINITY);
    refuses_limit(&config.output_max, -50.0f);
    refuses_limit(&config.output_max, 1.1e9f);
    refuses_limit(&config.output_max, INFINITY);
    refuses_limit(&config.integral_min, 0.001f);
    refuses_limit(&config.integral_min, -1.1e9f);
    refuses_limit(&config.integral_min, 1.1e9f);
    refuses_limit(&config.integral_max, -0.001f);
    refuses_limit(&config.integral_max, 1.1e9f);
    /* The next number behind 1e9. */
    refuses_limit(&config.output_max, 1000000064.0f);
    refuses_limit(&config.integral_min, -1000000064.0f);
    config.output_min = -1.0e9f;
    config.output_max = 1.0e9f;
    config.integral_min = -1.0e9f;
    config.integral_max = 1.0e9f;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pid_init(&pid, &config));
}

static void PID_001_what_the_filter_refuses_is_refused(void)
{
    config.rate_hz = 0.0f;
    init_refuses(KEEL_ERR_RATE);
    config.rate_hz = 100.0f;
    config.cutoff_hz = 50.0f;
    init_refuses(KEEL_ERR_CUTOFF);
}

static void PID_002_made_as_configured(void)
{
    make(1.0f, 2.0f, 3.0f, 4.0f);
    TEST_ASSERT_EQUAL_MEMORY(&config, &pid.config, sizeof config);
    TEST_ASSERT_FLOAT_WITHIN(1e-8f, 0.02f, pid.integral_gain);
    TEST_ASSERT_FALSE(pid.started);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, pid.output);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, pid.integral);
}

static void PID_003_reset_forgets(void)
{
    make(1.0f, 10.0f, 1.0f, 1.0f);
    step_to(21.0f, 10.0f, 0.0f); /* 10 + 1 + 0 + 10 */
    keel_pid_reset(&pid);
    TEST_ASSERT_FALSE(pid.started);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, pid.output);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, pid.integral);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, pid.setpoint);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, pid.error);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, pid.derivative);
    step_to(21.0f, 10.0f, 0.0f);
}

static void PID_003_output_is_the_limit_next_to_0(void)
{
    config.output_min = 5.0f;
    make(0.0f, 0.0f, 0.0f, 0.0f);
    TEST_ASSERT_EQUAL_FLOAT(5.0f, pid.output);
    pid.output = 6.0f;
    keel_pid_reset(&pid);
    TEST_ASSERT_EQUAL_FLOAT(5.0f, pid.output);
    config.output_min = -50.0f;
    config.output_max = -5.0f;
    make(0.0f, 0.0f, 0.0f, 0.0f);
    TEST_ASSERT_EQUAL_FLOAT(-5.0f, pid.output);
    TEST_ASSERT_EQUAL(KEEL_PID_FREE, pid.saturation);
    pid.output = -6.0f;
    keel_pid_reset(&pid);
    TEST_ASSERT_EQUAL_FLOAT(-5.0f, pid.output);
}

static void set_gains_refuses(keel_pid_gains_t gains)
{
    keel_pid_t before;

    memcpy(&before, &pid, sizeof before);
    TEST_ASSERT_EQUAL(KEEL_ERR_GAIN, keel_pid_set_gains(&pid, &gains));
    TEST_ASSERT_EQUAL_MEMORY(&before, &pid, sizeof pid);
}

static void PID_004_bad_gains_change_nothing(void)
{
    make(1.0f, 2.0f, 3.0f, 4.0f);
    step_to(5.02f, 1.0f, 0.0f);
    set_gains_refuses((keel_pid_gains_t){-0.1f, 2.0f, 3.0f, 4.0f});
    set_gains_refuses((keel_pid_gains_t){1.0f, NAN, 3.0f, 4.0f});
    set_gains_refuses((keel_pid_gains_t){1.0f, 2.0f, INFINITY, 4.0f});
    set_gains_refuses((keel_pid_gains_t){1.0f, 2.0f, 3.0f, 1.1e6f});
}

static void PID_005_new_gains_without_a_bump(void)
{
    const keel_pid_gains_t gains = {3.0f, 0.0f, 0.25f, 0.5f};

    make(2.0f, 10.0f, 0.5f, 1.0f);
    step_to(0.0f, 0.0f, 0.0f);
    /* e = 4, r = 1: 8 + 0.4 + 0.5 * 4 * 29.289322 + 1. */
    step_to(67.978644f, 1.0f, -3.0f);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pid_set_gains(&pid, &gains));
    TEST_ASSERT_EQUAL_MEMORY(&gains, &pid.config.gains, sizeof gains);
    /* The integral, 0.4, takes over (8 - 12) + (58.578644 - 29.289322) + (1 - 0.5). */
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 26.189322f, pid.integral);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, pid.integral_gain);
    /* 12 + 0.25 * d + 0.5 + 26.189322 with d = 4 * 0.58578644 * 100. */
    step_to(97.267966f, 1.0f, -3.0f);
}

static void PID_005_new_ki_acts_on_what_comes(void)
{
    const keel_pid_gains_t gains = {0.0f, 100.0f, 0.0f, 0.0f};

    make(0.0f, 10.0f, 0.0f, 0.0f);
    step_to(0.5f, 5.0f, 0.0f);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pid_set_gains(&pid, &gains));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.5f, pid.integral);
    step_to(5.5f, 5.0f, 0.0f);
}

static void PID_005_takes_over_up_to_its_limits(void)
{
    const keel_pid_gains_t gains = {0.0f, 0.0f, 0.0f, 0.0f};

    make(10.0f, 0.0f, 0.0f, 0.0f);
    step_to(50.0f, 5.0f, 0.0f);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pid_set_gains(&pid, &gains));
    TEST_ASSERT_EQUAL_FLOAT(30.0f, pid.integral);
    make(10.0f, 0.0f, 0.0f, 0.0f);
    step_to(-40.0f, -4.0f, 0.0f);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pid_set_gains(&pid, &gains));
    TEST_ASSERT_EQUAL_FLOAT(-20.0f, pid.integral);
}

static void PID_006_integral_stays_within_its_limits(void)
{
    make(0.0f, 100.0f, 0.0f, 0.0f);
    step_to(18.0f, 18.0f, 0.0f);
    step_to(30.0f, 18.0f, 0.0f);
    TEST_ASSERT_EQUAL_FLOAT(30.0f, pid.integral);
    TEST_ASSERT_EQUAL(KEEL_PID_FREE, pid.saturation);
    step_to(12.0f, -18.0f, 0.0f);
    step_to(-6.0f, -18.0f, 0.0f);
    step_to(-20.0f, -18.0f, 0.0f);
    TEST_ASSERT_EQUAL_FLOAT(-20.0f, pid.integral);
}

static void PID_007_bad_inputs_are_held(void)
{
    keel_pid_t before;
    const float bad[] = {NAN, INFINITY, -INFINITY, 500001.0f, -500001.0f};

    make(1.0f, 10.0f, 0.5f, 1.0f);
    step_to(2.1f, 1.0f, 0.0f);
    memcpy(&before, &pid, sizeof before);
    for (size_t i = 0u; i < (sizeof bad / sizeof bad[0]); i++) {
        TEST_ASSERT_EQUAL(KEEL_ERR_INPUT, keel_pid_step(&pid, bad[i], 0.0f));
        TEST_ASSERT_EQUAL_MEMORY(&before, &pid, sizeof pid);
        TEST_ASSERT_EQUAL(KEEL_ERR_INPUT, keel_pid_step(&pid, 0.0f, bad[i]));
        TEST_ASSERT_EQUAL_MEMORY(&before, &pid, sizeof pid);
    }
}

static void PID_007_what_the_filter_refuses_is_held(void)
{
    keel_pid_t before;

    make(1.0f, 10.0f, 0.5f, 1.0f);
    step_to(2.1f, 1.0f, 0.0f);
    pid.filter.s1 = KEEL_FILTER_LOW_STATE_LIMIT; /* See FLT_005_energy_stays_below_its_limit. */
    pid.filter.s2 = 0.0f;
    memcpy(&before, &pid, sizeof before);
    TEST_ASSERT_EQUAL(KEEL_ERR_INPUT, keel_pid_step(&pid, 5.0e5f, -5.0e5f));
    TEST_ASSERT_EQUAL_MEMORY(&before, &pid, sizeof pid);
}

static void PID_007_the_greatest_inputs_are_taken(void)
{
    make(KEEL_PID_GAIN_LIMIT, KEEL_PID_GAIN_LIMIT, KEEL_PID_GAIN_LIMIT, KEEL_PID_GAIN_LIMIT);
    step_to(100.0f, 5.0e5f, -5.0e5f);
    step_to(-50.0f, -5.0e5f, 5.0e5f);
}

static void PID_008_terms_of_eq_4(void)
{
    make(2.0f, 0.0f, 0.0f, 0.0f);
    step_to(-6.0f, 1.0f, 4.0f);
    make(0.0f, 50.0f, 0.0f, 0.0f);
    step_to(1.0f, 2.0f, 0.0f);
    step_to(0.5f, 0.0f, 1.0f);
    make(0.0f, 0.0f, 0.0f, 3.0f);
    step_to(6.0f, 2.0f, 9.0f);
    make(0.0f, 0.0f, 0.5f, 0.0f);
    step_to(0.0f, 0.0f, 0.0f);
    step_to(14.644661f, 1.0f, 0.0f);
    step_to(29.289322f, 1.0f, 0.0f);
}

static void PID_009_no_kick_at_the_first_step(void)
{
    make(0.0f, 0.0f, 10.0f, 0.0f);
    step_to(0.0f, 3.0f, 0.0f);
    TEST_ASSERT_TRUE(pid.started);
    step_to(0.0f, 3.0f, 0.0f);
    keel_pid_reset(&pid);
    step_to(0.0f, -3.0f, 0.0f);
    step_to(0.0f, -3.0f, 0.0f);
}

static void PID_010_no_wind_up_above(void)
{
    config.integral_max = 1000.0f;
    make(1.0f, 1000.0f, 0.0f, 0.0f);
    step_to(99.0f, 9.0f, 0.0f); /* 9 + 90 */
    TEST_ASSERT_EQUAL(KEEL_PID_FREE, pid.saturation);
    step_to(100.0f, 11.0f, 0.0f); /* 11 + 90 already is beyond 100: the integral stays. */
    TEST_ASSERT_EQUAL(KEEL_PID_AT_MAX, pid.saturation);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 90.0f, pid.integral);
    step_to(79.0f, -1.0f, 0.0f); /* -1 + 90 - 10: at once. */
}

static void PID_010_may_leave_a_limit(void)
{
    config.integral_max = 1000.0f;
    make(0.0f, 1000.0f, 0.0f, 100.0f);
    step_to(90.0f, 0.0f, -9.0f);
    step_to(100.0f, 1.0f, 2.0f); /* 100 + 80: beyond the limit, the integral falls. */
    TEST_ASSERT_EQUAL(KEEL_PID_AT_MAX, pid.saturation);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 80.0f, pid.integral);
}

static void PID_010_no_wind_up_below(void)
{
    config.integral_min = -1000.0f;
    make(1.0f, 1000.0f, 0.0f, 100.0f);
    step_to(-44.0f, 0.0f, 4.0f); /* -4 - 40 */
    TEST_ASSERT_EQUAL(KEEL_PID_FREE, pid.saturation);
    step_to(-50.0f, 0.0f, 11.0f); /* -11 - 40 already is beyond -50. */
    TEST_ASSERT_EQUAL(KEEL_PID_AT_MIN, pid.saturation);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, -40.0f, pid.integral);
    step_to(-50.0f, -1.0f, -2.0f); /* 1 - 100 - 30: beyond the limit, the integral rises. */
    TEST_ASSERT_EQUAL(KEEL_PID_AT_MIN, pid.saturation);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, -30.0f, pid.integral);
    step_to(-29.0f + 10.0f, 0.0f, -1.0f); /* 1 - 30 + 10 */
}

/* Without what the integral would add, the output stays short of its limit, and is free. */
static void PID_010_an_integral_that_stays_may_free_the_output(void)
{
    make(1.0f, 10.0f, 0.0f, 0.0f);
    step_to(-47.0f, -47.0f, 0.0f); /* -47 - 4.7 would be beyond -50. */
    TEST_ASSERT_EQUAL(KEEL_PID_FREE, pid.saturation);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, pid.integral);
}

/* --- PID-011: kp 2, ki T 0.1, kff 0.5; the integral from -20 to 30 ---------------------------- */

static void enter(float setpoint, float measurement, float output)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pid_enter(&pid, setpoint, measurement, output));
}

static void PID_011_the_first_output_is_the_one_to_begin_at(void)
{
    make(2.0f, 10.0f, 3.0f, 0.5f);
    step_to(24.0f + 6.0f + 1.2f, 12.0f, 0.0f);
    step_to(-50.0f, 12.0f, 12.0f);
    enter(4.0f, 1.0f, 15.0f);
    TEST_ASSERT_EQUAL_FLOAT(15.0f, pid.output);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 15.0f - 6.0f - 2.0f - 0.3f, pid.integral);
    TEST_ASSERT_TRUE(!pid.started && (pid.saturation == KEEL_PID_FREE));
    TEST_ASSERT_TRUE((pid.setpoint == 0.0f) && (pid.error == 0.0f) && (pid.derivative == 0.0f));
    step_to(15.0f, 4.0f, 1.0f);
    step_to(15.3f, 4.0f, 1.0f);
}

static void PID_011_as_far_as_the_integral_goes(void)
{
    make(2.0f, 10.0f, 0.0f, 0.0f);
    enter(0.0f, 0.0f, 90.0f);
    TEST_ASSERT_EQUAL_FLOAT(30.0f, pid.integral);
    TEST_ASSERT_EQUAL_FLOAT(90.0f, pid.output);
    step_to(30.0f, 0.0f, 0.0f);
    enter(0.0f, 0.0f, -40.0f);
    TEST_ASSERT_EQUAL_FLOAT(-20.0f, pid.integral);
}

static void PID_011_within_the_limits_of_the_output(void)
{
    make(2.0f, 10.0f, 0.0f, 0.0f);
    enter(50.0f, 0.0f, 1000.0f);
    TEST_ASSERT_EQUAL_FLOAT(100.0f, pid.output);
    TEST_ASSERT_EQUAL_FLOAT(-5.0f, pid.integral);
    enter(-20.0f, 0.0f, -1.0e9f);
    TEST_ASSERT_EQUAL_FLOAT(-50.0f, pid.output);
    TEST_ASSERT_EQUAL_FLOAT(-8.0f, pid.integral);
}

/* Nothing would take the share of the integral away again. */
static void PID_011_without_ki_the_integral_is_0(void)
{
    make(2.0f, 0.0f, 0.0f, 0.0f);
    enter(1.0f, 0.0f, 10.0f);
    TEST_ASSERT_EQUAL_FLOAT(10.0f, pid.output);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, pid.integral);
    step_to(2.0f, 1.0f, 0.0f);
}

static void enter_refuses(float setpoint, float measurement, float output)
{
    keel_pid_t before;

    memcpy(&before, &pid, sizeof before);
    TEST_ASSERT_EQUAL(KEEL_ERR_INPUT, keel_pid_enter(&pid, setpoint, measurement, output));
    TEST_ASSERT_EQUAL_MEMORY(&before, &pid, sizeof pid);
}

static void PID_011_bad_inputs_change_nothing(void)
{
    const float bad[] = {500001.0f, -500001.0f, INFINITY, NAN};

    make(2.0f, 10.0f, 0.0f, 0.0f);
    step_to(2.1f, 1.0f, 0.0f);
    for (size_t i = 0u; i < (sizeof bad / sizeof bad[0]); i++) {
        enter_refuses(bad[i], 0.0f, 0.0f);
        enter_refuses(0.0f, bad[i], 0.0f);
    }
    enter_refuses(0.0f, 0.0f, 1.1e9f);
    enter_refuses(0.0f, 0.0f, -1.1e9f);
    enter_refuses(0.0f, 0.0f, NAN);
}

/* --- PID-012 ---------------------------------------------------------------------------------- */

static void within(float output, float integral, float setpoint, bool rises, bool falls)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_pid_step_within(&pid, setpoint, 0.0f, rises, falls));
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, output, pid.output);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, integral, pid.integral);
}

static void PID_012_the_integral_moves_where_it_may(void)
{
    make(2.0f, 100.0f, 0.0f, 0.0f);
    within(3.0f, 1.0f, 1.0f, true, true);
    within(4.0f, 1.0f, 1.0f, false, true);
    within(4.0f, 2.0f, 1.0f, true, false);
    within(-1.0f, 1.0f, -1.0f, false, true);
    within(-2.0f, 1.0f, -1.0f, true, false);
    within(-2.0f, 1.0f, -1.0f, false, false);
    within(4.0f, 1.0f, 1.0f, false, false);
}

static void PID_012_bad_inputs_are_held(void)
{
    keel_pid_t before;

    make(2.0f, 100.0f, 0.0f, 0.0f);
    within(3.0f, 1.0f, 1.0f, true, true);
    memcpy(&before, &pid, sizeof before);
    TEST_ASSERT_EQUAL(KEEL_ERR_INPUT, keel_pid_step_within(&pid, NAN, 0.0f, false, false));
    TEST_ASSERT_EQUAL(KEEL_ERR_INPUT, keel_pid_step_within(&pid, 0.0f, 6.0e5f, true, true));
    TEST_ASSERT_EQUAL_MEMORY(&before, &pid, sizeof pid);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(PID_001_bad_gains_are_refused);
    RUN_TEST(PID_001_bad_limits_are_refused);
    RUN_TEST(PID_001_what_the_filter_refuses_is_refused);
    RUN_TEST(PID_002_made_as_configured);
    RUN_TEST(PID_003_reset_forgets);
    RUN_TEST(PID_003_output_is_the_limit_next_to_0);
    RUN_TEST(PID_004_bad_gains_change_nothing);
    RUN_TEST(PID_005_new_gains_without_a_bump);
    RUN_TEST(PID_005_new_ki_acts_on_what_comes);
    RUN_TEST(PID_005_takes_over_up_to_its_limits);
    RUN_TEST(PID_006_integral_stays_within_its_limits);
    RUN_TEST(PID_007_bad_inputs_are_held);
    RUN_TEST(PID_007_what_the_filter_refuses_is_held);
    RUN_TEST(PID_007_the_greatest_inputs_are_taken);
    RUN_TEST(PID_008_terms_of_eq_4);
    RUN_TEST(PID_009_no_kick_at_the_first_step);
    RUN_TEST(PID_010_no_wind_up_above);
    RUN_TEST(PID_010_may_leave_a_limit);
    RUN_TEST(PID_010_no_wind_up_below);
    RUN_TEST(PID_010_an_integral_that_stays_may_free_the_output);
    RUN_TEST(PID_011_the_first_output_is_the_one_to_begin_at);
    RUN_TEST(PID_011_as_far_as_the_integral_goes);
    RUN_TEST(PID_011_within_the_limits_of_the_output);
    RUN_TEST(PID_011_without_ki_the_integral_is_0);
    RUN_TEST(PID_011_bad_inputs_change_nothing);
    RUN_TEST(PID_012_the_integral_moves_where_it_may);
    RUN_TEST(PID_012_bad_inputs_are_held);
    return UNITY_END();
}
