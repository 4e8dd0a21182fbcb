/* SPDX-License-Identifier: Apache-2.0 */
/* The tasks of table 2, and what each of them writes: a body gets no more than that to write to. */
#include "copter.h"

static void run_scheduler_analysis(copter_t *copter)
{
    copter_scheduler_analysis(&copter->health, copter);
}

static void run_stack(copter_t *copter)
{
    copter_stack(&copter->health, &copter->parameters, copter);
}

static void run_adc(copter_t *copter)
{
    copter_adc(&copter->health, copter);
}

static void run_background_power_module(copter_t *copter)
{
    copter_background_power_module(&copter->power, copter);
}

static void run_foreground_power_module(copter_t *copter)
{
    copter_foreground_power_module(&copter->power, copter);
}

static void run_background_barometer(copter_t *copter)
{
    copter_background_barometer(&copter->barometer, copter);
}

static void run_foreground_barometer(copter_t *copter)
{
    copter_foreground_barometer(&copter->barometer);
}

static void run_background_magnetometer(copter_t *copter)
{
    copter_background_magnetometer(&copter->magnetometer, copter);
}

static void run_foreground_magnetometer(copter_t *copter)
{
    copter_foreground_magnetometer(&copter->magnetometer, copter);
}

static void run_calibration_magnetometer(copter_t *copter)
{
    copter_calibration_magnetometer(&copter->calibration, copter);
}

static void run_background_imu(copter_t *copter)
{
    copter_background_imu(&copter->imu, copter);
}

static void run_foreground_imu(copter_t *copter)
{
    copter_foreground_imu(&copter->imu, copter);
}

static void run_calibration_imu(copter_t *copter)
{
    copter_calibration_imu(&copter->calibration, copter);
}

static void run_gps(copter_t *copter)
{
    copter_gps(&copter->gps, copter);
}

static void run_background_radio(copter_t *copter)
{
    copter_background_radio(&copter->pilot, copter);
}

static void run_foreground_radio(copter_t *copter)
{
    copter_foreground_radio(&copter->pilot);
}

static void run_navigation(copter_t *copter)
{
    copter_navigation(&copter->estimate, copter);
}

static void run_angle_rate_control(copter_t *copter)
{
    copter_angle_rate_control(&copter->control, copter);
}

static void run_angle_control(copter_t *copter)
{
    copter_angle_control(&copter->control, &copter->pilot, copter);
}

static void run_position_control(copter_t *copter)
{
    copter_position_control(&copter->control, copter);
}

static void run_state_machine(copter_t *copter)
{
    copter_state_machine(&copter->state, &copter->request, copter);
}

void (*const copter_bodies[URPILOT_TASK_COUNT])(copter_t *copter) = {
    [URPILOT_SCHEDULER_ANALYSIS] = run_scheduler_analysis,
    [URPILOT_STACK] = run_stack,
    [URPILOT_ADC] = run_adc,
    [URPILOT_BACKGROUND_POWER_MODULE] = run_background_power_module,
    [URPILOT_FOREGROUND_POWER_MODULE] = run_foreground_power_module,
    [URPILOT_BACKGROUND_BAROMETER] = run_background_barometer,
    [URPILOT_FOREGROUND_BAROMETER] = run_foreground_barometer,
    [URPILOT_BACKGROUND_MAGNETOMETER] = run_background_magnetometer,
    [URPILOT_FOREGROUND_MAGNETOMETER] = run_foreground_magnetometer,
    [URPILOT_CALIBRATION_MAGNETOMETER] = run_calibration_magnetometer,
    [URPILOT_BACKGROUND_IMU] = run_background_imu,
    [URPILOT_FOREGROUND_IMU] = run_foreground_imu,
    [URPILOT_CALIBRATION_IMU] = run_calibration_imu,
    [URPILOT_GPS] = run_gps,
    [URPILOT_BACKGROUND_RADIO] = run_background_radio,
    [URPILOT_FOREGROUND_RADIO] = run_foreground_radio,
    [URPILOT_NAVIGATION] = run_navigation,
    [URPILOT_ANGLE_RATE_CONTROL] = run_angle_rate_control,
    [URPILOT_ANGLE_CONTROL] = run_angle_control,
    [URPILOT_POSITION_CONTROL] = run_position_control,
    [URPILOT_STATE_MACHINE] = run_state_machine,
};
