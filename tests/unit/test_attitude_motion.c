/* SPDX-License-Identifier: Apache-2.0 */
/* The estimator of keel/flight/attitude.h against the truth: a vehicle that turns as it is told,
 * whose attitude is integrated in double precision, by the closed form of a turn at a constant
 * rate, and whose sensors see what that attitude gives. Nothing here is the estimator's own. */
#include "any.h"
#include "keel/flight/attitude.h"
#include "unity.h"

#include <math.h>
#include <string.h>

#define PI      3.14159265358979323846
#define RATE_HZ 1000.0
#define GRAVITY 9.80665
#define DEGREE  0.017453292519943295

typedef struct vector {
    double x, y, z;
} vector_t;

typedef struct quaternion {
    double w, x, y, z;
} quaternion_t;

static keel_attitude_config_t config;
static keel_attitude_t attitude;
static quaternion_t truth;    /* From body to Earth. */
static vector_t rate;         /* Of the body. */
static vector_t bias;         /* Of the gyroscope. */
static vector_t acceleration; /* Of the vehicle, in the Earth's frame. */
static double noise;          /* Of the accelerometer, in m/s^2, at most. */
static double field_noise;    /* Of the magnetometer, in microtesla, standard deviation. */
static double shake;          /* Amplitude of three tones of vibration, in m/s^2. */
static vector_t field;        /* Of the Earth. */
static bool knows;            /* Whether the estimator is told the acceleration. */
static uint32_t field_every;  /* A field sample in so many steps. */
static uint32_t steps;

/* What was left when it said that it had converged, in degrees, and how long the longest took. */
static double worst_tilt;
static double worst_whole;
static double longest_s;

/* The field in Zuerich, in microtesla: horizontal 21.6, 3 degrees east of north, 43.3 down. */
static const vector_t FIELD = {21.57, 1.13, 43.3};

/* From 0 to 1, with all of a double's bits. */
static double part(void)
{
    return (double)(any_64() >> 11) / 9007199254740992.0;
}

static double from_to(double low, double high)
{
    return low + ((high - low) * part());
}

static quaternion_t times(quaternion_t a, quaternion_t b)
{
    const quaternion_t product = {(a.w * b.w) - (a.x * b.x) - (a.y * b.y) - (a.z * b.z),
                                  (a.w * b.x) + (a.x * b.w) + (a.y * b.z) - (a.z * b.y),
                                  (a.w * b.y) - (a.x * b.z) + (a.y * b.w) + (a.z * b.x),
                                  (a.w * b.z) + (a.x * b.y) - (a.y * b.x) + (a.z * b.w)};

    return product;
}

static quaternion_t conjugate(quaternion_t q)
{
    const quaternion_t inverse = {q.w, -q.x, -q.y, -q.z};

    return inverse;
}

/* About an axis, of any length but 0, by an angle. */
static quaternion_t turn_about(double x, double y, double z, double angle)
{
    const double length = sqrt((x * x) + (y * y) + (z * z));
    const double s = sin(angle / 2.0) / length;
    const quaternion_t q = {cos(angle / 2.0), s * x, s * y, s * z};

    return q;
}

static vector_t to_body(quaternion_t q, vector_t v)
{
    const quaternion_t pure = {0.0, v.x, v.y, v.z};
    const quaternion_t turned = times(times(conjugate(q), pure), q);
    const vector_t result = {turned.x, turned.y, turned.z};

    return result;
}

/* Uniform over all attitudes (K. Shoemake). */
static quaternion_t any_attitude(void)
{
    const double u = part();
    const double a = 2.0 * PI * part();
    const double b = 2.0 * PI * part();
    const quaternion_t q = {sqrt(1.0 - u) * sin(a), sqrt(1.0 - u) * cos(a), sqrt(u) * sin(b),
                            sqrt(u) * cos(b)};

    return q;
}

