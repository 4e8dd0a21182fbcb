/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/flight/mixer.h"

#include "keel/middleware/range.h"

/* Lever arms are parts of the largest about the same axis. In an octocopter's X the motors stand
 * 22.5 degrees from the axes: sine by cosine is the tangent. */
#define TAN_22 0.41421356f
#define SIN_45 0.70710678f

const keel_mixer_geometry_t keel_mixer_quad_x = {
    .motor = {{-1.0f, 1.0f, 1.0f}, {-1.0f, -1.0f, -1.0f}, {1.0f, -1.0f, 1.0f}, {1.0f, 1.0f, -1.0f}},
    .motors = 4u};

const keel_mixer_geometry_t keel_mixer_quad_plus = {
    .motor = {{0.0f, 1.0f, 1.0f}, {-1.0f, 0.0f, -1.0f}, {0.0f, -1.0f, 1.0f}, {1.0f, 0.0f, -1.0f}},
    .motors = 4u};

const keel_mixer_geometry_t keel_mixer_hexa_x = {.motor = {{-0.5f, 1.0f, 1.0f},
                                                           {-1.0f, 0.0f, -1.0f},
                                                           {-0.5f, -1.0f, 1.0f},
                                                           {0.5f, -1.0f, -1.0f},
                                                           {1.0f, 0.0f, 1.0f},
                                                           {0.5f, 1.0f, -1.0f}},
                                                 .motors = 6u};

const keel_mixer_geometry_t keel_mixer_hexa_plus = {.motor = {{0.0f, 1.0f, 1.0f},
                                                              {-1.0f, 0.5f, -1.0f},
                                                              {-1.0f, -0.5f, 1.0f},
                                                              {0.0f, -1.0f, -1.0f},
                                                              {1.0f, -0.5f, 1.0f},
                                                              {1.0f, 0.5f, -1.0f}},
                                                    .motors = 6u};

const keel_mixer_geometry_t keel_mixer_octo_x = {.motor = {{-TAN_22, 1.0f, 1.0f},
                                                           {-1.0f, TAN_22, -1.0f},
                                                           {-1.0f, -TAN_22, 1.0f},
                                                           {-TAN_22, -1.0f, -1.0f},
                                                           {TAN_22, -1.0f, 1.0f},
                                                           {1.0f, -TAN_22, -1.0f},
                                                           {1.0f, TAN_22, 1.0f},
                                                           {TAN_22, 1.0f, -1.0f}},
                                                 .motors = 8u};

const keel_mixer_geometry_t keel_mixer_octo_plus = {.motor = {{0.0f, 1.0f, 1.0f},
                                                              {-SIN_45, SIN_45, -1.0f},
                                                              {-1.0f, 0.0f, 1.0f},
                                                              {-SIN_45, -SIN_45, -1.0f},
                                                              {0.0f, -1.0f, 1.0f},
                                                              {SIN_45, -SIN_45, -1.0f},
                                                              {1.0f, 0.0f, 1.0f},
                                                              {SIN_45, SIN_45, -1.0f}},
                                                    .motors = 8u};

const keel_mixer_geometry_t keel_mixer_y6 = {.motor = {{-1.0f, 0.5f, 1.0f},
                                                       {-1.0f, 0.5f, -1.0f},
                                                       {0.0f, -1.0f, 1.0f},
                                                       {0.0f, -1.0f, -1.0f},
                                                       {1.0f, 0.5f, 1.0f},
                                                       {1.0f, 0.5f, -1.0f}},
                                             .motors = 6u};

/*@ assigns \nothing;
  @ ensures \result <==> mixer_factor(value);
  @*/
static bool is_factor(float value)
{
    return keel_range_contains(value, -1.0f, 1.0f);
}

/* Whether all factors are in range. */
/*@ requires \valid_read(geometry) && geometry->motors <= KEEL_MIXER_MOTORS;
  @ assigns \nothing;
  @ ensures \result <==> \forall integer i; 0 <= i < geometry->motors ==>
  @     mixer_factor(geometry->motor[i].roll) && mixer_factor(geometry->motor[i].pitch) &&
  @     mixer_factor(geometry->motor[i].yaw);
  @*/
