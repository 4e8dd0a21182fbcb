/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file i2c_bus.h
 * @brief I2C master in fast mode, the only one on its bus, with a bound on every exchange.
 *
 * A device that was cut off within a byte may hold SDA low for ever. Nine clocks bring it to the
 * end of any byte, and a stop condition ends it (UM10204, 3.1.16). That takes as long as a few
 * bytes, so an exchange that finds the bus held does it in place of its own bytes, and fails: the
 * next one finds a free bus.
 *
 * How long an exchange takes: reading sends an address twice and so moves two bytes more than its
 * length, writing moves one more. A byte has 9 bits, and the conditions around it take 3. A bit
 * takes 2.5 us to 3.6 us, as quick as the lines rise and fall. Eight bytes are read in 93 bits, 233
 * to 335 us. A failure is told after all looks of the bound at the latest, and then costs a
 * microsecond. A bus that is held takes 22 pauses, and no looks.
 */
#ifndef KEEL_BSP_STM32F767_I2C_BUS_H
#define KEEL_BSP_STM32F767_I2C_BUS_H

#include "common/bsp_status.h"
#include "common/bus.h"
#include "common/wait.h"
#include "stm32f767/pin.h"
#include "stm32f767/registers/i2c.h"

#include <stdint.h>

/** The most bytes of an exchange. */
#define KEEL_I2C_BYTES 255u

/** How often a bus that is held makes keel_i2c_bus_free pause, at most. */
#define KEEL_I2C_PAUSES 22u

/** A device on an I2C: the context of keel_i2c_bus_exchange. */
typedef struct keel_i2c_device {
    keel_i2c_t *i2c;              /**< The bus. */
    uint8_t address;              /**< The device's address, of 7 bits. */
    keel_pin_t scl;               /**< The clock's pin, with a resistor that holds it high. */
    keel_pin_t sda;               /**< The data's pin, likewise. */
    uint32_t function;            /**< The alternate function of both. */
    const keel_wait_t *wait;      /**< The bound of all looks of an exchange together. */
    void (*pause)(void *context); /**< Lets half a clock pass, 1.3 us at least. */
    void *pause_context;          /**< Handed to pause; may be null. */
} keel_i2c_device_t;

/**
 * The timing of fast mode: at most 400 kHz, at least 1.3 us low and 0.6 us high, for lines that
 * rise and fall in 300 ns at most, with the analogue filter (requirement IIC-001).
 *
 * By RM0410, 33.4.5 and 33.4.9, with the times of UM10204, table 10. T is a clock; a tick is
 * (PRESC + 1) * T; the filter delays by 50 ns to 260 ns:
 *
 *     (SCLL + 1) ticks >= 1300 ns; (SCLH + 1) ticks >= 600 ns
 *     (SCLL + 1 + SCLH + 1) ticks + 4 T + 2 * 50 ns >= 2500 ns
 *     300 ns - 50 ns - 3 T <= SDADEL ticks <= 900 ns - 300 ns - 260 ns - 4 T
 *     (SCLDEL + 1) ticks >= 300 ns + 100 ns
 *
 * SCLH, SDADEL and SCLDEL are the least that hold, and then SCLL, of the least PRESC with which all
 * fit.
 *
 * @param clock_hz the bus's clock
 * @param timing   the content of TIMINGR
 * @return KEEL_BSP_OK, or KEEL_BSP_ARGUMENT when none fits, with timing as it was
 */
keel_bsp_status_t keel_i2c_timing(uint32_t clock_hz, uint32_t *timing);

/**
 * Starts an I2C as master in fast mode, with the analogue filter (requirement IIC-002).
 *
 * @param i2c      the bus, with its clock on and its pins given to it
 * @param clock_hz its clock
 * @return KEEL_BSP_OK, or KEEL_BSP_ARGUMENT as keel_i2c_timing, with the bus as it was
 */
keel_bsp_status_t keel_i2c_start(keel_i2c_t *i2c, uint32_t clock_hz);

/**
 * Writes all bytes to a device, or writes the first and reads the others, each into its place; the
 * first place is left as it was (IIC-003 to IIC-008).
 * As keel_bus_t's exchange; context is a keel_i2c_device_t.
 *
 * @return KEEL_BSP_OK; KEEL_BSP_TIMEOUT when all looks are used up; KEEL_BSP_BUS when the device
 *         does not acknowledge its address or a byte, on an error of the bus, a lost arbitration or
 *         an overrun, and when the bus was held: then it was freed, and no byte was exchanged;
 *         KEEL_BSP_ARGUMENT when the length is not 1 to KEEL_I2C_BYTES, with the bus as it was
 */
keel_bsp_status_t keel_i2c_bus_exchange(void *context, const uint8_t *out, uint8_t *in,
                                        uint32_t length, uint32_t *done);

/**
 * Frees a bus whose data line is held: as many clocks as it takes, nine at most, and a stop
 * condition; the pins are the bus's again however it went (requirement IIC-009).
 *
 * @param device any device on the bus
 * @return KEEL_BSP_OK, or KEEL_BSP_STUCK when a line is still low
 */
keel_bsp_status_t keel_i2c_bus_free(const keel_i2c_device_t *device);

#endif
