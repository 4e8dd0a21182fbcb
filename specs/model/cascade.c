/* SPDX-License-Identifier: Apache-2.0 */
/* The stages of the cascade; their axes are in cascade_parts.c. */
#include "cascade.h"

#include "keel/flight/mode.h"
#include "pid.h"

#define BIT(axis) (1u << (axis))

#define RATES                                                                                      \
    (BIT(KEEL_CASCADE_ROLL_RATE) | BIT(KEEL_CASCADE_PITCH_RATE) | BIT(KEEL_CASCADE_YAW_RATE))
#define ANGLES   (BIT(KEEL_CASCADE_ROLL) | BIT(KEEL_CASCADE_PITCH))
#define VERTICAL (BIT(KEEL_CASCADE_CLIMB) | BIT(KEEL_CASCADE_HEIGHT))
#define LEVEL                                                                                      \
    (BIT(KEEL_CASCADE_NORTH_SPEED) | BIT(KEEL_CASCADE_EAST_SPEED) | BIT(KEEL_CASCADE_NORTH) |      \
     BIT(KEEL_CASCADE_EAST))

static bool number_within(float value, float least, float greatest)
{
    return (value >= least) && (value <= greatest);
}

static float nearest_within(float value, float least, float greatest)
{
    const float above = (value > least) ? value : least;

    return (above < greatest) ? above : greatest;
}

keel_status_t model_cascade_init(keel_cascade_t *cascade, const keel_cascade_config_t *config)
{
    keel_status_t status = KEEL_OK;

    /* CAS-002: the first axis that is not good is told, and nothing is changed. */
    for (uint32_t i = KEEL_CASCADE_AXES; i > 0u; i--) {
        const keel_status_t of_axis = model_cascade_check(config, i - 1u);

        status = (of_axis != KEEL_OK) ? of_axis : status;
    }
    if (status != KEEL_OK) {
        return status;
    }
    for (uint32_t i = 0u; i < KEEL_CASCADE_AXES; i++) {
        (void)model_pid_init(&cascade->axis[i].pid, &config->pid[i]);
        cascade->axis[i].reach = config->reach[i];
        cascade->axis[i].limit = (keel_cascade_limit_t){false, false};
        cascade->axis[i].running = false;
        cascade->axis[i].held = false;
    }
    cascade->fence.gain = config->acceleration * config->reaction_s;
    cascade->fence.half_gain = 0.5f * cascade->fence.gain;
    cascade->fence.reaction_s = config->reaction_s;
    cascade->fence.twice_braking = 2.0f * config->braking;
    cascade->hover = config->hover;
    cascade->axes = 0u;
    cascade->gave_way = 0u;
    cascade->velocity = (keel_cascade_vector_t){0.0f, 0.0f, 0.0f};
    cascade->tilt = (keel_cascade_tilt_t){0.0f, 0.0f};
    cascade->thrust = 0.0f;
    cascade->rates = (keel_cascade_tilt_t){0.0f, 0.0f};
    cascade->command = (keel_mixer_command_t){0.0f, 0.0f, 0.0f, 0.0f};
    return KEEL_OK;
}

/* CAS-003 */
static uint32_t axes_of(uint8_t mode)
{
    uint32_t axes;

    switch (mode) {
    case KEEL_MODE_ACRO:
        axes = RATES;
        break;
    case KEEL_MODE_LAND:
        axes = RATES | ANGLES | BIT(KEEL_CASCADE_CLIMB);
        break;
    case KEEL_MODE_ANGLE:
        axes = RATES | ANGLES;
        break;
    case KEEL_MODE_ALTITUDE:
        axes = RATES | ANGLES | VERTICAL;
        break;
    case KEEL_MODE_POSITION:
    case KEEL_MODE_RETURN:
        axes = RATES | ANGLES | VERTICAL | LEVEL;
        break;
    default:
        axes = 0u;
        break;
    }
    return axes;
}

void model_cascade_enter(keel_cascade_t *cascade, uint8_t mode)
{
    cascade->axes = axes_of(mode);
    for (uint32_t i = 0u; i < KEEL_CASCADE_AXES; i++) {
        if ((cascade->axes & BIT(i)) == 0u) {
            cascade->axis[i].running = false;
        }
    }
    if (cascade->axes == 0u) {
        cascade->command = (keel_mixer_command_t){0.0f, 0.0f, 0.0f, 0.0f};
    }
}

