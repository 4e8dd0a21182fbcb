// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 282
// checks: assertions
// sources: src/middleware/mavlink.c specs/model/mavlink.c specs/model/mavlink_drop.c
// replaces: keel_crc16
// covers: keel_mavlink_look id_in checksum_in end_of whole_frame place_of checksum_of
// covers: read_header publish_payload publish_signature publish_frame end_frame
//
// Chosen payloads of up to 255 bytes, and a table of 256 messages: the same as the model's, with
// the bytes that are dropped. Faults that only a long frame or a late message shows are refuted
// here; keel_mavlink_look_harness has every payload of up to 32 bytes and every table of up to 4
// messages.
#include "every_byte.h"

#define ASKED (10u + KEEL_MAVLINK_PAYLOAD_MAX)
#include "told_crc_steps.h"

typedef struct {
    uint8_t length;
    uint8_t flags;
    uint16_t place; /* in the table; 256: in none */
    uint16_t known;
    uint16_t held;
    bool whole; /* a whole frame, or its header alone */
    bool right; /* with the right checksum */
} point_t;

#define POINTS 14u

static const point_t point[POINTS] = {
    {255u, 1u, 255u, 256u, 280u, true, true},   {255u, 0u, 70u, 256u, 280u, true, true},
    {200u, 1u, 3u, 200u, 280u, true, true},     {64u, 0u, 64u, 65u, 280u, true, true},
    {65u, 1u, 65u, 256u, 280u, true, true},     {63u, 0u, 63u, 64u, 280u, true, true},
    {255u, 0u, 255u, 256u, 280u, true, false},  {100u, 1u, 9u, 20u, 280u, true, false},
    {255u, 1u, 255u, 256u, 280u, false, false}, {80u, 0u, 130u, 131u, 280u, false, false},
    {80u, 0u, 130u, 130u, 280u, false, false},  {9u, 1u, 256u, 256u, 280u, false, false},
    {30u, 2u, 5u, 256u, 280u, false, false},    {1u, 0u, 71u, 90u, 9u, false, false},
};

static void choose_table(void)
{
    for (uint32_t i = 0u; i < KEEL_MAVLINK_MESSAGES_MAX; i++) {
        table.messages[i].id = i * 300u;
        table.messages[i].shortest = (uint8_t)(i & 7u);
        table.messages[i].longest = (uint8_t)(255u - ((i & 8u) >> 3u));
        table.messages[i].crc_extra = (uint8_t)i;
    }
}

/* A decoder that holds the frame and some bytes more. */
static keel_mavlink_t decoder_of(const point_t *one)
{
    const uint32_t id = (uint32_t)one->place * 300u;
    const uint32_t end = 10u + (uint32_t)one->length;
    const uint32_t checksum = step_after(end) ^ (one->right ? 0u : 0x100u);
    keel_mavlink_t made = {.known = one->known, .messages = table.messages, .held = one->held};

    for (uint32_t i = 3u; i < KEEL_MAVLINK_FRAME_MAX; i++) {
        made.bytes[i] = (uint8_t)(((i * 11u) + (i / 23u)) & 0xFFu);
    }
    made.bytes[0] = 0xFDu;
    made.bytes[1] = one->length;
    made.bytes[2] = one->flags;
    made.bytes[7] = (uint8_t)(id & 0xFFu);
    made.bytes[8] = (uint8_t)((id >> 8u) & 0xFFu);
    made.bytes[9] = (uint8_t)(id >> 16u);
    made.bytes[end] = (uint8_t)(checksum & 0xFFu);
    made.bytes[end + 1u] = (uint8_t)(checksum >> 8u);
    made.message = one->place;
    made.awaited = (uint16_t)(one->whole ? model_mavlink_whole(made.bytes) : 10u);
    return made;
}

void keel_mavlink_look__points_harness(void)
{
    choose_table();
    for (uint32_t i = 0u; i < POINTS; i++) {
        keel_mavlink_t mavlink = decoder_of(&point[i]);
        keel_mavlink_t model = mavlink;
        keel_mavlink_look_t expected;
        keel_mavlink_look_t seen;

        tell_steps();
        expected = model_mavlink_look(&model);

        tell_code();
        seen = keel_mavlink_look(&mavlink);

        __CPROVER_assert(seen == expected, "MAV_004_model: it finds what the model finds");
        __CPROVER_assert(!point[i].right || (seen == KEEL_MAVLINK_FRAME),
                         "MAV_004_right: a right frame is found");
        __CPROVER_assert(every_byte_same(&mavlink, &model),
                         "MAV_003_model: every field is what the model says");
    }
}
