/* SPDX-License-Identifier: Apache-2.0 */
/* MAVLink's frames beside their executable specification (specs/model): random frames, disturbed
 * and not, to both decoders; after each byte and look every field must be the same. What is written
 * must be, too. */
#include "any.h"
#include "keel/middleware/mavlink.h"
#include "unity.h"

#include <string.h>

/* The model is part of this test: the kernel that it is linked with has none. */
#include "../../specs/model/crc.c"
#include "../../specs/model/mavlink.c"
#include "../../specs/model/mavlink_drop.c"
#include "../../specs/model/mavlink_gap.c"

#define FRAMES 6000u
#define SEED   20261125u
#define KNOWN  20u

static const keel_mavlink_message_t messages[KNOWN] = {
    {.id = 0u, .crc_extra = 50u, .shortest = 1u, .longest = 9u},
    {.id = 30u, .crc_extra = 39u, .shortest = 20u, .longest = 28u},
    {.id = 253u, .crc_extra = 83u, .shortest = 0u, .longest = 255u},
    {.id = 300u, .crc_extra = 217u, .shortest = 1u, .longest = 255u},
    {.id = 301u, .crc_extra = 1u, .shortest = 1u, .longest = 13u},
    {.id = 302u, .crc_extra = 2u, .shortest = 3u, .longest = 3u},
    {.id = 303u, .crc_extra = 3u, .shortest = 1u, .longest = 34u},
    {.id = 511u, .crc_extra = 4u, .shortest = 1u, .longest = 255u},
    {.id = 512u, .crc_extra = 5u, .shortest = 0u, .longest = 1u},
    {.id = 513u, .crc_extra = 6u, .shortest = 1u, .longest = 128u},
    {.id = 0x1234u, .crc_extra = 7u, .shortest = 2u, .longest = 37u},
    {.id = 0x3412u, .crc_extra = 8u, .shortest = 1u, .longest = 200u},
    {.id = 0xFFFFu, .crc_extra = 9u, .shortest = 1u, .longest = 42u},
    {.id = 0x10000u, .crc_extra = 10u, .shortest = 1u, .longest = 64u},
    {.id = 0x10001u, .crc_extra = 11u, .shortest = 1u, .longest = 254u},
    {.id = 0x20000u, .crc_extra = 12u, .shortest = 5u, .longest = 31u},
    {.id = 0x7FFFFFu, .crc_extra = 13u, .shortest = 1u, .longest = 33u},
    {.id = 0x800000u, .crc_extra = 14u, .shortest = 1u, .longest = 255u},
    {.id = 0xFFFFFEu, .crc_extra = 15u, .shortest = 1u, .longest = 16u},
    {.id = 0xFFFFFFu, .crc_extra = 255u, .shortest = 1u, .longest = 40u},
};

static keel_mavlink_t mavlink;
static keel_mavlink_t model;
static uint32_t taken;

void setUp(void)
{
    any_from(SEED);
    memset(&mavlink, 0, sizeof mavlink);
    memset(&model, 0, sizeof model);
    taken = 0u;
}

void tearDown(void)
{
}

static void set_up(void)
{
    const uint32_t known = one_in(2u) ? KNOWN : (any() % (KNOWN + 1u));

    memset(&mavlink, 0, sizeof mavlink);
    memset(&model, 0, sizeof model);
    TEST_ASSERT_EQUAL(KEEL_OK, model_mavlink_init(&model, messages, known));
    TEST_ASSERT_EQUAL(KEEL_OK, keel_mavlink_init(&mavlink, messages, known));
    if (one_in(8u)) {
        memset(&mavlink.count, 0xFF, sizeof mavlink.count);
        memset(&model.count, 0xFF, sizeof model.count);
    }
}

static void compare(void)
{
    TEST_ASSERT_EQUAL_MEMORY(&model, &mavlink, sizeof mavlink);
}

/* One look of each, or what both do at a gap. */
static keel_mavlink_look_t both_look(bool is_gap)
{
    const keel_mavlink_look_t expected = is_gap ? model_mavlink_gap(&model)
                                                : model_mavlink_look(&model);

    TEST_ASSERT_EQUAL(expected, is_gap ? keel_mavlink_gap(&mavlink) : keel_mavlink_look(&mavlink));
    compare();
    taken += (expected == KEEL_MAVLINK_FRAME) ? 1u : 0u;
    return expected;
}

