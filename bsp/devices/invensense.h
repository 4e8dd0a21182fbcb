/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file invensense.h
 * @brief The inertial sensors ICM-20689, ICM-20602 and MPU-6000 (TDK InvenSense: DS-000143,
 *        DS-000176, RM-MPU-6000A) on an SPI bus. They share a map of registers; what differs is a
 *        table.
 *
 * Full scale is 2000 degrees per second and 16 g, samples come at 1 kHz, low-pass at 176 Hz
 * (gyroscope) and 218 Hz (accelerometer); of the MPU-6000 at 188 and 184 Hz.
 */
#ifndef KEEL_BSP_DEVICES_INVENSENSE_H
#define KEEL_BSP_DEVICES_INVENSENSE_H

#include "common/bsp_status.h"
#include "common/bus.h"
#include "devices/inertial.h"
#include "devices/registers.h"

#include <stdbool.h>
#include <stdint.h>

/** What a reset takes at most, in us; so does one of the signal paths. */
#define KEEL_INVENSENSE_RESET_US 100000u

/** How often the same sample may be read again: noise moves each axis. */
#define KEEL_INVENSENSE_REPEATS 100u

/** What differs from sensor to sensor. */
typedef struct keel_invensense_kind {
    uint32_t bus_limit_hz;     /**< The fastest that the bus may be, in Hz … */
    uint32_t sample_limit_hz;  /**< … and where only samples and their status are read. */
    int32_t counts;            /**< Steps of temperature in … */
    int32_t counts_cdeg;       /**< … so many hundredths of a degree Celsius. */
    int32_t zero_cdeg;         /**< The temperature that is told as 0, in these. */
    uint8_t identity;          /**< What it says that it is. */
    uint8_t interface_address; /**< The register that switches I2C off … */
    uint8_t interface_value;   /**< … and how. */
    uint8_t signal_paths;      /**< What resets the signal paths after a reset over SPI, or 0. */
    bool has_second_filter;    /**< The accelerometer has a low-pass of its own. */
} keel_invensense_kind_t;

extern const keel_invensense_kind_t keel_icm20689; /**< ICM-20689. */
extern const keel_invensense_kind_t keel_icm20602; /**< ICM-20602. */
extern const keel_invensense_kind_t keel_mpu6000;  /**< MPU-6000. */

/** A sensor. The caller owns it. */
typedef struct keel_invensense {
    const keel_invensense_kind_t *kind; /**< Which it is. */
    keel_registers_t registers;         /**< For start and check: on the bus, with it selected. */
    keel_bus_t sample_bus;              /**< For samples and their status; may be the same. */
    keel_repeats_t repeats;             /**< Of samples; 0 at the start. */
} keel_invensense_t;

/**
 * Resets the sensor, makes sure that it is the one, and configures it; what is written is read back
 * (requirements ICM-001 to ICM-004).
 *
 * @param sensor the sensor, with its bus
 * @return KEEL_BSP_OK; KEEL_BSP_STUCK when the identity reads all zeros or all ones; KEEL_BSP_ID;
 *         KEEL_BSP_VERIFY; KEEL_BSP_TIMEOUT, KEEL_BSP_BUS or KEEL_BSP_SHORT of the bus
 */
keel_bsp_status_t keel_invensense_start(const keel_invensense_t *sensor);

/**
 * Whether it is still the sensor that was started: identity and settings are read back (requirement
 * ICM-008). After a brown-out it would go on in other units, or sleep.
 *
 * @param sensor the sensor
 * @return as keel_invensense_start
 */
keel_bsp_status_t keel_invensense_check(const keel_invensense_t *sensor);

/**
 * Whether there is a sample that was not read yet (requirement ICM-005).
 *
 * @param sensor the sensor
 * @param ready  whether there is
 * @return KEEL_BSP_OK, or KEEL_BSP_TIMEOUT, KEEL_BSP_BUS or KEEL_BSP_SHORT, with ready as it was
 */
keel_bsp_status_t keel_invensense_ready(const keel_invensense_t *sensor, bool *ready);

/**
 * Reads a sample in one burst, so that its parts belong together (requirements ICM-006, ICM-007 and
 * ICM-009).
 *
 * @param sensor the sensor
 * @param sample the sample
 * @return KEEL_BSP_OK; KEEL_BSP_STUCK when all bits are the same, or the same sample has been read
 *         again more than KEEL_INVENSENSE_REPEATS times; KEEL_BSP_TIMEOUT, KEEL_BSP_BUS or
 *         KEEL_BSP_SHORT; with sample as it was unless KEEL_BSP_OK
 */
keel_bsp_status_t keel_invensense_read(keel_invensense_t *sensor, keel_inertial_sample_t *sample);

#endif
