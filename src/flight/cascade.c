/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/flight/cascade.h"

#include "keel/internal/flight/mode.h"
#include "keel/middleware/range.h"

/* An axis of the angle stage acts on that of the rate stage which is so much below it, and one of
 * the position stage on that of the velocity stage. */
#define STAGE 3u

/* The axes of each stage, as bits. */
#define ALL_RATES  0x07u
#define ALL_ANGLES 0x18u
#define CLIMB_BIT  0x80u
#define HEIGHT_BIT 0x400u
#define ALL_AXES   0x7FFu

/*@ requires axis < KEEL_CASCADE_AXES;
  @ assigns \nothing;
  @ ensures \is_finite(\result);
  @*/
static float greatest_reach(uint32_t axis)
{
    if (axis <= KEEL_CASCADE_YAW_RATE) {
        return KEEL_CASCADE_RATE_MAX;
    }
    if (axis <= KEEL_CASCADE_PITCH) {
        return KEEL_CASCADE_TILT_MAX;
    }
    return (axis <= KEEL_CASCADE_CLIMB) ? KEEL_CASCADE_SPEED_MAX : KEEL_CASCADE_DISTANCE_MAX;
}

/*@ requires axis < KEEL_CASCADE_AXES;
  @ assigns \nothing;
  @*/
static bool is_speed(uint32_t axis)
{
    return (axis == KEEL_CASCADE_NORTH_SPEED) || (axis == KEEL_CASCADE_EAST_SPEED);
}

/* The greatest output that what is below an axis takes. */
/*@ requires \valid_read(config) && axis < KEEL_CASCADE_AXES;
  @ assigns \nothing;
  @*/
static float most_taken(const keel_cascade_config_t *config, uint32_t axis)
{
    const float roll = config->reach[KEEL_CASCADE_ROLL];
    const float pitch = config->reach[KEEL_CASCADE_PITCH];

    if (axis <= KEEL_CASCADE_YAW_RATE) {
        return 1.0f;
    }
    if (is_speed(axis)) {
        return KEEL_CASCADE_DIAGONAL *
               keel_range_clamp((roll < pitch) ? roll : pitch, 0.0f, KEEL_CASCADE_TILT_MAX);
    }
    return (axis == KEEL_CASCADE_CLIMB) ? (1.0f - config->hover) : config->reach[axis - STAGE];
}

/* Not more than what is below takes. */
/*@ requires \valid_read(config) && axis < KEEL_CASCADE_AXES;
  @ assigns \nothing;
  @*/
static bool is_output_taken(const keel_cascade_config_t *config, uint32_t axis)
{
    const keel_pid_config_t *const pid = &config->pid[axis];
    const float most = most_taken(config, axis);
    const float least = (axis == KEEL_CASCADE_CLIMB) ? -config->hover : -most;

    return (pid->output_min >= least) && (pid->output_max <= most);
}

/* An acceleration that is asked for is enough to brake, and not beyond that which is counted on. */
/*@ requires \valid_read(config) && axis < KEEL_CASCADE_AXES;
  @ assigns \nothing;
  @*/
static bool is_braking(const keel_cascade_config_t *config, uint32_t axis)
{
    const keel_pid_config_t *const pid = &config->pid[axis];

    return !is_speed(axis) ||
           ((pid->output_max >= config->braking) && (pid->output_max <= config->acceleration) &&
            (pid->output_min <= -config->braking) && (pid->output_min >= -config->acceleration));
}

/* The fence is looked at with each step of the velocity stage. */
/*@ requires \valid_read(config) && axis < KEEL_CASCADE_AXES;
  @ assigns \nothing;
  @*/
static bool is_in_time(const keel_cascade_config_t *config, uint32_t axis)
{
    return !(is_speed(axis) || (axis == KEEL_CASCADE_CLIMB)) ||
           ((config->reaction_s * config->pid[axis].rate_hz) >= 1.0f);
}

