/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/flight/attitude.h"

#include "keel/middleware/range.h"

/* 1 / g, to single precision: standard gravity is 9.80665 m/s^2 (CGPM 1901). */
#define PER_GRAVITY 0.101971618831157684326171875f

/* North, east and down as the body sees them: the rows of the matrix of a quaternion. */
typedef struct axes {
    keel_attitude_vector_t north;
    keel_attitude_vector_t east;
    keel_attitude_vector_t down;
} axes_t;

/*@ requires \is_finite(most);
  @ assigns \nothing;
  @ ensures \result <==> attitude_within(v, most);
  @*/
static bool is_within(keel_attitude_vector_t v, float most)
{
    return keel_range_contains(v.x, -most, most) && keel_range_contains(v.y, -most, most) &&
           keel_range_contains(v.z, -most, most);
}

/*@ assigns \nothing; */
static float dot_product(keel_attitude_vector_t a, keel_attitude_vector_t b)
{
    return ((a.x * b.x) + (a.y * b.y)) + (a.z * b.z);
}

/*@ assigns \nothing; */
static keel_attitude_vector_t cross_product(keel_attitude_vector_t a, keel_attitude_vector_t b)
{
    const keel_attitude_vector_t product = {(a.y * b.z) - (a.z * b.y), (a.z * b.x) - (a.x * b.z),
                                            (a.x * b.y) - (a.y * b.x)};

    return product;
}

/* a + k b. */
/*@ assigns \nothing; */
static keel_attitude_vector_t add_scaled(keel_attitude_vector_t a, float k,
                                         keel_attitude_vector_t b)
{
    const keel_attitude_vector_t sum = {a.x + (k * b.x), a.y + (k * b.y), a.z + (k * b.z)};

    return sum;
}

/*@ assigns \nothing; */
static keel_attitude_vector_t scaled_vector(float k, keel_attitude_vector_t a)
{
    const keel_attitude_vector_t product = {k * a.x, k * a.y, k * a.z};

    return product;
}

/*@ assigns \nothing; */
static keel_attitude_vector_t vector_difference(keel_attitude_vector_t a, keel_attitude_vector_t b)
{
    const keel_attitude_vector_t rest = {a.x - b.x, a.y - b.y, a.z - b.z};

    return rest;
}

/*@ requires \is_finite(most) && 0 <= most;
  @ assigns \nothing;
  @ ensures attitude_within(\result, most);
  @*/
static keel_attitude_vector_t clamped_vector(keel_attitude_vector_t a, float most)
{
    const keel_attitude_vector_t near = {keel_range_clamp(a.x, -most, most),
                                         keel_range_clamp(a.y, -most, most),
                                         keel_range_clamp(a.z, -most, most)};

    return near;
}

/*@ assigns \nothing; */
static axes_t axes_of(keel_attitude_quaternion_t q)
{
    const float x2 = q.x + q.x;
    const float y2 = q.y + q.y;
    const float z2 = q.z + q.z;
    const float xx = q.x * x2;
    const float yy = q.y * y2;
    const float zz = q.z * z2;
    const float xy = q.x * y2;
    const float xz = q.x * z2;
    const float yz = q.y * z2;
    const float wx = q.w * x2;
    const float wy = q.w * y2;
    const float wz = q.w * z2;
    const axes_t axes = {{1.0f - (yy + zz), xy - wz, xz + wy},
                         {xy + wz, 1.0f - (xx + zz), yz - wx},
                         {xz - wy, yz + wx, 1.0f - (xx + yy)}};

    return axes;
}

/* A vector of the body's in the Earth's frame. */
/*@ requires \valid_read(axes);
  @ assigns \nothing;
  @*/
static keel_attitude_vector_t to_earth(const axes_t *axes, keel_attitude_vector_t v)
{
    const keel_attitude_vector_t seen = {dot_product(axes->north, v), dot_product(axes->east, v),
                                         dot_product(axes->down, v)};

    return seen;
}

/* And back. */
/*@ requires \valid_read(axes);
  @ assigns \nothing;
  @*/
static keel_attitude_vector_t to_body(const axes_t *axes, keel_attitude_vector_t v)
{
    return add_scaled(add_scaled(scaled_vector(v.x, axes->north), v.y, axes->east), v.z,
                      axes->down);
}

