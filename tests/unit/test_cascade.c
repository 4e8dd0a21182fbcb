/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/flight/cascade.h. Expected values are worked out by hand, from the gains and
 * reaches of cascades.h: an axis that enters at u, at an error e, puts out u in its first step, and
 * in the next, at the error f, u + kp (f - e) + f / 4, as ki T is 1/4. */
#include "cascades.h"

static const keel_cascade_rates_t no_rates;
static const keel_attitude_vector_t still;
static const keel_cascade_vector_t nowhere;
static keel_cascade_estimate_t estimate;

void setUp(void)
{
    configure();
    memset(&cascade, 0, sizeof cascade);
    memset(&estimate, 0, sizeof estimate);
    estimate.forward_north = 1.0f;
    estimate.has_place = true;
    estimate.has_height = true;
}

void tearDown(void)
{
}

static void make(void)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_cascade_init(&cascade, &config));
}

static void fly(uint8_t mode)
{
    make();
    keel_cascade_enter(&cascade, mode);
}

static const keel_cascade_axis_t *axis_of(uint32_t axis)
{
    return &cascade.axis[axis];
}

static float integral_of(uint32_t axis)
{
    return cascade.axis[axis].pid.integral;
}

/* --- CAS-001, CAS-002 ------------------------------------------------------------------------- */

static void refused(uint32_t axis, keel_status_t status)
{
    keel_cascade_t before;

    memset(&cascade, 0x55, sizeof cascade);
    memcpy(&before, &cascade, sizeof before);
    TEST_ASSERT_EQUAL(status, keel_cascade_check(&config, axis));
    TEST_ASSERT_EQUAL(status, keel_cascade_init(&cascade, &config));
    TEST_ASSERT_EQUAL_MEMORY(&before, &cascade, sizeof before);
}

/* A number of the configuration, beyond each of its ends; at its ends it is taken. */
static void has_range(float *value, float least, float most, uint32_t axis)
{
    const float good = *value;
    const float bad[] = {nextafterf(least, -INFINITY), nextafterf(most, INFINITY), NAN, INFINITY,
                         -INFINITY};

    for (size_t i = 0u; i < (sizeof bad / sizeof bad[0]); i++) {
        *value = bad[i];
        refused(axis, KEEL_ERR_LIMITS);
    }
    *value = least;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_cascade_check(&config, axis));
    *value = most;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_cascade_check(&config, axis));
    *value = good;
}

static void CAS_001_the_reach_of_each_axis(void)
{
    static const float most[AXES] = {64.0f,  64.0f,  64.0f,    0.75f,    0.75f,   100.0f,
                                     100.0f, 100.0f, 16384.0f, 16384.0f, 16384.0f};

    for (uint32_t i = 0u; i < AXES; i++) {
        const float good = config.reach[i];

        config.reach[i] = -0x1p-149f;
        TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_cascade_check(&config, i));
        config.reach[i] = nextafterf(most[i], INFINITY);
        TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_cascade_check(&config, i));
        config.reach[i] = NAN;
        TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_cascade_check(&config, i));
        config.reach[i] = most[i];
        TEST_ASSERT_EQUAL(KEEL_OK, keel_cascade_check(&config, i));
        config.reach[i] = good;
        TEST_ASSERT_EQUAL(KEEL_OK, keel_cascade_check(&config, i));
    }
    config.reach[KEEL_CASCADE_HEIGHT] = -1.0f;
    refused(KEEL_CASCADE_HEIGHT, KEEL_ERR_LIMITS);
    TEST_ASSERT_EQUAL(KEEL_ERR_INPUT, keel_cascade_check(&config, AXES));
}

/* What is below each axis takes its output. The accelerations are bounded by 3.466796875 m/s^2,
 * from the lesser reach of roll and pitch, 0.5. */
static void CAS_001_outputs_are_within_what_takes_them(void)
{
    static const float most[AXES] = {1.0f,         1.0f,   1.0f, 6.0f, 5.0f, 3.466796875f,
                                     3.466796875f, 0.625f, 8.0f, 7.0f, 4.0f};

    for (uint32_t i = 0u; i < AXES; i++) {
        const keel_pid_config_t good = config.pid[i];
        const float least = (i == KEEL_CASCADE_CLIMB) ? -0.375f : -most[i];

        config.pid[i].output_max = most[i];
        config.pid[i].output_min = least;
        TEST_ASSERT_EQUAL(KEEL_OK, keel_cascade_check(&config, i));
        config.pid[i].output_max = nextafterf(most[i], INFINITY);
        refused(i, KEEL_ERR_LIMITS);
        config.pid[i].output_max = most[i];
        config.pid[i].output_min = nextafterf(least, -INFINITY);
        refused(i, KEEL_ERR_LIMITS);
        config.pid[i] = good;
    }
}

static void CAS_001_either_tilt_limits_the_accelerations(void)
{
    config.reach[KEEL_CASCADE_ROLL] = 0.75f;
    config.reach[KEEL_CASCADE_PITCH] = 0.5f;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_cascade_check(&config, KEEL_CASCADE_NORTH_SPEED));
    config.reach[KEEL_CASCADE_PITCH] = 0.25f;
    refused(KEEL_CASCADE_NORTH_SPEED, KEEL_ERR_LIMITS);
}

/* From none, which leaves no acceleration to brake with, to the greatest: 0.75 of 6.93359375. */
static void CAS_001_the_ends_of_the_tilt_limit_the_accelerations(void)
{
    config.acceleration = 6.0f;
    config.reach[KEEL_CASCADE_ROLL] = 0.75f;
    config.pid[KEEL_CASCADE_NORTH_SPEED].output_max = 5.2001953125f;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_cascade_check(&config, KEEL_CASCADE_NORTH_SPEED));
    config.pid[KEEL_CASCADE_NORTH_SPEED].output_max = nextafterf(5.2001953125f, INFINITY);
    refused(KEEL_CASCADE_NORTH_SPEED, KEEL_ERR_LIMITS);
    configure();
    config.reach[KEEL_CASCADE_ROLL] = 0.0f;
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_cascade_check(&config, KEEL_CASCADE_NORTH_SPEED));
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_cascade_check(&config, KEEL_CASCADE_EAST_SPEED));
}

static void CAS_001_accelerations_brake_and_are_counted_on(void)
{
    config.braking = 3.0f;
    config.acceleration = 3.25f;
    make();
    for (uint32_t i = KEEL_CASCADE_NORTH_SPEED; i <= KEEL_CASCADE_EAST_SPEED; i++) {
        has_range(&config.pid[i].output_max, 3.0f, 3.25f, i);
        has_range(&config.pid[i].output_min, -3.25f, -3.0f, i);
    }
}

static void CAS_001_the_other_numbers(void)
{
    config.pid[KEEL_CASCADE_CLIMB].output_min = -0.0f;
    config.pid[KEEL_CASCADE_CLIMB].output_max = 0x1p-149f;
    config.hover = 1.0f;
    refused(KEEL_CASCADE_CLIMB, KEEL_ERR_LIMITS);
    config.hover = 0.0f;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_cascade_check(&config, KEEL_CASCADE_CLIMB));
    has_range(&config.hover, 0.0f, 1.0f, KEEL_CASCADE_ROLL_RATE);
    has_range(&config.acceleration, 0.25f, 64.0f, KEEL_CASCADE_ROLL_RATE);
    has_range(&config.braking, 0.25f, 64.0f, KEEL_CASCADE_ROLL_RATE);
    has_range(&config.reaction_s, 0.0f, 4.0f, KEEL_CASCADE_ROLL_RATE);
}

static void CAS_001_a_period_is_within_the_reaction_time(void)
{
    for (uint32_t i = KEEL_CASCADE_NORTH_SPEED; i <= KEEL_CASCADE_CLIMB; i++) {
        has_range(&config.reaction_s, 0.0078125f, 4.0f, i);
    }
    config.reaction_s = 0.0f;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_cascade_check(&config, KEEL_CASCADE_PITCH));
    TEST_ASSERT_EQUAL(KEEL_OK, keel_cascade_check(&config, KEEL_CASCADE_NORTH));
}

