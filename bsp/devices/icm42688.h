/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file icm42688.h
 * @brief The inertial sensor ICM-42688-P (TDK InvenSense, DS-000347) on an SPI bus.
 *
 * Full scale is 2000 degrees per second and 16 g, samples come at 1 kHz. Two low-passes follow each
 * other: anti-alias filters at 258 Hz (gyroscope) and 213 Hz (accelerometer), then one at 250 Hz.
 *
 * Its registers lie in banks. Samples, their status and what keel_icm42688_check reads lie in bank
 * 0, and only the start leaves it, so that no failure in flight can leave another bank selected.
 *
 * @code
 * keel_icm42688_t sensor = {.registers = {.bus = bus, .delay = wait_us}};
 * keel_inertial_sample_t sample;
 *
 * if ((keel_icm42688_start(&sensor) == KEEL_BSP_OK) &&
 *     (keel_icm42688_read(&sensor, &sample) == KEEL_BSP_OK)) {
 *     use(sample.rate[0]);
 * }
 * @endcode
 */
#ifndef KEEL_BSP_DEVICES_ICM42688_H
#define KEEL_BSP_DEVICES_ICM42688_H

#include "common/bsp_status.h"
#include "common/bus.h"
#include "devices/inertial.h"
#include "devices/registers.h"

#include <stdbool.h>

/** The fastest that the bus may be, in Hz (table of the SPI's timing). */
#define KEEL_ICM42688_BUS_LIMIT_HZ 24000000u

/** What a reset is given, in us; it takes 1 ms (register DEVICE_CONFIG). */
#define KEEL_ICM42688_RESET_US 10000u

/** What the sensors are given after they were switched on, in us. The gyroscope takes 30 ms
 * (section 3.1) and must stay on for 45 ms, and for 200 us nothing may be written (PWR_MGMT0). */
#define KEEL_ICM42688_START_US 60000u

/** How often the same sample may be read again: noise moves each axis. */
#define KEEL_ICM42688_REPEATS 100u

/** A sensor. The caller owns it. */
typedef struct keel_icm42688 {
    keel_registers_t registers; /**< Its registers, on a bus with the sensor selected. */
    keel_repeats_t repeats;     /**< Of samples; 0 at the start. */
} keel_icm42688_t;

/**
 * Resets the sensor, makes sure that it is the one, and configures it; what is written is read
 * back (requirements ICP-001 to ICP-004).
 *
 * @param sensor the sensor, with its bus
 * @return KEEL_BSP_OK; KEEL_BSP_STUCK when the identity reads all zeros or all ones; KEEL_BSP_ID;
 *         KEEL_BSP_VERIFY, also of a reset that was not made; KEEL_BSP_TIMEOUT, KEEL_BSP_BUS or
 *         KEEL_BSP_SHORT of the bus
 */
keel_bsp_status_t keel_icm42688_start(const keel_icm42688_t *sensor);

/**
 * Whether it is still the sensor that was started: identity and the settings of bank 0 are read
 * back (requirement ICP-008). A brown-out loses the settings of all banks at once.
 *
 * @param sensor the sensor
 * @return as keel_icm42688_start
 */
keel_bsp_status_t keel_icm42688_check(const keel_icm42688_t *sensor);

/**
 * Whether there is a sample that was not read yet (requirement ICP-005).
 *
 * @param sensor the sensor
 * @param ready  whether there is
 * @return KEEL_BSP_OK, or KEEL_BSP_TIMEOUT, KEEL_BSP_BUS or KEEL_BSP_SHORT, with ready as it was
 */
keel_bsp_status_t keel_icm42688_ready(const keel_icm42688_t *sensor, bool *ready);

/**
 * Reads a sample in one burst, so that its parts belong together (requirements ICP-006, ICP-007
 * and ICP-009).
 *
 * @param sensor the sensor
 * @param sample the sample
 * @return KEEL_BSP_OK; KEEL_BSP_STUCK when all bits are the same, or the same sample has been read
 *         again more than KEEL_ICM42688_REPEATS times; KEEL_BSP_RANGE when a number is -32768,
 *         which the sensor says in place of what it has not measured (INTF_CONFIG0);
 *         KEEL_BSP_TIMEOUT, KEEL_BSP_BUS or KEEL_BSP_SHORT; with sample as it was unless
 *         KEEL_BSP_OK
 */
keel_bsp_status_t keel_icm42688_read(keel_icm42688_t *sensor, keel_inertial_sample_t *sample);

#endif