/* A first-order low pass. */
/*@ assigns \nothing; */
static keel_attitude_vector_t low_passed(keel_attitude_vector_t a, float share,
                                         keel_attitude_vector_t sample)
{
    return add_scaled(a, share, vector_difference(sample, a));
}

/* q turned by the half angles h, and led back to length 1. From this text, proofs/attitude/norm.g
 * bounds what rounding does to its length. */
/*@ assigns \nothing; */
static keel_attitude_quaternion_t turned_quaternion(keel_attitude_quaternion_t q,
                                                    keel_attitude_vector_t h)
{
    const float w = q.w - (((q.x * h.x) + (q.y * h.y)) + (q.z * h.z));
    const float x = q.x + (((q.w * h.x) + (q.y * h.z)) - (q.z * h.y));
    const float y = q.y + (((q.w * h.y) - (q.x * h.z)) + (q.z * h.x));
    const float z = q.z + (((q.w * h.z) + (q.x * h.y)) - (q.y * h.x));
    const float n = ((w * w) + (x * x)) + ((y * y) + (z * z));
    const float r = 1.5f - (0.5f * n);
    const keel_attitude_quaternion_t p = {w * r, x * r, y * r, z * r};

    return p;
}

/*@ assigns \nothing;
  @ ensures up && count < most ==> \result == count + 1;
  @ ensures up && count >= most ==> \result == most;
  @ ensures !up && count > 0 ==> \result == count - 1;
  @ ensures !up && count == 0 ==> \result == 0;
  @*/
static uint16_t counted_step(uint16_t count, bool up, uint16_t most)
{
    if (up) {
        return (count < most) ? (uint16_t)(count + 1u) : most;
    }
    return (count > 0u) ? (uint16_t)(count - 1u) : 0u;
}

/*@ requires \valid_read(config);
  @ assigns \nothing;
  @ ensures \result <==> attitude_gains(*config);
  @*/
static bool attitude_gains_fit(const keel_attitude_config_t *config)
{
    const float most = KEEL_ATTITUDE_GAIN_LIMIT;

    return keel_range_contains(config->tilt_gain, 0.0f, most) &&
           keel_range_contains(config->heading_gain, 0.0f, most) &&
           keel_range_contains(config->align_gain, 0.0f, most) &&
           keel_range_contains(config->bias_gain, 0.0f, most) &&
           keel_range_contains(config->force_gain, 0.0f, most) &&
           keel_range_contains(config->field_share, 0.0f, 1.0f);
}

/*@ requires \valid_read(config);
  @ assigns \nothing;
  @ ensures \result <==> attitude_limits(*config) && attitude_steps(*config);
  @*/
static bool attitude_limits_fit(const keel_attitude_config_t *config)
{
    return keel_range_contains(config->bias_limit, 0.0f, KEEL_ATTITUDE_BIAS_LIMIT) &&
           keel_range_contains(config->clip_rate, 0.0f, KEEL_ATTITUDE_RATE_LIMIT) &&
           keel_range_contains(config->quiet_rate, 0.0f, config->clip_rate) &&
           keel_range_contains(config->still_rate, 0.0f, KEEL_ATTITUDE_STILL_RATE_LIMIT) &&
           keel_range_contains(config->still_acceleration, 0.0f,
                               KEEL_ATTITUDE_STILL_ACCELERATION_LIMIT) &&
           keel_range_contains(config->tolerance, 0.0f, 1.0f) && (config->still_steps > 0u) &&
           (config->settle_steps > 0u) && (config->lost_steps > 0u) && (config->field_steps > 0u);
}

/* The expected field: none, or one that can be divided by. */
/*@ requires \valid_read(config);
  @ assigns \nothing;
  @*/
static bool is_field(const keel_attitude_config_t *config)
{
    const float most = KEEL_ATTITUDE_FIELD_LIMIT;
    const bool none = (config->north == 0.0f) && (config->east == 0.0f);

    return none || (keel_range_contains(config->north, -most, most) &&
                    keel_range_contains(config->east, -most, most) &&
                    (((config->north * config->north) + (config->east * config->east)) >=
                     (KEEL_ATTITUDE_FIELD_MIN * KEEL_ATTITUDE_FIELD_MIN)));
}

