/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file spi_bus.h
 * @brief SPI master in mode 3, one byte after the other, with a bound on every wait.
 */
#ifndef KEEL_BSP_STM32F767_SPI_BUS_H
#define KEEL_BSP_STM32F767_SPI_BUS_H

#include "common/bsp_status.h"
#include "common/bus.h"
#include "common/wait.h"
#include "stm32f767/pin.h"
#include "stm32f767/registers/spi.h"

#include <stdint.h>

/** A device on an SPI: the context of keel_spi_bus_exchange. */
typedef struct keel_spi_device {
    keel_spi_t *spi;         /**< The bus. */
    keel_pin_t select;       /**< The device's chip select, active low. */
    const keel_wait_t *wait; /**< The bound of each wait, a byte's time at least. */
} keel_spi_device_t;

/**
 * The code of the divisor 2, 4 … 256 that gives the highest rate within a limit (SPI-001).
 *
 * @param clock_hz the bus's clock
 * @param limit_hz the highest rate that the device takes
 * @param code     the content of BR
 * @return KEEL_BSP_OK, or KEEL_BSP_ARGUMENT when even a 256th is too fast, with code as it was
 */
keel_bsp_status_t keel_spi_divisor(uint32_t clock_hz, uint32_t limit_hz, uint32_t *code);

/**
 * Starts an SPI as master: mode 3, 8 bits, most significant bit first (requirement SPI-002).
 *
 * @param spi      the bus, with its clock on
 * @param clock_hz its clock
 * @param limit_hz the highest rate
 * @return KEEL_BSP_OK, or KEEL_BSP_ARGUMENT as keel_spi_divisor, with the bus as it was
 */
keel_bsp_status_t keel_spi_start(keel_spi_t *spi, uint32_t clock_hz, uint32_t limit_hz);

/**
 * Exchanges bytes with a device; it is deselected again however it went, and the bus is made ready
 * for the next exchange (SPI-003 to SPI-006).
 * As keel_bus_t's exchange; context is a keel_spi_device_t.
 */
keel_bsp_status_t keel_spi_bus_exchange(void *context, const uint8_t *out, uint8_t *in,
                                        uint32_t length, uint32_t *done);

#endif
