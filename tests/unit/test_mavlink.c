/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/middleware/mavlink.h. Frames are those that pymavlink 2.4.50 made. */
#include "keel/middleware/mavlink.h"
#include "unity.h"

#include <string.h>

#define HEARTBEAT 0u
#define PING      1u
#define KNOWN     2u

/* What stands for their layouts is from the messages' definitions. */
static const keel_mavlink_message_t messages[KNOWN] = {
    {.id = 0u, .crc_extra = 50u, .shortest = 1u, .longest = 9u},
    {.id = 4u, .crc_extra = 237u, .shortest = 1u, .longest = 255u},
};

/* System 1, component 1, sequence 0: custom_mode 0; a quadrotor, 2; autopilot 0, base_mode 0;
 * standby, 3; version 3. */
static const uint8_t heartbeat[21] = {0xFD, 9, 0, 0, 0, 1, 1, 0, 0,    0,   0,
                                      0,    0, 0, 2, 0, 0, 3, 3, 0x83, 0x46};

/* The same, signed: link 3, timestamp 0x010203040506, key 0, 1, 2 ... 31. */
static const uint8_t signed_heartbeat[34] = {
    0xFD, 9, 1,    0,    0, 1,    1,    0,    0,    0,    0,    0,    0,    0,    2,    0,    0,
    3,    3, 0x64, 0xBE, 3, 0x06, 0x05, 0x04, 0x03, 0x02, 0x01, 0xA6, 0x2A, 0xC1, 0x40, 0xBB, 0xF1};

/* All of it is 0: one byte is left. */
static const uint8_t ping[13] = {0xFD, 1, 0, 0, 0, 1, 1, 4, 0, 0, 0, 0xBF, 0x2F};

static keel_mavlink_t mavlink;
static keel_mavlink_sender_t sender;
static keel_mavlink_packet_t packet;
static uint8_t *const out = packet.bytes;

void setUp(void)
{
    memset(&mavlink, 0xA5, sizeof mavlink);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_mavlink_init(&mavlink, messages, KNOWN));
    sender = (keel_mavlink_sender_t){.system = 1u, .component = 1u};
    memset(out, 0xA5, sizeof packet);
}

void tearDown(void)
{
}

/* How many frames the looks find; they are no more than they may be. */
static uint32_t look(void)
{
    const uint32_t most = (2u * mavlink.held) + 1u;
    uint32_t taken = 0u;
    uint32_t looks = 0u;
    keel_mavlink_look_t seen;

    do {
        seen = keel_mavlink_look(&mavlink);
        taken += (seen == KEEL_MAVLINK_FRAME) ? 1u : 0u;
        looks++;
    } while (seen != KEEL_MAVLINK_NOTHING);
    TEST_ASSERT_TRUE(looks <= most);
    return taken;
}

/* How many frames are found in these bytes. */
static uint32_t feed(const uint8_t *bytes, uint32_t count)
{
    uint32_t taken = 0u;

    for (uint32_t i = 0u; i < count; i++) {
        TEST_ASSERT_EQUAL(KEEL_OK, keel_mavlink_take(&mavlink, bytes[i]));
        taken += look();
    }
    return taken;
}

/* How many frames are found when no byte follows. */
static uint32_t gap(void)
{
    uint32_t taken = 0u;
    keel_mavlink_look_t seen;

    do {
        seen = keel_mavlink_gap(&mavlink);
        taken += (seen == KEEL_MAVLINK_FRAME) ? 1u : 0u;
    } while (seen != KEEL_MAVLINK_NOTHING);
    TEST_ASSERT_EQUAL_UINT16(0u, mavlink.held);
    return taken;
}

static void refused(keel_status_t why, const keel_mavlink_message_t *table, uint32_t known)
{
    const keel_mavlink_t before = mavlink;

    TEST_ASSERT_EQUAL(why, keel_mavlink_init(&mavlink, table, known));
    TEST_ASSERT_EQUAL_MEMORY(&before, &mavlink, sizeof mavlink);
}

