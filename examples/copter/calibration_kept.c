/* SPDX-License-Identifier: Apache-2.0 */
/* Calibrations, as a ground station hears of them, and the parameters that keep what they found. */
#include "telemetry.h"

#define TURNS_US 6000000u

/* Parameters that keep a magnetometer's offset, by its axes. */
static const char *const field_name[KEEL_CALIBRATION_AXES] = {"MAG_OFF_X", "MAG_OFF_Y",
                                                              "MAG_OFF_Z"};

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

/* The pilot has ended a calibration of the magnetometer. */
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

/* Sets one parameter: each is checked with all others, which is enough for a run. Once it is in
 * force, field_offset is that of the parameters. */
static void keep_next(copter_t *copter)
{
    copter_telemetry_t *const self = copter->telemetry;
    keel_parameters_t *const table = &copter->tuning.table;

    const uint32_t axis = self->keeps - 1u;
    const uint16_t index = keel_parameters_find(table, field_name[axis]);
    const keel_parameter_value_t value = {.type = KEEL_PARAMETER_FLOAT,
                                          .real = copter->calibration.field.offset[axis]};

    self->keeps--;
    if (keel_parameters_set(table, index, value) == KEEL_OK) {
        copter_parameter_is_set(copter, index);
    } else {
        copter_text(self, (uint8_t)MAV_SEVERITY_WARNING, field_name[axis], ": not kept");
    }
}

void copter_keep_calibration(copter_t *copter)
{
    copter_telemetry_t *const self = copter->telemetry;
    const copter_calibration_t *const from = &copter->calibration;

    tell_turn(self, from->turns, copter->scheduler.clock.now_us);
    if (self->field_ends != from->field_ends) {
        self->field_ends = from->field_ends;
        tell_field(self, from->field_end);
        self->keeps = (from->field_end == (uint8_t)KEEL_CALIBRATION_FIT) ? KEEL_CALIBRATION_AXES
                                                                         : 0u;
    }
    if (self->keeps > 0u) {
        keep_next(copter);
    }
}
