/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file adc.h
 * @brief Analogue-to-digital converter: one conversion of 12 bits at a time, with a bound on every
 *        wait; and what its counts mean: supply, pins, and the chip's temperature.
 *
 * A count c is c * supply / 4096 (as keel/middleware/power_module.h counts; RM0410 divides by the
 * highest count, 4095, which is less than one count's difference). The supply is that at VREF+,
 * which the boards join to VDDA.
 */
#ifndef KEEL_BSP_STM32F767_ADC_H
#define KEEL_BSP_STM32F767_ADC_H

#include "common/bsp_status.h"
#include "common/wait.h"
#include "stm32f767/registers/adc.h"
#include "stm32f767/registers/adc_common.h"

#include <stdint.h>

/** The highest count. */
#define KEEL_ADC_COUNT_MAX 4095u

/** Channels of ADC1 within the chip (RM0410, 15.3.3); 0 to 15 are pins. */
#define KEEL_ADC_REFERENCE   17u
#define KEEL_ADC_TEMPERATURE 18u

/** The clock that keel_adc_start takes, in Hz: an eighth of it is the converter's. */
#define KEEL_ADC_CLOCK_MIN_HZ 4800000u   /**< The converter's lowest is 0.6 MHz. */
#define KEEL_ADC_CLOCK_MAX_HZ 115200000u /**< 144 cycles of it are 10 us. */

/** The supply, in mV, for which the chip is made. */
#define KEEL_ADC_SUPPLY_MIN_MV 1700u
#define KEEL_ADC_SUPPLY_MAX_MV 3600u

/** The temperature of the chip, in hundredths of a degree Celsius, for which it is made. */
#define KEEL_ADC_TEMPERATURE_MIN_CDEG (-4000)
#define KEEL_ADC_TEMPERATURE_MAX_CDEG 12500

/** A converter with what it shares, and a clock. */
typedef struct keel_adc_device {
    keel_adc_t *adc;                     /**< The converter, with its clock on. */
    keel_adc_common_t *common;           /**< What the converters share; this one alone uses it. */
    const keel_wait_t *wait;             /**< Its looks last 12 us at least, of the clock, too. */
    uint32_t (*clock_us)(void *context); /**< Reads a counter of microseconds; wraps at 2^32. */
    void *context;                       /**< Handed to clock_us; may be null. */
} keel_adc_device_t;

/** What the maker counted at 3.3 V, as it lies in the chip's memory; 0xFFFF where it did not. */
typedef struct keel_adc_calibration {
    uint16_t reference; /**< The internal reference, at 30 degrees Celsius. */
    uint16_t at_30;     /**< The temperature sensor at 30 degrees Celsius. */
    uint16_t at_110;    /**< And at 110. */
} keel_adc_calibration_t;

/**
 * Starts a converter and the chip's own sensors; takes some 10 us (ADC-001 to ADC-003).
 *
 * @param device   the converter, in whatever state
 * @param clock_hz the bus's clock, KEEL_ADC_CLOCK_MIN_HZ to KEEL_ADC_CLOCK_MAX_HZ
 * @return KEEL_BSP_OK; KEEL_BSP_ARGUMENT, with all as it was; or KEEL_BSP_TIMEOUT when the clock
 *         stands still
 */
keel_bsp_status_t keel_adc_start(const keel_adc_device_t *device, uint32_t clock_hz);

/**
 * Converts a channel once; takes 156 cycles of the converter, 11.6 us at 108 MHz (ADC-004 to
 * ADC-008).
 *
 * @param device  the converter, started
 * @param channel 0 to 15, KEEL_ADC_REFERENCE or KEEL_ADC_TEMPERATURE; 16 is joined to nothing
 * @param count   what it counted, 0 to KEEL_ADC_COUNT_MAX; written when all went well
 * @return KEEL_BSP_OK; KEEL_BSP_ARGUMENT for another channel, with the converter as it was;
 *         KEEL_BSP_TIMEOUT when the conversion does not end, KEEL_BSP_BUS when it overran another:
 *         then the converter is off and on again, as after its start
 */
keel_bsp_status_t keel_adc_read(const keel_adc_device_t *device, uint32_t channel, uint16_t *count);

/**
 * The supply, from the internal reference (RM0410, 15.10, with the data sheet's calibration): 3300
 * mV * calibration / count, rounded to the nearest (requirement ADC-009).
 *
 * @param calibration the chip's
 * @param count       what KEEL_ADC_REFERENCE counts
 * @param supply_mv   in mV, KEEL_ADC_SUPPLY_MIN_MV to KEEL_ADC_SUPPLY_MAX_MV
 * @return KEEL_BSP_OK; KEEL_BSP_ARGUMENT when the calibration is blank or no count; KEEL_BSP_RANGE
 *         when that is no supply for the chip; then supply_mv is as it was
 */
keel_bsp_status_t keel_adc_supply(const keel_adc_calibration_t *calibration, uint16_t count,
                                  uint32_t *supply_mv);

/**
 * The voltage at a pin: count * supply / 4096, rounded to the nearest (requirement ADC-010).
 *
 * @param count     what its channel counts, up to KEEL_ADC_COUNT_MAX
 * @param supply_mv in mV, KEEL_ADC_SUPPLY_MIN_MV to KEEL_ADC_SUPPLY_MAX_MV
 * @param pin_mv    in mV, 0 to 3599
 * @return KEEL_BSP_OK, or KEEL_BSP_ARGUMENT, with pin_mv as it was
 */
keel_bsp_status_t keel_adc_pin(uint16_t count, uint32_t supply_mv, uint32_t *pin_mv);

/**
 * The chip's temperature: on the line through its two calibrations, which hold for 3.3 V (RM0410,
 * 15.10, with the data sheet's calibration), rounded to the nearest (requirement ADC-011). One
 * count is a third of a degree.
 *
 * @param calibration      the chip's
 * @param count            what KEEL_ADC_TEMPERATURE counts, up to KEEL_ADC_COUNT_MAX
 * @param supply_mv        in mV, KEEL_ADC_SUPPLY_MIN_MV to KEEL_ADC_SUPPLY_MAX_MV
 * @param temperature_cdeg in hundredths of a degree Celsius, KEEL_ADC_TEMPERATURE_MIN_CDEG to
 *                         KEEL_ADC_TEMPERATURE_MAX_CDEG
 * @return KEEL_BSP_OK; KEEL_BSP_ARGUMENT when count, supply or calibration cannot be, as one that
 *         is blank, or does not grow; KEEL_BSP_RANGE when the chip is not made for that
 *         temperature; then temperature_cdeg is as it was
 */
keel_bsp_status_t keel_adc_temperature(const keel_adc_calibration_t *calibration, uint16_t count,
                                       uint32_t supply_mv, int32_t *temperature_cdeg);

#endif
