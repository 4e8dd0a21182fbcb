/* SPDX-License-Identifier: Apache-2.0 */
/* Modes that ground stations ask for. Whatever the command, it moves the mode switch
 * (action_request.h) to a mode that flies without anybody's hand at the throttle. */
#include "command.h"
#include "keel/middleware/range.h"
#include "mavlink_modes.h"

#define CUSTOM      (MAV_MODE_FLAG_CUSTOM_MODE_ENABLED)
#define BYTE_MOST   255.0f
#define NUMBER_MOST 4294967040.0f /* The greatest float that a number of 32 bits can be. */
#define NOT_WHOLE   UINT32_MAX

/* Places of parameters. */
#define BASE_MODE 0u
#define MAIN_MODE 1u
#define SUB_MODE  2u
#define PRECISION 1u
#define LATITUDE  4u
#define LONGITUDE 5u

/* A parameter that is a whole number, of at most so much; NOT_WHOLE when it is none. */
static uint32_t whole_of(float param, float most)
{
    const bool fits = keel_range_contains(param, 0.0f, most);
    const uint32_t whole = fits ? (uint32_t)param : 0u;
    const bool is_whole = fits && keel_range_contains(param, (float)whole, (float)whole);

    return is_whole ? whole : NOT_WHOLE;
}

static uint32_t refuse_command(copter_t *copter, uint32_t result, const char *reason)
{
    copter_text(copter->telemetry, (uint8_t)MAV_SEVERITY_WARNING, "mode: ", reason);
    return result;
}

/* Modes that fly without a hand at the throttle. */
static bool is_safe(uint8_t mode)
{
    return (mode == KEEL_MODE_LAND) || (mode == KEEL_MODE_ALTITUDE) ||
           (mode == KEEL_MODE_POSITION) || (mode == KEEL_MODE_RETURN);
}

/* Modes that end a flight. On the ground there is none to end, and who stood there with the switch
 * at one of them could not be armed. */
static bool is_last(uint8_t mode)
{
    return (mode == KEEL_MODE_LAND) || (mode == KEEL_MODE_RETURN);
}

static uint32_t ask_for(copter_t *copter, const copter_command_t *command, uint8_t mode)
{
    copter_telemetry_t *const self = copter->telemetry;
    const keel_mode_t *const machine = &copter->state.mode;
    const copter_action_request_t *const request = &copter->request;

    if (request->mode.answer == COPTER_ANSWER_WAITS) {
        return (copter_command_is_again(&self->mode_waiter, command) && (mode == request->asked))
                   ? MAV_RESULT_IN_PROGRESS
                   : refuse_command(copter, MAV_RESULT_TEMPORARILY_REJECTED,
                                    "another is being asked for");
    }
    if (!is_safe(mode)) {
        return refuse_command(copter, MAV_RESULT_DENIED, "only by the pilot's switch");
    }
    if ((machine->settled & KEEL_MODE_RC_LINKED) == 0u) {
        return refuse_command(copter, MAV_RESULT_TEMPORARILY_REJECTED, "no radio link");
    }
    if (is_last(mode) && !machine->motors) {
        return refuse_command(copter, MAV_RESULT_TEMPORARILY_REJECTED, "not flying");
    }
    copter_action_request_mode(&copter->request, mode, copter->pilot.asked);
    self->mode_waiter = copter_command_waiter(command);
    return MAV_RESULT_IN_PROGRESS;
}

/* Position hold with a pilot whose sticks ask for nothing: with others it would not hold. */
static uint32_t hold_place(copter_t *copter, const copter_command_t *command)
{
    const keel_reference_setpoints_t *const sticks = &copter->pilot.reference.setpoints;
    const bool rest = keel_range_contains(sticks->forward, 0.0f, 0.0f) &&
                      keel_range_contains(sticks->right, 0.0f, 0.0f) &&
                      keel_range_contains(sticks->climb_rate, 0.0f, 0.0f);

    return rest ? ask_for(copter, command, (uint8_t)KEEL_MODE_POSITION)
                : refuse_command(copter, MAV_RESULT_TEMPORARILY_REJECTED,
                                 "hold: sticks not centred");
}