/*@ requires \valid_read(config);
  @ assigns \nothing;
  @*/
static bool are_numbers(const keel_cascade_config_t *config)
{
    return keel_range_contains(config->hover, 0.0f, 1.0f) &&
           keel_range_contains(config->acceleration, KEEL_CASCADE_BRAKING_MIN,
                               KEEL_CASCADE_ACCELERATION_MAX) &&
           keel_range_contains(config->braking, KEEL_CASCADE_BRAKING_MIN,
                               KEEL_CASCADE_ACCELERATION_MAX) &&
           keel_range_contains(config->reaction_s, 0.0f, KEEL_CASCADE_REACTION_MAX_S);
}

keel_status_t keel_cascade_check(const keel_cascade_config_t *config, uint32_t axis)
{
    keel_pid_t pid;

    if (axis >= KEEL_CASCADE_AXES) {
        return KEEL_ERR_INPUT;
    }
    if (!(are_numbers(config) &&
          keel_range_contains(config->reach[axis], 0.0f, greatest_reach(axis)) &&
          is_output_taken(config, axis) && is_braking(config, axis) && is_in_time(config, axis))) {
        return KEEL_ERR_LIMITS;
    }
    return keel_pid_init(&pid, &config->pid[axis]);
}

/*@ requires \valid(axis) && \valid_read(config) && \separated(axis, config);
  @ assigns *axis;
  @*/
static void make_axis(keel_cascade_axis_t *axis, const keel_pid_config_t *config, float reach)
{
    (void)keel_pid_init(&axis->pid, config);
    axis->reach = reach;
    axis->limit.at_min = false;
    axis->limit.at_max = false;
    axis->running = false;
    axis->held = false;
}

/*@ requires \valid(command);
  @ assigns *command;
  @ ensures mixer_command(*command);
  @ ensures command->roll == 0 && command->pitch == 0 && command->yaw == 0 && command->thrust == 0;
  @*/
static void command_nothing(keel_mixer_command_t *command)
{
    command->roll = 0.0f;
    command->pitch = 0.0f;
    command->yaw = 0.0f;
    command->thrust = 0.0f;
}

keel_status_t keel_cascade_init(keel_cascade_t *cascade, const keel_cascade_config_t *config)
{
    /*@ loop invariant 0 <= i <= KEEL_CASCADE_AXES;
      @ loop assigns i;
      @ loop variant KEEL_CASCADE_AXES - i;
      @*/
    for (uint32_t i = 0u; i < KEEL_CASCADE_AXES; i++) {
        const keel_status_t status = keel_cascade_check(config, i);

        if (status != KEEL_OK) {
            return status;
        }
    }
    /*@ loop invariant 0 <= i <= KEEL_CASCADE_AXES;
      @ loop assigns i, cascade->axis[0 .. KEEL_CASCADE_AXES - 1];
      @ loop variant KEEL_CASCADE_AXES - i;
      @*/
    for (uint32_t i = 0u; i < KEEL_CASCADE_AXES; i++) {
        make_axis(&cascade->axis[i], &config->pid[i], config->reach[i]);
    }
    cascade->fence.gain = config->acceleration * config->reaction_s;
    cascade->fence.half_gain = 0.5f * cascade->fence.gain;
    cascade->fence.reaction_s = config->reaction_s;
    cascade->fence.twice_braking = 2.0f * config->braking;
    cascade->hover = config->hover;
    cascade->axes = 0u;
    cascade->gave_way = 0u;
    cascade->velocity.north = 0.0f;
    cascade->velocity.east = 0.0f;
    cascade->velocity.up = 0.0f;
    cascade->tilt.roll = 0.0f;
    cascade->tilt.pitch = 0.0f;
    cascade->thrust = 0.0f;
    cascade->rates.roll = 0.0f;
    cascade->rates.pitch = 0.0f;
    command_nothing(&cascade->command);
    return KEEL_OK;
}

