/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/middleware/sbus.h. Frames are worked out by hand.
 *
 * 992 is 01111100000 in binary, so with its lowest bit first 00000 11111 0. Eight such channels are
 * 88 bits, 11 bytes; each byte's lowest bit comes first:
 *
 *     bits  0 to  7   00000 111              E0
 *           8 to 15   11 0 00000             03
 *          16 to 23   11111 0 00             1F
 *          24 to 31   000 11111              F8
 *          32 to 39   0 00000 11             C0
 *          40 to 47   111 0 0000             07
 *          48 to 55   0 11111 0 0            3E
 *          56 to 63   0000 1111              F0
 *          64 to 71   1 0 00000 1            81
 *          72 to 79   1111 0 000             0F
 *          80 to 87   00 11111 0             7C
 *
 * So bytes 10 and 21 of a frame of them look like headers. */
#include "keel/middleware/sbus.h"
#include "unity.h"

#include <string.h>

#define BYTES     25u
#define BYTE_US   120u
#define GAP_US    1000u
#define SILENT_US 4000u

static const uint8_t middle[BYTES] = {0x0F, 0xE0, 0x03, 0x1F, 0xF8, 0xC0, 0x07, 0x3E, 0xF0,
                                      0x81, 0x0F, 0x7C, 0xE0, 0x03, 0x1F, 0xF8, 0xC0, 0x07,
                                      0x3E, 0xF0, 0x81, 0x0F, 0x7C, 0x00, 0x00};

/* 172 is 00010101100, 1811 is 11100010011. Behind the header: the lower 8 bits of 172, AC; 3 more
 * of it and 5 zeros of 992, 00; 11111 0 of 992 and 11 of 1811, DF; bits 2 to 9 of 1811, 0010 0011,
 * C4; its last, 1, and seven of 992, 00000 11, C1; then as above. */
static const uint8_t ends[BYTES] = {0x0F, 0xAC, 0x00, 0xDF, 0xC4, 0xC1, 0x07, 0x3E, 0xF0,
                                    0x81, 0x0F, 0x7C, 0xE0, 0x03, 0x1F, 0xF8, 0xC0, 0x07,
                                    0x3E, 0xF0, 0x81, 0x0F, 0x7C, 0x0C, 0x00};

static const keel_sbus_config_t usual = {
    .gap_us = GAP_US, .lowest = 172u, .highest = 1811u, .judged = 0xFFFFu};
static const keel_sbus_config_t widest = {
    .gap_us = GAP_US, .lowest = 0u, .highest = 2047u, .judged = 0xFFFFu};
/* As in the field: sticks alone, from 885 to 2115 us. */
static const keel_sbus_config_t field = {
    .gap_us = GAP_US, .lowest = 8u, .highest = 1976u, .judged = 0x000Fu};

static keel_sbus_t sbus;

void setUp(void)
{
    memset(&sbus, 0xA5, sizeof sbus);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_sbus_init(&sbus, &usual));
}

void tearDown(void)
{
}

/* How many frames end in these bytes, the first of which comes after so long. */
static uint32_t feed(const uint8_t *bytes, uint32_t count, uint32_t first_us)
{
    uint32_t taken = 0u;

    for (uint32_t i = 0u; i < count; i++) {
        taken += keel_sbus_take(&sbus, bytes[i], (i == 0u) ? first_us : BYTE_US) ? 1u : 0u;
    }
    return taken;
}

/* All but its last byte take nothing, and the last one takes it. */
static void is_taken(const uint8_t *frame, uint32_t first_us)
{
    TEST_ASSERT_EQUAL_UINT32(0u, feed(frame, BYTES - 1u, first_us));
    TEST_ASSERT_TRUE(keel_sbus_take(&sbus, frame[BYTES - 1u], BYTE_US));
}

static void all_are(uint16_t value)
{
    for (uint32_t i = 0u; i < 16u; i++) {
        TEST_ASSERT_EQUAL_UINT16(value, sbus.frame.channel[i]);
    }
}

/* A frame of these channels, bit by bit. */
static void write_frame(uint8_t *frame, const uint16_t *channel, uint8_t flags)
{
    memset(frame, 0, BYTES);
    frame[0] = 0x0Fu;
    for (uint32_t bit = 0u; bit < 176u; bit++) {
        if ((((uint32_t)channel[bit / 11u] >> (bit % 11u)) & 1u) != 0u) {
            frame[1u + (bit / 8u)] |= (uint8_t)(1u << (bit % 8u));
        }
    }
    frame[23] = flags;
}

