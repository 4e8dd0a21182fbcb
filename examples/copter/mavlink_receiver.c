/* SPDX-License-Identifier: Apache-2.0 */
/* Requests of a ground station:
 *
 *     parameters                      list, read, set: see mavlink_parameters.c
 *     COMMAND_LONG, COMMAND_INT       COMPONENT_ARM_DISARM, SET_MESSAGE_INTERVAL, REQUEST_MESSAGE,
 *                                     and those of command.h; others are answered with UNSUPPORTED
 *     SET_MODE                        as DO_SET_MODE
 *     PING, TIMESYNC                  answered
 *     missions, logs                  as mavlink_empty_lists.h says
 *     FILE_TRANSFER_PROTOCOL          as ftp.h says
 *     SERIAL_CONTROL                  as shell.h says
 *
 * Arming, disarming and modes are asked of the state machine, as action_request.h says. It answers,
 * and what it refuses is answered with TEMPORARILY_REJECTED and a text for each thing that stands
 * in the way. DENIED is what can never be: to force it, to stop motors in flight, a mode in which
 * the throttle is the thrust, as whoever asks does not hold the throttle. */
#include "command.h"
#include "keel/middleware/range.h"
#include "mavlink_modes.h"
#include "obstacle.h"

#include <math.h>

#define ANYBODY   0u
#define LEAST_US  10000.0f
#define MOST_US   60000000.0f
#define ID_MOST   16777215.0f
#define NOT_FOUND UINT32_MAX

/* A text for each of what stands in the way. */
static void tell_reason(copter_telemetry_t *self, const char *what,
                        const keel_mode_refusal_t *refusal)
{
    for (uint32_t i = 0u; i < COPTER_OBSTACLES; i++) {
        const char *const words = copter_obstacle(refusal, i);

        if (words != NULL) {
            copter_text(self, (uint8_t)MAV_SEVERITY_WARNING, what, words);
        }
    }
}

/* Why it is not armed. */
static void tell_refusal(copter_telemetry_t *self, const char *words)
{
    copter_text(self, (uint8_t)MAV_SEVERITY_WARNING, COPTER_NOT_ARMED, words);
}

static void acknowledge(copter_telemetry_t *self, const copter_waiter_t *to, uint32_t result)
{
    copter_link_t *const link = &self->link[to->link];

    if (link->acks < COPTER_LINK_ACKS) {
        link->ack[link->acks] = (message_command_ack_t){.command = to->command,
                                                        .result = (uint8_t)result,
                                                        .target_system = to->system,
                                                        .target_component = to->component};
        link->acks++;
    } else {
        link->dropped++;
    }
}

copter_waiter_t copter_command_waiter(const copter_command_t *command)
{
    return (copter_waiter_t){.link = command->link,
                             .command = command->id,
                             .system = command->system,
                             .component = command->component};
}

bool copter_command_is_again(const copter_waiter_t *waiter, const copter_command_t *command)
{
    return (waiter->link == command->link) && (waiter->command == command->id) &&
           (waiter->system == command->system) && (waiter->component == command->component);
}

bool copter_command_is_empty(float param)
{
    return isnan(param) || keel_range_contains(param, 0.0f, 0.0f);
}

static uint32_t ask_to_arm(copter_t *copter)
{
    const keel_mode_t *const machine = &copter->state.mode;

    if (machine->motors) {
        return MAV_RESULT_ACCEPTED;
    }
    if ((machine->blocking.checks != 0u) || (machine->blocking.facts != 0u) || !machine->ready) {
        tell_reason(copter->telemetry, COPTER_NOT_ARMED, &machine->blocking);
        if ((machine->settled & KEEL_MODE_RC_LINKED) == 0u) {
            tell_refusal(copter->telemetry, "no radio link for long enough");
        } else if (!machine->ready) {
            tell_refusal(copter->telemetry, "arm switch was not off");
        } else {
            /* It has been told. */
        }
        return MAV_RESULT_TEMPORARILY_REJECTED;
    }
    copter_action_request_arm(&copter->request, true);
    return MAV_RESULT_IN_PROGRESS;
}

