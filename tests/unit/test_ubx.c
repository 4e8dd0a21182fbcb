/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/middleware/ubx.h. What is expected is worked out by hand; that receivers and
 * other encoders mean the same is tests/tools/test_ubx_messages.py's. */
#include "keel/middleware/ubx.h"
#include "unity.h"

#include <string.h>

#define BYTE_US   87u /* 115200 baud, 10 bits. */
#define GAP_US    20000u
#define SILENT_US 80000u

#define FIX_BYTES 100u
#define SENT_MAX  70000u

static const keel_ubx_config_t usual = {
    .gap_us = GAP_US, .max_age_us = 500000u, .accuracy_mm = 5000u, .speed_accuracy = 1000u};

static keel_ubx_t ubx;
static uint8_t sent[SENT_MAX];
static uint8_t fix_bytes[FIX_BYTES];

/* A whole message in `to`; its length. */
static uint32_t write(uint8_t *to, uint8_t group, uint8_t id, const uint8_t *payload,
                      uint32_t length)
{
    uint32_t a = 0u;
    uint32_t b = 0u;

    to[0] = 0xB5u;
    to[1] = 0x62u;
    to[2] = group;
    to[3] = id;
    to[4] = (uint8_t)(length % 256u);
    to[5] = (uint8_t)(length / 256u);
    memcpy(&to[6], payload, length);
    for (uint32_t i = 2u; i < (6u + length); i++) {
        a = (a + to[i]) % 256u;
        b = (b + a) % 256u;
    }
    to[6u + length] = (uint8_t)a;
    to[7u + length] = (uint8_t)b;
    return 8u + length;
}

static void put(uint8_t *payload, uint32_t at, int64_t value)
{
    for (uint32_t i = 0u; i < 4u; i++) {
        payload[at + i] = (uint8_t)(((uint64_t)value >> (8u * i)) & 0xFFu);
    }
}

/* A good fix at a time of week, in fix_bytes. */
static void make_fix(uint32_t tow_ms)
{
    uint8_t payload[92];

    memset(payload, 0, sizeof payload);
    put(payload, 0u, tow_ms);
    payload[20] = 3u;
    payload[21] = 1u;
    payload[23] = 14u;
    put(payload, 24u, 85455940);
    put(payload, 28u, -473977420);
    put(payload, 32u, 77777);
    put(payload, 36u, -12345);
    put(payload, 40u, 800);
    put(payload, 44u, 1200);
    put(payload, 48u, -1500);
    put(payload, 52u, 2500);
    put(payload, 56u, -3);
    put(payload, 68u, 200);
    (void)write(fix_bytes, 0x01u, 0x07u, payload, 92u);
}

/* With other bytes, and a checksum that is right again. */
static void change(uint32_t at, uint8_t value)
{
    uint8_t payload[92];

    memcpy(payload, &fix_bytes[6], sizeof payload);
    payload[at] = value;
    (void)write(fix_bytes, 0x01u, 0x07u, payload, 92u);
}

void setUp(void)
{
    memset(&ubx, 0xA5, sizeof ubx);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_ubx_init(&ubx, &usual));
    make_fix(100000u);
}

void tearDown(void)
{
}

/* How many fixes end in these bytes, the first of which comes after so long. */
static uint32_t feed(const uint8_t *bytes, uint32_t count, uint32_t first_us)
{
    uint32_t taken = 0u;

    for (uint32_t i = 0u; i < count; i++) {
        taken += keel_ubx_take(&ubx, bytes[i], (i == 0u) ? first_us : BYTE_US) ? 1u : 0u;
    }
    return taken;
}

/* A NAV-PVT of another length: the bytes of the usual one, and 0xFF behind them. */
static uint32_t of_length(uint32_t length)
{
    uint8_t payload[4096];

    memset(payload, 0xFF, sizeof payload);
    memcpy(payload, &fix_bytes[6], (length < 92u) ? length : 92u);
    return write(sent, 0x01u, 0x07u, payload, length);
}

/* All but the last byte take nothing, and the last one takes it. */
static void is_taken(uint32_t first_us)
{
    TEST_ASSERT_EQUAL_UINT32(0u, feed(fix_bytes, FIX_BYTES - 1u, first_us));
    TEST_ASSERT_TRUE(keel_ubx_take(&ubx, fix_bytes[FIX_BYTES - 1u], BYTE_US));
}

static void taken_at(uint32_t tow_ms)
{
    make_fix(tow_ms);
    is_taken(SILENT_US);
}