static bool has_factors(const keel_mixer_geometry_t *geometry)
{
    /*@ loop invariant 0 <= i <= geometry->motors;
      @ loop invariant \forall integer j; 0 <= j < i ==>
      @     mixer_factor(geometry->motor[j].roll) && mixer_factor(geometry->motor[j].pitch) &&
      @     mixer_factor(geometry->motor[j].yaw);
      @ loop assigns i;
      @ loop variant geometry->motors - i;
      @*/
    for (uint32_t i = 0u; i < geometry->motors; i++) {
        const keel_mixer_motor_t *const motor = &geometry->motor[i];

        if (!is_factor(motor->roll) || !is_factor(motor->pitch) || !is_factor(motor->yaw)) {
            return false;
        }
    }
    return true;
}

/* Whether some motors turn the craft about each axis by at least so much; by as much the other way,
 * if it is negative. */
/*@ requires \valid_read(geometry) && geometry->motors <= KEEL_MIXER_MOTORS;
  @ requires mixer_geometry(*geometry);
  @ assigns \nothing;
  @*/
static bool turns(const keel_mixer_geometry_t *geometry, float way)
{
    bool rolls = false;
    bool pitches = false;
    bool yaws = false;

    /*@ loop invariant 0 <= i <= geometry->motors;
      @ loop assigns i, rolls, pitches, yaws;
      @ loop variant geometry->motors - i;
      @*/
    for (uint32_t i = 0u; i < geometry->motors; i++) {
        const keel_mixer_motor_t *const motor = &geometry->motor[i];

        rolls = rolls || ((way * motor->roll) >= KEEL_MIXER_AUTHORITY);
        pitches = pitches || ((way * motor->pitch) >= KEEL_MIXER_AUTHORITY);
        yaws = yaws || ((way * motor->yaw) >= KEEL_MIXER_AUTHORITY);
    }
    return rolls && pitches && yaws;
}

keel_status_t keel_mixer_check(const keel_mixer_config_t *config)
{
    const keel_mixer_geometry_t *const geometry = &config->geometry;

    if ((geometry->motors < KEEL_MIXER_MOTORS_MIN) || (geometry->motors > KEEL_MIXER_MOTORS)) {
        return KEEL_ERR_MOTORS;
    }
    if (!has_factors(geometry) || !turns(geometry, 1.0f) || !turns(geometry, -1.0f)) {
        return KEEL_ERR_GEOMETRY;
    }
    return (keel_range_contains(config->idle, KEEL_MIXER_IDLE_MIN, KEEL_MIXER_IDLE_MAX) &&
            keel_range_contains(config->highest, KEEL_MIXER_HIGHEST_MIN, 1.0f))
               ? KEEL_OK
               : KEEL_ERR_LIMITS;
}

/*@ requires \valid(mixer);
  @ assigns mixer->output[0 .. KEEL_MIXER_MOTORS - 1], mixer->limited;
  @ ensures mixer_stopped(*mixer) && mixer->limited == 0;
  @*/
static void stop(keel_mixer_t *mixer)
{
    mixer->limited = 0u;
    /*@ loop invariant 0 <= i <= KEEL_MIXER_MOTORS;
      @ loop invariant \forall integer j; 0 <= j < i ==>
      @     \is_finite(mixer->output[j]) && mixer->output[j] == 0;
      @ loop assigns i, mixer->output[0 .. KEEL_MIXER_MOTORS - 1];
      @ loop variant KEEL_MIXER_MOTORS - i;
      @*/
    for (uint32_t i = 0u; i < KEEL_MIXER_MOTORS; i++) {
        mixer->output[i] = 0.0f;
    }
}

keel_status_t keel_mixer_init(keel_mixer_t *mixer, const keel_mixer_config_t *config)
{
    const keel_status_t status = keel_mixer_check(config);

    if (status == KEEL_OK) {
        mixer->config = *config;
        stop(mixer);
    }
    return status;
}

/* What the motors are to do, before yaw and the last clamp; and what gave way. */
typedef struct mix {
    float tilt[KEEL_MIXER_MOTORS]; /* for roll and pitch */
    float yaw;                     /* as much of it as fits */
    float base;                    /* for thrust */
    uint8_t limited;
} mix_t;

