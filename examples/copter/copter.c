/* SPDX-License-Identifier: Apache-2.0 */
#include "copter.h"

#if COPTER_LOG_TASKS != COPTER_TASKS
#error "COPTER_LOG_TASKS: all tasks"
#endif

/* The scheduler reads these as long as it runs. */
static keel_task_config_t declaration[COPTER_TASKS];

const keel_task_config_t *copter_declaration(uint32_t row)
{
    return &declaration[row];
}

static void copter_body(void *context)
{
    const copter_task_t *const task = context;
    copter_t *const copter = task->copter;
    const copter_port_t *const port = copter->port;

    keel_trace_begin(&copter->log.trace, &copter->scheduler);
    task->body(copter);
    copter_log_sample(copter, task->row);
    port->end_run(port->context, task->row, task->wcet_us);
    if (copter->log.traces) {
        keel_trace_end(&copter->log.trace, &copter->scheduler);
        copter_log_run(copter);
    }
    keel_task_table_add(&copter->table, &copter->log.trace.run);
}

/* The first that is not KEEL_OK. */
static keel_status_t first_of(const keel_status_t status[], uint32_t count)
{
    keel_status_t first = KEEL_OK;

    for (uint32_t i = 0u; (i < count) && (first == KEEL_OK); i++) {
        first = status[i];
    }
    return first;
}

static keel_status_t make_parts(copter_t *copter)
{
    const keel_status_t status[] = {
        copter_imu_init(&copter->imu, copter->port->imus),
        copter_calibration_init(&copter->calibration, copter->port->imus),
        copter_magnetometer_init(&copter->magnetometer),
        copter_barometer_init(&copter->barometer),
        copter_gps_init(&copter->gps),
        copter_pilot_init(&copter->pilot),
        copter_power_init(&copter->power),
        copter_estimate_init(&copter->estimate),
        copter_state_machine_init(&copter->state),
        copter_control_init(&copter->control)};

    return first_of(status, sizeof status / sizeof status[0]);
}

/* The next row, declared already; it is there once the scheduler has it. */
static keel_status_t add_row(copter_t *copter, void (*body)(copter_t *copter), uint32_t wcet_us)
{
    const uint32_t row = copter->tasks;
    const keel_status_t status = keel_scheduler_add(&copter->scheduler, &declaration[row]);

    copter->task[row] = (copter_task_t){
        .copter = copter, .body = body, .row = row, .wcet_us = wcet_us};
    copter->tasks += (status == KEEL_OK) ? 1u : 0u;
    return status;
}

/* Declares a row of table 2, and tells its worst-case execution time. */
static uint32_t declare_row(copter_t *copter, uint32_t row)
{
    keel_task_config_t *const task = &declaration[row];
    uint32_t wcet_us = urpilot_task[row].wcet_us;

    *task = urpilot_task_config(row, copter_body, &copter->task[row]);
    if (row == (uint32_t)URPILOT_SCHEDULER_ANALYSIS) {
        task->budget_us += COPTER_ANALYSIS_WCET_US - wcet_us;
        task->phase_us = COPTER_ANALYSIS_PHASE_US;
        wcet_us = COPTER_ANALYSIS_WCET_US;
    } else if (row == (uint32_t)URPILOT_BACKGROUND_RADIO) {
        task->budget_us += COPTER_RADIO_WCET_US - wcet_us;
        task->phase_us = COPTER_RADIO_PHASE_US;
        wcet_us = COPTER_RADIO_WCET_US;
    } else if (row == (uint32_t)URPILOT_FOREGROUND_RADIO) {
        task->phase_us = COPTER_PILOT_PHASE_US;
        task->priority = COPTER_PILOT_PRIORITY;
    } else if (row == (uint32_t)URPILOT_STATE_MACHINE) {
        task->phase_us = COPTER_STATE_PHASE_US;
        task->priority = COPTER_STATE_PRIORITY;
    } else {
        /* It is as the paper has it. */
    }
    return wcet_us;
}

static keel_status_t add_tasks(copter_t *copter)
{
    keel_status_t status = KEEL_OK;

    for (uint32_t row = 0u; (row < URPILOT_TASK_COUNT) && (status == KEEL_OK); row++) {
        status = add_row(copter, copter_bodies[row], declare_row(copter, row));
    }
    return status;
}

keel_status_t copter_add(copter_t *copter, const copter_own_task_t *own)
{
    const uint32_t row = copter->tasks;

    if (row >= COPTER_TASKS) {
        return KEEL_ERR_FULL;
    }
    declaration[row] = (keel_task_config_t){.name = own->name,
                                            .run = copter_body,
                                            .context = &copter->task[row],
                                            .period_us = own->period_us,
                                            .budget_us = own->budget_us,
                                            .phase_us = own->phase_us,
                                            .priority = KEEL_PRIORITY_LOW};
    return add_row(copter, own->body, own->wcet_us);
}

/* Neither the cascade, nor the mixer, nor the sticks remember anything between flights, and
 * what a calibration has found is in the parameters a few runs of telemetry later.
 * All take their settings: the check of the parameters has asked them. */
void copter_retune(copter_t *copter)
{
    if (copter_parameter_store_apply(&copter->parameters)) {
        (void)copter_control_init(&copter->control);
        copter_calibration_set(&copter->calibration);
        (void)copter_pilot_tune(&copter->pilot);
    }
}

keel_status_t copter_start(copter_t *copter, const copter_port_t *port, bool plain_mean)
{
    const keel_scheduler_config_t config = urpilot_scheduler_config(port->read_clock, port->clock);
    keel_status_t status;

    if ((port->imus < COPTER_IMUS_LEAST) || (port->imus > COPTER_IMUS)) {
        return KEEL_ERR_SENSORS;
    }
    *copter = (copter_t){.port = port, .plain_mean = plain_mean};
    status = copter_parameter_store_start(&copter->parameters, port->memory);
    if (status == KEEL_OK) {
        status = make_parts(copter);
    }
    if (status == KEEL_OK) {
        status = keel_scheduler_init(&copter->scheduler, &config);
    }
    if (status == KEEL_OK) {
        status = add_tasks(copter);
    }
    return (status == KEEL_OK) ? keel_scheduler_start(&copter->scheduler) : status;
}