static void RAD_001_refuses_a_range_that_is_none(void)
{
    keel_sbus_config_t config = usual;
    keel_sbus_t before = sbus;

    config.lowest = 1812u;
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_sbus_init(&sbus, &config));
    config = usual;
    config.highest = 2048u;
    config.gap_us = 0u;
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_sbus_init(&sbus, &config));
    TEST_ASSERT_EQUAL_MEMORY(&before, &sbus, sizeof sbus);
}

static void RAD_001_refuses_a_gap_of_none(void)
{
    keel_sbus_config_t config = usual;
    keel_sbus_t before = sbus;

    config.gap_us = 0u;
    TEST_ASSERT_EQUAL(KEEL_ERR_AGE, keel_sbus_init(&sbus, &config));
    TEST_ASSERT_EQUAL_MEMORY(&before, &sbus, sizeof sbus);
}

static void RAD_002_begins_with_no_frame(void)
{
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, sbus.age_us);
    TEST_ASSERT_TRUE(sbus.frame.failsafe);
    TEST_ASSERT_FALSE(sbus.frame.lost);
    TEST_ASSERT_EQUAL_UINT8(0u, sbus.held);
    TEST_ASSERT_EQUAL_UINT32(0u, sbus.count.frames);
    TEST_ASSERT_EQUAL_UINT32(0u, sbus.count.headers);
    all_are(0u);
}

/* One value alone is a range. */
static void RAD_001_takes_the_smallest_range(void)
{
    keel_sbus_config_t config = usual;

    config.lowest = 992u;
    config.highest = 992u;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_sbus_init(&sbus, &config));
    is_taken(middle, SILENT_US);
    TEST_ASSERT_EQUAL_UINT32(0u, feed(ends, BYTES, SILENT_US));
    TEST_ASSERT_EQUAL_UINT32(1u, sbus.count.ranges);
}

static void RAD_005_takes_the_middle(void)
{
    is_taken(middle, SILENT_US);
    all_are(992u);
    TEST_ASSERT_FALSE(sbus.frame.digital_17);
    TEST_ASSERT_FALSE(sbus.frame.digital_18);
    TEST_ASSERT_FALSE(sbus.frame.lost);
    TEST_ASSERT_FALSE(sbus.frame.failsafe);
    TEST_ASSERT_EQUAL_UINT32(1u, sbus.count.frames);
    TEST_ASSERT_EQUAL_UINT32(0u, sbus.age_us);
}

static void RAD_005_takes_both_ends(void)
{
    is_taken(ends, SILENT_US);
    TEST_ASSERT_EQUAL_UINT16(172u, sbus.frame.channel[0]);
    TEST_ASSERT_EQUAL_UINT16(992u, sbus.frame.channel[1]);
    TEST_ASSERT_EQUAL_UINT16(1811u, sbus.frame.channel[2]);
    for (uint32_t i = 3u; i < 16u; i++) {
        TEST_ASSERT_EQUAL_UINT16(992u, sbus.frame.channel[i]);
    }
    TEST_ASSERT_TRUE(sbus.frame.lost);
    TEST_ASSERT_TRUE(sbus.frame.failsafe);
}

/* Each bit is of one channel, and no other. */
static void RAD_005_each_bit_is_of_its_channel(void)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_sbus_init(&sbus, &widest));
    for (uint32_t bit = 0u; bit < 176u; bit++) {
        uint8_t frame[BYTES] = {0x0F};

        frame[1u + (bit / 8u)] = (uint8_t)(1u << (bit % 8u));
        is_taken(frame, SILENT_US);
        for (uint32_t i = 0u; i < 16u; i++) {
            const uint32_t is = (i == (bit / 11u)) ? (1u << (bit % 11u)) : 0u;

            TEST_ASSERT_EQUAL_UINT16(is, sbus.frame.channel[i]);
        }
    }
}

