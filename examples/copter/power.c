/* SPDX-License-Identifier: Apache-2.0 */
/* Background and foreground power module. */
#include "copter.h"

/* At rest a cell of lithium polymer has so much of its charge: a chart that makers of hobby packs
 * print, in steps of 10 % and finer where it falls. Another chemistry has another one. */
typedef struct rest {
    float volt;
    float part;
} rest_t;

static const rest_t chart[] = {{3.27f, 0.00f}, {3.61f, 0.05f}, {3.69f, 0.10f}, {3.73f, 0.20f},
                               {3.77f, 0.30f}, {3.80f, 0.40f}, {3.84f, 0.50f}, {3.87f, 0.60f},
                               {3.95f, 0.70f}, {4.02f, 0.80f}, {4.11f, 0.90f}, {4.20f, 1.00f}};

#define CHART (sizeof chart / sizeof chart[0])

/* What it has at this voltage; between two rows on the line that joins them. */
static float charge_at(float cell_voltage)
{
    float part = chart[0].part;

    for (uint32_t i = 1u; i < CHART; i++) {
        const rest_t *const low = &chart[i - 1u];
        const rest_t *const high = &chart[i];

        if (cell_voltage >= high->volt) {
            part = high->part;
        } else if (cell_voltage > low->volt) {
            part = low->part + (((cell_voltage - low->volt) / (high->volt - low->volt)) *
                                (high->part - low->part));
        } else {
            /* Rows that are above it add nothing. */
        }
    }
    return part;
}

/* A pack that was not charged is not counted as full: once, before motors ever turn, its voltage at
 * rest says what it has. The configured charge stands where that is less. */
static void look_at_rest(copter_power_t *self)
{
    if (!self->is_known && !self->sample.running && (self->battery.level != KEEL_BATTERY_UNKNOWN)) {
        keel_battery_config_t config = self->battery.config;
        const float part = charge_at(self->battery.cell_voltage);

        self->is_known = true;
        if (part < config.initial) {
            config.initial = part;
            (void)keel_battery_init(&self->battery, &config);
        }
    }
}

keel_status_t copter_power_init(copter_power_t *power)
{
    return keel_battery_init(&power->battery, &copter_settings.battery);
}

void copter_background_power_module(copter_power_t *self, const copter_t *copter)
{
    for (uint32_t i = 0u; i < COPTER_POWER_MODULES; i++) {
        keel_battery_reading_t *const module = &self->sample.module[i];
        copter_power_reading_t reading;

        if (copter->port->read_power(copter->port->context, i, &reading)) {
            module->voltage = reading.voltage;
            module->current = reading.current;
            module->has_voltage = true;
            module->has_current = true;
        }
    }
}

void copter_foreground_power_module(copter_power_t *self, const copter_t *copter)
{
    self->sample.running = copter->state.mode.motors;
    keel_battery_step(&self->battery, &self->sample);
    look_at_rest(self);
    for (uint32_t i = 0u; i < COPTER_POWER_MODULES; i++) {
        self->sample.module[i].has_voltage = false;
        self->sample.module[i].has_current = false;
    }
}
