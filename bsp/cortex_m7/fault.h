/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file fault.h
 * @brief What a fault leaves behind: a record in memory that a reset keeps.
 *
 * Every fault, unexpected exception and failed assertion ends the same way: outputs off, a record
 * of the registers, the fault's status and the running task, then a reset. The start-up code finds
 * the record and enters the safe state instead of the application, unless that has said before that
 * it starts safely itself.
 */
#ifndef KEEL_BSP_CORTEX_M7_FAULT_H
#define KEEL_BSP_CORTEX_M7_FAULT_H

#include "keel/rtos/scheduler.h"

#include <stdbool.h>
#include <stdint.h>

#define KEEL_FAULT_NAME_SIZE 28u
#define KEEL_FAULT_REGISTERS 8u

/** A fault as it was found. */
typedef struct keel_fault_record {
    uint32_t magic;   /**< Tells a record from what memory holds after power-on. */
    uint32_t count;   /**< Faults since power-on. */
    uint32_t fresh;   /**< 1 until the safe state has been entered for it. */
    uint32_t number;  /**< The exception's number: 3 hard fault, 4 memory, 5 bus, 6 usage. */
    uint32_t code;    /**< What keel_fault_stop was given, else 0. */
    uint32_t stacked; /**< 1 if the eight stacked registers below could be read. */
    uint32_t r0, r1, r2, r3, r12, lr, pc, xpsr; /**< As the core stacked them. */
    uint32_t r4_to_r11[KEEL_FAULT_REGISTERS];   /**< As the handler found them. */
    uint32_t sp;                                /**< The stack pointer at the fault. */
    uint32_t exc_return;                        /**< Which stack and frame were in use. */
    uint32_t cfsr, hfsr, mmfar, bfar;           /**< The core's fault status and addresses. */
    char task[KEEL_FAULT_NAME_SIZE];            /**< The running task's name; empty: none. */
    uint32_t check;                             /**< Over all words before: no half a record. */
} keel_fault_record_t;

/** Names the scheduler whose running task a record shall name; null for none. */
void keel_fault_watch(const keel_scheduler_t *scheduler);

/**
 * Stops as a fault does. For what must not happen: a failed assertion, a step that fails.
 *
 * @param code what to record, not 0
 */
void keel_fault_stop(uint32_t code) __attribute__((noreturn));

/** Whether memory holds a whole record. */
bool keel_fault_is_whole(const keel_fault_record_t *record);

/** Completes a record: its magic number and its check. */
void keel_fault_seal(keel_fault_record_t *record);

/**
 * The last fault.
 *
 * @return the record; null when there was none since power-on
 */
const keel_fault_record_t *keel_fault_last(void);

/**
 * Whether the safe state has to be entered; true once for each fault.
 *
 * So a pilot's next reset starts the application again; the record stays until power goes.
 */
bool keel_fault_take(void);

/**
 * Says whether the application is to be started again behind the next fault: for one that begins
 * with its outputs off, and keeps them off until somebody asks for more. It holds for one reset,
 * whatever that comes from, so that what faults at its start ends in the safe state.
 *
 * @param allowed whether it is
 */
void keel_fault_allow_restart(bool allowed);

/** Whether it was allowed before this reset; asking ends it. For the start-up code. */
bool keel_fault_take_restart(void);

/** Writes the last fault to the console. */
void keel_fault_print(void);

/** The handler of every exception that is not expected. */
void keel_fault_handler(void);

#endif