/* 176 ones. */
static void RAD_005_takes_the_greatest(void)
{
    uint8_t frame[BYTES];

    TEST_ASSERT_EQUAL(KEEL_OK, keel_sbus_init(&sbus, &widest));
    memset(frame, 0xFF, sizeof frame);
    frame[0] = 0x0Fu;
    frame[23] = 0x0Fu;
    frame[24] = 0x00u;
    is_taken(frame, SILENT_US);
    all_are(2047u);
}

static void RAD_005_each_flag_is_told(void)
{
    uint8_t frame[BYTES];

    memcpy(frame, middle, sizeof frame);
    for (uint32_t flags = 0u; flags < 16u; flags++) {
        frame[23] = (uint8_t)flags;
        is_taken(frame, SILENT_US);
        TEST_ASSERT_EQUAL((flags % 2u) == 1u, sbus.frame.digital_17);
        TEST_ASSERT_EQUAL(((flags / 2u) % 2u) == 1u, sbus.frame.digital_18);
        TEST_ASSERT_EQUAL(((flags / 4u) % 2u) == 1u, sbus.frame.lost);
        TEST_ASSERT_EQUAL((flags / 8u) == 1u, sbus.frame.failsafe);
    }
}

/* Each value of the last byte; SBUS2 has four. */
static void RAD_004_each_last_byte(void)
{
    uint8_t frame[BYTES];

    memcpy(frame, middle, sizeof frame);
    for (uint32_t footer = 0u; footer < 256u; footer++) {
        const bool of_two = (footer == 0x04u) || (footer == 0x14u) || (footer == 0x24u) ||
                            (footer == 0x34u);
        const uint32_t refused = sbus.count.footers;
        const bool right = (footer == 0u) || of_two;

        frame[24] = (uint8_t)footer;
        TEST_ASSERT_EQUAL_UINT32(right ? 1u : 0u, feed(frame, BYTES, SILENT_US));
        TEST_ASSERT_EQUAL_UINT32(refused + (right ? 0u : 1u), sbus.count.footers);
    }
}

/* And RAD-004: each bit of a frame changed; tests/tools/test_sbus_frames.py changes each byte in
 * every way. SBUS has no checksum: a channel that is still in its range is believed. */
static void RAD_006_one_bit_changed(void)
{
    for (uint32_t at = 0u; at < BYTES; at++) {
        for (uint32_t change = 1u; change < 256u; change *= 2u) {
            uint8_t frame[BYTES];
            bool right = true;

            memcpy(frame, middle, sizeof frame);
            frame[at] ^= (uint8_t)change;
            for (uint32_t i = 0u; i < 16u; i++) {
                uint32_t value = 0u;

                for (uint32_t bit = 11u * i; bit < (11u * (i + 1u)); bit++) {
                    value += (((uint32_t)frame[1u + (bit / 8u)] >> (bit % 8u)) & 1u) << (bit % 11u);
                }
                right = right && (value >= 172u) && (value <= 1811u);
            }
            /* One bit of the footer makes it one of SBUS2's. */
            right = right && (at != 0u) && ((at != 24u) || (change == 4u)) && (frame[23] < 16u);

            TEST_ASSERT_EQUAL(KEEL_OK, keel_sbus_init(&sbus, &usual));
            is_taken(ends, SILENT_US);
            TEST_ASSERT_EQUAL_UINT32(right ? 1u : 0u, feed(frame, BYTES, SILENT_US));
            if (!right) {
                TEST_ASSERT_EQUAL_UINT16(172u, sbus.frame.channel[0]);
                TEST_ASSERT_EQUAL_UINT16(1811u, sbus.frame.channel[2]);
                TEST_ASSERT_EQUAL_UINT32(1u, sbus.count.frames);
            }
            is_taken(middle, SILENT_US);
            all_are(992u);
        }
    }
}

/* The ends of the range, of each channel. */
static void RAD_004_each_channel_has_its_range(void)
{
    const uint16_t values[4] = {171u, 172u, 1811u, 1812u};

    for (uint32_t i = 0u; i < 16u; i++) {
        for (uint32_t v = 0u; v < 4u; v++) {
            uint16_t channel[16];
            uint8_t frame[BYTES];
            const uint32_t refused = sbus.count.ranges;
            const bool right = (v == 1u) || (v == 2u);

            for (uint32_t k = 0u; k < 16u; k++) {
                channel[k] = 992u;
            }
            channel[i] = values[v];
            write_frame(frame, channel, 0u);
            TEST_ASSERT_EQUAL_UINT32(right ? 1u : 0u, feed(frame, BYTES, SILENT_US));
            TEST_ASSERT_EQUAL_UINT32(refused + (right ? 0u : 1u), sbus.count.ranges);
        }
    }
}