static uint32_t ask_to_disarm(copter_t *copter)
{
    const keel_mode_t *const machine = &copter->state.mode;

    if (!machine->motors) {
        return MAV_RESULT_ACCEPTED;
    }
    if (machine->state != KEEL_MODE_ARMED) {
        copter_text(copter->telemetry, (uint8_t)MAV_SEVERITY_WARNING,
                    "not disarmed: ", "not on the ground");
        return MAV_RESULT_DENIED;
    }
    copter_action_request_arm(&copter->request, false);
    return MAV_RESULT_IN_PROGRESS;
}

static uint32_t arm_or_disarm(copter_t *copter, const copter_command_t *command)
{
    copter_telemetry_t *const self = copter->telemetry;
    const keel_mode_t *const machine = &copter->state.mode;
    const bool on = keel_range_contains(command->param[0], 1.0f, 1.0f);
    const bool off = keel_range_contains(command->param[0], 0.0f, 0.0f);
    uint32_t result;

    if (copter->request.arm.answer == COPTER_ANSWER_WAITS) {
        return (copter_command_is_again(&self->arm_waiter, command) && (on == copter->request.arms))
                   ? MAV_RESULT_IN_PROGRESS
                   : MAV_RESULT_TEMPORARILY_REJECTED;
    }
    if ((on == off) || !copter_command_is_empty(command->param[1])) {
        return MAV_RESULT_DENIED; /* A second number asks to force it. */
    }
    if (machine->state == KEEL_MODE_TERMINATED) {
        if (on) {
            tell_refusal(self, copter_obstacle_first(machine));
        }
        return MAV_RESULT_DENIED;
    }
    result = on ? ask_to_arm(copter) : ask_to_disarm(copter);
    if (result == MAV_RESULT_IN_PROGRESS) {
        self->arm_waiter = copter_command_waiter(command);
    }
    return result;
}

/* The place of a message among those that are sent. */
static uint32_t sent_of(float id)
{
    uint32_t found = NOT_FOUND;

    if (keel_range_contains(id, 0.0f, ID_MOST)) {
        for (uint32_t i = 0u; i < MESSAGES_SENT; i++) {
            found = (messages_sent[i].id == (uint32_t)id) ? i : found;
        }
    }
    return found;
}

/* Answers are sent to what they answer alone. */
static bool is_answer(uint32_t sent)
{
    return (sent == SENT_PING) || (sent == SENT_PARAM_VALUE) || (sent == SENT_PARAM_ERROR) ||
           (sent == SENT_COMMAND_ACK) || (sent == SENT_TIMESYNC) || (sent == SENT_STATUSTEXT) ||
           (sent == SENT_MISSION_COUNT) || (sent == SENT_MISSION_ACK) || (sent == SENT_LOG_ENTRY) ||
           (sent == SENT_LOG_DATA) || (sent == SENT_FILE_TRANSFER_PROTOCOL) ||
           (sent == SENT_SERIAL_CONTROL);
}

static uint32_t set_interval(copter_t *copter, const copter_command_t *command)
{
    const uint32_t sent = sent_of(command->param[0]);
    const float interval = command->param[1];
    uint32_t interval_us = 0u; /* Below 0: never. */

    if ((sent == NOT_FOUND) || is_answer(sent) || (sent == SENT_HEARTBEAT) ||
        (sent == SENT_AVAILABLE_MODES) || !keel_range_contains(interval, -1.0f, MOST_US)) {
        return MAV_RESULT_DENIED;
    }
    if (interval >= LEAST_US) {
        interval_us = (uint32_t)interval;
    } else if (interval > 0.0f) {
        interval_us = (uint32_t)LEAST_US;
    } else if (interval >= 0.0f) {
        interval_us = copter_telemetry_interval_us(sent);
    } else {
        /* Never. */
    }
    copter_link_schedule_repeat(&copter->telemetry->link[command->link].schedule, sent,
                                interval_us);
    return MAV_RESULT_ACCEPTED;
}