static void CAS_001_what_a_controller_refuses(void)
{
    for (uint32_t i = 0u; i < AXES; i++) {
        const keel_pid_config_t good = config.pid[i];

        config.pid[i].gains.kp = -1.0f;
        refused(i, KEEL_ERR_GAIN);
        config.pid[i] = good;
        config.pid[i].cutoff_hz = 0.0f;
        refused(i, KEEL_ERR_CUTOFF);
        config.pid[i] = good;
    }
    config.pid[KEEL_CASCADE_HEIGHT].rate_hz = NAN;
    refused(KEEL_CASCADE_HEIGHT, KEEL_ERR_RATE);
    config.pid[KEEL_CASCADE_ROLL].gains.ki = NAN;
    refused(KEEL_CASCADE_ROLL, KEEL_ERR_GAIN);
}

static void CAS_002_made_at_rest(void)
{
    memset(&cascade, 0x55, sizeof cascade);
    make();
    for (uint32_t i = 0u; i < AXES; i++) {
        TEST_ASSERT_FALSE(axis_of(i)->running || axis_of(i)->held);
        TEST_ASSERT_FALSE(axis_of(i)->limit.at_min || axis_of(i)->limit.at_max);
        TEST_ASSERT_EQUAL_FLOAT(config.reach[i], axis_of(i)->reach);
        TEST_ASSERT_EQUAL_MEMORY(&config.pid[i], &axis_of(i)->pid.config, sizeof config.pid[i]);
    }
    TEST_ASSERT_EQUAL_FLOAT(1.0f, cascade.fence.gain);
    TEST_ASSERT_EQUAL_FLOAT(0.5f, cascade.fence.half_gain);
    TEST_ASSERT_EQUAL_FLOAT(0.25f, cascade.fence.reaction_s);
    TEST_ASSERT_EQUAL_FLOAT(5.0f, cascade.fence.twice_braking);
    TEST_ASSERT_EQUAL_FLOAT(0.375f, cascade.hover);
    TEST_ASSERT_EQUAL_HEX32(0u, cascade.axes);
    TEST_ASSERT_EQUAL_HEX32(0u, cascade.gave_way);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, cascade.velocity.north);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, cascade.tilt.pitch);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, cascade.thrust);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, cascade.rates.roll);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, cascade.command.yaw);
}

/* --- CAS-003 ---------------------------------------------------------------------------------- */

static void CAS_003_axes_of_each_mode(void)
{
    static const uint32_t axes[8] = {0x007u, 0x09Fu, 0x01Fu, 0x49Fu, 0x7FFu, 0x7FFu, 0u, 0u};

    for (uint32_t mode = 0u; mode < 9u; mode++) {
        make();
        for (uint32_t i = 0u; i < AXES; i++) {
            cascade.axis[i].running = i != 1u;
        }
        keel_cascade_enter(&cascade, (mode < 8u) ? (uint8_t)mode : 255u);
        TEST_ASSERT_EQUAL_HEX32((mode < 8u) ? axes[mode] : 0u, cascade.axes);
        for (uint32_t i = 0u; i < AXES; i++) {
            TEST_ASSERT_EQUAL((i != 1u) && (((cascade.axes >> i) & 1u) != 0u),
                              cascade.axis[i].running);
        }
    }
}

static void CAS_003_no_mode_commands_nothing(void)
{
    const keel_cascade_rates_t asked = {1.0f, 1.0f, 1.0f, 0.5f};
    const keel_attitude_vector_t turning = {1.0f, 2.0f, 3.0f};
    const keel_mixer_command_t nothing = {0.0f, 0.0f, 0.0f, 0.0f};

    fly(KEEL_MODE_ACRO);
    keel_cascade_rate_step(&cascade, no_rates, turning, 0u);
    keel_cascade_rate_step(&cascade, asked, still, 0u);
    TEST_ASSERT_TRUE(cascade.command.roll > 0.1f);
    TEST_ASSERT_EQUAL_FLOAT(0.5f, cascade.command.thrust);
    keel_cascade_enter(&cascade, KEEL_MODE_ANGLE);
    TEST_ASSERT_TRUE(cascade.command.roll > 0.1f);
    keel_cascade_enter(&cascade, KEEL_MODE_NONE);
    TEST_ASSERT_EQUAL_MEMORY(&nothing, &cascade.command, sizeof nothing);
    keel_cascade_rate_step(&cascade, asked, still, 0u);
    TEST_ASSERT_EQUAL_MEMORY(&nothing, &cascade.command, sizeof nothing);
}

/* --- CAS-004, CAS-005: one axis --------------------------------------------------------------- */

static keel_cascade_axis_t one;
static keel_cascade_input_t told;

static void one_axis(void)
{
    const keel_cascade_input_t input = {1.0f, 0.5f, 2.0f, {false, false}, true};

    make();
    one = cascade.axis[KEEL_CASCADE_HEIGHT];
    told = input;
}

static void CAS_004_an_axis_enters_and_steps(void)
{
    one_axis();
    keel_cascade_axis_step(&one, &told);
    TEST_ASSERT_TRUE(one.running && !one.held);
    TEST_ASSERT_EQUAL_FLOAT(2.0f, one.pid.output);
    told.measured = 0.0f;
    told.flown = 100.0f;
    keel_cascade_axis_step(&one, &told);
    TEST_ASSERT_EQUAL_FLOAT(2.75f, one.pid.output);
    TEST_ASSERT_FALSE(one.limit.at_min || one.limit.at_max);
}

static void CAS_004_a_setpoint_counts_as_the_reach(void)
{
    one_axis();
    told.setpoint = 70.0f;
    told.measured = 69.0f;
    keel_cascade_axis_step(&one, &told);
    TEST_ASSERT_EQUAL_FLOAT(70.0f, one.pid.setpoint);
    TEST_ASSERT_FALSE(one.limit.at_min || one.limit.at_max);
    told.setpoint = 71.0f;
    keel_cascade_axis_step(&one, &told);
    TEST_ASSERT_EQUAL_FLOAT(70.0f, one.pid.setpoint);
    TEST_ASSERT_EQUAL_FLOAT(2.25f, one.pid.output);
    TEST_ASSERT_TRUE(one.limit.at_max && !one.limit.at_min);
    told.setpoint = -70.5f;
    told.measured = -70.0f;
    keel_cascade_axis_step(&one, &told);
    TEST_ASSERT_EQUAL_FLOAT(-70.0f, one.pid.setpoint);
    TEST_ASSERT_TRUE(one.limit.at_min && !one.limit.at_max);
}

static void CAS_004_an_output_at_its_limit_says_so(void)
{
    one_axis();
    keel_cascade_axis_step(&one, &told);
    told.measured = -9.0f;
    keel_cascade_axis_step(&one, &told);
    TEST_ASSERT_EQUAL_FLOAT(4.0f, one.pid.output);
    TEST_ASSERT_TRUE(one.limit.at_max && !one.limit.at_min);
    told.measured = 9.0f;
    keel_cascade_axis_step(&one, &told);
    TEST_ASSERT_EQUAL_FLOAT(-3.0f, one.pid.output);
    TEST_ASSERT_TRUE(one.limit.at_min && !one.limit.at_max);
}

