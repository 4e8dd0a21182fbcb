/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/flight/mode.h. Steps are 10 ms apart and times in the configuration whole
 * tenths of a second, so that expected steps are counted by hand. */
#include "keel/flight/mode.h"
#include "unity.h"

#include <string.h>

#define STEP_US 10000u

static const keel_mode_config_t usual = {
    .loss_us = 250000u,
    .regain_us = 500000u,
    .request_us = 300000u,
    .kill_us = 400000u,
    .landed_us = 1000000u,
    .estimate_us = 700000u,
    .alarm_us = 600000u,
    .idle_us = 5000000u,
    .hold_us = 2000000u,
    .return_us = 3000000u,
    .required = KEEL_MODE_CHECK_GYROSCOPE | KEEL_MODE_CHECK_ACCELEROMETER |
                KEEL_MODE_CHECK_MAGNETOMETER | KEEL_MODE_CHECK_BAROMETER |
                KEEL_MODE_CHECK_POSITION_ESTIMATE | KEEL_MODE_CHECK_CALIBRATION |
                KEEL_MODE_CHECK_LEVEL_ATTITUDE | KEEL_MODE_CHECK_BATTERY_LEVEL |
                KEEL_MODE_CHECK_MOTORS | KEEL_MODE_CHECK_CPU_LOAD | KEEL_MODE_CHECK_STORAGE |
                KEEL_MODE_CHECK_HOME_POSITION,
    .returns = true,
};

static keel_mode_t machine;
static keel_mode_input_t in;

static void begin(const keel_mode_config_t *config)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_mode_init(&machine, config));
    in.elapsed_us = STEP_US;
    in.facts = KEEL_MODE_RC_LINKED | KEEL_MODE_ARM_SWITCH_OFF | KEEL_MODE_THROTTLE_LOW |
               KEEL_MODE_LANDED | KEEL_MODE_ATTITUDE_VALID | KEEL_MODE_ALTITUDE_VALID |
               KEEL_MODE_POSITION_VALID;
    in.checks = usual.required;
    in.asked = KEEL_MODE_POSITION;
}

void setUp(void)
{
    begin(&usual);
}

void tearDown(void)
{
}

static void set(uint32_t facts)
{
    in.facts |= facts;
}

static void clear(uint32_t facts)
{
    in.facts &= ~facts;
}

static void run(uint32_t steps)
{
    for (uint32_t i = 0u; i < steps; i++) {
        keel_mode_step(&machine, &in);
    }
}

static void switch_on(void)
{
    clear(KEEL_MODE_ARM_SWITCH_OFF);
    set(KEEL_MODE_ARM_SWITCH_ON);
}

static void switch_off(void)
{
    clear(KEEL_MODE_ARM_SWITCH_ON);
    set(KEEL_MODE_ARM_SWITCH_OFF);
}

/* The next n steps end in this state, and the one before them did not. */
static void expect_after(uint32_t steps, uint8_t state)
{
    run(steps - 1u);
    TEST_ASSERT_NOT_EQUAL(state, machine.state);
    run(1u);
    TEST_ASSERT_EQUAL_UINT8(state, machine.state);
}

static void arm(void)
{
    run(150u);
    switch_on();
    run(31u); /* The first look, and 300 ms. */
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_ARMED, machine.state);
}

static void fly(void)
{
    arm();
    clear(KEEL_MODE_LANDED | KEEL_MODE_THROTTLE_LOW);
    run(100u);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_FLYING, machine.state);
}

/* In flight, with the link lost just now. */
static void lose_link(void)
{
    fly();
    clear(KEEL_MODE_RC_LINKED);
    expect_after(25u, KEEL_MODE_HOLDING); /* 250 ms. */
}

static void refuse(keel_mode_config_t config, keel_status_t expected)
{
    const keel_mode_t before = machine;

    TEST_ASSERT_EQUAL(expected, keel_mode_init(&machine, &config));
    TEST_ASSERT_EQUAL_MEMORY(&before, &machine, sizeof before);
}