static quaternion_t estimate(void)
{
    const quaternion_t q = {(double)attitude.quaternion.w, (double)attitude.quaternion.x,
                            (double)attitude.quaternion.y, (double)attitude.quaternion.z};

    return q;
}

/* The angle between the two downs, in degrees. */
static double tilt_error(void)
{
    const vector_t down = {0.0, 0.0, 1.0};
    const vector_t a = to_body(truth, down);
    const vector_t b = to_body(estimate(), down);
    const double s = hypot(hypot((a.y * b.z) - (a.z * b.y), (a.z * b.x) - (a.x * b.z)),
                           (a.x * b.y) - (a.y * b.x));

    return atan2(s, (a.x * b.x) + (a.y * b.y) + (a.z * b.z)) / DEGREE;
}

/* The angle of the turn from the estimate to the truth, in degrees. */
static double whole_error(void)
{
    const quaternion_t d = times(conjugate(truth), estimate());

    return 2.0 * atan2(sqrt((d.x * d.x) + (d.y * d.y) + (d.z * d.z)), fabs(d.w)) / DEGREE;
}

static keel_attitude_vector_t single(vector_t v)
{
    const keel_attitude_vector_t result = {(float)v.x, (float)v.y, (float)v.z};

    return result;
}

static void near(double within, double expected, double value)
{
    TEST_ASSERT_TRUE(fabs(value - expected) <= within);
}

/* Normally distributed: the sum of twelve that are uniform has the variance 1. */
static double normal(void)
{
    double sum = -6.0;

    for (uint32_t n = 0u; n < 12u; n++) {
        sum += part();
    }
    return sum;
}

static vector_t noisy(vector_t v)
{
    const vector_t changed = {v.x + (field_noise * normal()), v.y + (field_noise * normal()),
                              v.z + (field_noise * normal())};

    return (field_noise > 0.0) ? changed : v;
}

static void step(void)
{
    const vector_t force = {acceleration.x, acceleration.y, acceleration.z - GRAVITY};
    const vector_t turning = {rate.x + bias.x, rate.y + bias.y, rate.z + bias.z};
    const double fast = sqrt((rate.x * rate.x) + (rate.y * rate.y) + (rate.z * rate.z));
    keel_attitude_sample_t sample;
    vector_t felt;

    memset(&sample, 0, sizeof sample);
    if (fast > 0.0) {
        truth = times(truth, turn_about(rate.x, rate.y, rate.z, fast / RATE_HZ));
    }
    felt = to_body(truth, force);
    felt.x += noise * from_to(-1.0, 1.0);
    felt.y += noise * from_to(-1.0, 1.0);
    felt.z += noise * from_to(-1.0, 1.0);
    felt.x += shake * sin(2.0 * PI * 87.0 * (double)steps / RATE_HZ);
    felt.y += shake * sin(2.0 * PI * 131.0 * (double)steps / RATE_HZ);
    felt.z += shake * sin(2.0 * PI * 173.0 * (double)steps / RATE_HZ);
    sample.gyroscope = single(turning);
    sample.accelerometer = single(felt);
    sample.magnetometer = single(noisy(to_body(truth, field)));
    sample.acceleration = single(acceleration);
    sample.has_gyroscope = true;
    sample.has_accelerometer = true;
    sample.has_magnetometer = (steps % field_every) == 0u;
    sample.has_acceleration = knows;
    keel_attitude_step(&attitude, &sample);
    steps++;
}

static void run(double seconds)
{
    for (uint32_t n = (uint32_t)(seconds * RATE_HZ); n > 0u; n--) {
        step();
    }
}

static void begin(void)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_attitude_init(&attitude, &config));
}

/* Running, with a valid heading and no error but what is asked for, at rest. */
static void begin_settled(quaternion_t at)
{
    truth = at;
    begin();
    run(12.0);
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_RUNNING, attitude.phase);
    TEST_ASSERT_TRUE(attitude.heading_valid);
}