/* Each channel alone is judged: then it alone voids a frame. */
static void RAD_004_each_channel_may_be_judged(void)
{
    for (uint32_t judged = 0u; judged < 16u; judged++) {
        keel_sbus_config_t config = field;

        config.judged = (uint16_t)(1u << judged);
        TEST_ASSERT_EQUAL(KEEL_OK, keel_sbus_init(&sbus, &config));
        for (uint32_t i = 0u; i < 16u; i++) {
            uint16_t channel[16];
            uint8_t frame[BYTES];

            for (uint32_t k = 0u; k < 16u; k++) {
                channel[k] = 992u;
            }
            channel[i] = 7u;
            write_frame(frame, channel, 0u);
            TEST_ASSERT_EQUAL_UINT32((i == judged) ? 0u : 1u, feed(frame, BYTES, SILENT_US));
        }
        TEST_ASSERT_EQUAL_UINT32(1u, sbus.count.ranges);
    }
}

/* Channels 5 to 16 say anything, all of them at once; sticks up to 115 %. */
static void RAD_004_knobs_and_channels_that_are_none(void)
{
    const uint16_t others[5] = {0u, 7u, 1977u, 2047u, 110u};
    const uint16_t sticks[2] = {8u, 1976u};

    TEST_ASSERT_EQUAL(KEEL_OK, keel_sbus_init(&sbus, &field));
    for (uint32_t k = 0u; k < 10u; k++) {
        uint16_t channel[16];
        uint8_t frame[BYTES];

        for (uint32_t i = 0u; i < 16u; i++) {
            channel[i] = (i < 4u) ? sticks[k % 2u] : others[k / 2u];
        }
        write_frame(frame, channel, 0u);
        is_taken(frame, SILENT_US);
        TEST_ASSERT_EQUAL_UINT16_ARRAY(channel, sbus.frame.channel, 16u);
    }
    TEST_ASSERT_EQUAL_UINT32(0u, sbus.count.ranges);
}

/* A receiver without the radio that sends zeros says no stick. */
static void RAD_004_no_pulses_are_refused(void)
{
    const uint8_t zeros[BYTES] = {0x0F};

    TEST_ASSERT_EQUAL(KEEL_OK, keel_sbus_init(&sbus, &field));
    is_taken(middle, SILENT_US);
    TEST_ASSERT_EQUAL_UINT32(0u, feed(zeros, BYTES, SILENT_US));
    all_are(992u);
    TEST_ASSERT_EQUAL_UINT32(1u, sbus.count.ranges);
}

/* The first of footer, flags and range that applies is counted, once. */
static void RAD_007_one_reason_is_counted(void)
{
    uint8_t frame[BYTES] = {0x0F}; /* Channels of 0. */

    frame[23] = 0x10u;
    frame[24] = 0x01u;
    TEST_ASSERT_EQUAL_UINT32(0u, feed(frame, BYTES, SILENT_US));
    TEST_ASSERT_EQUAL_UINT32(1u, sbus.count.footers);
    TEST_ASSERT_EQUAL_UINT32(0u, sbus.count.flags);
    frame[24] = 0x00u;
    TEST_ASSERT_EQUAL_UINT32(0u, feed(frame, BYTES, SILENT_US));
    TEST_ASSERT_EQUAL_UINT32(1u, sbus.count.flags);
    TEST_ASSERT_EQUAL_UINT32(0u, sbus.count.ranges);
    frame[23] = 0x00u;
    TEST_ASSERT_EQUAL_UINT32(0u, feed(frame, BYTES, SILENT_US));
    TEST_ASSERT_EQUAL_UINT32(1u, sbus.count.ranges);
    TEST_ASSERT_EQUAL_UINT32(1u, sbus.count.footers);
    TEST_ASSERT_EQUAL_UINT32(1u, sbus.count.flags);
}

