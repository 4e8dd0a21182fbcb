/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file clock_tree.h
 * @brief The clocks: from the board's oscillator to 216 MHz, with over-drive.
 *
 * Limits and formulas are those of RM0410 5.2 and of the data sheet for a supply of 2.7 to 3.6 V.
 */
#ifndef KEEL_BSP_STM32F767_CLOCK_TREE_H
#define KEEL_BSP_STM32F767_CLOCK_TREE_H

#include "common/bsp_status.h"
#include "common/wait.h"
#include "stm32f767/registers/flash.h"
#include "stm32f767/registers/pwr.h"
#include "stm32f767/registers/rcc.h"

#include <stdbool.h>
#include <stdint.h>

#define KEEL_CORE_HZ       216000000u /**< The core's clock. */
#define KEEL_APB1_LIMIT_HZ 54000000u  /**< Highest clock of the first peripheral bus. */
#define KEEL_APB2_LIMIT_HZ 108000000u /**< Highest clock of the second peripheral bus. */

/** Factors of the main PLL: core = source / m * n / p, 48 MHz = source / m * n / q. */
typedef struct keel_pll {
    uint32_t m; /**< 2 to 63; source / m is 2 MHz, which gives the least jitter. */
    uint32_t n; /**< 50 to 432. */
    uint32_t p; /**< 2, 4, 6 or 8. */
    uint32_t q; /**< 2 to 15. */
} keel_pll_t;

/** The oscillator of a board. */
typedef struct keel_oscillator {
    uint32_t hz; /**< Its frequency. */
    bool bypass; /**< A clock comes from outside; otherwise a crystal is at the pins. */
} keel_oscillator_t;

/** The step at which the clocks failed to start. */
typedef enum keel_clock_fault {
    KEEL_CLOCK_OK = 0,
    KEEL_CLOCK_PLAN,             /**< No factors give the core's clock from this oscillator. */
    KEEL_CLOCK_HSI,              /**< The internal oscillator is not ready. */
    KEEL_CLOCK_TO_HSI,           /**< The core does not change to the internal oscillator. */
    KEEL_CLOCK_PLL_STOP,         /**< The PLL does not stop. */
    KEEL_CLOCK_HSE_STOP,         /**< The external oscillator does not stop. */
    KEEL_CLOCK_HSE,              /**< The external oscillator does not start. */
    KEEL_CLOCK_OVERDRIVE,        /**< Over-drive is not ready. */
    KEEL_CLOCK_OVERDRIVE_SWITCH, /**< The regulator does not change to over-drive. */
    KEEL_CLOCK_PLL,              /**< The PLL does not lock. */
    KEEL_CLOCK_LATENCY,          /**< The flash does not take its wait states. */
    KEEL_CLOCK_TO_PLL            /**< The core does not change to the PLL. */
} keel_clock_fault_t;

/** The register blocks that make up the clock tree. */
typedef struct keel_clock_registers {
    keel_rcc_t *rcc;
    keel_pwr_t *pwr;
    keel_flash_t *flash;
} keel_clock_registers_t;

/**
 * Factors of the PLL for a core clock (requirement CLT-001).
 *
 * @param source_hz the oscillator, 4 to 26 MHz and a multiple of 2 MHz
 * @param core_hz   the core's clock, 96 to 216 MHz and a multiple of 24 MHz, so that 48 MHz can be
 *                  had as well
 * @param pll       the factors
 * @return KEEL_BSP_OK, or KEEL_BSP_ARGUMENT, with pll as it was
 */
keel_bsp_status_t keel_pll_plan(uint32_t source_hz, uint32_t core_hz, keel_pll_t *pll);

/**
 * The content of PLLCFGR for factors, with its reserved bits as after reset (requirement CLT-002).
 *
 * @param pll factors as keel_pll_plan gives them
 */
uint32_t keel_pll_word(const keel_pll_t *pll);

/**
 * Wait states of the flash at 2.7 to 3.6 V: one for each 30 MHz begun, less one (CLT-003).
 *
 * @param core_hz the core's clock, 1 to 216 MHz
 */
uint32_t keel_flash_wait_states(uint32_t core_hz);

/**
 * The smallest divisor 1, 2, 4, 8 or 16 of a bus that keeps it within a limit (CLT-004).
 *
 * @param core_hz  the core's clock
 * @param limit_hz the bus's limit, at least a sixteenth of the core's clock
 */
uint32_t keel_bus_divisor(uint32_t core_hz, uint32_t limit_hz);

/**
 * The clock of the timers on a bus: the bus's own if it is not divided, else twice that (CLT-005).
 *
 * @param core_hz the core's clock
 * @param divisor the bus's divisor
 */
uint32_t keel_timer_hz(uint32_t core_hz, uint32_t divisor);

/**
 * Starts the clocks at KEEL_CORE_HZ, whatever ran before (requirements CLT-006 and CLT-007): the
 * external oscillator, the PLL, over-drive, the flash's wait states, prefetch and accelerator, and
 * the clock security system, which raises an NMI should the oscillator fail later.
 *
 * @param registers  the register blocks
 * @param oscillator the board's oscillator
 * @param wait       the bound for each step
 * @return KEEL_CLOCK_OK, or the step that failed; the core then runs on the internal oscillator
 *         or, where that was the step, on what it ran on before
 */
keel_clock_fault_t keel_clock_tree_start(const keel_clock_registers_t *registers,
                                         const keel_oscillator_t *oscillator,
                                         const keel_wait_t *wait);

#endif