static void MOD_001_each_time_is_checked(void)
{
    const size_t settling[] = {
        offsetof(keel_mode_config_t, regain_us),   offsetof(keel_mode_config_t, request_us),
        offsetof(keel_mode_config_t, kill_us),     offsetof(keel_mode_config_t, landed_us),
        offsetof(keel_mode_config_t, estimate_us), offsetof(keel_mode_config_t, alarm_us),
        offsetof(keel_mode_config_t, idle_us)};
    const size_t lasting[] = {offsetof(keel_mode_config_t, hold_us),
                              offsetof(keel_mode_config_t, return_us)};
    const uint32_t short_us = 249999u;
    const uint32_t long_us = 3600000001u;
    keel_mode_config_t config = usual;

    arm();
    for (size_t i = 0u; i < (sizeof settling / sizeof settling[0]); i++) {
        config = usual;
        memcpy((char *)&config + settling[i], &short_us, sizeof short_us);
        refuse(config, KEEL_ERR_LIMITS);
        memcpy((char *)&config + settling[i], &long_us, sizeof long_us);
        refuse(config, KEEL_ERR_LIMITS);
    }
    for (size_t i = 0u; i < (sizeof lasting / sizeof lasting[0]); i++) {
        config = usual;
        memcpy((char *)&config + lasting[i], &long_us, sizeof long_us);
        refuse(config, KEEL_ERR_LIMITS);
    }
    config = usual;
    config.loss_us = 9999u;
    refuse(config, KEEL_ERR_LIMITS);
    config.loss_us = 2000001u;
    refuse(config, KEEL_ERR_LIMITS);
    config = usual;
    config.required = 0u;
    refuse(config, KEEL_ERR_INPUT);
}

static void MOD_001_ends_of_ranges_are_accepted(void)
{
    keel_mode_config_t config = usual;

    config.loss_us = 10000u;
    config.regain_us = 10000u;
    config.idle_us = 3600000000u;
    config.hold_us = 0u;
    config.return_us = 3600000000u;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_mode_init(&machine, &config));
}

/* With all other times an hour, it is the range of the silence alone that decides. */
static void MOD_001_the_longest_silence_that_is_accepted(void)
{
    const uint32_t hour_us = 3600000000u;
    const keel_mode_config_t config = {.loss_us = 2000000u,
                                       .regain_us = hour_us,
                                       .request_us = hour_us,
                                       .kill_us = hour_us,
                                       .landed_us = hour_us,
                                       .estimate_us = hour_us,
                                       .alarm_us = hour_us,
                                       .idle_us = hour_us,
                                       .required = 1u};
    keel_mode_config_t longer = config;

    longer.loss_us = 2000001u;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_mode_init(&machine, &config));
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_mode_init(&machine, &longer));
}

static void MOD_002_begins_disarmed(void)
{
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_DISARMED, machine.state);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_NONE, machine.mode);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_NONE, machine.asked);
    TEST_ASSERT_FALSE(machine.motors);
    TEST_ASSERT_FALSE(machine.ready);
    TEST_ASSERT_EQUAL_HEX32(0u, machine.seen | machine.settled);
}

static void MOD_003_a_fact_counts_after_its_time(void)
{
    run(70u); /* The first look, and 690 ms. */
    TEST_ASSERT_EQUAL_HEX32(0u, machine.settled & KEEL_MODE_ATTITUDE_VALID);
    run(1u);
    TEST_ASSERT_EQUAL_HEX32(KEEL_MODE_ATTITUDE_VALID, machine.settled & KEEL_MODE_ATTITUDE_VALID);
    clear(KEEL_MODE_ATTITUDE_VALID);
    run(1u);
    TEST_ASSERT_EQUAL_HEX32(0u, machine.settled & KEEL_MODE_ATTITUDE_VALID);
    set(KEEL_MODE_ATTITUDE_VALID);
    run(70u);
    TEST_ASSERT_EQUAL_HEX32(0u, machine.settled & KEEL_MODE_ATTITUDE_VALID);
}

static void MOD_003_two_frames_do_not_count(void)
{
    fly();
    set(KEEL_MODE_KILL_SWITCH_ON); /* kill_us is 400 ms. */
    run(1u);
    clear(KEEL_MODE_RC_LINKED);
    run(23u);
    set(KEEL_MODE_RC_LINKED);
    run(1u); /* The second frame, 240 ms later. */
    clear(KEEL_MODE_RC_LINKED);
    run(24u); /* Held for 480 ms, but by two frames. */
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_FLYING, machine.state);
    set(KEEL_MODE_RC_LINKED);
    in.elapsed_us = 9999u; /* Just within the longest silence. */
    run(1u);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_TERMINATED, machine.state);
}

