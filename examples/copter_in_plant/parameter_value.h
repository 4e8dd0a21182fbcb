/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file parameter_value.h
 * @brief Numbers as parameters have them, for whoever implements sim.h.
 */
#ifndef COPTER_PARAMETER_VALUE_H
#define COPTER_PARAMETER_VALUE_H

#include "parameters.h"

#include <stdbool.h>
#include <stdint.h>

/**
 * A number as a parameter of a type has it.
 *
 * @param type   the parameter's
 * @param number any
 * @param value  the number; not to be used when the type cannot have it
 * @return whether the type has this number
 */
static inline bool sim_parameter_value(keel_parameter_type_t type, double number,
                                       keel_parameter_value_t *value)
{
    *value = (keel_parameter_value_t){.type = type};
    if (type == KEEL_PARAMETER_FLOAT) {
        value->real = (float)number;
        return true;
    }
    if (!((double)INT32_MIN <= number) || !(number <= (double)INT32_MAX)) {
        return false;
    }
    value->whole = (int32_t)number;
    return (double)value->whole == number;
}

#endif
