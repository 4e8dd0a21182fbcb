/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/flight/mixer.h"

#include "keel/middleware/range.h"

/* Lever arms are parts of the largest about the same axis. In an octocopter's X the motors stand
 * 22.5 degrees from the axes: sine by cosine is the tangent. */
#define TAN_22 0x1.a8279ap-2f /* 0.414 */
#define SIN_45 0x1.6a09e6p-1f /* 0.707 */

/* No motor. */
#define NONE {0.0f, 0.0f, 0.0f}

const keel_mixer_geometry_t keel_mixer_quad_x = {.motor = {{-1.0f, 1.0f, 1.0f},
                                                           {-1.0f, -1.0f, -1.0f},
                                                           {1.0f, -1.0f, 1.0f},
                                                           {1.0f, 1.0f, -1.0f},
                                                           NONE,
                                                           NONE,
                                                           NONE,
                                                           NONE},
                                                 .motors = 4u};

const keel_mixer_geometry_t keel_mixer_quad_plus = {.motor = {{0.0f, 1.0f, 1.0f},
                                                              {-1.0f, 0.0f, -1.0f},
                                                              {0.0f, -1.0f, 1.0f},
                                                              {1.0f, 0.0f, -1.0f},
                                                              NONE,
                                                              NONE,
                                                              NONE,
                                                              NONE},
                                                    .motors = 4u};

const keel_mixer_geometry_t keel_mixer_hexa_x = {.motor = {{-0.5f, 1.0f, 1.0f},
                                                           {-1.0f, 0.0f, -1.0f},
                                                           {-0.5f, -1.0f, 1.0f},
                                                           {0.5f, -1.0f, -1.0f},
                                                           {1.0f, 0.0f, 1.0f},
                                                           {0.5f, 1.0f, -1.0f},
                                                           NONE,
                                                           NONE},
                                                 .motors = 6u};

const keel_mixer_geometry_t keel_mixer_hexa_plus = {.motor = {{0.0f, 1.0f, 1.0f},
                                                              {-1.0f, 0.5f, -1.0f},
                                                              {-1.0f, -0.5f, 1.0f},
                                                              {0.0f, -1.0f, -1.0f},
                                                              {1.0f, -0.5f, 1.0f},
                                                              {1.0f, 0.5f, -1.0f},
                                                              NONE,
                                                              NONE},
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
                                                       {1.0f, 0.5f, -1.0f},
                                                       NONE,
                                                       NONE},
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
  @ assigns \nothing;
  @*/
static bool turns_about_axes(const keel_mixer_geometry_t *geometry, float way)
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
    if (!has_factors(geometry) || !turns_about_axes(geometry, 1.0f) ||
        !turns_about_axes(geometry, -1.0f)) {
        return KEEL_ERR_GEOMETRY;
    }
    return (keel_range_contains(config->idle, KEEL_MIXER_IDLE_MIN, KEEL_MIXER_IDLE_MAX) &&
            keel_range_contains(config->highest, KEEL_MIXER_HIGHEST_MIN, 1.0f) &&
            keel_range_contains(config->yaw_share, 0.0f, KEEL_MIXER_YAW_SHARE_MAX))
               ? KEEL_OK
               : KEEL_ERR_LIMITS;
}

/*@ requires \valid(mixer);
  @ assigns mixer->output[0 .. KEEL_MIXER_MOTORS - 1], mixer->limited;
  @ ensures mixer_stopped(mixer) && mixer->limited == 0;
  @*/