/*@ requires \valid(scale) && \valid_read(config) && \separated(scale, config);
  @ assigns *scale;
  @*/
static void set_scale(keel_attitude_scale_t *scale, const keel_attitude_config_t *config)
{
    const float square = (config->north * config->north) + (config->east * config->east);
    const bool none = square == 0.0f;

    scale->step = 1.0f / config->rate_hz;
    scale->half_step = 0.5f / config->rate_hz;
    scale->bias_step = config->bias_gain / config->rate_hz;
    scale->quiet = config->quiet_rate * config->quiet_rate;
    scale->tolerance = config->tolerance * config->tolerance;
    scale->north = none ? 0.0f : (config->north / square);
    scale->east = none ? 0.0f : (config->east / square);
    scale->still = 1.0f / (float)config->still_steps;
}

keel_status_t keel_attitude_init(keel_attitude_t *attitude, const keel_attitude_config_t *config)
{
    if (!keel_range_contains(config->rate_hz, KEEL_ATTITUDE_RATE_MIN_HZ,
                             KEEL_ATTITUDE_RATE_MAX_HZ)) {
        return KEEL_ERR_RATE;
    }
    if (!attitude_gains_fit(config)) {
        return KEEL_ERR_GAIN;
    }
    if (!attitude_limits_fit(config)) {
        return KEEL_ERR_LIMITS;
    }
    if (!is_field(config)) {
        return KEEL_ERR_INPUT;
    }
    attitude->config = *config;
    set_scale(&attitude->scale, config);
    keel_attitude_restart(attitude);
    return KEEL_OK;
}

void keel_attitude_restart(keel_attitude_t *attitude)
{
    const keel_attitude_quaternion_t level = {1.0f, 0.0f, 0.0f, 0.0f};
    const keel_attitude_vector_t zero = {0.0f, 0.0f, 0.0f};

    attitude->quaternion = level;
    attitude->bias = zero;
    attitude->rate = zero;
    attitude->gyroscope = zero;
    attitude->first_rate = zero;
    attitude->first_force = zero;
    attitude->sum = zero;
    attitude->down = zero;
    attitude->field = zero;
    attitude->heading_error = 0.0f;
    attitude->still = 0u;
    attitude->settled = 0u;
    attitude->heading_settled = 0u;
    attitude->lost = 0u;
    attitude->field_age = attitude->config.field_steps;
    attitude->flags = 0u;
    attitude->heading_valid = false;
    attitude->phase = KEEL_ATTITUDE_STILL;
}

/* The output of three channels. Whether a sensor contributed to each of them in the last vote. */
/*@ requires \valid(vector) && \valid_read(channel + (0 .. 2));
  @ requires \separated(vector, channel + (0 .. 2));
  @ assigns *vector;
  @*/
static bool take_three(keel_attitude_vector_t *vector, const keel_voter_t channel[])
{
    vector->x = channel[0].vote.output;
    vector->y = channel[1].vote.output;
    vector->z = channel[2].vote.output;
    return (channel[0].vote.contributing > 0u) && (channel[1].vote.contributing > 0u) &&
           (channel[2].vote.contributing > 0u);
}

void keel_attitude_take(keel_attitude_sample_t *sample, const keel_virtual_imu_t *imu)
{
    sample->has_accelerometer = take_three(&sample->accelerometer, &imu->channel[0]);
    sample->has_gyroscope = take_three(&sample->gyroscope,
                                       &imu->channel[KEEL_VIRTUAL_IMU_ACCELEROMETER]);
}

/* Tilt and heading are not valid any more. */
/*@ requires \valid(attitude);
  @ assigns attitude->settled, attitude->heading_settled, attitude->heading_valid,
  @     attitude->phase;
  @*/
static void lose_attitude(keel_attitude_t *attitude)
{
    attitude->settled = 0u;
    attitude->heading_settled = 0u;
    attitude->heading_valid = false;
    attitude->phase = KEEL_ATTITUDE_ALIGNING;
}

/* The rate to turn with: the new one, the last one for a while, none after that. */
/*@ requires \valid(attitude) && \valid_read(sample) && \separated(attitude, sample);
  @ requires \is_finite(attitude->config.clip_rate);
  @ assigns attitude->gyroscope, attitude->rate, attitude->lost, attitude->flags,
  @     attitude->settled, attitude->heading_settled, attitude->heading_valid, attitude->phase;
  @*/