static void MAV_001_tables_out_of_order_are_refused(void)
{
    static keel_mavlink_message_t many[KEEL_MAVLINK_MESSAGES_MAX + 1];

    for (uint32_t i = 0u; i <= KEEL_MAVLINK_MESSAGES_MAX; i++) {
        many[i] = (keel_mavlink_message_t){.id = i, .crc_extra = 0u, .shortest = 1u, .longest = 9u};
    }
    TEST_ASSERT_EQUAL(KEEL_OK, keel_mavlink_init(&mavlink, many, KEEL_MAVLINK_MESSAGES_MAX));
    refused(KEEL_ERR_FULL, many, KEEL_MAVLINK_MESSAGES_MAX + 1u);
    many[1].id = 0u;
    refused(KEEL_ERR_LIMITS, many, 2u);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_mavlink_init(&mavlink, many, 1u));
    many[1].id = KEEL_MAVLINK_ID_MAX + 1u;
    refused(KEEL_ERR_LIMITS, many, 2u);
    many[1].id = KEEL_MAVLINK_ID_MAX;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_mavlink_init(&mavlink, many, 2u));
    many[1].longest = 0u;
    refused(KEEL_ERR_LIMITS, many, 2u);
    many[1].shortest = 0u;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_mavlink_init(&mavlink, many, 2u));
    many[0].longest = 0u;
    refused(KEEL_ERR_LIMITS, many, 2u);
}

static void MAV_002_a_decoder_begins_with_nothing(void)
{
    static const keel_mavlink_frame_t no_frame = {0};
    static const keel_mavlink_count_t no_count = {0};

    TEST_ASSERT_EQUAL_UINT32(no_frame.id, mavlink.frame.id);
    TEST_ASSERT_EQUAL_MEMORY(no_frame.payload, mavlink.frame.payload, sizeof no_frame.payload);
    TEST_ASSERT_EQUAL_MEMORY(no_frame.seal, mavlink.frame.seal, sizeof no_frame.seal);
    TEST_ASSERT_EQUAL_UINT8(0u, mavlink.frame.length);
    TEST_ASSERT_FALSE(mavlink.frame.is_signed);
    TEST_ASSERT_EQUAL_MEMORY(&no_count, &mavlink.count, sizeof no_count);
    TEST_ASSERT_EQUAL_UINT16(0u, mavlink.held);
    TEST_ASSERT_EQUAL_PTR(messages, mavlink.messages);
    TEST_ASSERT_EQUAL_UINT32(KNOWN, mavlink.known);
}

static void MAV_004_a_right_frame_is_taken_by_its_last_byte(void)
{
    TEST_ASSERT_EQUAL_UINT32(0u, feed(heartbeat, 20u));
    TEST_ASSERT_EQUAL_UINT32(1u, feed(&heartbeat[20], 1u));
    TEST_ASSERT_EQUAL_UINT32(1u, mavlink.count.frames);
}

static void MAV_005_a_frame_says_what_was_sent(void)
{
    static const uint8_t payload[9] = {0, 0, 0, 0, 2, 0, 0, 3, 3};
    static const uint8_t no_seal[6] = {0};

    memset(&mavlink.frame.payload, 0xA5, sizeof mavlink.frame.payload);
    TEST_ASSERT_EQUAL_UINT32(1u, feed(heartbeat, 21u));
    TEST_ASSERT_EQUAL_UINT32(0u, mavlink.frame.id);
    TEST_ASSERT_EQUAL_UINT8(0u, mavlink.frame.sequence);
    TEST_ASSERT_EQUAL_UINT8(1u, mavlink.frame.system);
    TEST_ASSERT_EQUAL_UINT8(1u, mavlink.frame.component);
    TEST_ASSERT_EQUAL_UINT8(0u, mavlink.frame.compatible);
    TEST_ASSERT_EQUAL_UINT8(9u, mavlink.frame.length);
    TEST_ASSERT_EQUAL_MEMORY(payload, mavlink.frame.payload, 9u);
    for (uint32_t i = 9u; i < KEEL_MAVLINK_PAYLOAD_MAX; i++) {
        TEST_ASSERT_EQUAL_UINT8(0u, mavlink.frame.payload[i]);
    }
    TEST_ASSERT_EQUAL_UINT16(0x4683u, mavlink.frame.checksum);
    TEST_ASSERT_FALSE(mavlink.frame.is_signed);
    TEST_ASSERT_EQUAL_UINT8(0u, mavlink.frame.link);
    TEST_ASSERT_EQUAL_UINT64(0u, mavlink.frame.timestamp);
    TEST_ASSERT_EQUAL_MEMORY(no_seal, mavlink.frame.seal, 6u);
}