/*@ assigns \nothing;
  @ ensures \result == cascade_axes(mode);
  @*/
static uint32_t axes_flown(uint8_t mode)
{
    static const uint32_t flown[KEEL_MODE_NONE] = {
        [KEEL_MODE_ACRO] = ALL_RATES,
        [KEEL_MODE_LAND] = ALL_RATES | ALL_ANGLES | CLIMB_BIT,
        [KEEL_MODE_ANGLE] = ALL_RATES | ALL_ANGLES,
        [KEEL_MODE_ALTITUDE] = ALL_RATES | ALL_ANGLES | CLIMB_BIT | HEIGHT_BIT,
        [KEEL_MODE_POSITION] = ALL_AXES,
        [KEEL_MODE_RETURN] = ALL_AXES,
    };

    return (mode < KEEL_MODE_NONE) ? flown[mode] : 0u;
}

/*@ requires \valid_read(cascade) && axis < KEEL_CASCADE_AXES;
  @ assigns \nothing;
  @*/
static bool is_flown(const keel_cascade_t *cascade, uint32_t axis)
{
    return ((cascade->axes >> axis) & 1u) != 0u;
}

void keel_cascade_enter(keel_cascade_t *cascade, uint8_t mode)
{
    cascade->axes = axes_flown(mode);
    /*@ loop invariant 0 <= i <= KEEL_CASCADE_AXES;
      @ loop invariant \forall integer k; 0 <= k < KEEL_CASCADE_AXES ==>
      @     (cascade->axis[k].running ==> \at(cascade->axis[k].running, Pre));
      @ loop assigns i, cascade->axis[0 .. KEEL_CASCADE_AXES - 1].running;
      @ loop variant KEEL_CASCADE_AXES - i;
      @*/
    for (uint32_t i = 0u; i < KEEL_CASCADE_AXES; i++) {
        cascade->axis[i].running = cascade->axis[i].running && is_flown(cascade, i);
    }
    if (cascade->axes == 0u) {
        command_nothing(&cascade->command);
    }
}

/* A set-point within reach of an axis; what the controller refuses is left to it. */
/*@ requires cascade_number(reach, 0, KEEL_CASCADE_DISTANCE_MAX);
  @ assigns \nothing;
  @*/
static float within_reach(float reach, float setpoint)
{
    return keel_range_contains(setpoint, -KEEL_PID_INPUT_LIMIT, KEEL_PID_INPUT_LIMIT)
               ? keel_range_clamp(setpoint, -reach, reach)
               : setpoint;
}

void keel_cascade_axis_step(keel_cascade_axis_t *axis, const keel_cascade_input_t *input)
{
    const float setpoint = within_reach(axis->reach, input->setpoint);
    keel_status_t status = KEEL_ERR_INPUT;

    if (!axis->running && input->valid) {
        axis->running = (keel_pid_enter(&axis->pid, setpoint, input->measured, input->flown) ==
                         KEEL_OK);
    }
    axis->running = axis->running && input->valid;
    if (axis->running) {
        status = keel_pid_step_within(&axis->pid, setpoint, input->measured, !input->below.at_max,
                                      !input->below.at_min);
    }
    axis->held = (status != KEEL_OK);
    axis->limit.at_min = input->below.at_min || (axis->pid.saturation == KEEL_PID_AT_MIN) ||
                         (input->setpoint < -axis->reach);
    axis->limit.at_max = input->below.at_max || (axis->pid.saturation == KEEL_PID_AT_MAX) ||
                         (input->setpoint > axis->reach);
}

/* The output of an axis: nothing when it does not run. */
/*@ requires \valid_read(axis);
  @ assigns \nothing;
  @ ensures \result == (axis->running ? axis->pid.output : 0.0f);
  @*/
static float asks_for(const keel_cascade_axis_t *axis)
{
    return axis->running ? axis->pid.output : 0.0f;
}

