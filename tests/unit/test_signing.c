/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/middleware/signing.h. The frame and its signature are those that pymavlink
 * 2.4.50 made; the hash here knows that one text, and gives all others something else. */
#include "keel/middleware/signing.h"
#include "unity.h"

#include <string.h>

#define LINK   3u
#define TIME   0x010203040506u
#define MINUTE 6000000u

static const keel_mavlink_message_t message = {
    .id = 0u, .crc_extra = 50u, .shortest = 1u, .longest = 9u};
static const uint8_t payload[9] = {0, 0, 0, 0, 2, 0, 0, 3, 3};

/* Key 0, 1, 2 ... 31; and what is hashed: it, and the frame without its last 6 bytes. */
static const uint8_t text[60] = {0,  1,  2,    3,  4,  5,  6,    7,    8,  9,  10, 11, 12, 13, 14,
                                 15, 16, 17,   18, 19, 20, 21,   22,   23, 24, 25, 26, 27, 28, 29,
                                 30, 31, 0xFD, 9,  1,  0,  0,    1,    1,  0,  0,  0,  0,  0,  0,
                                 0,  2,  0,    0,  3,  3,  0x64, 0xBE, 3,  6,  5,  4,  3,  2,  1};
static const uint8_t seal[6] = {0xA6, 0x2A, 0xC1, 0x40, 0xBB, 0xF1};

static keel_signing_t signing;
static keel_mavlink_sender_t sender;
static keel_mavlink_frame_t frame;
static keel_mavlink_packet_t packet;
static uint8_t *const out = packet.bytes;
static bool sealed_all;

static void hash(const uint8_t *data, uint32_t size, uint8_t *digest)
{
    const bool known = (size == sizeof text) && (memcmp(data, text, sizeof text) == 0);

    memset(digest, 0x55, KEEL_SIGNING_DIGEST_BYTES);
    if (known || sealed_all) {
        memcpy(digest, seal, sizeof seal);
    }
}

void setUp(void)
{
    memset(&signing, 0xA5, sizeof signing);
    keel_signing_init(&signing, LINK, hash);
    keel_signing_set_key(&signing, text);
    sender = (keel_mavlink_sender_t){.system = 1u, .component = 1u};
    memset(&frame, 0, sizeof frame);
    frame.system = 1u;
    frame.component = 1u;
    frame.length = 9u;
    memcpy(frame.payload, payload, sizeof payload);
    frame.checksum = 0xBE64u;
    frame.is_signed = true;
    frame.link = LINK;
    frame.timestamp = TIME;
    memcpy(frame.seal, seal, sizeof seal);
    memset(out, 0xA5, sizeof packet);
    sealed_all = false;
}

void tearDown(void)
{
}

static void refused(const uint32_t *count)
{
    const keel_signing_t before = signing;
    const uint32_t counted = *count;

    TEST_ASSERT_FALSE(keel_signing_accepts(&signing, &frame));
    TEST_ASSERT_EQUAL_UINT32(counted + 1u, *count);
    TEST_ASSERT_EQUAL_MEMORY(before.stream, signing.stream, sizeof signing.stream);
    TEST_ASSERT_EQUAL_UINT32(before.streams, signing.streams);
    TEST_ASSERT_EQUAL_UINT64(before.timestamp, signing.timestamp);
}

static void SGN_001_it_begins_without_a_key(void)
{
    keel_signing_init(&signing, 7u, hash);
    TEST_ASSERT_FALSE(signing.has_key);
    TEST_ASSERT_EQUAL_UINT8(7u, signing.link);
    TEST_ASSERT_EQUAL_UINT64(0u, signing.timestamp);
    TEST_ASSERT_EQUAL_UINT32(0u, signing.streams);
    TEST_ASSERT_EQUAL_UINT32(0u, signing.count.accepted);
    for (uint32_t i = 0u; i < KEEL_SIGNING_TEXT_MAX; i++) {
        TEST_ASSERT_EQUAL_UINT8(0u, signing.text[i]);
    }
}