/* Bytes before a header are counted, and not held. */
static void RAD_010_waits_for_a_header(void)
{
    const uint8_t noise[4] = {0x00, 0xF0, 0x0E, 0xFF};

    TEST_ASSERT_EQUAL_UINT32(0u, feed(noise, 4u, BYTE_US));
    TEST_ASSERT_EQUAL_UINT32(4u, sbus.count.headers);
    TEST_ASSERT_EQUAL_UINT8(0u, sbus.held);
    is_taken(middle, BYTE_US);
}

/* The beginning of a frame is lost, as many bytes as there can be. */
static void RAD_009_any_prefix_lost_before_a_gap(void)
{
    for (uint32_t lost = 1u; lost < BYTES; lost++) {
        TEST_ASSERT_EQUAL(KEEL_OK, keel_sbus_init(&sbus, &usual));
        TEST_ASSERT_EQUAL_UINT32(0u, feed(&middle[lost], BYTES - lost, SILENT_US));
        is_taken(ends, SILENT_US);
    }
}

/* So is the end. */
static void RAD_009_any_suffix_lost_before_a_gap(void)
{
    for (uint32_t come = 1u; come < BYTES; come++) {
        TEST_ASSERT_EQUAL(KEEL_OK, keel_sbus_init(&sbus, &usual));
        TEST_ASSERT_EQUAL_UINT32(0u, feed(middle, come, SILENT_US));
        TEST_ASSERT_EQUAL_UINT32(0u, sbus.count.gaps);
        is_taken(ends, SILENT_US);
        TEST_ASSERT_EQUAL_UINT32(1u, sbus.count.gaps);
    }
}

/* A gap is longer than gap_us, not as long; and passes in parts as well. */
static void RAD_009_a_gap_is_longer(void)
{
    TEST_ASSERT_EQUAL_UINT32(0u, feed(middle, 12u, SILENT_US));
    TEST_ASSERT_EQUAL_UINT32(1u, feed(&middle[12], 13u, GAP_US));
    TEST_ASSERT_EQUAL_UINT32(0u, sbus.count.gaps);

    TEST_ASSERT_EQUAL_UINT32(0u, feed(middle, 12u, SILENT_US));
    TEST_ASSERT_EQUAL_UINT32(0u, feed(&middle[12], 13u, GAP_US + 1u));
    TEST_ASSERT_EQUAL_UINT32(1u, sbus.count.gaps);

    TEST_ASSERT_EQUAL_UINT32(0u, feed(middle, 12u, SILENT_US));
    keel_sbus_pass_time(&sbus, 600u);
    TEST_ASSERT_EQUAL_UINT32(0u, feed(&middle[12], 13u, 401u));
    TEST_ASSERT_EQUAL_UINT32(3u, sbus.count.gaps);
}

/* A byte that is no header, after a gap, begins nothing. */
static void RAD_009_noise_after_a_gap(void)
{
    TEST_ASSERT_EQUAL_UINT32(0u, feed(middle, 12u, SILENT_US));
    TEST_ASSERT_FALSE(keel_sbus_take(&sbus, 0x55u, SILENT_US));
    TEST_ASSERT_EQUAL_UINT8(0u, sbus.held);
    TEST_ASSERT_EQUAL_UINT32(1u, sbus.count.gaps);
    TEST_ASSERT_EQUAL_UINT32(1u, sbus.count.headers);
}

/* With no gap at all, the first whole frame is taken by its last byte. */
static void RAD_011_any_prefix_lost_without_a_gap(void)
{
    for (uint32_t lost = 1u; lost < BYTES; lost++) {
        TEST_ASSERT_EQUAL(KEEL_OK, keel_sbus_init(&sbus, &usual));
        TEST_ASSERT_EQUAL_UINT32(0u, feed(&middle[lost], BYTES - lost, BYTE_US));
        is_taken(middle, BYTE_US);
        is_taken(ends, BYTE_US);
    }
}

/* Nothing but headers, as many as you like. */
static void RAD_011_headers_without_end(void)
{
    for (uint32_t count = 1u; count < 60u; count++) {
        TEST_ASSERT_EQUAL(KEEL_OK, keel_sbus_init(&sbus, &usual));
        for (uint32_t i = 0u; i < count; i++) {
            TEST_ASSERT_FALSE(keel_sbus_take(&sbus, 0x0Fu, BYTE_US));
        }
        is_taken(middle, BYTE_US);
    }
}