/* By its number. */
static uint32_t ask_for_number(copter_t *copter, const copter_command_t *command, uint32_t number)
{
    const uint8_t mode = copter_mavlink_mode_of_number(number);

    return (mode == (uint8_t)KEEL_MODE_NONE)
               ? refuse_command(copter, MAV_RESULT_DENIED, "there is no such one")
               : ask_for(copter, command, mode);
}

/* By PX4's main mode and sub-mode. A sender without a sub-mode may mean ArduCopter's number. */
static uint32_t ask_for_pair(copter_t *copter, const copter_command_t *command)
{
    const uint32_t main_mode = whole_of(command->param[MAIN_MODE], BYTE_MOST);
    const uint32_t sub_mode = whole_of(command->param[SUB_MODE], BYTE_MOST);

    if ((main_mode == COPTER_MODE_AUTO) && (sub_mode == COPTER_MODE_HOLD)) {
        return hold_place(copter, command);
    }
    return ask_for_number(copter, command,
                          ((main_mode == NOT_WHOLE) || (sub_mode == NOT_WHOLE))
                              ? NOT_WHOLE
                              : ((sub_mode << 24) | (main_mode << 16)));
}

uint32_t copter_command_set_mode(copter_t *copter, const copter_command_t *command)
{
    const uint32_t base = whole_of(command->param[BASE_MODE], BYTE_MOST);

    if ((base == NOT_WHOLE) || ((base & CUSTOM) == 0u)) {
        return refuse_command(copter, MAV_RESULT_DENIED, "only custom modes");
    }
    return copter_command_is_empty(command->param[SUB_MODE])
               ? ask_for_number(copter, command, whole_of(command->param[MAIN_MODE], NUMBER_MOST))
               : ask_for_pair(copter, command);
}

uint32_t copter_command_set_mode_by_number(copter_t *copter, const copter_command_t *command,
                                           bool is_custom, uint32_t number)
{
    return is_custom ? ask_for_number(copter, command, number)
                     : refuse_command(copter, MAV_RESULT_DENIED, "only custom modes");
}

uint32_t copter_command_set_standard_mode(copter_t *copter, const copter_command_t *command)
{
    const uint8_t mode = copter_mavlink_mode_of_standard(whole_of(command->param[0], BYTE_MOST));

    /* The standard has FAILED for a mode that there is not. */
    return (mode == (uint8_t)KEEL_MODE_NONE)
               ? refuse_command(copter, MAV_RESULT_FAILED, "there is no such one")
               : ask_for(copter, command, mode);
}

/* Whether a command names no place. */
static bool is_here(const copter_command_t *command)
{
    return copter_command_is_empty(command->param[LATITUDE]) &&
           copter_command_is_empty(command->param[LONGITUDE]);
}

uint32_t copter_command_land(copter_t *copter, const copter_command_t *command)
{
    if (!is_here(command) || !copter_command_is_empty(command->param[PRECISION])) {
        return refuse_command(copter, MAV_RESULT_DENIED, "it lands where it is");
    }
    return ask_for(copter, command, (uint8_t)KEEL_MODE_LAND);
}

uint32_t copter_command_return(copter_t *copter, const copter_command_t *command)
{
    return ask_for(copter, command, (uint8_t)KEEL_MODE_RETURN);
}

uint32_t copter_command_hold(copter_t *copter, const copter_command_t *command)
{
    return is_here(command) ? hold_place(copter, command)
                            : refuse_command(copter, MAV_RESULT_DENIED, "it holds where it is");
}

uint32_t copter_command_take_off(copter_t *copter, const copter_command_t *command)
{
    (void)command;
    copter_text(copter->telemetry, (uint8_t)MAV_SEVERITY_WARNING,
                "take-off: ", "only by the pilot's throttle");
    return MAV_RESULT_UNSUPPORTED;
}
