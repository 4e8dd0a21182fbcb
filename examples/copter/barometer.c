/* SPDX-License-Identifier: Apache-2.0 */
/* Background and foreground barometer. */
#include "copter.h"

#define OVERSAMPLING 2u  /* Background runs in a foreground period. */
#define STUCK        25u /* So many equal pressures in a row, half a second of them. */

keel_status_t copter_barometer_init(copter_barometer_t *barometer)
{
    return keel_oversample_init(&barometer->pressure, OVERSAMPLING);
}

void copter_background_barometer(copter_barometer_t *self, const copter_t *copter)
{
    copter_barometer_sample_t sample;

    if (copter->port->read_barometer(copter->port->context, &sample) &&
        (keel_oversample_add(&self->pressure, sample.pressure_pa) == KEEL_OK)) {
        self->temperature = sample.temperature;
        self->sampled_us = copter->scheduler.clock.now_us;
    }
}

/* Air is never so still that a sensor says the same for long, bit for bit: one that does is stuck.
 * Its pressures are no samples then. */
void copter_foreground_barometer(copter_barometer_t *self)
{
    const float before = self->pressure_pa;

    if (keel_oversample_take(&self->pressure, &self->pressure_pa) == KEEL_OK) {
        if ((self->pressure_pa < before) || (self->pressure_pa > before)) {
            self->repeats = 0u;
        } else if (self->repeats < STUCK) {
            self->repeats++;
        } else {
            /* It is stuck already. */
        }
        self->samples += (self->repeats < STUCK) ? 1u : 0u;
    }
}