static uint32_t request_message(copter_t *copter, const copter_command_t *command)
{
    const uint32_t sent = sent_of(command->param[0]);

    if ((sent == NOT_FOUND) || is_answer(sent) ||
        ((sent == SENT_AVAILABLE_MODES) &&
         !copter_mavlink_modes_want(&copter->telemetry->link[command->link], command->param[1]))) {
        return MAV_RESULT_DENIED;
    }
    copter_link_schedule_ask(&copter->telemetry->link[command->link].schedule, sent);
    return MAV_RESULT_ACCEPTED;
}

static bool may_command(copter_telemetry_t *self, uint32_t link)
{
    const bool may = self->config.link[link].commands;

    self->link[link].refused += may ? 0u : 1u;
    return may;
}

/* A command that moves the aircraft or stops it, and who carries it out. */
typedef struct order {
    uint16_t id;
    uint32_t (*obey)(copter_t *copter, const copter_command_t *command);
} order_t;

static const order_t orders[] = {
    {MAV_CMD_COMPONENT_ARM_DISARM, arm_or_disarm},
    {MAV_CMD_DO_SET_MODE, copter_command_set_mode},
    {MAV_CMD_DO_SET_STANDARD_MODE, copter_command_set_standard_mode},
    {MAV_CMD_NAV_LAND, copter_command_land},
    {MAV_CMD_NAV_RETURN_TO_LAUNCH, copter_command_return},
    {MAV_CMD_NAV_LOITER_UNLIM, copter_command_hold},
    {MAV_CMD_NAV_TAKEOFF, copter_command_take_off},
    {MAV_CMD_PREFLIGHT_CALIBRATION, copter_command_calibrate},
    {MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, copter_command_reboot},
};

static uint32_t run_command(copter_t *copter, const copter_command_t *command)
{
    for (uint32_t i = 0u; i < (sizeof orders / sizeof orders[0]); i++) {
        if (orders[i].id == command->id) {
            return may_command(copter->telemetry, command->link) ? orders[i].obey(copter, command)
                                                                 : MAV_RESULT_DENIED;
        }
    }
    return MAV_RESULT_UNSUPPORTED;
}

static uint32_t result_of(copter_t *copter, const copter_command_t *command)
{
    switch (command->id) {
    case MAV_CMD_SET_MESSAGE_INTERVAL:
        return set_interval(copter, command);
    case MAV_CMD_REQUEST_MESSAGE:
        return request_message(copter, command);
    default:
        return run_command(copter, command);
    }
}

static void obey_command(copter_t *copter, const copter_command_t *command)
{
    const uint32_t result = result_of(copter, command);

    if (result != MAV_RESULT_IN_PROGRESS) {
        const copter_waiter_t to = copter_command_waiter(command);

        acknowledge(copter->telemetry, &to, result);
    }
}

static copter_command_t command_from(const keel_mavlink_frame_t *frame, uint32_t link)
{
    return (copter_command_t){.link = link, .system = frame->system, .component = frame->component};
}

static void take_command_long(copter_t *copter, const keel_mavlink_frame_t *frame, uint32_t link)
{
    copter_command_t command = command_from(frame, link);
    message_command_long_t message;

    message_command_long_unpack(&message, frame->payload);
    if (copter_is_meant(&copter->telemetry->link[link], message.target_system,
                        message.target_component)) {
        command.id = message.command;
        command.param[0] = message.param1;
        command.param[1] = message.param2;
        command.param[2] = message.param3;
        command.param[3] = message.param4;
        command.param[4] = message.param5;
        command.param[5] = message.param6;
        command.param[6] = message.param7;
        obey_command(copter, &command);
    }
}

/* The greatest number stands for none. */
static float place_of(int32_t number)
{
    return (number == INT32_MAX) ? NAN : (float)number;
}