static void is_held(float *value)
{
    const float bad[] = {NAN, INFINITY, -INFINITY, 5.1e5f, -5.1e5f};

    for (size_t i = 0u; i < (sizeof bad / sizeof bad[0]); i++) {
        keel_cascade_input_t before;
        keel_pid_t pid;
        float good;

        one_axis();
        before = told;
        good = *value;
        keel_cascade_axis_step(&one, &told);
        pid = one.pid;
        *value = bad[i];
        keel_cascade_axis_step(&one, &told);
        TEST_ASSERT_TRUE(one.running && one.held);
        TEST_ASSERT_EQUAL_MEMORY(&pid, &one.pid, sizeof pid);
        *value = good;
        keel_cascade_axis_step(&one, &before);
        TEST_ASSERT_FALSE(one.held);
        TEST_ASSERT_EQUAL_FLOAT(2.125f, one.pid.output);
    }
}

static void CAS_005_bad_numbers_are_held(void)
{
    is_held(&told.setpoint);
    is_held(&told.measured);
}

static void CAS_005_does_not_enter_with_bad_numbers(void)
{
    one_axis();
    told.measured = NAN;
    keel_cascade_axis_step(&one, &told);
    TEST_ASSERT_TRUE(!one.running && one.held);
    told.measured = 0.5f;
    told.flown = NAN;
    keel_cascade_axis_step(&one, &told);
    TEST_ASSERT_TRUE(!one.running && one.held);
    told.flown = -1.0f;
    keel_cascade_axis_step(&one, &told);
    TEST_ASSERT_TRUE(one.running && !one.held);
    TEST_ASSERT_EQUAL_FLOAT(-1.0f, one.pid.output);
}

static void CAS_005_stops_without_a_measurement(void)
{
    one_axis();
    keel_cascade_axis_step(&one, &told);
    told.valid = false;
    keel_cascade_axis_step(&one, &told);
    TEST_ASSERT_TRUE(!one.running && one.held);
    told.valid = true;
    told.flown = 3.0f;
    keel_cascade_axis_step(&one, &told);
    TEST_ASSERT_EQUAL_FLOAT(3.0f, one.pid.output);
}

/* --- CAS-006: one axis ------------------------------------------------------------------------ */

static void CAS_006_the_integral_stops_in_one_direction(void)
{
    one_axis();
    keel_cascade_axis_step(&one, &told);
    TEST_ASSERT_EQUAL_FLOAT(1.5f, one.pid.integral);
    told.below.at_max = true;
    keel_cascade_axis_step(&one, &told);
    TEST_ASSERT_EQUAL_FLOAT(1.5f, one.pid.integral);
    TEST_ASSERT_TRUE(one.limit.at_max && !one.limit.at_min);
    told.measured = 1.5f;
    keel_cascade_axis_step(&one, &told);
    TEST_ASSERT_EQUAL_FLOAT(1.375f, one.pid.integral);
    told.below.at_max = false;
    told.below.at_min = true;
    keel_cascade_axis_step(&one, &told);
    TEST_ASSERT_EQUAL_FLOAT(1.375f, one.pid.integral);
    TEST_ASSERT_TRUE(one.limit.at_min && !one.limit.at_max);
    told.measured = 0.5f;
    keel_cascade_axis_step(&one, &told);
    TEST_ASSERT_EQUAL_FLOAT(1.5f, one.pid.integral);
}

/* Both limits at once: one from below, and one of the axis itself. */
static void CAS_006_the_limit_below_and_that_of_the_axis(void)
{
    one_axis();
    keel_cascade_axis_step(&one, &told);
    told.below.at_max = true;
    told.setpoint = -70.5f;
    told.measured = -70.0f;
    keel_cascade_axis_step(&one, &told);
    TEST_ASSERT_TRUE(one.limit.at_min && one.limit.at_max);
    told.setpoint = 1.0f;
    told.measured = 9.0f;
    keel_cascade_axis_step(&one, &told);
    TEST_ASSERT_EQUAL(KEEL_PID_AT_MIN, one.pid.saturation);
    TEST_ASSERT_TRUE(one.limit.at_min && one.limit.at_max);
    told.below.at_max = false;
    told.below.at_min = true;
    told.setpoint = 71.0f;
    told.measured = 70.0f;
    keel_cascade_axis_step(&one, &told);
    TEST_ASSERT_TRUE(one.limit.at_min && one.limit.at_max);
    told.setpoint = 1.0f;
    told.measured = -9.0f;
    keel_cascade_axis_step(&one, &told);
    TEST_ASSERT_EQUAL(KEEL_PID_AT_MAX, one.pid.saturation);
    TEST_ASSERT_TRUE(one.limit.at_min && one.limit.at_max);
    told.below.at_max = true;
    told.measured = 1.0f;
    keel_cascade_axis_step(&one, &told);
    TEST_ASSERT_TRUE(one.limit.at_min && one.limit.at_max);
}

/* --- CAS-006 to CAS-008: the rate stage ------------------------------------------------------- */

static void CAS_008_torques_and_thrust(void)
{
    const keel_cascade_rates_t asked = {2.0f, 1.0f, 0.5f, 0.625f};
    const keel_attitude_vector_t rate = {1.0f, 2.0f, 0.25f};

    fly(KEEL_MODE_ACRO);
    keel_cascade_rate_step(&cascade, no_rates, still, 0u);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, cascade.command.roll);
    keel_cascade_rate_step(&cascade, asked, rate, 5u);
    TEST_ASSERT_EQUAL_FLOAT(0.375f, cascade.command.roll);
    TEST_ASSERT_EQUAL_FLOAT(-0.5f, cascade.command.pitch);
    TEST_ASSERT_EQUAL_FLOAT(0.1875f, cascade.command.yaw);
    TEST_ASSERT_EQUAL_FLOAT(0.625f, cascade.command.thrust);
    TEST_ASSERT_EQUAL_HEX32(5u, cascade.gave_way);
}

static void CAS_008_any_thrust_is_within_its_range(void)
{
    const float given[] = {-1.0f, 0.0f, 0.25f, 1.0f, 1.5f, INFINITY, -INFINITY, NAN};
    const float taken[] = {0.0f, 0.0f, 0.25f, 1.0f, 1.0f, 1.0f, 0.0f, 0.0f};

    fly(KEEL_MODE_ACRO);
    for (size_t i = 0u; i < (sizeof given / sizeof given[0]); i++) {
        const keel_cascade_rates_t asked = {0.0f, 0.0f, 0.0f, given[i]};

        keel_cascade_rate_step(&cascade, asked, still, 0u);
        TEST_ASSERT_EQUAL_FLOAT(taken[i], cascade.command.thrust);
    }
}

/* What the integrals of the rate axes are after two steps of error 1 and one of `error` with a
 * flag: those of all axes move by 1/4 of it, or not. */
static void rate_integrals(float error, uint32_t flags, bool roll, bool pitch, bool yaw)
{
    const keel_cascade_rates_t asked = {0.25f, 0.25f, 0.25f, 0.5f};
    const keel_attitude_vector_t rate = {0.25f - error, 0.25f - error, 0.25f - error};
    float before[3];

    fly(KEEL_MODE_ACRO);
    keel_cascade_rate_step(&cascade, asked, rate, 0u);
    keel_cascade_rate_step(&cascade, asked, rate, 0u);
    for (uint32_t i = 0u; i < 3u; i++) {
        before[i] = integral_of(i);
    }
    keel_cascade_rate_step(&cascade, asked, rate, flags);
    TEST_ASSERT_EQUAL_FLOAT(roll ? (before[0] + (0.25f * error)) : before[0], integral_of(0u));
    TEST_ASSERT_EQUAL_FLOAT(pitch ? (before[1] + (0.25f * error)) : before[1], integral_of(1u));
    TEST_ASSERT_EQUAL_FLOAT(yaw ? (before[2] + (0.25f * error)) : before[2], integral_of(2u));
    TEST_ASSERT_EQUAL(!roll && (error > 0.0f), axis_of(0u)->limit.at_max);
    TEST_ASSERT_EQUAL(!roll && (error < 0.0f), axis_of(0u)->limit.at_min);
    TEST_ASSERT_EQUAL(!yaw && (error > 0.0f), axis_of(2u)->limit.at_max);
    TEST_ASSERT_EQUAL(!yaw && (error < 0.0f), axis_of(2u)->limit.at_min);
}