static void UBX_001_refuses_limits_of_none(void)
{
    const keel_ubx_t before = ubx;
    keel_ubx_config_t config = usual;

    config.accuracy_mm = 0u;
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_ubx_init(&ubx, &config));
    config = usual;
    config.speed_accuracy = 0u;
    config.gap_us = 0u;
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_ubx_init(&ubx, &config));
    config = usual;
    config.gap_us = 0u;
    TEST_ASSERT_EQUAL(KEEL_ERR_AGE, keel_ubx_init(&ubx, &config));
    config = usual;
    config.max_age_us = 0u;
    TEST_ASSERT_EQUAL(KEEL_ERR_AGE, keel_ubx_init(&ubx, &config));
    TEST_ASSERT_EQUAL_MEMORY(&before, &ubx, sizeof ubx);
}

static void UBX_002_begins_with_no_fix(void)
{
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, ubx.age_us);
    TEST_ASSERT_EQUAL_UINT32(0u, ubx.count.fixes);
    TEST_ASSERT_EQUAL_UINT32(0u, ubx.count.bytes);
    TEST_ASSERT_EQUAL_UINT8(KEEL_UBX_SEARCH, ubx.step);
    TEST_ASSERT_FALSE(ubx.is_advancing);
    TEST_ASSERT_EQUAL(KEEL_UBX_NONE, keel_ubx_judge(&ubx));
}

static void UBX_005_says_what_its_bytes_say(void)
{
    is_taken(SILENT_US);
    TEST_ASSERT_EQUAL_UINT32(100000u, ubx.fix.tow_ms);
    TEST_ASSERT_EQUAL_UINT8(KEEL_UBX_3D, ubx.fix.type);
    TEST_ASSERT_TRUE(ubx.fix.is_ok);
    TEST_ASSERT_FALSE(ubx.fix.is_invalid);
    TEST_ASSERT_EQUAL_UINT8(14u, ubx.fix.satellites);
    TEST_ASSERT_EQUAL_INT32(85455940, ubx.fix.longitude);
    TEST_ASSERT_EQUAL_INT32(-473977420, ubx.fix.latitude);
    TEST_ASSERT_EQUAL_INT32(-12345, ubx.fix.height_mm);
    TEST_ASSERT_EQUAL_UINT32(800u, ubx.fix.accuracy_mm);
    TEST_ASSERT_EQUAL_UINT32(1200u, ubx.fix.height_accuracy);
    TEST_ASSERT_EQUAL_INT32(-1500, ubx.fix.north);
    TEST_ASSERT_EQUAL_INT32(2500, ubx.fix.east);
    TEST_ASSERT_EQUAL_INT32(-3, ubx.fix.down);
    TEST_ASSERT_EQUAL_UINT32(200u, ubx.fix.speed_accuracy);
    TEST_ASSERT_EQUAL_UINT32(0u, ubx.age_us);
}

/* The ends of what four bytes can say. */
static void UBX_005_takes_both_ends(void)
{
    change(27u, 0x80u); /* 85455940 is 0x517F7C4. */
    is_taken(SILENT_US);
    TEST_ASSERT_EQUAL_INT32((85455940 % 16777216) - 2147483647 - 1, ubx.fix.longitude);
    for (uint32_t i = 0u; i < 4u; i++) {
        change(24u + i, 0xFFu);
        change(48u + i, (i == 3u) ? 0x7Fu : 0xFFu);
        change(52u + i, (i == 3u) ? 0x80u : 0x00u);
        change(40u + i, 0xFFu);
    }
    change(78u, 0x01u);
    change(21u, 0xFEu);
    is_taken(SILENT_US);
    TEST_ASSERT_EQUAL_INT32(-1, ubx.fix.longitude);
    TEST_ASSERT_EQUAL_INT32(INT32_MAX, ubx.fix.north);
    TEST_ASSERT_EQUAL_INT32(INT32_MIN, ubx.fix.east);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, ubx.fix.accuracy_mm);
    TEST_ASSERT_TRUE(ubx.fix.is_invalid);
    TEST_ASSERT_FALSE(ubx.fix.is_ok);
}

/* And UBX-006: a change of one byte is found, and changes nothing. */
static void UBX_004_one_byte_changed(void)
{
    for (uint32_t at = 0u; at < FIX_BYTES; at++) {
        for (uint32_t by = 1u; by < 256u; by += 37u) {
            uint8_t bytes[FIX_BYTES];
            keel_ubx_fix_t before;

            TEST_ASSERT_EQUAL(KEEL_OK, keel_ubx_init(&ubx, &usual));
            is_taken(SILENT_US);
            before = ubx.fix;
            memcpy(bytes, fix_bytes, sizeof bytes);
            bytes[at] ^= (uint8_t)by;
            TEST_ASSERT_EQUAL_UINT32(0u, feed(bytes, FIX_BYTES, SILENT_US));
            TEST_ASSERT_EQUAL_MEMORY(&before, &ubx.fix, sizeof before);
            TEST_ASSERT_EQUAL_UINT32(1u, ubx.count.fixes);
            is_taken(BYTE_US);
        }
    }
}

