/* SPDX-License-Identifier: Apache-2.0 */
#include "calibration.h"

#include <stdbool.h>

/* No comparison with NaN holds. */
static bool lies_in(float value, float least, float most)
{
    return (value >= least) && (value <= most);
}

static bool all_lie_in(const float value[KEEL_CALIBRATION_AXES], float least, float most)
{
    return lies_in(value[0], least, most) && lies_in(value[1], least, most) &&
           lies_in(value[2], least, most);
}

static uint16_t counted_once(uint16_t count)
{
    return (count < 65535u) ? (uint16_t)(count + 1u) : 65535u;
}

keel_status_t model_calibration_rest_init(keel_calibration_rest_t *rest,
                                          const keel_calibration_rest_config_t *config)
{
    /* CAL-001: a refusal changes nothing. */
    if (!all_lie_in(config->expected, -KEEL_CALIBRATION_LIMIT, KEEL_CALIBRATION_LIMIT)) {
        return KEEL_ERR_VALUE;
    }
    if (!(lies_in(config->spread, 0.0f, KEEL_CALIBRATION_LIMIT) &&
          lies_in(config->limit, 0.0f, KEEL_CALIBRATION_LIMIT) && (config->samples >= 1u) &&
          (config->samples <= KEEL_CALIBRATION_SAMPLES_MAX))) {
        return KEEL_ERR_LIMITS;
    }
    /* CAL-002, CAL-003 */
    model_calibration_rest_begin(rest);
    rest->config = *config;
    rest->per_sample = 1.0f / (float)config->samples;
    rest->state = KEEL_CALIBRATION_IDLE;
    for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
        rest->offset[k] = 0.0f;
    }
    return KEEL_OK;
}

/* CAL-003: all but the offset is forgotten. */
void model_calibration_rest_begin(keel_calibration_rest_t *rest)
{
    for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
        rest->first[k] = 0.0f;
        rest->sum[k] = 0.0f;
    }
    rest->count = 0u;
    rest->state = KEEL_CALIBRATION_COLLECTING;
    rest->restarts = 0u;
    rest->beyond = 0u;
}

/* CAL-005: the run is over; told once for each. */
static void give_up(keel_calibration_rest_t *rest)
{
    rest->restarts = (rest->count > 0u) ? counted_once(rest->restarts) : rest->restarts;
    rest->count = 0u;
}

/* CAL-004, CAL-005: differences to the first are added up while they are small. */
static void compare_with_first(keel_calibration_rest_t *rest,
                               const float sample[KEEL_CALIBRATION_AXES])
{
    float away[KEEL_CALIBRATION_AXES] = {0.0f, 0.0f, 0.0f};

    for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
        away[k] = sample[k] - rest->first[k];
    }
    if (all_lie_in(away, -rest->config.spread, rest->config.spread)) {
        for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
            rest->sum[k] = rest->sum[k] + away[k];
        }
        rest->count++;
    } else {
        give_up(rest);
    }
}

/* CAL-006, CAL-007: all three are believed, or none is taken. */
static void judge_mean(keel_calibration_rest_t *rest)
{
    float offset[KEEL_CALIBRATION_AXES] = {0.0f, 0.0f, 0.0f};
    uint16_t beyond = 0u;

    for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
        offset[k] = (rest->first[k] - rest->config.expected[k]) + (rest->sum[k] * rest->per_sample);
        if (!lies_in(offset[k], -rest->config.limit, rest->config.limit)) {
            beyond = (uint16_t)(beyond + (1u << k));
        }
    }
    rest->beyond = beyond;
    rest->state = KEEL_CALIBRATION_REFUSED;
    if (beyond == 0u) {
        for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
            rest->offset[k] = offset[k];
        }
        rest->state = KEEL_CALIBRATION_DONE;
    }
}

