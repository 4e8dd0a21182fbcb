/* SPDX-License-Identifier: Apache-2.0 */
/* Signatures beside their executable specification (specs/model): random frames, signed by whoever
 * has the key, by whoever has not, recorded and late, to both; after each call every field must be
 * the same. What is written must be, too, and accepted by whoever has the key. */
#include "any.h"
#include "keel/middleware/signing.h"
#include "unity.h"

#include <string.h>

/* The models are part of this test: the kernel that it is linked with has none. */
#include "../../specs/model/crc.c"
#include "../../specs/model/mavlink.c"
#include "../../specs/model/mavlink_drop.c"
#include "../../specs/model/signing.c"

#define CALLS 40000u
#define SEED  20261124u

static keel_signing_t signing;
static keel_signing_t model;
static keel_mavlink_sender_t sender;
static keel_mavlink_sender_t model_sender;
static uint32_t accepted;
static uint32_t written;

static const keel_mavlink_message_t messages[2] = {
    {.id = 0u, .crc_extra = 50u, .shortest = 1u, .longest = 9u},
    {.id = 0xFFFFFFu, .crc_extra = 217u, .shortest = 1u, .longest = 255u},
};

/* No hash to trust, but one in which every byte and the number of them count. */
static void hash(const uint8_t *data, uint32_t size, uint8_t *digest)
{
    uint32_t state = 2166136261u;

    for (uint32_t i = 0u; i < size; i++) {
        state = (state ^ data[i]) * 16777619u;
    }
    for (uint32_t i = 0u; i < 32u; i++) {
        state = (state ^ i) * 16777619u;
        digest[i] = (uint8_t)(state >> 24u);
    }
}

void setUp(void)
{
    any_from(SEED);
    memset(&signing, 0xA5, sizeof signing);
    memset(&model, 0x5A, sizeof model);
    keel_signing_init(&signing, 7u, hash);
    model_signing_init(&model, 7u, hash);
    sender = (keel_mavlink_sender_t){1u, 1u, 250u, false};
    model_sender = sender;
    accepted = 0u;
    written = 0u;
}

void tearDown(void)
{
}

static void compare(void)
{
    for (uint32_t i = 0u; i < 8u; i++) {
        TEST_ASSERT_EQUAL_UINT64(model.stream[i].timestamp, signing.stream[i].timestamp);
        TEST_ASSERT_EQUAL_UINT8(model.stream[i].system, signing.stream[i].system);
        TEST_ASSERT_EQUAL_UINT8(model.stream[i].component, signing.stream[i].component);
        TEST_ASSERT_EQUAL_UINT8(model.stream[i].link, signing.stream[i].link);
    }
    TEST_ASSERT_EQUAL_UINT32(model.streams, signing.streams);
    TEST_ASSERT_EQUAL_MEMORY(&model.count, &signing.count, sizeof model.count);
    TEST_ASSERT_TRUE(model.hash == signing.hash);
    TEST_ASSERT_EQUAL_UINT64(model.timestamp, signing.timestamp);
    TEST_ASSERT_EQUAL_MEMORY(model.text, signing.text, sizeof model.text);
    TEST_ASSERT_EQUAL_UINT8(model.link, signing.link);
    TEST_ASSERT_EQUAL(model.has_key, signing.has_key);
}

/* Around our time, and at both ends. */
static uint64_t any_time(void)
{
    const uint64_t around = model.timestamp + (any() % 12000010u);
    uint64_t timestamp = (around > 6000005u) ? (around - 6000005u) : 0u;

    if (one_in(256u)) {
        timestamp = 0xFFFFFFFFFFFFu - (any() % 4u);
    }
    return (timestamp > 0xFFFFFFFFFFFFu) ? 0xFFFFFFFFFFFFu : timestamp;
}

