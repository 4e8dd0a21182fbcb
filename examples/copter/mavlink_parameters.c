/* SPDX-License-Identifier: Apache-2.0 */
/* Requests of a ground station for parameters: to list, read and set them.
 *
 * On a link each parameter is a float. MAVLink has two ways to write an integer into the message's
 * float, its bits or its number; a client that expects the other way shows a wrong value and sets
 * one. All agree on a float, so a parameter that is an int32 or a bool is told as one, and taken
 * from one when it is a whole number. Of a number of another type nobody can tell which way it was
 * written, so it is refused.
 *
 * Whatever is asked is answered: with the value as it is, and with PARAM_ERROR when it was refused.
 * A refusal is told in words, too, and so is what was set and is not in force yet. */
#include "keel/middleware/range.h"
#include "telemetry.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#define NO_INDEX  (-1)
#define WORD      32u
#define MOST_TOLD 8u

/* The floats between which each is an int32: from -2^31 to the last one below 2^31. */
#define LEAST_WHOLE (-2147483648.0f)
#define MOST_WHOLE  2147483520.0f

static void want_parameter(copter_link_t *link, uint32_t index)
{
    link->wanted[index / WORD] |= (uint32_t)1u << (index % WORD);
}

/* All are told what it is now, also when that is what it was. */
static void want_on_all(copter_telemetry_t *self, uint32_t index)
{
    for (uint32_t i = 0u; i < COPTER_LINKS; i++) {
        want_parameter(&self->link[i], index);
    }
}

static void say_parameter(copter_t *copter, uint32_t severity, uint16_t index, const char *what)
{
    copter_text(copter->telemetry, (uint8_t)severity,
                keel_parameters_name(&copter->parameters.table, index), what);
}

/* The request is refused: the sender is to be told. */
static void refuse_parameter(copter_link_t *link, const keel_mavlink_frame_t *from,
                             const char *name, int16_t index, uint32_t error)
{
    message_param_error_t *const message = &link->error[link->errors];

    if (link->errors == COPTER_LINK_ERRORS) {
        link->dropped++;
        return;
    }
    *message = (message_param_error_t){.target_system = from->system,
                                       .target_component = from->component,
                                       .param_index = index,
                                       .error = (uint8_t)error};
    (void)memcpy(message->param_id, name, sizeof message->param_id);
    link->errors++;
}

/* The value that a message has for a parameter; or, in words, why it has none. */
static const char *value_of(keel_parameter_type_t type, const message_param_set_t *message,
                            keel_parameter_value_t *value)
{
    const float number = message->param_value;

    *value = (keel_parameter_value_t){.type = type};
    if (message->param_type != (uint8_t)MAV_PARAM_TYPE_REAL32) {
        return ": not set, its type is REAL32";
    }
    if (isnan(number)) {
        return ": not set, not a number";
    }
    if (type == KEEL_PARAMETER_FLOAT) {
        value->real = number;
    } else if (!keel_range_contains(number, LEAST_WHOLE, MOST_WHOLE)) {
        return ": not set, out of its range";
    } else {
        value->whole = (int32_t)number;
        if ((float)value->whole != number) {
            return ": not set, not a whole number";
        }
    }
    return NULL;
}

/* Sets a parameter; or says, in words, why not. */
static const char *set_value(keel_parameters_t *table, uint16_t index,
                             const message_param_set_t *message)
{
    keel_parameter_value_t value;
    const char *const reason = value_of(keel_parameters_get(table, index).type, message, &value);
    keel_status_t status;

    if (reason != NULL) {
        return reason;
    }
    status = keel_parameters_set(table, index, value);
    if (status == KEEL_ERR_VALUE) {
        return ": not set, out of its range";
    }
    return (status == KEEL_OK) ? NULL : ": not set, contradicts another";
}

