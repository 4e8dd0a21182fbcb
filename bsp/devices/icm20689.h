/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file icm20689.h
 * @brief The inertial sensor ICM-20689 (TDK InvenSense, DS-000143) on an SPI bus.
 *
 * Full scale is 2000 degrees per second and 16 g, samples come at 1 kHz, low-pass at 176 Hz
 * (gyroscope) and 218 Hz (accelerometer).
 */
#ifndef KEEL_BSP_DEVICES_ICM20689_H
#define KEEL_BSP_DEVICES_ICM20689_H

#include "common/bsp_status.h"
#include "common/bus.h"

#include <stdbool.h>
#include <stdint.h>

/** The fastest that the bus may be, in Hz. */
#define KEEL_ICM20689_BUS_LIMIT_HZ 8000000u

/** What a reset takes at most, in us. */
#define KEEL_ICM20689_RESET_US 100000u

/** Waits; returns KEEL_BSP_OK, or why it could not. */
typedef keel_bsp_status_t (*keel_delay_fn_t)(void *context, uint32_t time_us);

/** A sensor. The caller owns it. */
typedef struct keel_icm20689 {
    keel_bus_t bus;        /**< The bus, with the sensor selected. */
    keel_delay_fn_t delay; /**< Waits between the steps of the start. */
    void *delay_context;   /**< Handed to delay; may be null. */
} keel_icm20689_t;

/** One sample, in the sensor's axes. */
typedef struct keel_icm20689_sample {
    int16_t acceleration[3]; /**< 1 / 2048 g. */
    int16_t temperature;     /**< 1 / 326.8 degrees Celsius, above 25. */
    int16_t rate[3];         /**< 1 / 16.4 degree per second. */
} keel_icm20689_sample_t;

/**
 * Resets the sensor, makes sure that it is one, and configures it; what is written is read back
 * (requirements ICM-001 to ICM-004).
 *
 * @param sensor the sensor, with its bus
 * @return KEEL_BSP_OK; KEEL_BSP_STUCK when the identity reads all zeros or all ones; KEEL_BSP_ID;
 *         KEEL_BSP_VERIFY; KEEL_BSP_TIMEOUT, KEEL_BSP_BUS or KEEL_BSP_SHORT of the bus
 */
keel_bsp_status_t keel_icm20689_start(const keel_icm20689_t *sensor);

/**
 * Whether there is a sample that was not read yet (requirement ICM-005).
 *
 * @param sensor the sensor
 * @param ready  whether there is
 * @return KEEL_BSP_OK, or KEEL_BSP_TIMEOUT, KEEL_BSP_BUS or KEEL_BSP_SHORT, with ready as it was
 */
keel_bsp_status_t keel_icm20689_ready(const keel_icm20689_t *sensor, bool *ready);

/**
 * Reads a sample in one burst, so that its parts belong together (requirements ICM-006, ICM-007).
 *
 * @param sensor the sensor
 * @param sample the sample
 * @return KEEL_BSP_OK; KEEL_BSP_STUCK when all bits are the same; KEEL_BSP_TIMEOUT, KEEL_BSP_BUS
 *         or KEEL_BSP_SHORT; with sample as it was unless KEEL_BSP_OK
 */
keel_bsp_status_t keel_icm20689_read(const keel_icm20689_t *sensor, keel_icm20689_sample_t *sample);

#endif