static void SGN_002_a_key_is_set_and_forgotten(void)
{
    TEST_ASSERT_TRUE(signing.has_key);
    TEST_ASSERT_EQUAL_MEMORY(text, signing.text, KEEL_SIGNING_KEY_BYTES);
    TEST_ASSERT_TRUE(keel_signing_accepts(&signing, &frame));
    keel_signing_clear_key(&signing);
    TEST_ASSERT_FALSE(signing.has_key);
    TEST_ASSERT_EQUAL_UINT32(0u, signing.streams);
    TEST_ASSERT_EQUAL_UINT64(TIME, signing.timestamp);
    for (uint32_t i = 0u; i < KEEL_SIGNING_KEY_BYTES; i++) {
        TEST_ASSERT_EQUAL_UINT8(0u, signing.text[i]);
    }
}

static void SGN_003_our_time_never_goes_back(void)
{
    keel_signing_advance(&signing, 100u);
    TEST_ASSERT_EQUAL_UINT64(100u, signing.timestamp);
    keel_signing_advance(&signing, 99u);
    TEST_ASSERT_EQUAL_UINT64(100u, signing.timestamp);
    keel_signing_advance(&signing, KEEL_SIGNING_TIME_MAX + 1u);
    TEST_ASSERT_EQUAL_UINT64(100u, signing.timestamp);
    keel_signing_advance(&signing, KEEL_SIGNING_TIME_MAX);
    TEST_ASSERT_EQUAL_UINT64(KEEL_SIGNING_TIME_MAX, signing.timestamp);
}

static void SGN_004_without_a_key_all_is_accepted(void)
{
    keel_signing_clear_key(&signing);
    frame.seal[0] = 0u;
    TEST_ASSERT_TRUE(keel_signing_accepts(&signing, &frame));
    TEST_ASSERT_TRUE(keel_signing_accepts(&signing, &frame));
    frame.is_signed = false;
    TEST_ASSERT_TRUE(keel_signing_accepts(&signing, &frame));
    TEST_ASSERT_EQUAL_UINT32(0u, signing.streams);
    TEST_ASSERT_EQUAL_UINT64(0u, signing.timestamp);
}

static void SGN_005_with_a_key_a_signature_must_be_there(void)
{
    frame.is_signed = false;
    refused(&signing.count.missing);
}

static void SGN_006_no_frame_is_accepted_twice(void)
{
    TEST_ASSERT_TRUE(keel_signing_accepts(&signing, &frame));
    TEST_ASSERT_EQUAL_UINT32(1u, signing.count.accepted);
    refused(&signing.count.replayed);
    frame.timestamp = TIME - 1u;
    refused(&signing.count.replayed);
    sealed_all = true;
    frame.timestamp = TIME + 1u;
    TEST_ASSERT_TRUE(keel_signing_accepts(&signing, &frame));
    TEST_ASSERT_EQUAL_UINT32(1u, signing.streams);
    TEST_ASSERT_EQUAL_UINT64(TIME + 1u, signing.stream[0].timestamp);
}

static void SGN_006_streams_are_systems_components_and_links(void)
{
    sealed_all = true;
    TEST_ASSERT_TRUE(keel_signing_accepts(&signing, &frame));
    frame.system = 2u;
    TEST_ASSERT_TRUE(keel_signing_accepts(&signing, &frame));
    frame.component = 2u;
    TEST_ASSERT_TRUE(keel_signing_accepts(&signing, &frame));
    frame.link = 2u;
    TEST_ASSERT_TRUE(keel_signing_accepts(&signing, &frame));
    TEST_ASSERT_EQUAL_UINT32(4u, signing.streams);
    refused(&signing.count.replayed);
}

static void SGN_007_a_new_stream_may_be_a_minute_behind(void)
{
    sealed_all = true;
    keel_signing_advance(&signing, TIME + MINUTE + 1u);
    refused(&signing.count.old);
    frame.timestamp = TIME + 1u;
    TEST_ASSERT_TRUE(keel_signing_accepts(&signing, &frame));
    TEST_ASSERT_EQUAL_UINT64(TIME + MINUTE + 1u, signing.timestamp);
    /* Its own time goes on from there, however far behind ours. */
    keel_signing_advance(&signing, TIME + (9u * MINUTE));
    frame.timestamp = TIME + 2u;
    TEST_ASSERT_TRUE(keel_signing_accepts(&signing, &frame));
}

