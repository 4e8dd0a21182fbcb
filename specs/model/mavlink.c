/* SPDX-License-Identifier: Apache-2.0 */
#include "mavlink.h"

#include "crc.h"

/* MAV-001 */
static bool in_order(const keel_mavlink_message_t *messages, uint32_t known)
{
    for (uint32_t i = 0u; i < known; i++) {
        if ((messages[i].id >> 24u) != 0u) {
            return false;
        }
        if (messages[i].longest < messages[i].shortest) {
            return false;
        }
        if (((i + 1u) < known) && (messages[i + 1u].id <= messages[i].id)) {
            return false;
        }
    }
    return true;
}

/* MAV-001, MAV-002 */
keel_status_t model_mavlink_init(keel_mavlink_t *mavlink, const keel_mavlink_message_t *messages,
                                 uint32_t known)
{
    static const keel_mavlink_t nothing = {0};

    if (known > 256u) {
        return KEEL_ERR_FULL;
    }
    if (!in_order(messages, known)) {
        return KEEL_ERR_LIMITS;
    }
    *mavlink = nothing;
    mavlink->messages = messages;
    mavlink->known = known;
    mavlink->crc = 0xFFFFu;
    mavlink->message = known;
    return KEEL_OK;
}

/* MAV-007: counts stay at their end. */
static void tally(uint32_t *count)
{
    if (*count != UINT32_MAX) {
        *count = *count + 1u;
    }
}

/* MAV-004: ten bytes, the payload, two bytes, and thirteen when it is signed. */
uint32_t model_mavlink_whole(const uint8_t *header)
{
    return 12u + header[1] + (((header[2] & 1u) != 0u) ? 13u : 0u);
}

/* MAV-004: of all bytes from the length to the payload's last. */
uint16_t model_mavlink_checksum(const uint8_t *bytes, uint8_t crc_extra)
{
    uint16_t crc = 0xFFFFu;

    for (uint32_t i = 1u; i < (10u + (uint32_t)bytes[1]); i++) {
        crc = model_crc16(crc, bytes[i]);
    }
    return model_crc16(crc, crc_extra);
}

/* A number in so many bytes, the lowest first. */
static uint64_t number(const uint8_t *bytes, uint32_t count)
{
    uint64_t value = 0u;

    for (uint32_t i = count; i > 0u; i--) {
        value = (value << 8u) + bytes[i - 1u];
    }
    return value;
}

/* MAV-005 */
keel_mavlink_frame_t model_mavlink_frame(const keel_mavlink_t *mavlink)
{
    const uint8_t *header = mavlink->header;
    keel_mavlink_frame_t frame = {.id = (uint32_t)number(&header[7], 3u),
                                  .sequence = header[4],
                                  .system = header[5],
                                  .component = header[6],
                                  .compatible = header[3],
                                  .length = header[1],
                                  .checksum = (uint16_t)number(mavlink->tail, 2u),
                                  .is_signed = (header[2] & 1u) != 0u};

    for (uint32_t i = 0u; i < 255u; i++) {
        if (i < header[1]) {
            frame.payload[i] = mavlink->payload[i];
        }
    }
    if (frame.is_signed) {
        frame.link = mavlink->tail[2];
        frame.timestamp = number(&mavlink->tail[3], 6u);
        for (uint32_t i = 0u; i < 6u; i++) {
            frame.seal[i] = mavlink->tail[9u + i];
        }
    }
    return frame;
}

/* MAV-008: the byte is held, and counts for the checksum unless it is of that, or behind it. */
static void keep(keel_mavlink_t *mavlink, uint8_t byte)
{
    const uint32_t at = mavlink->held;

    const uint32_t length = mavlink->header[1];
    const bool is_header = at < 10u;
    const bool is_payload = !is_header && ((at - 10u) < length);

    if (is_header) {
        mavlink->header[at] = byte;
    } else if (is_payload) {
        mavlink->payload[at - 10u] = byte;
    } else {
        mavlink->tail[at - (10u + length)] = byte;
    }
    mavlink->held = (uint16_t)(at + 1u);
    if (at == 0u) {
        mavlink->crc = 0xFFFFu;
    } else if (is_header || is_payload) {
        mavlink->crc = model_crc16(mavlink->crc, byte);
    }
}

/* MAV-008: what is no beginning is not held. */
static void begin_with(keel_mavlink_t *mavlink, uint8_t byte)
{
    if (byte == 0xFDu) {
        keep(mavlink, byte);
    } else {
        tally(&mavlink->count.others);
    }
}