/* 25 bytes that are no frame: the next header is at 10, and 15 bytes are left. */
static void RAD_011_goes_on_at_the_next_header(void)
{
    uint8_t frame[BYTES];

    memcpy(frame, middle, sizeof frame);
    frame[24] = 0x01u;
    TEST_ASSERT_EQUAL_UINT32(0u, feed(frame, BYTES, SILENT_US));
    TEST_ASSERT_EQUAL_UINT8(15u, sbus.held);
    TEST_ASSERT_EQUAL_MEMORY(&frame[10], sbus.buffer, 15u);
    is_taken(middle, BYTE_US);
}

/* There is none, or it is the last byte. */
static void RAD_011_goes_on_with_little(void)
{
    uint8_t frame[BYTES] = {0x0F};

    frame[24] = 0x01u;
    TEST_ASSERT_EQUAL_UINT32(0u, feed(frame, BYTES, SILENT_US));
    TEST_ASSERT_EQUAL_UINT8(0u, sbus.held);
    frame[24] = 0x0Fu;
    TEST_ASSERT_EQUAL_UINT32(0u, feed(frame, BYTES, SILENT_US));
    TEST_ASSERT_EQUAL_UINT8(1u, sbus.held);
    TEST_ASSERT_EQUAL_UINT32(0u, feed(&middle[1], BYTES - 2u, BYTE_US));
    TEST_ASSERT_TRUE(keel_sbus_take(&sbus, middle[24], BYTE_US));
}

/* And the limit of it: bytes 4 to 6 of this frame are 00 00 0F, a footer and a header. Without a
 * gap nothing tells which frame is meant, and a decoder that began at byte 6 stays there. A gap, or
 * a channel that moves, ends it. */
static void RAD_011_what_looks_like_a_frame_is_one(void)
{
    uint8_t frame[BYTES] = {0x0F};

    TEST_ASSERT_EQUAL(KEEL_OK, keel_sbus_init(&sbus, &widest));
    frame[6] = 0x0Fu;
    TEST_ASSERT_EQUAL_UINT32(0u, feed(&frame[6], BYTES - 6u, BYTE_US));
    for (uint32_t i = 0u; i < 4u; i++) {
        TEST_ASSERT_EQUAL_UINT32(1u, feed(frame, 6u, BYTE_US));
        TEST_ASSERT_EQUAL_UINT32(0u, feed(&frame[6], BYTES - 6u, BYTE_US));
    }
    is_taken(frame, SILENT_US);
    is_taken(frame, BYTE_US);
}

/* What was taken is not looked at again. */
static void RAD_010_a_frame_is_taken_once(void)
{
    is_taken(middle, SILENT_US);
    TEST_ASSERT_EQUAL_UINT8(0u, sbus.held);
    TEST_ASSERT_EQUAL_UINT32(0u, feed(&middle[1], BYTES - 1u, BYTE_US));
    TEST_ASSERT_EQUAL_UINT32(1u, sbus.count.frames);
}

static void RAD_008_age_is_told(void)
{
    is_taken(middle, SILENT_US);
    keel_sbus_pass_time(&sbus, 5000u);
    TEST_ASSERT_EQUAL_UINT32(5000u, sbus.age_us);
    TEST_ASSERT_EQUAL_UINT32(5000u, sbus.quiet_us);
    TEST_ASSERT_FALSE(keel_sbus_take(&sbus, 0x0Fu, 2000u));
    TEST_ASSERT_EQUAL_UINT32(7000u, sbus.age_us);
    TEST_ASSERT_EQUAL_UINT32(0u, sbus.quiet_us);
    keel_sbus_pass_time(&sbus, UINT32_MAX - 7000u);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, sbus.age_us);
    keel_sbus_pass_time(&sbus, 7001u);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, sbus.age_us);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, sbus.quiet_us);
}

/* A right frame after the longest silence is new. */
static void RAD_008_silence_ends(void)
{
    is_taken(middle, UINT32_MAX);
    keel_sbus_pass_time(&sbus, UINT32_MAX);
    keel_sbus_pass_time(&sbus, UINT32_MAX);
    is_taken(middle, UINT32_MAX);
    TEST_ASSERT_EQUAL_UINT32(0u, sbus.age_us);
}

