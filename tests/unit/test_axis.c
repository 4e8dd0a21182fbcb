/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/flight/axis.h. Expected values are worked out by hand from the formulas of
 * axis.h, or in double precision. */
#include "keel/flight/axis.h"
#include "unity.h"

#include <math.h>
#include <string.h>

static keel_axis_config_t config;
static keel_axis_t axis;
static keel_axis_sample_t sample;

void setUp(void)
{
    const keel_axis_config_t usual = {.rate_hz = 100.0f,
                                      .position_gain = 0.25f,
                                      .velocity_gain = 0.5f,
                                      .rate_gain = 0.125f,
                                      .bias_gain = 0.0625f,
                                      .bias_limit = 1.0f,
                                      .position_gate = 8.0f,
                                      .velocity_gate = 4.0f,
                                      .late_steps = 4u,
                                      .lost_steps = 10u,
                                      .settle_fixes = 3u,
                                      .jump_fixes = 3u};
    const keel_axis_sample_t still = {.has_acceleration = true, .is_usable = true};

    config = usual;
    sample = still;
    memset(&axis, 0x55, sizeof axis);
}

void tearDown(void)
{
}

static void make(void)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_axis_init(&axis, &config));
}

static void fix(float position, float velocity)
{
    sample.has_fix = true;
    sample.has_velocity = true;
    sample.position = position;
    sample.velocity = velocity;
    keel_axis_step(&axis, &sample);
    sample.has_fix = false;
    sample.has_velocity = false;
}

static void steps(unsigned count)
{
    for (unsigned i = 0u; i < count; i++) {
        keel_axis_step(&axis, &sample);
    }
}

/* An axis that is known well, at rest at 0. */
static void settle(void)
{
    make();
    for (unsigned i = 0u; i < 4u; i++) {
        fix(0.0f, 0.0f);
    }
    TEST_ASSERT_EQUAL(KEEL_AXIS_GOOD, axis.quality);
}

static void init_refuses(keel_status_t status)
{
    keel_axis_t before;

    memcpy(&before, &axis, sizeof before);
    TEST_ASSERT_EQUAL(status, keel_axis_init(&axis, &config));
    TEST_ASSERT_EQUAL_MEMORY(&before, &axis, sizeof axis);
}

/* A number is taken from least to most, and nothing else is. */
static void has_range(float *value, float least, float most, keel_status_t status)
{
    const float good = *value;
    const float bad[] = {nextafterf(least, -INFINITY), nextafterf(most, INFINITY), NAN, INFINITY,
                         -INFINITY};

    for (size_t i = 0u; i < (sizeof bad / sizeof bad[0]); i++) {
        *value = bad[i];
        init_refuses(status);
    }
    *value = least;
    make();
    *value = most;
    make();
    *value = good;
    memset(&axis, 0x55, sizeof axis);
}

static void AXI_001_bad_rates_are_refused(void)
{
    has_range(&config.rate_hz, 10.0f, 1000.0f, KEEL_ERR_RATE);
}

static void AXI_001_bad_gains_are_refused(void)
{
    has_range(&config.position_gain, 0.0f, 1.0f, KEEL_ERR_GAIN);
    has_range(&config.velocity_gain, 0.0f, 16.0f, KEEL_ERR_GAIN);
    has_range(&config.rate_gain, 0.0f, 1.0f, KEEL_ERR_GAIN);
    has_range(&config.bias_gain, 0.0f, 16.0f, KEEL_ERR_GAIN);
}

static void AXI_001_bad_limits_are_refused(void)
{
    has_range(&config.bias_limit, 0.0f, 8.0f, KEEL_ERR_LIMITS);
    has_range(&config.position_gate, 0.0f, 16384.0f, KEEL_ERR_LIMITS);
    has_range(&config.velocity_gate, 0.0f, 256.0f, KEEL_ERR_LIMITS);
}