static void SGN_007_there_is_room_for_so_many_streams(void)
{
    sealed_all = true;
    for (uint32_t i = 0u; i < KEEL_SIGNING_STREAMS; i++) {
        frame.system = (uint8_t)(10u + i);
        TEST_ASSERT_TRUE(keel_signing_accepts(&signing, &frame));
    }
    frame.system = 99u;
    refused(&signing.count.full);
    frame.system = 10u;
    frame.timestamp = TIME + 1u;
    TEST_ASSERT_TRUE(keel_signing_accepts(&signing, &frame));
}

/* Any one wrong bit, of the seal or of what is sealed; and it does not move the stream. */
static void SGN_008_no_wrong_signature_is_accepted(void)
{
    for (uint32_t bit = 0u; bit < 48u; bit++) {
        frame.seal[bit / 8u] = (uint8_t)(frame.seal[bit / 8u] ^ (1u << (bit % 8u)));
        refused(&signing.count.wrong);
        frame.seal[bit / 8u] = seal[bit / 8u];
    }
    for (uint32_t bit = 0u; bit < 72u; bit++) {
        frame.payload[bit / 8u] = (uint8_t)(frame.payload[bit / 8u] ^ (1u << (bit % 8u)));
        refused(&signing.count.wrong);
        frame.payload[bit / 8u] = payload[bit / 8u];
    }
    frame.timestamp = TIME + 1u;
    refused(&signing.count.wrong);
    frame.timestamp = TIME;
    TEST_ASSERT_TRUE(keel_signing_accepts(&signing, &frame));
}

static void SGN_008_every_field_is_part_of_what_is_signed(void)
{
    keel_mavlink_frame_t changed[7];

    for (uint32_t i = 0u; i < 7u; i++) {
        changed[i] = frame;
    }
    changed[0].id = 1u;
    changed[1].id = 0x10000u;
    changed[2].sequence = 1u;
    changed[3].system = 2u;
    changed[4].component = 2u;
    changed[5].compatible = 1u;
    changed[6].checksum = 0xBE65u;
    for (uint32_t i = 0u; i < 7u; i++) {
        TEST_ASSERT_FALSE(keel_signing_accepts(&signing, &changed[i]));
    }
    TEST_ASSERT_EQUAL_UINT32(7u, signing.count.wrong);
    TEST_ASSERT_TRUE(keel_signing_accepts(&signing, &frame));
}

/* Of a sender that nobody knows yet: it takes up no room. */
static void SGN_009_what_is_refused_moves_nothing(void)
{
    frame.system = 7u;
    refused(&signing.count.wrong);
    TEST_ASSERT_EQUAL_UINT32(0u, signing.streams);
}

static void SGN_010_our_time_follows(void)
{
    sealed_all = true;
    TEST_ASSERT_TRUE(keel_signing_accepts(&signing, &frame));
    TEST_ASSERT_EQUAL_UINT64(TIME, signing.timestamp);
    frame.link = 4u;
    frame.timestamp = TIME - 1u;
    TEST_ASSERT_TRUE(keel_signing_accepts(&signing, &frame));
    TEST_ASSERT_EQUAL_UINT64(TIME, signing.timestamp);
}

static void SGN_010_counts_stay_at_their_end(void)
{
    keel_signing_count_t ended;

    memset(&ended, 0xFF, sizeof ended);
    signing.count = ended;
    sealed_all = true;
    frame.is_signed = false;
    TEST_ASSERT_FALSE(keel_signing_accepts(&signing, &frame)); /* It is missing, */
    frame.is_signed = true;
    frame.seal[0] ^= 1u;
    TEST_ASSERT_FALSE(keel_signing_accepts(&signing, &frame)); /* wrong, */
    frame.seal[0] ^= 1u;
    TEST_ASSERT_TRUE(keel_signing_accepts(&signing, &frame));
    TEST_ASSERT_FALSE(keel_signing_accepts(&signing, &frame)); /* replayed, */
    frame.system = 100u;
    frame.timestamp = TIME - KEEL_SIGNING_MINUTE - 1u;
    TEST_ASSERT_FALSE(keel_signing_accepts(&signing, &frame)); /* old, */
    signing.streams = KEEL_SIGNING_STREAMS;
    frame.timestamp = TIME;
    TEST_ASSERT_FALSE(keel_signing_accepts(&signing, &frame)); /* or there is no room. */
    TEST_ASSERT_EQUAL_MEMORY(&ended, &signing.count, sizeof ended);
}

