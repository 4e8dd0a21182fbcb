/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/middleware/crsf.h. Frames are known ones, or made here bit by bit, their CRC
 * by long division. */
#include "keel/middleware/crsf.h"
#include "keel/middleware/sbus.h"
#include "unity.h"

#include <string.h>

#define BYTE_US   24u
#define GAP_US    300u
#define SILENT_US 3000u
#define LOST_US   200000u
#define LINK_US   1000000u

/* Channels 172, 1811, and 992 fourteen times; its CRC is checked below. */
static const uint8_t ends[26] = {0xC8, 0x18, 0x16, 0xAC, 0x98, 0x38, 0xF8, 0xC0, 0x07,
                                 0x3E, 0xF0, 0x81, 0x0F, 0x7C, 0xE0, 0x03, 0x1F, 0xF8,
                                 0xC0, 0x07, 0x3E, 0xF0, 0x81, 0x0F, 0x7C, 0x20};

static const keel_crsf_config_t usual = {
    .gap_us = GAP_US, .channels_us = LOST_US, .link_us = LINK_US};

static keel_crsf_t crsf;

void setUp(void)
{
    memset(&crsf, 0xA5, sizeof crsf);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_crsf_init(&crsf, &usual));
}

void tearDown(void)
{
}

/* The rest of these bytes, followed by 8 zeros, divided by x^8 + x^7 + x^6 + x^4 + x^2 + 1. */
static uint8_t divided(const uint8_t *bytes, uint32_t count)
{
    uint32_t rest = 0u;

    for (uint32_t bit = 0u; bit < (8u * (count + 1u)); bit++) {
        const uint32_t byte = (bit < (8u * count)) ? bytes[bit / 8u] : 0u;
        const uint32_t next = byte >> (7u - (bit % 8u));

        rest = (2u * rest) + (next & 1u);
        rest ^= (rest >= 256u) ? 0x1D5u : 0u;
    }
    return (uint8_t)rest;
}

/* A frame of this type and so many bytes of payload, which are there already. */
static uint32_t finish(uint8_t *frame, uint8_t type, uint32_t payload)
{
    frame[0] = 0xC8u;
    frame[1] = (uint8_t)(payload + 2u);
    frame[2] = type;
    frame[payload + 3u] = divided(&frame[2], payload + 1u);
    return payload + 4u;
}

/* What its bytes end; all but the last of them nothing. */
static keel_crsf_taken_t feed(const uint8_t *bytes, uint32_t count, uint32_t first_us)
{
    keel_crsf_taken_t taken = KEEL_CRSF_NOTHING;

    for (uint32_t i = 0u; i < count; i++) {
        TEST_ASSERT_EQUAL(KEEL_CRSF_NOTHING, taken);
        taken = keel_crsf_take(&crsf, bytes[i], (i == 0u) ? first_us : BYTE_US);
    }
    return taken;
}

static void are_ends(void)
{
    TEST_ASSERT_EQUAL_UINT16(172u, crsf.channel[0]);
    TEST_ASSERT_EQUAL_UINT16(1811u, crsf.channel[1]);
    for (uint32_t i = 2u; i < 16u; i++) {
        TEST_ASSERT_EQUAL_UINT16(992u, crsf.channel[i]);
    }
}

static uint32_t link_frame(uint8_t *frame, uint8_t quality, uint8_t snr)
{
    const uint8_t payload[10] = {90, 105, quality, snr, 1, 2, 3, 70, 99, 0xF6};

    memcpy(&frame[3], payload, sizeof payload);
    return finish(frame, 0x14u, 10u);
}

static void CRF_001_refuses_times_of_none(void)
{
    keel_crsf_config_t config = usual;
    const keel_crsf_t before = crsf;

    config.gap_us = 0u;
    TEST_ASSERT_EQUAL(KEEL_ERR_AGE, keel_crsf_init(&crsf, &config));
    config = usual;
    config.channels_us = 0u;
    TEST_ASSERT_EQUAL(KEEL_ERR_AGE, keel_crsf_init(&crsf, &config));
    TEST_ASSERT_EQUAL_MEMORY(&before, &crsf, sizeof crsf);
}

