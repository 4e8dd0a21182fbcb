/* SPDX-License-Identifier: Apache-2.0 */
#include "axis.h"

#include <stdbool.h>

/* No comparison with NaN holds. */
static bool lies_in(float value, float least, float most)
{
    return (value >= least) && (value <= most);
}

/* The number of a range that is next to a given one; the lower end for NaN. */
static float next_in(float value, float least, float most)
{
    const float raised = (value > least) ? value : least;

    return (raised < most) ? raised : most;
}

static bool axis_config_taken(const keel_axis_config_t *c)
{
    return lies_in(c->bias_limit, 0.0f, KEEL_AXIS_BIAS_LIMIT) &&
           lies_in(c->position_gate, 0.0f, KEEL_AXIS_POSITION_LIMIT) &&
           lies_in(c->velocity_gate, 0.0f, KEEL_AXIS_VELOCITY_LIMIT) && (c->late_steps != 0u) &&
           (c->late_steps <= c->lost_steps) && (c->settle_fixes != 0u) && (c->jump_fixes != 0u);
}

keel_status_t model_axis_init(keel_axis_t *axis, const keel_axis_config_t *config)
{
    /* AXI-001: a refusal changes nothing. */
    if (!lies_in(config->rate_hz, KEEL_AXIS_RATE_MIN_HZ, KEEL_AXIS_RATE_MAX_HZ)) {
        return KEEL_ERR_RATE;
    }
    if (!(lies_in(config->position_gain, 0.0f, KEEL_AXIS_PART_LIMIT) &&
          lies_in(config->velocity_gain, 0.0f, KEEL_AXIS_VELOCITY_GAIN_LIMIT) &&
          lies_in(config->rate_gain, 0.0f, KEEL_AXIS_PART_LIMIT) &&
          lies_in(config->bias_gain, 0.0f, KEEL_AXIS_BIAS_GAIN_LIMIT))) {
        return KEEL_ERR_GAIN;
    }
    if (!axis_config_taken(config)) {
        return KEEL_ERR_LIMITS;
    }
    /* AXI-002 */
    axis->config = *config;
    axis->step = 1.0f / config->rate_hz;
    axis->half_step = 0.5f / config->rate_hz;
    model_axis_restart(axis);
    return KEEL_OK;
}

/* AXI-003: as if no fix had ever come. */
void model_axis_restart(keel_axis_t *axis)
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

/* AXI-004, AXI-005: the acceleration is constant for a step; without one the velocity is. */
static void integrate(keel_axis_t *axis, const keel_axis_sample_t *sample)
{
    const bool sees = sample->has_acceleration &&
                      lies_in(sample->acceleration, -KEEL_AXIS_ACCELERATION_LIMIT,
                              KEEL_AXIS_ACCELERATION_LIMIT);
    const float a = sees ? (sample->acceleration - axis->bias) : 0.0f;
    const float v = axis->velocity;
    const float next = next_in(v + (axis->step * a), -KEEL_AXIS_VELOCITY_LIMIT,
                               KEEL_AXIS_VELOCITY_LIMIT);

    axis->position = next_in(axis->position + (axis->half_step * (v + next)),
                             -KEEL_AXIS_POSITION_LIMIT, KEEL_AXIS_POSITION_LIMIT);
    axis->velocity = next;
    axis->flags = sees ? 0u : KEEL_AXIS_BLIND;
}

/* AXI-007: whether the source calls a fix usable, and all of its numbers are in range. */
static bool fix_usable(const keel_axis_sample_t *sample)
{
    return sample->is_usable &&
           lies_in(sample->position, -KEEL_AXIS_POSITION_LIMIT, KEEL_AXIS_POSITION_LIMIT) &&
           (!sample->has_velocity ||
            lies_in(sample->velocity, -KEEL_AXIS_VELOCITY_LIMIT, KEEL_AXIS_VELOCITY_LIMIT));
}