static void MOD_003_silence_forgets_the_pilot(void)
{
    run(100u);
    TEST_ASSERT_TRUE(machine.ready);
    clear(KEEL_MODE_RC_LINKED);
    run(24u);
    TEST_ASSERT_EQUAL_HEX32(KEEL_MODE_RC_LINKED, machine.settled & KEEL_MODE_RC_LINKED);
    run(1u);
    TEST_ASSERT_EQUAL_HEX32(0u, (machine.settled | machine.seen) & 0x3Fu);
    TEST_ASSERT_FALSE(machine.ready);
}

static void MOD_003_a_stall_begins_anew(void)
{
    set(KEEL_MODE_AT_HOME);
    run(2u); /* Counts after 600 ms of looks. */
    in.elapsed_us = 10000000u;
    run(1u);
    TEST_ASSERT_EQUAL_HEX32(0u, machine.settled);
}

static void MOD_003_a_frame_with_no_mode_is_none(void)
{
    in.asked = KEEL_MODE_NONE;
    run(200u);
    TEST_ASSERT_EQUAL_HEX32(0u, machine.seen & 0x3Fu);
}

static void MOD_004_arms_when_switched_on(void)
{
    run(150u);
    switch_on();
    expect_after(31u, KEEL_MODE_ARMED);
    TEST_ASSERT_TRUE(machine.motors);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_POSITION, machine.mode);
}

static void MOD_004_a_switch_that_was_never_off_arms_nothing(void)
{
    switch_on();
    run(1000u);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_DISARMED, machine.state);
    TEST_ASSERT_EQUAL_HEX32(KEEL_MODE_ARM_SWITCH_OFF, machine.blocking.facts);
}

static void MOD_004_both_positions_are_neither(void)
{
    run(150u);
    set(KEEL_MODE_ARM_SWITCH_ON);
    run(100u);
    TEST_ASSERT_EQUAL_HEX32(0u,
                            machine.seen & (KEEL_MODE_ARM_SWITCH_ON | KEEL_MODE_ARM_SWITCH_OFF));
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_DISARMED, machine.state);
}

static void MOD_004_an_attempt_needs_off_before(void)
{
    in.checks = 0u;
    run(150u);
    switch_on();
    run(50u);
    in.checks = usual.required; /* Too late: the attempt was refused. */
    run(1000u);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_DISARMED, machine.state);
    switch_off();
    run(31u);
    switch_on();
    expect_after(31u, KEEL_MODE_ARMED);
}

/* An attempt in which something is not as it must be. */
static void attempt_refused(uint32_t checks, uint32_t facts)
{
    switch_on();
    run(31u);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_DISARMED, machine.state);
    TEST_ASSERT_EQUAL_HEX32(checks, machine.refused.checks);
    TEST_ASSERT_EQUAL_HEX32(facts, machine.refused.facts);
    switch_off();
}

static void MOD_005_each_refusal_is_named(void)
{
    const uint32_t not_so[] = {KEEL_MODE_THROTTLE_LOW, KEEL_MODE_LANDED};
    const uint32_t is_so[] = {KEEL_MODE_KILL_SWITCH_ON, KEEL_MODE_FENCE_BREACHED,
                              KEEL_MODE_BATTERY_CRITICAL, KEEL_MODE_BATTERY_EMPTY};

    for (uint32_t check = 0x0001u; check <= KEEL_MODE_CHECK_HOME_POSITION; check <<= 1) {
        in.checks = usual.required & ~check;
        run(150u);
        attempt_refused(check, 0u);
    }
    in.checks = usual.required;
    for (size_t i = 0u; i < (sizeof not_so / sizeof not_so[0]); i++) {
        clear(not_so[i]);
        run(150u);
        attempt_refused(0u, not_so[i]);
        set(not_so[i]);
    }
    for (size_t i = 0u; i < (sizeof is_so / sizeof is_so[0]); i++) {
        set(is_so[i]);
        run(150u);
        attempt_refused(0u, is_so[i]);
        clear(is_so[i]);
    }
}