static void AXI_001_numbers_that_are_0_are_refused(void)
{
    uint16_t *const numbers[] = {&config.late_steps, &config.settle_fixes, &config.jump_fixes};

    for (size_t i = 0u; i < 3u; i++) {
        const uint16_t good = *numbers[i];

        *numbers[i] = 0u;
        init_refuses(KEEL_ERR_LIMITS);
        *numbers[i] = good;
    }
}

static void AXI_001_late_is_not_after_lost(void)
{
    config.late_steps = 11u;
    init_refuses(KEEL_ERR_LIMITS);
    config.late_steps = 10u;
    make();
}

static void AXI_001_the_first_reason_is_told(void)
{
    config.late_steps = 0u;
    config.rate_gain = NAN;
    init_refuses(KEEL_ERR_GAIN);
    config.rate_hz = NAN;
    init_refuses(KEEL_ERR_RATE);
}

static void AXI_002_made_as_configured(void)
{
    make();
    TEST_ASSERT_EQUAL_MEMORY(&config, &axis.config, sizeof config);
    TEST_ASSERT_EQUAL_FLOAT(0.01f, axis.step);
    TEST_ASSERT_EQUAL_FLOAT(0.005f, axis.half_step);
}

static void nothing_is_known(void)
{
    TEST_ASSERT_EQUAL_FLOAT(0.0f, axis.position);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, axis.velocity);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, axis.bias);
    TEST_ASSERT_EQUAL_UINT16(10u, axis.age);
    TEST_ASSERT_EQUAL_UINT16(0u, axis.agreed);
    TEST_ASSERT_EQUAL_UINT16(0u, axis.jumped);
    TEST_ASSERT_EQUAL_HEX32(0u, axis.flags);
    TEST_ASSERT_EQUAL(KEEL_AXIS_NONE, axis.quality);
}

static void AXI_003_made_with_nothing_known(void)
{
    make();
    nothing_is_known();
}

static void AXI_003_a_restart_forgets(void)
{
    settle();
    sample.acceleration = 2.0f;
    fix(3.0f, 1.0f);
    fix(100.0f, 1.0f);
    keel_axis_restart(&axis);
    nothing_is_known();
}

/* From rest, 2 m/s^2 for 0.1 s: 0.2 m/s and 0.01 m. */
static void AXI_004_acceleration_is_integrated(void)
{
    settle();
    sample.acceleration = 2.0f;
    steps(9u);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.18f, axis.velocity);
    TEST_ASSERT_FLOAT_WITHIN(1e-7f, 0.0081f, axis.position);
    steps(1u);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.2f, axis.velocity);
    TEST_ASSERT_FLOAT_WITHIN(1e-7f, 0.01f, axis.position);
}

/* At rest at 0, a fix at 4 m with 2 m/s: a quarter of 4 m; 0.5 * 4 m + 2 m/s / 8; the bias loses
 * 0.0625 * 4 m. */
static void AXI_004_a_fix_is_made_up_for_in_part(void)
{
    settle();
    fix(4.0f, 2.0f);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, axis.position);
    TEST_ASSERT_EQUAL_FLOAT(2.25f, axis.velocity);
    TEST_ASSERT_EQUAL_FLOAT(-0.25f, axis.bias);
    TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_FIXED, axis.flags);
}

static void AXI_004_without_velocity_by_the_position_alone(void)
{
    settle();
    sample.has_fix = true;
    sample.position = 4.0f;
    sample.velocity = NAN;
    steps(1u);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, axis.position);
    TEST_ASSERT_EQUAL_FLOAT(2.0f, axis.velocity);
}

/* A bias of -0.25 m/s^2 is taken off: 2.25 m/s^2 for 0.01 s. */
static void AXI_004_the_bias_is_taken_off(void)
{
    settle();
    fix(4.0f, 2.0f);
    sample.acceleration = 2.0f;
    steps(1u);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 2.25f + 0.0225f, axis.velocity);
}

/* A constant bias of the accelerometer is found: gains of three poles at 0.9 per fix, 10 per
 * second, without anything else but exact fixes. */
