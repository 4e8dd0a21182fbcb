/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/flight/axis.h"

#include "keel/middleware/range.h"

/*@ requires \valid_read(config);
  @ assigns \nothing;
  @ ensures \result <==> axis_gains(*config);
  @*/
static bool axis_gains_fit(const keel_axis_config_t *config)
{
    return keel_range_contains(config->position_gain, 0.0f, KEEL_AXIS_PART_LIMIT) &&
           keel_range_contains(config->velocity_gain, 0.0f, KEEL_AXIS_VELOCITY_GAIN_LIMIT) &&
           keel_range_contains(config->rate_gain, 0.0f, KEEL_AXIS_PART_LIMIT) &&
           keel_range_contains(config->bias_gain, 0.0f, KEEL_AXIS_BIAS_GAIN_LIMIT);
}

/*@ requires \valid_read(config);
  @ assigns \nothing;
  @ ensures \result <==> axis_limits(*config);
  @*/
static bool axis_limits_fit(const keel_axis_config_t *config)
{
    return keel_range_contains(config->bias_limit, 0.0f, KEEL_AXIS_BIAS_LIMIT) &&
           keel_range_contains(config->position_gate, 0.0f, KEEL_AXIS_POSITION_LIMIT) &&
           keel_range_contains(config->velocity_gate, 0.0f, KEEL_AXIS_VELOCITY_LIMIT) &&
           (config->late_steps > 0u) && (config->late_steps <= config->lost_steps) &&
           (config->settle_fixes > 0u) && (config->jump_fixes > 0u);
}

keel_status_t keel_axis_init(keel_axis_t *axis, const keel_axis_config_t *config)
{
    if (!keel_range_contains(config->rate_hz, KEEL_AXIS_RATE_MIN_HZ, KEEL_AXIS_RATE_MAX_HZ)) {
        return KEEL_ERR_RATE;
    }
    if (!axis_gains_fit(config)) {
        return KEEL_ERR_GAIN;
    }
    if (!axis_limits_fit(config)) {
        return KEEL_ERR_LIMITS;
    }
    axis->config = *config;
    axis->step = 1.0f / config->rate_hz;
    axis->half_step = 0.5f / config->rate_hz;
    keel_axis_restart(axis);
    return KEEL_OK;
}

void keel_axis_restart(keel_axis_t *axis)
{
    axis->position = 0.0f;
    axis->velocity = 0.0f;
    axis->bias = 0.0f;
    axis->jump = 0.0f;
    axis->age = axis->config.lost_steps;
    axis->agreed = 0u;
    axis->jumped = 0u;
    axis->flags = 0u;
    axis->quality = KEEL_AXIS_NONE;
}

/* One more, up to a number. */
/*@ assigns \nothing;
  @ ensures count < most ==> \result == count + 1;
  @ ensures count >= most ==> \result == most;
  @*/
static uint16_t one_up_to(uint16_t count, uint16_t most)
{
    return (count < most) ? (uint16_t)(count + 1u) : most;
}

/* Only by the acceleration. */
/*@ requires \valid(axis) && \valid_read(sample) && \separated(axis, sample);
  @ assigns axis->position, axis->velocity, axis->flags;
  @*/
static void predict_state(keel_axis_t *axis, const keel_axis_sample_t *sample)
{
    const bool sees = sample->has_acceleration &&
                      keel_range_contains(sample->acceleration, -KEEL_AXIS_ACCELERATION_LIMIT,
                                          KEEL_AXIS_ACCELERATION_LIMIT);
    const float acceleration = sees ? (sample->acceleration - axis->bias) : 0.0f;
    const float velocity = keel_range_clamp(axis->velocity + (axis->step * acceleration),
                                            -KEEL_AXIS_VELOCITY_LIMIT, KEEL_AXIS_VELOCITY_LIMIT);

    axis->flags = sees ? 0u : KEEL_AXIS_BLIND;
    axis->position = keel_range_clamp(axis->position +
                                          (axis->half_step * (axis->velocity + velocity)),
                                      -KEEL_AXIS_POSITION_LIMIT, KEEL_AXIS_POSITION_LIMIT);
    axis->velocity = velocity;
}

/*@ requires \valid_read(sample);
  @ assigns \nothing;
  @ ensures \result <==> axis_counts(sample);
  @*/
static bool fix_counts(const keel_axis_sample_t *sample)
{
    return sample->has_fix && sample->is_usable &&
           keel_range_contains(sample->position, -KEEL_AXIS_POSITION_LIMIT,
                               KEEL_AXIS_POSITION_LIMIT) &&
           (!sample->has_velocity ||
            keel_range_contains(sample->velocity, -KEEL_AXIS_VELOCITY_LIMIT,
                                KEEL_AXIS_VELOCITY_LIMIT));
}

/* A fix is believed, whatever was known. */
/*@ requires \valid(axis) && \valid_read(sample) && \separated(axis, sample);
  @ assigns axis->position, axis->velocity, axis->age, axis->agreed, axis->jumped, axis->flags;
  @*/