/* Every count stays at its end. */
static void RAD_007_counts_stay_at_their_end(void)
{
    uint8_t frame[BYTES];

    memset(&sbus.count, 0xFF, sizeof sbus.count);
    is_taken(middle, SILENT_US);
    TEST_ASSERT_FALSE(keel_sbus_take(&sbus, 0x00u, BYTE_US));
    memcpy(frame, middle, sizeof frame);
    frame[24] = 0x01u;
    TEST_ASSERT_EQUAL_UINT32(0u, feed(frame, BYTES, SILENT_US));
    frame[24] = 0x00u;
    frame[23] = 0xF0u;
    TEST_ASSERT_EQUAL_UINT32(0u, feed(frame, BYTES, SILENT_US));
    frame[23] = 0x00u;
    frame[1] = 0xFFu;
    frame[2] = 0xFFu;
    TEST_ASSERT_EQUAL_UINT32(0u, feed(frame, BYTES, SILENT_US));
    TEST_ASSERT_FALSE(keel_sbus_take(&sbus, 0x00u, SILENT_US));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, sbus.count.frames);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, sbus.count.headers);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, sbus.count.footers);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, sbus.count.flags);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, sbus.count.ranges);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, sbus.count.gaps);
}

/* In double precision, halves up. */
static void RAD_012_each_channel_as_a_pulse(void)
{
    TEST_ASSERT_EQUAL_UINT16(880u, keel_sbus_us(0u));
    TEST_ASSERT_EQUAL_UINT16(988u, keel_sbus_us(172u));
    TEST_ASSERT_EQUAL_UINT16(1500u, keel_sbus_us(992u));
    TEST_ASSERT_EQUAL_UINT16(2012u, keel_sbus_us(1811u));
    TEST_ASSERT_EQUAL_UINT16(2159u, keel_sbus_us(2047u));
    TEST_ASSERT_EQUAL_UINT16(2159u, keel_sbus_us(2048u));
    TEST_ASSERT_EQUAL_UINT16(2159u, keel_sbus_us(UINT16_MAX));
    for (uint32_t raw = 0u; raw < 2048u; raw++) {
        TEST_ASSERT_EQUAL_UINT16((uint16_t)((0.625 * (double)raw) + 880.5),
                                 keel_sbus_us((uint16_t)raw));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(RAD_001_refuses_a_range_that_is_none);
    RUN_TEST(RAD_001_refuses_a_gap_of_none);
    RUN_TEST(RAD_002_begins_with_no_frame);
    RUN_TEST(RAD_001_takes_the_smallest_range);
    RUN_TEST(RAD_005_takes_the_middle);
    RUN_TEST(RAD_005_takes_both_ends);
    RUN_TEST(RAD_005_each_bit_is_of_its_channel);
    RUN_TEST(RAD_005_takes_the_greatest);
    RUN_TEST(RAD_005_each_flag_is_told);
    RUN_TEST(RAD_004_each_last_byte);
    RUN_TEST(RAD_006_one_bit_changed);
    RUN_TEST(RAD_004_each_channel_has_its_range);
    RUN_TEST(RAD_004_each_channel_may_be_judged);
    RUN_TEST(RAD_004_knobs_and_channels_that_are_none);
    RUN_TEST(RAD_004_no_pulses_are_refused);
    RUN_TEST(RAD_007_one_reason_is_counted);
    RUN_TEST(RAD_010_waits_for_a_header);
    RUN_TEST(RAD_009_any_prefix_lost_before_a_gap);
    RUN_TEST(RAD_009_any_suffix_lost_before_a_gap);
    RUN_TEST(RAD_009_a_gap_is_longer);
    RUN_TEST(RAD_009_noise_after_a_gap);
    RUN_TEST(RAD_011_any_prefix_lost_without_a_gap);
    RUN_TEST(RAD_011_headers_without_end);
    RUN_TEST(RAD_011_goes_on_at_the_next_header);
    RUN_TEST(RAD_011_goes_on_with_little);
    RUN_TEST(RAD_011_what_looks_like_a_frame_is_one);
    RUN_TEST(RAD_010_a_frame_is_taken_once);
    RUN_TEST(RAD_008_age_is_told);
    RUN_TEST(RAD_008_silence_ends);
    RUN_TEST(RAD_007_counts_stay_at_their_end);
    RUN_TEST(RAD_012_each_channel_as_a_pulse);
    return UNITY_END();
}
