/* SPDX-License-Identifier: Apache-2.0 */
/* Missions and logs, of which the copter has none:
 *
 *     MISSION_REQUEST_LIST          MISSION_COUNT of 0
 *     MISSION_CLEAR_ALL             MISSION_ACK, ACCEPTED; so is an upload of no items
 *     MISSION_COUNT, MISSION_ITEM   MISSION_ACK, UNSUPPORTED: an upload
 *     MISSION_REQUEST               MISSION_ACK, INVALID_SEQUENCE: there is no such item
 *     LOG_REQUEST_LIST              LOG_ENTRY: no log
 *     LOG_REQUEST_DATA              LOG_DATA of no bytes: the end of the log
 *     MISSION_SET_CURRENT, LOG_ERASE  a text, as MAVLink has no other answer
 *
 * A refusal changes nothing, so a link that may not command is answered, too. */
#include "telemetry.h"

/* The content of a message about a mission, whichever it is. */
typedef struct asked {
    uint8_t system; /* The addressee. */
    uint8_t component;
    uint8_t kind;
    uint8_t result; /* The answer, of a kind that there is. */
} asked_t;

static void send_reply(copter_link_t *link, copter_reply_t answer)
{
    if (link->replies.count < COPTER_REPLIES) {
        link->replies.reply[link->replies.count] = answer;
        link->replies.count++;
    } else {
        link->dropped++;
    }
}

static asked_t asked_for_list(const keel_mavlink_frame_t *frame)
{
    message_mission_request_list_t message;

    message_mission_request_list_unpack(&message, frame->payload);
    return (asked_t){message.target_system, message.target_component, message.mission_type,
                     (uint8_t)MAV_MISSION_ACCEPTED};
}

static asked_t asked_to_clear(const keel_mavlink_frame_t *frame)
{
    message_mission_clear_all_t message;

    message_mission_clear_all_unpack(&message, frame->payload);
    return (asked_t){message.target_system, message.target_component, message.mission_type,
                     (uint8_t)MAV_MISSION_ACCEPTED};
}

/* An upload of no items clears. */
static asked_t asked_to_load(const keel_mavlink_frame_t *frame)
{
    message_mission_count_t message;

    message_mission_count_unpack(&message, frame->payload);
    return (asked_t){
        message.target_system, message.target_component, message.mission_type,
        (uint8_t)((message.count == 0u) ? MAV_MISSION_ACCEPTED : MAV_MISSION_UNSUPPORTED)};
}

/* MISSION_REQUEST and MISSION_REQUEST_INT are alike. */
static asked_t asked_for_item(const keel_mavlink_frame_t *frame)
{
    message_mission_request_int_t message;

    message_mission_request_int_unpack(&message, frame->payload);
    return (asked_t){message.target_system, message.target_component, message.mission_type,
                     (uint8_t)MAV_MISSION_INVALID_SEQUENCE};
}

/* MISSION_ITEM and MISSION_ITEM_INT are alike but for the types of two fields that do not matter
 * here. */
static asked_t asked_to_keep(const keel_mavlink_frame_t *frame)
{
    message_mission_item_int_t message;

    message_mission_item_int_unpack(&message, frame->payload);
    return (asked_t){message.target_system, message.target_component, message.mission_type,
                     (uint8_t)MAV_MISSION_UNSUPPORTED};
}

/* The messages that ask for a part of a list, and that write one, are alike. */
static asked_t asked_for_part(const keel_mavlink_frame_t *frame)
{
    const bool writes = (frame->id == MESSAGE_MISSION_WRITE_PARTIAL_LIST);
    message_mission_request_partial_list_t message;

    message_mission_request_partial_list_unpack(&message, frame->payload);
    return (asked_t){message.target_system, message.target_component, message.mission_type,
                     (uint8_t)(writes ? MAV_MISSION_UNSUPPORTED : MAV_MISSION_INVALID_SEQUENCE)};
}

static bool is_kind(uint8_t kind, bool clears)
{
    return (kind <= MAV_MISSION_TYPE_RALLY) || (clears && (kind == MAV_MISSION_TYPE_ALL));
}

static void take_mission(copter_t *copter, const keel_mavlink_frame_t *frame, uint32_t number,
                         asked_t asked)
{
    copter_link_t *const link = &copter->telemetry->link[number];
    const bool lists = (frame->id == MESSAGE_MISSION_REQUEST_LIST);
    const bool is_known = is_kind(asked.kind, frame->id == MESSAGE_MISSION_CLEAR_ALL);

    if (copter_is_meant(link, asked.system, asked.component)) {
        send_reply(link, (copter_reply_t){.sent = (uint8_t)((lists && is_known) ? SENT_MISSION_COUNT
                                                                                : SENT_MISSION_ACK),
                                          .system = frame->system,
                                          .component = frame->component,
                                          .kind = asked.kind,
                                          .result = is_known ? asked.result
                                                             : (uint8_t)MAV_MISSION_UNSUPPORTED});
    }
}