/* The set-point of an axis: where the axis above begins. */
/*@ requires \valid_read(axis);
  @ assigns \nothing;
  @ ensures \result == (axis->running ? axis->pid.setpoint : 0.0f);
  @*/
static float is_asked_for(const keel_cascade_axis_t *axis)
{
    return axis->running ? axis->pid.setpoint : 0.0f;
}

/* A torque that the mixer made less. */
/*@ assigns \nothing; */
static keel_cascade_limit_t torque_limit(bool limited, float torque)
{
    const keel_cascade_limit_t limit = {limited && (torque < 0.0f), limited && (torque > 0.0f)};

    return limit;
}

/* One axis of the rate stage, of whose last torque the mixer gave all or less; the torque that it
 * asks for. */
/*@ requires \valid(cascade) && axis <= KEEL_CASCADE_YAW_RATE;
  @ assigns cascade->axis[axis];
  @*/
static float turn_with(keel_cascade_t *cascade, uint32_t axis, float asked, float rate,
                       bool limited, float last)
{
    keel_cascade_input_t input = {
        .setpoint = asked, .measured = rate, .flown = last, .valid = is_flown(cascade, axis)};

    input.below = torque_limit(limited, last);
    keel_cascade_axis_step(&cascade->axis[axis], &input);
    return asks_for(&cascade->axis[axis]);
}

void keel_cascade_rate_step(keel_cascade_t *cascade, keel_cascade_rates_t asked,
                            keel_attitude_vector_t rate, uint32_t gave_way)
{
    keel_mixer_command_t *const command = &cascade->command;
    const bool tilt = (gave_way & KEEL_MIXER_TILT) != 0u;
    const bool yaw = (gave_way & KEEL_MIXER_YAW) != 0u;

    cascade->gave_way = gave_way;
    command->roll = turn_with(cascade, KEEL_CASCADE_ROLL_RATE, asked.roll, rate.x, tilt,
                              command->roll);
    command->pitch = turn_with(cascade, KEEL_CASCADE_PITCH_RATE, asked.pitch, rate.y, tilt,
                               command->pitch);
    command->yaw = turn_with(cascade, KEEL_CASCADE_YAW_RATE, asked.yaw, rate.z, yaw, command->yaw);
    command->thrust = (cascade->axes != 0u) ? keel_range_clamp(asked.thrust, 0.0f, 1.0f) : 0.0f;
}

/* One axis of the angle or the position stage, which acts on the axis STAGE below it; what it asks
 * for. */
/*@ requires \valid(cascade) && STAGE <= axis < KEEL_CASCADE_AXES;
  @ assigns cascade->axis[axis];
  @*/
static float lead_with(keel_cascade_t *cascade, uint32_t axis, float asked, float measured,
                       bool valid)
{
    const keel_cascade_axis_t *const below = &cascade->axis[axis - STAGE];
    keel_cascade_input_t input = {.setpoint = asked,
                                  .measured = measured,
                                  .flown = is_asked_for(below),
                                  .valid = valid && is_flown(cascade, axis)};

    input.below = below->limit;
    keel_cascade_axis_step(&cascade->axis[axis], &input);
    return asks_for(&cascade->axis[axis]);
}

void keel_cascade_angle_step(keel_cascade_t *cascade, keel_cascade_tilt_t asked,
                             keel_attitude_vector_t down, bool valid)
{
    cascade->rates.roll = lead_with(cascade, KEEL_CASCADE_ROLL, asked.roll, down.y, valid);
    cascade->rates.pitch = lead_with(cascade, KEEL_CASCADE_PITCH, asked.pitch, -down.x, valid);
}

