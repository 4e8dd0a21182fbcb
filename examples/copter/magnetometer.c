/* SPDX-License-Identifier: Apache-2.0 */
/* Background and foreground magnetometer. */
#include "copter.h"

#define OVERSAMPLING 2u    /* Background runs in a foreground period. */
#define RATE_HZ      50.0f /* Table 2: foreground magnetometer. */
#define CALM_HZ      0.5f  /* Of 2.2 uT of noise a sample this leaves 0.25. */

keel_status_t copter_magnetometer_init(copter_magnetometer_t *magnetometer)
{
    keel_status_t status = KEEL_OK;

    for (uint32_t k = 0u; (k < 3u) && (status == KEEL_OK); k++) {
        (void)keel_oversample_init(&magnetometer->axis[k], OVERSAMPLING);
        status = keel_filter_init(&magnetometer->calm[k], RATE_HZ, CALM_HZ);
    }
    return status;
}

void copter_background_magnetometer(copter_magnetometer_t *self, const copter_t *copter)
{
    copter_magnetometer_sample_t sample;

    if (copter->port->read_magnetometer(copter->port->context, &sample)) {
        for (uint32_t k = 0u; k < 3u; k++) {
            (void)keel_oversample_add(&self->axis[k], sample.value[k]);
        }
    }
}

/* It begins at the first sample. A value that is no number changes nothing. */
static void calm_down(copter_magnetometer_t *self, const float field[3])
{
    for (uint32_t k = 0u; k < 3u; k++) {
        (void)((self->samples == 0u) ? keel_filter_reset(&self->calm[k], field[k])
                                     : keel_filter_step(&self->calm[k], field[k]));
    }
}

/* Along an axis, what the wires' current makes of the field. A current that does not come any more
 * is held by the battery's monitor; before the first it is 0. */
static float own_field(const copter_t *copter, uint32_t axis)
{
    return copter_settings.field_per_ampere[axis] * copter->power.battery.current;
}

void copter_foreground_magnetometer(copter_magnetometer_t *self, const copter_t *copter)
{
    float field[3] = {0.0f, 0.0f, 0.0f};
    bool whole = true;

    for (uint32_t k = 0u; k < 3u; k++) {
        if (keel_oversample_take(&self->axis[k], &field[k]) != KEEL_OK) {
            whole = false;
        }
    }
    if (whole) {
        keel_calibration_vector_t out;

        self->raw = (keel_attitude_vector_t){field[0], field[1], field[2]};
        for (uint32_t k = 0u; k < 3u; k++) {
            field[k] -= own_field(copter, k);
        }
        keel_calibration_correct(&copter->calibration.magnetometer, field, &out);
        calm_down(self, field);
        self->field = (keel_attitude_vector_t){out.axis[0], out.axis[1], out.axis[2]};
        self->samples++;
    }
}
