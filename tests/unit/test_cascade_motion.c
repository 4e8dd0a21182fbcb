/* SPDX-License-Identifier: Apache-2.0 */
/* The cascade in closed loop with a point mass that tilts, in double precision: it holds and
 * reaches places, does not jump when modes change, and stays inside of the fence (CAS-012 as far as
 * a test goes: the plant is one, and is known to keep A-34). */
#include "any.h"
#include "cascades.h"

#define GRAVITY 9.80665
#define PI      3.14159265358979

/* Turned by Euler angles: yaw, pitch, roll. Positions and velocities are north, east and up. */
typedef struct plant {
    double position[3];
    double velocity[3];
    double wind[3]; /* m/s^2 */
    double roll;
    double pitch;
    double yaw;
    double rate[3];
} plant_t;

static plant_t plant;
static keel_cascade_rates_t pilot;    /* Taken in ACRO. */
static keel_cascade_tilt_t leaning;   /* Taken in ANGLE and ALTITUDE. */
static keel_cascade_vector_t going;   /* Taken in POSITION where it is flown by speeds. */
static keel_cascade_vector_t place;   /* Taken in RETURN. */
static keel_cascade_tilt_t last_tilt; /* For the greatest jump between steps. */
static float jump;
static uint32_t milliseconds;

static keel_pid_config_t loop(float kp, float ki, float rate_hz, float most)
{
    keel_pid_config_t pid = controller(kp, ki, rate_hz, -most, most);

    pid.integral_min = -most;
    pid.integral_max = most;
    return pid;
}

void setUp(void)
{
    static const float reach[AXES] = {6.0f, 6.0f, 3.0f,  0.5f,  0.5f, 8.0f,
                                      8.0f, 3.0f, 30.0f, 25.0f, 20.0f};

    any_from(20241130u);
    memset(&plant, 0, sizeof plant);
    configure();
    memset(&pilot, 0, sizeof pilot);
    memset(&leaning, 0, sizeof leaning);
    memset(&going, 0, sizeof going);
    memset(&place, 0, sizeof place);
    memcpy(config.reach, reach, sizeof reach);
    for (uint32_t i = KEEL_CASCADE_ROLL_RATE; i <= KEEL_CASCADE_YAW_RATE; i++) {
        config.pid[i] = loop(0.3f, 0.6f, 1000.0f, 1.0f);
    }
    config.pid[KEEL_CASCADE_ROLL] = loop(8.0f, 0.0f, 500.0f, 5.0f);
    config.pid[KEEL_CASCADE_PITCH] = loop(8.0f, 0.0f, 500.0f, 5.0f);
    config.pid[KEEL_CASCADE_NORTH_SPEED] = loop(2.0f, 0.6f, 100.0f, 3.4f);
    config.pid[KEEL_CASCADE_EAST_SPEED] = loop(2.0f, 0.6f, 100.0f, 3.4f);
    config.pid[KEEL_CASCADE_CLIMB] = loop(0.2f, 0.1f, 100.0f, 0.3f);
    config.pid[KEEL_CASCADE_NORTH] = loop(0.7f, 0.0f, 50.0f, 6.0f);
    config.pid[KEEL_CASCADE_EAST] = loop(0.7f, 0.0f, 50.0f, 6.0f);
    config.pid[KEEL_CASCADE_HEIGHT] = loop(0.8f, 0.0f, 50.0f, 2.5f);
    config.hover = 0.375f;
    config.acceleration = 4.0f;
    config.braking = 1.5f;
    config.reaction_s = 0.5f;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_cascade_init(&cascade, &config));
    milliseconds = 0u;
    pilot.thrust = 0.375f;
}

void tearDown(void)
{
}

/* A millisecond of the plant: torques turn it, with a little damping; thrust pushes it. */
static void move(void)
{
    const double dt = 0.001;
    const keel_mixer_command_t *const command = &cascade.command;
    const double torque[3] = {command->roll, command->pitch, command->yaw};
    const double push = GRAVITY * command->thrust / 0.375;
    const double forward = -push * sin(plant.pitch) * cos(plant.roll);
    const double right = push * sin(plant.roll);
    const double acceleration[3] = {(forward * cos(plant.yaw)) - (right * sin(plant.yaw)),
                                    (forward * sin(plant.yaw)) + (right * cos(plant.yaw)),
                                    (push * cos(plant.pitch) * cos(plant.roll)) - GRAVITY};

    for (uint32_t i = 0u; i < 3u; i++) {
        plant.rate[i] += dt * ((80.0 * torque[i]) - (2.0 * plant.rate[i]));
        plant.velocity[i] += dt * (acceleration[i] + plant.wind[i]);
        plant.position[i] += dt * plant.velocity[i];
    }
    plant.roll += dt * plant.rate[0];
    plant.pitch += dt * plant.rate[1];
    plant.yaw += dt * plant.rate[2];
}