static void set_to_fix(keel_axis_t *axis, const keel_axis_sample_t *sample)
{
    axis->position = sample->position;
    axis->velocity = sample->has_velocity ? sample->velocity : 0.0f;
    axis->age = 0u;
    axis->agreed = 0u;
    axis->jumped = 0u;
    axis->flags |= KEEL_AXIS_FIXED | KEEL_AXIS_BEGUN;
}

/* A part of how far a fix is off is made up for. */
/*@ requires \valid(axis) && axis_limited(axis);
  @ assigns axis->position, axis->velocity, axis->bias, axis->age, axis->agreed, axis->jumped,
  @     axis->flags;
  @*/
static void correct_state(keel_axis_t *axis, float way, float rate)
{
    const keel_axis_config_t *const config = &axis->config;

    axis->position = keel_range_clamp(axis->position + (config->position_gain * way),
                                      -KEEL_AXIS_POSITION_LIMIT, KEEL_AXIS_POSITION_LIMIT);
    axis->velocity = keel_range_clamp(axis->velocity + ((config->velocity_gain * way) +
                                                        (config->rate_gain * rate)),
                                      -KEEL_AXIS_VELOCITY_LIMIT, KEEL_AXIS_VELOCITY_LIMIT);
    axis->bias = keel_range_clamp(axis->bias - (config->bias_gain * way), -config->bias_limit,
                                  config->bias_limit);
    axis->age = 0u;
    axis->agreed = one_up_to(axis->agreed, config->settle_fixes);
    axis->jumped = 0u;
    axis->flags |= KEEL_AXIS_FIXED;
}

/* A fix beyond the gates: believed when it agrees with enough jumps before it, or one more jump. */
/*@ requires \valid(axis) && \valid_read(sample) && \separated(axis, sample);
  @ requires axis_limited(axis);
  @ assigns axis->position, axis->velocity, axis->jump, axis->age, axis->agreed, axis->jumped,
  @     axis->flags;
  @*/
static void judge_jump(keel_axis_t *axis, const keel_axis_sample_t *sample)
{
    const keel_axis_config_t *const config = &axis->config;
    const bool again = (axis->jumped > 0u) &&
                       keel_range_contains(sample->position - axis->jump, -config->position_gate,
                                           config->position_gate);
    const uint16_t before = again ? axis->jumped : 0u;

    axis->flags |= again ? KEEL_AXIS_AGAIN : 0u;
    if ((before + 1u) >= config->jump_fixes) {
        set_to_fix(axis, sample);
    } else {
        axis->agreed = 0u;
        axis->jumped = (uint16_t)(before + 1u);
        axis->jump = sample->position;
        axis->flags |= KEEL_AXIS_JUMPED;
    }
}

/* A fix that counts: believed, taken for a jump, or made use of. */
/*@ requires \valid(axis) && \valid_read(sample) && \separated(axis, sample);
  @ requires axis_limited(axis);
  @ assigns axis->position, axis->velocity, axis->bias, axis->jump, axis->age, axis->agreed,
  @     axis->jumped, axis->flags;
  @*/
static void judge_fix(keel_axis_t *axis, const keel_axis_sample_t *sample)
{
    const keel_axis_config_t *const config = &axis->config;
    const float way = sample->position - axis->position;
    const float rate = sample->has_velocity ? (sample->velocity - axis->velocity) : 0.0f;
    const bool near = keel_range_contains(way, -config->position_gate, config->position_gate) &&
                      keel_range_contains(rate, -config->velocity_gate, config->velocity_gate);

    if (axis->age >= config->lost_steps) {
        set_to_fix(axis, sample);
    } else if (near) {
        correct_state(axis, way, rate);
    } else {
        judge_jump(axis, sample);
    }
}

/*@ requires \valid_read(axis);
  @ assigns \nothing;
  @*/
static keel_axis_quality_t quality_of(const keel_axis_t *axis)
{
    const keel_axis_config_t *const config = &axis->config;
    keel_axis_quality_t quality = KEEL_AXIS_POOR;

    if (axis->age >= config->lost_steps) {
        quality = KEEL_AXIS_NONE;
    } else if ((axis->age < config->late_steps) && (axis->agreed >= config->settle_fixes) &&
               ((axis->flags & KEEL_AXIS_BLIND) == 0u)) {
        quality = KEEL_AXIS_GOOD;
    } else {
        /* Known, but not more. */
    }
    return quality;
}

void keel_axis_step(keel_axis_t *axis, const keel_axis_sample_t *sample)
{
    predict_state(axis, sample);
    axis->age = one_up_to(axis->age, axis->config.lost_steps);
    if (fix_counts(sample)) {
        judge_fix(axis, sample);
    } else if (sample->has_fix) {
        axis->agreed = 0u;
        axis->flags |= KEEL_AXIS_UNUSABLE;
    } else {
        /* None came. */
    }
    axis->quality = quality_of(axis);
}