/* A part of a command: not finite counts as 0, beyond its range as the end next to it. */
/*@ requires \is_finite(lowest) && \is_finite(highest) && lowest <= 0 <= highest;
  @ requires \valid(limited);
  @ assigns *limited;
  @ ensures MIX_005_part: \is_finite(\result) && lowest <= \result <= highest;
  @ ensures MIX_005_told: *limited == (range_contains(part, lowest, highest)
  @     ? \old(*limited) : (\old(*limited) | KEEL_MIXER_COMMAND));
  @*/
static float taken(float part, float lowest, float highest, uint8_t *limited)
{
    if (keel_range_contains(part, lowest, highest)) {
        return part;
    }
    *limited |= KEEL_MIXER_COMMAND;
    return keel_range_contains(part, -KEEL_RANGE_LARGEST, KEEL_RANGE_LARGEST)
               ? keel_range_clamp(part, lowest, highest)
               : 0.0f;
}

/* What each motor adds for roll and pitch, before any limit. */
/*@ requires \valid_read(geometry) && mixer_geometry(*geometry) && \valid(mix);
  @ requires \separated(geometry, mix);
  @ assigns mix->tilt[0 .. KEEL_MIXER_MOTORS - 1];
  @*/
static void tilt(const keel_mixer_geometry_t *geometry, float roll, float pitch, mix_t *mix)
{
    /*@ loop invariant 0 <= i <= geometry->motors;
      @ loop assigns i, mix->tilt[0 .. KEEL_MIXER_MOTORS - 1];
      @ loop variant geometry->motors - i;
      @*/
    for (uint32_t i = 0u; i < geometry->motors; i++) {
        mix->tilt[i] = (geometry->motor[i].roll * roll) + (geometry->motor[i].pitch * pitch);
    }
}

/* The least and the greatest of some values. */
typedef struct ends {
    float least;
    float greatest;
} ends_t;

/*@ requires \valid_read(value + (0 .. count - 1)) && 1 <= count <= KEEL_MIXER_MOTORS;
  @ assigns \nothing;
  @*/
static ends_t ends_of(const float value[], uint32_t count)
{
    ends_t ends = {value[0], value[0]};

    /*@ loop invariant 1 <= i <= count;
      @ loop assigns i, ends;
      @ loop variant count - i;
      @*/
    for (uint32_t i = 1u; i < count; i++) {
        ends.least = (value[i] < ends.least) ? value[i] : ends.least;
        ends.greatest = (value[i] > ends.greatest) ? value[i] : ends.greatest;
    }
    return ends;
}

/* Scales roll and pitch by one factor where they need more than the span; what they need then. */
/*@ requires \valid(mix) && 1 <= motors <= KEEL_MIXER_MOTORS;
  @ assigns mix->tilt[0 .. KEEL_MIXER_MOTORS - 1], mix->limited;
  @*/
static ends_t fit_tilt(float span, uint32_t motors, mix_t *mix)
{
    const ends_t ends = ends_of(mix->tilt, motors);
    const float need = ends.greatest - ends.least;
    float scale;

    if (need <= span) {
        return ends;
    }
    scale = span / need;
    mix->limited |= KEEL_MIXER_TILT;
    /*@ loop invariant 0 <= i <= motors;
      @ loop assigns i, mix->tilt[0 .. KEEL_MIXER_MOTORS - 1];
      @ loop variant motors - i;
      @*/
    for (uint32_t i = 0u; i < motors; i++) {
        mix->tilt[i] = mix->tilt[i] * scale;
    }
    return (ends_t){ends.least * scale, ends.greatest * scale};
}

/* Thrust as asked for, or as near to it as roll and pitch allow. */
/*@ requires \valid_read(config) && \valid(mix) && \separated(config, mix);
  @ assigns mix->base, mix->limited;
  @*/
static void fit_thrust(const keel_mixer_config_t *config, float thrust, ends_t tilt, mix_t *mix)
{
    const float lowest = config->idle - tilt.least;
    const float highest = config->highest - tilt.greatest;

    mix->base = config->idle + (thrust * (config->highest - config->idle));
    if (mix->base < lowest) {
        mix->base = lowest;
        mix->limited |= KEEL_MIXER_RAISED;
    }
    if (mix->base > highest) {
        mix->base = highest;
        mix->limited |= KEEL_MIXER_LOWERED;
    }
}