static void take_command_int(copter_t *copter, const keel_mavlink_frame_t *frame, uint32_t link)
{
    copter_command_t command = command_from(frame, link);
    message_command_int_t message;

    message_command_int_unpack(&message, frame->payload);
    if (copter_is_meant(&copter->telemetry->link[link], message.target_system,
                        message.target_component)) {
        command.id = message.command;
        command.param[0] = message.param1;
        command.param[1] = message.param2;
        command.param[2] = message.param3;
        command.param[3] = message.param4;
        command.param[4] = place_of(message.x);
        command.param[5] = place_of(message.y);
        command.param[6] = message.z;
        obey_command(copter, &command);
    }
}

static void take_set_mode(copter_t *copter, const keel_mavlink_frame_t *frame, uint32_t link)
{
    copter_command_t command = command_from(frame, link);
    message_set_mode_t message;

    message_set_mode_unpack(&message, frame->payload);
    if ((message.target_system == copter->telemetry->system) &&
        may_command(copter->telemetry, link)) {
        command.id = MESSAGE_SET_MODE;
        (void)copter_command_set_mode_by_number(copter, &command,
                                                (message.base_mode &
                                                 MAV_MODE_FLAG_CUSTOM_MODE_ENABLED) != 0u,
                                                message.custom_mode);
    }
}

static void take_read(copter_t *copter, const keel_mavlink_frame_t *frame, uint32_t link)
{
    message_param_request_read_t message;

    message_param_request_read_unpack(&message, frame->payload);
    if (copter_is_meant(&copter->telemetry->link[link], message.target_system,
                        message.target_component)) {
        copter_mavlink_read_parameter(copter, link, frame, &message);
    }
}

static void take_list(copter_t *copter, const keel_mavlink_frame_t *frame, uint32_t link)
{
    message_param_request_list_t message;

    message_param_request_list_unpack(&message, frame->payload);
    if (copter_is_meant(&copter->telemetry->link[link], message.target_system,
                        message.target_component)) {
        copter_mavlink_list_parameters(copter, link);
    }
}

static void take_set(copter_t *copter, const keel_mavlink_frame_t *frame, uint32_t link)
{
    message_param_set_t message;

    message_param_set_unpack(&message, frame->payload);
    if (copter_is_meant(&copter->telemetry->link[link], message.target_system,
                        message.target_component)) {
        copter_mavlink_set_parameter(copter, link, frame, &message,
                                     may_command(copter->telemetry, link));
    }
}

static void take_ping(copter_t *copter, const keel_mavlink_frame_t *frame, uint32_t link)
{
    copter_link_t *const to = &copter->telemetry->link[link];
    message_ping_t message;

    message_ping_unpack(&message, frame->payload);
    if ((message.target_system == ANYBODY) && (message.target_component == ANYBODY)) {
        to->ping = message;
        to->ping.target_system = frame->system;
        to->ping.target_component = frame->component;
        copter_link_schedule_ask(&to->schedule, SENT_PING);
    }
}

static void take_timesync(copter_t *copter, const keel_mavlink_frame_t *frame, uint32_t link)
{
    copter_link_t *const to = &copter->telemetry->link[link];
    message_timesync_t message;

    message_timesync_unpack(&message, frame->payload);
    if (message.tc1 == 0) {
        to->timesync = (message_timesync_t){
            .tc1 = (int64_t)(copter->scheduler.clock.now_us * 1000u), .ts1 = message.ts1};
        copter_link_schedule_ask(&to->schedule, SENT_TIMESYNC);
    }
}

static void take_ftp(copter_t *copter, const keel_mavlink_frame_t *frame, uint32_t link)
{
    copter_link_t *const to = &copter->telemetry->link[link];
    message_file_transfer_protocol_t message;

    message_file_transfer_protocol_unpack(&message, frame->payload);
    if (copter_is_meant(to, message.target_system, message.target_component) &&
        !copter_ftp_take(&to->ftp, &message, frame->system, frame->component)) {
        to->dropped++;
    }
}