void setUp(void)
{
    const keel_attitude_config_t usual = {.rate_hz = (float)RATE_HZ,
                                          .tilt_gain = 0.5f,
                                          .heading_gain = 0.5f,
                                          .align_gain = 8.0f,
                                          .bias_gain = 0.02f,
                                          .force_gain = 0.5f,
                                          .field_share = 0.0625f,
                                          .bias_limit = 0.1f,
                                          .quiet_rate = 0.3f,
                                          .clip_rate = 34.0f,
                                          .still_rate = 0.05f,
                                          .still_acceleration = 0.5f,
                                          .tolerance = 0.02f,
                                          .north = (float)FIELD.x,
                                          .east = (float)FIELD.y,
                                          .still_steps = 1000u,
                                          .settle_steps = 200u,
                                          .lost_steps = 10u,
                                          .field_steps = 100u};
    const vector_t zero = {0.0, 0.0, 0.0};

    config = usual;
    any_from(20261122u);
    truth = turn_about(1.0, 0.0, 0.0, 0.0);
    rate = zero;
    bias = zero;
    acceleration = zero;
    noise = 0.0;
    field_noise = 0.0;
    shake = 0.0;
    field = FIELD;
    knows = false;
    field_every = 10u;
    steps = 0u;
    worst_tilt = 0.0;
    worst_whole = 0.0;
    longest_s = 0.0;
}

void tearDown(void)
{
}

static void converges(quaternion_t from)
{
    bool running = false;
    double seconds = 0.0;

    truth = from;
    begin();
    while (!attitude.heading_valid && (seconds < 20.0)) {
        step();
        seconds += 1.0 / RATE_HZ;
        if (!running && (attitude.phase == KEEL_ATTITUDE_RUNNING)) {
            running = true;
            worst_tilt = fmax(worst_tilt, tilt_error());
        }
    }
    TEST_ASSERT_TRUE(running);
    TEST_ASSERT_TRUE(attitude.heading_valid);
    worst_whole = fmax(worst_whole, whole_error());
    longest_s = fmax(longest_s, seconds);
}

/* The tolerance, a sine of 0.02, is 1.15 degrees; in tilt and in heading that is 1.63 at most. */
static void ATT_017_converges_from_any_attitude(void)
{
    for (uint32_t n = 0u; n < 300u; n++) {
        converges(any_attitude());
    }
    TEST_ASSERT_TRUE(worst_tilt < 1.15);
    TEST_ASSERT_TRUE(worst_whole < 1.63);
    TEST_ASSERT_TRUE(longest_s < 5.0);
}

/* Level is where it begins. Half a turn away from there the sines that it goes by are 0. */
static void ATT_017_converges_from_half_a_turn_away(void)
{
    converges(turn_about(1.0, 0.0, 0.0, PI));
    converges(turn_about(0.0, 1.0, 0.0, PI));
    converges(turn_about(0.0, 0.0, 1.0, PI));
    converges(turn_about(1.0, 1.0, 0.0, PI));
    converges(turn_about(0.0, 1.0, 0.0, PI / 2.0));
    converges(turn_about(0.0, 1.0, 0.0, -PI / 2.0));
    TEST_ASSERT_TRUE(worst_tilt < 1.15);
    TEST_ASSERT_TRUE(worst_whole < 1.63);
    TEST_ASSERT_TRUE(longest_s < 5.0);
}

/* Vibration of 0.15 m/s^2 on each axis is a sine of 0.026 at most; the tolerance is 0.05. */
static void ATT_017_converges_with_noise_and_biases(void)
{
    noise = 0.15;
    bias.x = 0.02;
    bias.y = -0.03;
    bias.z = 0.05;
    config.tolerance = 0.05f;
    for (uint32_t n = 0u; n < 100u; n++) {
        converges(any_attitude());
        near(0.0005, bias.x, (double)attitude.bias.x);
        near(0.0005, bias.y, (double)attitude.bias.y);
        near(0.0005, bias.z, (double)attitude.bias.z);
    }
    TEST_ASSERT_TRUE(worst_tilt < 2.9);
    TEST_ASSERT_TRUE(worst_whole < 4.1);
    TEST_ASSERT_TRUE(longest_s < 8.0);
}