void model_calibration_rest_step(keel_calibration_rest_t *rest,
                                 const float sample[KEEL_CALIBRATION_AXES])
{
    if (rest->state == KEEL_CALIBRATION_COLLECTING) {
        if (!all_lie_in(sample, -KEEL_CALIBRATION_LIMIT, KEEL_CALIBRATION_LIMIT)) {
            give_up(rest);
        } else if (rest->count == 0u) {
            for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
                rest->first[k] = sample[k];
                rest->sum[k] = 0.0f;
            }
            rest->count = 1u;
        } else {
            compare_with_first(rest, sample);
        }
        if (rest->count >= rest->config.samples) {
            judge_mean(rest);
        }
    }
}

keel_status_t model_calibration_field_init(keel_calibration_field_t *field,
                                           const keel_calibration_field_config_t *config)
{
    /* CAL-008: a refusal changes nothing. */
    if (!(lies_in(config->highest, -KEEL_CALIBRATION_LIMIT, KEEL_CALIBRATION_LIMIT) &&
          lies_in(config->lowest, -KEEL_CALIBRATION_LIMIT, config->highest))) {
        return KEEL_ERR_VALUE;
    }
    if (!(lies_in(config->span_max, 0.0f, 2.0f * KEEL_CALIBRATION_LIMIT) &&
          (config->span_min > 0.0f) && (config->span_min <= config->span_max) &&
          lies_in(config->limit, 0.0f, KEEL_CALIBRATION_LIMIT))) {
        return KEEL_ERR_LIMITS;
    }
    /* CAL-009 */
    field->config = *config;
    model_calibration_field_begin(field);
    field->state = KEEL_CALIBRATION_IDLE;
    for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
        field->offset[k] = 0.0f;
    }
    return KEEL_OK;
}

/* CAL-009: nothing has been seen; all but the offset is forgotten. */
void model_calibration_field_begin(keel_calibration_field_t *field)
{
    for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
        field->lowest[k] = field->config.highest;
        field->highest[k] = field->config.lowest;
    }
    field->state = KEEL_CALIBRATION_COLLECTING;
    field->dropped = 0u;
}

/* CAL-010 */
void model_calibration_field_step(keel_calibration_field_t *field,
                                  const float sample[KEEL_CALIBRATION_AXES])
{
    const bool collects = field->state == KEEL_CALIBRATION_COLLECTING;
    const bool sane = all_lie_in(sample, field->config.lowest, field->config.highest);

    for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
        if (collects && sane) {
            field->lowest[k] = (sample[k] < field->lowest[k]) ? sample[k] : field->lowest[k];
            field->highest[k] = (sample[k] > field->highest[k]) ? sample[k] : field->highest[k];
        }
    }
    if (collects && !sane) {
        field->dropped = counted_once(field->dropped);
    }
}

/* The vehicle's part of what was seen. */
static float centre(const keel_calibration_field_t *field, uint32_t axis)
{
    return 0.5f * (field->lowest[axis] + field->highest[axis]);
}

/* CAL-011: what is missing first, then what is wrong. */
keel_calibration_verdict_t model_calibration_field_axis(const keel_calibration_field_t *field,
                                                        uint32_t axis)
{
    const float span = field->highest[axis] - field->lowest[axis];

    if (!(span >= field->config.span_min)) {
        return KEEL_CALIBRATION_NARROW;
    }
    if (span > field->config.span_max) {
        return KEEL_CALIBRATION_WIDE;
    }
    if (!lies_in(centre(field, axis), -field->config.limit, field->config.limit)) {
        return KEEL_CALIBRATION_BEYOND;
    }
    return KEEL_CALIBRATION_FIT;
}

keel_status_t model_calibration_field_finish(keel_calibration_field_t *field)
{
    /* CAL-012: all three fit, or none is taken. */
    if (field->state != KEEL_CALIBRATION_COLLECTING) {
        return KEEL_ERR_STATE;
    }
    if ((model_calibration_field_axis(field, 0u) != KEEL_CALIBRATION_FIT) ||
        (model_calibration_field_axis(field, 1u) != KEEL_CALIBRATION_FIT) ||
        (model_calibration_field_axis(field, 2u) != KEEL_CALIBRATION_FIT)) {
        return KEEL_ERR_LIMITS;
    }
    for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
        field->offset[k] = centre(field, k);
    }
    field->state = KEEL_CALIBRATION_DONE;
    return KEEL_OK;
}

