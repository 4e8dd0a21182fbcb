/* SPDX-License-Identifier: Apache-2.0 */
#include "attitude.h"

typedef keel_attitude_vector_t vector_t;
typedef keel_attitude_quaternion_t quaternion_t;

/* No comparison with NaN holds. */
static bool from_to(float value, float least, float most)
{
    return (value >= least) && (value <= most);
}

static bool vector_to(vector_t v, float most)
{
    return from_to(v.x, -most, most) && from_to(v.y, -most, most) && from_to(v.z, -most, most);
}

static float product_of(vector_t a, vector_t b)
{
    return ((a.x * b.x) + (a.y * b.y)) + (a.z * b.z);
}

/* a + k b, each product rounded before its sum. */
static vector_t sum_of(vector_t a, float k, vector_t b)
{
    const vector_t sum = {a.x + (k * b.x), a.y + (k * b.y), a.z + (k * b.z)};

    return sum;
}

static vector_t apart(vector_t a, vector_t b)
{
    const vector_t difference = {a.x - b.x, a.y - b.y, a.z - b.z};

    return difference;
}

static float nearest(float value, float most)
{
    const float above = (value > -most) ? value : -most;

    return (above < most) ? above : most;
}

static vector_t nearest_vector(vector_t v, float most)
{
    const vector_t near = {nearest(v.x, most), nearest(v.y, most), nearest(v.z, most)};

    return near;
}

/* A count that goes up to `most` and down to 0. */
static uint16_t next_count(uint16_t count, bool up, uint16_t most)
{
    if (up) {
        return (count < most) ? (uint16_t)(count + 1u) : most;
    }
    return (count > 0u) ? (uint16_t)(count - 1u) : 0u;
}

/* n, e and v of attitude.h, each product taken with the double of its second factor. */
static vector_t north_of(quaternion_t q)
{
    const float y2 = q.y + q.y;
    const float z2 = q.z + q.z;
    const vector_t n = {1.0f - ((q.y * y2) + (q.z * z2)), (q.x * y2) - (q.w * z2),
                        (q.x * z2) + (q.w * y2)};

    return n;
}

static vector_t east_of(quaternion_t q)
{
    const float x2 = q.x + q.x;
    const float y2 = q.y + q.y;
    const float z2 = q.z + q.z;
    const vector_t e = {(q.x * y2) + (q.w * z2), 1.0f - ((q.x * x2) + (q.z * z2)),
                        (q.y * z2) - (q.w * x2)};

    return e;
}

static vector_t down_of(quaternion_t q)
{
    const float x2 = q.x + q.x;
    const float y2 = q.y + q.y;
    const float z2 = q.z + q.z;
    const vector_t v = {(q.x * z2) - (q.w * y2), (q.y * z2) + (q.w * x2),
                        1.0f - ((q.x * x2) + (q.y * y2))};

    return v;
}

static bool gains_valid(const keel_attitude_config_t *c)
{
    const float most = KEEL_ATTITUDE_GAIN_LIMIT;

    return from_to(c->tilt_gain, 0.0f, most) && from_to(c->heading_gain, 0.0f, most) &&
           from_to(c->align_gain, 0.0f, most) && from_to(c->bias_gain, 0.0f, most) &&
           from_to(c->force_gain, 0.0f, most) && from_to(c->field_share, 0.0f, 1.0f);
}

static bool limits_valid(const keel_attitude_config_t *c)
{
    return from_to(c->bias_limit, 0.0f, KEEL_ATTITUDE_BIAS_LIMIT) &&
           from_to(c->clip_rate, 0.0f, KEEL_ATTITUDE_RATE_LIMIT) &&
           from_to(c->quiet_rate, 0.0f, c->clip_rate) &&
           from_to(c->still_rate, 0.0f, KEEL_ATTITUDE_STILL_RATE_LIMIT) &&
           from_to(c->still_acceleration, 0.0f, KEEL_ATTITUDE_STILL_ACCELERATION_LIMIT) &&
           from_to(c->tolerance, 0.0f, 1.0f) && (c->still_steps > 0u) && (c->settle_steps > 0u) &&
           (c->lost_steps > 0u) && (c->field_steps > 0u);
}

