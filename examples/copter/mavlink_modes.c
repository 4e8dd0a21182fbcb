/* SPDX-License-Identifier: Apache-2.0 */
#include "mavlink_modes.h"

#include "keel/middleware/range.h"

#include <stddef.h>

/* PX4's layout of custom_mode. */
#define NUMBER(main, sub) (((uint32_t)(sub) << 24) | ((uint32_t)(main) << 16))

#define NOT_ASKED ((uint32_t)MAV_MODE_PROPERTY_NOT_USER_SELECTABLE)

/* A mode as stations know it. */
typedef struct row {
    uint32_t number;
    uint32_t properties;
    uint8_t standard; /* Of MAVLink's standard modes. */
    const char *name; /* Of 34 characters at most; null: the standard mode's own. */
} row_t;

/* By the modes of mode.h. In acro and angle the throttle is the thrust: only the pilot asks. */
static const row_t rows[COPTER_MODES] = {
    [KEEL_MODE_ACRO] = {.number = NUMBER(5, 0),
                        .properties = NOT_ASKED | (uint32_t)MAV_MODE_PROPERTY_ADVANCED,
                        .standard = (uint8_t)MAV_STANDARD_MODE_NON_STANDARD,
                        .name = "Acro"},
    [KEEL_MODE_LAND] = {.number = NUMBER(COPTER_MODE_AUTO, 6),
                        .standard = (uint8_t)MAV_STANDARD_MODE_LAND},
    [KEEL_MODE_ANGLE] = {.number = NUMBER(7, 0),
                         .properties = NOT_ASKED,
                         .standard = (uint8_t)MAV_STANDARD_MODE_NON_STANDARD,
                         .name = "Angle"},
    [KEEL_MODE_ALTITUDE] = {.number = NUMBER(2, 0),
                            .standard = (uint8_t)MAV_STANDARD_MODE_ALTITUDE_HOLD},
    [KEEL_MODE_POSITION] = {.number = NUMBER(3, 0),
                            .standard = (uint8_t)MAV_STANDARD_MODE_POSITION_HOLD},
    [KEEL_MODE_RETURN] = {.number = NUMBER(COPTER_MODE_AUTO, 5),
                          .standard = (uint8_t)MAV_STANDARD_MODE_SAFE_RECOVERY},
};

uint8_t copter_mavlink_mode_told(const copter_t *copter)
{
    const keel_mode_t *const machine = &copter->state.mode;

    return machine->motors ? machine->mode : machine->asked;
}

uint32_t copter_mavlink_mode_number(uint8_t mode)
{
    return (mode < COPTER_MODES) ? rows[mode].number : COPTER_MODE_NUMBER_NONE;
}

uint8_t copter_mavlink_mode_of_number(uint32_t number)
{
    uint8_t found = (uint8_t)KEEL_MODE_NONE;

    for (uint8_t mode = 0u; mode < COPTER_MODES; mode++) {
        found = (rows[mode].number == number) ? mode : found;
    }
    return found;
}

static uint8_t standard_of(uint8_t mode)
{
    return (mode < COPTER_MODES) ? rows[mode].standard : (uint8_t)MAV_STANDARD_MODE_NON_STANDARD;
}

uint8_t copter_mavlink_mode_of_standard(uint32_t standard)
{
    uint8_t found = (uint8_t)KEEL_MODE_NONE;

    for (uint8_t mode = 0u; mode < COPTER_MODES; mode++) {
        const bool is_it = (standard != MAV_STANDARD_MODE_NON_STANDARD) &&
                           (rows[mode].standard == standard);

        found = is_it ? mode : found;
    }
    return found;
}

bool copter_mavlink_modes_want(copter_link_t *link, float index)
{
    const bool known = keel_range_contains(index, 0.0f, (float)COPTER_MODES);
    const uint32_t number = known ? (uint32_t)index : 0u;
    const bool whole = known && keel_range_contains(index, (float)number, (float)number);

    if (whole) {
        link->modes |= (number == 0u) ? ((1u << COPTER_MODES) - 1u) : (1u << (number - 1u));
    }
    return whole;
}

void copter_mavlink_modes_current(const copter_t *copter, uint8_t *payload)
{
    const uint8_t mode = copter_mavlink_mode_told(copter);
    const uint8_t asked = copter->state.mode.asked;
    const message_current_mode_t message = {
        .custom_mode = copter_mavlink_mode_number(mode),
        .intended_custom_mode = (asked < COPTER_MODES) ? rows[asked].number : 0u, /* Not known. */
        .standard_mode = standard_of(mode)};

    message_current_mode_pack(&message, payload);
}

bool copter_mavlink_modes_available(copter_link_t *link, uint8_t *payload)
{
    uint8_t mode = 0u;
    message_available_modes_t message = {.number_modes = COPTER_MODES};

    while ((mode < COPTER_MODES) && ((link->modes & (1u << mode)) == 0u)) {
        mode++;
    }
    if (mode == COPTER_MODES) {
        return false;
    }
    link->modes &= ~(1u << mode);
    message.custom_mode = rows[mode].number;
    message.properties = rows[mode].properties;
    message.mode_index = (uint8_t)(mode + 1u);
    message.standard_mode = rows[mode].standard;
    for (uint32_t i = 0u; (rows[mode].name != NULL) && (rows[mode].name[i] != '\0'); i++) {
        message.mode_name[i] = rows[mode].name[i];
    }
    message_available_modes_pack(&message, payload);
    return true;
}