/* Signed with the key, unless chance will have it otherwise. */
static keel_mavlink_frame_t any_frame(void)
{
    keel_mavlink_frame_t frame = {
        .id = any() & 0xFFFFFFu,
        .sequence = (uint8_t)any(),
        .system = (uint8_t)(any() % 3u),
        .component = (uint8_t)(any() % 2u),
        .compatible = (uint8_t)any(),
        .length = (uint8_t)any(),
        .checksum = (uint16_t)any(),
        .is_signed = !one_in(16u),
        .link = (uint8_t)(any() % 2u),
        .timestamp = any_time(),
    };
    keel_signing_t probe = model;
    uint8_t digest[32];

    for (uint32_t i = 0u; i < frame.length; i++) {
        frame.payload[i] = (uint8_t)any();
    }
    hash(probe.text, put_signed(&probe, &frame), digest);
    memcpy(frame.seal, digest, sizeof frame.seal);
    if (one_in(8u)) {
        frame.seal[any() % 6u] ^= (uint8_t)(1u << (any() % 8u));
    }
    return frame;
}

static void both_accept(void)
{
    const keel_mavlink_frame_t frame = any_frame();
    const bool expected = model_signing_accepts(&model, &frame);

    TEST_ASSERT_EQUAL(expected, keel_signing_accepts(&signing, &frame));
    accepted += (expected && model.has_key) ? 1u : 0u;
    if (one_in(4u)) {
        const bool again = model_signing_accepts(&model, &frame);

        TEST_ASSERT_EQUAL(again, keel_signing_accepts(&signing, &frame));
        TEST_ASSERT_TRUE(!again || !model.has_key);
    }
}

static void both_write(void)
{
    const keel_mavlink_message_t *message = &messages[any() % 2u];
    const uint8_t length = (uint8_t)(one_in(8u) ? any() : (1u + (any() % message->longest)));
    uint8_t payload[255];
    keel_mavlink_packet_t packet;
    keel_mavlink_packet_t expected;
    uint16_t whole;

    for (uint32_t i = 0u; i < 255u; i++) {
        payload[i] = (uint8_t)(one_in(2u) ? 0u : any());
    }
    memset(&packet, 0xA5, sizeof packet);
    expected = packet;
    whole = model_signing_write(&model, &model_sender, message, payload, length, &expected);
    TEST_ASSERT_EQUAL_UINT16(whole, keel_signing_write(&signing, &sender, message, payload, length,
                                                       &packet));
    TEST_ASSERT_EQUAL_MEMORY(&expected, &packet, sizeof packet);
    TEST_ASSERT_EQUAL_MEMORY(&model_sender, &sender, sizeof sender);
    written += (whole > 0u) ? 1u : 0u;
}

static void both_get_a_key(void)
{
    uint8_t key[32];

    for (uint32_t i = 0u; i < 32u; i++) {
        key[i] = (uint8_t)any();
    }
    model_signing_set_key(&model, key);
    keel_signing_set_key(&signing, key);
}

static void SGN_005_each_call_is_as_specified(void)
{
    for (uint32_t n = 0u; n < CALLS; n++) {
        if (one_in(512u)) {
            both_get_a_key();
        } else if (one_in(2048u)) {
            model_signing_clear_key(&model);
            keel_signing_clear_key(&signing);
        } else if (one_in(64u)) {
            const uint64_t timestamp = one_in(8u) ? ((uint64_t)any() << 20u) : any_time();

            model_signing_advance(&model, timestamp);
            keel_signing_advance(&signing, timestamp);
        } else if (one_in(2048u)) {
            memset(&model.count, 0xFF, sizeof model.count);
            memset(&signing.count, 0xFF, sizeof signing.count);
        } else if (one_in(1024u)) {
            model_signing_init(&model, (uint8_t)n, hash);
            keel_signing_init(&signing, (uint8_t)n, hash);
        } else if (one_in(3u)) {
            both_write();
        } else {
            both_accept();
        }
        compare();
    }
    TEST_ASSERT_TRUE(accepted > (CALLS / 20u));
    TEST_ASSERT_TRUE(written > (CALLS / 8u));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(SGN_005_each_call_is_as_specified);
    return UNITY_END();
}