static void take_set_current(copter_t *copter, const keel_mavlink_frame_t *frame, uint32_t link)
{
    message_mission_set_current_t message;

    message_mission_set_current_unpack(&message, frame->payload);
    if (copter_is_meant(&copter->telemetry->link[link], message.target_system,
                        message.target_component)) {
        copter_text(copter->telemetry, (uint8_t)MAV_SEVERITY_WARNING, "mission: ", "there is none");
    }
}

static void take_log_list(copter_t *copter, const keel_mavlink_frame_t *frame, uint32_t number)
{
    copter_link_t *const link = &copter->telemetry->link[number];
    message_log_request_list_t message;

    message_log_request_list_unpack(&message, frame->payload);
    if (copter_is_meant(link, message.target_system, message.target_component)) {
        send_reply(link, (copter_reply_t){.sent = (uint8_t)SENT_LOG_ENTRY});
    }
}

static void take_log_data(copter_t *copter, const keel_mavlink_frame_t *frame, uint32_t number)
{
    copter_link_t *const link = &copter->telemetry->link[number];
    message_log_request_data_t message;

    message_log_request_data_unpack(&message, frame->payload);
    if (copter_is_meant(link, message.target_system, message.target_component)) {
        send_reply(link, (copter_reply_t){.sent = (uint8_t)SENT_LOG_DATA,
                                          .log = message.id,
                                          .offset = message.ofs});
    }
}

static void take_log_erase(copter_t *copter, const keel_mavlink_frame_t *frame, uint32_t link)
{
    message_log_erase_t message;

    message_log_erase_unpack(&message, frame->payload);
    if (copter_is_meant(&copter->telemetry->link[link], message.target_system,
                        message.target_component)) {
        copter_text(copter->telemetry, (uint8_t)MAV_SEVERITY_WARNING,
                    "logs: ", "are not erased by telemetry");
    }
}

void copter_mavlink_receive_list(copter_t *copter, uint32_t link)
{
    const keel_mavlink_frame_t *const frame = &copter->telemetry->link[link].decoder.frame;

    switch (frame->id) {
    case MESSAGE_MISSION_REQUEST_LIST:
        take_mission(copter, frame, link, asked_for_list(frame));
        break;
    case MESSAGE_MISSION_CLEAR_ALL:
        take_mission(copter, frame, link, asked_to_clear(frame));
        break;
    case MESSAGE_MISSION_COUNT:
        take_mission(copter, frame, link, asked_to_load(frame));
        break;
    case MESSAGE_MISSION_REQUEST:
    case MESSAGE_MISSION_REQUEST_INT:
        take_mission(copter, frame, link, asked_for_item(frame));
        break;
    case MESSAGE_MISSION_ITEM:
    case MESSAGE_MISSION_ITEM_INT:
        take_mission(copter, frame, link, asked_to_keep(frame));
        break;
    case MESSAGE_MISSION_REQUEST_PARTIAL_LIST:
    case MESSAGE_MISSION_WRITE_PARTIAL_LIST:
        take_mission(copter, frame, link, asked_for_part(frame));
        break;
    case MESSAGE_MISSION_SET_CURRENT:
        take_set_current(copter, frame, link);
        break;
    case MESSAGE_LOG_REQUEST_LIST:
        take_log_list(copter, frame, link);
        break;
    case MESSAGE_LOG_REQUEST_DATA:
        take_log_data(copter, frame, link);
        break;
    case MESSAGE_LOG_ERASE:
        take_log_erase(copter, frame, link);
        break;
    default:
        /* It is not taken. */
        break;
    }
}

static void pack_mission_count(const copter_reply_t *answer, uint8_t *payload)
{
    const message_mission_count_t message = {.target_system = answer->system,
                                             .target_component = answer->component,
                                             .mission_type = answer->kind};

    message_mission_count_pack(&message, payload);
}

static void pack_mission_ack(const copter_reply_t *answer, uint8_t *payload)
{
    const message_mission_ack_t message = {.target_system = answer->system,
                                           .target_component = answer->component,
                                           .type = answer->result,
                                           .mission_type = answer->kind};

    message_mission_ack_pack(&message, payload);
}

static void pack_log_data(const copter_reply_t *answer, uint8_t *payload)
{
    const message_log_data_t message = {.ofs = answer->offset, .id = answer->log};

    message_log_data_pack(&message, payload);
}

static void pack_log_entry(uint8_t *payload)
{
    const message_log_entry_t message = {0};

    message_log_entry_pack(&message, payload);
}

bool copter_mavlink_report_list(copter_link_t *link, uint32_t sent, uint8_t *payload)
{
    copter_replies_t *const replies = &link->replies;
    const copter_reply_t answer = replies->reply[0];

    if ((replies->count == 0u) || (answer.sent != sent)) {
        return false;
    }
    for (uint32_t i = 1u; i < replies->count; i++) {
        replies->reply[i - 1u] = replies->reply[i];
    }
    replies->count--;
    if (sent == SENT_MISSION_COUNT) {
        pack_mission_count(&answer, payload);
    } else if (sent == SENT_MISSION_ACK) {
        pack_mission_ack(&answer, payload);
    } else if (sent == SENT_LOG_DATA) {
        pack_log_data(&answer, payload);
    } else {
        pack_log_entry(payload);
    }
    return true;
}
