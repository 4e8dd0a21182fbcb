/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/flight/calibration.h"

#include "keel/middleware/range.h"

#include <stdbool.h>

/* How an axis lies. */
#define LEANS     0u
#define UPWARDS   1u
#define DOWNWARDS 2u

/* A count that stays at its end. */
/*@ assigns \nothing;
  @ ensures \result == calibration_up(count);
  @*/
static uint16_t one_up(uint16_t count)
{
    return (count < UINT16_MAX) ? (uint16_t)(count + 1u) : count;
}

/*@ requires \valid_read(three + (0 .. 2)) && \is_finite(least) && \is_finite(most);
  @ assigns \nothing;
  @ ensures \result <==> calibration_three(three, least, most);
  @*/
static bool are_within(const float three[KEEL_CALIBRATION_AXES], float least, float most)
{
    return keel_range_contains(three[0], least, most) &&
           keel_range_contains(three[1], least, most) && keel_range_contains(three[2], least, most);
}

/*@ requires \valid(three + (0 .. 2)) && \is_finite(value);
  @ assigns three[0 .. 2];
  @ ensures three[0] == value && three[1] == value && three[2] == value;
  @*/
static void set_axes(float three[KEEL_CALIBRATION_AXES], float value)
{
    three[0] = value;
    three[1] = value;
    three[2] = value;
}

/*@ requires \valid_read(config);
  @ assigns \nothing;
  @ ensures \result <==> calibration_rest_limits(*config);
  @*/
static bool rest_limits_fit(const keel_calibration_rest_config_t *config)
{
    return keel_range_contains(config->spread, 0.0f, KEEL_CALIBRATION_LIMIT) &&
           keel_range_contains(config->limit, 0.0f, KEEL_CALIBRATION_LIMIT) &&
           (config->samples > 0u) && (config->samples <= KEEL_CALIBRATION_SAMPLES_MAX);
}

keel_status_t keel_calibration_rest_init(keel_calibration_rest_t *rest,
                                         const keel_calibration_rest_config_t *config)
{
    if (!are_within(config->expected, -KEEL_CALIBRATION_LIMIT, KEEL_CALIBRATION_LIMIT)) {
        return KEEL_ERR_VALUE;
    }
    if (!rest_limits_fit(config)) {
        return KEEL_ERR_LIMITS;
    }
    rest->config = *config;
    rest->per_sample = 1.0f / (float)config->samples;
    set_axes(rest->offset, 0.0f);
    keel_calibration_rest_begin(rest);
    rest->state = KEEL_CALIBRATION_IDLE;
    return KEEL_OK;
}

void keel_calibration_rest_begin(keel_calibration_rest_t *rest)
{
    set_axes(rest->first, 0.0f);
    set_axes(rest->sum, 0.0f);
    rest->count = 0u;
    rest->state = KEEL_CALIBRATION_COLLECTING;
    rest->restarts = 0u;
    rest->beyond = 0u;
}

/*@ requires \valid(rest) && \valid_read(sample + (0 .. 2)) && \separated(rest, sample + (0 .. 2));
  @ assigns rest->first[0 .. 2], rest->sum[0 .. 2], rest->count;
  @*/
static void begin_run(keel_calibration_rest_t *rest, const float sample[KEEL_CALIBRATION_AXES])
{
    rest->first[0] = sample[0];
    rest->first[1] = sample[1];
    rest->first[2] = sample[2];
    set_axes(rest->sum, 0.0f);
    rest->count = 1u;
}

/*@ requires \valid(rest);
  @ assigns rest->count, rest->restarts;
  @ ensures rest->count == 0 && rest->restarts == (\old(rest->count) == 0 ? \old(rest->restarts)
  @     : calibration_up(\old(rest->restarts)));
  @*/
static void break_run(keel_calibration_rest_t *rest)
{
    if (rest->count > 0u) {
        rest->restarts = one_up(rest->restarts);
        rest->count = 0u;
    }
}

/* A sample that is near the first belongs to its run; another ends it. */
/*@ requires \valid(rest) && \valid_read(sample + (0 .. 2)) && \separated(rest, sample + (0 .. 2));
  @ requires calibration_rest_counts(rest);
  @ assigns rest->sum[0 .. 2], rest->count, rest->restarts;
  @*/
