/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file power.h
 * @brief Brown-out level, backup memory, and why the chip was reset.
 */
#ifndef KEEL_BSP_STM32F767_POWER_H
#define KEEL_BSP_STM32F767_POWER_H

#include "common/bsp_status.h"
#include "common/wait.h"
#include "stm32f767/registers/flash.h"
#include "stm32f767/registers/pwr.h"
#include "stm32f767/registers/rcc.h"

#include <stdbool.h>
#include <stdint.h>

/** BOR_LEV: below which supply the chip stays in reset (data sheet, table of power resets). */
typedef enum keel_brownout {
    KEEL_BROWNOUT_2V7 = 0, /**< Level 3: the flash needs 2.7 V for seven wait states. */
    KEEL_BROWNOUT_2V4 = 1, /**< Level 2. */
    KEEL_BROWNOUT_2V1 = 2, /**< Level 1. */
    KEEL_BROWNOUT_OFF = 3  /**< As delivered. */
} keel_brownout_t;

/**
 * The brown-out level that is set (requirement PWR-001).
 *
 * @param flash the flash interface
 */
keel_brownout_t keel_brownout_level(const keel_flash_t *flash);

/**
 * Sets the brown-out level, if it is another, and keeps all other option bytes (PWR-002, PWR-003).
 * It is kept in option bytes, which last some 10 000 changes: a level that is set is not written.
 *
 * @param flash the flash interface
 * @param level the level
 * @param wait  the bound for the option bytes, some 1 s
 * @return KEEL_BSP_OK; KEEL_BSP_TIMEOUT when the flash is not ready; KEEL_BSP_VERIFY when the
 *         level does not read back
 */
keel_bsp_status_t keel_brownout_set(keel_flash_t *flash, keel_brownout_t level,
                                    const keel_wait_t *wait);

/**
 * Makes the backup memory writable; it keeps its content over a reset (requirement PWR-004).
 *
 * @param rcc  the clock control
 * @param pwr  the power control
 * @param wait the bound for the write protection to open
 * @return KEEL_BSP_OK, or KEEL_BSP_TIMEOUT
 */
keel_bsp_status_t keel_backup_open(keel_rcc_t *rcc, keel_pwr_t *pwr, const keel_wait_t *wait);

/** Why the chip starts. */
typedef enum keel_restart {
    KEEL_RESTART_POWER = 0, /**< The supply came. */
    KEEL_RESTART_ASKED,     /**< Software asked for it: the image, or a boot loader. */
    KEEL_RESTART_PIN,       /**< The reset pin, by a button or a probe. */
    KEEL_RESTART_UNTOLD,    /**< The flags tell of none: somebody has cleared them. */
    KEEL_RESTART_BROWNOUT,  /**< The supply fell below the brown-out level, but not away. */
    KEEL_RESTART_WATCHDOG,  /**< A watchdog was not fed. */
    KEEL_RESTART_CLOCK,     /**< The external clock was lost; told by a record alone. */
    KEEL_RESTART_FAULT      /**< A fault; told by a record alone. */
} keel_restart_t;

/**
 * Why the chip was reset, as its flags tell (requirement PWR-005). They stay until they are
 * cleared, so there may be those of several resets: a watchdog's counts first, then a supply that
 * came, one that fell, and what asked for it. Every reset pulls the reset pin, whose flag counts
 * last.
 *
 * @param csr the content of RCC_CSR
 * @return neither KEEL_RESTART_CLOCK nor KEEL_RESTART_FAULT
 */
keel_restart_t keel_restart_of(uint32_t csr);

#endif