/* The value is set, but another one flies. */
static void tell_wait(copter_t *copter, uint16_t index)
{
    if (!copter_parameter_store_differs(&copter->parameters, index)) {
        return;
    }
    if (copter_parameter[index].restarts) {
        say_parameter(copter, MAV_SEVERITY_WARNING, index, ": in force after a restart");
    } else if (copter->state.mode.state != KEEL_MODE_DISARMED) {
        say_parameter(copter, MAV_SEVERITY_INFO, index, ": in force once disarmed");
    } else {
        /* It is in force before anything else is taken. */
    }
}

void copter_mavlink_tell_parameters(copter_t *copter)
{
    const copter_parameter_store_t *const store = &copter->parameters;
    uint32_t told = 0u;

    for (uint16_t i = 0u; (i < COPTER_PARAMETER_COUNT) && (told < MOST_TOLD); i++) {
        const bool waits = copter_parameter[i].restarts && copter_parameter_store_differs(store, i);
        const bool is_lost = store->entry[i].refused != KEEL_OK;

        if (waits) {
            tell_wait(copter, i);
        } else if (is_lost) {
            say_parameter(copter, MAV_SEVERITY_WARNING, i, ": the stored value is not taken");
        } else {
            /* It is as it was set. */
        }
        told += (waits || is_lost) ? 1u : 0u;
    }
    if (store->loaded.unknown > 0u) {
        copter_text(copter->telemetry, (uint8_t)MAV_SEVERITY_WARNING,
                    "parameters: ", "unknown ones are stored");
    }
}

void copter_mavlink_read_parameter(copter_t *copter, uint32_t link,
                                   const keel_mavlink_frame_t *from,
                                   const message_param_request_read_t *message)
{
    copter_link_t *const to = &copter->telemetry->link[link];
    const uint32_t index = (message->param_index == NO_INDEX)
                               ? keel_parameters_find(&copter->parameters.table, message->param_id)
                               : (uint32_t)message->param_index;

    if (index < COPTER_PARAMETER_COUNT) {
        want_parameter(to, index);
    } else {
        refuse_parameter(to, from, message->param_id, message->param_index,
                         MAV_PARAM_ERROR_DOES_NOT_EXIST);
    }
}

void copter_mavlink_list_parameters(copter_t *copter, uint32_t link)
{
    for (uint32_t i = 0u; i < COPTER_PARAMETER_COUNT; i++) {
        want_parameter(&copter->telemetry->link[link], i);
    }
    copter_mavlink_tell_parameters(copter);
}

void copter_mavlink_parameter_is_set(copter_t *copter, uint16_t index)
{
    copter->telemetry->saves = true;
    copter->telemetry->applies = true;
    want_on_all(copter->telemetry, index);
}

void copter_mavlink_set_parameter(copter_t *copter, uint32_t link, const keel_mavlink_frame_t *from,
                                  const message_param_set_t *message, bool may)
{
    copter_telemetry_t *const self = copter->telemetry;
    copter_link_t *const to = &self->link[link];
    keel_parameters_t *const table = &copter->parameters.table;
    const uint16_t index = keel_parameters_find(table, message->param_id);
    const char *reason;

    if (index >= COPTER_PARAMETER_COUNT) {
        copter_text(self, (uint8_t)MAV_SEVERITY_WARNING, "parameter: ", "there is no such one");
        refuse_parameter(to, from, message->param_id, NO_INDEX, MAV_PARAM_ERROR_DOES_NOT_EXIST);
        return;
    }
    if (!may) {
        refuse_parameter(to, from, message->param_id, NO_INDEX, MAV_PARAM_ERROR_PERMISSION_DENIED);
        want_parameter(to, index);
        return;
    }
    reason = set_value(table, index, message);
    if (reason == NULL) {
        copter_mavlink_parameter_is_set(copter, index);
        tell_wait(copter, index);
    } else {
        say_parameter(copter, MAV_SEVERITY_WARNING, index, reason);
        refuse_parameter(to, from, message->param_id, NO_INDEX, MAV_PARAM_ERROR_VALUE_OUT_OF_RANGE);
        want_on_all(self, index);
    }
}