static void UBX_007_each_is_counted(void)
{
    const uint8_t payload[2] = {0x06, 0x08};
    const uint32_t size = write(sent, 0x05u, 0x01u, payload, 2u);

    TEST_ASSERT_EQUAL_UINT32(0u, feed(sent, size, BYTE_US));
    TEST_ASSERT_EQUAL_UINT32(1u, ubx.count.acks);
    TEST_ASSERT_EQUAL_UINT32(0u, feed(sent, write(sent, 0x05u, 0x00u, payload, 2u), BYTE_US));
    TEST_ASSERT_EQUAL_UINT32(1u, ubx.count.naks);
    TEST_ASSERT_EQUAL_UINT32(0u, feed(sent, write(sent, 0x05u, 0x02u, payload, 2u), BYTE_US));
    TEST_ASSERT_EQUAL_UINT32(0u, feed(sent, write(sent, 0x05u, 0x01u, payload, 1u), BYTE_US));
    TEST_ASSERT_EQUAL_UINT32(2u, ubx.count.others);
    TEST_ASSERT_EQUAL_UINT32(1u, ubx.count.acks);
    sent[size - 1u] = 0u;
    (void)write(sent, 0x05u, 0x01u, payload, 2u);
    sent[size - 1u] ^= 0x10u;
    TEST_ASSERT_EQUAL_UINT32(0u, feed(sent, size, BYTE_US));
    sent[size - 2u] ^= 0x10u;
    TEST_ASSERT_EQUAL_UINT32(0u, feed(sent, size, BYTE_US));
    TEST_ASSERT_EQUAL_UINT32(2u, ubx.count.checksums);
    TEST_ASSERT_EQUAL_UINT32((5u * size) + 9u, ubx.count.bytes);
    TEST_ASSERT_EQUAL_UINT32(0u, ubx.count.cut);
}

/* Every count stays at its end. */
static void UBX_007_counts_stay_at_their_end(void)
{
    const uint8_t payload[2] = {0u, 0u};
    uint32_t size;

    memset(&ubx.count, 0xFF, sizeof ubx.count);
    is_taken(SILENT_US);
    (void)feed(sent, write(sent, 0x05u, 0x01u, payload, 2u), BYTE_US);
    (void)feed(sent, write(sent, 0x05u, 0x00u, payload, 2u), BYTE_US);
    size = write(sent, 0x0Au, 0x04u, payload, 2u);
    (void)feed(sent, size, BYTE_US);
    sent[size - 1u]++;
    (void)feed(sent, size, BYTE_US);
    (void)feed(sent, 7u, BYTE_US);
    (void)keel_ubx_take(&ubx, 0u, SILENT_US);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, ubx.count.bytes);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, ubx.count.fixes);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, ubx.count.acks);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, ubx.count.naks);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, ubx.count.others);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, ubx.count.checksums);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, ubx.count.cut);
}

static void UBX_008_age_is_told(void)
{
    is_taken(SILENT_US);
    keel_ubx_pass_time(&ubx, 5000u);
    TEST_ASSERT_EQUAL_UINT32(5000u, ubx.age_us);
    TEST_ASSERT_EQUAL_UINT32(5000u, ubx.quiet_us);
    TEST_ASSERT_FALSE(keel_ubx_take(&ubx, 0xB5u, 2000u));
    TEST_ASSERT_EQUAL_UINT32(7000u, ubx.age_us);
    TEST_ASSERT_EQUAL_UINT32(0u, ubx.quiet_us);
    keel_ubx_pass_time(&ubx, UINT32_MAX - 7000u);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, ubx.age_us);
    keel_ubx_pass_time(&ubx, 7001u);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, ubx.age_us);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, ubx.quiet_us);
    is_taken(UINT32_MAX);
    TEST_ASSERT_EQUAL_UINT32(0u, ubx.age_us);
}