static void CRF_002_begins_with_nothing(void)
{
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, crsf.channels_age_us);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, crsf.link_age_us);
    TEST_ASSERT_EQUAL_UINT8(0u, crsf.framing.held);
    TEST_ASSERT_EQUAL_UINT8(0u, crsf.link.quality);
    TEST_ASSERT_EQUAL_UINT32(0u, crsf.count.channels);
    TEST_ASSERT_EQUAL_UINT32(0u, crsf.count.crcs);
    for (uint32_t i = 0u; i < 16u; i++) {
        TEST_ASSERT_EQUAL_UINT16(0u, crsf.channel[i]);
    }
    TEST_ASSERT_TRUE(keel_crsf_is_lost(&crsf));
}

/* Catalogues say BC for the digits. */
static void CRF_013_known_checks(void)
{
    const uint8_t digits[9] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};

    TEST_ASSERT_EQUAL_UINT8(0xBCu, keel_crsf_crc(digits, 9u));
    TEST_ASSERT_EQUAL_UINT8(0u, keel_crsf_crc(digits, 0u));
    TEST_ASSERT_EQUAL_UINT8(0x20u, keel_crsf_crc(&ends[2], 23u));
    TEST_ASSERT_EQUAL_UINT8(0u, keel_crsf_crc(&ends[2], 24u));
    TEST_ASSERT_EQUAL_UINT8(0x20u, divided(&ends[2], 23u));
}

static void CRF_005_takes_a_known_frame(void)
{
    TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_CHANNELS, feed(ends, 26u, SILENT_US));
    are_ends();
    TEST_ASSERT_EQUAL_UINT32(1u, crsf.count.channels);
    TEST_ASSERT_EQUAL_UINT32(0u, crsf.channels_age_us);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, crsf.link_age_us);
    TEST_ASSERT_EQUAL_UINT8(0u, crsf.framing.held);
}

/* Each bit is of one channel, and no other. */
static void CRF_005_each_bit_is_of_its_channel(void)
{
    for (uint32_t bit = 0u; bit < 176u; bit++) {
        uint8_t frame[64] = {0};
        uint32_t size;

        frame[3u + (bit / 8u)] = (uint8_t)(1u << (bit % 8u));
        size = finish(frame, 0x16u, 22u);
        TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_CHANNELS, feed(frame, size, SILENT_US));
        for (uint32_t i = 0u; i < 16u; i++) {
            const uint32_t is = (i == (bit / 11u)) ? (1u << (bit % 11u)) : 0u;

            TEST_ASSERT_EQUAL_UINT16(is, crsf.channel[i]);
        }
    }
}

static void CRF_006_takes_statistics(void)
{
    uint8_t frame[64];

    TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_LINK, feed(frame, link_frame(frame, 97u, 0xF6u), SILENT_US));
    TEST_ASSERT_EQUAL_UINT8(90u, crsf.link.rssi[0]);
    TEST_ASSERT_EQUAL_UINT8(105u, crsf.link.rssi[1]);
    TEST_ASSERT_EQUAL_UINT8(97u, crsf.link.quality);
    TEST_ASSERT_EQUAL_INT8(-10, crsf.link.snr);
    TEST_ASSERT_EQUAL_UINT8(1u, crsf.link.antenna);
    TEST_ASSERT_EQUAL_UINT8(2u, crsf.link.mode);
    TEST_ASSERT_EQUAL_UINT32(1u, crsf.count.links);
    TEST_ASSERT_EQUAL_UINT32(0u, crsf.link_age_us);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, crsf.channels_age_us);
}

static void CRF_006_each_ratio(void)
{
    for (int snr = -128; snr < 128; snr++) {
        uint8_t frame[64];
        const uint32_t size = link_frame(frame, 97u, (uint8_t)snr);

        TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_LINK, feed(frame, size, SILENT_US));
        TEST_ASSERT_EQUAL_INT8(snr, crsf.link.snr);
    }
}