/* CAL-014 */
void model_calibration_apply(const float offset[KEEL_CALIBRATION_AXES],
                             const float raw[KEEL_CALIBRATION_AXES], keel_calibration_vector_t *out)
{
    for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
        out->axis[k] = raw[k] - offset[k];
    }
}

/* CAL-015 */
void model_calibration_correct(const keel_calibration_correction_t *correction,
                               const float raw[KEEL_CALIBRATION_AXES],
                               keel_calibration_vector_t *out)
{
    for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
        const float less = raw[k] - correction->offset[k];

        out->axis[k] = less * correction->scale[k];
    }
}

/* CAL-016: the side, of six, on which it has enough along one axis and little beside it. */
uint32_t model_calibration_side(const float mean[KEEL_CALIBRATION_AXES], float least, float most)
{
    for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
        const bool alone = lies_in(mean[(k + 1u) % 3u], -most, most) &&
                           lies_in(mean[(k + 2u) % 3u], -most, most);

        if (alone && lies_in(mean[k], least, KEEL_CALIBRATION_LIMIT)) {
            return 2u * k;
        }
        if (alone && lies_in(mean[k], -KEEL_CALIBRATION_LIMIT, -least)) {
            return (2u * k) + 1u;
        }
    }
    return KEEL_CALIBRATION_SIDES;
}

/* CAL-017: the scale of an axis; none when both sides say about the same. */
static float scale_on(const keel_calibration_sides_t *sides, uint32_t k)
{
    const float span = sides->up[k] - sides->down[k];

    if (span > sides->gravity) {
        return (2.0f * sides->gravity) / span;
    }
    return 0.0f;
}

/* CAL-017: all three are believed, or none is taken. */
keel_status_t model_calibration_six(const keel_calibration_sides_t *sides,
                                    keel_calibration_correction_t *correction)
{
    keel_calibration_correction_t found;

    if (!((sides->gravity > 0.0f) && (sides->gravity <= KEEL_CALIBRATION_LIMIT) &&
          lies_in(sides->limit, 0.0f, KEEL_CALIBRATION_LIMIT))) {
        return KEEL_ERR_VALUE;
    }
    for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
        found.offset[k] = 0.5f * (sides->up[k] + sides->down[k]);
        found.scale[k] = scale_on(sides, k);
    }
    if (!(all_lie_in(sides->up, -KEEL_CALIBRATION_LIMIT, KEEL_CALIBRATION_LIMIT) &&
          all_lie_in(sides->down, -KEEL_CALIBRATION_LIMIT, KEEL_CALIBRATION_LIMIT) &&
          all_lie_in(found.offset, -sides->limit, sides->limit) &&
          all_lie_in(found.scale, KEEL_CALIBRATION_SCALE_MIN, KEEL_CALIBRATION_SCALE_MAX))) {
        return KEEL_ERR_LIMITS;
    }
    *correction = found;
    return KEEL_OK;
}

/* CAL-018: products are added from the left. */
static float sum_of_products(const float a[KEEL_CALIBRATION_AXES],
                             const float b[KEEL_CALIBRATION_AXES])
{
    float sum = a[0] * b[0];

    for (uint32_t i = 1u; i < KEEL_CALIBRATION_AXES; i++) {
        sum = sum + (a[i] * b[i]);
    }
    return sum;
}

void model_calibration_turn(const keel_calibration_rotation_t *turn,
                            const float raw[KEEL_CALIBRATION_AXES], keel_calibration_vector_t *out)
{
    out->axis[0] = sum_of_products(turn->x, raw);
    out->axis[1] = sum_of_products(turn->y, raw);
    out->axis[2] = sum_of_products(turn->z, raw);
}