static void take_rate(keel_attitude_t *attitude, const keel_attitude_sample_t *sample)
{
    const bool fits = sample->has_gyroscope &&
                      is_within(sample->gyroscope, attitude->config.clip_rate);
    const bool came = fits || (sample->has_gyroscope &&
                               is_within(sample->gyroscope, KEEL_ATTITUDE_RATE_LIMIT));
    const uint16_t most = attitude->config.lost_steps;

    if (fits) {
        attitude->flags = 0u;
    } else if (came) {
        attitude->flags = KEEL_ATTITUDE_CLIPPED;
    } else {
        attitude->flags = KEEL_ATTITUDE_LOST;
    }
    attitude->lost = counted_step(attitude->lost, !fits, most);
    if (came) {
        attitude->gyroscope = sample->gyroscope;
    } else if (attitude->lost >= most) {
        attitude->gyroscope = attitude->bias;
    } else {
        /* Held. */
    }
    if ((attitude->lost >= most) && (attitude->phase == KEEL_ATTITUDE_RUNNING)) {
        lose_attitude(attitude);
    }
    attitude->rate = vector_difference(attitude->gyroscope, attitude->bias);
}

/* Whether the heading is valid, by one more sample of the field. */
/*@ requires \valid(attitude);
  @ assigns attitude->heading_settled, attitude->heading_valid;
  @*/
static void judge_heading(keel_attitude_t *attitude, bool ahead)
{
    const uint16_t most = attitude->config.settle_steps;
    const float square = attitude->heading_error * attitude->heading_error;

    if (attitude->heading_valid) {
        attitude->heading_settled = counted_step(attitude->heading_settled, ahead, most);
        attitude->heading_valid = attitude->heading_settled > 0u;
    } else if (attitude->phase == KEEL_ATTITUDE_RUNNING) {
        const bool near = ahead && (square <= attitude->scale.tolerance);

        attitude->heading_settled = near ? counted_step(attitude->heading_settled, true, most) : 0u;
        attitude->heading_valid = attitude->heading_settled >= most;
    } else {
        /* Not before tilt is. */
    }
}

/* One step without a sample of the field. When none has come for long, the low-passed one tells of
 * an attitude of that time. */
/*@ requires \valid(attitude);
  @ assigns attitude->field, attitude->heading_error, attitude->heading_settled,
  @     attitude->heading_valid, attitude->field_age;
  @*/
static void miss_field(keel_attitude_t *attitude)
{
    const keel_attitude_vector_t zero = {0.0f, 0.0f, 0.0f};

    if (attitude->field_age < attitude->config.field_steps) {
        attitude->field_age++;
        if (attitude->field_age >= attitude->config.field_steps) {
            attitude->field = zero;
            attitude->heading_error = 0.0f;
            attitude->heading_settled = 0u;
            attitude->heading_valid = false;
        }
    }
}

/* The heading's error by the low-passed field, where that is within the bounds. The sine falls when
 * the error grows beyond a right angle; there the whole error stands in its place. Without an
 * expected field both are 0, and out of range. */
/*@ requires \valid(attitude);
  @ assigns attitude->field, attitude->heading_error, attitude->heading_settled,
  @     attitude->heading_valid, attitude->field_age, attitude->flags;
  @*/
static void judge_field(keel_attitude_t *attitude)
{
    const keel_attitude_scale_t *const scale = &attitude->scale;
    const keel_attitude_vector_t field = attitude->field;
    const float sine = (field.x * scale->east) - (field.y * scale->north);
    const float cosine = (field.x * scale->north) + (field.y * scale->east);
    const float whole = (sine < 0.0f) ? -1.0f : 1.0f;

    if (keel_range_contains((sine * sine) + (cosine * cosine), KEEL_ATTITUDE_FIELD_RATIO_MIN,
                            KEEL_ATTITUDE_FIELD_RATIO_MAX)) {
        attitude->heading_error = (cosine > 0.0f) ? sine : whole;
        attitude->field_age = 0u;
        attitude->flags |= KEEL_ATTITUDE_FIELD;
        judge_heading(attitude, cosine > 0.0f);
    } else {
        miss_field(attitude);
    }
}

