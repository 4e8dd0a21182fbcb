// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 281 --external-sat-solver cadical
// checks: assertions
// sources: src/middleware/mavlink.c src/middleware/crc.c specs/model/mavlink.c specs/model/crc.c
// covers: keel_mavlink_take offer put_byte count_met id_in checksum_in end_of whole_frame place_of
// covers: check_flags check_message timestamp_in publish_payload publish_signature publish_frame
// covers: end_frame
// covers: model_mavlink_take begin_with keep begin_again look_up finish_frame tally number
// covers: model_mavlink_whole model_mavlink_frame
//
// Chosen frames, all bytes of each, one behind the other into one decoder: the same as the model's.
// Any byte for any decoder is dealt with in keel_mavlink_take_harness; wrong bodies are refuted at
// once here, as right frames are rare among arbitrary bytes.
#include "mavlink_proof.h"

#define POINTS 30u
#define LINE   64u

/* Bytes before a frame, the frame, and which byte of it comes wrong, if one does. */
typedef struct {
    uint8_t bytes[3];
    uint32_t before;
    uint32_t id;
    uint8_t extra;
    uint8_t flags;
    uint8_t length;
    uint32_t wrong;
} point_t;

static const keel_mavlink_message_t messages[MESSAGES] = {
    {.id = 0x010203u, .crc_extra = 0x32u, .shortest = 0u, .longest = 4u},
    {.id = 0x010302u, .crc_extra = 0x9Du, .shortest = 3u, .longest = 9u},
    {.id = 0x030201u, .crc_extra = 0xE7u, .shortest = 5u, .longest = 255u}};

/* Signed and not, the longest and the shortest; messages that differ from one in a single byte;
 * lengths at the ends of a range and beyond; a wrong byte in each part; unknown flags, and
 * beginnings of which the second or the third byte is one, too. */
static const point_t points[POINTS] = {
    {.id = 0x010302u, .extra = 0x9Du, .length = 6u},
    {.id = 0x010302u, .extra = 0x9Du, .length = 9u, .flags = 1u},
    {.id = 0x010302u, .extra = 0x9Du, .length = 3u},
    {.id = 0x010302u, .extra = 0x9Du, .length = 2u},
    {.id = 0x010302u, .extra = 0x9Du, .length = 10u, .flags = 1u},
    {.id = 0x010203u, .extra = 0x32u, .length = 0u},
    {.id = 0x010203u, .extra = 0x32u, .length = 0u, .flags = 1u},
    {.id = 0x010203u, .extra = 0x32u, .length = 4u},
    {.id = 0x010203u, .extra = 0x32u, .length = 5u},
    {.id = 0x030201u, .extra = 0xE7u, .length = 4u},
    {.id = 0x030201u, .extra = 0xE7u, .length = 5u, .flags = 1u},
    {.id = 0x030201u, .extra = 0xE7u, .length = 12u, .flags = 1u},
    {.id = 0x030201u, .extra = 0xE7u, .length = 5u},
    {.id = 0x010303u, .extra = 0x9Du, .length = 5u},
    {.id = 0x010202u, .extra = 0x9Du, .length = 5u, .flags = 1u},
    {.id = 0x020302u, .extra = 0x9Du, .length = 5u},
    {.id = 0x010302u, .extra = 0x9Du, .length = 5u, .wrong = 15u},
    {.id = 0x010302u, .extra = 0x9Du, .length = 5u, .wrong = 16u},
    {.id = 0x010302u, .extra = 0x9Du, .length = 5u, .wrong = 12u, .flags = 1u},
    {.id = 0x010302u, .extra = 0x9Du, .length = 5u, .wrong = 6u},
    {.id = 0x010302u, .extra = 0x9Cu, .length = 5u},
    {.id = 0x010302u, .extra = 0x9Du, .length = 5u, .before = 1u, .bytes = {0xFDu}},
    {.id = 0x010302u, .extra = 0x9Du, .length = 5u, .before = 2u, .bytes = {0xFDu, 0xFDu}},
    {.id = 0x010302u, .extra = 0x9Du, .length = 5u, .before = 2u, .bytes = {0xFDu, 5u}},
    {.id = 0x010302u, .extra = 0x9Du, .length = 5u, .before = 3u, .bytes = {0xFDu, 5u, 2u}},
    {.id = 0x010302u, .extra = 0x9Du, .length = 5u, .before = 3u, .bytes = {0xFCu, 0u, 0xFEu}},
    {.id = 0x010302u, .extra = 0x9Du, .length = 5u, .flags = 3u},
    {.id = 0x010302u, .extra = 0x9Du, .length = 5u, .flags = 128u},
    {.id = 0x010302u, .extra = 0x9Du, .length = 5u, .flags = 2u},
    {.id = 0x010302u, .extra = 0x9Du, .length = 7u, .flags = 1u}};

