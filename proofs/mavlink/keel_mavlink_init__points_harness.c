// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 281 --external-sat-solver cadical
// checks: assertions
// sources: src/middleware/mavlink.c src/middleware/crc.c specs/model/mavlink.c specs/model/crc.c
// covers: keel_mavlink_init is_table model_mavlink_init in_order
//
// Chosen tables, among them a full one and one that is too long, for a decoder of which no field
// is what it becomes: the same as the model's. Any table of 3 messages is dealt with in
// keel_mavlink_init_harness; wrong bodies are refuted at once here.
#include "mavlink_proof.h"

#define POINTS 14u

/* How many messages there are, and which of them becomes what. */
typedef struct {
    uint32_t known;
    uint32_t place;
    keel_mavlink_message_t message;
} point_t;

/* None, one, and all; ids that are the same or descend at either end, and that are or are not one;
 * ranges of one length and of none; as many as there may be, and one more. */
static const point_t points[POINTS] = {
    {0u, 0u, {.id = 9u, .shortest = 2u, .longest = 1u}},
    {1u, 0u, {.id = 0u, .shortest = 2u, .longest = 2u}},
    {1u, 1u, {.id = 9u, .shortest = 2u, .longest = 1u}},
    {1u, 0u, {.id = 9u, .shortest = 2u, .longest = 1u}},
    {1u, 0u, {.id = 0x1000000u, .shortest = 1u, .longest = 2u}},
    {3u, 2u, {.id = 0xFFFFFFu, .shortest = 0u, .longest = 255u}},
    {3u, 2u, {.id = 0x1000000u, .shortest = 0u, .longest = 255u}},
    {3u, 1u, {.id = 10u, .shortest = 1u, .longest = 2u}},
    {3u, 1u, {.id = 9u, .shortest = 1u, .longest = 2u}},
    {3u, 1u, {.id = 30u, .shortest = 1u, .longest = 2u}},
    {3u, 1u, {.id = 31u, .shortest = 1u, .longest = 2u}},
    {3u, 2u, {.id = 30u, .shortest = 255u, .longest = 254u}},
    {256u, 0u, {.id = 9u, .shortest = 7u, .longest = 7u}},
    {257u, 0u, {.id = 9u, .shortest = 7u, .longest = 7u}}};

/* Ids that are all the same. */
static const keel_mavlink_message_t many[257];

static const keel_mavlink_message_t *table_of(const point_t *point)
{
    for (uint32_t i = 0u; i < MESSAGES; i++) {
        table[i].id = 10u * (i + 1u);
        table[i].crc_extra = 0x9Du;
        table[i].shortest = 1u;
        table[i].longest = 9u;
    }
    table[point->place] = point->message;
    return (point->known > MESSAGES) ? many : table;
}

/* One that is in the middle of something. */
static keel_mavlink_t used(void)
{
    keel_mavlink_t mavlink = {.messages = many,
                              .known = MESSAGES,
                              .frame = {.id = 0x010203u,
                                        .sequence = 4u,
                                        .system = 5u,
                                        .component = 6u,
                                        .compatible = 7u,
                                        .length = 8u,
                                        .checksum = 9u,
                                        .is_signed = true,
                                        .link = 10u,
                                        .timestamp = 11u},
                              .count = {12u, 13u, 14u, 15u, 16u, 17u, 18u},
                              .held = 19u,
                              .crc = 20u,
                              .message = 2u};

    for (uint32_t i = 0u; i < KEEL_MAVLINK_HEADER_BYTES; i++) {
        mavlink.header[i] = (uint8_t)(30u + i);
    }
    for (uint32_t i = 0u; i < KEEL_MAVLINK_PAYLOAD_MAX; i++) {
        mavlink.payload[i] = (uint8_t)(i + 1u);
        mavlink.frame.payload[i] = (uint8_t)(255u - i);
    }
    for (uint32_t i = 0u; i < KEEL_MAVLINK_TAIL_MAX; i++) {
        mavlink.tail[i] = (uint8_t)(50u + i);
    }
    for (uint32_t i = 0u; i < KEEL_MAVLINK_SEAL_BYTES; i++) {
        mavlink.frame.seal[i] = (uint8_t)(70u + i);
    }
    return mavlink;
}

void keel_mavlink_init__points_harness(void)
{
    const uint32_t at = any_below(KEEL_MAVLINK_PAYLOAD_MAX);
    for (unsigned number = 0u; number < POINTS; number++) {
        keel_mavlink_t mavlink = used();
        keel_mavlink_t model = mavlink;
        const keel_mavlink_message_t *known;
        keel_status_t expected;
        keel_status_t status;

        known = table_of(&points[number]);
        expected = model_mavlink_init(&model, known, points[number].known);

        status = keel_mavlink_init(&mavlink, known, points[number].known);

        __CPROVER_assert(status == expected, "MAV_001_points: taken or refused as the model says");
        __CPROVER_assert(mavlink_same(&mavlink, &model, at),
                         "MAV_002_points: every field is what the model says");
    }
}