/* CAS-005: an axis that does not run asks for nothing, and is asked for nothing. */
static float output_of(const keel_cascade_axis_t *axis)
{
    return axis->running ? axis->pid.output : 0.0f;
}

static float setpoint_of(const keel_cascade_axis_t *axis)
{
    return axis->running ? axis->pid.setpoint : 0.0f;
}

/* One axis; the mode flies it or not. */
static float axis_output(keel_cascade_t *cascade, uint32_t axis, keel_cascade_input_t input)
{
    input.valid = input.valid && (((cascade->axes >> axis) & 1u) != 0u);
    model_cascade_axis_step(&cascade->axis[axis], &input);
    return output_of(&cascade->axis[axis]);
}

/* CAS-008: where the mixer gave less torque, more of it in the same direction is of no use. */
static float torque_of(keel_cascade_t *cascade, uint32_t axis, float asked, float rate, bool less,
                       float last)
{
    const keel_cascade_input_t input = {
        asked, rate, last, {less && (last < 0.0f), less && (last > 0.0f)}, true};

    return axis_output(cascade, axis, input);
}

void model_cascade_rate_step(keel_cascade_t *cascade, keel_cascade_rates_t asked,
                             keel_attitude_vector_t rate, uint32_t gave_way)
{
    const keel_mixer_command_t last = cascade->command;
    const bool tilt = (gave_way & KEEL_MIXER_TILT) != 0u;
    const bool yaw = (gave_way & KEEL_MIXER_YAW) != 0u;

    cascade->gave_way = gave_way;
    cascade->command.roll = torque_of(cascade, KEEL_CASCADE_ROLL_RATE, asked.roll, rate.x, tilt,
                                      last.roll);
    cascade->command.pitch = torque_of(cascade, KEEL_CASCADE_PITCH_RATE, asked.pitch, rate.y, tilt,
                                       last.pitch);
    cascade->command.yaw = torque_of(cascade, KEEL_CASCADE_YAW_RATE, asked.yaw, rate.z, yaw,
                                     last.yaw);
    cascade->command.thrust = 0.0f;
    if (cascade->axes != 0u) {
        cascade->command.thrust = nearest_within(asked.thrust, 0.0f, 1.0f);
    }
}

/* What an axis asks of the one that is three below it. */
static float asked_below(keel_cascade_t *cascade, uint32_t axis, float asked, float measured,
                         bool valid)
{
    const keel_cascade_axis_t *const below = &cascade->axis[axis - 3u];
    const keel_cascade_input_t input = {asked, measured, setpoint_of(below), below->limit, valid};

    return axis_output(cascade, axis, input);
}

/* CAS-009 */
void model_cascade_angle_step(keel_cascade_t *cascade, keel_cascade_tilt_t asked,
                              keel_attitude_vector_t down, bool valid)
{
    cascade->rates.roll = asked_below(cascade, KEEL_CASCADE_ROLL, asked.roll, down.y, valid);
    cascade->rates.pitch = asked_below(cascade, KEEL_CASCADE_PITCH, asked.pitch, -down.x, valid);
}

/* CAS-013 */
void model_cascade_position_step(keel_cascade_t *cascade, keel_cascade_vector_t asked,
                                 const keel_cascade_estimate_t *estimate)
{
    cascade->velocity.north = asked_below(cascade, KEEL_CASCADE_NORTH, asked.north,
                                          estimate->position.north, estimate->has_place);
    cascade->velocity.east = asked_below(cascade, KEEL_CASCADE_EAST, asked.east,
                                         estimate->position.east, estimate->has_place);
    cascade->velocity.up = asked_below(cascade, KEEL_CASCADE_HEIGHT, asked.up,
                                       estimate->position.up, estimate->has_height);
}

/* CAS-011: x' and v' of cascade.h, from the distance to a side and the speed towards it. */
static bool side_near(const keel_cascade_fence_t *fence, float way, float speed)
{
    const float left = way - (fence->reaction_s * (speed + fence->half_gain));
    const float fastest = speed + fence->gain;
    const float towards = (fastest > 0.0f) ? (fastest * fastest) : 0.0f;

    return !(towards <= (fence->twice_braking * left));
}

