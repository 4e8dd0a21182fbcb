/* SPDX-License-Identifier: Apache-2.0 */
/* Calibrations, as a ground station hears of them, and the parameters that keep what they found. */
#include "command.h"
#include "keel/middleware/range.h"

#define TURNS_US 6000000u

/* A place of a command's parameters, and its values. */
#define ACCELEROMETER 4u
#define ON_SIX_SIDES  1.0f
#define WHILE_LEVEL   2.0f

/* Parameters that keep what calibrations find: offsets of the magnetometer, offset and scale of
 * each accelerometer, and how they are mounted. */
#define FIELD_FIRST 0u
#define SIDES_FIRST 3u
#define OF_UNIT     6u
#define TRIM_FIRST  21u
#define KEPT        23u

static const char *const kept_name[KEPT] = {
    "MAG_OFF_X",    "MAG_OFF_Y",    "MAG_OFF_Z",    "ACC1_OFF_X", "ACC1_OFF_Y", "ACC1_OFF_Z",
    "ACC1_SCALE_X", "ACC1_SCALE_Y", "ACC1_SCALE_Z", "ACC2_OFF_X", "ACC2_OFF_Y", "ACC2_OFF_Z",
    "ACC2_SCALE_X", "ACC2_SCALE_Y", "ACC2_SCALE_Z", "ACC3_OFF_X", "ACC3_OFF_Y", "ACC3_OFF_Z",
    "ACC3_SCALE_X", "ACC3_SCALE_Y", "ACC3_SCALE_Z", "TRIM_ROLL",  "TRIM_PITCH"};

/* QGroundControl knows these texts. They name the side that points down: front, where the axis
 * forwards does. */
static const char *const side_detected[KEEL_CALIBRATION_SIDES] = {
    "back orientation detected",  "front orientation detected", "left orientation detected",
    "right orientation detected", "up orientation detected",    "down orientation detected"};
static const char *const side_done[KEEL_CALIBRATION_SIDES] = {
    "back side done, rotate to a different side", "front side done, rotate to a different side",
    "left side done, rotate to a different side", "right side done, rotate to a different side",
    "up side done, rotate to a different side",   "down side done, rotate to a different side"};
static const char *const progress[KEEL_CALIBRATION_SIDES + 1u] = {
    "progress <0>",  "progress <17>", "progress <33>", "progress <50>",
    "progress <67>", "progress <83>", "progress <100>"};

/* Says why gyroscopes are not calibrated; not for each turn. */
static void tell_turn(copter_telemetry_t *self, uint32_t turns, uint64_t now_us)
{
    if ((turns != self->turns) && ((now_us - self->turned_us) >= TURNS_US)) {
        copter_text(self, (uint8_t)MAV_SEVERITY_WARNING,
                    "not calibrated: ", "it turns, or iron moves nearby");
        self->turned_us = now_us;
        self->turns = turns;
    }
}

/* How it ended, in words. */
static void tell_field(copter_telemetry_t *self, uint8_t end)
{
    static const char *const words[] = {[KEEL_CALIBRATION_FIT] = "calibrated",
                                        [KEEL_CALIBRATION_NARROW] = "turn it about all axes",
                                        [KEEL_CALIBRATION_WIDE] = "refused, the field is disturbed",
                                        [KEEL_CALIBRATION_BEYOND] = "refused, iron is too near"};

    copter_text(self,
                (end == (uint8_t)KEEL_CALIBRATION_FIT) ? (uint8_t)MAV_SEVERITY_INFO
                                                       : (uint8_t)MAV_SEVERITY_WARNING,
                "magnetometer: ", words[end]);
}

static void say_calibration(copter_telemetry_t *self, const char *what)
{
    copter_text(self, (uint8_t)MAV_SEVERITY_INFO, "[cal] ", what);
}

/* A side that is new, and how many there are. */
static void tell_sides(copter_telemetry_t *self, const copter_accel_calibration_t *from)
{
    uint32_t count = 0u;

    if (from->side != self->side) {
        self->side = from->side;
        if ((from->side < KEEL_CALIBRATION_SIDES) && ((from->seen & (1u << from->side)) == 0u)) {
            say_calibration(self, side_detected[from->shown]);
        }
    }
    if ((from->seen != self->sides) && (from->seen != 0u)) {
        for (uint32_t bits = from->seen; bits != 0u; bits >>= 1u) {
            count += bits & 1u;
        }
        say_calibration(self, side_done[from->shown]);
        say_calibration(self, progress[count]);
    }
    self->sides = from->seen;
}

/* How it ended. */
static void tell_end(copter_telemetry_t *self, uint8_t levelling, uint8_t end)
{
    const bool is_level = levelling == (uint8_t)COPTER_LEVELLING_LEVEL;

    if (end == (uint8_t)COPTER_LEVELLED_DONE) {
        say_calibration(self, is_level ? "calibration done: level" : "calibration done: accel");
        self->keeps = is_level ? TRIM_FIRST : SIDES_FIRST;
        self->keeps_end = is_level ? KEPT : TRIM_FIRST;
    } else if (end == (uint8_t)COPTER_LEVELLED_CANCELLED) {
        say_calibration(self, "calibration cancelled");
    } else {
        say_calibration(self, is_level ? "calibration failed: level" : "calibration failed: accel");
        copter_text(self, (uint8_t)MAV_SEVERITY_WARNING, "not calibrated: ",
                    (end == (uint8_t)COPTER_LEVELLED_LATE) ? "it did not rest for two minutes"
                                                           : "what was found is beyond limits");
    }
}

