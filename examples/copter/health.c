/* SPDX-License-Identifier: Apache-2.0 */
/* Scheduler analysis, stack and ADC. */
#include "copter.h"

void copter_scheduler_analysis(copter_t *copter)
{
    copter_health_t *const self = &copter->health;
    const uint64_t now_us = copter->scheduler.clock.now_us;

    self->load_ppm = keel_load_ppm(&self->window, now_us, copter->scheduler.busy_us);
    keel_load_begin(&self->window, now_us, copter->scheduler.busy_us);
    self->checks = (self->load_ppm <= copter_settings.load_limit_ppm) ? KEEL_MODE_CHECK_LOAD : 0u;
}

void copter_stack(copter_t *copter)
{
    copter->health.stack_free = copter->port->stack_free(copter->port->context);
    copter_tuning_step(&copter->tuning);
}

void copter_adc(copter_t *copter)
{
    copter->health.supply_v = copter->energy.battery.voltage;
}