/* Of several lengths, and of each type: only two are understood, when they are long enough. */
static void CRF_004_each_type_and_length(void)
{
    const uint32_t lengths[5] = {0u, 10u, 22u, 23u, 60u};

    for (uint32_t type = 0u; type < 256u; type++) {
        for (uint32_t k = 0u; k < 5u; k++) {
            uint8_t frame[64];
            const uint32_t others = crsf.count.others;
            const bool known = (type == 0x16u) || (type == 0x14u);
            keel_crsf_taken_t is = known ? KEEL_CRSF_TOOK_SHORT : KEEL_CRSF_TOOK_OTHER;

            is = ((type == 0x16u) && (k >= 2u)) ? KEEL_CRSF_TOOK_CHANNELS : is;
            is = ((type == 0x14u) && (k >= 1u)) ? KEEL_CRSF_TOOK_LINK : is;
            memset(frame, 0xC8, sizeof frame);
            TEST_ASSERT_EQUAL(is, feed(frame, finish(frame, (uint8_t)type, lengths[k]), SILENT_US));
            TEST_ASSERT_EQUAL_UINT32(others + (known ? 0u : 1u), crsf.count.others);
        }
    }
    TEST_ASSERT_EQUAL_UINT32(3u, crsf.count.channels);
    TEST_ASSERT_EQUAL_UINT32(4u, crsf.count.links);
    TEST_ASSERT_EQUAL_UINT32(3u, crsf.count.shorts);
}

/* Every length from nothing to all that there can be. */
static void CRF_004_every_length(void)
{
    for (uint32_t payload = 0u; payload <= 60u; payload++) {
        uint8_t frame[64] = {0};

        TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_OTHER,
                          feed(frame, finish(frame, 0x2Bu, payload), SILENT_US));
        TEST_ASSERT_EQUAL_UINT8(0u, crsf.framing.held);
    }
    TEST_ASSERT_EQUAL_UINT32(61u, crsf.count.others);
    TEST_ASSERT_EQUAL_UINT32(0u, crsf.count.crcs);
}

/* A length that there is none of: the header is dropped at once. */
static void CRF_008_impossible_lengths(void)
{
    const uint8_t lengths[4] = {0u, 1u, 63u, 255u};

    for (uint32_t k = 0u; k < 4u; k++) {
        const uint8_t begin[2] = {0xC8, lengths[k]};

        TEST_ASSERT_EQUAL(KEEL_CRSF_NOTHING, feed(begin, 2u, SILENT_US));
        /* A length of 0 may be a header itself: to all. */
        TEST_ASSERT_EQUAL_UINT8((lengths[k] == 0u) ? 1u : 0u, crsf.framing.held);
        TEST_ASSERT_EQUAL_UINT32(k + 1u, crsf.count.lengths);
    }
    TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_CHANNELS, feed(ends, 26u, BYTE_US));
}

/* One bit of a frame changed, each: a CRC of 8 bits sees them all. Nothing but counts changes. */
static void CRF_007_one_bit_changed(void)
{
    for (uint32_t bit = 0u; bit < 208u; bit++) {
        uint8_t frame[26];
        keel_crsf_t before;

        TEST_ASSERT_EQUAL(KEEL_OK, keel_crsf_init(&crsf, &usual));
        TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_CHANNELS, feed(ends, 26u, SILENT_US));
        before = crsf;
        memset(frame, 0xAA, sizeof frame); /* None of its bytes is a header, even if changed. */
        (void)finish(frame, 0x16u, 22u);
        frame[bit / 8u] ^= (uint8_t)(1u << (bit % 8u));
        for (uint32_t i = 0u; i < 26u; i++) {
            TEST_ASSERT_EQUAL(KEEL_CRSF_NOTHING,
                              keel_crsf_take(&crsf, frame[i], (i == 0u) ? SILENT_US : BYTE_US));
        }
        are_ends();
        TEST_ASSERT_EQUAL_UINT32(1u, crsf.count.channels);
        TEST_ASSERT_EQUAL_MEMORY(&before.link, &crsf.link, sizeof crsf.link);
        TEST_ASSERT_EQUAL_UINT32(SILENT_US + (25u * BYTE_US), crsf.channels_age_us);
        TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_CHANNELS, feed(ends, 26u, SILENT_US));
    }
}

/* A newer sender has more behind what is known: an EdgeTX of today a byte, the draft of 32 channels
 * 23. All that is known is taken, and what is behind is not read. */
static void CRF_004_longer_frames_are_taken(void)
{
    for (uint32_t payload = 22u; payload <= 60u; payload++) {
        uint8_t frame[64];

        memset(frame, 0xFF, sizeof frame);
        memcpy(&frame[3], &ends[3], 22u);
        TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_CHANNELS,
                          feed(frame, finish(frame, 0x16u, payload), SILENT_US));
        are_ends();
    }
    for (uint32_t payload = 10u; payload <= 60u; payload++) {
        uint8_t frame[64];

        memset(frame, 0xFF, sizeof frame);
        (void)link_frame(frame, (uint8_t)payload, 0u);
        TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_LINK,
                          feed(frame, finish(frame, 0x14u, payload), SILENT_US));
        TEST_ASSERT_EQUAL_UINT8(payload, crsf.link.quality);
    }
    TEST_ASSERT_EQUAL_UINT32(39u, crsf.count.channels);
    TEST_ASSERT_EQUAL_UINT32(51u, crsf.count.links);
}