void keel_cascade_position_step(keel_cascade_t *cascade, keel_cascade_vector_t asked,
                                const keel_cascade_estimate_t *estimate)
{
    const keel_cascade_vector_t *const position = &estimate->position;

    cascade->velocity.north = lead_with(cascade, KEEL_CASCADE_NORTH, asked.north, position->north,
                                        estimate->has_place);
    cascade->velocity.east = lead_with(cascade, KEEL_CASCADE_EAST, asked.east, position->east,
                                       estimate->has_place);
    cascade->velocity.up = lead_with(cascade, KEEL_CASCADE_HEIGHT, asked.up, position->up,
                                     estimate->has_height);
}

/* Whether a side that is so far away, towards which the aircraft moves, may be approached no
 * further: in the worst case, after the reaction time, there is just room to brake. */
/*@ requires \valid_read(fence);
  @ assigns \nothing;
  @*/
static bool is_side_near(const keel_cascade_fence_t *fence, float way, float speed)
{
    const float fastest = speed + fence->gain;
    const float left = way - (fence->reaction_s * (speed + fence->half_gain));
    const float square = (fastest > 0.0f) ? (fastest * fastest) : 0.0f;

    return !(square <= (fence->twice_braking * left));
}

/* The sides of the fence that are near: both, where the position or the speed is none. */
/*@ requires \valid_read(fence);
  @ assigns \nothing;
  @*/
static keel_cascade_limit_t near_sides(const keel_cascade_fence_t *fence, float reach,
                                       float position, float speed)
{
    const bool known = keel_range_contains(position, -KEEL_PID_INPUT_LIMIT, KEEL_PID_INPUT_LIMIT) &&
                       keel_range_contains(speed, -KEEL_PID_INPUT_LIMIT, KEEL_PID_INPUT_LIMIT);
    const keel_cascade_limit_t near = {!known || is_side_near(fence, reach + position, -speed),
                                       !known || is_side_near(fence, reach - position, speed)};

    return near;
}

/* A speed, but none towards a side that is near. */
/*@ assigns \nothing; */
static float admitted_speed(keel_cascade_limit_t near, float speed)
{
    const bool stops = (near.at_max && (speed > 0.0f)) || (near.at_min && (speed < 0.0f));

    return stops ? 0.0f : speed;
}

/* One axis of the velocity stage; what it asks for. */
/*@ requires \valid(cascade) && \valid(input) && \separated(cascade, input);
  @ requires KEEL_CASCADE_NORTH_SPEED <= axis <= KEEL_CASCADE_CLIMB;
  @ assigns cascade->axis[axis], *input;
  @*/
static float drive_with(keel_cascade_t *cascade, uint32_t axis, keel_cascade_input_t *input,
                        float position)
{
    keel_cascade_axis_t *const own = &cascade->axis[axis];
    const keel_cascade_limit_t near = near_sides(&cascade->fence, cascade->axis[axis + STAGE].reach,
                                                 position, input->measured);

    input->setpoint = admitted_speed(near, input->setpoint);
    input->valid = input->valid && is_flown(cascade, axis);
    keel_cascade_axis_step(own, input);
    own->limit.at_min = own->limit.at_min || near.at_min;
    own->limit.at_max = own->limit.at_max || near.at_max;
    return asks_for(own);
}

/* Whether an axis of the body at its limit keeps one of the Earth's from growing, of which the part
 * `share` lies along it. */
/*@ assigns \nothing; */
static bool limit_stops_growth(keel_cascade_limit_t limit, float share)
{
    return (limit.at_max && (share > KEEL_CASCADE_SHARE)) ||
           (limit.at_min && (share < -KEEL_CASCADE_SHARE));
}

/* The limits of an axis of the Earth, from those of the body's. */
/*@ assigns \nothing; */
static keel_cascade_limit_t shared_limit(keel_cascade_limit_t forward, float forward_share,
                                         keel_cascade_limit_t right, float right_share)
{
    const keel_cascade_limit_t limit = {
        limit_stops_growth(forward, -forward_share) || limit_stops_growth(right, -right_share),
        limit_stops_growth(forward, forward_share) || limit_stops_growth(right, right_share)};

    return limit;
}