/* CAS-010 and CAS-011: an axis of the velocity stage, which does not go where the fence is near. */
static float driven(keel_cascade_t *cascade, uint32_t axis, keel_cascade_input_t input,
                    float position)
{
    const float reach = cascade->axis[axis + 3u].reach;
    const bool known = number_within(position, -KEEL_PID_INPUT_LIMIT, KEEL_PID_INPUT_LIMIT) &&
                       number_within(input.measured, -KEEL_PID_INPUT_LIMIT, KEEL_PID_INPUT_LIMIT);
    const bool above = !known || side_near(&cascade->fence, reach - position, input.measured);
    const bool below = !known || side_near(&cascade->fence, reach + position, -input.measured);
    const bool towards = (above && (input.setpoint > 0.0f)) || (below && (input.setpoint < 0.0f));
    keel_cascade_limit_t *const limit = &cascade->axis[axis].limit;
    float output;

    input.setpoint = towards ? 0.0f : input.setpoint;
    output = axis_output(cascade, axis, input);
    limit->at_min = limit->at_min || below;
    limit->at_max = limit->at_max || above;
    return output;
}

/* CAS-006: whether more along an axis of the Earth is more along one of the body that is at its
 * limit. `part` is that of the body's axis which lies along the Earth's. */
static bool no_more(keel_cascade_limit_t body, float part)
{
    return (body.at_max && (part > 0.5f)) || (body.at_min && (part < -0.5f));
}

void model_cascade_velocity_step(keel_cascade_t *cascade, keel_cascade_vector_t asked,
                                 const keel_cascade_estimate_t *estimate)
{
    const keel_cascade_axis_t *const roll = &cascade->axis[KEEL_CASCADE_ROLL];
    const keel_cascade_axis_t *const pitch = &cascade->axis[KEEL_CASCADE_PITCH];
    /* Nose down is forward. */
    const keel_cascade_limit_t forward = {pitch->limit.at_max, pitch->limit.at_min};
    const keel_cascade_limit_t right = roll->limit;
    const bool valid = estimate->has_place &&
                       number_within(estimate->forward_north, -1.0009765625f, 1.0009765625f) &&
                       number_within(estimate->forward_east, -1.0009765625f, 1.0009765625f);
    const float n = valid ? estimate->forward_north : 0.0f;
    const float e = valid ? estimate->forward_east : 0.0f;
    /* CAS-007: the accelerations that are flown. */
    const float ahead = -KEEL_CASCADE_GRAVITY * setpoint_of(pitch);
    const float aside = KEEL_CASCADE_GRAVITY * setpoint_of(roll);
    const keel_cascade_input_t north = {
        asked.north,
        estimate->velocity.north,
        (n * ahead) - (e * aside),
        {no_more(forward, -n) || no_more(right, e), no_more(forward, n) || no_more(right, -e)},
        valid};
    const keel_cascade_input_t east = {
        asked.east,
        estimate->velocity.east,
        (e * ahead) + (n * aside),
        {no_more(forward, -e) || no_more(right, -n), no_more(forward, e) || no_more(right, n)},
        valid};
    const keel_cascade_input_t up = {asked.up,
                                     estimate->velocity.up,
                                     cascade->command.thrust - cascade->hover,
                                     {(cascade->gave_way & KEEL_MIXER_RAISED) != 0u,
                                      (cascade->gave_way & KEEL_MIXER_LOWERED) != 0u},
                                     estimate->has_height};
    const float a = driven(cascade, KEEL_CASCADE_NORTH_SPEED, north, estimate->position.north);
    const float b = driven(cascade, KEEL_CASCADE_EAST_SPEED, east, estimate->position.east);
    const float lift = driven(cascade, KEEL_CASCADE_CLIMB, up, estimate->position.up);

    /* CAS-010 */
    cascade->tilt.roll = nearest_within(((n * b) - (e * a)) * KEEL_CASCADE_PER_GRAVITY,
                                        -roll->reach, roll->reach);
    cascade->tilt.pitch = nearest_within(-((n * a) + (e * b)) * KEEL_CASCADE_PER_GRAVITY,
                                         -pitch->reach, pitch->reach);
    cascade->thrust = nearest_within(cascade->hover + lift, 0.0f, 1.0f);
}