/* What is too short for its type says nothing, and is counted as that. */
static void CRF_008_shorter_frames_are_counted(void)
{
    keel_crsf_t before;

    TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_CHANNELS, feed(ends, 26u, SILENT_US));
    before = crsf;
    for (uint32_t payload = 0u; payload < 22u; payload++) {
        uint8_t frame[64] = {0};

        TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_SHORT,
                          feed(frame, finish(frame, 0x16u, payload), SILENT_US));
        if (payload < 10u) {
            TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_SHORT,
                              feed(frame, finish(frame, 0x14u, payload), SILENT_US));
        }
    }
    are_ends();
    TEST_ASSERT_EQUAL_MEMORY(&before.link, &crsf.link, sizeof crsf.link);
    TEST_ASSERT_EQUAL_UINT32(32u, crsf.count.shorts);
    TEST_ASSERT_EQUAL_UINT32(0u, crsf.count.others);
}

/* On a serial port, to all, a receiver, a transmitter's module; and no other byte. */
static void CRF_004_each_first_byte(void)
{
    for (uint32_t byte = 0u; byte < 256u; byte++) {
        const bool begins = (byte == 0xC8u) || (byte == 0x00u) || (byte == 0xECu) ||
                            (byte == 0xEEu);
        uint32_t taken = 0u;
        uint8_t frame[26];

        memcpy(frame, ends, sizeof frame);
        frame[0] = (uint8_t)byte;
        setUp();
        for (uint32_t i = 0u; i < 26u; i++) {
            taken += (keel_crsf_take(&crsf, frame[i], (i == 0u) ? SILENT_US : BYTE_US) ==
                      KEEL_CRSF_TOOK_CHANNELS)
                         ? 1u
                         : 0u;
        }
        TEST_ASSERT_EQUAL_UINT32(begins ? 1u : 0u, taken);
    }
}

static void CRF_008_a_wrong_crc_is_counted(void)
{
    uint8_t frame[26];

    memcpy(frame, ends, sizeof frame);
    frame[25] ^= 1u;
    TEST_ASSERT_EQUAL(KEEL_CRSF_NOTHING, feed(frame, 26u, SILENT_US));
    TEST_ASSERT_EQUAL_UINT32(1u, crsf.count.crcs);
    TEST_ASSERT_EQUAL_UINT8(0u, crsf.framing.held);
}

/* The beginning or the end of a frame is lost before a gap. */
static void CRF_010_any_part_before_a_gap(void)
{
    for (uint32_t from = 0u; from < 26u; from++) {
        for (uint32_t to = from; to < 26u; to++) {
            TEST_ASSERT_EQUAL(KEEL_OK, keel_crsf_init(&crsf, &usual));
            TEST_ASSERT_EQUAL(KEEL_CRSF_NOTHING, feed(&ends[from], (to - from), SILENT_US));
            TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_CHANNELS, feed(ends, 26u, GAP_US + 1u));
        }
    }
}

/* A gap within a frame ends it. */
static void CRF_010_a_gap_within(void)
{
    TEST_ASSERT_EQUAL(KEEL_CRSF_NOTHING, feed(ends, 12u, SILENT_US));
    TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_CHANNELS, feed(&ends[12], 14u, GAP_US));
    TEST_ASSERT_EQUAL(KEEL_CRSF_NOTHING, feed(ends, 12u, SILENT_US));
    keel_crsf_pass_time(&crsf, 200u);
    TEST_ASSERT_EQUAL(KEEL_CRSF_NOTHING, feed(&ends[12], 14u, 101u));
    TEST_ASSERT_EQUAL_UINT32(1u, crsf.framing.gaps);
    TEST_ASSERT_EQUAL_UINT32(1u, crsf.count.channels);
}

/* A header and the greatest length, and frames behind it without a gap: 64 bytes are no frame; two
 * of the three in them are whole by then, and taken one a byte, the third by its last. */