static void AXI_004_a_constant_bias_is_found(void)
{
    config.position_gain = 0.271f;
    config.velocity_gain = 0.285f;
    config.rate_gain = 0.0f;
    config.bias_gain = 0.1f;
    config.lost_steps = 100u;
    config.late_steps = 50u;
    make();
    sample.acceleration = 0.3f;
    for (unsigned i = 0u; i < 300u; i++) {
        sample.has_fix = true;
        sample.position = 5.0f;
        steps(1u);
        sample.has_fix = false;
        steps(9u);
    }
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, 0.3f, axis.bias);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, 5.0f, axis.position);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, 0.0f, axis.velocity);
}

static void is_blind(float acceleration, bool has_acceleration, bool blind)
{
    settle();
    sample.acceleration = acceleration;
    sample.has_acceleration = has_acceleration;
    steps(1u);
    TEST_ASSERT_EQUAL_HEX32(blind ? KEEL_AXIS_BLIND : 0u, axis.flags);
    TEST_ASSERT_EQUAL(blind ? KEEL_AXIS_POOR : KEEL_AXIS_GOOD, axis.quality);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, blind ? 0.0f : (0.01f * acceleration), axis.velocity);
}

static void AXI_005_no_acceleration_is_told(void)
{
    is_blind(1.0f, false, true);
    setUp();
    is_blind(NAN, true, true);
    setUp();
    is_blind(INFINITY, true, true);
    setUp();
    is_blind(nextafterf(320.0f, INFINITY), true, true);
    setUp();
    is_blind(-nextafterf(320.0f, INFINITY), true, true);
    setUp();
    is_blind(320.0f, true, false);
    setUp();
    is_blind(-320.0f, true, false);
}

static void AXI_006_position_and_velocity_stay_in_their_limits(void)
{
    settle();
    sample.acceleration = 320.0f;
    steps(1000u);
    TEST_ASSERT_EQUAL_FLOAT(256.0f, axis.velocity);
    steps(10000u);
    TEST_ASSERT_EQUAL_FLOAT(16384.0f, axis.position);
    sample.acceleration = -320.0f;
    steps(20000u);
    TEST_ASSERT_EQUAL_FLOAT(-256.0f, axis.velocity);
    TEST_ASSERT_EQUAL_FLOAT(-16384.0f, axis.position);
}

static void AXI_006_the_bias_stays_in_its_limits(void)
{
    settle();
    for (unsigned i = 0u; i < 20u; i++) {
        fix(axis.position + 7.0f, axis.velocity);
    }
    TEST_ASSERT_EQUAL_FLOAT(-1.0f, axis.bias);
    for (unsigned i = 0u; i < 20u; i++) {
        fix(axis.position - 7.0f, axis.velocity);
    }
    TEST_ASSERT_EQUAL_FLOAT(1.0f, axis.bias);
}

/* Where a fix pulls beyond what can be, the limit is kept. */
static void AXI_006_a_fix_does_not_lead_beyond(void)
{
    config.velocity_gain = 16.0f;
    config.position_gate = 16384.0f;
    config.velocity_gate = 256.0f;
    make();
    fix(0.0f, 0.0f);
    fix(100.0f, 0.0f);
    TEST_ASSERT_EQUAL_FLOAT(256.0f, axis.velocity);
    make();
    fix(0.0f, 0.0f);
    fix(-100.0f, 0.0f);
    TEST_ASSERT_EQUAL_FLOAT(-256.0f, axis.velocity);
    config.position_gain = 1.0f;
    make();
    fix(0.0f, 0.0f);
    fix(16384.0f, 0.0f);
    TEST_ASSERT_EQUAL_FLOAT(16384.0f, axis.position);
    make();
    fix(0.0f, 0.0f);
    fix(-16384.0f, 0.0f);
    TEST_ASSERT_EQUAL_FLOAT(-16384.0f, axis.position);
}

static void AXI_006_corrupted_numbers_are_clamped(void)
{
    settle();
    axis.position = NAN;
    axis.velocity = INFINITY;
    steps(1u);
    TEST_ASSERT_EQUAL_FLOAT(-16384.0f, axis.position);
    TEST_ASSERT_EQUAL_FLOAT(256.0f, axis.velocity);
}