/*@ requires \valid(attitude) && \valid_read(sample) && \valid_read(axes);
  @ requires \separated(attitude, sample) && \separated(attitude, axes);
  @ assigns attitude->field, attitude->heading_error, attitude->heading_settled,
  @     attitude->heading_valid, attitude->field_age, attitude->flags;
  @*/
static void take_field(keel_attitude_t *attitude, const keel_attitude_sample_t *sample,
                       const axes_t *axes)
{
    if (sample->has_magnetometer && is_within(sample->magnetometer, KEEL_ATTITUDE_FIELD_REACH)) {
        attitude->field = low_passed(attitude->field, attitude->config.field_share,
                                     to_earth(axes, sample->magnetometer));
        judge_field(attitude);
    } else {
        miss_field(attitude);
    }
}

/*@ requires \valid_read(sample);
  @ assigns \nothing;
  @*/
static bool has_force(const keel_attitude_sample_t *sample)
{
    return sample->has_accelerometer && is_within(sample->accelerometer, KEEL_ATTITUDE_FORCE_LIMIT);
}

/* A gain while tilt is valid; before, that of alignment. */
/*@ requires \valid_read(attitude);
  @ assigns \nothing;
  @*/
static float gain_of(const keel_attitude_t *attitude, float running)
{
    return (attitude->phase == KEEL_ATTITUDE_RUNNING) ? running : attitude->config.align_gain;
}

/* Down by the accelerometer, low-passed in the Earth's frame, in which it stands still while the
 * body turns. It is taken for down when the flag says so. */
/*@ requires \valid(attitude) && \valid_read(sample) && \valid_read(axes);
  @ requires \separated(attitude, sample) && \separated(attitude, axes);
  @ assigns attitude->down, attitude->flags;
  @*/
static void take_force(keel_attitude_t *attitude, const keel_attitude_sample_t *sample,
                       const axes_t *axes, bool forced)
{
    if (forced) {
        const float share = attitude->scale.step * gain_of(attitude, attitude->config.force_gain);
        keel_attitude_vector_t down = scaled_vector(-PER_GRAVITY,
                                                    to_earth(axes, sample->accelerometer));

        if (sample->has_acceleration &&
            is_within(sample->acceleration, KEEL_ATTITUDE_FORCE_LIMIT)) {
            down = add_scaled(down, PER_GRAVITY, sample->acceleration);
            attitude->flags |= KEEL_ATTITUDE_COMPENSATED;
        }
        attitude->down = low_passed(attitude->down, share, down);
        if (keel_range_contains(dot_product(attitude->down, attitude->down), KEEL_ATTITUDE_DOWN_MIN,
                                KEEL_ATTITUDE_DOWN_MAX)) {
            attitude->flags |= KEEL_ATTITUDE_DOWN;
        }
    }
}

/* Whether tilt is valid, by one more measurement of down: the sine and the cosine of its error. */
/*@ requires \valid(attitude);
  @ assigns attitude->settled, attitude->heading_settled, attitude->heading_valid,
  @     attitude->phase;
  @*/
static void judge_tilt(keel_attitude_t *attitude, keel_attitude_vector_t error, float cosine)
{
    const uint16_t most = attitude->config.settle_steps;

    if (attitude->phase == KEEL_ATTITUDE_RUNNING) {
        attitude->settled = counted_step(attitude->settled, cosine >= KEEL_ATTITUDE_AGREEMENT,
                                         most);
        if (attitude->settled == 0u) {
            lose_attitude(attitude);
        }
    } else if (attitude->phase == KEEL_ATTITUDE_ALIGNING) {
        const bool near = (cosine > 0.0f) &&
                          (dot_product(error, error) <= attitude->scale.tolerance) &&
                          (attitude->lost == 0u);

        attitude->settled = near ? counted_step(attitude->settled, true, most) : 0u;
        if (attitude->settled >= most) {
            attitude->phase = KEEL_ATTITUDE_RUNNING;
        } else {
            attitude->phase = KEEL_ATTITUDE_ALIGNING;
        }
    } else {
        /* Not before there is a bias. */
    }
}

