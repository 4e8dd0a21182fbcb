/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file bsp_status.h
 * @brief The result of what a board's drivers do.
 */
#ifndef KEEL_BSP_COMMON_BSP_STATUS_H
#define KEEL_BSP_COMMON_BSP_STATUS_H

/** Why a driver refused or failed, or KEEL_BSP_OK. */
typedef enum keel_bsp_status {
    KEEL_BSP_OK = 0,   /**< Done. */
    KEEL_BSP_ARGUMENT, /**< A value is out of its range; the hardware is as it was. */
    KEEL_BSP_TIMEOUT,  /**< The hardware did not answer within the bound. */
    KEEL_BSP_BUS,      /**< The bus reported an error. */
    KEEL_BSP_SHORT,    /**< Fewer bytes came than were asked for. */
    KEEL_BSP_STUCK,    /**< The data line, or what is measured, does not move. */
    KEEL_BSP_ID,       /**< Another device answers. */
    KEEL_BSP_VERIFY,   /**< What was written does not read back, or a checksum is wrong. */
    KEEL_BSP_RANGE,    /**< What was measured lies outside of what the device is made for. */
    KEEL_BSP_WAIT      /**< Nothing is wrong, and nothing is there yet. */
} keel_bsp_status_t;

#endif
