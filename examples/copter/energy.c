/* SPDX-License-Identifier: Apache-2.0 */
/* Background and foreground power module. */
#include "copter.h"

keel_status_t copter_energy_init(copter_energy_t *energy)
{
    return keel_battery_init(&energy->battery, &copter_settings.battery);
}

void copter_background_power_module(copter_t *copter)
{
    for (uint32_t i = 0u; i < COPTER_MODULES; i++) {
        keel_battery_reading_t *const module = &copter->energy.sample.module[i];
        copter_power_reading_t reading;

        if (copter->port->read_power(copter->port->context, i, &reading)) {
            module->voltage = reading.voltage;
            module->current = reading.current;
            module->has_voltage = true;
            module->has_current = true;
        }
    }
}

void copter_foreground_power_module(copter_t *copter)
{
    copter_energy_t *const self = &copter->energy;

    self->sample.running = copter->state.mode.motors;
    keel_battery_step(&self->battery, &self->sample);
    for (uint32_t i = 0u; i < COPTER_MODULES; i++) {
        self->sample.module[i].has_voltage = false;
        self->sample.module[i].has_current = false;
    }
}