static void is_unusable(void)
{
    sample.has_fix = true;
    steps(1u);
    TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_UNUSABLE, axis.flags);
    TEST_ASSERT_EQUAL(KEEL_AXIS_POOR, axis.quality);
    TEST_ASSERT_EQUAL_UINT16(0u, axis.agreed);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, axis.position);
    TEST_ASSERT_EQUAL_UINT16(1u, axis.age);
}

static void AXI_007_what_its_source_does_not_trust_is_not_used(void)
{
    settle();
    sample.is_usable = false;
    sample.position = 1.0f;
    is_unusable();
}

static void AXI_007_numbers_out_of_range_are_not_used(void)
{
    const float bad[] = {NAN, INFINITY, -INFINITY, 16385.0f, -16385.0f};

    for (size_t i = 0u; i < (sizeof bad / sizeof bad[0]); i++) {
        setUp();
        settle();
        sample.position = bad[i];
        is_unusable();
        setUp();
        settle();
        sample.has_velocity = true;
        sample.velocity = bad[i];
        is_unusable();
    }
}

/* Its source's word says nothing when there is no fix. */
static void AXI_007_no_fix_is_none_that_is_unusable(void)
{
    settle();
    sample.is_usable = false;
    steps(1u);
    TEST_ASSERT_EQUAL_HEX32(0u, axis.flags);
    TEST_ASSERT_EQUAL(KEEL_AXIS_GOOD, axis.quality);
}

static void jumps(float position, float velocity, bool jumped)
{
    settle();
    fix(position, velocity);
    TEST_ASSERT_EQUAL_HEX32(jumped ? KEEL_AXIS_JUMPED : KEEL_AXIS_FIXED, axis.flags);
    TEST_ASSERT_EQUAL(jumped ? KEEL_AXIS_POOR : KEEL_AXIS_GOOD, axis.quality);
    TEST_ASSERT_EQUAL_UINT16(jumped ? 1u : 0u, axis.jumped);
    TEST_ASSERT_EQUAL_UINT16(jumped ? 1u : 0u, axis.age);
    if (jumped) {
        TEST_ASSERT_EQUAL_FLOAT(0.0f, axis.position);
        TEST_ASSERT_EQUAL_FLOAT(0.0f, axis.velocity);
        TEST_ASSERT_EQUAL_FLOAT(0.0f, axis.bias);
    }
}

static void AXI_008_beyond_the_gates_it_is_a_jump(void)
{
    jumps(8.0f, 0.0f, false);
    setUp();
    jumps(-8.0f, 0.0f, false);
    setUp();
    jumps(8.001f, 0.0f, true);
    setUp();
    jumps(-8.001f, 0.0f, true);
    setUp();
    jumps(0.0f, 4.0f, false);
    setUp();
    jumps(0.0f, -4.0f, false);
    setUp();
    jumps(0.0f, 4.001f, true);
    setUp();
    jumps(0.0f, -4.001f, true);
}

static void AXI_009_the_first_fix_is_believed(void)
{
    make();
    sample.acceleration = 1.0f;
    steps(3u);
    fix(1000.0f, -20.0f);
    TEST_ASSERT_EQUAL_FLOAT(1000.0f, axis.position);
    TEST_ASSERT_EQUAL_FLOAT(-20.0f, axis.velocity);
    TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_FIXED | KEEL_AXIS_BEGUN, axis.flags);
    TEST_ASSERT_EQUAL(KEEL_AXIS_POOR, axis.quality);
    TEST_ASSERT_EQUAL_UINT16(0u, axis.agreed);
}

static void AXI_009_without_velocity_it_begins_at_rest(void)
{
    settle();
    sample.acceleration = 100.0f;
    steps(10u);
    sample.has_fix = true;
    sample.position = 50.0f;
    sample.velocity = 3.0f;
    steps(1u);
    TEST_ASSERT_EQUAL_FLOAT(50.0f, axis.position);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, axis.velocity);
}

