/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file parameter_store.h
 * @brief The copter's parameters: where its settings come from, and where they are kept.
 */
#ifndef COPTER_PARAMETER_STORE_H
#define COPTER_PARAMETER_STORE_H

#include "common/slots.h"
#include "parameter_table.h"
#include "parameters.h"

#include <stdbool.h>
#include <stdint.h>

/** The most bytes that all parameters take, and where the slots for them begin in a memory. */
#define COPTER_PARAMETER_BYTES 4096u
#define COPTER_PARAMETER_FIRST 0u
#define COPTER_PARAMETER_OTHER 8192u

/** Parameters, and the memory that keeps them. */
typedef struct copter_parameter_store {
    keel_parameters_t table;         /**< To get and set them. */
    keel_parameters_loaded_t loaded; /**< What the start found of a stored set. */
    keel_slots_result_t found;       /**< Whether it found one, or why not. */
    keel_slots_result_t saved;       /**< What became of the last save, or that it goes on. */
    bool has_memory;                 /**< There is one, and slots were made of it. */
    keel_slots_t slots;              /**< In the memory. */
    uint32_t length;                 /**< Of the set that was loaded, or is being saved. */
    keel_parameter_entry_t entry[COPTER_PARAMETER_COUNT];    /**< As they were set. */
    keel_parameter_entry_t in_force[COPTER_PARAMETER_COUNT]; /**< As copter_settings has them. */
    uint8_t image[COPTER_PARAMETER_BYTES];
} copter_parameter_store_t;

/**
 * Sets copter_settings: to its defaults, and to what a memory keeps of parameters.
 *
 * @param store  the parameters
 * @param memory     the memory, or null when there is none
 * @return KEEL_OK, or which default no unit takes; a memory that cannot be read, or holds what
 *         this firmware does not know, is told in parameters, and no reason not to start
 */
keel_status_t copter_parameter_store_start(copter_parameter_store_t *store,
                                           const keel_medium_t *memory);

/** Whether what was set is not what is in force. */
bool copter_parameter_store_differs(const copter_parameter_store_t *store, uint16_t index);

/**
 * Puts in force what was set, but for parameters that wait for a restart: changes copter_settings.
 *
 * @return whether anything was changed
 */
bool copter_parameter_store_apply(copter_parameter_store_t *store);

/**
 * Begins to save all parameters that do not have their defaults.
 *
 * @return KEEL_OK; KEEL_ERR_NULL without a memory; what keel_slots_begin says
 */
keel_status_t copter_parameter_store_save(copter_parameter_store_t *store);

/** Goes on with a save, if one is under way, by a few bytes. */
void copter_parameter_store_step(copter_parameter_store_t *store);

#endif