static void continue_run(keel_calibration_rest_t *rest, const float sample[KEEL_CALIBRATION_AXES])
{
    const float away[KEEL_CALIBRATION_AXES] = {
        sample[0] - rest->first[0], sample[1] - rest->first[1], sample[2] - rest->first[2]};

    if (are_within(away, -rest->config.spread, rest->config.spread)) {
        rest->sum[0] += away[0];
        rest->sum[1] += away[1];
        rest->sum[2] += away[2];
        rest->count++;
    } else {
        break_run(rest);
    }
}

/* The axes, as bits, on which an offset is beyond its limit. */
/*@ requires \valid_read(offset + (0 .. 2)) && \is_finite(limit);
  @ assigns \nothing;
  @ ensures \result <= 7;
  @ ensures \result == 0 <==> calibration_three(offset, -limit, limit);
  @*/
static uint16_t axes_beyond(const float offset[KEEL_CALIBRATION_AXES], float limit)
{
    uint16_t beyond = 0u;

    if (!keel_range_contains(offset[0], -limit, limit)) {
        beyond = 1u;
    }
    if (!keel_range_contains(offset[1], -limit, limit)) {
        beyond = (uint16_t)(beyond + 2u);
    }
    if (!keel_range_contains(offset[2], -limit, limit)) {
        beyond = (uint16_t)(beyond + 4u);
    }
    return beyond;
}

/* Takes the offset of a whole run, or refuses it. */
/*@ requires \valid(rest) && \is_finite(rest->config.limit);
  @ assigns rest->offset[0 .. 2], rest->state, rest->beyond;
  @*/
static void end_rest(keel_calibration_rest_t *rest)
{
    const float *const expected = rest->config.expected;
    const float offset[KEEL_CALIBRATION_AXES] = {
        (rest->first[0] - expected[0]) + (rest->sum[0] * rest->per_sample),
        (rest->first[1] - expected[1]) + (rest->sum[1] * rest->per_sample),
        (rest->first[2] - expected[2]) + (rest->sum[2] * rest->per_sample)};

    rest->beyond = axes_beyond(offset, rest->config.limit);
    rest->state = KEEL_CALIBRATION_REFUSED;
    if (rest->beyond == 0u) {
        rest->offset[0] = offset[0];
        rest->offset[1] = offset[1];
        rest->offset[2] = offset[2];
        rest->state = KEEL_CALIBRATION_DONE;
    }
}

void keel_calibration_rest_step(keel_calibration_rest_t *rest,
                                const float sample[KEEL_CALIBRATION_AXES])
{
    if (rest->state != KEEL_CALIBRATION_COLLECTING) {
        return;
    }
    if (!are_within(sample, -KEEL_CALIBRATION_LIMIT, KEEL_CALIBRATION_LIMIT)) {
        break_run(rest);
    } else if (rest->count == 0u) {
        begin_run(rest, sample);
    } else {
        continue_run(rest, sample);
    }
    if (rest->count >= rest->config.samples) {
        end_rest(rest);
    }
}

/*@ requires \valid_read(config);
  @ assigns \nothing;
  @ ensures \result <==> calibration_field_range(*config);
  @*/
static bool field_range_fits(const keel_calibration_field_config_t *config)
{
    return keel_range_contains(config->highest, -KEEL_CALIBRATION_LIMIT, KEEL_CALIBRATION_LIMIT) &&
           keel_range_contains(config->lowest, -KEEL_CALIBRATION_LIMIT, config->highest);
}

/*@ requires \valid_read(config);
  @ assigns \nothing;
  @ ensures \result <==> calibration_field_limits(*config);
  @*/
static bool field_limits_fit(const keel_calibration_field_config_t *config)
{
    return keel_range_contains(config->span_max, 0.0f, 2.0f * KEEL_CALIBRATION_LIMIT) &&
           keel_range_contains(config->span_min, 0.0f, config->span_max) &&
           (config->span_min > 0.0f) &&
           keel_range_contains(config->limit, 0.0f, KEEL_CALIBRATION_LIMIT);
}

keel_status_t keel_calibration_field_init(keel_calibration_field_t *field,
                                          const keel_calibration_field_config_t *config)
{
    if (!field_range_fits(config)) {
        return KEEL_ERR_VALUE;
    }
    if (!field_limits_fit(config)) {
        return KEEL_ERR_LIMITS;
    }
    field->config = *config;
    set_axes(field->offset, 0.0f);
    keel_calibration_field_begin(field);
    field->state = KEEL_CALIBRATION_IDLE;
    return KEEL_OK;
}

