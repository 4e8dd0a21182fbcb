// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 282
// sources: src/middleware/mavlink.c src/middleware/crc.c specs/model/mavlink.c
// sources: specs/model/mavlink_drop.c specs/model/crc.c
// covers: keel_mavlink_look read_header place_of end_frame
//
// Headers whose length is at a limit of their message or one beyond it, and two short frames: the
// same as the model's. Faults that only large limits show are refuted here;
// keel_mavlink_look_harness has any limits, which only a solver meets.
#include "mavlink_contracts.h"

typedef struct {
    uint16_t place;
    uint16_t known;
    uint8_t length;
    uint8_t flags;
    uint8_t held;
    uint8_t awaited; /* the header, or the whole frame */
} point_t;

#define POINTS 14u

static const point_t point[POINTS] = {
    {70u, 71u, 69u, 0u, 10u, 10u},    {70u, 256u, 70u, 1u, 10u, 10u},
    {70u, 71u, 71u, 0u, 10u, 10u},    {70u, 256u, 72u, 0u, 10u, 10u},
    {255u, 256u, 254u, 0u, 10u, 10u}, {255u, 256u, 255u, 0u, 10u, 10u},
    {0u, 1u, 8u, 0u, 10u, 10u},       {17u, 256u, 16u, 0u, 10u, 10u},
    {17u, 18u, 17u, 2u, 10u, 10u},    {17u, 17u, 17u, 0u, 10u, 10u},
    {17u, 18u, 17u, 0u, 9u, 10u},     {88u, 89u, 88u, 0u, 70u, 100u},
    {0u, 1u, 0u, 0u, 12u, 12u},       {1u, 2u, 1u, 0u, 13u, 13u},
};

/* Message i takes payloads of i bytes up to the next multiple of 8 less one. */
static void choose_table(void)
{
    for (uint32_t i = 0u; i < KEEL_MAVLINK_MESSAGES_MAX; i++) {
        table.messages[i].id = i;
        table.messages[i].shortest = (uint8_t)i;
        table.messages[i].longest = (uint8_t)(i | 7u);
    }
}

/* The checksum is right when there is no payload. */
static keel_mavlink_t decoder_of(const point_t *one)
{
    keel_mavlink_t made = {.messages = table.messages,
                           .known = one->known,
                           .message = one->place,
                           .held = one->held,
                           .awaited = one->awaited};
    uint16_t checksum;

    made.bytes[0] = 0xFDu;
    made.bytes[1] = one->length;
    made.bytes[2] = one->flags;
    made.bytes[7] = (uint8_t)one->place;
    if (one->length == 0u) {
        checksum = model_mavlink_checksum(made.bytes, 0u);
        made.bytes[10] = (uint8_t)(checksum & 0xFFu);
        made.bytes[11] = (uint8_t)(checksum >> 8u);
    }
    return made;
}

void keel_mavlink_look__header_points_harness(void)
{
    choose_table();
    for (uint32_t i = 0u; i < POINTS; i++) {
        keel_mavlink_t mavlink = decoder_of(&point[i]);
        keel_mavlink_t model = mavlink;
        const keel_mavlink_look_t expected = model_mavlink_look(&model);

        const keel_mavlink_look_t seen = keel_mavlink_look(&mavlink);

        __CPROVER_assert(seen == expected, "MAV_004_model: it finds what the model finds");
        __CPROVER_assert(mavlink_same(&mavlink, &model, 1u),
                         "MAV_003_model: every field is what the model says");
    }
}