static void MAV_005_header_bytes_are_told_apart(void)
{
    uint8_t frame[13] = {0xFD, 1, 0, 0x11, 0x22, 0x33, 0x44, 4, 0, 0, 0x55, 0, 0};
    uint16_t crc = KEEL_CRC16_FIRST;

    for (uint32_t i = 1u; i < 11u; i++) {
        crc = keel_crc16(crc, frame[i]);
    }
    crc = keel_crc16(crc, 237u);
    frame[11] = (uint8_t)(crc & 0xFFu);
    frame[12] = (uint8_t)(crc >> 8);
    TEST_ASSERT_EQUAL_UINT32(1u, feed(frame, 13u));
    TEST_ASSERT_EQUAL_UINT8(0x11u, mavlink.frame.compatible);
    TEST_ASSERT_EQUAL_UINT8(0x22u, mavlink.frame.sequence);
    TEST_ASSERT_EQUAL_UINT8(0x33u, mavlink.frame.system);
    TEST_ASSERT_EQUAL_UINT8(0x44u, mavlink.frame.component);
    TEST_ASSERT_EQUAL_UINT32(4u, mavlink.frame.id);
    TEST_ASSERT_EQUAL_UINT8(0x55u, mavlink.frame.payload[0]);
}

static void MAV_005_a_signature_is_told(void)
{
    TEST_ASSERT_EQUAL_UINT32(0u, feed(signed_heartbeat, 33u));
    TEST_ASSERT_EQUAL_UINT32(1u, feed(&signed_heartbeat[33], 1u));
    TEST_ASSERT_TRUE(mavlink.frame.is_signed);
    TEST_ASSERT_EQUAL_UINT8(3u, mavlink.frame.link);
    TEST_ASSERT_EQUAL_UINT64(0x010203040506u, mavlink.frame.timestamp);
    TEST_ASSERT_EQUAL_MEMORY(&signed_heartbeat[28], mavlink.frame.seal, 6u);
    TEST_ASSERT_EQUAL_UINT16(0xBE64u, mavlink.frame.checksum);
}

static void MAV_005_what_was_left_out_is_0(void)
{
    TEST_ASSERT_EQUAL_UINT32(1u, feed(signed_heartbeat, 34u));
    TEST_ASSERT_EQUAL_UINT32(1u, feed(ping, 13u));
    TEST_ASSERT_EQUAL_UINT32(4u, mavlink.frame.id);
    TEST_ASSERT_EQUAL_UINT8(1u, mavlink.frame.length);
    for (uint32_t i = 0u; i < KEEL_MAVLINK_PAYLOAD_MAX; i++) {
        TEST_ASSERT_EQUAL_UINT8(0u, mavlink.frame.payload[i]);
    }
    TEST_ASSERT_FALSE(mavlink.frame.is_signed);
    TEST_ASSERT_EQUAL_UINT64(0u, mavlink.frame.timestamp);
}

/* Any one wrong bit, and what it says stays; the next frame is taken. */
static void MAV_006_no_frame_with_a_wrong_bit_is_taken(void)
{
    keel_mavlink_frame_t first;

    TEST_ASSERT_EQUAL_UINT32(1u, feed(ping, 13u));
    first = mavlink.frame;
    for (uint32_t bit = 0u; bit < (8u * 21u); bit++) {
        uint8_t wrong[21];

        memcpy(wrong, heartbeat, sizeof wrong);
        wrong[bit / 8u] = (uint8_t)(wrong[bit / 8u] ^ (1u << (bit % 8u)));
        TEST_ASSERT_EQUAL_UINT32(0u, feed(wrong, 21u));
        TEST_ASSERT_EQUAL_MEMORY(&first, &mavlink.frame, sizeof first);
        TEST_ASSERT_EQUAL_UINT32(0u, gap());
    }
    TEST_ASSERT_EQUAL_UINT32(1u, mavlink.count.frames);
    TEST_ASSERT_EQUAL_UINT32(1u, feed(heartbeat, 21u));
    TEST_ASSERT_EQUAL_UINT8(9u, mavlink.frame.length);
}