void keel_calibration_field_begin(keel_calibration_field_t *field)
{
    set_axes(field->lowest, field->config.highest);
    set_axes(field->highest, field->config.lowest);
    field->state = KEEL_CALIBRATION_COLLECTING;
    field->dropped = 0u;
}

/* Adds one value to the range that was seen of an axis. */
/*@ requires \valid(field) && axis < KEEL_CALIBRATION_AXES && \is_finite(value);
  @ assigns field->lowest[axis], field->highest[axis];
  @*/
static void widen_range(keel_calibration_field_t *field, uint32_t axis, float value)
{
    if (value < field->lowest[axis]) {
        field->lowest[axis] = value;
    }
    if (value > field->highest[axis]) {
        field->highest[axis] = value;
    }
}

void keel_calibration_field_step(keel_calibration_field_t *field,
                                 const float sample[KEEL_CALIBRATION_AXES])
{
    if (field->state != KEEL_CALIBRATION_COLLECTING) {
        return;
    }
    if (are_within(sample, field->config.lowest, field->config.highest)) {
        widen_range(field, 0u, sample[0]);
        widen_range(field, 1u, sample[1]);
        widen_range(field, 2u, sample[2]);
    } else {
        field->dropped = one_up(field->dropped);
    }
}

/* The part that is the same on both sides of an axis: the vehicle's. */
/*@ requires \valid_read(field) && axis < KEEL_CALIBRATION_AXES;
  @ assigns \nothing;
  @*/
static float middle_of(const keel_calibration_field_t *field, uint32_t axis)
{
    return 0.5f * (field->lowest[axis] + field->highest[axis]);
}

keel_calibration_verdict_t keel_calibration_field_axis(const keel_calibration_field_t *field,
                                                       uint32_t axis)
{
    const keel_calibration_field_config_t *const config = &field->config;
    const float span = field->highest[axis] - field->lowest[axis];
    keel_calibration_verdict_t verdict = KEEL_CALIBRATION_FIT;

    if (!(span >= config->span_min)) {
        verdict = KEEL_CALIBRATION_NARROW;
    } else if (span > config->span_max) {
        verdict = KEEL_CALIBRATION_WIDE;
    } else if (!keel_range_contains(middle_of(field, axis), -config->limit, config->limit)) {
        verdict = KEEL_CALIBRATION_BEYOND;
    } else {
        /* It fits. */
    }
    return verdict;
}

keel_status_t keel_calibration_field_finish(keel_calibration_field_t *field)
{
    if (field->state != KEEL_CALIBRATION_COLLECTING) {
        return KEEL_ERR_STATE;
    }
    if ((keel_calibration_field_axis(field, 0u) != KEEL_CALIBRATION_FIT) ||
        (keel_calibration_field_axis(field, 1u) != KEEL_CALIBRATION_FIT) ||
        (keel_calibration_field_axis(field, 2u) != KEEL_CALIBRATION_FIT)) {
        return KEEL_ERR_LIMITS;
    }
    field->offset[0] = middle_of(field, 0u);
    field->offset[1] = middle_of(field, 1u);
    field->offset[2] = middle_of(field, 2u);
    field->state = KEEL_CALIBRATION_DONE;
    return KEEL_OK;
}

void keel_calibration_apply(const float offset[KEEL_CALIBRATION_AXES],
                            const float raw[KEEL_CALIBRATION_AXES], keel_calibration_vector_t *out)
{
    out->axis[0] = raw[0] - offset[0];
    out->axis[1] = raw[1] - offset[1];
    out->axis[2] = raw[2] - offset[2];
}

void keel_calibration_correct(const keel_calibration_correction_t *correction,
                              const float raw[KEEL_CALIBRATION_AXES],
                              keel_calibration_vector_t *out)
{
    out->axis[0] = (raw[0] - correction->offset[0]) * correction->scale[0];
    out->axis[1] = (raw[1] - correction->offset[1]) * correction->scale[1];
    out->axis[2] = (raw[2] - correction->offset[2]) * correction->scale[2];
}

/* How an axis lies, by what it says and whether the others say little. */
/*@ requires \is_finite(least);
  @ assigns \nothing;
  @ ensures \result <= DOWNWARDS;
  @*/