/* In flight there is no stillness: tilt and heading come back while it turns slowly. */
static void ATT_017_comes_back_while_it_turns(void)
{
    begin_settled(turn_about(0.0, 0.0, 1.0, 2.0));
    truth = any_attitude();
    rate.x = 0.4;
    rate.y = -0.3;
    rate.z = 0.2;
    run(20.0);
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_RUNNING, attitude.phase);
    TEST_ASSERT_TRUE(attitude.heading_valid);
    TEST_ASSERT_TRUE(whole_error() < 0.5);
}

/* A gyroscope's bias that drifts away after the calibration is followed, as far as its limit. */
static void ATT_012_a_drift_is_followed(void)
{
    config.tilt_gain = 1.0f;
    config.heading_gain = 1.0f;
    config.bias_gain = 0.25f;
    begin_settled(turn_about(1.0, 2.0, 3.0, 0.5));
    bias.x = 0.03;
    bias.y = -0.02;
    bias.z = 0.01;
    run(40.0);
    near(0.0003, bias.x, (double)attitude.bias.x);
    near(0.0003, bias.y, (double)attitude.bias.y);
    near(0.0003, bias.z, (double)attitude.bias.z);
    TEST_ASSERT_TRUE(whole_error() < 0.1);
    bias.x = 0.2;
    run(40.0);
    TEST_ASSERT_EQUAL_FLOAT(0.1f, attitude.bias.x);
}

/* An attitude is reached by many small turns. Of an angle 2 |h| a step turns 2 atan |h|, which is
 * short of it by |h|^2 / 3: at 12.85 rad/s and 1000 Hz 1.38e-5, 0.605 degrees in the 771 rad of a
 * minute. What rounding adds must be far below. */
static void ATT_018_turns_as_far_as_the_rate_says(void)
{
    config.tilt_gain = 0.0f;
    config.heading_gain = 0.0f;
    config.bias_gain = 0.0f;
    begin_settled(turn_about(0.0, 0.0, 1.0, 0.7));
    rate.x = 10.0;
    rate.y = -7.0;
    rate.z = 4.0;
    run(60.0);
    near(0.01, 0.605, whole_error());
}

static void ATT_018_follows_lively_motion(void)
{
    double worst = 0.0;

    begin_settled(turn_about(0.0, 0.0, 1.0, 0.7));
    for (uint32_t n = 0u; n < 60000u; n++) {
        const double t = (double)n / RATE_HZ;

        rate.x = 3.0 * sin(2.0 * PI * 0.5 * t);
        rate.y = 2.0 * cos(2.0 * PI * 0.7 * t);
        rate.z = 1.0 * sin(2.0 * PI * 0.3 * t);
        step();
        worst = fmax(worst, whole_error());
    }
    TEST_ASSERT_TRUE(worst < 0.2);
}

/* Half a minute of thrust that is 20 degrees off gravity. */
static void accelerated(void)
{
    begin_settled(turn_about(0.0, 0.0, 1.0, 0.7));
    acceleration.x = GRAVITY * tan(20.0 * DEGREE);
    run(30.0);
}

/* What cannot be seen is not seen: |f| is 1.064 g, within the gate. */
static void ATT_007_untold_acceleration_is_taken_for_tilt(void)
{
    accelerated();
    near(1.0, 20.0, tilt_error());
}

static void ATT_007_acceleration_that_is_told_is_none(void)
{
    knows = true;
    accelerated();
    TEST_ASSERT_TRUE(whole_error() < 0.1);
}

/* The estimator in a plane, without bias, in double precision: the angle by which it is off, and
 * down as low-passed. An independent oracle of low pass, gate and turning along. */
typedef struct plane {
    double angle;
    double across; /* Of down as low-passed. */
    double along;
} plane_t;

