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
 * link of telemetry, at the board's own rate and without a key; no log, and no console's answer.
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

/** Why the board cannot go on, or what an option is that it does not have; empty: nothing. */
const char *board_problem(void);

/** A number of up to 4 bytes in the image's memory; 0 where no memory is. */
uint32_t board_number(uint32_t address, uint32_t size);

/** What it said on its console; there until the next call. */
const char *board_text(void);

#endif
