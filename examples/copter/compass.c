/* SPDX-License-Identifier: Apache-2.0 */
/* Background and foreground magnetometer. */
#include "copter.h"

#define OVERSAMPLING 2u /* Background runs in a foreground period. */

keel_status_t copter_compass_init(copter_compass_t *compass)
{
    for (uint32_t k = 0u; k < 3u; k++) {
        (void)keel_oversample_init(&compass->axis[k], OVERSAMPLING);
    }
    return KEEL_OK;
}

void copter_background_magnetometer(copter_t *copter)
{
    copter_field_t sample;

    if (copter->port->read_magnetometer(copter->port->context, &sample)) {
        for (uint32_t k = 0u; k < 3u; k++) {
            (void)keel_oversample_add(&copter->compass.axis[k], sample.value[k]);
        }
    }
}

void copter_foreground_magnetometer(copter_t *copter)
{
    copter_compass_t *const self = &copter->compass;
    float field[3] = {0.0f, 0.0f, 0.0f};
    bool whole = true;

    for (uint32_t k = 0u; k < 3u; k++) {
        if (keel_oversample_take(&self->axis[k], &field[k]) != KEEL_OK) {
            whole = false;
        }
    }
    if (whole) {
        keel_calibration_vector_t out;

        keel_calibration_apply(copter->calibration.field.offset, field, &out);
        self->raw = (keel_attitude_vector_t){field[0], field[1], field[2]};
        self->field = (keel_attitude_vector_t){out.axis[0], out.axis[1], out.axis[2]};
        self->samples++;
    }
}
