/* SPDX-License-Identifier: Apache-2.0 */
/* Scheduler analysis, stack and ADC. */
#include "copter.h"

#include <stddef.h>

/* The counts of all tasks since the start; the kernel's own counts stay at their ends. */
static void count_faults(copter_health_t *self, const copter_t *copter)
{
    self->overruns = 0u;
    self->skipped = 0u;
    for (uint32_t row = 0u; row < copter->tasks; row++) {
        keel_task_report_t report;

        if (keel_scheduler_report(&copter->scheduler, copter_declaration(row), &report) ==
            KEEL_OK) {
            self->overruns += report.stats.overruns;
            self->skipped += report.skipped;
        }
    }
}

void copter_scheduler_analysis(copter_health_t *self, const copter_t *copter)
{
    const uint64_t now_us = copter->scheduler.clock.now_us;

    self->load_ppm = keel_load_ppm(&self->window, now_us, copter->scheduler.busy_us);
    keel_load_begin(&self->window, now_us, copter->scheduler.busy_us);
    count_faults(self, copter);
    self->checks = (self->load_ppm <= copter_settings.load_limit_ppm) ? KEEL_MODE_CHECK_CPU_LOAD
                                                                      : 0u;
}

void copter_stack(copter_health_t *self, copter_parameter_store_t *parameters,
                  const copter_t *copter)
{
    self->stack_free = copter->port->stack_free(copter->port->context);
    copter_parameter_store_step(parameters);
}

void copter_adc(copter_health_t *self, const copter_t *copter)
{
    const copter_port_t *const port = copter->port;
    copter_chip_t chip = {0};

    if (port->read_chip != NULL) {
        port->read_chip(port->context, &chip);
    }
    self->chip = chip; /* Nothing of the run before. */
}
