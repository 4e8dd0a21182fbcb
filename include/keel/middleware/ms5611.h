/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ms5611.h
 * @brief The barometer MS5611-01BA03: from what it reads to pressure and temperature.
 *
 * The sensor tells two raw readings of 24 bits, D1 (pressure) and D2 (temperature). Six
 * coefficients, which its maker measured and wrote into its PROM, turn them into values by
 * the formulas of its data sheet, second order at low temperatures included; all divisions cut off
 * towards zero, as C's do.
 *
 * All is integer arithmetic of 64 bits, and nothing overflows, whatever the PROM holds and whatever
 * is read. How the sensor is asked is its driver's affair (bsp/devices/ms5611.h).
 */
#ifndef KEEL_MIDDLEWARE_MS5611_H
#define KEEL_MIDDLEWARE_MS5611_H

#include "keel/c_declarations.h"
#include "keel/status.h"

#include <stdint.h>

KEEL_C_BEGIN

/** Words of the PROM: the maker's, six coefficients, and one with the check in its lowest bits. */
#define KEEL_MS5611_WORDS 8

/** The largest reading, of 24 bits. */
#define KEEL_MS5611_READING_MAX 16777215

/** The pressures that the sensor is made for, in Pa: 10 to 1200 mbar. */
#define KEEL_MS5611_PRESSURE_MIN 1000
#define KEEL_MS5611_PRESSURE_MAX 120000

/** The temperatures that it is made for, in hundredths of a degree Celsius. */
#define KEEL_MS5611_TEMPERATURE_MIN (-4000)
#define KEEL_MS5611_TEMPERATURE_MAX 8500

/** A sensor's coefficients, C1 to C6 of its data sheet. */
typedef struct keel_ms5611 {
    uint16_t sensitivity; /**< C1, at the reference temperature; 2^15 in the formula's unit. */
    uint16_t offset;      /**< C2, at the reference temperature; 2^16. */
    uint16_t sensitivity_slope; /**< C3, over temperature; 2^-8. */
    uint16_t offset_slope;      /**< C4, over temperature; 2^-7. */
    uint16_t reference;         /**< C5, what D2 is at 20 degrees; 2^8. */
    uint16_t temperature_slope; /**< C6, hundredths of a degree a step of D2; 2^-23. */
} keel_ms5611_t;

/** The measurements. */
typedef struct keel_ms5611_sample {
    int32_t pressure_pa;      /**< In Pa; KEEL_MS5611_PRESSURE_MIN to _MAX. */
    int32_t temperature_cdeg; /**< In hundredths of a degree Celsius; the limits alike. */
} keel_ms5611_sample_t;

/**
 * The check of a PROM (requirement MSC-001): CRC-4, the rest of its first 15 bytes, divided by
 * x^4 + x + 1.
 *
 * @param word the words of the PROM
 * @return what the lowest four bits of the last word should be
 */
uint8_t keel_ms5611_crc(const uint16_t *word);

/**
 * Takes the coefficients of a sensor (requirements MSC-002 and MSC-003).
 *
 * @param ms5611 the sensor's coefficients
 * @param word   the words of its PROM
 * @return KEEL_OK; KEEL_ERR_VALUE when all words are 0, as nothing answers then (and its check
 *         would be right); KEEL_ERR_INPUT when the check is wrong; nothing is changed then
 */
keel_status_t keel_ms5611_init(keel_ms5611_t *ms5611, const uint16_t *word);

/**
 * The values of two readings (requirements MSC-004 to MSC-008), whatever the coefficients are.
 *
 * @param ms5611 the sensor's coefficients
 * @param d1     the raw pressure
 * @param d2     the raw temperature, read shortly before or after
 * @param sample what they amount to
 * @return KEEL_OK; KEEL_ERR_INPUT when a reading is above KEEL_MS5611_READING_MAX; KEEL_ERR_STATE
 *         when one is 0, which the sensor says when a conversion has not ended; KEEL_ERR_VALUE when
 *         the temperature, and KEEL_ERR_LIMITS when the pressure is not within what it is made for;
 *         the first that applies: then nothing is changed
 */
keel_status_t keel_ms5611_compensate(const keel_ms5611_t *ms5611, uint32_t d1, uint32_t d2,
                                     keel_ms5611_sample_t *sample);

KEEL_C_END

#endif
