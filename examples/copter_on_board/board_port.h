/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file board_port.h
 * @brief What the copter needs of a board, as far as the board has it and a driver is there.
 *
 * A device that is missing gives no sample, as one that is broken does: the copter names the check
 * that fails, and does not arm. docs/boards.md has which parts are there.
 */
#ifndef COPTER_BOARD_PORT_H
#define COPTER_BOARD_PORT_H

#include "board_lines.h"
#include "board_panel.h"
#include "devices/ist8310.h"
#include "devices/ms5611.h"
#include "fatfs/black_box.h"
#include "keel/middleware/power_module.h"
#include "port.h"
#include "stm32f767/target/chip.h"

#include <stdint.h>

/** A power module that is being measured: its task has time for one conversion a run. */
typedef struct board_module {
    uint16_t voltage; /**< Counts of the ADC. */
    uint16_t current;
    bool is_new; /**< Both are newer than what was handed over last. */
} board_module_t;

/** An inertial unit. */
typedef struct board_imu {
    keel_bsp_status_t status; /**< How it started. */
    uint32_t samples;         /**< That it gave. */
    uint32_t failures;        /**< Readings of it that failed. */
} board_imu_t;

/** The devices of a board. */
typedef struct board_port {
    board_imu_t imu[COPTER_IMUS];
    keel_bsp_status_t adc;    /**< How the converter did. */
    keel_bsp_status_t memory; /**< How the memory of parameters did. */
    keel_card_result_t card;  /**< How opening the log did. */
    bool has_barometer;       /**< The board has one; whether it answers, its state tells. */
    bool has_slot;            /**< For a card. */
    bool keeps;               /**< Parameters are kept in the memory. */
    bool turning;             /**< The outputs are armed. */
    bool has_magnetometer;    /**< As has_barometer. */
    uint32_t pressures;       /**< Samples of the barometer. */
    uint32_t stepped_us;      /**< When it was stepped last. */
    uint32_t fields;          /**< Samples of the magnetometer. */
    uint32_t looked_us;       /**< When it was stepped last. */
    uint32_t stack_free_b;    /**< Bytes of the stack that were never used, as it was found last. */
    const uint32_t *stack_looked; /**< Up to where the stack is known to be unused now. */
    uint32_t measured;            /**< Conversions of the power modules. */
    uint32_t supply_mv;           /**< The chip's supply; 0: not known yet. */
    bool wants_temperature;       /**< The chip's temperature is measured next. */
    keel_ms5611_device_t barometer;
    keel_ist8310_t magnetometer;
    keel_mounting_t mounting; /**< Of the magnetometer. */
    board_lines_t lines;
    board_panel_t panel;
    keel_power_module_t scale; /**< Of both power modules. */
    board_module_t module[COPTER_POWER_MODULES];
    keel_medium_t medium;
    keel_disk_t disk;
    keel_black_box_t box;
    uint8_t uid[COPTER_UID_BYTES];
    const char *restart; /**< As the port tells it. */
    copter_notice_t notice[COPTER_NOTICES];
    uint32_t notices; /**< So many of them. */
} board_port_t;

/**
 * Starts all devices of the board that have a driver, and says on the console which are there.
 * Takes up to seconds where a card is large: for the time before the watchdog runs.
 *
 * @param board the devices
 * @return the port for copter_start
 */
copter_port_t board_port_start(board_port_t *board);

#endif