static void CAS_006_the_mixer_stops_torques(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        const float error = 0.125f * (float)sign;

        rate_integrals(error, 0u, true, true, true);
        rate_integrals(error, KEEL_MIXER_RAISED | KEEL_MIXER_LOWERED, true, true, true);
        rate_integrals(error, KEEL_MIXER_TILT, false, false, true);
        rate_integrals(error, KEEL_MIXER_YAW, true, true, false);
        rate_integrals(error, KEEL_MIXER_YAW | KEEL_MIXER_TILT, false, false, false);
    }
}

static void CAS_006_a_torque_comes_back_from_the_limit(void)
{
    const keel_cascade_rates_t asked = {0.25f, 0.0f, 0.0f, 0.5f};
    const keel_attitude_vector_t fast = {0.5f, 0.0f, 0.0f};
    float before;

    fly(KEEL_MODE_ACRO);
    keel_cascade_rate_step(&cascade, no_rates, still, 0u);
    keel_cascade_rate_step(&cascade, asked, still, 0u);
    before = integral_of(0u);
    TEST_ASSERT_TRUE(cascade.command.roll > 0.0f);
    keel_cascade_rate_step(&cascade, asked, fast, KEEL_MIXER_TILT);
    TEST_ASSERT_EQUAL_FLOAT(before - 0.0625f, integral_of(0u));
}

static void CAS_007_torques_begin_at_the_last_command(void)
{
    const keel_cascade_rates_t asked = {2.0f, 0.0f, 0.0f, 0.5f};
    const keel_attitude_vector_t bad = {NAN, 0.0f, 0.0f};

    fly(KEEL_MODE_ACRO);
    keel_cascade_rate_step(&cascade, asked, bad, 0u);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, cascade.command.roll);
    cascade.command.roll = 0.5f;
    keel_cascade_rate_step(&cascade, asked, still, 0u);
    TEST_ASSERT_EQUAL_FLOAT(0.5f, cascade.command.roll);
}

static void CAS_005_a_bad_rate_holds_one_torque(void)
{
    const keel_cascade_rates_t asked = {0.25f, 0.25f, 0.25f, 0.5f};
    const keel_attitude_vector_t bad = {0.0f, NAN, 0.0f};
    float pitch;
    float yaw;

    fly(KEEL_MODE_ACRO);
    keel_cascade_rate_step(&cascade, no_rates, still, 0u);
    keel_cascade_rate_step(&cascade, asked, still, 0u);
    pitch = cascade.command.pitch;
    yaw = cascade.command.yaw;
    keel_cascade_rate_step(&cascade, asked, bad, 0u);
    TEST_ASSERT_EQUAL_FLOAT(pitch, cascade.command.pitch);
    TEST_ASSERT_TRUE(axis_of(1u)->held && !axis_of(0u)->held);
    TEST_ASSERT_EQUAL_FLOAT(yaw + 0.0625f, cascade.command.yaw);
}

/* --- CAS-009: the angle stage ----------------------------------------------------------------- */

static const keel_cascade_tilt_t level;
static const keel_attitude_vector_t down = {0.0f, 0.0f, 1.0f};

static void CAS_009_rates_for_tilts(void)
{
    const keel_cascade_tilt_t asked = {0.25f, -0.125f};
    const keel_attitude_vector_t tilted = {0.5f, 0.375f, 0.75f};

    fly(KEEL_MODE_ANGLE);
    keel_cascade_angle_step(&cascade, level, down, true);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, cascade.rates.roll);
    keel_cascade_angle_step(&cascade, asked, tilted, true);
    /* Errors: roll 0.25 - 0.375, pitch -0.125 - (-0.5). */
    TEST_ASSERT_EQUAL_FLOAT(-0.125f * 8.25f, cascade.rates.roll);
    TEST_ASSERT_EQUAL_FLOAT(0.375f * 6.25f, cascade.rates.pitch);
}

static void CAS_009_stops_without_an_attitude(void)
{
    const keel_cascade_tilt_t asked = {0.25f, 0.25f};

    fly(KEEL_MODE_ANGLE);
    keel_cascade_angle_step(&cascade, level, down, true);
    keel_cascade_angle_step(&cascade, asked, down, true);
    TEST_ASSERT_TRUE(cascade.rates.roll > 1.0f);
    keel_cascade_angle_step(&cascade, asked, down, false);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, cascade.rates.roll);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, cascade.rates.pitch);
    TEST_ASSERT_FALSE(axis_of(KEEL_CASCADE_ROLL)->running);
}

/* The mode does not fly it. */
static void CAS_009_not_in_acro(void)
{
    const keel_cascade_tilt_t asked = {0.25f, 0.25f};

    fly(KEEL_MODE_ACRO);
    keel_cascade_angle_step(&cascade, asked, down, true);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, cascade.rates.roll);
    TEST_ASSERT_FALSE(axis_of(KEEL_CASCADE_PITCH)->running);
}

static void CAS_006_limits_of_the_rates_stop_the_angles(void)
{
    const keel_cascade_tilt_t asked = {0.25f, 0.25f};
    float roll;
    float pitch;

    fly(KEEL_MODE_ANGLE);
    keel_cascade_angle_step(&cascade, asked, down, true);
    cascade.axis[KEEL_CASCADE_ROLL_RATE].limit.at_max = true;
    cascade.axis[KEEL_CASCADE_PITCH_RATE].limit.at_min = true;
    roll = integral_of(KEEL_CASCADE_ROLL);
    pitch = integral_of(KEEL_CASCADE_PITCH);
    keel_cascade_angle_step(&cascade, asked, down, true);
    TEST_ASSERT_EQUAL_FLOAT(roll, integral_of(KEEL_CASCADE_ROLL));
    TEST_ASSERT_EQUAL_FLOAT(pitch + 0.0625f, integral_of(KEEL_CASCADE_PITCH));
    TEST_ASSERT_TRUE(axis_of(KEEL_CASCADE_ROLL)->limit.at_max);
    TEST_ASSERT_TRUE(axis_of(KEEL_CASCADE_PITCH)->limit.at_min);
}

static void CAS_007_angles_begin_at_the_rates_that_are_flown(void)
{
    const keel_cascade_rates_t flown = {1.5f, -2.0f, 0.0f, 0.5f};
    const keel_cascade_tilt_t asked = {0.25f, 0.125f};

    fly(KEEL_MODE_ACRO);
    keel_cascade_rate_step(&cascade, flown, still, 0u);
    keel_cascade_enter(&cascade, KEEL_MODE_ANGLE);
    keel_cascade_angle_step(&cascade, asked, down, true);
    TEST_ASSERT_EQUAL_FLOAT(1.5f, cascade.rates.roll);
    TEST_ASSERT_EQUAL_FLOAT(-2.0f, cascade.rates.pitch);
}

/* --- CAS-010: the velocity stage -------------------------------------------------------------- */

/* Enters at rest, then asks for accelerations: errors of 1 and -0.5 m/s and 0.25 m/s upwards lead
 * to 1.75 and -0.75 m/s^2, and to 0.09375 more thrust. */
static void accelerate(float forward_north, float forward_east)
{
    const keel_cascade_vector_t asked = {1.0f, -0.5f, 0.25f};

    fly(KEEL_MODE_POSITION);
    cascade.command.thrust = 0.375f;
    estimate.forward_north = forward_north;
    estimate.forward_east = forward_east;
    keel_cascade_velocity_step(&cascade, nowhere, &estimate);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, cascade.tilt.roll);
    TEST_ASSERT_EQUAL_FLOAT(0.375f, cascade.thrust);
    keel_cascade_velocity_step(&cascade, asked, &estimate);
}

#define G 9.80665f