static void MOD_005_a_mode_that_cannot_be_flown_refuses(void)
{
    const uint8_t asked[] = {KEEL_MODE_LAND, KEEL_MODE_RETURN};

    for (size_t i = 0u; i < (sizeof asked / sizeof asked[0]); i++) {
        in.asked = asked[i];
        run(150u);
        attempt_refused(0u, KEEL_MODE_SWITCH_UNMOVED);
    }
    in.asked = KEEL_MODE_POSITION;
    clear(KEEL_MODE_POSITION_VALID);
    run(150u);
    attempt_refused(0u, KEEL_MODE_SWITCH_UNMOVED);
    in.asked = KEEL_MODE_ALTITUDE;
    run(150u);
    switch_on();
    expect_after(31u, KEEL_MODE_ARMED);
}

static void MOD_005_without_a_link_that_is_named(void)
{
    clear(KEEL_MODE_RC_LINKED);
    run(150u);
    TEST_ASSERT_EQUAL_HEX32(KEEL_MODE_RC_LINKED | KEEL_MODE_ARM_SWITCH_OFF |
                                KEEL_MODE_THROTTLE_LOW | KEEL_MODE_SWITCH_UNMOVED,
                            machine.blocking.facts);
}

static void MOD_006_the_switch_disarms_on_the_ground(void)
{
    arm();
    switch_off();
    expect_after(31u, KEEL_MODE_DISARMED);
    TEST_ASSERT_FALSE(machine.motors);
}

static void MOD_006_the_switch_disarms_nothing_in_flight(void)
{
    fly();
    switch_off();
    run(10000u);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_FLYING, machine.state);
}

static void MOD_006_false_landing_with_throttle_stops_nothing(void)
{
    fly();
    set(KEEL_MODE_LANDED);
    switch_off();
    run(10000u);
    TEST_ASSERT_TRUE(machine.motors);
}

static void MOD_006_lands_and_disarms(void)
{
    fly();
    set(KEEL_MODE_LANDED | KEEL_MODE_THROTTLE_LOW);
    expect_after(101u, KEEL_MODE_ARMED);
    expect_after(500u, KEEL_MODE_DISARMED); /* Idle for 5 s. */
    TEST_ASSERT_EQUAL_HEX32(KEEL_MODE_STATE_TIMES_OUT, machine.cause);
}

static void MOD_007_holds_returns_lands_disarms(void)
{
    lose_link();
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_POSITION, machine.mode);
    expect_after(200u, KEEL_MODE_RETURNING);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_RETURN, machine.mode);
    expect_after(300u, KEEL_MODE_LANDING);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_LAND, machine.mode);
    TEST_ASSERT_EQUAL_HEX32(KEEL_MODE_RC_LOST | KEEL_MODE_STATE_TIMES_OUT, machine.cause);
    run(10000u);
    TEST_ASSERT_TRUE(machine.motors);
    set(KEEL_MODE_LANDED);
    expect_after(101u, KEEL_MODE_DISARMED);
}

static void MOD_007_returns_until_home(void)
{
    lose_link();
    run(200u);
    set(KEEL_MODE_AT_HOME);
    expect_after(61u, KEEL_MODE_LANDING);
}

static void MOD_007_lands_where_it_cannot_return(void)
{
    keel_mode_config_t config = usual;

    lose_link();
    clear(KEEL_MODE_POSITION_VALID);
    expect_after(200u, KEEL_MODE_LANDING);
    config.returns = false;
    begin(&config);
    switch_off();
    lose_link();
    expect_after(200u, KEEL_MODE_LANDING);
}

static void MOD_007_lands_from_the_ground(void)
{
    arm();
    clear(KEEL_MODE_RC_LINKED);
    expect_after(25u, KEEL_MODE_LANDING);
    expect_after(100u, KEEL_MODE_DISARMED); /* Landed for long, but so long in this state. */
}

static void MOD_008_link_that_is_back_resumes_nothing(void)
{
    lose_link();
    set(KEEL_MODE_RC_LINKED);
    in.asked = KEEL_MODE_ANGLE; /* Moved while there was no link. */
    run(150u);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_HOLDING, machine.state);
    in.asked = KEEL_MODE_ALTITUDE;
    expect_after(32u, KEEL_MODE_FLYING);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_ALTITUDE, machine.mode);
    TEST_ASSERT_EQUAL_HEX32(KEEL_MODE_PILOT_TAKES_OVER, machine.cause);
}