/* A gap is longer than gap_us, not as long; and passes in parts as well. */
static void UBX_009_a_gap_ends_a_message(void)
{
    TEST_ASSERT_EQUAL_UINT32(0u, feed(fix_bytes, 50u, SILENT_US));
    TEST_ASSERT_EQUAL_UINT32(1u, feed(&fix_bytes[50], 50u, GAP_US));
    TEST_ASSERT_EQUAL_UINT32(0u, ubx.count.cut);

    TEST_ASSERT_EQUAL_UINT32(0u, feed(fix_bytes, 50u, SILENT_US));
    TEST_ASSERT_EQUAL_UINT32(0u, feed(&fix_bytes[50], 50u, GAP_US + 1u));
    TEST_ASSERT_EQUAL_UINT32(1u, ubx.count.cut);

    TEST_ASSERT_EQUAL_UINT32(0u, feed(fix_bytes, 50u, SILENT_US));
    keel_ubx_pass_time(&ubx, GAP_US);
    TEST_ASSERT_EQUAL_UINT32(0u, feed(&fix_bytes[50], 50u, 1u));
    TEST_ASSERT_EQUAL_UINT32(2u, ubx.count.cut);
}

/* A header in two parts is none. */
static void UBX_009_a_gap_in_a_header(void)
{
    for (uint32_t cut = 1u; cut < 6u; cut++) {
        TEST_ASSERT_EQUAL_UINT32(0u, feed(fix_bytes, cut, SILENT_US));
        TEST_ASSERT_EQUAL_UINT32(0u, feed(&fix_bytes[cut], FIX_BYTES - cut, SILENT_US));
        TEST_ASSERT_EQUAL_UINT8(KEEL_UBX_SEARCH, ubx.step);
    }
    TEST_ASSERT_EQUAL_UINT32(0u, ubx.count.cut);
    is_taken(BYTE_US);
}

/* After a header that promises 65535 bytes, at each of them. */
static void UBX_010_within_another_message(void)
{
    static const uint8_t promise[6] = {0xB5, 0x62, 0x0A, 0x04, 0xFF, 0xFF};

    for (uint32_t more = 0u; more < 300u; more++) {
        TEST_ASSERT_EQUAL(KEEL_OK, keel_ubx_init(&ubx, &usual));
        TEST_ASSERT_EQUAL_UINT32(0u, feed(promise, sizeof promise, BYTE_US));
        for (uint32_t i = 0u; i < more; i++) {
            TEST_ASSERT_FALSE(keel_ubx_take(&ubx, 0xB5u, BYTE_US));
        }
        is_taken(BYTE_US);
        TEST_ASSERT_EQUAL_UINT32(1u, ubx.count.cut);
    }
}

/* After any part of another one, and its first byte after any of its own. */
static void UBX_010_any_part_lost(void)
{
    for (uint32_t lost = 1u; lost < FIX_BYTES; lost++) {
        TEST_ASSERT_EQUAL(KEEL_OK, keel_ubx_init(&ubx, &usual));
        TEST_ASSERT_EQUAL_UINT32(0u, feed(&fix_bytes[lost], FIX_BYTES - lost, BYTE_US));
        is_taken(BYTE_US);
        TEST_ASSERT_EQUAL_UINT32(0u, feed(fix_bytes, lost, BYTE_US));
        is_taken(BYTE_US);
    }
}

/* The one frame that is lost: its header comes again in it. The next one is taken. */
static void UBX_010_its_header_in_it(void)
{
    for (uint32_t i = 0u; i < 6u; i++) {
        change(30u + i, fix_bytes[i]);
    }
    TEST_ASSERT_EQUAL_UINT32(0u, feed(fix_bytes, FIX_BYTES, SILENT_US));
    TEST_ASSERT_EQUAL_UINT32(1u, ubx.count.cut);
    make_fix(100100u);
    is_taken(BYTE_US);
}

/* Its last bytes may be a header's: it is taken all the same, and they begin nothing. */
static void UBX_010_what_was_taken_begins_nothing(void)
{
    for (uint32_t a = 0u; a < 256u; a++) {
        for (uint32_t b = 0u; b < 256u; b++) {
            change(90u, (uint8_t)a);
            change(91u, (uint8_t)b);
            if ((fix_bytes[98] == 0xB5u) && (fix_bytes[99] == 0x62u)) {
                is_taken(SILENT_US);
                TEST_ASSERT_EQUAL_UINT64(0u, ubx.window);
                TEST_ASSERT_EQUAL_UINT32(0u, feed(&fix_bytes[2], 4u, BYTE_US));
                TEST_ASSERT_EQUAL_UINT8(KEEL_UBX_SEARCH, ubx.step);
                return;
            }
        }
    }
    TEST_FAIL_MESSAGE("no such frame");
}

/* The fix begins within a message of any length that was cut: its header counts wherever it comes,
 * as data or as the sum. */