static void CAS_010_tilts_in_the_direction_of_the_heading(void)
{
    accelerate(1.0f, 0.0f);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, -1.75f / G, cascade.tilt.pitch);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, -0.75f / G, cascade.tilt.roll);
    TEST_ASSERT_EQUAL_FLOAT(0.46875f, cascade.thrust);
    /* East: the nose up, and to the left. */
    accelerate(0.0f, 1.0f);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.75f / G, cascade.tilt.pitch);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, -1.75f / G, cascade.tilt.roll);
    accelerate(-0.6f, 0.8f);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, -((-0.6f * 1.75f) - (0.8f * 0.75f)) / G, cascade.tilt.pitch);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, ((0.6f * 0.75f) - (0.8f * 1.75f)) / G, cascade.tilt.roll);
}

static void CAS_010_the_greatest_tilt(void)
{
    const keel_cascade_vector_t far = {8.0f, 7.0f, 4.0f};
    float square;

    for (uint32_t i = KEEL_CASCADE_NORTH_SPEED; i <= KEEL_CASCADE_EAST_SPEED; i++) {
        config.pid[i].output_max = 3.466796875f;
    }
    fly(KEEL_MODE_POSITION);
    cascade.command.thrust = 0.375f;
    estimate.forward_north = 0.6f;
    estimate.forward_east = -0.8f;
    keel_cascade_velocity_step(&cascade, nowhere, &estimate);
    keel_cascade_velocity_step(&cascade, far, &estimate);
    square = (cascade.tilt.roll * cascade.tilt.roll) + (cascade.tilt.pitch * cascade.tilt.pitch);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.2499457f, square); /* 2 (3.466796875 / g)^2 */
    TEST_ASSERT_EQUAL_FLOAT(0.875f, cascade.thrust);
}

static void CAS_010_a_tilt_is_within_the_reach_however_long_the_direction(void)
{
    const keel_cascade_vector_t far = {8.0f, 7.0f, 4.0f};

    for (uint32_t i = KEEL_CASCADE_NORTH_SPEED; i <= KEEL_CASCADE_EAST_SPEED; i++) {
        config.pid[i].output_max = 3.466796875f;
    }
    fly(KEEL_MODE_POSITION);
    estimate.forward_north = 1.0f;
    estimate.forward_east = 1.0f;
    keel_cascade_velocity_step(&cascade, nowhere, &estimate);
    keel_cascade_velocity_step(&cascade, far, &estimate);
    /* Twice 3.466796875 / g, within pitch's own reach. */
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, -0.7070299f, cascade.tilt.pitch);
    estimate.forward_east = -1.0f;
    keel_cascade_velocity_step(&cascade, far, &estimate);
    TEST_ASSERT_EQUAL_FLOAT(0.5f, cascade.tilt.roll);
}

/* With a direction between north and east that is too long, accelerations add up in one angle, to
 * at least 6 / g, beyond its reach, and cancel in the other, but for 0.25 m/s^2. */
static void CAS_010_either_tilt_is_within_its_reach_in_either_direction(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        const float one_way = (float)sign;
        const keel_cascade_vector_t ahead = {8.0f * one_way, 7.0f * one_way, 0.0f};
        const keel_cascade_vector_t aside = {-8.0f * one_way, 7.0f * one_way, 0.0f};

        config.reach[KEEL_CASCADE_PITCH] = 0.5f;
        fly(KEEL_MODE_POSITION);
        estimate.forward_north = 1.0f;
        estimate.forward_east = 1.0f;
        keel_cascade_velocity_step(&cascade, nowhere, &estimate);
        keel_cascade_velocity_step(&cascade, ahead, &estimate);
        TEST_ASSERT_EQUAL_FLOAT(-0.5f * one_way, cascade.tilt.pitch);
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, -0.25f / G, cascade.tilt.roll);
        keel_cascade_velocity_step(&cascade, aside, &estimate);
        TEST_ASSERT_EQUAL_FLOAT(0.5f * one_way, cascade.tilt.roll);
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.0f, cascade.tilt.pitch);
    }
}

/* All that hovering leaves, upwards, and all of it, downwards. */
static void CAS_010_the_ends_of_the_thrust(void)
{
    const keel_cascade_vector_t up = {0.0f, 0.0f, 4.0f};
    const keel_cascade_vector_t under = {0.0f, 0.0f, -4.0f};

    config.pid[KEEL_CASCADE_CLIMB] = controller(1.0f, 32.0f, 128.0f, -0.375f, 0.625f);
    fly(KEEL_MODE_ALTITUDE);
    keel_cascade_velocity_step(&cascade, nowhere, &estimate);
    keel_cascade_velocity_step(&cascade, up, &estimate);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, cascade.thrust);
    keel_cascade_velocity_step(&cascade, under, &estimate);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, cascade.thrust);
}

static void CAS_010_stops_without_a_place_or_a_direction(void)
{
    const float bad[] = {NAN, 1.001f, -1.001f, INFINITY};

    for (size_t i = 0u; i < 9u; i++) {
        accelerate(1.0f, 0.0f);
        estimate.has_place = i < 8u;
        estimate.forward_north = (i < 4u) ? bad[i] : 1.0f;
        estimate.forward_east = ((i >= 4u) && (i < 8u)) ? bad[i - 4u] : 0.0f;
        keel_cascade_velocity_step(&cascade, nowhere, &estimate);
        TEST_ASSERT_EQUAL_FLOAT(0.0f, cascade.tilt.roll);
        TEST_ASSERT_EQUAL_FLOAT(0.0f, cascade.tilt.pitch);
        TEST_ASSERT_FALSE(axis_of(KEEL_CASCADE_NORTH_SPEED)->running);
        TEST_ASSERT_TRUE(axis_of(KEEL_CASCADE_CLIMB)->running);
        estimate.has_place = true;
    }
}

static void CAS_010_hovers_without_a_height(void)
{
    accelerate(1.0f, 0.0f);
    estimate.has_height = false;
    keel_cascade_velocity_step(&cascade, nowhere, &estimate);
    TEST_ASSERT_EQUAL_FLOAT(0.375f, cascade.thrust);
    TEST_ASSERT_TRUE(axis_of(KEEL_CASCADE_EAST_SPEED)->running);
}

static void CAS_010_altitude_alone(void)
{
    fly(KEEL_MODE_ALTITUDE);
    keel_cascade_velocity_step(&cascade, nowhere, &estimate);
    TEST_ASSERT_TRUE(axis_of(KEEL_CASCADE_CLIMB)->running);
    TEST_ASSERT_FALSE(axis_of(KEEL_CASCADE_NORTH_SPEED)->running);
    TEST_ASSERT_FALSE(axis_of(KEEL_CASCADE_EAST_SPEED)->running);
}

static void CAS_007_accelerations_begin_at_the_tilt_that_is_flown(void)
{
    const keel_cascade_tilt_t flown = {0.25f, -0.125f};
    const keel_cascade_rates_t rates = {0.0f, 0.0f, 0.0f, 0.5f};
    const keel_cascade_vector_t asked = {1.0f, -0.5f, 0.25f};

    fly(KEEL_MODE_ANGLE);
    keel_cascade_rate_step(&cascade, rates, still, 0u);
    keel_cascade_angle_step(&cascade, flown, down, true);
    keel_cascade_enter(&cascade, KEEL_MODE_POSITION);
    estimate.forward_north = 0.6f;
    estimate.forward_east = 0.8f;
    keel_cascade_velocity_step(&cascade, asked, &estimate);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.25f, cascade.tilt.roll);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, -0.125f, cascade.tilt.pitch);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.5f, cascade.thrust);
}