/* No byte of it behind the first is 0xFD: all are of no frame and no beginning. */
static void MAV_007_each_reason_is_counted(void)
{
    uint8_t bytes[21];

    memcpy(bytes, heartbeat, sizeof bytes);
    bytes[20] ^= 0x01u; /* The checksum. */
    TEST_ASSERT_EQUAL_UINT32(0u, feed(bytes, 21u));
    TEST_ASSERT_EQUAL_UINT32(1u, mavlink.count.checksums);
    TEST_ASSERT_EQUAL_UINT32(20u, mavlink.count.others);
    bytes[7] = 1u; /* No message that is known. */
    TEST_ASSERT_EQUAL_UINT32(0u, feed(bytes, 21u));
    TEST_ASSERT_EQUAL_UINT32(1u, mavlink.count.unknown);
    TEST_ASSERT_EQUAL_UINT32(40u, mavlink.count.others);
    bytes[7] = 0u;
    bytes[1] = 0u; /* Too short, */
    TEST_ASSERT_EQUAL_UINT32(0u, feed(bytes, 12u));
    TEST_ASSERT_EQUAL_UINT32(1u, mavlink.count.lengths);
    bytes[1] = 10u; /* and too long. */
    TEST_ASSERT_EQUAL_UINT32(0u, feed(bytes, 10u));
    TEST_ASSERT_EQUAL_UINT32(2u, mavlink.count.lengths);
    bytes[2] = 2u; /* A flag that nobody knows. */
    TEST_ASSERT_EQUAL_UINT32(0u, feed(bytes, 10u));
    TEST_ASSERT_EQUAL_UINT32(1u, mavlink.count.flags);
    TEST_ASSERT_EQUAL_UINT32(40u + 11u + 9u + 9u, mavlink.count.others);
    TEST_ASSERT_EQUAL_UINT32(0u, mavlink.count.gaps);
    TEST_ASSERT_EQUAL_UINT32(0u, mavlink.count.frames);
    TEST_ASSERT_EQUAL_UINT16(0u, mavlink.held);
}

static void MAV_007_counts_stay_at_their_end(void)
{
    uint8_t bytes[21];

    memset(&mavlink.count, 0xFF, sizeof mavlink.count);
    TEST_ASSERT_EQUAL_UINT32(1u, feed(heartbeat, 21u));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, mavlink.count.frames);
    TEST_ASSERT_EQUAL_UINT32(0u, feed(&heartbeat[1], 1u));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, mavlink.count.others);
    memcpy(bytes, heartbeat, sizeof bytes);
    bytes[20] ^= 0x01u;
    TEST_ASSERT_EQUAL_UINT32(0u, feed(bytes, 21u));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, mavlink.count.checksums);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, mavlink.count.others);
    bytes[7] = 1u;
    TEST_ASSERT_EQUAL_UINT32(0u, feed(bytes, 10u));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, mavlink.count.unknown);
    bytes[7] = 0u;
    bytes[1] = 0u;
    TEST_ASSERT_EQUAL_UINT32(0u, feed(bytes, 10u));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, mavlink.count.lengths);
    bytes[2] = 2u;
    TEST_ASSERT_EQUAL_UINT32(0u, feed(bytes, 10u));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, mavlink.count.flags);
    TEST_ASSERT_EQUAL_UINT32(0u, feed(heartbeat, 3u));
    TEST_ASSERT_EQUAL_UINT32(0u, gap());
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, mavlink.count.gaps);
}

static void MAV_007_who_knows_no_message_takes_none(void)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_mavlink_init(&mavlink, messages, 0u));
    TEST_ASSERT_EQUAL_UINT32(0u, feed(heartbeat, 21u));
    TEST_ASSERT_EQUAL_UINT32(1u, mavlink.count.unknown);
}

static void MAV_010_a_gap_behind_one_byte(void)
{
    TEST_ASSERT_EQUAL_UINT32(0u, feed(heartbeat, 1u));
    TEST_ASSERT_EQUAL_UINT32(0u, gap());
    TEST_ASSERT_EQUAL_UINT32(1u, mavlink.count.gaps);
    TEST_ASSERT_EQUAL_UINT32(0u, mavlink.count.others);
}