static void AXI_009_the_last_of_some_jumps_is_believed(void)
{
    settle();
    fix(100.0f, 0.0f);
    fix(108.0f, 1.0f);
    TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_JUMPED | KEEL_AXIS_AGAIN, axis.flags);
    TEST_ASSERT_EQUAL_UINT16(2u, axis.jumped);
    fix(116.0f, 2.0f);
    TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_FIXED | KEEL_AXIS_BEGUN | KEEL_AXIS_AGAIN, axis.flags);
    TEST_ASSERT_EQUAL_FLOAT(116.0f, axis.position);
    TEST_ASSERT_EQUAL_FLOAT(2.0f, axis.velocity);
    TEST_ASSERT_EQUAL_UINT16(0u, axis.jumped);
    TEST_ASSERT_EQUAL(KEEL_AXIS_POOR, axis.quality);
}

static void AXI_009_a_jump_without_velocity_is_believed_at_rest(void)
{
    settle();
    sample.acceleration = 100.0f;
    steps(1u);
    for (unsigned i = 0u; i < 3u; i++) {
        sample.has_fix = true;
        sample.position = 100.0f;
        sample.velocity = 3.0f;
        steps(1u);
    }
    TEST_ASSERT_EQUAL_FLOAT(100.0f, axis.position);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, axis.velocity);
}

static void AXI_009_jumps_count_in_a_row(void)
{
    settle();
    fix(100.0f, 0.0f);
    fix(100.0f, 0.0f);
    fix(0.0f, 0.0f);
    TEST_ASSERT_EQUAL_UINT16(0u, axis.jumped);
    fix(100.0f, 0.0f);
    fix(100.0f, 0.0f);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, axis.position);
}

/* A gate is 8 m wide to either side; each of these is farther from the one before. */
static void AXI_009_jumps_here_and_there_are_never_believed(void)
{
    settle();
    for (unsigned i = 0u; i < 30u; i++) {
        fix(((i % 2u) == 0u) ? 100.0f : 108.5f, 0.0f);
        TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_JUMPED, axis.flags & ~KEEL_AXIS_BLIND);
        TEST_ASSERT_EQUAL_UINT16(1u, axis.jumped);
        axis.age = 1u; /* It is not lost meanwhile. */
    }
    TEST_ASSERT_FLOAT_WITHIN(1.0f, 0.0f, axis.position);
}

static void AXI_013_the_last_jump_is_kept(void)
{
    settle();
    fix(100.0f, 0.0f);
    TEST_ASSERT_EQUAL_FLOAT(100.0f, axis.jump);
    fix(0.0f, 0.0f);
    TEST_ASSERT_EQUAL_FLOAT(100.0f, axis.jump);
    fix(101.0f, 0.0f);
    TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_JUMPED, axis.flags);
    TEST_ASSERT_EQUAL_UINT16(1u, axis.jumped);
    TEST_ASSERT_EQUAL_FLOAT(101.0f, axis.jump);
}

static void AXI_009_what_is_unusable_is_no_jump(void)
{
    settle();
    fix(100.0f, 0.0f);
    fix(NAN, 0.0f);
    TEST_ASSERT_EQUAL_UINT16(1u, axis.jumped);
}

static void AXI_010_the_age_counts_steps(void)
{
    settle();
    TEST_ASSERT_EQUAL_UINT16(0u, axis.age);
    steps(3u);
    TEST_ASSERT_EQUAL_UINT16(3u, axis.age);
    fix(0.0f, 0.0f);
    TEST_ASSERT_EQUAL_UINT16(0u, axis.age);
    steps(50u);
    TEST_ASSERT_EQUAL_UINT16(10u, axis.age);
}

static void AXI_011_a_jump_lowers_the_quality_until_fixes_agree_again(void)
{
    settle();
    fix(100.0f, 0.0f);
    TEST_ASSERT_EQUAL(KEEL_AXIS_POOR, axis.quality);
    steps(1u);
    TEST_ASSERT_EQUAL(KEEL_AXIS_POOR, axis.quality);
    fix(0.0f, 0.0f);
    fix(0.0f, 0.0f);
    TEST_ASSERT_EQUAL(KEEL_AXIS_POOR, axis.quality);
    fix(0.0f, 0.0f);
    TEST_ASSERT_EQUAL(KEEL_AXIS_GOOD, axis.quality);
    fix(0.0f, 0.0f);
    TEST_ASSERT_EQUAL_UINT16(3u, axis.agreed);
}