static void UBX_010_within_any_message(void)
{
    for (uint8_t length = 0u; length < 12u; length++) {
        const uint8_t cut[6] = {0xB5, 0x62, 0x0A, 0x04, length, 0x00};

        TEST_ASSERT_EQUAL_UINT32(0u, feed(cut, 6u, SILENT_US));
        is_taken(BYTE_US);
        TEST_ASSERT_EQUAL_UINT32(0u, feed(cut, 6u, SILENT_US));
        TEST_ASSERT_EQUAL_UINT32(1u, feed(sent, of_length(84u), BYTE_US));
    }
}

/* A header may end where a sum is expected. Of class 0x0A, id 0x04 and six bytes the first sum is
 * 0, which is the last byte of the fix's header: 0x0A + 0x04 + 0x06 + 0x71 + 0xB5 + 0x62 + 0x01 +
 * 0x07 + 0x5C = 0x200. */
static void UBX_010_where_a_right_sum_is(void)
{
    static const uint8_t cut[7] = {0xB5, 0x62, 0x0A, 0x04, 0x06, 0x00, 0x71};

    TEST_ASSERT_EQUAL_UINT32(0u, feed(cut, 7u, SILENT_US));
    is_taken(BYTE_US);
    TEST_ASSERT_EQUAL_UINT32(1u, ubx.count.cut);
    ubx.count.cut = UINT32_MAX;
    TEST_ASSERT_EQUAL_UINT32(0u, feed(cut, 7u, SILENT_US));
    is_taken(BYTE_US);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, ubx.count.cut);
}

/* A wrong sum ends a message of nothing: its own sums, 0x0E and 0x34, are right. */
static void UBX_010_where_a_wrong_sum_is(void)
{
    static const uint8_t within[14] = {0xB5, 0x62, 0x0A, 0x04, 0x05, 0x00, 0xB5,
                                       0x62, 0x0A, 0x04, 0x00, 0x00, 0x0E, 0x34};

    TEST_ASSERT_EQUAL_UINT32(0u, feed(within, 12u, SILENT_US));
    TEST_ASSERT_EQUAL_UINT32(1u, ubx.count.checksums);
    TEST_ASSERT_EQUAL_UINT8(KEEL_UBX_SUM_A, ubx.step);
    TEST_ASSERT_EQUAL_UINT32(0u, feed(&within[12], 2u, BYTE_US));
    TEST_ASSERT_EQUAL_UINT32(1u, ubx.count.checksums);
    TEST_ASSERT_EQUAL_UINT8(KEEL_UBX_SEARCH, ubx.step);
}

/* And the limit of it: a right message that ends in the first bytes of a fix. After a gap there is
 * none. */
static void UBX_010_a_message_that_ends_in_it(void)
{
    const uint8_t header[6] = {0xB5, 0x62, 0x0A, 0x04, 0x00, 0x00};

    for (uint32_t id = 0u; id < 256u; id++) {
        for (uint32_t group = 0u; group < 256u; group++) {
            (void)write(sent, (uint8_t)group, (uint8_t)id, header, 0u);
            if ((sent[6] == 0xB5u) && (sent[7] == 0x62u)) {
                TEST_ASSERT_EQUAL_UINT32(0u, feed(sent, 6u, BYTE_US));
                TEST_ASSERT_EQUAL_UINT32(0u, feed(fix_bytes, FIX_BYTES, BYTE_US));
                TEST_ASSERT_EQUAL_UINT32(1u, ubx.count.others);
                TEST_ASSERT_EQUAL_UINT32(0u, feed(sent, 6u, BYTE_US));
                is_taken(SILENT_US);
                return;
            }
        }
    }
    TEST_FAIL_MESSAGE("no such message");
}

/* Messages of every length are counted, and the next one is taken. */
static void UBX_011_skips_any_length(void)
{
    static const uint8_t zeros[SENT_MAX] = {0};
    const uint32_t lengths[10] = {0u, 1u, 2u, 91u, 92u, 93u, 255u, 256u, 257u, 65535u};

    for (uint32_t i = 0u; i < 10u; i++) {
        const uint32_t size = write(sent, 0x0Au, 0x04u, zeros, lengths[i]);

        TEST_ASSERT_EQUAL_UINT32(0u, feed(sent, size, BYTE_US));
        TEST_ASSERT_EQUAL_UINT32(i + 1u, ubx.count.others);
        is_taken(BYTE_US);
    }
    TEST_ASSERT_EQUAL_UINT32(0u, ubx.count.cut);
    TEST_ASSERT_EQUAL_UINT32(0u, ubx.count.checksums);
}