static keel_cascade_estimate_t seen(void)
{
    const keel_cascade_estimate_t estimate = {
        .position = {(float)plant.position[0], (float)plant.position[1], (float)plant.position[2]},
        .velocity = {(float)plant.velocity[0], (float)plant.velocity[1], (float)plant.velocity[2]},
        .forward_north = (float)(cos(plant.yaw) * cos(plant.pitch)),
        .forward_east = (float)(sin(plant.yaw) * cos(plant.pitch)),
        .has_place = true,
        .has_height = true};

    return estimate;
}

/* The tasks of a millisecond, each stage at its own rate. */
static void control(uint8_t mode)
{
    const keel_cascade_estimate_t estimate = seen();
    const keel_attitude_vector_t rate = {(float)plant.rate[0], (float)plant.rate[1],
                                         (float)plant.rate[2]};
    const keel_attitude_vector_t down = {(float)-sin(plant.pitch),
                                         (float)(sin(plant.roll) * cos(plant.pitch)),
                                         (float)(cos(plant.roll) * cos(plant.pitch))};
    const bool alone = mode == KEEL_MODE_RETURN;
    const bool speeds = alone || (mode == KEEL_MODE_POSITION);
    keel_cascade_rates_t rates = pilot;

    keel_cascade_enter(&cascade, mode);
    if (alone && ((milliseconds % 20u) == 0u)) {
        keel_cascade_position_step(&cascade, place, &estimate);
    }
    if (speeds && ((milliseconds % 10u) == 0u)) {
        keel_cascade_velocity_step(&cascade, alone ? cascade.velocity : going, &estimate);
    }
    if ((mode != KEEL_MODE_ACRO) && ((milliseconds % 2u) == 0u)) {
        keel_cascade_angle_step(&cascade, speeds ? cascade.tilt : leaning, down, true);
    }
    if (mode != KEEL_MODE_ACRO) {
        rates.roll = cascade.rates.roll;
        rates.pitch = cascade.rates.pitch;
    }
    rates.thrust = speeds ? cascade.thrust : pilot.thrust;
    keel_cascade_rate_step(&cascade, rates, rate, 0u);
    milliseconds++;
}

static void fly(uint8_t mode, uint32_t seconds)
{
    jump = 0.0f;
    for (uint32_t i = 0u; i < (1000u * seconds); i++) {
        last_tilt = cascade.tilt;
        control(mode);
        jump = fmaxf(jump, fabsf(cascade.tilt.roll - last_tilt.roll));
        jump = fmaxf(jump, fabsf(cascade.tilt.pitch - last_tilt.pitch));
        move();
    }
}

static void is_about(double within, double expected, double value)
{
    TEST_ASSERT_FLOAT_WITHIN((float)within, (float)expected, (float)value);
}

static void CAS_013_reaches_a_place(void)
{
    const double want[3] = {12.0, -9.0, 6.0};

    place = (keel_cascade_vector_t){12.0f, -9.0f, 6.0f};
    plant.yaw = 1.0;
    plant.wind[0] = 0.5;
    plant.wind[1] = -0.25;
    fly(KEEL_MODE_RETURN, 30u);
    for (uint32_t i = 0u; i < 3u; i++) {
        is_about(0.05, want[i], plant.position[i]);
        is_about(0.02, 0.0, plant.velocity[i]);
    }
}

static void CAS_010_flies_by_speeds_in_any_heading(void)
{
    for (uint32_t i = 0u; i < 8u; i++) {
        setUp();
        plant.yaw = (PI / 4.0) * (double)i;
        pilot.yaw = 0.2f;
        going = (keel_cascade_vector_t){2.0f, -1.0f, 0.5f};
        fly(KEEL_MODE_POSITION, 12u);
        is_about(0.1, 2.0, plant.velocity[0]);
        is_about(0.1, -1.0, plant.velocity[1]);
        is_about(0.05, 0.5, plant.velocity[2]);
    }
}