/* AXI-009: what a fix says is all that is known. */
static void begin_at(keel_axis_t *axis, const keel_axis_sample_t *sample)
{
    axis->position = sample->position;
    axis->velocity = sample->has_velocity ? sample->velocity : 0.0f;
    axis->age = 0u;
    axis->agreed = 0u;
    axis->jumped = 0u;
    axis->flags |= KEEL_AXIS_FIXED | KEEL_AXIS_BEGUN;
}

/* AXI-004: the formulas of axis.h. */
static void make_up(keel_axis_t *axis, float way, float rate)
{
    const keel_axis_config_t *const c = &axis->config;

    axis->position = next_in(axis->position + (c->position_gain * way), -KEEL_AXIS_POSITION_LIMIT,
                             KEEL_AXIS_POSITION_LIMIT);
    axis->velocity = next_in(axis->velocity + ((c->velocity_gain * way) + (c->rate_gain * rate)),
                             -KEEL_AXIS_VELOCITY_LIMIT, KEEL_AXIS_VELOCITY_LIMIT);
    axis->bias = next_in(axis->bias - (c->bias_gain * way), -c->bias_limit, c->bias_limit);
    axis->age = 0u;
    axis->agreed = (axis->agreed < c->settle_fixes) ? (uint16_t)(axis->agreed + 1u)
                                                    : c->settle_fixes;
    axis->jumped = 0u;
    axis->flags |= KEEL_AXIS_FIXED;
}

/* AXI-009, AXI-013: jumps count while each is near the one before; the count begins at 1. */
static void meet_jump(keel_axis_t *axis, const keel_axis_sample_t *sample)
{
    const keel_axis_config_t *const c = &axis->config;
    const float hop = sample->position - axis->jump;
    uint32_t row = 1u;

    if ((axis->jumped != 0u) && lies_in(hop, -c->position_gate, c->position_gate)) {
        axis->flags |= KEEL_AXIS_AGAIN;
        row += axis->jumped;
    }
    if (row >= c->jump_fixes) {
        begin_at(axis, sample);
    } else {
        axis->jump = sample->position;
        axis->jumped = (uint16_t)row;
        axis->agreed = 0u;
        axis->flags |= KEEL_AXIS_JUMPED;
    }
}

/* AXI-008: how far a fix is off decides. */
static void meet_fix(keel_axis_t *axis, const keel_axis_sample_t *sample)
{
    const keel_axis_config_t *const c = &axis->config;
    const float way = sample->position - axis->position;
    const float rate = sample->has_velocity ? (sample->velocity - axis->velocity) : 0.0f;
    const bool near = lies_in(way, -c->position_gate, c->position_gate) &&
                      lies_in(rate, -c->velocity_gate, c->velocity_gate);

    if (axis->age >= c->lost_steps) {
        begin_at(axis, sample);
    } else if (near) {
        make_up(axis, way, rate);
    } else {
        meet_jump(axis, sample);
    }
}

void model_axis_step(keel_axis_t *axis, const keel_axis_sample_t *sample)
{
    const keel_axis_config_t *const c = &axis->config;

    integrate(axis, sample);
    /* AXI-010: one step older, until a fix is taken. */
    axis->age = (axis->age < c->lost_steps) ? (uint16_t)(axis->age + 1u) : c->lost_steps;
    if (sample->has_fix && fix_usable(sample)) {
        meet_fix(axis, sample);
    } else if (sample->has_fix) {
        axis->agreed = 0u;
        axis->flags |= KEEL_AXIS_UNUSABLE;
    }
    /* AXI-012 */
    if (axis->age >= c->lost_steps) {
        axis->quality = KEEL_AXIS_NONE;
    } else if ((axis->age < c->late_steps) && (axis->agreed >= c->settle_fixes) &&
               ((axis->flags & KEEL_AXIS_BLIND) == 0u)) {
        axis->quality = KEEL_AXIS_GOOD;
    } else {
        axis->quality = KEEL_AXIS_POOR;
    }
}