/* The part of a motor's yaw that fits between what it does already and the end of its range. */
/*@ assigns \nothing; */
static float fitting(float turn, float room)
{
    const float need = (turn < 0.0f) ? -turn : turn;

    if (need <= room) {
        return 1.0f;
    }
    return (room > 0.0f) ? (room / need) : 0.0f;
}

/* As much yaw as fits for every motor. */
/*@ requires \valid_read(config) && mixer_geometry(config->geometry);
  @ requires \valid(mix) && \separated(config, mix);
  @ assigns mix->yaw, mix->limited;
  @*/
static void fit_yaw(const keel_mixer_config_t *config, float yaw, mix_t *mix)
{
    float part = 1.0f;

    /*@ loop invariant 0 <= i <= config->geometry.motors;
      @ loop assigns i, part;
      @ loop variant config->geometry.motors - i;
      @*/
    for (uint32_t i = 0u; i < config->geometry.motors; i++) {
        const float turn = config->geometry.motor[i].yaw * yaw;
        const float done = mix->base + mix->tilt[i];
        const float room = (turn < 0.0f) ? (done - config->idle) : (config->highest - done);
        const float fits = fitting(turn, room);

        part = (fits < part) ? fits : part;
    }
    if (part < 1.0f) {
        mix->limited |= KEEL_MIXER_YAW;
    }
    mix->yaw = part * yaw;
}

/*@ requires \valid(mixer) && \valid_read(command) && \separated(mixer, command);
  @ requires mixer_valid(*mixer);
  @ assigns mixer->output[0 .. KEEL_MIXER_MOTORS - 1], mixer->limited;
  @ ensures mixer_turning(*mixer);
  @ ensures \forall integer i; mixer->config.geometry.motors <= i < KEEL_MIXER_MOTORS ==>
  @     \is_finite(mixer->output[i]) && mixer->output[i] == 0;
  @*/
static void turn(keel_mixer_t *mixer, const keel_mixer_command_t *command)
{
    const keel_mixer_config_t *const config = &mixer->config;
    const keel_mixer_geometry_t *const geometry = &config->geometry;
    mix_t mix = {.limited = 0u};
    const float roll = taken(command->roll, -1.0f, 1.0f, &mix.limited);
    const float pitch = taken(command->pitch, -1.0f, 1.0f, &mix.limited);
    const float yaw = taken(command->yaw, -1.0f, 1.0f, &mix.limited);
    const float thrust = taken(command->thrust, 0.0f, 1.0f, &mix.limited);
    ends_t ends;

    tilt(geometry, roll, pitch, &mix);
    ends = fit_tilt(config->highest - config->idle, geometry->motors, &mix);
    fit_thrust(config, thrust, ends, &mix);
    fit_yaw(config, yaw, &mix);
    /*@ loop invariant 0 <= i <= KEEL_MIXER_MOTORS;
      @ loop invariant \forall integer j; 0 <= j < i && j < geometry->motors ==>
      @     \is_finite(mixer->output[j]) && config->idle <= mixer->output[j] <= config->highest;
      @ loop invariant \forall integer j; geometry->motors <= j < i ==>
      @     \is_finite(mixer->output[j]) && mixer->output[j] == 0;
      @ loop assigns i, mixer->output[0 .. KEEL_MIXER_MOTORS - 1];
      @ loop variant KEEL_MIXER_MOTORS - i;
      @*/
    for (uint32_t i = 0u; i < KEEL_MIXER_MOTORS; i++) {
        float output = 0.0f;

        if (i < geometry->motors) {
            output = (mix.base + mix.tilt[i]) + (geometry->motor[i].yaw * mix.yaw);
            output = keel_range_clamp(output, config->idle, config->highest);
        }
        mixer->output[i] = output; /* once: whoever interrupts sees no output in between */
    }
    mixer->limited = mix.limited;
}

void keel_mixer_step(keel_mixer_t *mixer, const keel_mixer_command_t *command, bool armed)
{
    if (armed) {
        turn(mixer, command);
    } else {
        stop(mixer);
    }
}
