/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file console.h
 * @brief What can be asked of the copter in words, and its answers, a line at a time.
 *
 *     help    the commands
 *     tasks   how each task has run since the start (bsp/common/task_table.h)
 *
 * Asking changes nothing. A ground station (shell.h) and the terminal of a simulation hand over the
 * lines that are typed there.
 */
#ifndef COPTER_CONSOLE_H
#define COPTER_CONSOLE_H

#include "common/task_table.h"

#include <stdint.h>

/** So much of what is typed is looked at. */
#define COPTER_CONSOLE_TYPED 32u

/** Room for a line of an answer, which has its end of line, and a zero behind that. */
#define COPTER_CONSOLE_LINE KEEL_TASK_TABLE_LINE

struct copter;

/** An answer that is being given. */
typedef struct copter_said {
    char typed[COPTER_CONSOLE_TYPED]; /**< The command, and a zero. */
    uint32_t lines;                   /**< That were made. */
} copter_said_t;

/**
 * Begins an answer. Spaces before and behind a command do not matter.
 *
 * @param answer the answer
 * @param typed  the command
 * @param length its characters
 */
void copter_console_ask(copter_said_t *answer, const char *typed, uint32_t length);

/**
 * Makes the next line.
 *
 * @param copter the copter
 * @param answer the answer
 * @param line   written
 * @return its characters, without the zero behind them; 0: the answer has ended
 */
uint32_t copter_console_line(const struct copter *copter, copter_said_t *answer,
                             char line[COPTER_CONSOLE_LINE]);

#endif
