/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file sdmmc.h
 * @brief The host interface for SD cards: commands and blocks, by the processor, with a bound on
 *        every wait.
 *
 * The processor moves the data itself, eight words at a time: its FIFO holds 16 us of them at
 * 16 MHz, and nothing preempts a task of Keel. So there is no cache to keep coherent, and no
 * flow control by the hardware, which the chip's errata sheet advises against.
 */
#ifndef KEEL_BSP_STM32F767_SDMMC_H
#define KEEL_BSP_STM32F767_SDMMC_H

#include "common/bsp_status.h"
#include "common/wait.h"
#include "devices/sd_card.h"
#include "stm32f767/registers/sdmmc.h"

#include <stdint.h>

/** A host interface: the context of keel_sdmmc_host's functions. Written by keel_sdmmc_start. */
typedef struct keel_sdmmc_host {
    keel_sdmmc_t *sdmmc;
    const keel_wait_t *prompt;  /**< For what comes without the card's leave. */
    const keel_wait_t *patient; /**< For what a card may take its time for. */
    uint32_t identify_divisor;  /**< Content of CLKDIV until the card is known, */
    uint32_t transfer_divisor;  /**< and behind that. */
    uint32_t data_timeout;      /**< Clocks of the bus for which a card may hold data back. */
} keel_sdmmc_host_t;

/**
 * The content of CLKDIV that gives the highest rate within a limit, clock / (CLKDIV + 2) (SDM-001).
 *
 * @param clock_hz the interface's clock
 * @param limit_hz the highest rate, at least 1 Hz
 * @param divisor  the content of CLKDIV
 * @return KEEL_BSP_OK, or KEEL_BSP_ARGUMENT when even the largest is too fast, with divisor as it
 *         was
 */
keel_bsp_status_t keel_sdmmc_divisor(uint32_t clock_hz, uint32_t limit_hz, uint32_t *divisor);

/**
 * Starts the interface, with its clock to the card still off (requirement SDM-002).
 *
 * @param host     the interface, for keel_sdmmc_host's functions
 * @param sdmmc    its registers, with their clock on
 * @param clock_hz the clock that makes the card's, up to 48 MHz
 * @param limit_hz the card's highest rate, up to 25 MHz; 400 kHz until the card is known
 * @param prompt   the bound of a wait for an answer, and while one block is sent: 1 ms. So a card
 *                 that breaks down in flight costs a task no more than that
 * @param patient  the bound of a wait for a block that is read, and between two that are sent: half
 *                 a second
 * @return KEEL_BSP_OK, or KEEL_BSP_ARGUMENT as keel_sdmmc_divisor, with all as it was
 */
keel_bsp_status_t keel_sdmmc_start(keel_sdmmc_host_t *host, keel_sdmmc_t *sdmmc, uint32_t clock_hz,
                                   uint32_t limit_hz, const keel_wait_t *prompt,
                                   const keel_wait_t *patient);

/**
 * The interface as a card's host, by sd_card.h (requirements SDM-003 to SDM-009).
 *
 * @param host the interface, started; stays in use
 */
keel_sd_host_t keel_sdmmc_host(keel_sdmmc_host_t *host);

#endif
