// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 281 --external-sat-solver cadical
// checks: assertions
// sources: src/middleware/mavlink.c src/middleware/crc.c specs/model/mavlink.c specs/model/crc.c
// covers: keel_mavlink_write cut_of checksum_of model_mavlink_checksum
//
// Chosen senders, messages and payloads, each in a case of its own, and the frames that are to be
// written. All senders and messages are dealt with in the other harnesses; wrong bodies are refuted
// at once here.
#include "mavlink_contracts.h"

#define PAYLOAD 24u
#define FRAME   64u
#define POINTS  19u

/* What is passed to keel_mavlink_write, from which byte of the payload on those before the last
 * are 0, and how many of them are to be sent: none when the frame is to be refused. */
typedef struct {
    uint32_t id;
    uint8_t longest;
    uint8_t length;
    uint8_t zeros;
    uint8_t first_zero;
    uint8_t sequence;
    bool is_signing;
    uint8_t sent;
} point_t;

/* Refused: of no length, too long, or of an id that is none. Written: as long as may be, with
 * zeros at the end, in the middle, at the beginning, and alone; signed and not. */
static const point_t points[POINTS] = {
    {.id = 0x123456u, .longest = 9u, .length = 0u, .sent = 0u},
    {.id = 0x123456u, .longest = 9u, .length = 10u, .sent = 0u},
    {.id = 0x123456u, .longest = 0u, .length = 1u, .sent = 0u},
    {.id = 0x1000000u, .longest = 9u, .length = 7u, .sent = 0u},
    {.id = 0xFFFFFFFFu, .longest = 9u, .length = 7u, .sent = 0u},
    {.id = 0xFFFFFFu, .longest = 9u, .length = 7u, .sequence = 126u, .sent = 7u},
    {.id = 0x123456u, .longest = 9u, .length = 9u, .sequence = 255u, .sent = 9u},
    {.id = 0x123456u, .longest = 9u, .length = 8u, .is_signing = true, .sent = 8u},
    {.id = 0x123456u, .longest = 255u, .length = 24u, .is_signing = true, .sent = 24u},
    {.id = 0x123456u, .longest = 9u, .length = 1u, .sequence = 254u, .sent = 1u},
    {.id = 0x123456u, .longest = 1u, .length = 1u, .zeros = 1u, .sent = 1u},
    {.id = 0x123456u, .longest = 9u, .length = 2u, .zeros = 1u, .first_zero = 1u, .sent = 1u},
    {.id = 0x123456u, .longest = 9u, .length = 2u, .zeros = 2u, .sent = 1u},
    {.id = 0x123456u, .longest = 9u, .length = 7u, .zeros = 7u, .is_signing = true, .sent = 1u},
    {.id = 0x123456u, .longest = 9u, .length = 7u, .zeros = 6u, .first_zero = 1u, .sent = 1u},
    {.id = 0x123456u, .longest = 9u, .length = 7u, .zeros = 6u, .sent = 7u},
    {.id = 0x123456u, .longest = 9u, .length = 7u, .zeros = 3u, .first_zero = 4u, .sent = 4u},
    {.id = 0x123456u, .longest = 9u, .length = 7u, .zeros = 2u, .first_zero = 3u, .sent = 7u},
    {.id = 0x123456u, .longest = 9u, .length = 7u, .zeros = 1u, .first_zero = 6u, .sent = 6u}};

static void make_payload(const point_t *point, uint8_t *payload)
{
    for (uint32_t i = 0u; i < PAYLOAD; i++) {
        const bool is_zero = (i >= point->first_zero) &&
                             (i < ((uint32_t)point->first_zero + point->zeros));

        payload[i] = is_zero ? 0u : (uint8_t)(((37u * i) + 11u) & 0xFFu);
    }
}

/* How many bytes are to be written, and which. */
static uint32_t expect(const point_t *point, const uint8_t *payload, uint8_t extra, uint8_t *frame)
{
    const uint32_t end = 10u + (uint32_t)point->sent;
    const uint8_t header[10] = {0xFDu,
                                point->sent,
                                point->is_signing ? 1u : 0u,
                                0u,
                                point->sequence,
                                3u,
                                191u,
                                (uint8_t)(point->id & 0xFFu),
                                (uint8_t)((point->id >> 8u) & 0xFFu),
                                (uint8_t)((point->id >> 16u) & 0xFFu)};
    uint16_t checksum;

    if (point->sent == 0u) {
        return 0u;
    }
    for (uint32_t i = 0u; i < end; i++) {
        frame[i] = (i < 10u) ? header[i] : payload[i - 10u];
    }
    checksum = model_mavlink_checksum(frame, extra);
    frame[end] = (uint8_t)(checksum & 0xFFu);
    frame[end + 1u] = (uint8_t)((uint32_t)checksum >> 8u);
    for (uint32_t i = 0u; point->is_signing && (i < 13u); i++) {
        frame[end + 2u + i] = 0u;
    }
    return end + 2u + (point->is_signing ? 13u : 0u);
}

void keel_mavlink_write__points_harness(void)
{
    for (uint32_t number = 0u; number < POINTS; number++) {
        const point_t *const point = &points[number];
        const keel_mavlink_message_t message = {
            .id = point->id, .crc_extra = 0x9Du, .shortest = 2u, .longest = point->longest};
        const keel_mavlink_sender_t before = {3u, 191u, point->sequence, point->is_signing};
        keel_mavlink_sender_t sender = before;
        keel_mavlink_sender_t after = before;
        keel_mavlink_packet_t packet;
        uint8_t payload[PAYLOAD];
        uint8_t frame[FRAME];
        uint32_t expected;
        uint32_t written;

        for (uint32_t i = 0u; i < FRAME; i++) {
            packet.bytes[i] = 0xA5u;
            frame[i] = 0xA5u;
        }
        make_payload(point, payload);
        expected = expect(point, payload, message.crc_extra, frame);
        if (expected > 0u) {
            after.sequence = (uint8_t)((before.sequence + 1u) & 0xFFu);
        }

        written = keel_mavlink_write(&sender, &message, payload, point->length, &packet);

        __CPROVER_assert(written == expected, "MAV_011_points: as many bytes as are expected");
        for (uint32_t i = 0u; i < FRAME; i++) {
            __CPROVER_assert(packet.bytes[i] == frame[i],
                             "MAV_012_points: every byte is what is expected, or as it was");
        }
        __CPROVER_assert(mavlink_sender_same(&sender, &after),
                         "MAV_013_points: the sequence is counted when a frame is written");
    }
}
