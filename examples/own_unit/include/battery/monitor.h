/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file monitor.h
 * @brief Watches a battery's voltage, and says when to land.
 *
 * A single low sample is noise; so many in a row are a battery that is nearly empty. The alarm
 * stays: a voltage that recovers when the motors slow down says nothing about the charge.
 */
#ifndef BATTERY_MONITOR_H
#define BATTERY_MONITOR_H

#include "keel/status.h"

#include <stdbool.h>
#include <stdint.h>

/** Samples in a row below the limit that raise the alarm. */
#define BATTERY_MONITOR_SAMPLES 5u

/** The state of a monitor. */
typedef struct battery_monitor {
    uint16_t limit_mv;
    uint8_t low;
    bool alarm;
} battery_monitor_t;

/*@ predicate battery_monitor_valid(battery_monitor_t *monitor) =
  @     monitor->low <= BATTERY_MONITOR_SAMPLES;
  @*/

/**
 * Starts a monitor (requirement BAT-001).
 *
 * @param monitor  the state, which is written as a whole, or not at all
 * @param limit_mv the voltage below which a sample is low, in millivolts, not 0
 * @return KEEL_OK, or KEEL_ERR_LIMITS for a limit of 0, below which no voltage is
 */
/*@ requires \valid(monitor);
  @ behavior refused:
  @   assumes limit_mv == 0;
  @   assigns \nothing;
  @   ensures BAT_001_refused: \result == KEEL_ERR_LIMITS;
  @ behavior started:
  @   assumes limit_mv != 0;
  @   assigns *monitor;
  @   ensures BAT_001_started: \result == KEEL_OK;
  @   ensures BAT_001_limit: monitor->limit_mv == limit_mv;
  @   ensures BAT_001_low: monitor->low == 0;
  @   ensures BAT_001_alarm: monitor->alarm == \false;
  @   ensures valid: battery_monitor_valid(monitor);
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t battery_monitor_init(battery_monitor_t *monitor, uint16_t limit_mv);

/**
 * Takes a sample (requirement BAT-002).
 *
 * @param monitor    the state
 * @param voltage_mv the voltage now, in millivolts
 * @return whether the alarm is raised, now or before
 */
/*@ requires \valid(monitor) && battery_monitor_valid(monitor);
  @ assigns monitor->low, monitor->alarm;
  @ ensures BAT_002_reset: voltage_mv >= monitor->limit_mv ==> monitor->low == 0;
  @ ensures BAT_002_counts: voltage_mv < monitor->limit_mv ==>
  @     monitor->low == \min(\old(monitor->low) + 1, BATTERY_MONITOR_SAMPLES);
  @ ensures BAT_002_alarm: monitor->alarm <==>
  @     (\old(monitor->alarm) || monitor->low == BATTERY_MONITOR_SAMPLES);
  @ ensures BAT_002_result: \result == monitor->alarm;
  @ ensures valid: battery_monitor_valid(monitor);
  @*/
bool battery_monitor_step(battery_monitor_t *monitor, uint16_t voltage_mv);

#endif
