/* SPDX-License-Identifier: Apache-2.0 */
/* Scheduler analysis, stack, ADC, and the calibrations: what the checks before arming rest on. */
#include "copter.h"

static void set_check(copter_health_t *self, uint32_t check, bool holds)
{
    self->checks = holds ? (self->checks | check) : (self->checks & ~check);
}

void copter_scheduler_analysis(copter_t *copter)
{
    copter_health_t *const self = &copter->health;
    const uint64_t now_us = copter->scheduler.clock.now_us;

    self->load_ppm = keel_load_ppm(&self->window, now_us, copter->scheduler.busy_us);
    keel_load_begin(&self->window, now_us, copter->scheduler.busy_us);
    set_check(self, KEEL_MODE_CHECK_LOAD, self->load_ppm <= copter_settings.load_limit_ppm);
}

void copter_stack(copter_t *copter)
{
    copter->health.stack_free = copter->port->stack_free(copter->port->context);
}

void copter_adc(copter_t *copter)
{
    copter->health.supply_v = copter->energy.battery.voltage;
}

/* The gyroscopes' bias is found by the attitude's estimator while the aircraft is still. */
void copter_calibration_imu(copter_t *copter)
{
    set_check(&copter->health, KEEL_MODE_CHECK_CALIBRATION,
              copter->inertia.attitude.phase == KEEL_ATTITUDE_RUNNING);
}

/* The field is what its settings expect when the heading follows it. */
void copter_calibration_magnetometer(copter_t *copter)
{
    set_check(&copter->health, KEEL_MODE_CHECK_MAGNETOMETER,
              copter->inertia.attitude.heading_valid);
}
