/* SPDX-License-Identifier: Apache-2.0 */
#include "mixer.h"

#include "range.h"

/* No comparison with NaN holds. */
static bool contains(float value, float least, float greatest)
{
    return (value >= least) && (value <= greatest);
}

static bool factors_are_valid(const keel_mixer_motor_t *motor)
{
    return contains(motor->roll, -1.0f, 1.0f) && contains(motor->pitch, -1.0f, 1.0f) &&
           contains(motor->yaw, -1.0f, 1.0f);
}

/* MIX-001: about each axis some motor turns the craft one way, and some the other. */
keel_status_t model_mixer_check(const keel_mixer_config_t *config)
{
    const keel_mixer_geometry_t *const geometry = &config->geometry;
    bool valid = true;
    bool left = false;
    bool right = false;
    bool up = false;
    bool down = false;
    bool clockwise = false;
    bool counter = false;

    if ((geometry->motors < KEEL_MIXER_MOTORS_MIN) || (KEEL_MIXER_MOTORS < geometry->motors)) {
        return KEEL_ERR_MOTORS;
    }
    for (uint32_t i = 0u; i < KEEL_MIXER_MOTORS; i++) {
        if (i < geometry->motors) {
            const keel_mixer_motor_t *const motor = &geometry->motor[i];

            valid = valid && factors_are_valid(motor);
            right = right || (motor->roll >= KEEL_MIXER_AUTHORITY);
            left = left || (motor->roll <= -KEEL_MIXER_AUTHORITY);
            up = up || (motor->pitch >= KEEL_MIXER_AUTHORITY);
            down = down || (motor->pitch <= -KEEL_MIXER_AUTHORITY);
            clockwise = clockwise || (motor->yaw >= KEEL_MIXER_AUTHORITY);
            counter = counter || (motor->yaw <= -KEEL_MIXER_AUTHORITY);
        }
    }
    if (!(valid && left && right && up && down && clockwise && counter)) {
        return KEEL_ERR_GEOMETRY;
    }
    if (!contains(config->idle, KEEL_MIXER_IDLE_MIN, KEEL_MIXER_IDLE_MAX) ||
        !contains(config->highest, KEEL_MIXER_HIGHEST_MIN, 1.0f) ||
        !contains(config->yaw_share, 0.0f, KEEL_MIXER_YAW_SHARE_MAX)) {
        return KEEL_ERR_LIMITS;
    }
    return KEEL_OK;
}

/* MIX-003 */
static void stop(keel_mixer_t *mixer)
{
    for (uint32_t i = 0u; i < KEEL_MIXER_MOTORS; i++) {
        mixer->output[i] = 0.0f;
    }
    mixer->limited = 0u;
}

/* MIX-002 */
keel_status_t model_mixer_init(keel_mixer_t *mixer, const keel_mixer_config_t *config)
{
    const keel_status_t status = model_mixer_check(config);

    if (status != KEEL_OK) {
        return status;
    }
    mixer->config = *config;
    stop(mixer);
    return KEEL_OK;
}

static bool command_is_valid(const keel_mixer_command_t *command)
{
    return contains(command->roll, -1.0f, 1.0f) && contains(command->pitch, -1.0f, 1.0f) &&
           contains(command->yaw, -1.0f, 1.0f) && contains(command->thrust, 0.0f, 1.0f);
}

/* MIX-005: 0 for what is not finite, the end that is next to what is out of range. */
static float part_of(float part, float lowest)
{
    const bool finite = contains(part, -KEEL_RANGE_LARGEST, KEEL_RANGE_LARGEST);

    return finite ? model_range_clamp(part, lowest, 1.0f) : 0.0f;
}

static keel_mixer_command_t command_of(const keel_mixer_command_t *command)
{
    return (keel_mixer_command_t){part_of(command->roll, -1.0f), part_of(command->pitch, -1.0f),
                                  part_of(command->yaw, -1.0f), part_of(command->thrust, 0.0f)};
}

/* MIX-009: the yaw that thrust gives way to. */
static float share_of(const keel_mixer_config_t *config, float yaw, float least, float greatest)
{
    const float left = 0.5f * ((config->highest - config->idle) - (greatest - least));
    const float asked = (yaw < 0.0f) ? -yaw : yaw;
    const float most = (left < config->yaw_share) ? left : config->yaw_share;
    const float share = (asked < most) ? asked : most;

    return (share > 0.0f) ? share : 0.0f;
}