/* The bias follows slowly, and only when little turns and the directions do not contradict. */
/*@ requires \valid(attitude) && \valid_read(axes) && \separated(attitude, axes);
  @ requires attitude_number(attitude->config.bias_limit, 0, KEEL_ATTITUDE_BIAS_LIMIT);
  @ requires attitude_number(attitude->config.tolerance, 0, 1);
  @ assigns attitude->bias;
  @*/
static void follow_bias(keel_attitude_t *attitude, const axes_t *axes, keel_attitude_vector_t error)
{
    if ((attitude->phase == KEEL_ATTITUDE_RUNNING) && (attitude->lost == 0u) &&
        (attitude->down.z >= KEEL_ATTITUDE_AGREEMENT) &&
        (dot_product(attitude->rate, attitude->rate) <= attitude->scale.quiet)) {
        const float heading = attitude->heading_valid ? attitude->heading_error : 0.0f;
        const keel_attitude_vector_t whole = {error.x, error.y, heading};
        const keel_attitude_vector_t part = clamped_vector(whole, attitude->config.tolerance);

        attitude->bias = clamped_vector(add_scaled(attitude->bias, -attitude->scale.bias_step,
                                                   to_body(axes, part)),
                                        attitude->config.bias_limit);
    }
}

/* The rate, in the Earth's frame, that leads towards the directions that were measured. */
/*@ requires \valid(attitude) && \valid_read(axes) && \separated(attitude, axes);
  @ requires attitude_number(attitude->config.bias_limit, 0, KEEL_ATTITUDE_BIAS_LIMIT);
  @ requires attitude_number(attitude->config.tolerance, 0, 1);
  @ assigns attitude->bias, attitude->settled, attitude->heading_settled,
  @     attitude->heading_valid, attitude->phase;
  @*/
static keel_attitude_vector_t rate_correction(keel_attitude_t *attitude, const axes_t *axes)
{
    keel_attitude_vector_t rate = {0.0f, 0.0f, 0.0f};

    if ((attitude->flags & KEEL_ATTITUDE_DOWN) != 0u) {
        const keel_attitude_vector_t nudge = {KEEL_ATTITUDE_NUDGE_X, KEEL_ATTITUDE_NUDGE_Y, 0.0f};
        keel_attitude_vector_t error = {attitude->down.y, -attitude->down.x, 0.0f};

        judge_tilt(attitude, error, attitude->down.z);
        follow_bias(attitude, axes, error);
        if (attitude->down.z < 0.0f) {
            error = add_scaled(error, 1.0f, nudge);
        }
        rate = scaled_vector(gain_of(attitude, attitude->config.tilt_gain), error);
    }
    rate.z = attitude->heading_error * (attitude->heading_valid ? attitude->config.heading_gain
                                                                : attitude->config.align_gain);
    return rate;
}

/* Turns the low-passed vectors along with the estimate of the Earth's frame: so a correction need
 * not be measured again. This comes last in a step, and bounds the vectors. */
/*@ requires \valid(attitude);
  @ assigns attitude->down, attitude->field;
  @*/
static void turn_along(keel_attitude_t *attitude, keel_attitude_vector_t rate)
{
    const keel_attitude_vector_t angle = scaled_vector(attitude->scale.step, rate);

    attitude->down = clamped_vector(add_scaled(attitude->down, 1.0f,
                                               cross_product(angle, attitude->down)),
                                    KEEL_ATTITUDE_DOWN_REACH);
    attitude->field = clamped_vector(add_scaled(attitude->field, 1.0f,
                                                cross_product(angle, attitude->field)),
                                     KEEL_ATTITUDE_FIELD_REACH);
}

bool keel_attitude_is_unit(keel_attitude_quaternion_t q)
{
    const float n = ((q.w * q.w) + (q.x * q.x)) + ((q.y * q.y) + (q.z * q.z));

    return keel_range_contains(n, KEEL_ATTITUDE_NORM_MIN, KEEL_ATTITUDE_NORM_MAX);
}

/*@ requires \valid(attitude);
  @ assigns attitude->quaternion, attitude->down, attitude->field, attitude->flags,
  @     attitude->settled, attitude->heading_settled, attitude->heading_valid, attitude->phase;
  @*/