static void take_shell(copter_t *copter, const keel_mavlink_frame_t *frame, uint32_t link)
{
    copter_link_t *const to = &copter->telemetry->link[link];
    message_serial_control_t message;

    message_serial_control_unpack(&message, frame->payload);
    if (copter_is_meant(to, message.target_system, message.target_component) &&
        !copter_shell_take(&to->shell, &message, frame->system, frame->component)) {
        to->dropped++;
    }
}

void copter_mavlink_receive(copter_t *copter, uint32_t link)
{
    const keel_mavlink_frame_t *const frame = &copter->telemetry->link[link].decoder.frame;

    switch (frame->id) {
    case MESSAGE_COMMAND_LONG:
        take_command_long(copter, frame, link);
        break;
    case MESSAGE_COMMAND_INT:
        take_command_int(copter, frame, link);
        break;
    case MESSAGE_SET_MODE:
        take_set_mode(copter, frame, link);
        break;
    case MESSAGE_PARAM_REQUEST_READ:
        take_read(copter, frame, link);
        break;
    case MESSAGE_PARAM_REQUEST_LIST:
        take_list(copter, frame, link);
        break;
    case MESSAGE_PARAM_SET:
        take_set(copter, frame, link);
        break;
    case MESSAGE_PING:
        take_ping(copter, frame, link);
        break;
    case MESSAGE_TIMESYNC:
        take_timesync(copter, frame, link);
        break;
    case MESSAGE_FILE_TRANSFER_PROTOCOL:
        take_ftp(copter, frame, link);
        break;
    case MESSAGE_SERIAL_CONTROL:
        take_shell(copter, frame, link);
        break;
    default:
        copter_mavlink_receive_list(copter, link);
        break;
    }
}

/* Tells who waits. Nobody waits any more. */
static void answer_waiter(copter_telemetry_t *self, copter_moved_t *moved, copter_waiter_t *waiter)
{
    const bool done = moved->answer == COPTER_ANSWER_DONE;

    if (waiter->command != MESSAGE_SET_MODE) { /* That one has no answer. */
        acknowledge(self, waiter, done ? MAV_RESULT_ACCEPTED : MAV_RESULT_TEMPORARILY_REJECTED);
    }
    moved->answer = COPTER_ANSWER_NONE;
    waiter->command = 0u;
}

/* Says why an attempt to arm failed: all to whoever asked, the first to who moved his switch. What
 * failed without an attempt of the machine, as the link was lost, is in its way now. */
static void tell_attempt(copter_t *copter)
{
    copter_telemetry_t *const self = copter->telemetry;
    const copter_state_t *const state = &copter->state;
    const copter_action_request_t *const request = &copter->request;
    const bool is_tried = state->refusals != self->refusals;

    self->refusals = state->refusals;
    if ((request->arm.answer == COPTER_ANSWER_REFUSED) && request->arms) {
        tell_reason(self, COPTER_NOT_ARMED,
                    is_tried ? &state->mode.refused : &state->mode.blocking);
    } else if (is_tried) {
        tell_refusal(self, copter_obstacle_first(&state->mode));
    } else {
        /* Nobody tried, or it is armed. */
    }
}

void copter_mavlink_pass_answers(copter_t *copter)
{
    copter_telemetry_t *const self = copter->telemetry;
    const keel_mode_t *const machine = &copter->state.mode;
    copter_action_request_t *const request = &copter->request;

    tell_attempt(copter);
    if (request->arm.answer > COPTER_ANSWER_WAITS) {
        answer_waiter(self, &request->arm, &self->arm_waiter);
    }
    if (request->mode.answer > COPTER_ANSWER_WAITS) {
        if (request->mode.answer == COPTER_ANSWER_REFUSED) {
            copter_text(self, (uint8_t)MAV_SEVERITY_WARNING, "mode: ", "the aircraft cannot");
            tell_reason(self, "mode: ", &(keel_mode_refusal_t){.facts = machine->missing});
        }
        answer_waiter(self, &request->mode, &self->mode_waiter);
    }
}