static uint32_t way_of(float says, bool is_alone, float least)
{
    uint32_t way = LEANS;

    if (is_alone && keel_range_contains(says, least, KEEL_CALIBRATION_LIMIT)) {
        way = UPWARDS;
    } else if (is_alone && keel_range_contains(says, -KEEL_CALIBRATION_LIMIT, -least)) {
        way = DOWNWARDS;
    } else {
        /* It leans, or says too much. */
    }
    return way;
}

uint32_t keel_calibration_side(const float mean[KEEL_CALIBRATION_AXES], float least, float most)
{
    const bool x_is_little = keel_range_contains(mean[0], -most, most);
    const bool y_is_little = keel_range_contains(mean[1], -most, most);
    const bool z_is_little = keel_range_contains(mean[2], -most, most);
    const uint32_t x = way_of(mean[0], y_is_little && z_is_little, least);
    const uint32_t y = way_of(mean[1], z_is_little && x_is_little, least);
    const uint32_t z = way_of(mean[2], x_is_little && y_is_little, least);
    uint32_t side = KEEL_CALIBRATION_SIDES;

    if (x != LEANS) {
        side = x - UPWARDS;
    } else if (y != LEANS) {
        side = (y - UPWARDS) + 2u;
    } else if (z != LEANS) {
        side = (z - UPWARDS) + 4u;
    } else {
        /* It leans. */
    }
    return side;
}

/* 0, which nobody believes, where both sides say about the same. */
/*@ requires \is_finite(up) && \is_finite(down) && \is_finite(gravity) && gravity > 0;
  @ assigns \nothing;
  @*/
static float scale_of(float up, float down, float gravity)
{
    const float span = up - down;

    return (span > gravity) ? ((2.0f * gravity) / span) : 0.0f;
}

/*@ requires \valid_read(sides);
  @ assigns \nothing;
  @ ensures \result <==> calibration_sides(*sides);
  @*/
static bool sides_fit(const keel_calibration_sides_t *sides)
{
    return keel_range_contains(sides->gravity, 0.0f, KEEL_CALIBRATION_LIMIT) &&
           (sides->gravity > 0.0f) &&
           keel_range_contains(sides->limit, 0.0f, KEEL_CALIBRATION_LIMIT);
}

keel_status_t keel_calibration_six(const keel_calibration_sides_t *sides,
                                   keel_calibration_correction_t *correction)
{
    const float *const up = sides->up;
    const float *const down = sides->down;
    keel_calibration_correction_t found;

    if (!sides_fit(sides)) {
        return KEEL_ERR_VALUE;
    }
    if (!are_within(up, -KEEL_CALIBRATION_LIMIT, KEEL_CALIBRATION_LIMIT) ||
        !are_within(down, -KEEL_CALIBRATION_LIMIT, KEEL_CALIBRATION_LIMIT)) {
        return KEEL_ERR_LIMITS;
    }
    found.offset[0] = 0.5f * (up[0] + down[0]);
    found.offset[1] = 0.5f * (up[1] + down[1]);
    found.offset[2] = 0.5f * (up[2] + down[2]);
    found.scale[0] = scale_of(up[0], down[0], sides->gravity);
    found.scale[1] = scale_of(up[1], down[1], sides->gravity);
    found.scale[2] = scale_of(up[2], down[2], sides->gravity);
    if (!are_within(found.offset, -sides->limit, sides->limit) ||
        !are_within(found.scale, KEEL_CALIBRATION_SCALE_MIN, KEEL_CALIBRATION_SCALE_MAX)) {
        return KEEL_ERR_LIMITS;
    }
    *correction = found;
    return KEEL_OK;
}

/*@ requires \valid_read(row + (0 .. 2)) && \valid_read(raw + (0 .. 2));
  @ assigns \nothing;
  @*/
static float row_product(const float row[KEEL_CALIBRATION_AXES],
                         const float raw[KEEL_CALIBRATION_AXES])
{
    return ((row[0] * raw[0]) + (row[1] * raw[1])) + (row[2] * raw[2]);
}

void keel_calibration_turn(const keel_calibration_rotation_t *turn,
                           const float raw[KEEL_CALIBRATION_AXES], keel_calibration_vector_t *out)
{
    out->axis[0] = row_product(turn->x, raw);
    out->axis[1] = row_product(turn->y, raw);
    out->axis[2] = row_product(turn->z, raw);
}
