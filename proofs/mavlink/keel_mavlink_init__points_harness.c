// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 282
// checks: assertions
// sources: src/middleware/mavlink.c src/middleware/crc.c specs/model/mavlink.c specs/model/crc.c
// covers: keel_mavlink_init is_table
//
// Tables of chosen lengths up to 257, right or with one message that is not: the same as the
// model's. A solver has keel_mavlink_init_harness, with every table; here none is needed.
#include "every_byte.h"

typedef enum {
    RIGHT,
    SAME_ID,  /* As the message before it. */
    LARGE_ID, /* Of 25 bits. */
    CROSSED   /* Its shortest payload is longer than the longest. */
} flaw_t;

typedef struct {
    uint32_t known;
    flaw_t flaw;
    uint32_t at; /* The message that has it. */
} point_t;

#define POINTS 9u

static const point_t point[POINTS] = {
    {256u, RIGHT, 0u},     {257u, RIGHT, 0u},   {255u, SAME_ID, 255u},
    {256u, SAME_ID, 255u}, {256u, CROSSED, 0u}, {256u, LARGE_ID, 255u},
    {66u, CROSSED, 65u},   {18u, SAME_ID, 17u}, {0u, CROSSED, 0u},
};

static void choose_table(void)
{
    for (uint32_t i = 0u; i < KEEL_MAVLINK_MESSAGES_MAX; i++) {
        table.messages[i].id = (i == 255u) ? 0xFFFFFFu : (i * 300u);
        table.messages[i].shortest = (uint8_t)i;
        table.messages[i].longest = (uint8_t)(i | 7u);
        table.messages[i].crc_extra = (uint8_t)(i * 3u);
    }
}

static void spoil(const point_t *one)
{
    if (one->flaw == SAME_ID) {
        table.messages[one->at].id = table.messages[one->at - 1u].id;
    } else if (one->flaw == LARGE_ID) {
        table.messages[one->at].id = 0x1000000u;
    } else if (one->flaw == CROSSED) {
        table.messages[one->at].longest = 6u;
        table.messages[one->at].shortest = 7u;
    } else {
        /* It is right. */
    }
}

void keel_mavlink_init__points_harness(void)
{
    choose_table();
    for (uint32_t i = 0u; i < POINTS; i++) {
        const keel_mavlink_message_t whole = table.messages[point[i].at];
        keel_mavlink_t mavlink = {.known = 77u, .held = 3u, .awaited = 50u, .message = 4u};
        keel_mavlink_t model;
        keel_status_t expected;
        keel_status_t status;

        spoil(&point[i]);
        for (uint32_t j = 0u; j < KEEL_MAVLINK_FRAME_MAX; j++) {
            mavlink.bytes[j] = (uint8_t)(j + 1u);
        }
        mavlink.count.frames = 8u;
        mavlink.frame.id = 5u;
        model = mavlink;
        expected = model_mavlink_init(&model, table.messages, point[i].known);

        status = keel_mavlink_init(&mavlink, table.messages, point[i].known);

        __CPROVER_assert(status == expected, "MAV_001_model: taken or refused as the model says");
        __CPROVER_assert(every_byte_same(&mavlink, &model),
                         "MAV_002_model: every field is what the model says");
        table.messages[point[i].at] = whole;
    }
}