static void CRF_011_a_false_header_hides_frames(void)
{
    const uint8_t begin[2] = {0xC8, 0x3E};
    uint8_t bytes[78];

    for (uint32_t k = 0u; k < 3u; k++) {
        memcpy(&bytes[26u * k], ends, 26u);
    }
    TEST_ASSERT_EQUAL(KEEL_CRSF_NOTHING, feed(begin, 2u, SILENT_US));
    TEST_ASSERT_EQUAL(KEEL_CRSF_NOTHING, feed(bytes, 62u, BYTE_US));
    TEST_ASSERT_EQUAL_UINT32(1u, crsf.count.crcs);
    TEST_ASSERT_EQUAL_UINT8(62u, crsf.framing.held);
    TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_CHANNELS, keel_crsf_take(&crsf, bytes[62], BYTE_US));
    TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_CHANNELS, keel_crsf_take(&crsf, bytes[63], BYTE_US));
    TEST_ASSERT_EQUAL_UINT8(12u, crsf.framing.held);
    TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_CHANNELS, feed(&bytes[64], 14u, BYTE_US));
    are_ends();
}

/* Nothing but headers, any number of them: 200 is no length, so each is dropped by the next. */
static void CRF_011_headers_without_end(void)
{
    for (uint32_t count = 1u; count < 80u; count++) {
        TEST_ASSERT_EQUAL(KEEL_OK, keel_crsf_init(&crsf, &usual));
        for (uint32_t i = 0u; i < count; i++) {
            TEST_ASSERT_EQUAL(KEEL_CRSF_NOTHING, keel_crsf_take(&crsf, 0xC8u, BYTE_US));
        }
        TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_CHANNELS, feed(ends, 26u, BYTE_US));
    }
}

/* Before a frame, any number of false beginnings of any length: it is taken by the 126th byte
 * behind its first, unless bytes of it were part of what is a right frame by chance. */
static void CRF_011_the_latest(void)
{
    for (uint32_t before = 2u; before < 64u; before += 12u) {
        for (uint32_t length = 2u; length <= 62u; length += 12u) {
            uint32_t bytes = 0u;
            bool taken = false;

            TEST_ASSERT_EQUAL(KEEL_OK, keel_crsf_init(&crsf, &usual));
            for (uint32_t i = 0u; i < before; i++) {
                (void)keel_crsf_take(&crsf, ((i % 2u) == 0u) ? 0xC8u : (uint8_t)length, BYTE_US);
            }
            crsf.count.channels = 0u;
            while (!taken && (bytes <= 126u)) {
                const uint8_t byte = (bytes < 26u) ? ends[bytes] : 0x00u;

                taken = keel_crsf_take(&crsf, byte, BYTE_US) == KEEL_CRSF_TOOK_CHANNELS;
                bytes++;
            }
            TEST_ASSERT_TRUE(taken || (crsf.count.others > 0u));
        }
    }
}

/* Age of channels, age of statistics, and a quality of 0: each means a lost radio. */
static void CRF_012_each_way_to_lose_it(void)
{
    uint8_t frame[64];

    TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_CHANNELS, feed(ends, 26u, SILENT_US));
    TEST_ASSERT_TRUE(keel_crsf_is_lost(&crsf)); /* No statistics yet. */
    TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_LINK, feed(frame, link_frame(frame, 1u, 5u), SILENT_US));
    TEST_ASSERT_FALSE(keel_crsf_is_lost(&crsf));
    TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_LINK, feed(frame, link_frame(frame, 0u, 5u), SILENT_US));
    TEST_ASSERT_TRUE(keel_crsf_is_lost(&crsf));

    TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_LINK, feed(frame, link_frame(frame, 1u, 5u), SILENT_US));
    TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_CHANNELS, feed(ends, 26u, SILENT_US));
    keel_crsf_pass_time(&crsf, LOST_US);
    TEST_ASSERT_FALSE(keel_crsf_is_lost(&crsf));
    keel_crsf_pass_time(&crsf, 1u);
    TEST_ASSERT_TRUE(keel_crsf_is_lost(&crsf));

    TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_LINK, feed(frame, link_frame(frame, 1u, 5u), SILENT_US));
    keel_crsf_pass_time(&crsf, LINK_US - SILENT_US - (25u * BYTE_US));
    TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_CHANNELS, feed(ends, 26u, SILENT_US));
    TEST_ASSERT_FALSE(keel_crsf_is_lost(&crsf));
    keel_crsf_pass_time(&crsf, 1u);
    TEST_ASSERT_TRUE(keel_crsf_is_lost(&crsf));
}