/* What a receiver of any protocol says, all but the last byte taking nothing. */
static void says_the_same(uint32_t length, uint32_t first_us)
{
    const uint32_t size = of_length(length);

    TEST_ASSERT_EQUAL_UINT32(0u, feed(sent, size - 1u, first_us));
    TEST_ASSERT_TRUE(keel_ubx_take(&ubx, sent[size - 1u], BYTE_US));
    TEST_ASSERT_EQUAL_UINT32(100000u, ubx.fix.tow_ms);
    TEST_ASSERT_EQUAL_UINT8(KEEL_UBX_3D, ubx.fix.type);
    TEST_ASSERT_TRUE(ubx.fix.is_ok);
    TEST_ASSERT_EQUAL_UINT8(14u, ubx.fix.satellites);
    TEST_ASSERT_EQUAL_INT32(85455940, ubx.fix.longitude);
    TEST_ASSERT_EQUAL_INT32(-473977420, ubx.fix.latitude);
    TEST_ASSERT_EQUAL_INT32(-12345, ubx.fix.height_mm);
    TEST_ASSERT_EQUAL_UINT32(800u, ubx.fix.accuracy_mm);
    TEST_ASSERT_EQUAL_INT32(-3, ubx.fix.down);
    TEST_ASSERT_EQUAL_UINT32(200u, ubx.fix.speed_accuracy);
}

/* Of an u-blox 7, 84 bytes; of receivers to come, more. */
static void UBX_016_other_protocols_say_the_same(void)
{
    static const uint32_t lengths[8] = {84u, 85u, 91u, 92u, 93u, 100u, 256u, 4096u};

    for (uint32_t i = 0u; i < 8u; i++) {
        TEST_ASSERT_EQUAL(KEEL_OK, keel_ubx_init(&ubx, &usual));
        says_the_same(lengths[i], SILENT_US);
        TEST_ASSERT_FALSE(ubx.fix.is_invalid);
        TEST_ASSERT_EQUAL_UINT32(1u, ubx.count.fixes);
        TEST_ASSERT_EQUAL_UINT32(0u, ubx.count.others);
    }
}

/* Bytes 78 and 79 of protocol 14 are reserved, whatever they are; what was said before is over. */
static void UBX_016_invalid_is_of_92_bytes(void)
{
    change(78u, 0x01u);
    says_the_same(92u, SILENT_US);
    TEST_ASSERT_TRUE(ubx.fix.is_invalid);
    says_the_same(84u, SILENT_US);
    TEST_ASSERT_FALSE(ubx.fix.is_invalid);
    says_the_same(91u, SILENT_US);
    TEST_ASSERT_FALSE(ubx.fix.is_invalid);
    says_the_same(93u, SILENT_US);
    TEST_ASSERT_TRUE(ubx.fix.is_invalid);
}

static void UBX_016_a_shorter_one_is_another(void)
{
    TEST_ASSERT_EQUAL_UINT32(0u, feed(sent, of_length(83u), BYTE_US));
    TEST_ASSERT_EQUAL_UINT32(1u, ubx.count.others);
    TEST_ASSERT_EQUAL_UINT32(0u, feed(sent, of_length(0u), BYTE_US));
    TEST_ASSERT_EQUAL_UINT32(2u, ubx.count.others);
    TEST_ASSERT_EQUAL_UINT32(0u, ubx.count.fixes);
}

/* One of 84 bytes begins in the midst of another message; one of 85 does not, but after a gap. */
static void UBX_010_of_protocol_14_within_another(void)
{
    static const uint8_t promise[6] = {0xB5, 0x62, 0x0A, 0x04, 0xFF, 0xFF};

    TEST_ASSERT_EQUAL_UINT32(0u, feed(promise, sizeof promise, SILENT_US));
    says_the_same(84u, BYTE_US);
    TEST_ASSERT_EQUAL_UINT32(1u, ubx.count.cut);
    TEST_ASSERT_EQUAL_UINT32(0u, feed(promise, sizeof promise, SILENT_US));
    TEST_ASSERT_EQUAL_UINT32(0u, feed(sent, of_length(85u), BYTE_US));
    TEST_ASSERT_EQUAL_UINT32(1u, ubx.count.fixes);
    says_the_same(85u, SILENT_US);
}

static void UBX_012_time_advances(void)
{
    taken_at(100000u);
    TEST_ASSERT_FALSE(ubx.is_advancing);
    taken_at(100100u);
    TEST_ASSERT_TRUE(ubx.is_advancing);
    taken_at(100100u);
    TEST_ASSERT_FALSE(ubx.is_advancing);
    taken_at(100000u);
    TEST_ASSERT_FALSE(ubx.is_advancing);
    taken_at(604799900u);
    TEST_ASSERT_FALSE(ubx.is_advancing); /* More than half a week: it went back. */
    taken_at(0u);
    TEST_ASSERT_TRUE(ubx.is_advancing);
    taken_at(302400000u);
    TEST_ASSERT_FALSE(ubx.is_advancing); /* Half a week: either. */
    taken_at(604799999u);
    TEST_ASSERT_TRUE(ubx.is_advancing);
    taken_at(302399999u);
    TEST_ASSERT_FALSE(ubx.is_advancing); /* Half a week, around its end. */
    taken_at(604800000u);
    TEST_ASSERT_FALSE(ubx.is_advancing); /* There is no such time, */
    taken_at(1u);
    TEST_ASSERT_FALSE(ubx.is_advancing); /* and nothing is after it. */
}