/* A MAVLink 1 heartbeat: no byte of it begins a frame. */
static void MAV_008_what_begins_otherwise_is_no_frame(void)
{
    static const uint8_t older[17] = {0xFE, 9, 0, 1, 1, 0, 0, 0, 0, 0, 2, 0, 0, 3, 3, 0x12, 0x34};

    TEST_ASSERT_EQUAL_UINT32(0u, feed(older, 17u));
    TEST_ASSERT_EQUAL_UINT32(17u, mavlink.count.others);
    TEST_ASSERT_EQUAL_UINT32(1u, feed(heartbeat, 21u));
}

/* Who never looks gets no more bytes in than there is room for; what is held is looked at later. */
static void MAV_008_without_a_look_bytes_are_refused(void)
{
    keel_mavlink_t before;

    for (uint32_t i = 0u; i < 13u; i++) {
        for (uint32_t j = 0u; j < 21u; j++) {
            TEST_ASSERT_EQUAL(KEEL_OK, keel_mavlink_take(&mavlink, heartbeat[j]));
        }
    }
    for (uint32_t i = 273u; i < KEEL_MAVLINK_FRAME_MAX; i++) {
        TEST_ASSERT_EQUAL(KEEL_OK, keel_mavlink_take(&mavlink, 0u));
    }
    before = mavlink;
    TEST_ASSERT_EQUAL(KEEL_ERR_FULL, keel_mavlink_take(&mavlink, 0u));
    TEST_ASSERT_EQUAL_MEMORY(&before, &mavlink, sizeof mavlink);
    TEST_ASSERT_EQUAL_UINT32(13u, look());
    TEST_ASSERT_EQUAL_UINT32(7u, mavlink.count.others);
    TEST_ASSERT_EQUAL_UINT16(0u, mavlink.held);
}

static void MAV_009_a_look_changes_nothing_before_a_frame_is_whole(void)
{
    for (uint32_t i = 0u; i < 20u; i++) {
        keel_mavlink_t before;

        TEST_ASSERT_EQUAL_UINT32(0u, feed(&heartbeat[i], 1u));
        before = mavlink;
        TEST_ASSERT_EQUAL(KEEL_MAVLINK_NOTHING, keel_mavlink_look(&mavlink));
        TEST_ASSERT_EQUAL_MEMORY(&before, &mavlink, sizeof mavlink);
        TEST_ASSERT_EQUAL_UINT16(i + 1u, mavlink.held);
    }
}

/* FF: 255 bytes were to come; 20: as many as 32. The message is one that is known, or not. */
static void MAV_014_a_beginning_that_is_none_costs_no_frame(void)
{
    static const uint8_t none[4][10] = {{0xFD, 0xFF, 0},
                                        {0xFD, 0xFF, 0, 0, 0, 1, 1, 4, 0, 0},
                                        {0xFD, 0x20, 0, 0, 0, 1, 1, 4, 0, 0},
                                        {0xFD, 0xFF, 1, 0, 0, 1, 1, 4, 0, 0}};

    for (uint32_t n = 0u; n < 4u; n++) {
        uint32_t taken = 0u;

        TEST_ASSERT_EQUAL(KEEL_OK, keel_mavlink_init(&mavlink, messages, KNOWN));
        TEST_ASSERT_EQUAL_UINT32(0u, feed(none[n], (n == 0u) ? 3u : 10u));
        for (uint32_t i = 0u; i < 20u; i++) {
            taken += feed(heartbeat, 21u);
        }
        TEST_ASSERT_EQUAL_UINT32(20u, taken);
    }
}

/* Whoever begins to listen in the middle of a payload that looks like beginnings of frames. */
static void MAV_014_payloads_that_look_like_beginnings_cost_no_frame(void)
{
    uint8_t payload[KEEL_MAVLINK_PAYLOAD_MAX];

    for (uint32_t i = 0u; i < sizeof payload; i++) {
        static const uint8_t wrong[10] = {0xFD, 0x20, 0, 0, 0, 1, 1, 4, 0, 0};

        payload[i] = wrong[i % 10u];
    }
    for (uint32_t n = 0u; n < 40u; n++) {
        const uint16_t whole = keel_mavlink_write(&sender, &messages[PING], payload, 254u, &packet);
        const uint32_t skipped = (n == 0u) ? 15u : 0u; /* Of the first frame the first bytes. */

        TEST_ASSERT_EQUAL_UINT32((n == 0u) ? 0u : 1u, feed(&out[skipped], whole - skipped));
    }
}