/* Sometimes without a look, so that bytes wait; where there is no room, both say so. */
static void both_take(uint8_t byte)
{
    TEST_ASSERT_EQUAL(model_mavlink_take(&model, byte), keel_mavlink_take(&mavlink, byte));
    compare();
    while (!one_in(64u) && (both_look(false) != KEEL_MAVLINK_NOTHING)) {
    }
}

static void any_bytes(uint8_t *bytes, uint32_t count)
{
    for (uint32_t i = 0u; i < count; i++) {
        bytes[i] = (uint8_t)(one_in(3u) ? 0u : (one_in(8u) ? 0xFDu : any()));
    }
}

/* A frame as it is specified, and the same as the unit writes it. */
static uint32_t any_frame(uint8_t *frame)
{
    const keel_mavlink_message_t *message = &messages[any() % KNOWN];
    keel_mavlink_sender_t sender = {(uint8_t)any(), (uint8_t)any(), (uint8_t)any(), one_in(4u)};
    keel_mavlink_sender_t model_sender = sender;
    const uint8_t length = (uint8_t)(one_in(8u) ? any() : (1u + (any() % message->longest)));
    uint8_t payload[255];
    keel_mavlink_packet_t packet;
    keel_mavlink_packet_t expected;
    uint32_t whole;

    any_bytes(payload, 255u);
    any_bytes(packet.bytes, 280u);
    expected = packet;
    whole = model_mavlink_write(&model_sender, message, payload, length, &expected);
    TEST_ASSERT_EQUAL_UINT16(whole, keel_mavlink_write(&sender, message, payload, length, &packet));
    TEST_ASSERT_EQUAL_MEMORY(&expected, &packet, sizeof packet);
    TEST_ASSERT_EQUAL_MEMORY(&model_sender, &sender, sizeof sender);
    memcpy(frame, packet.bytes, sizeof packet);
    return whole;
}

static void MAV_003_each_byte_is_as_specified(void)
{
    for (uint32_t n = 0u; n < FRAMES; n++) {
        uint8_t frame[280];
        const uint32_t whole = any_frame(frame);

        if ((n % 64u) == 0u) {
            set_up();
        }
        for (uint32_t i = 0u; i < whole; i++) {
            if (one_in(512u)) {
                both_take((uint8_t)(one_in(2u) ? 0xFDu : any()));
            }
            if (!one_in(512u)) {
                both_take((uint8_t)(one_in(256u) ? any() : frame[i]));
            }
        }
        if (one_in(2u)) {
            while (both_look(true) != KEEL_MAVLINK_NOTHING) {
            }
        }
    }
    TEST_ASSERT_TRUE(taken > (FRAMES / 10u));
}

static void MAV_003_noise_is_as_specified(void)
{
    const uint8_t often[4] = {0xFD, 0x00, 0x01, 0xFD};

    set_up();
    for (uint32_t n = 0u; n < (FRAMES * 40u); n++) {
        both_take(one_in(2u) ? often[any() % 4u] : (uint8_t)any());
    }
}

static void MAV_001_each_table_is_as_specified(void)
{
    for (uint32_t n = 0u; n < 20000u; n++) {
        keel_mavlink_message_t table[24];
        const uint32_t known = one_in(16u) ? (257u + (any() % 8u)) : (any() % 25u);
        const uint32_t wrong = any() % 24u; /* There and behind it one may be wrong. */

        for (uint32_t i = 0u; i < 24u; i++) {
            const bool is_right = i < wrong;

            table[i].id = (is_right || !one_in(16u)) ? ((i * 2u) + (any() % (is_right ? 2u : 3u)))
                                                     : any();
            table[i].crc_extra = (uint8_t)any();
            table[i].shortest = (uint8_t)((is_right || !one_in(8u)) ? 1u : any());
            table[i].longest = (uint8_t)(is_right ? (1u + (any() % 255u)) : any());
        }
        TEST_ASSERT_EQUAL(model_mavlink_init(&model, table, known),
                          keel_mavlink_init(&mavlink, table, known));
        compare();
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(MAV_003_each_byte_is_as_specified);
    RUN_TEST(MAV_003_noise_is_as_specified);
    RUN_TEST(MAV_001_each_table_is_as_specified);
    return UNITY_END();
}
