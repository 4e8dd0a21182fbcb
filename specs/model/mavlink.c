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
    mavlink->message = known;
    mavlink->awaited = 10u;
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
keel_mavlink_frame_t model_mavlink_frame(const uint8_t *bytes)
{
    const uint8_t *tail = &bytes[10u + bytes[1]];
    keel_mavlink_frame_t frame = {.id = (uint32_t)number(&bytes[7], 3u),
                                  .sequence = bytes[4],
                                  .system = bytes[5],
                                  .component = bytes[6],
                                  .compatible = bytes[3],
                                  .length = bytes[1],
                                  .checksum = (uint16_t)number(tail, 2u),
                                  .is_signed = (bytes[2] & 1u) != 0u};

    for (uint32_t i = 0u; i < 255u; i++) {
        if (i < bytes[1]) {
            frame.payload[i] = bytes[10u + i];
        }
    }
    if (frame.is_signed) {
        frame.link = tail[2];
        frame.timestamp = number(&tail[3], 6u);
        for (uint32_t i = 0u; i < 6u; i++) {
            frame.seal[i] = tail[9u + i];
        }
    }
    return frame;
}

/* MAV-008 */
keel_status_t model_mavlink_take(keel_mavlink_t *mavlink, uint8_t byte)
{
    if (mavlink->held == 280u) {
        return KEEL_ERR_FULL;
    }
    if ((mavlink->held > 0u) || (byte == 0xFDu)) {
        mavlink->bytes[mavlink->held] = byte;
        mavlink->held = (uint16_t)(mavlink->held + 1u);
    } else {
        tally(&mavlink->count.others);
    }
    return KEEL_OK;
}

/* MAV-004: the place of the message with this id, or how many there are. */
static uint32_t find(const keel_mavlink_t *mavlink, uint32_t id)
{
    for (uint32_t i = 0u; i < mavlink->known; i++) {
        if (mavlink->messages[i].id == id) {
            return i;
        }
    }
    return mavlink->known;
}

/* MAV-004, MAV-007, MAV-009: whether the header is of a frame that may be right. */
static bool may_be(keel_mavlink_t *mavlink)
{
    const uint32_t place = find(mavlink, (uint32_t)number(&mavlink->bytes[7], 3u));

    if (mavlink->bytes[2] >= 2u) {
        tally(&mavlink->count.flags);
        return false;
    }
    if (place == mavlink->known) {
        tally(&mavlink->count.unknown);
        return false;
    }
    if ((mavlink->bytes[1] < mavlink->messages[place].shortest) ||
        (mavlink->bytes[1] > mavlink->messages[place].longest)) {
        tally(&mavlink->count.lengths);
        return false;
    }
    mavlink->message = place;
    return true;
}

/* MAV-004, MAV-006: whether the frame is right; if so, it is told. */
static bool is_taken(keel_mavlink_t *mavlink)
{
    const keel_mavlink_frame_t frame = model_mavlink_frame(mavlink->bytes);

    if (frame.checksum !=
        model_mavlink_checksum(mavlink->bytes, mavlink->messages[mavlink->message].crc_extra)) {
        tally(&mavlink->count.checksums);
        return false;
    }
    tally(&mavlink->count.frames);
    mavlink->frame = frame;
    return true;
}

keel_mavlink_look_t model_mavlink_look(keel_mavlink_t *mavlink)
{
    if (mavlink->held < mavlink->awaited) {
        return KEEL_MAVLINK_NOTHING;
    }
    if (mavlink->awaited == 10u) {
        if (may_be(mavlink)) {
            mavlink->awaited = (uint16_t)model_mavlink_whole(mavlink->bytes);
        } else {
            model_mavlink_drop(mavlink, 1u);
        }
        return KEEL_MAVLINK_AGAIN;
    }
    if (is_taken(mavlink)) {
        model_mavlink_drop(mavlink, mavlink->awaited);
        return KEEL_MAVLINK_FRAME;
    }
    model_mavlink_drop(mavlink, 1u);
    return KEEL_MAVLINK_AGAIN;
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