static void MAV_014_a_beginning_right_behind_a_wrong_one_is_found(void)
{
    static const uint8_t garbage[3] = {0xFD, 0xFD, 0x05};

    TEST_ASSERT_EQUAL_UINT32(0u, feed(garbage, 1u)); /* FD and a frame. */
    TEST_ASSERT_EQUAL_UINT32(1u, feed(heartbeat, 21u));
    TEST_ASSERT_EQUAL_UINT32(0u, feed(garbage, 2u)); /* FD FD and a frame. */
    TEST_ASSERT_EQUAL_UINT32(1u, feed(heartbeat, 21u));
    TEST_ASSERT_EQUAL_UINT32(0u, feed(&garbage[1], 2u)); /* FD 05 and a frame. */
    TEST_ASSERT_EQUAL_UINT32(1u, feed(heartbeat, 21u));
    TEST_ASSERT_EQUAL_UINT32(4u, mavlink.count.flags);
}

/* The shortest frame as near behind a beginning of the longest as one can be: its first bytes are
 * of that one's header, and say a message that is known. */
static void MAV_014_a_frame_is_found_265_bytes_later_at_the_latest(void)
{
    static const keel_mavlink_message_t both[2] = {{.id = 4u, .crc_extra = 237u, .longest = 255u},
                                                   {.id = 0x070605u, .longest = 255u}};
    static const uint8_t longest[3] = {0xFD, 255, 1};
    static const uint8_t zeros[264] = {0};
    uint8_t shortest[12] = {0xFD, 0, 0, 0, 5, 6, 7, 4, 0, 0};
    uint16_t crc = KEEL_CRC16_FIRST;

    for (uint32_t i = 1u; i < 10u; i++) {
        crc = keel_crc16(crc, shortest[i]);
    }
    crc = keel_crc16(crc, 237u);
    shortest[10] = (uint8_t)(crc & 0xFFu);
    shortest[11] = (uint8_t)(crc >> 8);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_mavlink_init(&mavlink, both, 2u));
    TEST_ASSERT_EQUAL_UINT32(0u, feed(longest, 3u));
    TEST_ASSERT_EQUAL_UINT32(0u, feed(shortest, 12u));
    TEST_ASSERT_EQUAL_UINT32(0u, feed(zeros, 264u));
    TEST_ASSERT_EQUAL_UINT32(1u, feed(zeros, 1u));
    TEST_ASSERT_EQUAL_UINT32(1u, mavlink.count.checksums);
}

/* A message that is known carries a frame: that is its payload, and no frame. */
static void MAV_014_frames_in_a_frame_that_is_taken_are_none(void)
{
    TEST_ASSERT_EQUAL_UINT16(33u,
                             keel_mavlink_write(&sender, &messages[PING], heartbeat, 21u, &packet));
    TEST_ASSERT_EQUAL_UINT32(1u, feed(out, 33u));
    TEST_ASSERT_EQUAL_UINT32(4u, mavlink.frame.id);
    TEST_ASSERT_EQUAL_UINT32(1u, mavlink.count.frames);
}

/* That of a message that is not known is searched. */
static void MAV_015_a_frame_in_a_message_that_is_not_known_is_taken(void)
{
    uint8_t outer[33] = {0xFD, 21, 0, 0, 0, 1, 1, 9, 0, 0};

    memcpy(&outer[10], heartbeat, 21u);
    TEST_ASSERT_EQUAL_UINT32(1u, feed(outer, 33u));
    TEST_ASSERT_EQUAL_UINT32(1u, mavlink.count.unknown);
    TEST_ASSERT_EQUAL_UINT32(0u, mavlink.frame.id);
}