/*@ assigns \nothing; */
static bool is_direction(float part)
{
    return keel_range_contains(part, -KEEL_CASCADE_HEADING_MAX, KEEL_CASCADE_HEADING_MAX);
}

/* North and east: accelerations, turned and made tilts. */
/*@ requires \valid(cascade) && \valid_read(estimate) && \separated(cascade, estimate);
  @ requires cascade_number(cascade->axis[KEEL_CASCADE_ROLL].reach, 0, KEEL_CASCADE_DISTANCE_MAX);
  @ requires cascade_number(cascade->axis[KEEL_CASCADE_PITCH].reach, 0, KEEL_CASCADE_DISTANCE_MAX);
  @ assigns cascade->axis[KEEL_CASCADE_NORTH_SPEED .. KEEL_CASCADE_EAST_SPEED], cascade->tilt;
  @*/
static void drive_tilts(keel_cascade_t *cascade, keel_cascade_vector_t asked,
                        const keel_cascade_estimate_t *estimate)
{
    const keel_cascade_axis_t *const roll = &cascade->axis[KEEL_CASCADE_ROLL];
    const keel_cascade_axis_t *const pitch = &cascade->axis[KEEL_CASCADE_PITCH];
    const bool valid = estimate->has_place && is_direction(estimate->forward_north) &&
                       is_direction(estimate->forward_east);
    const float most_roll = roll->reach;
    const float most_pitch = pitch->reach;
    const float n = valid ? estimate->forward_north : 0.0f;
    const float e = valid ? estimate->forward_east : 0.0f;
    const float forward = -KEEL_CASCADE_GRAVITY * is_asked_for(pitch);
    const float right = KEEL_CASCADE_GRAVITY * is_asked_for(roll);
    const keel_cascade_limit_t ahead = {pitch->limit.at_max, pitch->limit.at_min};
    keel_cascade_input_t north = {.setpoint = asked.north,
                                  .measured = estimate->velocity.north,
                                  .flown = (n * forward) - (e * right),
                                  .valid = valid};
    keel_cascade_input_t east = {.setpoint = asked.east,
                                 .measured = estimate->velocity.east,
                                 .flown = (e * forward) + (n * right),
                                 .valid = valid};
    float to_north;
    float to_east;

    north.below = shared_limit(ahead, n, roll->limit, -e);
    east.below = shared_limit(ahead, e, roll->limit, n);
    to_north = drive_with(cascade, KEEL_CASCADE_NORTH_SPEED, &north, estimate->position.north);
    to_east = drive_with(cascade, KEEL_CASCADE_EAST_SPEED, &east, estimate->position.east);
    cascade->tilt.roll = keel_range_clamp(((n * to_east) - (e * to_north)) *
                                              KEEL_CASCADE_PER_GRAVITY,
                                          -most_roll, most_roll);
    cascade->tilt.pitch = keel_range_clamp(-((n * to_north) + (e * to_east)) *
                                               KEEL_CASCADE_PER_GRAVITY,
                                           -most_pitch, most_pitch);
}

void keel_cascade_velocity_step(keel_cascade_t *cascade, keel_cascade_vector_t asked,
                                const keel_cascade_estimate_t *estimate)
{
    keel_cascade_input_t climb = {.setpoint = asked.up,
                                  .measured = estimate->velocity.up,
                                  .flown = cascade->command.thrust - cascade->hover,
                                  .valid = estimate->has_height};
    float lift;

    climb.below.at_min = (cascade->gave_way & KEEL_MIXER_RAISED) != 0u;
    climb.below.at_max = (cascade->gave_way & KEEL_MIXER_LOWERED) != 0u;
    drive_tilts(cascade, asked, estimate);
    lift = drive_with(cascade, KEEL_CASCADE_CLIMB, &climb, estimate->position.up);
    cascade->thrust = keel_range_clamp(cascade->hover + lift, 0.0f, 1.0f);
}