static void stop_motors(keel_mixer_t *mixer)
{
    mixer->limited = 0u;
    /*@ loop invariant 0 <= i <= KEEL_MIXER_MOTORS;
      @ loop invariant \forall integer j; 0 <= j < i ==>
      @     range_contains(mixer->output[j], 0, 0);
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
        stop_motors(mixer);
    }
    return status;
}

/*@ requires \valid_read(command);
  @ assigns \nothing;
  @ ensures \result <==> mixer_command(*command);
  @*/
static bool is_command(const keel_mixer_command_t *command)
{
    return is_factor(command->roll) && is_factor(command->pitch) && is_factor(command->yaw) &&
           keel_range_contains(command->thrust, 0.0f, 1.0f);
}

/* The value used for a part of a command: 0 if it is not finite, the nearest end if it is out of
 * range. */
/*@ requires \is_finite(lowest) && lowest <= 0;
  @ assigns \nothing;
  @ ensures tamed_part: range_contains(\result, lowest, 1);
  @ ensures tamed_same: range_contains(part, lowest, 1) ==> \result == part;
  @ ensures tamed_zero: !\is_finite(part) ==> \result == 0;
  @*/
static float tame_part(float part, float lowest)
{
    return keel_range_contains(part, -KEEL_RANGE_LARGEST, KEEL_RANGE_LARGEST)
               ? keel_range_clamp(part, lowest, 1.0f)
               : 0.0f;
}

/* The command that replaces one out of range. */
/*@ requires \valid_read(command);
  @ assigns \nothing;
  @ ensures tame_command: mixer_command(\result);
  @*/
static keel_mixer_command_t tamed_command(const keel_mixer_command_t *command)
{
    const keel_mixer_command_t within = {
        .roll = tame_part(command->roll, -1.0f),
        .pitch = tame_part(command->pitch, -1.0f),
        .yaw = tame_part(command->yaw, -1.0f),
        .thrust = tame_part(command->thrust, 0.0f),
    };

    return within;
}

/* The least and the greatest of what motors do for roll and pitch. */
typedef struct ends {
    float least;
    float greatest;
} ends_t;

/* Each motor's part for roll and pitch, before any limit. */
/*@ requires \valid_read(geometry) && mixer_geometry(*geometry) && \valid_read(command);
  @ requires \valid(tilt + (0 .. KEEL_MIXER_MOTORS - 1));
  @ requires \separated(geometry, tilt + (0 .. KEEL_MIXER_MOTORS - 1));
  @ assigns tilt[0 .. KEEL_MIXER_MOTORS - 1];
  @*/
static ends_t set_tilt(const keel_mixer_geometry_t *geometry, const keel_mixer_command_t *command,
                       float tilt[])
{
    ends_t ends = {2.0f, -2.0f}; /* as factors and torques are from -1 to 1 */

    /*@ loop invariant 0 <= i <= geometry->motors;
      @ loop assigns i, ends, tilt[0 .. KEEL_MIXER_MOTORS - 1];
      @ loop variant geometry->motors - i;
      @*/
    for (uint32_t i = 0u; i < geometry->motors; i++) {
        const keel_mixer_motor_t *const motor = &geometry->motor[i];
        const float both = (motor->roll * command->roll) + (motor->pitch * command->pitch);

        ends.least = (both >= ends.least) ? ends.least : both;
        ends.greatest = (both > ends.greatest) ? both : ends.greatest;
        tilt[i] = both;
    }
    return ends;
}

/* Scales roll and pitch by one factor where they need more than the span. */
/*@ requires \valid_read(config) && config->geometry.motors <= KEEL_MIXER_MOTORS;
  @ requires \valid(tilt + (0 .. KEEL_MIXER_MOTORS - 1)) && \valid(limited);
  @ requires \separated(config, tilt + (0 .. KEEL_MIXER_MOTORS - 1), limited);
  @ assigns tilt[0 .. KEEL_MIXER_MOTORS - 1], *limited;
  @*/
static ends_t fit_tilt(const keel_mixer_config_t *config, ends_t ends, float tilt[],
                       uint32_t *limited)
{
    const float span = config->highest - config->idle;
    const float need = ends.greatest - ends.least;
    ends_t fitting = ends;

    if (need > span) {
        const float scale = span / need;

        *limited |= KEEL_MIXER_TILT;
        /*@ loop invariant 0 <= i <= config->geometry.motors;
          @ loop assigns i, tilt[0 .. KEEL_MIXER_MOTORS - 1];
          @ loop variant config->geometry.motors - i;
          @*/
        for (uint32_t i = 0u; i < config->geometry.motors; i++) {
            tilt[i] = tilt[i] * scale;
        }
        fitting.least = ends.least * scale;
        fitting.greatest = ends.greatest * scale;
    }
    return fitting;
}

/* The yaw torque that thrust gives way to: its share, as far as roll and pitch leave it room. Some
 * motors need that upwards and others downwards, so one half of what is left is for each. */
/*@ requires \valid_read(config) && mixer_range(*config);
  @ assigns \nothing;
  @*/
static float kept_yaw(const keel_mixer_config_t *config, float yaw, ends_t tilt)
{
    const float span = config->highest - config->idle;
    const float left = 0.5f * (span - (tilt.greatest - tilt.least));
    const float asked = (yaw < 0.0f) ? -yaw : yaw;
    const float most = (left < config->yaw_share) ? left : config->yaw_share;
    const float kept = (asked < most) ? asked : most;

    return (kept > 0.0f) ? kept : 0.0f; /* Scaled tilts are rounded to more than the span, too. */
}

/* The part that all motors share: thrust as asked for, or as near to it as roll, pitch and the yaw
 * that is kept allow. */
/*@ requires \valid_read(config) && mixer_range(*config) && \valid(limited);
  @ requires \separated(config, limited);
  @ assigns *limited;
  @*/
static float fit_thrust(const keel_mixer_config_t *config, float thrust, ends_t tilt, float kept,
                        uint32_t *limited)
{
    const float asked = config->idle + (thrust * (config->highest - config->idle));
    const float lowest = (config->idle - tilt.least) + kept;
    const float highest = (config->highest - tilt.greatest) - kept;

    if (asked < lowest) {
        *limited |= KEEL_MIXER_RAISED;
        return lowest;
    }
    if (asked > highest) {
        /* Without any torque it is full thrust, rounded upwards: nothing gives way. */
        *limited |= ((tilt.greatest > 0.0f) || (kept > 0.0f)) ? KEEL_MIXER_LOWERED : 0u;
        return highest;
    }
    return asked;
}

/* The output of a motor whose yaw comes on top of all else. */
/*@ assigns \nothing; */
static float with_yaw(float done, float factor, float yaw)
{
    return done + (factor * yaw);
}

/* That for a part of the yaw. */
/*@ assigns \nothing; */
static float with_part(float done, float factor, float yaw, float part)
{
    return done + ((factor * yaw) * part);
}

/* A motor's output without yaw. */
/*@ assigns \nothing; */
static float without_yaw(float base, float tilt)
{
    return base + tilt;
}

/* Puts out all that is asked for, unless some motor cannot do it. */
/*@ requires \valid(mixer) && mixer_valid(mixer);
  @ requires \valid_read(tilt + (0 .. KEEL_MIXER_MOTORS - 1));
  @ requires \separated(mixer, tilt + (0 .. KEEL_MIXER_MOTORS - 1));
  @ assigns mixer->output[0 .. mixer->config.geometry.motors - 1];
  @ ensures \result ==> mixer_turning(mixer);
  @*/
static bool put_out_all(keel_mixer_t *mixer, const float tilt[], float base, float yaw)
{
    const keel_mixer_config_t *const config = &mixer->config;

    /*@ loop invariant 0 <= i <= config->geometry.motors;
      @ loop invariant \forall integer j; 0 <= j < i ==>
      @     range_contains(mixer->output[j], config->idle, config->highest);
      @ loop assigns i, mixer->output[0 .. mixer->config.geometry.motors - 1];
      @ loop variant config->geometry.motors - i;
      @*/
    for (uint32_t i = 0u; i < config->geometry.motors; i++) {
        const float done = without_yaw(base, tilt[i]);
        const float output = with_yaw(done, config->geometry.motor[i].yaw, yaw);

        if (!keel_range_contains(output, config->idle, config->highest)) {
            return false;
        }
        mixer->output[i] = output;
    }
    return true;
}

/* The part of a motor's yaw that fits between what it does already and the end of its range. */
/*@ assigns \nothing; */
static float fitting_part(float turn, float room)
{
    const float need = (turn < 0.0f) ? -turn : turn;

    return (need > room) ? (room / need) : 1.0f;
}

/* The part of the yaw that fits for every motor. */
/*@ requires \valid_read(config) && mixer_geometry(config->geometry) && mixer_range(*config);
  @ requires \valid_read(tilt + (0 .. KEEL_MIXER_MOTORS - 1));
  @ assigns \nothing;
  @*/
static float part_of_yaw(const keel_mixer_config_t *config, const float tilt[], float base,
                         float yaw)
{
    float part = 1.0f;

    /*@ loop invariant 0 <= i <= config->geometry.motors;
      @ loop assigns i, part;
      @ loop variant config->geometry.motors - i;
      @*/
    for (uint32_t i = 0u; i < config->geometry.motors; i++) {
        const float turn = config->geometry.motor[i].yaw * yaw;
        const float done = keel_range_clamp(base + tilt[i], config->idle, config->highest);
        const float room = (turn < 0.0f) ? (done - config->idle) : (config->highest - done);
        const float share = fitting_part(turn, room);

        part = (share < part) ? share : part;
    }
    return part;
}

/* Puts out a part of the yaw. Sums that should lie at the ends of the range are rounded beyond
 * them: the clamps take care of just that. */
/*@ requires \valid(mixer);
  @ requires mixer_geometry(mixer->config.geometry) && mixer_range(mixer->config);
  @ requires \valid_read(tilt + (0 .. KEEL_MIXER_MOTORS - 1));
  @ requires \separated(mixer, tilt + (0 .. KEEL_MIXER_MOTORS - 1));
  @ assigns mixer->output[0 .. mixer->config.geometry.motors - 1];
  @ ensures mixer_turning(mixer);
  @*/
static void put_out_part(keel_mixer_t *mixer, const float tilt[], float base, float yaw, float part)
{
    const keel_mixer_config_t *const config = &mixer->config;

    /*@ loop invariant 0 <= i <= config->geometry.motors;
      @ loop invariant \forall integer j; 0 <= j < i ==>
      @     range_contains(mixer->output[j], config->idle, config->highest);
      @ loop assigns i, mixer->output[0 .. mixer->config.geometry.motors - 1];
      @ loop variant config->geometry.motors - i;
      @*/
    for (uint32_t i = 0u; i < config->geometry.motors; i++) {
        const float done = keel_range_clamp(without_yaw(base, tilt[i]), config->idle,
                                            config->highest);
        const float output = with_part(done, config->geometry.motor[i].yaw, yaw, part);

        mixer->output[i] = keel_range_clamp(output, config->idle, config->highest);
    }
}

/*@ requires \valid(mixer) && \valid_read(command) && \separated(mixer, command);
  @ requires mixer_valid(mixer);
  @ assigns mixer->output[0 .. mixer->config.geometry.motors - 1], mixer->limited;
  @ ensures mixer_turning(mixer);
  @*/
static void turn_motors(keel_mixer_t *mixer, const keel_mixer_command_t *command)
{
    const keel_mixer_config_t *const config = &mixer->config;
    const bool valid = is_command(command);
    const keel_mixer_command_t wish = valid ? *command : tamed_command(command);
    uint32_t limited = valid ? 0u : KEEL_MIXER_COMMAND;
    float tilt[KEEL_MIXER_MOTORS];
    ends_t ends = set_tilt(&config->geometry, &wish, tilt);
    float base;

    ends = fit_tilt(config, ends, tilt, &limited);
    base = fit_thrust(config, wish.thrust, ends, kept_yaw(config, wish.yaw, ends), &limited);
    if (!put_out_all(mixer, tilt, base, wish.yaw)) {
        const float part = part_of_yaw(config, tilt, base, wish.yaw);

        limited |= (part < 1.0f) ? KEEL_MIXER_YAW : 0u;
        put_out_part(mixer, tilt, base, wish.yaw, part);
    }
    mixer->limited = limited;
}

void keel_mixer_step(keel_mixer_t *mixer, const keel_mixer_command_t *command, bool armed)
{
    if (armed) {
        turn_motors(mixer, command);
        /*@ assert config: mixer_geometry(mixer->config.geometry) &&
          @     mixer_range(mixer->config); */
        /*@ assert same_motors: mixer->config.geometry.motors ==
          @     \at(mixer->config.geometry.motors, Pre); */
        /*@ assert behind: \forall integer i;
          @     mixer->config.geometry.motors <= i < KEEL_MIXER_MOTORS ==>
          @     \is_finite(mixer->output[i]) && mixer->output[i] == 0; */
    } else {
        stop_motors(mixer);
    }
}
