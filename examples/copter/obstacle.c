/* SPDX-License-Identifier: Apache-2.0 */
#include "obstacle.h"

#include "settings.h"

#include <stdbool.h>
#include <stddef.h>

/* A bit and what it says. */
typedef struct word {
    uint32_t bit;
    bool is_check; /* Of the checks; else of the facts. */
    const char *text;
} word_t;

static const word_t words[COPTER_OBSTACLES] = {
    {KEEL_MODE_CHECK_GYROSCOPE, true, "gyroscopes do not agree"},
    {KEEL_MODE_CHECK_ACCELEROMETER, true, "accelerometers do not agree"},
    {KEEL_MODE_CHECK_MAGNETOMETER, true, "magnetometer"},
    {KEEL_MODE_CHECK_BAROMETER, true, "no good altitude"},
    {KEEL_MODE_CHECK_POSITION_ESTIMATE, true, "no good position"},
    {KEEL_MODE_CHECK_CALIBRATION, true, "not calibrated"},
    {KEEL_MODE_CHECK_LEVEL_ATTITUDE, true, "not level"},
    {KEEL_MODE_CHECK_BATTERY_LEVEL, true, "battery"},
    {KEEL_MODE_CHECK_MOTORS, true, "motors"},
    {KEEL_MODE_CHECK_CPU_LOAD, true, "processor load"},
    {KEEL_MODE_CHECK_STORAGE, true, "storage"},
    {KEEL_MODE_CHECK_HOME_POSITION, true, "no home"},
    {COPTER_CHECK_GROUND_PRESSURE, true, "pressure not of the ground: an MS5607?"},
    {COPTER_CHECK_SAFETY_SWITCH, true, "safety switch at safe, or none"},
    {KEEL_MODE_RC_LINKED, false, "no radio link"},
    {KEEL_MODE_ARM_SWITCH_ON, false, "arm switch"},
    {KEEL_MODE_ARM_SWITCH_OFF, false, "arm switch not off"},
    {KEEL_MODE_THROTTLE_LOW, false, "throttle not low"},
    {KEEL_MODE_KILL_SWITCH_ON, false, "kill switch"},
    {KEEL_MODE_SWITCH_UNMOVED, false, "mode switch not at a mode to fly"},
    {KEEL_MODE_LANDED, false, "not landed"},
    {KEEL_MODE_ATTITUDE_VALID, false, "no attitude"},
    {KEEL_MODE_ALTITUDE_VALID, false, "no altitude"},
    {KEEL_MODE_POSITION_VALID, false, "no position"},
    {KEEL_MODE_FENCE_BREACHED, false, "outside the fence"},
    {KEEL_MODE_BATTERY_CRITICAL, false, "battery critical"},
    {KEEL_MODE_BATTERY_EMPTY, false, "battery empty"},
};

const char *copter_obstacle(const keel_mode_refusal_t *refusal, uint32_t index)
{
    const word_t *const word = &words[index];
    const uint32_t bits = word->is_check ? refusal->checks : refusal->facts;

    return ((bits & word->bit) != 0u) ? word->text : NULL;
}

const char *copter_obstacle_first(const keel_mode_t *mode)
{
    const char *first = NULL;

    if (mode->state == KEEL_MODE_TERMINATED) {
        return "terminated until the power is off";
    }
    for (uint32_t i = 0u; (i < COPTER_OBSTACLES) && (first == NULL); i++) {
        first = copter_obstacle(&mode->refused, i);
    }
    return (first != NULL) ? first : "";
}