static void SGN_011_frames_are_signed_as_others_sign_them(void)
{
    keel_signing_advance(&signing, TIME - 1u);
    TEST_ASSERT_EQUAL_UINT16(34u,
                             keel_signing_write(&signing, &sender, &message, payload, 9u, &packet));
    TEST_ASSERT_EQUAL_MEMORY(&text[32], out, 28u);
    TEST_ASSERT_EQUAL_MEMORY(seal, &out[28], 6u);
    TEST_ASSERT_EQUAL_UINT64(TIME, signing.timestamp);
    TEST_ASSERT_EQUAL_UINT8(1u, sender.sequence);
}

static void SGN_011_without_a_key_frames_are_not_signed(void)
{
    keel_signing_clear_key(&signing);
    sender.is_signing = true;
    TEST_ASSERT_EQUAL_UINT16(21u,
                             keel_signing_write(&signing, &sender, &message, payload, 9u, &packet));
    TEST_ASSERT_EQUAL_UINT8(0u, out[2]);
    TEST_ASSERT_EQUAL_UINT64(0u, signing.timestamp);
    TEST_ASSERT_FALSE(sender.is_signing);
}

static void SGN_012_each_frame_has_a_time_of_its_own(void)
{
    TEST_ASSERT_EQUAL_UINT16(0u, keel_signing_write(&signing, &sender, &message, payload, 10u,
                                                    &packet));
    TEST_ASSERT_EQUAL_UINT64(0u, signing.timestamp);
    for (uint32_t i = 1u; i < 4u; i++) {
        TEST_ASSERT_EQUAL_UINT16(34u, keel_signing_write(&signing, &sender, &message, payload, 9u,
                                                         &packet));
        TEST_ASSERT_EQUAL_UINT64(i, signing.timestamp);
        TEST_ASSERT_EQUAL_UINT8(i, out[22]);
    }
}

static void SGN_012_behind_the_last_time_nothing_is_signed(void)
{
    keel_signing_advance(&signing, KEEL_SIGNING_TIME_MAX - 1u);
    TEST_ASSERT_EQUAL_UINT16(34u,
                             keel_signing_write(&signing, &sender, &message, payload, 9u, &packet));
    TEST_ASSERT_EQUAL_UINT16(0u,
                             keel_signing_write(&signing, &sender, &message, payload, 9u, &packet));
    TEST_ASSERT_EQUAL_UINT64(KEEL_SIGNING_TIME_MAX, signing.timestamp);
    TEST_ASSERT_EQUAL_UINT8(1u, sender.sequence);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(SGN_001_it_begins_without_a_key);
    RUN_TEST(SGN_002_a_key_is_set_and_forgotten);
    RUN_TEST(SGN_003_our_time_never_goes_back);
    RUN_TEST(SGN_004_without_a_key_all_is_accepted);
    RUN_TEST(SGN_005_with_a_key_a_signature_must_be_there);
    RUN_TEST(SGN_006_no_frame_is_accepted_twice);
    RUN_TEST(SGN_006_streams_are_systems_components_and_links);
    RUN_TEST(SGN_007_a_new_stream_may_be_a_minute_behind);
    RUN_TEST(SGN_007_there_is_room_for_so_many_streams);
    RUN_TEST(SGN_008_no_wrong_signature_is_accepted);
    RUN_TEST(SGN_008_every_field_is_part_of_what_is_signed);
    RUN_TEST(SGN_009_what_is_refused_moves_nothing);
    RUN_TEST(SGN_010_our_time_follows);
    RUN_TEST(SGN_010_counts_stay_at_their_end);
    RUN_TEST(SGN_011_frames_are_signed_as_others_sign_them);
    RUN_TEST(SGN_011_without_a_key_frames_are_not_signed);
    RUN_TEST(SGN_012_each_frame_has_a_time_of_its_own);
    RUN_TEST(SGN_012_behind_the_last_time_nothing_is_signed);
    return UNITY_END();
}
