/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ist8310.h
 * @brief The magnetometer IST8310 (iSentek) on an I2C bus: a state machine that never waits.
 *
 * It is reset, known by its identity, configured, and what was written is read back. Then it
 * measures again and again, each time when it is told to, 16 times averaged. A step makes one
 * exchange: one begins a measurement, the next reads it. Stepped at 100 Hz, it has 50 samples a
 * second, less those of one more step behind each tenth: that reads back a setting, or the
 * temperature.
 *
 * After a brown-out it would go on in other units, in which the field is a quarter of what it is.
 * So the first sample, and one that is less than half as strong as the one before, is proved: the
 * step after says that it is there, when the setting of its units has been read back. Samples in
 * other units thus come only if the field has doubled between two of them, and then 20 at most.
 *
 * Every failure is told by the step that meets it; when many follow each other, or a setting is
 * lost, the sensor is reset.
 */
#ifndef KEEL_BSP_DEVICES_IST8310_H
#define KEEL_BSP_DEVICES_IST8310_H

#include "common/bsp_status.h"
#include "common/bus.h"
#include "common/progress.h"

#include <stdint.h>

/** Its address on the bus, of 7 bits. */
#define KEEL_IST8310_ADDRESS 0x0Eu

/** The fastest that the bus may be, in Hz. */
#define KEEL_IST8310_BUS_LIMIT_HZ 400000u

/** What a reset takes at most, in us. */
#define KEEL_IST8310_RESET_US 50000u

/** What a measurement takes, 16 times averaged, in us. */
#define KEEL_IST8310_MEASURE_US 6000u

/** When it is given up, in us. */
#define KEEL_IST8310_LATE_US 30000u

/** How many failures in a row reset the sensor. */
#define KEEL_IST8310_FAILURES 10u

/** How often the same sample may be told again: noise moves it. */
#define KEEL_IST8310_REPEATS 50u

/** What a sample's field counts: so many a gauss, or 100 uT. */
#define KEEL_IST8310_COUNTS_PER_GAUSS 1320

/** After so many samples one step more reads back the next setting, or the temperature. */
#define KEEL_IST8310_ASIDE 10u

/** What the sensor is doing. */
typedef enum keel_ist8310_state {
    KEEL_IST8310_OFF,       /**< It is to be reset. */
    KEEL_IST8310_RESETTING, /**< It comes up. */
    KEEL_IST8310_STARTING,  /**< It is looked at, and configured. */
    KEEL_IST8310_IDLE,      /**< It is to measure. */
    KEEL_IST8310_MEASURING, /**< It measures. */
    KEEL_IST8310_PROVING,   /**< The setting of the units is to be read back behind a sample. */
    KEEL_IST8310_ASIDE_DUE  /**< The next setting, or the temperature, is to be read. */
} keel_ist8310_state_t;

/** One sample. */
typedef struct keel_ist8310_sample {
    int16_t field[3];    /**< 1 / KEEL_IST8310_COUNTS_PER_GAUSS gauss; forward, right and down. */
    int16_t temperature; /**< As the sensor said it last, without a unit in its data sheet; 0 in
                              the first sample. */
} keel_ist8310_sample_t;

/** A sensor. Written by the functions below alone; all of it may be read. */
typedef struct keel_ist8310 {
    keel_bus_t bus;               /**< The bus, with the sensor's address. */
    keel_ist8310_sample_t sample; /**< The last sample; all 0 before. */
    keel_ist8310_state_t state;   /**< What it is doing. */
    keel_progress_t progress;     /**< Times and failures. */
    uint32_t overruns;      /**< Samples that were lost before they were read; stays at its end. */
    uint32_t started;       /**< So many exchanges of the start are done. */
    uint32_t aside;         /**< The setting that is read back next, or the temperature. */
    uint32_t since_aside;   /**< Samples since. */
    uint32_t strength;      /**< The last sample's, squared; UINT32_MAX before the first. */
    int16_t field[3];       /**< What is to be proved. */
    int16_t temperature;    /**< What was read last; 0 before. */
    keel_repeats_t repeats; /**< Of the field. */
} keel_ist8310_t;

/**
 * Makes a sensor that was not reset yet (requirement IST-001).
 *
 * @param sensor the sensor
 * @param bus    its bus
 */
void keel_ist8310_begin(keel_ist8310_t *sensor, keel_bus_t bus);

/**
 * Does what is next, if its time has come: at most one exchange, of eight bytes at most, and no
 * waiting (requirements IST-002 to IST-013).
 *
 * @param sensor     the sensor
 * @param elapsed_us the time since the call before, in us
 * @return KEEL_BSP_OK when there is a new sample; KEEL_BSP_WAIT when there is none yet;
 *         KEEL_BSP_STUCK when identity or field have all bits the same, or the field repeats;
 *         KEEL_BSP_ID when another device answers; KEEL_BSP_VERIFY when a setting does not read
 *         back; KEEL_BSP_TIMEOUT when a reset or a measurement does not end; KEEL_BSP_TIMEOUT,
 *         KEEL_BSP_BUS or KEEL_BSP_SHORT of the bus; with the sample as it was unless KEEL_BSP_OK
 */
keel_bsp_status_t keel_ist8310_step(keel_ist8310_t *sensor, uint32_t elapsed_us);

#endif