/* Without statistics asked for, channels alone tell. */
static void CRF_012_without_statistics(void)
{
    keel_crsf_config_t config = usual;

    config.link_us = 0u;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_crsf_init(&crsf, &config));
    TEST_ASSERT_TRUE(keel_crsf_is_lost(&crsf));
    TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_CHANNELS, feed(ends, 26u, SILENT_US));
    TEST_ASSERT_FALSE(keel_crsf_is_lost(&crsf));
}

static void CRF_009_ages_stay_at_their_end(void)
{
    uint8_t frame[64];

    TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_CHANNELS, feed(ends, 26u, SILENT_US));
    TEST_ASSERT_EQUAL(KEEL_CRSF_TOOK_LINK, feed(frame, link_frame(frame, 1u, 5u), SILENT_US));
    keel_crsf_pass_time(&crsf, UINT32_MAX - 1u);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX - 1u, crsf.link_age_us);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, crsf.channels_age_us);
    keel_crsf_pass_time(&crsf, 2u);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, crsf.link_age_us);
}

static void CRF_008_counts_stay_at_their_end(void)
{
    uint8_t frame[64];

    memset(&crsf.count, 0xFF, sizeof crsf.count);
    (void)feed(ends, 26u, SILENT_US);
    (void)feed(frame, link_frame(frame, 1u, 5u), SILENT_US);
    (void)feed(frame, finish(frame, 0x01u, 3u), SILENT_US);
    frame[6] ^= 1u;
    (void)feed(frame, 7u, SILENT_US);
    frame[1] = 0u;
    (void)feed(frame, 2u, SILENT_US);
    (void)feed(frame, finish(frame, 0x16u, 21u), SILENT_US);
    TEST_ASSERT_EACH_EQUAL_UINT32(UINT32_MAX, &crsf.count, sizeof crsf.count / sizeof(uint32_t));
}

/* CRSF's own rule is 1500 us and 5/8 us for each step away from 992, cut off. */
static void CRF_014_pulses_are_those_of_the_format(void)
{
    for (int raw = 0; raw < 2048; raw++) {
        const int us = (((raw - 992) * 5) / 8) + 1500;

        TEST_ASSERT_INT_WITHIN(1, us, keel_sbus_us((uint16_t)raw));
    }
    TEST_ASSERT_EQUAL_UINT16(988u, keel_sbus_us(172u));
    TEST_ASSERT_EQUAL_UINT16(1500u, keel_sbus_us(992u));
    TEST_ASSERT_EQUAL_UINT16(2012u, keel_sbus_us(1811u));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(CRF_001_refuses_times_of_none);
    RUN_TEST(CRF_002_begins_with_nothing);
    RUN_TEST(CRF_013_known_checks);
    RUN_TEST(CRF_005_takes_a_known_frame);
    RUN_TEST(CRF_005_each_bit_is_of_its_channel);
    RUN_TEST(CRF_006_takes_statistics);
    RUN_TEST(CRF_006_each_ratio);
    RUN_TEST(CRF_004_each_type_and_length);
    RUN_TEST(CRF_004_every_length);
    RUN_TEST(CRF_008_impossible_lengths);
    RUN_TEST(CRF_007_one_bit_changed);
    RUN_TEST(CRF_004_longer_frames_are_taken);
    RUN_TEST(CRF_008_shorter_frames_are_counted);
    RUN_TEST(CRF_004_each_first_byte);
    RUN_TEST(CRF_008_a_wrong_crc_is_counted);
    RUN_TEST(CRF_010_any_part_before_a_gap);
    RUN_TEST(CRF_010_a_gap_within);
    RUN_TEST(CRF_011_a_false_header_hides_frames);
    RUN_TEST(CRF_011_headers_without_end);
    RUN_TEST(CRF_011_the_latest);
    RUN_TEST(CRF_012_each_way_to_lose_it);
    RUN_TEST(CRF_012_without_statistics);
    RUN_TEST(CRF_009_ages_stay_at_their_end);
    RUN_TEST(CRF_008_counts_stay_at_their_end);
    RUN_TEST(CRF_014_pulses_are_those_of_the_format);
    return UNITY_END();
}