/* Leaning, the velocity stage takes over: the first tilt that it asks for is the one flown. */
static void CAS_007_no_jump_between_modes(void)
{
    leaning = (keel_cascade_tilt_t){0.2f, -0.1f};
    fly(KEEL_MODE_ANGLE, 1u);
    cascade.tilt = leaning;
    going = (keel_cascade_vector_t){(float)plant.velocity[0], (float)plant.velocity[1],
                                    (float)plant.velocity[2]};
    fly(KEEL_MODE_POSITION, 1u);
    TEST_ASSERT_TRUE(jump < 0.01f); /* Without it, 0.2. */
    is_about(0.7, (double)going.north, plant.velocity[0]);
}

/* Full speed towards all sides, in wind that pushes that way. */
static void CAS_012_stays_inside_of_the_fence(void)
{
    for (uint32_t i = 0u; i < 8u; i++) {
        const double sign = ((i & 1u) != 0u) ? -1.0 : 1.0;
        const double gust = ((i & 2u) != 0u) ? 0.4 : 0.0;
        double most[3] = {0.0, 0.0, 0.0};

        setUp();
        plant.yaw = ((i & 4u) != 0u) ? 0.6 : 0.0;
        going = (keel_cascade_vector_t){(float)(8.0 * sign), (float)(8.0 * sign),
                                        (float)(3.0 * sign)};
        plant.wind[0] = gust * sign;
        plant.wind[1] = gust * sign;
        plant.wind[2] = gust * sign;
        for (uint32_t tenth = 0u; tenth < 30u; tenth++) {
            fly(KEEL_MODE_POSITION, 1u);
            for (uint32_t k = 0u; k < 3u; k++) {
                most[k] = fmax(most[k], plant.position[k] * sign);
            }
        }
        for (uint32_t k = 0u; k < 3u; k++) {
            const double side = config.reach[KEEL_CASCADE_NORTH + k];

            TEST_ASSERT_TRUE(most[k] <= side);
            TEST_ASSERT_TRUE(most[k] > (side - 4.0));
        }
    }
}

/* The law by itself: a double integrator that does the worst that A-34 allows, at random times,
 * while no side is near, and brakes by no more than it must from when one is. */
static void CAS_012_the_law_in_the_worst_case(void)
{
    const float delay = 0.4f; /* The reaction time less a period of 0.1 s. */
    uint32_t braked = 0u;

    TEST_ASSERT_EQUAL_FLOAT(0.5f, cascade.fence.reaction_s);
    keel_cascade_enter(&cascade, KEEL_MODE_POSITION);
    for (uint32_t run = 0u; run < 200u; run++) {
        double x = (double)between(-20.0f, 20.0f);
        double v = 0.0;
        double braking_at = 1.0e9;

        for (uint32_t n = 0u; n < 40000u; n++) {
            const double t = 0.001 * (double)n;
            double u = one_in(3u) ? (double)between(-4.0f, 4.0f) : 4.0;

            if ((n % 100u) == 0u) {
                const keel_cascade_vector_t asked = {8.0f, 0.0f, 0.0f};
                const keel_cascade_estimate_t estimate = {.position = {(float)x, 0.0f, 0.0f},
                                                          .velocity = {(float)v, 0.0f, 0.0f},
                                                          .forward_north = 1.0f,
                                                          .has_place = true};

                keel_cascade_velocity_step(&cascade, asked, &estimate);
                if (!cascade.axis[KEEL_CASCADE_NORTH_SPEED].limit.at_max ||
                    (cascade.axis[KEEL_CASCADE_NORTH_SPEED].pid.setpoint > 0.0f)) {
                    braking_at = 1.0e9;
                } else if (braking_at > 1.0e8) {
                    braking_at = t + (double)delay;
                    braked++;
                } else {
                    /* It brakes already, or will. */
                }
            }
            if (t >= braking_at) {
                u = (v > 0.0) ? -1.5 : 0.0;
            }
            x += (0.001 * v) + (0.0000005 * u);
            v += 0.001 * u;
            v = ((t >= braking_at) && (v < 0.0)) ? 0.0 : v;
            TEST_ASSERT_TRUE(x <= 30.001);
            if (one_in(20000u)) {
                x -= 10.0;
                v = 0.0;
                braking_at = 1.0e9;
            }
        }
    }
    TEST_ASSERT_GREATER_THAN_UINT32(400u, braked);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(CAS_013_reaches_a_place);
    RUN_TEST(CAS_010_flies_by_speeds_in_any_heading);
    RUN_TEST(CAS_007_no_jump_between_modes);
    RUN_TEST(CAS_012_stays_inside_of_the_fence);
    RUN_TEST(CAS_012_the_law_in_the_worst_case);
    return UNITY_END();
}