static void AXI_012_late_is_poor_and_lost_is_none(void)
{
    settle();
    steps(3u);
    TEST_ASSERT_EQUAL(KEEL_AXIS_GOOD, axis.quality);
    steps(1u);
    TEST_ASSERT_EQUAL(KEEL_AXIS_POOR, axis.quality);
    steps(5u);
    TEST_ASSERT_EQUAL(KEEL_AXIS_POOR, axis.quality);
    steps(1u);
    TEST_ASSERT_EQUAL(KEEL_AXIS_NONE, axis.quality);
}

/* The step in which fixes come to be lost begins anew, too. */
static void AXI_012_after_a_loss_the_next_fix_begins_anew(void)
{
    settle();
    steps(9u);
    fix(500.0f, 0.0f);
    TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_FIXED | KEEL_AXIS_BEGUN, axis.flags);
    TEST_ASSERT_EQUAL_FLOAT(500.0f, axis.position);
    setUp();
    settle();
    steps(8u);
    fix(500.0f, 0.0f);
    TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_JUMPED, axis.flags);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(AXI_001_bad_rates_are_refused);
    RUN_TEST(AXI_001_bad_gains_are_refused);
    RUN_TEST(AXI_001_bad_limits_are_refused);
    RUN_TEST(AXI_001_numbers_that_are_0_are_refused);
    RUN_TEST(AXI_001_late_is_not_after_lost);
    RUN_TEST(AXI_001_the_first_reason_is_told);
    RUN_TEST(AXI_002_made_as_configured);
    RUN_TEST(AXI_003_made_with_nothing_known);
    RUN_TEST(AXI_003_a_restart_forgets);
    RUN_TEST(AXI_004_acceleration_is_integrated);
    RUN_TEST(AXI_004_a_fix_is_made_up_for_in_part);
    RUN_TEST(AXI_004_without_velocity_by_the_position_alone);
    RUN_TEST(AXI_004_the_bias_is_taken_off);
    RUN_TEST(AXI_004_a_constant_bias_is_found);
    RUN_TEST(AXI_005_no_acceleration_is_told);
    RUN_TEST(AXI_006_position_and_velocity_stay_in_their_limits);
    RUN_TEST(AXI_006_the_bias_stays_in_its_limits);
    RUN_TEST(AXI_006_a_fix_does_not_lead_beyond);
    RUN_TEST(AXI_006_corrupted_numbers_are_clamped);
    RUN_TEST(AXI_007_what_its_source_does_not_trust_is_not_used);
    RUN_TEST(AXI_007_numbers_out_of_range_are_not_used);
    RUN_TEST(AXI_007_no_fix_is_none_that_is_unusable);
    RUN_TEST(AXI_008_beyond_the_gates_it_is_a_jump);
    RUN_TEST(AXI_009_the_first_fix_is_believed);
    RUN_TEST(AXI_009_without_velocity_it_begins_at_rest);
    RUN_TEST(AXI_009_the_last_of_some_jumps_is_believed);
    RUN_TEST(AXI_009_a_jump_without_velocity_is_believed_at_rest);
    RUN_TEST(AXI_009_jumps_count_in_a_row);
    RUN_TEST(AXI_009_jumps_here_and_there_are_never_believed);
    RUN_TEST(AXI_009_what_is_unusable_is_no_jump);
    RUN_TEST(AXI_013_the_last_jump_is_kept);
    RUN_TEST(AXI_010_the_age_counts_steps);
    RUN_TEST(AXI_011_a_jump_lowers_the_quality_until_fixes_agree_again);
    RUN_TEST(AXI_012_late_is_poor_and_lost_is_none);
    RUN_TEST(AXI_012_after_a_loss_the_next_fix_begins_anew);
    return UNITY_END();
}
