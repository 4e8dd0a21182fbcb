/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file parameters.h
 * @brief Parameters: numbers with names, ranges and defaults, which are set, stored and loaded.
 *
 * A table in flash says what there is. A new value is checked twice: against the parameter's range,
 * and by whoever uses the values, who is shown all of them as they would be. Only then is it taken;
 * a refusal changes nothing.
 *
 * This unit knows nothing of the copter. It stands here as it is tested, not proved.
 *
 * Stored is each value that is not its default, with the parameter's name: so a set of another
 * firmware, older or newer, can be loaded. A name that this firmware does not know is counted.
 * A value that it does not take stays at its default, and the parameter tells why.
 */
#ifndef COPTER_PARAMETERS_H
#define COPTER_PARAMETERS_H

#include "keel/c_declarations.h"
#include "keel/status.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

/** The longest name, as MAVLink's. */
#define KEEL_PARAMETER_NAME_LENGTH 16

/** Bytes of a stored value: its name, padded with zeros, its type, and its bits, lowest first. */
#define KEEL_PARAMETER_RECORD_BYTES 21

/** The type of a parameter. These numbers are stored. */
typedef enum keel_parameter_type {
    KEEL_PARAMETER_FLOAT = 0,
    KEEL_PARAMETER_INT32 = 1,
    KEEL_PARAMETER_BOOL = 2
} keel_parameter_type_t;

/** A value and its type, which says which of the numbers counts; the other is 0. */
typedef struct keel_parameter_value {
    keel_parameter_type_t type;
    float real;    /**< That of a float. */
    int32_t whole; /**< That of an int32; of a bool, 0 or 1. */
} keel_parameter_value_t;

/** A row of the table. */
typedef struct keel_parameter {
    char name[KEEL_PARAMETER_NAME_LENGTH + 1]; /**< Ends with a zero. */
    keel_parameter_value_t initial;            /**< The default; lowest to highest. */
    keel_parameter_value_t lowest;             /**< Of the same type. */
    keel_parameter_value_t highest;            /**< Of the same type. */
    bool restarts; /**< What is set is used from the next start on; this unit does not ask. */
} keel_parameter_t;

/** The state of a parameter. */
typedef struct keel_parameter_entry {
    keel_parameter_value_t value;
    keel_status_t refused; /**< Why its value in the set that was loaded was not taken; OK when it
                                was, or another has been set since. */
} keel_parameter_entry_t;

/**
 * Says whether all these values can be used together, and if not, why.
 *
 * @param context what the parameters were made with
 * @param entry   each parameter's value, in the table's order
 * @return KEEL_OK, or the reason
 */
typedef keel_status_t (*keel_parameters_check_fn_t)(void *context,
                                                    const keel_parameter_entry_t *entry);

/** A configuration of parameters. All of it is read as long as they are used. */
typedef struct keel_parameters_config {
    const keel_parameter_t *table;
    keel_parameter_entry_t *entry; /**< As many; written by the functions below alone. */
    uint16_t count;                /**< Rows of the table, at least 1. */
    keel_parameters_check_fn_t check;
    void *context; /**< Handed to check. */
} keel_parameters_config_t;

/** All parameters. Written by the functions below alone. */
typedef struct keel_parameters {
    keel_parameters_config_t config;
} keel_parameters_t;

/** The outcome of loading a stored set. */
typedef struct keel_parameters_loaded {
    uint32_t taken;   /**< Values. */
    uint32_t refused; /**< Values of known parameters; entry[].refused says why. */
    uint32_t unknown; /**< Names that are in no row. */
} keel_parameters_loaded_t;

/** The 32 bits of a value: as MAVLink sends it byte by byte, and as it is stored. */
uint32_t keel_parameter_bits(keel_parameter_value_t value);

/** The value that has these bits. */
keel_parameter_value_t keel_parameter_from_bits(keel_parameter_type_t type, uint32_t bits);

/**
 * Makes parameters: each has its default.
 *
 * @return KEEL_OK; KEEL_ERR_NULL for a null pointer in config (but context) or a count of 0;
 *         KEEL_ERR_LIMITS when a row's default is not within its range, its types differ or its
 *         name does not end; what check says of the defaults. Unless KEEL_OK the parameters are as
 *         they were; entries may be written
 */
keel_status_t keel_parameters_init(keel_parameters_t *parameters,
                                   const keel_parameters_config_t *config);

/** How many there are. */
uint16_t keel_parameters_count(const keel_parameters_t *parameters);

/** The name of one, at most KEEL_PARAMETER_NAME_LENGTH characters and a zero; null when there is no
 *  such one. */
const char *keel_parameters_name(const keel_parameters_t *parameters, uint16_t index);

/**
 * The index of the one of this name.
 *
 * @param name ends at its first zero or with KEEL_PARAMETER_NAME_LENGTH characters, as MAVLink's
 * @return the index; keel_parameters_count when there is none
 */
uint16_t keel_parameters_find(const keel_parameters_t *parameters, const char *name);

/**
 * The value of one, and its type.
 *
 * @param index below keel_parameters_count
 */
keel_parameter_value_t keel_parameters_get(const keel_parameters_t *parameters, uint16_t index);

/**
 * Sets one. Nothing that flies changes by that: whoever uses the values says when they are.
 *
 * @return KEEL_OK; KEEL_ERR_INPUT when there is no such parameter; KEEL_ERR_VALUE when the value
 *         is of another type, not finite, or out of the range; or what check says of the whole.
 *         Unless KEEL_OK, nothing is changed
 */
keel_status_t keel_parameters_set(keel_parameters_t *parameters, uint16_t index,
                                  keel_parameter_value_t value);

/** Sets the one of this name: keel_parameters_find and keel_parameters_set. */
keel_status_t keel_parameters_set_by_name(keel_parameters_t *parameters, const char *name,
                                          keel_parameter_value_t value);

/**
 * Writes a set to be stored: a record for each parameter that does not have its default.
 *
 * @param image  of room bytes; count times KEEL_PARAMETER_RECORD_BYTES are enough
 * @param length the bytes that were written
 * @return KEEL_OK; KEEL_ERR_FULL when there is no room
 */
keel_status_t keel_parameters_pack(const keel_parameters_t *parameters, uint8_t *image,
                                   uint32_t room, uint32_t *length);

/**
 * Loads a set that was stored: what it does not name has its default.
 *
 * @return what became of it
 */
keel_parameters_loaded_t keel_parameters_load(keel_parameters_t *parameters, const uint8_t *image,
                                              uint32_t length);

KEEL_C_END

#endif