/* The angle of one axis alone is known where the stage begins: the other counts as level. */
static void CAS_007_accelerations_begin_at_what_is_known_of_the_tilt(void)
{
    const keel_cascade_tilt_t flown = {0.25f, -0.125f};
    const keel_attitude_vector_t no_roll = {0.0f, NAN, 1.0f};
    const keel_attitude_vector_t no_pitch = {NAN, 0.0f, 1.0f};
    const keel_cascade_vector_t asked = {1.0f, -0.5f, 0.25f};

    fly(KEEL_MODE_POSITION);
    keel_cascade_angle_step(&cascade, flown, no_roll, true);
    keel_cascade_velocity_step(&cascade, asked, &estimate);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.0f, cascade.tilt.roll);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, -0.125f, cascade.tilt.pitch);
    fly(KEEL_MODE_POSITION);
    keel_cascade_angle_step(&cascade, flown, no_pitch, true);
    keel_cascade_velocity_step(&cascade, asked, &estimate);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.25f, cascade.tilt.roll);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.0f, cascade.tilt.pitch);
}

/* Errors of 0.5 m/s in all directions, one step without limits and one with those of the body: the
 * integrals that move. */
static void earth_limits(float forward_north, float forward_east, float error, bool north,
                         bool east)
{
    const keel_cascade_vector_t asked = {error, error, error};
    float before[2];

    estimate.forward_north = forward_north;
    estimate.forward_east = forward_east;
    keel_cascade_enter(&cascade, KEEL_MODE_ANGLE);
    keel_cascade_enter(&cascade, KEEL_MODE_POSITION);
    keel_cascade_velocity_step(&cascade, nowhere, &estimate);
    before[0] = integral_of(KEEL_CASCADE_NORTH_SPEED);
    before[1] = integral_of(KEEL_CASCADE_EAST_SPEED);
    keel_cascade_velocity_step(&cascade, asked, &estimate);
    TEST_ASSERT_EQUAL_FLOAT(north ? (before[0] + (0.25f * error)) : before[0],
                            integral_of(KEEL_CASCADE_NORTH_SPEED));
    TEST_ASSERT_EQUAL_FLOAT(east ? (before[1] + (0.25f * error)) : before[1],
                            integral_of(KEEL_CASCADE_EAST_SPEED));
}

static void CAS_006_limits_of_the_tilt_stop_the_accelerations(void)
{
    keel_cascade_limit_t *const roll = &cascade.axis[KEEL_CASCADE_ROLL].limit;
    keel_cascade_limit_t *const pitch = &cascade.axis[KEEL_CASCADE_PITCH].limit;

    fly(KEEL_MODE_POSITION);
    /* To the north: pitch is north, roll is east. Nose down is forward. */
    earth_limits(1.0f, 0.0f, 0.5f, true, true);
    pitch->at_min = true;
    earth_limits(1.0f, 0.0f, 0.5f, false, true);
    earth_limits(1.0f, 0.0f, -0.5f, true, true);
    earth_limits(-1.0f, 0.0f, 0.5f, true, true);
    earth_limits(-1.0f, 0.0f, -0.5f, false, true);
    earth_limits(0.0f, 1.0f, 0.5f, true, false);
    earth_limits(0.0f, -1.0f, -0.5f, true, false);
    earth_limits(0.8f, 0.6f, 0.5f, false, false);
    earth_limits(0.875f, 0.5f, 0.5f, false, true);
    pitch->at_min = false;
    pitch->at_max = true;
    earth_limits(1.0f, 0.0f, -0.5f, false, true);
    earth_limits(1.0f, 0.0f, 0.5f, true, true);
    earth_limits(0.0f, 1.0f, -0.5f, true, false);
    earth_limits(0.0f, -1.0f, 0.5f, true, false);
    pitch->at_max = false;
    roll->at_max = true;
    earth_limits(1.0f, 0.0f, 0.5f, true, false);
    earth_limits(1.0f, 0.0f, -0.5f, true, true);
    earth_limits(0.0f, 1.0f, -0.5f, false, true);
    earth_limits(0.0f, -1.0f, 0.5f, false, true);
    earth_limits(-1.0f, 0.0f, -0.5f, true, false);
    roll->at_max = false;
    roll->at_min = true;
    earth_limits(1.0f, 0.0f, -0.5f, true, false);
    earth_limits(0.0f, 1.0f, 0.5f, false, true);
    earth_limits(0.0f, -1.0f, -0.5f, false, true);
}

/* The parts, north and east, of a direction of the body in which it goes no further. */
typedef struct part {
    bool there;
    float north;
    float east;
} part_t;

static void is_limited(const part_t *parts, keel_cascade_limit_t north, keel_cascade_limit_t east)
{
    keel_cascade_limit_t to_north = {false, false};
    keel_cascade_limit_t to_east = {false, false};

    for (uint32_t i = 0u; i < 4u; i++) {
        if (parts[i].there) {
            to_north.at_max = to_north.at_max || (parts[i].north > 0.5f);
            to_north.at_min = to_north.at_min || (parts[i].north < -0.5f);
            to_east.at_max = to_east.at_max || (parts[i].east > 0.5f);
            to_east.at_min = to_east.at_min || (parts[i].east < -0.5f);
        }
    }
    TEST_ASSERT_EQUAL(to_north.at_max, north.at_max);
    TEST_ASSERT_EQUAL(to_north.at_min, north.at_min);
    TEST_ASSERT_EQUAL(to_east.at_max, east.at_max);
    TEST_ASSERT_EQUAL(to_east.at_min, east.at_min);
}

/* Forward with the nose down, backward with it up, to the right and to the left. */
static void limits_from(const float heading[2], uint32_t limits)
{
    const float n = heading[0];
    const float e = heading[1];
    const part_t parts[4] = {{(limits & 1u) != 0u, n, e},
                             {(limits & 2u) != 0u, -n, -e},
                             {(limits & 4u) != 0u, -e, n},
                             {(limits & 8u) != 0u, e, -n}};

    cascade.axis[KEEL_CASCADE_PITCH].limit.at_min = parts[0].there;
    cascade.axis[KEEL_CASCADE_PITCH].limit.at_max = parts[1].there;
    cascade.axis[KEEL_CASCADE_ROLL].limit.at_max = parts[2].there;
    cascade.axis[KEEL_CASCADE_ROLL].limit.at_min = parts[3].there;
    estimate.forward_north = n;
    estimate.forward_east = e;
    keel_cascade_velocity_step(&cascade, nowhere, &estimate);
    is_limited(parts, axis_of(KEEL_CASCADE_NORTH_SPEED)->limit,
               axis_of(KEEL_CASCADE_EAST_SPEED)->limit);
}

static void CAS_006_every_limit_of_the_tilt_in_every_direction(void)
{
    static const float parts[5] = {-0.75f, -0.5f, 0.0f, 0.5f, 0.75f};

    fly(KEEL_MODE_POSITION);
    for (uint32_t i = 0u; i < 25u; i++) {
        const float heading[2] = {parts[i / 5u], parts[i % 5u]};

        for (uint32_t limits = 0u; limits < 16u; limits++) {
            limits_from(heading, limits);
        }
    }
}

static void CAS_006_the_mixer_stops_the_climb(void)
{
    const keel_cascade_vector_t up = {0.0f, 0.0f, 0.5f};
    const keel_cascade_vector_t under = {0.0f, 0.0f, -0.5f};
    const keel_cascade_rates_t rates = {0.0f, 0.0f, 0.0f, 0.375f};
    float before;

    fly(KEEL_MODE_ALTITUDE);
    keel_cascade_rate_step(&cascade, rates, still, KEEL_MIXER_LOWERED);
    keel_cascade_velocity_step(&cascade, nowhere, &estimate);
    before = integral_of(KEEL_CASCADE_CLIMB);
    keel_cascade_velocity_step(&cascade, up, &estimate);
    TEST_ASSERT_EQUAL_FLOAT(before, integral_of(KEEL_CASCADE_CLIMB));
    keel_cascade_velocity_step(&cascade, under, &estimate);
    TEST_ASSERT_EQUAL_FLOAT(before - 0.125f, integral_of(KEEL_CASCADE_CLIMB));
    keel_cascade_rate_step(&cascade, rates, still, KEEL_MIXER_RAISED);
    keel_cascade_velocity_step(&cascade, under, &estimate);
    TEST_ASSERT_EQUAL_FLOAT(before - 0.125f, integral_of(KEEL_CASCADE_CLIMB));
    keel_cascade_velocity_step(&cascade, up, &estimate);
    TEST_ASSERT_EQUAL_FLOAT(before, integral_of(KEEL_CASCADE_CLIMB));
}