static void MAV_010_a_gap_ends_what_is_partial(void)
{
    static const uint8_t longest[3] = {0xFD, 255, 0};

    TEST_ASSERT_EQUAL_UINT32(0u, feed(longest, 3u));
    TEST_ASSERT_EQUAL_UINT32(0u, gap());
    TEST_ASSERT_EQUAL_UINT32(1u, mavlink.count.gaps);
    TEST_ASSERT_EQUAL_UINT32(0u, gap());
    TEST_ASSERT_EQUAL_UINT32(1u, mavlink.count.gaps);
    TEST_ASSERT_EQUAL_UINT32(1u, feed(heartbeat, 21u));
    TEST_ASSERT_EQUAL_UINT32(1u, feed(heartbeat, 21u));
    TEST_ASSERT_EQUAL_UINT32(0u, gap());
    TEST_ASSERT_EQUAL_UINT32(1u, mavlink.count.gaps);
}

/* Frames behind a wrong beginning are found at the gap; the last, which is partial, is not. */
static void MAV_010_a_gap_finds_what_a_wrong_beginning_holds(void)
{
    static const uint8_t longest[10] = {0xFD, 255, 0, 0, 0, 1, 1, 4, 0, 0};

    TEST_ASSERT_EQUAL_UINT32(0u, feed(longest, 10u));
    TEST_ASSERT_EQUAL_UINT32(0u, feed(heartbeat, 21u));
    TEST_ASSERT_EQUAL_UINT32(0u, feed(ping, 13u));
    TEST_ASSERT_EQUAL_UINT32(0u, feed(heartbeat, 20u));
    TEST_ASSERT_EQUAL_UINT32(2u, gap());
    TEST_ASSERT_EQUAL_UINT32(4u, mavlink.frame.id);
    TEST_ASSERT_EQUAL_UINT32(2u, mavlink.count.gaps);
    TEST_ASSERT_EQUAL_UINT32(9u + 19u, mavlink.count.others);
}

static void MAV_011_what_is_no_frame_is_not_written(void)
{
    static const uint8_t payload[9] = {0, 0, 0, 0, 2, 0, 0, 3, 3};
    const keel_mavlink_message_t beyond = {.id = 0x1000000u, .crc_extra = 0u, .longest = 9u};
    uint8_t before[sizeof packet];

    memcpy(before, out, sizeof before);
    TEST_ASSERT_EQUAL_UINT16(0u, keel_mavlink_write(&sender, &messages[HEARTBEAT], payload, 0u,
                                                    &packet));
    TEST_ASSERT_EQUAL_UINT16(0u, keel_mavlink_write(&sender, &messages[HEARTBEAT], payload, 10u,
                                                    &packet));
    TEST_ASSERT_EQUAL_UINT16(0u, keel_mavlink_write(&sender, &beyond, payload, 9u, &packet));
    TEST_ASSERT_EQUAL_MEMORY(before, out, sizeof packet);
    TEST_ASSERT_EQUAL_UINT8(0u, sender.sequence);
}

static void MAV_012_frames_are_as_others_write_them(void)
{
    static const uint8_t payload[14] = {0, 0, 0, 0, 2, 0, 0, 3, 3};

    TEST_ASSERT_EQUAL_UINT16(21u, keel_mavlink_write(&sender, &messages[HEARTBEAT], payload, 9u,
                                                     &packet));
    TEST_ASSERT_EQUAL_MEMORY(heartbeat, out, 21u);
    TEST_ASSERT_EQUAL_UINT8(0xA5u, out[21]);
    sender.sequence = 0u;
    TEST_ASSERT_EQUAL_UINT16(13u,
                             keel_mavlink_write(&sender, &messages[PING], payload, 4u, &packet));
    TEST_ASSERT_EQUAL_MEMORY(ping, out, 13u);
    sender.sequence = 0u;
    sender.is_signing = true;
    TEST_ASSERT_EQUAL_UINT16(34u, keel_mavlink_write(&sender, &messages[HEARTBEAT], payload, 9u,
                                                     &packet));
    TEST_ASSERT_EQUAL_MEMORY(signed_heartbeat, out, 21u);
    for (uint32_t i = 21u; i < 34u; i++) {
        TEST_ASSERT_EQUAL_UINT8(0u, out[i]);
    }
}