/* All of these bytes, in their order, those of a payload or a signature different from each other;
 * how many there are. */
static uint32_t make_line(const point_t *point, uint32_t number, uint8_t *line)
{
    const uint8_t header[10] = {0xFDu,
                                point->length,
                                point->flags,
                                (uint8_t)(0x40u + number),
                                (uint8_t)(0x80u + number),
                                (uint8_t)(17u + number),
                                (uint8_t)(191u + number),
                                (uint8_t)(point->id & 0xFFu),
                                (uint8_t)((point->id >> 8u) & 0xFFu),
                                (uint8_t)((point->id >> 16u) & 0xFFu)};
    const uint32_t end = 10u + (uint32_t)point->length;
    uint8_t *const frame = &line[point->before];
    uint16_t checksum;

    for (uint32_t i = 0u; i < point->before; i++) {
        line[i] = point->bytes[i];
    }
    for (uint32_t i = 0u; i < (end + 15u); i++) {
        frame[i] = (i < 10u) ? header[i] : (uint8_t)(((37u * i) + number) & 0xFFu);
    }
    checksum = model_mavlink_checksum(frame, point->extra);
    frame[end] = (uint8_t)(checksum & 0xFFu);
    frame[end + 1u] = (uint8_t)((uint32_t)checksum >> 8u);
    if (point->wrong > 0u) {
        frame[point->wrong] ^= 0x11u;
    }
    return point->before + end + 2u + ((point->flags == 1u) ? 13u : 0u);
}

void keel_mavlink_take__points_harness(void)
{
    const uint32_t at = any_below(KEEL_MAVLINK_PAYLOAD_MAX);
    keel_mavlink_t mavlink = {.messages = table, .known = MESSAGES, .message = 1u};
    keel_mavlink_t model;

    for (uint32_t i = 0u; i < MESSAGES; i++) {
        table[i] = messages[i];
    }
    mavlink.count.others = UINT32_MAX - 9u;
    model = mavlink;
    for (uint32_t number = 0u; number < POINTS; number++) {
        uint8_t line[LINE];
        const uint32_t count = make_line(&points[number], number, line);

        for (uint32_t i = 0u; i < count; i++) {
            const bool expected = model_mavlink_take(&model, line[i]);
            const bool right = keel_mavlink_take(&mavlink, line[i]);

            __CPROVER_assert(right == expected,
                             "MAV_004_points: a frame ends where the model says");
            __CPROVER_assert((mavlink.held == model.held) && (mavlink.crc == model.crc),
                             "MAV_008_points: as many bytes are held, and their checksum");
        }
        __CPROVER_assert(mavlink_count_same(&mavlink.count, &model.count),
                         "MAV_007_points: what is counted is what the model counts");
        if ((number % 3u) == 2u) { /* Of all of it there is much to compare. */
            __CPROVER_assert(mavlink_same(&mavlink, &model, at),
                             "MAV_005_points: every field is what the model says");
        }
    }
}