/* --- CAS-011 ---------------------------------------------------------------------------------- */

/* What the velocity stage makes of set-points of 2 m/s to the north, east and up, or away. */
static void at_side(float north, float east, float up, float sign, float speed)
{
    const keel_cascade_vector_t asked = {2.0f * sign, 2.0f * sign, 2.0f * sign};

    estimate.position.north = sign * north;
    estimate.position.east = sign * east;
    estimate.position.up = sign * up;
    estimate.velocity.north = sign * speed;
    estimate.velocity.east = sign * speed;
    estimate.velocity.up = sign * speed;
    keel_cascade_velocity_step(&cascade, asked, &estimate);
}

static void is_near_at(float north, float east, float up, float speed, bool near)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        at_side(north, east, up, (float)sign, speed);
        for (uint32_t i = KEEL_CASCADE_NORTH_SPEED; i <= KEEL_CASCADE_CLIMB; i++) {
            const keel_cascade_limit_t limit = axis_of(i)->limit;

            TEST_ASSERT_EQUAL_FLOAT(near ? 0.0f : (2.0f * (float)sign), axis_of(i)->pid.setpoint);
            TEST_ASSERT_EQUAL(near, (sign > 0) ? limit.at_max : limit.at_min);
        }
    }
}

/* With v = 1.5 m/s: v' is 2.5 m/s, for which 1.25 m are needed after 0.5 m, so the side is near
 * from 1.75 m on. With v = -1: v' = 0, and 0.125 m back. With v = -3, still moving away after T,
 * 0.625 m back: near from 0.625 m beyond the side on. */
static void CAS_011_no_way_towards_a_side_that_is_near(void)
{
    for (uint32_t i = KEEL_CASCADE_NORTH_SPEED; i <= KEEL_CASCADE_CLIMB; i++) {
        config.pid[i].gains.kp = 0.0f;
        config.pid[i].gains.ki = 0.0f;
    }
    config.pid[KEEL_CASCADE_CLIMB].output_min = -0.375f;
    fly(KEEL_MODE_POSITION);
    is_near_at(88.25f, 78.25f, 68.25f, 1.5f, false);
    is_near_at(88.2501f, 78.2501f, 68.2501f, 1.5f, true);
    is_near_at(90.0f, 80.0f, 70.0f, 1.5f, true);
    is_near_at(90.125f, 80.125f, 70.125f, -1.0f, false);
    is_near_at(90.126f, 80.126f, 70.126f, -1.0f, true);
    is_near_at(90.625f, 80.625f, 70.625f, -3.0f, false);
    is_near_at(90.626f, 80.626f, 70.626f, -3.0f, true);
}

/* At rest 0.325 m are needed: 0.125 m, and 0.2 m for the 1 m/s then reached. */
static void CAS_011_no_way_in_a_fence_without_way_to_brake(void)
{
    for (uint32_t i = KEEL_CASCADE_NORTH; i <= KEEL_CASCADE_HEIGHT; i++) {
        config.reach[i] = 0.3125f;
    }
    fly(KEEL_MODE_POSITION);
    for (int sign = -1; sign <= 1; sign++) {
        at_side(0.0f, 0.0f, 0.0f, (float)sign, 0.0f);
        for (uint32_t i = KEEL_CASCADE_NORTH_SPEED; i <= KEEL_CASCADE_CLIMB; i++) {
            TEST_ASSERT_EQUAL_FLOAT(0.0f, axis_of(i)->pid.setpoint);
            TEST_ASSERT_TRUE(axis_of(i)->limit.at_min && axis_of(i)->limit.at_max);
        }
    }
}

static void CAS_011_each_axis_for_itself(void)
{
    const keel_cascade_vector_t asked = {2.0f, 2.0f, 2.0f};

    fly(KEEL_MODE_POSITION);
    estimate.position.north = 89.75f;
    keel_cascade_velocity_step(&cascade, asked, &estimate);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, axis_of(KEEL_CASCADE_NORTH_SPEED)->pid.setpoint);
    TEST_ASSERT_EQUAL_FLOAT(2.0f, axis_of(KEEL_CASCADE_EAST_SPEED)->pid.setpoint);
    TEST_ASSERT_EQUAL_FLOAT(2.0f, axis_of(KEEL_CASCADE_CLIMB)->pid.setpoint);
}

static void CAS_011_the_way_back_is_free(void)
{
    const keel_cascade_vector_t back = {-2.0f, 2.0f, -2.0f};

    fly(KEEL_MODE_POSITION);
    estimate.position.north = 95.0f;
    estimate.position.east = -95.0f;
    estimate.position.up = 95.0f;
    keel_cascade_velocity_step(&cascade, back, &estimate);
    TEST_ASSERT_EQUAL_FLOAT(-2.0f, axis_of(KEEL_CASCADE_NORTH_SPEED)->pid.setpoint);
    TEST_ASSERT_EQUAL_FLOAT(2.0f, axis_of(KEEL_CASCADE_EAST_SPEED)->pid.setpoint);
    TEST_ASSERT_EQUAL_FLOAT(-2.0f, axis_of(KEEL_CASCADE_CLIMB)->pid.setpoint);
}

static void CAS_011_no_way_without_a_number(void)
{
    const float bad[] = {NAN, INFINITY, -INFINITY, 5.1e5f, -5.1e5f};

    fly(KEEL_MODE_POSITION);
    for (size_t i = 0u; i < (sizeof bad / sizeof bad[0]); i++) {
        const keel_cascade_vector_t asked = {2.0f, -2.0f, 2.0f};

        estimate.position.north = bad[i];
        estimate.position.east = bad[i];
        keel_cascade_velocity_step(&cascade, asked, &estimate);
        TEST_ASSERT_EQUAL_FLOAT(0.0f, axis_of(KEEL_CASCADE_NORTH_SPEED)->pid.setpoint);
        TEST_ASSERT_EQUAL_FLOAT(0.0f, axis_of(KEEL_CASCADE_EAST_SPEED)->pid.setpoint);
        TEST_ASSERT_TRUE(axis_of(KEEL_CASCADE_EAST_SPEED)->limit.at_min);
        TEST_ASSERT_TRUE(axis_of(KEEL_CASCADE_EAST_SPEED)->limit.at_max);
        estimate.velocity.up = bad[i];
        keel_cascade_velocity_step(&cascade, asked, &estimate);
        TEST_ASSERT_TRUE(axis_of(KEEL_CASCADE_CLIMB)->held);
        TEST_ASSERT_TRUE(axis_of(KEEL_CASCADE_CLIMB)->limit.at_min);
        TEST_ASSERT_TRUE(axis_of(KEEL_CASCADE_CLIMB)->limit.at_max);
        estimate.velocity.up = 0.0f;
    }
}

/* --- CAS-013 ---------------------------------------------------------------------------------- */

static void CAS_013_velocities_for_places(void)
{
    const keel_cascade_vector_t asked = {3.0f, -2.0f, 1.0f};

    fly(KEEL_MODE_POSITION);
    keel_cascade_position_step(&cascade, nowhere, &estimate);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, cascade.velocity.north);
    estimate.position.north = 1.0f;
    estimate.position.east = 1.0f;
    estimate.position.up = 0.5f;
    keel_cascade_position_step(&cascade, asked, &estimate);
    TEST_ASSERT_EQUAL_FLOAT(2.0f, cascade.velocity.north);
    TEST_ASSERT_EQUAL_FLOAT(-2.25f, cascade.velocity.east);
    TEST_ASSERT_EQUAL_FLOAT(0.625f, cascade.velocity.up);
}