/* Each limit as the worst that is usable, and one more. */
static void UBX_013_each_reason(void)
{
    taken_at(100000u);
    TEST_ASSERT_EQUAL(KEEL_UBX_STUCK, keel_ubx_judge(&ubx));
    taken_at(100100u);
    TEST_ASSERT_EQUAL(KEEL_UBX_USABLE, keel_ubx_judge(&ubx));
    keel_ubx_pass_time(&ubx, 500000u);
    TEST_ASSERT_EQUAL(KEEL_UBX_USABLE, keel_ubx_judge(&ubx));
    keel_ubx_pass_time(&ubx, 1u);
    TEST_ASSERT_EQUAL(KEEL_UBX_OLD, keel_ubx_judge(&ubx));

    taken_at(100200u);
    ubx.fix.accuracy_mm = 5000u;
    ubx.fix.speed_accuracy = 1000u;
    TEST_ASSERT_EQUAL(KEEL_UBX_USABLE, keel_ubx_judge(&ubx));
    ubx.is_advancing = false;
    TEST_ASSERT_EQUAL(KEEL_UBX_STUCK, keel_ubx_judge(&ubx));
    ubx.fix.speed_accuracy = 1001u;
    TEST_ASSERT_EQUAL(KEEL_UBX_WIDE_SPEED, keel_ubx_judge(&ubx));
    ubx.fix.accuracy_mm = 5001u;
    TEST_ASSERT_EQUAL(KEEL_UBX_WIDE, keel_ubx_judge(&ubx));
    ubx.fix.is_invalid = true;
    TEST_ASSERT_EQUAL(KEEL_UBX_INVALID, keel_ubx_judge(&ubx));
    ubx.fix.type = 2u;
    TEST_ASSERT_EQUAL(KEEL_UBX_NOT_3D, keel_ubx_judge(&ubx));
    ubx.fix.type = 4u;
    TEST_ASSERT_EQUAL(KEEL_UBX_NOT_3D, keel_ubx_judge(&ubx));
    ubx.fix.is_ok = false;
    TEST_ASSERT_EQUAL(KEEL_UBX_NOT_OK, keel_ubx_judge(&ubx));
    keel_ubx_pass_time(&ubx, UINT32_MAX);
    TEST_ASSERT_EQUAL(KEEL_UBX_OLD, keel_ubx_judge(&ubx));
    ubx.count.fixes = 0u;
    TEST_ASSERT_EQUAL(KEEL_UBX_NONE, keel_ubx_judge(&ubx));
}

static void is_message(const keel_ubx_message_t *message, const uint8_t *bytes, uint32_t size)
{
    TEST_ASSERT_EQUAL_UINT8(size, message->size);
    TEST_ASSERT_EQUAL_MEMORY(bytes, message->bytes, size);
    for (uint32_t i = size; i < KEEL_UBX_MESSAGE_BYTES; i++) {
        TEST_ASSERT_EQUAL_UINT8(0u, message->bytes[i]);
    }
}

/* CFG-UART1-BAUDRATE is 115200, 0x1C200; one, two and four bytes. */
static void UBX_014_writes_values(void)
{
    const uint8_t baud[20] = {0xB5, 0x62, 0x06, 0x8A, 0x0C, 0x00, 0x00, 0x01, 0x00, 0x00,
                              0x01, 0x00, 0x52, 0x40, 0x00, 0xC2, 0x01, 0x00, 0xF3, 0xA5};
    keel_ubx_message_t message;

    TEST_ASSERT_EQUAL(KEEL_OK, keel_ubx_write_value(&message, 0x40520001u, 115200u));
    is_message(&message, baud, sizeof baud);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_ubx_write_value(&message, 0x30210001u, 100u));
    TEST_ASSERT_EQUAL_UINT8(18u, message.size);
    TEST_ASSERT_EQUAL_UINT8(100u, message.bytes[14]);
    TEST_ASSERT_EQUAL_UINT8(0u, message.bytes[15]);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_ubx_write_value(&message, 0x20910007u, 1u));
    TEST_ASSERT_EQUAL_UINT8(17u, message.size);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_ubx_write_value(&message, 0x10740002u, 0x1FFu));
    TEST_ASSERT_EQUAL_UINT8(17u, message.size);
    TEST_ASSERT_EQUAL_UINT8(0xFFu, message.bytes[14]);
}

