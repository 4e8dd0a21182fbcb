/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file sd_card.h
 * @brief A simulated SD card, command by command, as a card's host: with the states of the
 *        specification, and cards of version 1, of standard and of high capacity.
 */
#ifndef KEEL_BSP_SIMULATED_SD_CARD_H
#define KEEL_BSP_SIMULATED_SD_CARD_H

#include "devices/sd_card.h"

#include <stdbool.h>
#include <stdint.h>

/** A count that is never reached. */
#define SIMULATED_SD_NEVER UINT32_MAX

/** States of a card (table 4-1). */
typedef enum simulated_sd_state {
    SIMULATED_SD_IDLE = 0,
    SIMULATED_SD_READY = 1,
    SIMULATED_SD_IDENTIFY = 2,
    SIMULATED_SD_STANDBY = 3,
    SIMULATED_SD_TRANSFER = 4,
    SIMULATED_SD_SENDING = 5,
    SIMULATED_SD_RECEIVING = 6,
    SIMULATED_SD_PROGRAMMING = 7
} simulated_sd_state_t;

/** A card in its slot. */
typedef struct simulated_sd {
    /* What it is. */
    uint8_t *bytes;      /**< What it holds. */
    uint32_t csd[4];     /**< Its card-specific data, highest word first. */
    uint32_t conditions; /**< Its operation conditions when it is ready, without that bit. */
    uint32_t address;    /**< What it gives itself, 16 bits. */
    uint32_t sectors;    /**< How many there are in bytes. */
    bool is_absent;
    bool is_version_1;     /**< It does not know SEND_IF_COND. */
    bool is_high_capacity; /**< It counts sectors, not bytes. */
    uint32_t pattern;      /**< What it answers SEND_IF_COND with. */

    /* What goes wrong. */
    uint32_t ready_after;       /**< So many questions until it is ready. */
    uint32_t busy_looks;        /**< Behind a write it programs for so many looks at its status. */
    uint32_t fails_programming; /**< The write, from 1, whose programming fails. */
    uint32_t damages_command;   /**< The command, from 1, whose answer comes damaged. */
    uint32_t loses_command;     /**< The one that it does not get. */
    uint32_t fails_block;       /**< The block, from 1 in either direction, that breaks off. */
    keel_bsp_status_t delays;   /**< What delays end with. */

    /* Where it is. */
    simulated_sd_state_t state;
    uint32_t given_address;
    uint32_t errors;       /**< Told with the next status. */
    bool is_application;   /**< The next command is one of an application. */
    bool is_selected_wide; /**< It was told to use four lines. */
    uint32_t block_length;
    uint32_t at;    /**< The next sector of a transfer. */
    bool is_single; /**< Its transfer ends with one block. */
    uint32_t busy_left;

    /* What was met. */
    uint32_t commands;  /**< Commands, */
    uint32_t questions; /**< of these whether it is ready, */
    uint32_t last[64];  /**< the last argument of each, */
    uint32_t count[64]; /**< and how many there were. */
    uint32_t writes;    /**< Commands to write. */
    uint32_t blocks;    /**< Blocks in either direction. */
    uint32_t expected;  /**< Blocks that the host is ready for. */
    uint32_t breaches;  /**< Commands that it may not be given as it is, and data. */
    keel_sd_bus_t bus;
    uint32_t waited_us;
} simulated_sd_t;

/** A card of high capacity that nothing is wrong with; sectors: 1024 or a multiple. */
void simulated_sd_init(simulated_sd_t *card, uint8_t *bytes, uint32_t sectors);

/** Makes it one of standard capacity with so many sectors: 512 times 1 to 4096. */
void simulated_sd_make_standard(simulated_sd_t *card);

/** The card behind a host. */
keel_sd_host_t simulated_sd_host(simulated_sd_t *card);

/** A delay, which is handed the card. */
keel_bsp_status_t simulated_sd_delay(void *context, uint32_t time_us);

#endif