/* None, or one that can be divided by. */
static bool field_valid(const keel_attitude_config_t *c)
{
    const float most = KEEL_ATTITUDE_FIELD_LIMIT;
    const bool none = (c->north == 0.0f) && (c->east == 0.0f);

    return none || (from_to(c->north, -most, most) && from_to(c->east, -most, most) &&
                    (((c->north * c->north) + (c->east * c->east)) >=
                     (KEEL_ATTITUDE_FIELD_MIN * KEEL_ATTITUDE_FIELD_MIN)));
}

keel_status_t model_attitude_init(keel_attitude_t *attitude, const keel_attitude_config_t *config)
{
    const float square = (config->north * config->north) + (config->east * config->east);

    /* ATT-001: a refusal changes nothing. */
    if (!from_to(config->rate_hz, KEEL_ATTITUDE_RATE_MIN_HZ, KEEL_ATTITUDE_RATE_MAX_HZ)) {
        return KEEL_ERR_RATE;
    }
    if (!gains_valid(config)) {
        return KEEL_ERR_GAIN;
    }
    if (!limits_valid(config)) {
        return KEEL_ERR_LIMITS;
    }
    if (!field_valid(config)) {
        return KEEL_ERR_INPUT;
    }
    /* ATT-002 */
    attitude->config = *config;
    attitude->scale.step = 1.0f / config->rate_hz;
    attitude->scale.half_step = 0.5f / config->rate_hz;
    attitude->scale.bias_step = config->bias_gain / config->rate_hz;
    attitude->scale.quiet = config->quiet_rate * config->quiet_rate;
    attitude->scale.tolerance = config->tolerance * config->tolerance;
    attitude->scale.north = (square == 0.0f) ? 0.0f : (config->north / square);
    attitude->scale.east = (square == 0.0f) ? 0.0f : (config->east / square);
    attitude->scale.still = 1.0f / (float)config->still_steps;
    model_attitude_restart(attitude);
    return KEEL_OK;
}