static void plane_step(plane_t *plane, double forward_g)
{
    const double t = 1.0 / RATE_HZ;
    const double k = 0.5; /* force_gain and tilt_gain */
    /* The force without its sign, (-forward_g, 1), as seen from the frame that is off. */
    const double across = (-forward_g * cos(plane->angle)) - sin(plane->angle);
    const double along = cos(plane->angle) - (forward_g * sin(plane->angle));
    double square;

    plane->across += k * t * (across - plane->across);
    plane->along += k * t * (along - plane->along);
    square = (plane->across * plane->across) + (plane->along * plane->along);
    if ((square >= 0.71875) && (square <= 1.3203125)) {
        const double turn = k * t * plane->across;
        const double before = plane->across;

        plane->angle += turn;
        plane->across -= turn * plane->along;
        plane->along += turn * before;
    }
}

/* 1.41 g for half a minute: it is taken for tilt until the low pass is beyond 1.149 g, and no
 * longer; the oracle says how far it comes. */
static void ATT_006_hard_acceleration_leads_only_so_far(void)
{
    plane_t plane = {0.0, 0.0, 1.0};
    double worst = 0.0;

    config.bias_gain = 0.0f;
    begin_settled(turn_about(0.0, 0.0, 1.0, 0.0));
    acceleration.x = GRAVITY;
    for (uint32_t n = 0u; n < 30000u; n++) {
        step();
        plane_step(&plane, 1.0);
        worst = fmax(worst, fabs(tilt_error() - (fabs(plane.angle) / DEGREE)));
    }
    TEST_ASSERT_TRUE(worst < 0.1);
    TEST_ASSERT_TRUE(fabs(plane.angle) < (20.0 * DEGREE));
}

/* To and fro at 1 Hz with 3 m/s^2, as no gate of single samples bears: two low passes of 0.5/s one
 * behind the other leave 3 / g x 0.25 / ((2 pi)^2 + 0.25) = 0.00193 of it, 0.110 degrees, and a
 * bias that follows a little more. */
static void ATT_018_accelerations_that_end_leave_little(void)
{
    double worst = 0.0;

    begin_settled(turn_about(0.0, 0.0, 1.0, 0.7));
    for (uint32_t n = 0u; n < 60000u; n++) {
        acceleration.x = 3.0 * cos(2.0 * PI * (double)n / RATE_HZ);
        step();
        worst = (n < 30000u) ? 0.0 : fmax(worst, tilt_error());
    }
    near(0.02, 0.110, worst);
}

/* Six times gravity at its peak, on all axes. */
static void ATT_018_vibration_is_borne(void)
{
    double worst = 0.0;

    begin_settled(turn_about(0.0, 0.0, 1.0, 0.7));
    shake = 30.0;
    for (uint32_t n = 0u; n < 60000u; n++) {
        rate.x = 0.8 * sin(2.0 * PI * 0.5 * (double)n / RATE_HZ);
        rate.y = 0.6 * cos(2.0 * PI * 0.7 * (double)n / RATE_HZ);
        step();
        worst = fmax(worst, whole_error());
        TEST_ASSERT_EQUAL(KEEL_ATTITUDE_RUNNING, attitude.phase);
        TEST_ASSERT_TRUE(attitude.heading_valid);
        TEST_ASSERT_TRUE((attitude.flags & KEEL_ATTITUDE_DOWN) != 0u);
    }
    TEST_ASSERT_TRUE(worst < 0.3);
}

/* The gyroscope warms up by 0.02 rad/s in 80 s. While the bias follows, it lags by a constant error
 * of down's, E = ramp / bias_gain = 0.005, and the attitude by 1 + tilt_gain / force_gain = 2 of
 * that, 0.573 degrees; the bias itself by tilt_gain E = 0.0025. */
