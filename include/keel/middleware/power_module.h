/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file power_module.h
 * @brief An analogue power module: from what an ADC of 12 bits counts to millivolts and
 *        milliamperes.
 *
 * The module divides the battery's voltage and turns its current into a voltage; both go to the
 * ADC, which counts 4096 for its reference. A count c of the voltage is c * reference * divider /
 * 4096, rounded to the nearest millivolt, halves up; one of the current with amperes per volt in
 * the divider's place. For a board of two modules there are two of these.
 *
 * The highest count says that it is at least so much, and is flagged. So is a voltage that an input
 * with nothing on it shows.
 *
 * All is integer arithmetic.
 */
#ifndef KEEL_MIDDLEWARE_POWER_MODULE_H
#define KEEL_MIDDLEWARE_POWER_MODULE_H

#include "keel/c_declarations.h"
#include "keel/status.h"

#include <stdint.h>

KEEL_C_BEGIN

/** The highest count. */
#define KEEL_POWER_MODULE_COUNT_MAX 4095

/** The highest of a configuration: 5 V; a divider of 1000, or as many amperes per volt. */
#define KEEL_POWER_MODULE_REFERENCE_MAX 5000
#define KEEL_POWER_MODULE_SCALE_MAX     1000000000

/** @name The flags of a reading. */
/** @{ */
#define KEEL_POWER_MODULE_OPEN        0x1 /**< Nothing is connected: the voltage is too low. */
#define KEEL_POWER_MODULE_TOP_VOLTAGE 0x2 /**< The voltage is this or more. */
#define KEEL_POWER_MODULE_TOP_CURRENT 0x4 /**< The current is this or more. */
/** @} */

/** The configuration of a module. In brackets: those of Pixhawk 4 and its like. */
typedef struct keel_power_module_config {
    uint32_t reference_mv; /**< The ADC's, in mV; 1 to KEEL_POWER_MODULE_REFERENCE_MAX (3300). */
    uint32_t divider;      /**< Volts of the battery for a volt at the ADC, in millionths; 1 to
                                KEEL_POWER_MODULE_SCALE_MAX (18100000). */
    uint32_t ua_per_v;     /**< Current for a volt at the ADC, in uA; 1 to
                                KEEL_POWER_MODULE_SCALE_MAX (36367515). */
    uint32_t open_mv;      /**< With nothing connected the voltage is not above this (5600). */
} keel_power_module_config_t;

/** A module. Only keel_power_module_init writes it. */
typedef struct keel_power_module {
    uint64_t voltage; /**< reference_mv times divider. */
    uint64_t current; /**< reference_mv times ua_per_v. */
    uint32_t open_mv; /**< As configured. */
} keel_power_module_t;

/** A module's reading. */
typedef struct keel_power_module_reading {
    uint32_t voltage_mv; /**< In mV. */
    uint32_t current_ma; /**< In mA. */
    uint32_t told;       /**< KEEL_POWER_MODULE_OPEN, ...: bits; 0 when there is nothing to tell. */
} keel_power_module_reading_t;

/**
 * Makes a module (requirements PMD-001 and PMD-002).
 *
 * @param module the module
 * @param config what it is made from; copied
 * @return KEEL_OK; KEEL_ERR_LIMITS when reference_mv, divider or ua_per_v is 0 or above its limit:
 *         then nothing is changed
 */
keel_status_t keel_power_module_init(keel_power_module_t *module,
                                     const keel_power_module_config_t *config);

/**
 * Reads a module (requirements PMD-003 to PMD-005).
 *
 * @param module  the module, initialised
 * @param voltage what the ADC counts for the voltage; above KEEL_POWER_MODULE_COUNT_MAX it is that
 * @param current what it counts for the current, likewise
 * @param reading where it is written
 */
void keel_power_module_read(const keel_power_module_t *module, uint16_t voltage, uint16_t current,
                            keel_power_module_reading_t *reading);

KEEL_C_END

#endif