static void MAV_012_ids_have_three_bytes(void)
{
    const keel_mavlink_message_t message = {.id = 0x123456u, .crc_extra = 7u, .longest = 1u};
    const uint8_t payload[1] = {1u};

    TEST_ASSERT_EQUAL_UINT16(13u, keel_mavlink_write(&sender, &message, payload, 1u, &packet));
    TEST_ASSERT_EQUAL_HEX8(0x56u, out[7]);
    TEST_ASSERT_EQUAL_HEX8(0x34u, out[8]);
    TEST_ASSERT_EQUAL_HEX8(0x12u, out[9]);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_mavlink_init(&mavlink, &message, 1u));
    TEST_ASSERT_EQUAL_UINT32(1u, feed(out, 13u));
    TEST_ASSERT_EQUAL_HEX32(0x123456u, mavlink.frame.id);
}

static void MAV_012_what_is_written_is_read_for_every_length(void)
{
    for (uint32_t length = 1u; length <= KEEL_MAVLINK_PAYLOAD_MAX; length++) {
        uint8_t payload[KEEL_MAVLINK_PAYLOAD_MAX] = {0};
        const uint32_t used = (length + 1u) / 2u; /* The other half is left out. */
        uint16_t written;

        memset(payload, (int)length, used);
        sender.is_signing = (length % 3u) == 0u;
        written = keel_mavlink_write(&sender, &messages[PING], payload, (uint8_t)length, &packet);
        TEST_ASSERT_EQUAL_UINT16(12u + used + (sender.is_signing ? 13u : 0u), written);
        TEST_ASSERT_EQUAL_UINT32(1u, feed(out, written));
        TEST_ASSERT_EQUAL_UINT8(used, mavlink.frame.length);
        TEST_ASSERT_EQUAL_MEMORY(payload, mavlink.frame.payload, sizeof payload);
    }
    TEST_ASSERT_EQUAL_UINT32(255u, mavlink.count.frames);
}

static void MAV_013_sequences_count_and_wrap(void)
{
    const uint8_t payload[1] = {1u};

    for (uint32_t i = 0u; i < 300u; i++) {
        TEST_ASSERT_EQUAL_UINT8(i % 256u, sender.sequence);
        (void)keel_mavlink_write(&sender, &messages[PING], payload, 1u, &packet);
        TEST_ASSERT_EQUAL_UINT8(i % 256u, out[4]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(MAV_001_tables_out_of_order_are_refused);
    RUN_TEST(MAV_002_a_decoder_begins_with_nothing);
    RUN_TEST(MAV_004_a_right_frame_is_taken_by_its_last_byte);
    RUN_TEST(MAV_005_a_frame_says_what_was_sent);
    RUN_TEST(MAV_005_header_bytes_are_told_apart);
    RUN_TEST(MAV_005_a_signature_is_told);
    RUN_TEST(MAV_005_what_was_left_out_is_0);
    RUN_TEST(MAV_006_no_frame_with_a_wrong_bit_is_taken);
    RUN_TEST(MAV_007_each_reason_is_counted);
    RUN_TEST(MAV_007_counts_stay_at_their_end);
    RUN_TEST(MAV_007_who_knows_no_message_takes_none);
    RUN_TEST(MAV_008_what_begins_otherwise_is_no_frame);
    RUN_TEST(MAV_008_without_a_look_bytes_are_refused);
    RUN_TEST(MAV_009_a_look_changes_nothing_before_a_frame_is_whole);
    RUN_TEST(MAV_010_a_gap_ends_what_is_partial);
    RUN_TEST(MAV_010_a_gap_behind_one_byte);
    RUN_TEST(MAV_010_a_gap_finds_what_a_wrong_beginning_holds);
    RUN_TEST(MAV_011_what_is_no_frame_is_not_written);
    RUN_TEST(MAV_012_frames_are_as_others_write_them);
    RUN_TEST(MAV_012_ids_have_three_bytes);
    RUN_TEST(MAV_012_what_is_written_is_read_for_every_length);
    RUN_TEST(MAV_013_sequences_count_and_wrap);
    RUN_TEST(MAV_014_a_beginning_that_is_none_costs_no_frame);
    RUN_TEST(MAV_014_payloads_that_look_like_beginnings_cost_no_frame);
    RUN_TEST(MAV_014_a_beginning_right_behind_a_wrong_one_is_found);
    RUN_TEST(MAV_014_a_frame_is_found_265_bytes_later_at_the_latest);
    RUN_TEST(MAV_014_frames_in_a_frame_that_is_taken_are_none);
    RUN_TEST(MAV_015_a_frame_in_a_message_that_is_not_known_is_taken);
    return UNITY_END();
}
