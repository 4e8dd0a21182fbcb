/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file board_in_plant.h
 * @brief The image of an FMUv5 on a model of the board, as a shared library for a plant.
 *
 * Its functions are those of sim.h, in place of the copter that is compiled for the host. Here is
 * the rest of what an image needs: where it lies, and where its copter has what sim_view() and
 * sim_tasks() show.
 *
 * Of the options of a flight the image decides itself: units, the votes' way, costs. There is one
 * link of telemetry, at the board's own rate and without a key, and no console's answer. Its log is
 * on the card that is in its slot, if there is one.
 */
#ifndef BOARD_IN_PLANT_H
#define BOARD_IN_PLANT_H

#include "sim.h"

#include <stdint.h>

/** A number in the image's memory, and where sim_view_t has it. */
typedef struct board_place {
    uint32_t address;
    uint32_t size; /**< Its bytes, up to 4. */
    uint32_t view; /**< The offset in sim_view_t of a word. */
} board_place_t;

/** Where the image has what became of its tasks. */
typedef struct board_queue {
    uint32_t declarations;      /**< Of tasks, in the order of table 2, … */
    uint32_t declaration_bytes; /**< … and of each the bytes. */
    uint32_t slots;             /**< Of the scheduler's queue: how many, … */
    uint32_t tasks;             /**< … their tasks' declarations, … */
    uint32_t skipped;           /**< … the periods without a run, … */
    uint32_t stats;             /**< … and how runs went, … */
    uint32_t stats_bytes;       /**< … of each the bytes, … */
    uint32_t runs;              /**< … and in these the counts. */
    uint32_t overruns;
    uint32_t longest;
} board_queue_t;

/** An image. */
typedef struct board_image {
    const char *path; /**< Of its bytes. */
    uint32_t address; /**< Where they lie. */
    uint32_t end_run; /**< The function that the copter calls at the end of a task's run. */
    const board_place_t *places;
    uint32_t place_count;
    board_queue_t queue;
} board_image_t;

/** The image of all flights from now on.
 * @return 0; 1: its path is too long, or there are too many numbers */
int board_load(const board_image_t *image);

/** How the pilot's receiver sends its bytes of 8 bits; SBUS, unless it is told. */
void board_pilot_sends(uint32_t baud, uint32_t even_parity, uint32_t two_stops, uint32_t inverted);

/** Puts a card into the slot, with the content of these bytes, which the board reads and writes
 * from now on; null takes it out.
 * @return 0; 1: the size is no multiple of 512 KiB, up to 2 GiB */
int board_insert(uint8_t *bytes, uint32_t size);

/** Why the board cannot go on, or what an option is that it does not have; empty: nothing. */
const char *board_problem(void);

/** A number of up to 4 bytes in the image's memory; 0 where no memory is. */
uint32_t board_number(uint32_t address, uint32_t size);

/** @name Devices that a board may lack, a bit each. */
/** @{ */
#define BOARD_HAS_NO_IMU_1        1
#define BOARD_HAS_NO_IMU_2        2
#define BOARD_HAS_NO_BAROMETER    4
#define BOARD_HAS_NO_MAGNETOMETER 8
#define BOARD_HAS_NO_MEMORY       16
/** @} */

/** What is not on the board, from the next power-up on; 0: all is there. Nobody answers in its
 * place: the line of an SPI is as its pin is pulled, or noise, and an address on the I2C is
 * refused. */
void board_lack(uint32_t devices);

/** What can break at the board. */
typedef enum board_fault {
    BOARD_IMU_UNPLUGGED,    /**< The inertial unit `which`, from 1 on: nobody drives its line. */
    BOARD_SPI_LOW,          /**< What SPI `which`, 1, 2 or 4, reads is low. */
    BOARD_I2C_LOW,          /**< SDA is held low: for `amount` clocks, or, with 0, until it ends. */
    BOARD_GPS_SILENT,       /**< The satellite receiver sends nothing. */
    BOARD_RADIO_UNPLUGGED,  /**< Nobody drives the line of the pilot's receiver. */
    BOARD_RADIO_LINE_NOISE, /**< Of `amount` in 1000 of its bytes something goes wrong. */
    BOARD_CARD_BUSY,        /**< The card is busy with its last write, or the next one. */
    BOARD_CARD_GONE,        /**< The card is pulled out. */
    BOARD_OSCILLATOR_LOST,  /**< The crystal stands still. */
    BOARD_TASK_HANGS,       /**< The next run of task `which`, from 0 on, does not end. */
    BOARD_CORE_STOPS,       /**< No instruction is executed any more, until a reset. */
    BOARD_BROWN_OUT         /**< The supply goes and comes back: at once, or, with an `amount`, when
                                so many bytes more were written to the memory of parameters. */
} board_fault_t;

/** Something breaks or, with `on` 0, is mended; the last four are not.
 *
 * From the first fault on the board behaves as hardware does: exceptions are the image's, and a
 * watchdog that starves resets the chip. Before both end the flight, as what must not be.
 *
 * @return 0; 1: there is no such fault, unit, bus or card */
int board_break(uint32_t fault, uint32_t which, uint32_t amount, uint32_t on);

/** A change of an output's pin, or what happens to the chip. */
typedef struct board_edge {
    uint64_t at; /**< Since power-up, in BOARD_TICKS of a microsecond. */
    uint32_t line;
    uint32_t level;
} board_edge_t;

#define BOARD_TICKS   432
#define BOARD_OUTPUTS 8
#define BOARD_ARMED   8
#define BOARD_EVENT   9
#define BOARD_RESET   256

/** All changes since power-up, in the order of their times: of the lines 0 to 7, FMU_CH1 to 8, and
 * BOARD_ARMED, nARMED, each to 0, floating, 1, low, or 2, high. BOARD_EVENT is no line: its level
 * is the number of an exception that begins, or BOARD_RESET and why the chip is reset: 0 supply, 1
 * software, 2 watchdog. */
const board_edge_t *board_edges(uint32_t *count);

/** What it said on its console; there until the next call. */
const char *board_text(void);

#endif