/* A move counts after the frame that moves, the first that rests, and 300 ms. */
static void MOD_008_taking_over_from_return_and_landing(void)
{
    fly();
    in.asked = KEEL_MODE_RETURN;
    expect_after(32u, KEEL_MODE_RETURNING);
    in.asked = KEEL_MODE_ANGLE;
    expect_after(32u, KEEL_MODE_FLYING);
    in.asked = KEEL_MODE_LAND;
    expect_after(32u, KEEL_MODE_LANDING);
    in.asked = KEEL_MODE_RETURN;
    expect_after(32u, KEEL_MODE_RETURNING);
    in.asked = KEEL_MODE_LAND;
    expect_after(32u, KEEL_MODE_LANDING);
    in.asked = KEEL_MODE_ACRO;
    expect_after(32u, KEEL_MODE_FLYING);
}

static void MOD_009_gives_way_at_once_and_comes_back_later(void)
{
    fly();
    clear(KEEL_MODE_POSITION_VALID);
    run(1u);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_ALTITUDE, machine.mode);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_POSITION, machine.asked);
    TEST_ASSERT_EQUAL_HEX32(KEEL_MODE_POSITION_VALID, machine.missing);
    clear(KEEL_MODE_ALTITUDE_VALID);
    run(1u);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_ANGLE, machine.mode);
    clear(KEEL_MODE_ATTITUDE_VALID);
    run(1u);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_ACRO, machine.mode);
    set(KEEL_MODE_ATTITUDE_VALID | KEEL_MODE_ALTITUDE_VALID | KEEL_MODE_POSITION_VALID);
    run(70u);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_ACRO, machine.mode);
    run(1u);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_POSITION, machine.mode);
}

static void MOD_009_return_without_a_position_holds_the_altitude(void)
{
    fly();
    clear(KEEL_MODE_POSITION_VALID);
    in.asked = KEEL_MODE_RETURN;
    run(100u);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_FLYING, machine.state);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_ALTITUDE, machine.mode);
}

static void MOD_009_alone_it_lands_rather_than_wait_for_a_throttle(void)
{
    lose_link();
    clear(KEEL_MODE_POSITION_VALID);
    run(1u);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_ALTITUDE, machine.mode);
    clear(KEEL_MODE_ALTITUDE_VALID);
    run(1u);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_LAND, machine.mode);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_HOLDING, machine.state);
}

static void MOD_010_kill_terminates_for_good(void)
{
    fly();
    set(KEEL_MODE_KILL_SWITCH_ON);
    expect_after(41u, KEEL_MODE_TERMINATED);
    TEST_ASSERT_FALSE(machine.motors);
    begin(&usual);
    arm();
    set(KEEL_MODE_KILL_SWITCH_ON);
    expect_after(41u, KEEL_MODE_TERMINATED);
    clear(KEEL_MODE_KILL_SWITCH_ON);
    set(KEEL_MODE_LANDED | KEEL_MODE_THROTTLE_LOW);
    switch_off();
    run(1000u);
    switch_on();
    run(1000u);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_TERMINATED, machine.state);
    TEST_ASSERT_EQUAL_HEX32(KEEL_MODE_KILL_SWITCH_ON, machine.cause);
}

static void MOD_010_kill_terminates_without_a_pilot(void)
{
    lose_link();
    set(KEEL_MODE_RC_LINKED | KEEL_MODE_KILL_SWITCH_ON);
    expect_after(41u, KEEL_MODE_TERMINATED);
}

static void MOD_011_alarms_lead_home_or_down(void)
{
    fly();
    set(KEEL_MODE_BATTERY_CRITICAL);
    expect_after(61u, KEEL_MODE_RETURNING);
    set(KEEL_MODE_BATTERY_EMPTY);
    expect_after(61u, KEEL_MODE_LANDING);
    TEST_ASSERT_EQUAL_HEX32(KEEL_MODE_BATTERY_CRITICAL | KEEL_MODE_BATTERY_EMPTY, machine.cause);
}

