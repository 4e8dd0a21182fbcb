// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 282
// checks: assertions
// sources: src/middleware/mavlink.c specs/model/mavlink_drop.c
// covers: keel_mavlink_drop count_met
//
// Chosen numbers of bytes that are held and dropped, up to all that fit, with a beginning at chosen
// places: the same as the model's. Faults that only many bytes show are refuted here;
// keel_mavlink_drop_harness has any up to 8.
#include "every_byte.h"

typedef struct {
    uint16_t held;
    uint16_t count;
    uint16_t first; /* Where a beginning is; 0: at the first byte alone. */
    uint32_t others;
} point_t;

#define POINTS 14u

static const point_t point[POINTS] = {
    {280u, 1u, 0u, 0u},     {280u, 1u, 279u, 5u},
    {280u, 100u, 150u, 7u}, {280u, 280u, 0u, 9u},
    {280u, 279u, 279u, 1u}, {280u, 17u, 16u, UINT32_MAX - 3u},
    {65u, 3u, 64u, 0u},     {66u, 64u, 65u, UINT32_MAX},
    {20u, 1u, 0u, 2u},      {17u, 5u, 16u, 3u},
    {9u, 9u, 0u, 4u},       {40u, 1u, 3u, 0u},
    {5u, 2u, 4u, 0u},       {1u, 1u, 0u, 6u},
};

static keel_mavlink_t decoder_of(const point_t *one)
{
    keel_mavlink_t made = {.known = 3u, .messages = table.messages, .held = one->held};

    for (uint32_t i = 1u; i < KEEL_MAVLINK_FRAME_MAX; i++) {
        made.bytes[i] = (uint8_t)(((i * 11u) + (i / 23u)) & 0x7Fu);
    }
    made.bytes[0] = 0xFDu;
    made.bytes[one->first] = 0xFDu;
    made.awaited = 30u;
    made.message = 1u;
    made.count.others = one->others;
    return made;
}

void keel_mavlink_drop__points_harness(void)
{
    for (uint32_t i = 0u; i < POINTS; i++) {
        keel_mavlink_t mavlink = decoder_of(&point[i]);
        keel_mavlink_t model = mavlink;

        model_mavlink_drop(&model, point[i].count);

        keel_mavlink_drop(&mavlink, point[i].count);

        __CPROVER_assert(every_byte_same(&mavlink, &model),
                         "MAV_016_model: every field is what the model says");
    }
}