static void tell_levelling(copter_telemetry_t *self, const copter_accel_calibration_t *from)
{
    if (self->levelling == (uint8_t)COPTER_LEVELLING_SIDES) {
        tell_sides(self, from);
    }
    if ((from->levelling == (uint8_t)COPTER_LEVELLING_NONE) &&
        (self->levelling != from->levelling)) {
        tell_end(self, self->levelling, from->end);
    }
    self->levelling = from->levelling;
}

static uint32_t begin_levelling(copter_t *copter, copter_levelling_t levelling)
{
    copter_telemetry_t *const self = copter->telemetry;

    if (copter->state.mode.motors) {
        copter_text(self, (uint8_t)MAV_SEVERITY_WARNING, "not calibrated: ", "armed");
        return MAV_RESULT_TEMPORARILY_REJECTED;
    }
    if (self->levelling != (uint8_t)COPTER_LEVELLING_NONE) {
        return MAV_RESULT_TEMPORARILY_REJECTED;
    }
    copter_accel_calibration_ask(&copter->calibration.accelerometers, (uint8_t)levelling);
    say_calibration(self, (levelling == COPTER_LEVELLING_LEVEL) ? "calibration started: 2 level"
                                                                : "calibration started: 2 accel");
    self->levelling = (uint8_t)levelling;
    self->sides = 0u;
    self->side = (uint8_t)KEEL_CALIBRATION_SIDES;
    return MAV_RESULT_ACCEPTED;
}

static uint32_t end_levelling(copter_t *copter)
{
    if (copter->telemetry->levelling != (uint8_t)COPTER_LEVELLING_NONE) {
        copter_accel_calibration_ask(&copter->calibration.accelerometers,
                                     (uint8_t)COPTER_LEVELLING_NONE);
    }
    return MAV_RESULT_ACCEPTED;
}

uint32_t copter_command_calibrate(copter_t *copter, const copter_command_t *command)
{
    const float which = command->param[ACCELEROMETER];
    uint32_t result = MAV_RESULT_UNSUPPORTED;
    bool alone = true;

    for (uint32_t i = 0u; i < COPTER_COMMAND_PARAMS; i++) {
        alone = alone && ((i == ACCELEROMETER) || copter_command_is_empty(command->param[i]));
    }
    if (alone && copter_command_is_empty(which)) {
        result = end_levelling(copter);
    } else if (alone && keel_range_contains(which, ON_SIX_SIDES, ON_SIX_SIDES)) {
        result = begin_levelling(copter, COPTER_LEVELLING_SIDES);
    } else if (alone && keel_range_contains(which, WHILE_LEVEL, WHILE_LEVEL)) {
        result = begin_levelling(copter, COPTER_LEVELLING_LEVEL);
    } else {
        /* Gyroscopes calibrate themselves, and the pilot asks for the magnetometer's. */
    }
    return result;
}

static float value_found(const copter_calibration_t *from, uint32_t kept)
{
    const uint32_t of_unit = (kept - SIDES_FIRST) % OF_UNIT;
    float value = 0.0f;

    if (kept < SIDES_FIRST) {
        value = from->field.offset[kept];
    } else if (kept >= TRIM_FIRST) {
        value = from->accelerometers.trim[kept - TRIM_FIRST];
    } else {
        const keel_calibration_correction_t
            *const correction = &from->accelerometers.found[(kept - SIDES_FIRST) / OF_UNIT];

        value = (of_unit < KEEL_CALIBRATION_AXES)
                    ? correction->offset[of_unit]
                    : correction->scale[of_unit - KEEL_CALIBRATION_AXES];
    }
    return value;
}

/* Sets one parameter: each is checked with all others, which is enough for a run. */
static void keep_next(copter_t *copter)
{
    copter_telemetry_t *const self = copter->telemetry;
    keel_parameters_t *const table = &copter->parameters.table;
    const char *const name = kept_name[self->keeps];
    const uint16_t index = keel_parameters_find(table, name);
    const keel_parameter_value_t value = {.type = KEEL_PARAMETER_FLOAT,
                                          .real = value_found(&copter->calibration, self->keeps)};

    if (keel_parameters_set(table, index, value) == KEEL_OK) {
        copter_mavlink_parameter_is_set(copter, index);
    } else {
        copter_text(self, (uint8_t)MAV_SEVERITY_WARNING, name, ": not kept");
    }
    self->keeps++;
}

/* The pilot has ended a calibration of the magnetometer. */
static void take_field(copter_telemetry_t *self, const copter_calibration_t *from)
{
    self->field_ends = from->field_ends;
    tell_field(self, from->field_end);
    if (from->field_end == (uint8_t)KEEL_CALIBRATION_FIT) {
        self->keeps = FIELD_FIRST;
        self->keeps_end = SIDES_FIRST;
    }
}

/* One thing in a run: what another calibration found waits until that of the first is kept. */
void copter_keep_calibration(copter_t *copter)
{
    copter_telemetry_t *const self = copter->telemetry;
    const copter_calibration_t *const from = &copter->calibration;

    tell_turn(self, from->turns, copter->scheduler.clock.now_us);
    if (self->keeps < self->keeps_end) {
        keep_next(copter);
    } else if (self->field_ends != from->field_ends) {
        take_field(self, from);
    } else {
        tell_levelling(self, &from->accelerometers);
    }
}