/* ATT-003 */
void model_attitude_restart(keel_attitude_t *attitude)
{
    const vector_t zero = {0.0f, 0.0f, 0.0f};
    const quaternion_t level = {1.0f, 0.0f, 0.0f, 0.0f};

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

/* ATT-004: channels 0 to 2 are the accelerometer's, 3 to 5 the gyroscope's. */
void model_attitude_take(keel_attitude_sample_t *sample, const keel_virtual_imu_t *imu)
{
    const keel_voter_t *const c = imu->channel;

    sample->accelerometer.x = c[0].vote.output;
    sample->accelerometer.y = c[1].vote.output;
    sample->accelerometer.z = c[2].vote.output;
    sample->has_accelerometer = (c[0].vote.contributing > 0u) && (c[1].vote.contributing > 0u) &&
                                (c[2].vote.contributing > 0u);
    sample->gyroscope.x = c[3].vote.output;
    sample->gyroscope.y = c[4].vote.output;
    sample->gyroscope.z = c[5].vote.output;
    sample->has_gyroscope = (c[3].vote.contributing > 0u) && (c[4].vote.contributing > 0u) &&
                            (c[5].vote.contributing > 0u);
}

/* ATT-014, ATT-015: back to aligning. */
static void align_again(keel_attitude_t *attitude)
{
    attitude->phase = KEEL_ATTITUDE_ALIGNING;
    attitude->settled = 0u;
    attitude->heading_settled = 0u;
    attitude->heading_valid = false;
}

/* ATT-005: W, and W - B. */
static void rate_step(keel_attitude_t *attitude, const keel_attitude_sample_t *sample)
{
    const bool fits = sample->has_gyroscope &&
                      vector_to(sample->gyroscope, attitude->config.clip_rate);
    const bool came = fits || (sample->has_gyroscope &&
                               vector_to(sample->gyroscope, KEEL_ATTITUDE_RATE_LIMIT));
    const uint16_t most = attitude->config.lost_steps;

    if (fits) {
        attitude->flags = 0u;
    } else if (came) {
        attitude->flags = KEEL_ATTITUDE_CLIPPED;
    } else {
        attitude->flags = KEEL_ATTITUDE_LOST;
    }
    attitude->lost = next_count(attitude->lost, !fits, most);
    if (came) {
        attitude->gyroscope = sample->gyroscope;
    } else if (attitude->lost >= most) {
        attitude->gyroscope = attitude->bias;
    }
    if ((attitude->lost >= most) && (attitude->phase == KEEL_ATTITUDE_RUNNING)) {
        align_again(attitude);
    }
    attitude->rate = apart(attitude->gyroscope, attitude->bias);
}

/* ATT-015 */
static void heading_validity(keel_attitude_t *attitude, bool ahead)
{
    const uint16_t most = attitude->config.settle_steps;
    const float square = attitude->heading_error * attitude->heading_error;

    if (attitude->heading_valid) {
        attitude->heading_settled = next_count(attitude->heading_settled, ahead, most);
        attitude->heading_valid = attitude->heading_settled > 0u;
    } else if (attitude->phase == KEEL_ATTITUDE_RUNNING) {
        const bool near = ahead && (square <= attitude->scale.tolerance);

        attitude->heading_settled = near ? next_count(attitude->heading_settled, true, most) : 0u;
        attitude->heading_valid = attitude->heading_settled >= most;
    }
}

/* ATT-008: nothing is known of the field; after a while not even what was known. */
static void field_missing(keel_attitude_t *attitude)
{
    const vector_t zero = {0.0f, 0.0f, 0.0f};

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

/* R v. */
static vector_t of_earth(quaternion_t q, vector_t v)
{
    const vector_t turned = {product_of(north_of(q), v), product_of(east_of(q), v),
                             product_of(down_of(q), v)};

    return turned;
}

/* R^-1 v. */
static vector_t of_body(quaternion_t q, vector_t v)
{
    const vector_t n = north_of(q);
    const vector_t part = {v.x * n.x, v.x * n.y, v.x * n.z};

    return sum_of(sum_of(part, v.y, east_of(q)), v.z, down_of(q));
}

/* A share of the way from one vector to another. */
static vector_t towards(vector_t from, vector_t to, float share)
{
    return sum_of(from, share, apart(to, from));
}

/* ATT-008: F, H, and what becomes of it. */
static void field_step(keel_attitude_t *attitude, const keel_attitude_sample_t *sample)
{
    const bool came = sample->has_magnetometer &&
                      vector_to(sample->magnetometer, KEEL_ATTITUDE_FIELD_REACH);

    if (came) {
        const vector_t b = of_earth(attitude->quaternion, sample->magnetometer);
        const vector_t f = towards(attitude->field, b, attitude->config.field_share);
        const float sine = (f.x * attitude->scale.east) - (f.y * attitude->scale.north);
        const float cosine = (f.x * attitude->scale.north) + (f.y * attitude->scale.east);

        attitude->field = f;
        if (from_to((sine * sine) + (cosine * cosine), KEEL_ATTITUDE_FIELD_RATIO_MIN,
                    KEEL_ATTITUDE_FIELD_RATIO_MAX)) {
            attitude->heading_error = (cosine > 0.0f) ? sine : ((sine < 0.0f) ? -1.0f : 1.0f);
            attitude->field_age = 0u;
            attitude->flags |= KEEL_ATTITUDE_FIELD;
            heading_validity(attitude, cosine > 0.0f);
        } else {
            field_missing(attitude);
        }
    } else {
        field_missing(attitude);
    }
}

static bool force_came(const keel_attitude_sample_t *sample)
{
    return sample->has_accelerometer && vector_to(sample->accelerometer, KEEL_ATTITUDE_FORCE_LIMIT);
}

/* ATT-006 and ATT-007: D, told by a flag when it is taken for down. */
static void down_step(keel_attitude_t *attitude, const keel_attitude_sample_t *sample, bool came)
{
    const float per_gravity = 0.101971618831157684326171875f; /* 1 / g */
    const vector_t f = of_earth(attitude->quaternion, sample->accelerometer);
    const vector_t a = sample->acceleration;
    vector_t m = {-per_gravity * f.x, -per_gravity * f.y, -per_gravity * f.z};
    const float gain = (attitude->phase == KEEL_ATTITUDE_RUNNING) ? attitude->config.force_gain
                                                                  : attitude->config.align_gain;

    if (came) {
        if (sample->has_acceleration && vector_to(a, KEEL_ATTITUDE_FORCE_LIMIT)) {
            m = sum_of(m, per_gravity, a);
            attitude->flags |= KEEL_ATTITUDE_COMPENSATED;
        }
        attitude->down = towards(attitude->down, m, attitude->scale.step * gain);
        if (from_to(product_of(attitude->down, attitude->down), KEEL_ATTITUDE_DOWN_MIN,
                    KEEL_ATTITUDE_DOWN_MAX)) {
            attitude->flags |= KEEL_ATTITUDE_DOWN;
        }
    }
}

/* ATT-014 */
static void tilt_validity(keel_attitude_t *attitude, vector_t error, float cosine)
{
    const uint16_t most = attitude->config.settle_steps;

    if (attitude->phase == KEEL_ATTITUDE_RUNNING) {
        attitude->settled = next_count(attitude->settled, cosine >= KEEL_ATTITUDE_AGREEMENT, most);
        if (attitude->settled == 0u) {
            align_again(attitude);
        }
    } else if (attitude->phase == KEEL_ATTITUDE_ALIGNING) {
        const bool near = (cosine > 0.0f) &&
                          (product_of(error, error) <= attitude->scale.tolerance) &&
                          (attitude->lost == 0u);

        attitude->settled = near ? next_count(attitude->settled, true, most) : 0u;
        if (attitude->settled >= most) {
            attitude->phase = KEEL_ATTITUDE_RUNNING;
        } else {
            attitude->phase = KEEL_ATTITUDE_ALIGNING;
        }
    }
}

/* ATT-012: B. */
static void bias_step(keel_attitude_t *attitude, vector_t error)
{
    const float heading = attitude->heading_valid ? attitude->heading_error : 0.0f;
    const vector_t whole = {error.x, error.y, heading};
    const vector_t part = nearest_vector(whole, attitude->config.tolerance);

    if ((attitude->phase == KEEL_ATTITUDE_RUNNING) && (attitude->lost == 0u) &&
        (attitude->down.z >= KEEL_ATTITUDE_AGREEMENT) &&
        (product_of(attitude->rate, attitude->rate) <= attitude->scale.quiet)) {
        attitude->bias = nearest_vector(sum_of(attitude->bias, -attitude->scale.bias_step,
                                               of_body(attitude->quaternion, part)),
                                        attitude->config.bias_limit);
    }
}

/* ATT-009: u. */
static vector_t rate_of_correction(keel_attitude_t *attitude)
{
    vector_t u = {0.0f, 0.0f, 0.0f};
    float gain;

    if ((attitude->flags & KEEL_ATTITUDE_DOWN) != 0u) {
        const vector_t nudge = {KEEL_ATTITUDE_NUDGE_X, KEEL_ATTITUDE_NUDGE_Y, 0.0f};
        vector_t error = {attitude->down.y, -attitude->down.x, 0.0f};

        tilt_validity(attitude, error, attitude->down.z);
        bias_step(attitude, error);
        if (attitude->down.z < 0.0f) {
            error = sum_of(error, 1.0f, nudge);
        }
        gain = (attitude->phase == KEEL_ATTITUDE_RUNNING) ? attitude->config.tilt_gain
                                                          : attitude->config.align_gain;
        u.x = gain * error.x;
        u.y = gain * error.y;
    }
    gain = attitude->heading_valid ? attitude->config.heading_gain : attitude->config.align_gain;
    u.z = attitude->heading_error * gain;
    return u;
}

/* v + w x v: turned by small angles w. */
static vector_t turned_by(vector_t v, vector_t w, float most)
{
    const vector_t product = {(w.y * v.z) - (w.z * v.y), (w.z * v.x) - (w.x * v.z),
                              (w.x * v.y) - (w.y * v.x)};

    return nearest_vector(sum_of(v, 1.0f, product), most);
}

/* ATT-016 */
bool model_attitude_is_unit(keel_attitude_quaternion_t q)
{
    return from_to(((q.w * q.w) + (q.x * q.x)) + ((q.y * q.y) + (q.z * q.z)),
                   KEEL_ATTITUDE_NORM_MIN, KEEL_ATTITUDE_NORM_MAX);
}

/* ATT-009 and ATT-016: the next quaternion. */
static void turn_step(keel_attitude_t *attitude, vector_t rate)
{
    const quaternion_t level = {1.0f, 0.0f, 0.0f, 0.0f};
    const vector_t zero = {0.0f, 0.0f, 0.0f};
    const float k = attitude->scale.half_step;
    const vector_t angles = {k * rate.x, k * rate.y, k * rate.z};
    const vector_t h = nearest_vector(angles, KEEL_ATTITUDE_HALF_ANGLE_LIMIT);
    const quaternion_t q = attitude->quaternion;
    /* p = q + q (0, h) */
    const float w = q.w - (((q.x * h.x) + (q.y * h.y)) + (q.z * h.z));
    const float x = q.x + (((q.w * h.x) + (q.y * h.z)) - (q.z * h.y));
    const float y = q.y + (((q.w * h.y) - (q.x * h.z)) + (q.z * h.x));
    const float z = q.z + (((q.w * h.z) + (q.x * h.y)) - (q.y * h.x));
    /* one step of Newton's iteration towards 1 / |p| */
    const float r = 1.5f - (0.5f * (((w * w) + (x * x)) + ((y * y) + (z * z))));
    const quaternion_t next = {w * r, x * r, y * r, z * r};

    if (model_attitude_is_unit(next)) {
        attitude->quaternion = next;
    } else {
        attitude->quaternion = level;
        attitude->down = zero;
        attitude->field = zero;
        attitude->flags |= KEEL_ATTITUDE_CORRUPTED;
        if (attitude->phase == KEEL_ATTITUDE_RUNNING) {
            align_again(attitude);
        }
    }
}

/* ATT-013: the mean of enough still samples in a row is the bias. */
static void mean_of_still(keel_attitude_t *attitude)
{
    const vector_t mean = sum_of(attitude->first_rate, attitude->scale.still, attitude->sum);

    attitude->still = 0u;
    if (vector_to(mean, attitude->config.bias_limit)) {
        attitude->bias = mean;
        attitude->phase = KEEL_ATTITUDE_ALIGNING;
    } else {
        attitude->flags |= KEEL_ATTITUDE_BIASED;
    }
}

/* ATT-013: is this sample near the first of those that were still? */
static void still_step(keel_attitude_t *attitude, const keel_attitude_sample_t *sample, bool came)
{
    const vector_t zero = {0.0f, 0.0f, 0.0f};
    const vector_t w = attitude->gyroscope;
    const vector_t f = sample->accelerometer;
    const vector_t moved = apart(w, attitude->first_rate);

    if (((attitude->flags & (KEEL_ATTITUDE_LOST | KEEL_ATTITUDE_CLIPPED)) != 0u) || !came) {
        attitude->still = 0u;
    } else {
        if ((attitude->still > 0u) && vector_to(moved, attitude->config.still_rate) &&
            vector_to(apart(f, attitude->first_force), attitude->config.still_acceleration)) {
            attitude->sum = sum_of(attitude->sum, 1.0f, moved);
            attitude->still = next_count(attitude->still, true, attitude->config.still_steps);
        } else {
            attitude->first_rate = w;
            attitude->first_force = f;
            attitude->sum = zero;
            attitude->still = 1u;
        }
        if (attitude->still >= attitude->config.still_steps) {
            mean_of_still(attitude);
        }
    }
}

void model_attitude_step(keel_attitude_t *attitude, const keel_attitude_sample_t *sample)
{
    const quaternion_t q = attitude->quaternion;
    const bool came = force_came(sample);
    vector_t u;
    vector_t angle;

    rate_step(attitude, sample);
    field_step(attitude, sample);
    down_step(attitude, sample, came);
    u = rate_of_correction(attitude);
    angle.x = attitude->scale.step * u.x;
    angle.y = attitude->scale.step * u.y;
    angle.z = attitude->scale.step * u.z;
    attitude->down = turned_by(attitude->down, angle, KEEL_ATTITUDE_DOWN_REACH);
    attitude->field = turned_by(attitude->field, angle, KEEL_ATTITUDE_FIELD_REACH);
    turn_step(attitude, sum_of(attitude->rate, 1.0f, of_body(q, u)));
    if (attitude->phase == KEEL_ATTITUDE_STILL) {
        still_step(attitude, sample, came);
    }
}

/* ATT-019 */
keel_attitude_vector_t model_attitude_down(const keel_attitude_t *attitude)
{
    return down_of(attitude->quaternion);
}