static void CAS_013_places_are_within_the_fence(void)
{
    const keel_cascade_vector_t far = {1000.0f, -1000.0f, 1000.0f};

    fly(KEEL_MODE_POSITION);
    keel_cascade_position_step(&cascade, far, &estimate);
    TEST_ASSERT_EQUAL_FLOAT(90.0f, axis_of(KEEL_CASCADE_NORTH)->pid.setpoint);
    TEST_ASSERT_EQUAL_FLOAT(-80.0f, axis_of(KEEL_CASCADE_EAST)->pid.setpoint);
    TEST_ASSERT_EQUAL_FLOAT(70.0f, axis_of(KEEL_CASCADE_HEIGHT)->pid.setpoint);
    keel_cascade_position_step(&cascade, far, &estimate);
    TEST_ASSERT_EQUAL_FLOAT(7.5f, cascade.velocity.north);
    TEST_ASSERT_EQUAL_FLOAT(-7.0f, cascade.velocity.east);
    TEST_ASSERT_EQUAL_FLOAT(4.0f, cascade.velocity.up);
}

static void CAS_013_places_and_heights_are_valid_apart(void)
{
    const keel_cascade_vector_t asked = {3.0f, -2.0f, 1.0f};

    fly(KEEL_MODE_POSITION);
    estimate.has_place = false;
    keel_cascade_position_step(&cascade, nowhere, &estimate);
    keel_cascade_position_step(&cascade, asked, &estimate);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, cascade.velocity.north);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, cascade.velocity.east);
    TEST_ASSERT_EQUAL_FLOAT(1.25f, cascade.velocity.up);
    estimate.has_place = true;
    estimate.has_height = false;
    keel_cascade_position_step(&cascade, nowhere, &estimate);
    keel_cascade_position_step(&cascade, asked, &estimate);
    TEST_ASSERT_EQUAL_FLOAT(3.0f, cascade.velocity.north);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, cascade.velocity.up);
}

static void CAS_007_velocities_begin_at_those_that_are_flown(void)
{
    const keel_cascade_vector_t flown = {2.0f, -1.0f, 0.5f};
    const keel_cascade_vector_t asked = {3.0f, -2.0f, 1.0f};

    fly(KEEL_MODE_POSITION);
    keel_cascade_velocity_step(&cascade, flown, &estimate);
    keel_cascade_position_step(&cascade, asked, &estimate);
    TEST_ASSERT_EQUAL_FLOAT(2.0f, cascade.velocity.north);
    TEST_ASSERT_EQUAL_FLOAT(-1.0f, cascade.velocity.east);
    TEST_ASSERT_EQUAL_FLOAT(0.5f, cascade.velocity.up);
}

static void CAS_006_limits_of_the_velocities_stop_the_places(void)
{
    const keel_cascade_vector_t asked = {1.0f, -1.0f, 1.0f};
    float north;
    float east;

    fly(KEEL_MODE_POSITION);
    keel_cascade_position_step(&cascade, asked, &estimate);
    cascade.axis[KEEL_CASCADE_NORTH_SPEED].limit.at_max = true;
    cascade.axis[KEEL_CASCADE_EAST_SPEED].limit.at_max = true;
    north = integral_of(KEEL_CASCADE_NORTH);
    east = integral_of(KEEL_CASCADE_EAST);
    keel_cascade_position_step(&cascade, asked, &estimate);
    TEST_ASSERT_EQUAL_FLOAT(north, integral_of(KEEL_CASCADE_NORTH));
    TEST_ASSERT_EQUAL_FLOAT(east - 0.25f, integral_of(KEEL_CASCADE_EAST));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(CAS_001_the_reach_of_each_axis);
    RUN_TEST(CAS_001_outputs_are_within_what_takes_them);
    RUN_TEST(CAS_001_either_tilt_limits_the_accelerations);
    RUN_TEST(CAS_001_the_ends_of_the_tilt_limit_the_accelerations);
    RUN_TEST(CAS_001_accelerations_brake_and_are_counted_on);
    RUN_TEST(CAS_001_the_other_numbers);
    RUN_TEST(CAS_001_a_period_is_within_the_reaction_time);
    RUN_TEST(CAS_001_what_a_controller_refuses);
    RUN_TEST(CAS_002_made_at_rest);
    RUN_TEST(CAS_003_axes_of_each_mode);
    RUN_TEST(CAS_003_no_mode_commands_nothing);
    RUN_TEST(CAS_004_an_axis_enters_and_steps);
    RUN_TEST(CAS_004_a_setpoint_counts_as_the_reach);
    RUN_TEST(CAS_004_an_output_at_its_limit_says_so);
    RUN_TEST(CAS_005_bad_numbers_are_held);
    RUN_TEST(CAS_005_does_not_enter_with_bad_numbers);
    RUN_TEST(CAS_005_stops_without_a_measurement);
    RUN_TEST(CAS_005_a_bad_rate_holds_one_torque);
    RUN_TEST(CAS_006_the_integral_stops_in_one_direction);
    RUN_TEST(CAS_006_the_limit_below_and_that_of_the_axis);
    RUN_TEST(CAS_006_the_mixer_stops_torques);
    RUN_TEST(CAS_006_a_torque_comes_back_from_the_limit);
    RUN_TEST(CAS_006_limits_of_the_rates_stop_the_angles);
    RUN_TEST(CAS_006_limits_of_the_tilt_stop_the_accelerations);
    RUN_TEST(CAS_006_every_limit_of_the_tilt_in_every_direction);
    RUN_TEST(CAS_006_the_mixer_stops_the_climb);
    RUN_TEST(CAS_006_limits_of_the_velocities_stop_the_places);
    RUN_TEST(CAS_007_torques_begin_at_the_last_command);
    RUN_TEST(CAS_007_angles_begin_at_the_rates_that_are_flown);
    RUN_TEST(CAS_007_accelerations_begin_at_the_tilt_that_is_flown);
    RUN_TEST(CAS_007_accelerations_begin_at_what_is_known_of_the_tilt);
    RUN_TEST(CAS_007_velocities_begin_at_those_that_are_flown);
    RUN_TEST(CAS_008_torques_and_thrust);
    RUN_TEST(CAS_008_any_thrust_is_within_its_range);
    RUN_TEST(CAS_009_rates_for_tilts);
    RUN_TEST(CAS_009_stops_without_an_attitude);
    RUN_TEST(CAS_009_not_in_acro);
    RUN_TEST(CAS_010_tilts_in_the_direction_of_the_heading);
    RUN_TEST(CAS_010_the_greatest_tilt);
    RUN_TEST(CAS_010_a_tilt_is_within_the_reach_however_long_the_direction);
    RUN_TEST(CAS_010_either_tilt_is_within_its_reach_in_either_direction);
    RUN_TEST(CAS_010_the_ends_of_the_thrust);
    RUN_TEST(CAS_010_stops_without_a_place_or_a_direction);
    RUN_TEST(CAS_010_hovers_without_a_height);
    RUN_TEST(CAS_010_altitude_alone);
    RUN_TEST(CAS_011_no_way_towards_a_side_that_is_near);
    RUN_TEST(CAS_011_no_way_in_a_fence_without_way_to_brake);
    RUN_TEST(CAS_011_each_axis_for_itself);
    RUN_TEST(CAS_011_the_way_back_is_free);
    RUN_TEST(CAS_011_no_way_without_a_number);
    RUN_TEST(CAS_013_velocities_for_places);
    RUN_TEST(CAS_013_places_are_within_the_fence);
    RUN_TEST(CAS_013_places_and_heights_are_valid_apart);
    return UNITY_END();
}