static void UBX_014_refuses_other_lengths(void)
{
    keel_ubx_message_t message;
    keel_ubx_message_t before;

    memset(&message, 0xA5, sizeof message);
    before = message;
    TEST_ASSERT_EQUAL(KEEL_ERR_VALUE, keel_ubx_write_value(&message, 0x00210001u, 1u));
    TEST_ASSERT_EQUAL(KEEL_ERR_VALUE, keel_ubx_write_value(&message, 0x50210001u, 1u));
    TEST_ASSERT_EQUAL(KEEL_ERR_VALUE, keel_ubx_write_value(&message, 0x70210001u, 1u));
    TEST_ASSERT_EQUAL_MEMORY(&before, &message, sizeof message);
}

/* 06 + 01 + 03 + 00 + 01 + 07 + 01 = 13; 06 07 0A 0A 0B 12 13 sum to 51. */
static void UBX_015_writes_what_comes_how_often(void)
{
    const uint8_t bytes[11] = {0xB5, 0x62, 0x06, 0x01, 0x03, 0x00, 0x01, 0x07, 0x01, 0x13, 0x51};
    keel_ubx_message_t message;

    keel_ubx_write_output(&message, 0x01u, 0x07u, 1u);
    is_message(&message, bytes, sizeof bytes);
}

static void UBX_015_writes_the_rate(void)
{
    const uint8_t bytes[14] = {0xB5, 0x62, 0x06, 0x08, 0x06, 0x00, 0x64,
                               0x00, 0x01, 0x00, 0x01, 0x00, 0x7A, 0x12};
    keel_ubx_message_t message;

    keel_ubx_write_rate(&message, 100u);
    is_message(&message, bytes, sizeof bytes);
    keel_ubx_write_rate(&message, 0x1234u);
    TEST_ASSERT_EQUAL_UINT8(0x34u, message.bytes[6]);
    TEST_ASSERT_EQUAL_UINT8(0x12u, message.bytes[7]);
}

static void UBX_015_writes_the_port(void)
{
    const uint8_t payload[20] = {1u,    0u,    0u, 0u, 0xD0u, 0x08u, 0u, 0u, 0x00u, 0xC2u,
                                 0x01u, 0x00u, 1u, 0u, 1u,    0u,    0u, 0u, 0u,    0u};
    keel_ubx_message_t message;

    keel_ubx_write_port(&message, 115200u);
    is_message(&message, sent, write(sent, 0x06u, 0x00u, payload, 20u));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(UBX_001_refuses_limits_of_none);
    RUN_TEST(UBX_002_begins_with_no_fix);
    RUN_TEST(UBX_005_says_what_its_bytes_say);
    RUN_TEST(UBX_005_takes_both_ends);
    RUN_TEST(UBX_004_one_byte_changed);
    RUN_TEST(UBX_007_each_is_counted);
    RUN_TEST(UBX_007_counts_stay_at_their_end);
    RUN_TEST(UBX_008_age_is_told);
    RUN_TEST(UBX_009_a_gap_ends_a_message);
    RUN_TEST(UBX_009_a_gap_in_a_header);
    RUN_TEST(UBX_010_within_another_message);
    RUN_TEST(UBX_010_any_part_lost);
    RUN_TEST(UBX_010_its_header_in_it);
    RUN_TEST(UBX_010_what_was_taken_begins_nothing);
    RUN_TEST(UBX_010_within_any_message);
    RUN_TEST(UBX_010_where_a_right_sum_is);
    RUN_TEST(UBX_010_where_a_wrong_sum_is);
    RUN_TEST(UBX_010_a_message_that_ends_in_it);
    RUN_TEST(UBX_011_skips_any_length);
    RUN_TEST(UBX_010_of_protocol_14_within_another);
    RUN_TEST(UBX_016_other_protocols_say_the_same);
    RUN_TEST(UBX_016_invalid_is_of_92_bytes);
    RUN_TEST(UBX_016_a_shorter_one_is_another);
    RUN_TEST(UBX_012_time_advances);
    RUN_TEST(UBX_013_each_reason);
    RUN_TEST(UBX_014_writes_values);
    RUN_TEST(UBX_014_refuses_other_lengths);
    RUN_TEST(UBX_015_writes_what_comes_how_often);
    RUN_TEST(UBX_015_writes_the_rate);
    RUN_TEST(UBX_015_writes_the_port);
    return UNITY_END();
}