/* MIX-007: thrust, moved as far as roll, pitch and the share of yaw need. */
static float base_of(const keel_mixer_config_t *config, float thrust, float least, float greatest,
                     float share, uint32_t *limited)
{
    const float asked = config->idle + (thrust * (config->highest - config->idle));
    const float lowest = (config->idle - least) + share;
    const float highest = (config->highest - greatest) - share;

    if (asked < lowest) {
        *limited |= KEEL_MIXER_RAISED;
        return lowest;
    }
    if (asked > highest) {
        *limited |= ((greatest > 0.0f) || (share > 0.0f)) ? KEEL_MIXER_LOWERED : 0u;
        return highest;
    }
    return asked;
}

/* The part of its yaw that a motor can do. */
static float yaw_part(float turn, float room)
{
    const float need = (turn < 0.0f) ? -turn : turn;

    return (need > room) ? (room / need) : 1.0f;
}

/* Whether every motor can do all that it is asked for; that is put out then. */
static bool all_fits(const keel_mixer_config_t *config, const float tilt[], float base, float yaw,
                     float output[])
{
    for (uint32_t i = 0u; i < config->geometry.motors; i++) {
        const float all = (base + tilt[i]) + (config->geometry.motor[i].yaw * yaw);

        if (!contains(all, config->idle, config->highest)) {
            return false;
        }
        output[i] = all;
    }
    return true;
}

/* As much yaw as every motor can do. */
static void put_out(const keel_mixer_config_t *config, const float tilt[], float base, float yaw,
                    uint32_t *limited, float output[])
{
    const keel_mixer_motor_t *const motor = config->geometry.motor;
    const float idle = config->idle;
    const float highest = config->highest;
    float part = 1.0f;

    for (uint32_t i = 0u; i < config->geometry.motors; i++) {
        const float turned = motor[i].yaw * yaw;
        const float done = model_range_clamp(base + tilt[i], idle, highest);
        const float fitting = yaw_part(turned, (turned < 0.0f) ? (done - idle) : (highest - done));

        part = (fitting < part) ? fitting : part;
    }
    *limited |= (part < 1.0f) ? KEEL_MIXER_YAW : 0u;
    for (uint32_t i = 0u; i < config->geometry.motors; i++) {
        const float done = model_range_clamp(base + tilt[i], idle, highest);

        output[i] = model_range_clamp(done + ((motor[i].yaw * yaw) * part), idle, highest);
    }
}

/* MIX-004: the outputs of armed motors, and what gave way. */
static void turn(keel_mixer_t *mixer, const keel_mixer_command_t *command)
{
    const keel_mixer_config_t *const config = &mixer->config;
    const keel_mixer_motor_t *const motor = config->geometry.motor;
    const uint32_t motors = config->geometry.motors;
    const float span = config->highest - config->idle;
    const bool valid = command_is_valid(command);
    const keel_mixer_command_t wish = valid ? *command : command_of(command);
    uint32_t limited = valid ? 0u : KEEL_MIXER_COMMAND; /* MIX-005 */
    float tilt[KEEL_MIXER_MOTORS];
    float least = 2.0f;
    float greatest = -2.0f;
    float base;

    /* MIX-006: roll and pitch, both scaled where they need more than the span. */
    for (uint32_t i = 0u; i < motors; i++) {
        tilt[i] = (motor[i].roll * wish.roll) + (motor[i].pitch * wish.pitch);
        least = (tilt[i] >= least) ? least : tilt[i];
        greatest = (tilt[i] > greatest) ? tilt[i] : greatest;
    }
    if ((greatest - least) > span) {
        const float scale = span / (greatest - least);

        limited |= KEEL_MIXER_TILT;
        for (uint32_t i = 0u; i < motors; i++) {
            tilt[i] = tilt[i] * scale;
        }
        least = least * scale;
        greatest = greatest * scale;
    }
    base = base_of(config, wish.thrust, least, greatest,
                   share_of(config, wish.yaw, least, greatest), &limited);
    /* MIX-008: yaw, all of it or as much as every motor can do. */
    if (!all_fits(config, tilt, base, wish.yaw, mixer->output)) {
        put_out(config, tilt, base, wish.yaw, &limited, mixer->output);
    }
    mixer->limited = limited;
}

void model_mixer_step(keel_mixer_t *mixer, const keel_mixer_command_t *command, bool armed)
{
    if (armed) {
        turn(mixer, command);
    } else {
        stop(mixer);
    }
}