static void MOD_011_the_pilot_overrides_an_alarm(void)
{
    fly();
    set(KEEL_MODE_FENCE_BREACHED);
    expect_after(61u, KEEL_MODE_RETURNING);
    in.asked = KEEL_MODE_ANGLE;
    expect_after(32u, KEEL_MODE_FLYING);
    run(1000u);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_FLYING, machine.state);
    clear(KEEL_MODE_FENCE_BREACHED);
    run(1u);
    set(KEEL_MODE_FENCE_BREACHED); /* Another breach. */
    expect_after(61u, KEEL_MODE_RETURNING);
}

/* Sums of time stop at the greatest number: the link does not come back by itself. */
static void MOD_003_sums_of_time_do_not_wrap(void)
{
    run(150u);
    clear(KEEL_MODE_RC_LINKED);
    in.elapsed_us = UINT32_MAX;
    run(2u);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, machine.silence_us);
    in.elapsed_us = STEP_US;
    run(2u);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, machine.silence_us);
    TEST_ASSERT_FALSE(machine.ready);
    set(KEEL_MODE_RC_LINKED);
    run(100u);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, machine.state_us);
}

static void MOD_010_terminated_for_longer_than_can_be_counted(void)
{
    fly();
    set(KEEL_MODE_KILL_SWITCH_ON);
    run(60u);
    in.elapsed_us = UINT32_MAX;
    run(2u);
    TEST_ASSERT_EQUAL_UINT8(KEEL_MODE_TERMINATED, machine.state);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, machine.state_us);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(MOD_001_each_time_is_checked);
    RUN_TEST(MOD_001_ends_of_ranges_are_accepted);
    RUN_TEST(MOD_001_the_longest_silence_that_is_accepted);
    RUN_TEST(MOD_002_begins_disarmed);
    RUN_TEST(MOD_003_a_fact_counts_after_its_time);
    RUN_TEST(MOD_003_two_frames_do_not_count);
    RUN_TEST(MOD_003_silence_forgets_the_pilot);
    RUN_TEST(MOD_003_a_stall_begins_anew);
    RUN_TEST(MOD_003_a_frame_with_no_mode_is_none);
    RUN_TEST(MOD_003_sums_of_time_do_not_wrap);
    RUN_TEST(MOD_004_arms_when_switched_on);
    RUN_TEST(MOD_004_a_switch_that_was_never_off_arms_nothing);
    RUN_TEST(MOD_004_both_positions_are_neither);
    RUN_TEST(MOD_004_an_attempt_needs_off_before);
    RUN_TEST(MOD_005_each_refusal_is_named);
    RUN_TEST(MOD_005_a_mode_that_cannot_be_flown_refuses);
    RUN_TEST(MOD_005_without_a_link_that_is_named);
    RUN_TEST(MOD_006_the_switch_disarms_on_the_ground);
    RUN_TEST(MOD_006_the_switch_disarms_nothing_in_flight);
    RUN_TEST(MOD_006_false_landing_with_throttle_stops_nothing);
    RUN_TEST(MOD_006_lands_and_disarms);
    RUN_TEST(MOD_007_holds_returns_lands_disarms);
    RUN_TEST(MOD_007_returns_until_home);
    RUN_TEST(MOD_007_lands_where_it_cannot_return);
    RUN_TEST(MOD_007_lands_from_the_ground);
    RUN_TEST(MOD_008_link_that_is_back_resumes_nothing);
    RUN_TEST(MOD_008_taking_over_from_return_and_landing);
    RUN_TEST(MOD_009_gives_way_at_once_and_comes_back_later);
    RUN_TEST(MOD_009_return_without_a_position_holds_the_altitude);
    RUN_TEST(MOD_009_alone_it_lands_rather_than_wait_for_a_throttle);
    RUN_TEST(MOD_010_kill_terminates_for_good);
    RUN_TEST(MOD_010_kill_terminates_without_a_pilot);
    RUN_TEST(MOD_010_terminated_for_longer_than_can_be_counted);
    RUN_TEST(MOD_011_alarms_lead_home_or_down);
    RUN_TEST(MOD_011_the_pilot_overrides_an_alarm);
    return UNITY_END();
}