/* MAV-009: the search goes on at the second byte, and then at the third. */
static void begin_again(keel_mavlink_t *mavlink)
{
    const uint8_t second = mavlink->header[1];
    const uint8_t third = mavlink->header[2];

    tally(&mavlink->count.flags);
    mavlink->held = 0u;
    begin_with(mavlink, second);
    if (mavlink->held == 1u) {
        keep(mavlink, third);
    } else {
        begin_with(mavlink, third);
    }
}

/* MAV-004, MAV-007: the place of the message that the header names, if it may be so long. */
static void look_up(keel_mavlink_t *mavlink)
{
    const uint32_t id = (uint32_t)number(&mavlink->header[7], 3u);
    uint32_t place = mavlink->known;

    for (uint32_t i = 0u; i < mavlink->known; i++) {
        if (mavlink->messages[i].id == id) {
            place = i;
        }
    }
    mavlink->message = mavlink->known;
    if (place == mavlink->known) {
        tally(&mavlink->count.unknown);
    } else if ((mavlink->messages[place].shortest <= mavlink->header[1]) &&
               (mavlink->header[1] <= mavlink->messages[place].longest)) {
        mavlink->message = place;
    } else {
        tally(&mavlink->count.lengths);
    }
}

/* MAV-004, MAV-006 */
static bool finish_frame(keel_mavlink_t *mavlink)
{
    mavlink->held = 0u;
    if (mavlink->message == mavlink->known) {
        return false;
    }
    if (number(mavlink->tail, 2u) !=
        model_crc16(mavlink->crc, mavlink->messages[mavlink->message].crc_extra)) {
        tally(&mavlink->count.checksums);
        return false;
    }
    mavlink->frame = model_mavlink_frame(mavlink);
    tally(&mavlink->count.frames);
    return true;
}

bool model_mavlink_take(keel_mavlink_t *mavlink, uint8_t byte)
{
    if (mavlink->held == 0u) {
        begin_with(mavlink, byte);
        return false;
    }
    keep(mavlink, byte);
    if ((mavlink->held == 3u) && (mavlink->header[2] >= 2u)) {
        begin_again(mavlink);
    }
    if (mavlink->held == 10u) {
        look_up(mavlink);
    }
    if ((mavlink->held >= 12u) && (mavlink->held == model_mavlink_whole(mavlink->header))) {
        return finish_frame(mavlink);
    }
    return false;
}

/* MAV-010 */
void model_mavlink_gap(keel_mavlink_t *mavlink)
{
    if (mavlink->held != 0u) {
        tally(&mavlink->count.gaps);
    }
    mavlink->held = 0u;
}

/* MAV-012: up to the last byte that is not 0, or the first of all. */
static uint32_t sent_bytes(const uint8_t *payload, uint32_t length)
{
    uint32_t sent = 1u;

    for (uint32_t i = 0u; i < length; i++) {
        if (payload[i] != 0u) {
            sent = i + 1u;
        }
    }
    return sent;
}

/* MAV-011 to MAV-013 */
uint16_t model_mavlink_write(keel_mavlink_sender_t *sender, const keel_mavlink_message_t *message,
                             const uint8_t *payload, uint8_t length, keel_mavlink_packet_t *packet)
{
    const uint32_t sent = sent_bytes(payload, length);
    const uint32_t whole = 12u + sent + (sender->is_signing ? 13u : 0u);
    const uint8_t header[10] = {0xFDu,
                                (uint8_t)sent,
                                sender->is_signing ? 1u : 0u,
                                0u,
                                sender->sequence,
                                sender->system,
                                sender->component,
                                (uint8_t)(message->id % 256u),
                                (uint8_t)((message->id / 256u) % 256u),
                                (uint8_t)((message->id / 65536u) % 256u)};
    uint16_t checksum;

    if ((length == 0u) || (length > message->longest) || (message->id >= 16777216u)) {
        return 0u;
    }
    for (uint32_t i = 0u; i < whole; i++) {
        packet->bytes[i] = (i < 10u) ? header[i] : ((i < (10u + sent)) ? payload[i - 10u] : 0u);
    }
    checksum = model_mavlink_checksum(packet->bytes, message->crc_extra);
    packet->bytes[10u + sent] = (uint8_t)(checksum % 256u);
    packet->bytes[11u + sent] = (uint8_t)(checksum / 256u);
    sender->sequence = (uint8_t)((sender->sequence + 1u) % 256u);
    return (uint16_t)whole;
}