static void rotate_attitude(keel_attitude_t *attitude, keel_attitude_vector_t rate)
{
    const keel_attitude_quaternion_t level = {1.0f, 0.0f, 0.0f, 0.0f};
    const keel_attitude_vector_t zero = {0.0f, 0.0f, 0.0f};
    const keel_attitude_vector_t half = clamped_vector(scaled_vector(attitude->scale.half_step,
                                                                     rate),
                                                       KEEL_ATTITUDE_HALF_ANGLE_LIMIT);
    const keel_attitude_quaternion_t next = turned_quaternion(attitude->quaternion, half);

    if (keel_attitude_is_unit(next)) {
        attitude->quaternion = next;
    } else {
        attitude->quaternion = level;
        attitude->down = zero;
        attitude->field = zero;
        attitude->flags |= KEEL_ATTITUDE_CORRUPTED;
        if (attitude->phase == KEEL_ATTITUDE_RUNNING) {
            lose_attitude(attitude);
        }
    }
}

/* The mean rate of still samples becomes the bias. */
/*@ requires \valid(attitude) && \is_finite(attitude->config.bias_limit);
  @ assigns attitude->bias, attitude->still, attitude->flags, attitude->phase;
  @*/
static void conclude_still(keel_attitude_t *attitude)
{
    const keel_attitude_vector_t mean = add_scaled(attitude->first_rate, attitude->scale.still,
                                                   attitude->sum);

    attitude->still = 0u;
    if (is_within(mean, attitude->config.bias_limit)) {
        attitude->bias = mean;
        attitude->phase = KEEL_ATTITUDE_ALIGNING;
    } else {
        attitude->flags |= KEEL_ATTITUDE_BIASED;
    }
}

/* Counts samples near the first of them, which is this one when it is not. */
/*@ requires \valid(attitude) && \valid_read(sample) && \separated(attitude, sample);
  @ requires \is_finite(attitude->config.bias_limit) &&
  @     \is_finite(attitude->config.still_rate) &&
  @     \is_finite(attitude->config.still_acceleration);
  @ assigns attitude->first_rate, attitude->first_force, attitude->sum, attitude->still,
  @     attitude->bias, attitude->flags, attitude->phase;
  @*/
static void await_still(keel_attitude_t *attitude, const keel_attitude_sample_t *sample,
                        bool forced)
{
    const keel_attitude_vector_t zero = {0.0f, 0.0f, 0.0f};
    const keel_attitude_vector_t moved = vector_difference(attitude->gyroscope,
                                                           attitude->first_rate);

    if (((attitude->flags & (KEEL_ATTITUDE_LOST | KEEL_ATTITUDE_CLIPPED)) != 0u) || !forced) {
        attitude->still = 0u;
    } else {
        if ((attitude->still > 0u) && is_within(moved, attitude->config.still_rate) &&
            is_within(vector_difference(sample->accelerometer, attitude->first_force),
                      attitude->config.still_acceleration)) {
            attitude->sum = add_scaled(attitude->sum, 1.0f, moved);
            attitude->still = counted_step(attitude->still, true, attitude->config.still_steps);
        } else {
            attitude->first_rate = attitude->gyroscope;
            attitude->first_force = sample->accelerometer;
            attitude->sum = zero;
            attitude->still = 1u;
        }
        if (attitude->still >= attitude->config.still_steps) {
            conclude_still(attitude);
        }
    }
}

void keel_attitude_step(keel_attitude_t *attitude, const keel_attitude_sample_t *sample)
{
    const axes_t axes = axes_of(attitude->quaternion);
    const bool forced = has_force(sample);
    keel_attitude_vector_t rate;

    take_rate(attitude, sample);
    take_field(attitude, sample, &axes);
    take_force(attitude, sample, &axes, forced);
    rate = rate_correction(attitude, &axes);
    turn_along(attitude, rate);
    rotate_attitude(attitude, add_scaled(attitude->rate, 1.0f, to_body(&axes, rate)));
    if (attitude->phase == KEEL_ATTITUDE_STILL) {
        await_still(attitude, sample, forced);
    }
}

keel_attitude_vector_t keel_attitude_down(const keel_attitude_t *attitude)
{
    const axes_t axes = axes_of(attitude->quaternion);

    return axes.down;
}