static void ATT_012_a_bias_is_learnt_in_flight(void)
{
    double worst = 0.0;

    config.bias_gain = 0.05f;
    begin_settled(turn_about(0.0, 0.0, 1.0, 0.7));
    for (uint32_t n = 0u; n < 80000u; n++) {
        bias.y = 0.00025 * (double)n / RATE_HZ;
        rate.z = 0.2 * sin(2.0 * PI * 0.2 * (double)n / RATE_HZ);
        step();
        worst = fmax(worst, whole_error());
        if (n == 79999u) {
            near(0.06, 0.573, tilt_error());
        }
    }
    TEST_ASSERT_TRUE(worst < 2.0);
    near(0.0003, 0.0175, (double)attitude.bias.y);
}

/* A weak field, steep as far north, with noise of a sine of 0.147: single samples are within the
 * tolerance of 0.05 one time in four. */
static void ATT_015_a_heading_of_noisy_samples(void)
{
    double worst = 0.0;

    config.tolerance = 0.05f;
    config.field_share = 0.015625f;
    config.north = 15.0f;
    config.east = 0.0f;
    field.x = 15.0;
    field.y = 0.0;
    field_noise = 2.2;
    begin();
    run(10.0);
    TEST_ASSERT_TRUE(attitude.heading_valid);
    for (uint32_t n = 0u; n < 120000u; n++) {
        step();
        TEST_ASSERT_TRUE(attitude.heading_valid);
        worst = fmax(worst, whole_error());
    }
    TEST_ASSERT_TRUE(worst < 2.0);
}

/* The length stays within its proved bounds at any rate, at the least steps per second. */
static void ATT_010_length_stays_for_ever(void)
{
    keel_attitude_sample_t sample;
    double least = 1.0;
    double most = 1.0;

    config.rate_hz = 500.0f;
    begin();
    memset(&sample, 0, sizeof sample);
    sample.has_gyroscope = true;
    for (uint32_t n = 0u; n < 300000u; n++) {
        const quaternion_t q = estimate();
        const double square = (q.w * q.w) + (q.x * q.x) + (q.y * q.y) + (q.z * q.z);
        const double reach = (n < 100000u) ? 0.01 : 40.0;

        least = fmin(least, square);
        most = fmax(most, square);
        sample.gyroscope.x = (float)from_to(-reach, reach);
        sample.gyroscope.y = (n < 200000u) ? (float)from_to(-reach, reach) : 40.0f;
        sample.gyroscope.z = (n < 200000u) ? (float)from_to(-reach, reach) : -40.0f;
        keel_attitude_step(&attitude, &sample);
        TEST_ASSERT_EQUAL_UINT32(0u, attitude.flags & KEEL_ATTITUDE_CORRUPTED);
    }
    TEST_ASSERT_TRUE(least > 1.0 - 1.30e-4);
    TEST_ASSERT_TRUE(most < 1.0 + 7.7e-6);
    TEST_ASSERT_TRUE(least < 1.0 - 1.0e-6); /* The rates are such that Newton's step matters. */
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(ATT_006_hard_acceleration_leads_only_so_far);
    RUN_TEST(ATT_007_untold_acceleration_is_taken_for_tilt);
    RUN_TEST(ATT_007_acceleration_that_is_told_is_none);
    RUN_TEST(ATT_010_length_stays_for_ever);
    RUN_TEST(ATT_012_a_drift_is_followed);
    RUN_TEST(ATT_012_a_bias_is_learnt_in_flight);
    RUN_TEST(ATT_015_a_heading_of_noisy_samples);
    RUN_TEST(ATT_017_converges_from_any_attitude);
    RUN_TEST(ATT_017_converges_from_half_a_turn_away);
    RUN_TEST(ATT_017_converges_with_noise_and_biases);
    RUN_TEST(ATT_017_comes_back_while_it_turns);
    RUN_TEST(ATT_018_turns_as_far_as_the_rate_says);
    RUN_TEST(ATT_018_follows_lively_motion);
    RUN_TEST(ATT_018_accelerations_that_end_leave_little);
    RUN_TEST(ATT_018_vibration_is_borne);
    return UNITY_END();
}
