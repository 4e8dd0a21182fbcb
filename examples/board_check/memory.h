/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file memory.h
 * @brief What the board keeps parameters in: is it there, and does it keep what is written?
 */
#ifndef BOARD_CHECK_MEMORY_H
#define BOARD_CHECK_MEMORY_H

/**
 * Prints a line: what starting the memory and loading from it gave, and how many starts it has
 * counted. This one is counted, too, where that does not wear the memory out: flash is read alone.
 * Before the tasks run.
 */
void print_memory(void);

#endif
