/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ms5611.h
 * @brief The barometer MS5611-01BA03 (TE Connectivity) on an SPI bus: a state machine that never
 *        waits.
 *
 * It is reset, its PROM is read and checked, and then temperature and pressure are converted in
 * turn, 4096 times oversampled, 9.04 ms each. Whoever steps it at 100 Hz has 50 samples a second.
 *
 * A conversion that fails is begun again; when many fail in a row, the sensor is reset. Every
 * failure is told by the step that meets it.
 */
#ifndef KEEL_BSP_DEVICES_MS5611_H
#define KEEL_BSP_DEVICES_MS5611_H

#include "common/bsp_status.h"
#include "common/bus.h"
#include "common/progress.h"
#include "keel/middleware/ms5611.h"

#include <stdint.h>

/** The fastest that the bus may be, in Hz. */
#define KEEL_MS5611_BUS_LIMIT_HZ 20000000u

/** What a reset takes, in us: 2.8 ms, and a tick of the clock. */
#define KEEL_MS5611_RESET_US 2801u

/** What a conversion takes at most, in us: 9.04 ms, and a tick. */
#define KEEL_MS5611_CONVERSION_US 9041u

/** How many failures in a row reset the sensor. */
#define KEEL_MS5611_FAILURES 10u

/** How often the same two readings may be told again: noise moves them by dozens. */
#define KEEL_MS5611_REPEATS 25u

/** What the sensor is doing. */
typedef enum keel_ms5611_state {
    KEEL_MS5611_OFF,         /**< It is to be reset. */
    KEEL_MS5611_RESETTING,   /**< It loads its PROM. */
    KEEL_MS5611_IDLE,        /**< It is to convert the temperature. */
    KEEL_MS5611_TEMPERATURE, /**< It converts the temperature. */
    KEEL_MS5611_PRESSURE     /**< It converts the pressure. */
} keel_ms5611_state_t;

/** A sensor. Written by the functions below alone; all of it may be read. */
typedef struct keel_ms5611_device {
    keel_bus_t bus;              /**< The bus, with the sensor selected. */
    keel_ms5611_t coefficients;  /**< Of its PROM. */
    keel_ms5611_sample_t sample; /**< The last sample; all 0 before. */
    keel_ms5611_state_t state;   /**< What it is doing. */
    keel_progress_t progress;    /**< Times and failures. */
    uint32_t temperature;        /**< The raw temperature that was read last. */
    keel_repeats_t repeats;      /**< Of the raw readings. */
} keel_ms5611_device_t;

/**
 * Makes a sensor that was not reset yet (requirement MSD-001).
 *
 * @param device the sensor
 * @param bus    its bus
 */
void keel_ms5611_begin(keel_ms5611_device_t *device, keel_bus_t bus);

/**
 * Does what is next, if its time has come: at most nine exchanges, of four bytes at most, and no
 * waiting (requirements MSD-002 to MSD-011).
 *
 * @param device     the sensor
 * @param elapsed_us the time since the call before, in us
 * @return KEEL_BSP_OK when there is a new sample; KEEL_BSP_WAIT when there is none yet;
 *         KEEL_BSP_STUCK when the PROM or a reading has all bits the same, or readings repeat;
 *         KEEL_BSP_VERIFY when the PROM's check is wrong; KEEL_BSP_TIMEOUT when a conversion has
 *         not ended in time; KEEL_BSP_RANGE when what was measured cannot be; KEEL_BSP_TIMEOUT,
 *         KEEL_BSP_BUS or KEEL_BSP_SHORT of the bus; with the sample as it was unless KEEL_BSP_OK
 */
keel_bsp_status_t keel_ms5611_step(keel_ms5611_device_t *device, uint32_t elapsed_us);

#endif
