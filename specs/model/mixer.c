/* SPDX-License-Identifier: Apache-2.0 */
#include "mixer.h"

#include "range.h"

static bool factors_are_valid(const keel_mixer_motor_t *motor)
{
    return model_range_contains(motor->roll, -1.0f, 1.0f) &&
           model_range_contains(motor->pitch, -1.0f, 1.0f) &&
           model_range_contains(motor->yaw, -1.0f, 1.0f);
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
    if (!model_range_contains(config->idle, KEEL_MIXER_IDLE_MIN, KEEL_MIXER_IDLE_MAX) ||
        !model_range_contains(config->highest, KEEL_MIXER_HIGHEST_MIN, 1.0f)) {
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

/* MIX-005: what is taken for a part of a command. */
static float part_of(float part, float lowest, float highest)
{
    if (!model_range_contains(part, -KEEL_RANGE_LARGEST, KEEL_RANGE_LARGEST)) {
        return 0.0f;
    }
    return model_range_clamp(part, lowest, highest);
}

static bool command_is_valid(const keel_mixer_command_t *command)
{
    return model_range_contains(command->roll, -1.0f, 1.0f) &&
           model_range_contains(command->pitch, -1.0f, 1.0f) &&
           model_range_contains(command->yaw, -1.0f, 1.0f) &&
           model_range_contains(command->thrust, 0.0f, 1.0f);
}

/* The least of the motors' values, or the greatest. */
static float least_of(const float value[], uint32_t motors)
{
    float least = value[0];

    for (uint32_t i = 1u; i < KEEL_MIXER_MOTORS; i++) {
        if (i < motors) {
            least = (value[i] < least) ? value[i] : least;
        }
    }
    return least;
}

static float greatest_of(const float value[], uint32_t motors)
{
    float greatest = value[0];

    for (uint32_t i = 1u; i < KEEL_MIXER_MOTORS; i++) {
        if (i < motors) {
            greatest = (value[i] > greatest) ? value[i] : greatest;
        }
    }
    return greatest;
}

/* MIX-008: the part of its yaw that a motor can do. */
static float yaw_part(float turn, float room)
{
    const float need = (turn < 0.0f) ? -turn : turn;

    if (need <= room) {
        return 1.0f;
    }
    return (room > 0.0f) ? (room / need) : 0.0f;
}

void model_mixer_step(keel_mixer_t *mixer, const keel_mixer_command_t *command, bool armed)
{
    const keel_mixer_geometry_t *const geometry = &mixer->config.geometry;
    const uint32_t motors = geometry->motors;
    const float idle = mixer->config.idle;
    const float highest = mixer->config.highest;
    const float span = highest - idle;
    const float roll = part_of(command->roll, -1.0f, 1.0f);
    const float pitch = part_of(command->pitch, -1.0f, 1.0f);
    const float yaw = part_of(command->yaw, -1.0f, 1.0f);
    const float thrust = part_of(command->thrust, 0.0f, 1.0f);
    float tilt[KEEL_MIXER_MOTORS] = {0.0f};
    float least;
    float greatest;
    float base;
    float part = 1.0f;

    if (!armed) {
        stop(mixer);
        return;
    }
    mixer->limited = command_is_valid(command) ? 0u : KEEL_MIXER_COMMAND; /* MIX-005 */

    /* MIX-006: roll and pitch, both scaled where they need more than the span. */
    for (uint32_t i = 0u; i < KEEL_MIXER_MOTORS; i++) {
        if (i < motors) {
            tilt[i] = (geometry->motor[i].roll * roll) + (geometry->motor[i].pitch * pitch);
        }
    }
    least = least_of(tilt, motors);
    greatest = greatest_of(tilt, motors);
    if (!((greatest - least) <= span)) {
        const float scale = span / (greatest - least);

        mixer->limited |= KEEL_MIXER_TILT;
        for (uint32_t i = 0u; i < KEEL_MIXER_MOTORS; i++) {
            if (i < motors) {
                tilt[i] = tilt[i] * scale;
            }
        }
        least = least * scale;
        greatest = greatest * scale;
    }

    /* MIX-007: thrust, moved as far as roll and pitch need. */
    base = idle + (thrust * span);
    if (base < (idle - least)) {
        base = idle - least;
        mixer->limited |= KEEL_MIXER_RAISED;
    }
    if (base > (highest - greatest)) {
        base = highest - greatest;
        mixer->limited |= KEEL_MIXER_LOWERED;
    }

    /* MIX-008: yaw, as much of it as every motor can do. */
    for (uint32_t i = 0u; i < KEEL_MIXER_MOTORS; i++) {
        if (i < motors) {
            const float turn = geometry->motor[i].yaw * yaw;
            const float done = base + tilt[i];
            const float fits = yaw_part(turn, (turn < 0.0f) ? (done - idle) : (highest - done));

            part = (fits < part) ? fits : part;
        }
    }
    if (part < 1.0f) {
        mixer->limited |= KEEL_MIXER_YAW;
    }

    /* MIX-004 */
    for (uint32_t i = 0u; i < KEEL_MIXER_MOTORS; i++) {
        mixer->output[i] = 0.0f;
        if (i < motors) {
            mixer->output[i] =
                model_range_clamp((base + tilt[i]) + (geometry->motor[i].yaw * (part * yaw)), idle,
                                  highest);
        }
    }
}
