/* SPDX-License-Identifier: Apache-2.0 */
/* The check values of the three algorithms are those of the catalogue of parametrised CRC
 * algorithms (reveng.sourceforge.io): what "123456789" gives. */
#include "keel/middleware/crc.h"
#include "unity.h"

#define LENGTH 9u

static const uint8_t digits[LENGTH] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};

void setUp(void)
{
}

void tearDown(void)
{
}

static uint8_t crc8_of(const uint8_t *bytes, uint32_t count)
{
    uint8_t crc = KEEL_CRC8_FIRST;

    for (uint32_t i = 0u; i < count; i++) {
        crc = keel_crc8(crc, bytes[i]);
    }
    return crc;
}

static uint16_t crc16_of(const uint8_t *bytes, uint32_t count)
{
    uint16_t crc = KEEL_CRC16_FIRST;

    for (uint32_t i = 0u; i < count; i++) {
        crc = keel_crc16(crc, bytes[i]);
    }
    return crc;
}

static uint32_t crc32_of(const uint8_t *bytes, uint32_t count)
{
    uint32_t crc = KEEL_CRC32_FIRST;

    for (uint32_t i = 0u; i < count; i++) {
        crc = keel_crc32(crc, bytes[i]);
    }
    return crc;
}

/* CRC-001 */
static void test_crc8_of_the_catalogue(void)
{
    TEST_ASSERT_EQUAL_HEX8(0xBCu, crc8_of(digits, LENGTH));
}

/* CRC-001 */
static void test_the_rest_of_bytes_and_their_crc8_is_0(void)
{
    TEST_ASSERT_EQUAL_HEX8(0u, keel_crc8(0xBCu, 0xBCu));
}

/* CRC-001: one bit, by hand: x^8 divided by the polynomial leaves the polynomial without x^8. */
static void test_crc8_of_a_bit(void)
{
    TEST_ASSERT_EQUAL_HEX8(KEEL_CRC8_POLYNOMIAL, keel_crc8(0u, 0x01u));
}

/* CRC-002 */
static void test_crc16_of_the_catalogue(void)
{
    TEST_ASSERT_EQUAL_HEX16(0x6F91u, crc16_of(digits, LENGTH));
}

/* CRC-002: MAVLink's heartbeat fd 09 00 00 00 01 01 00 00 00, nine bytes, then CRC_EXTRA 50. */
static void test_crc16_of_a_frame(void)
{
    static const uint8_t frame[] = {9u, 0u, 0u, 0u, 1u, 1u, 0u, 0u, 0u, 0u,
                                    0u, 0u, 0u, 2u, 0u, 0u, 3u, 3u, 50u};

    TEST_ASSERT_EQUAL_HEX16(0x4683u, crc16_of(frame, sizeof frame));
}

/* CRC-003 */
static void test_crc32_of_the_catalogue(void)
{
    TEST_ASSERT_EQUAL_HEX32(0xCBF43926u, ~crc32_of(digits, LENGTH));
}

/* CRC-003: bytes and their check, the lowest byte first, always leave the same. */
static void test_the_rest_of_bytes_and_their_crc32(void)
{
    static const uint8_t stored[LENGTH + 4u] = {'1', '2', '3',   '4',   '5',   '6',  '7',
                                                '8', '9', 0x26u, 0x39u, 0xF4u, 0xCBu};

    TEST_ASSERT_EQUAL_HEX32(0xDEBB20E3u, crc32_of(stored, sizeof stored));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_crc8_of_the_catalogue);
    RUN_TEST(test_the_rest_of_bytes_and_their_crc8_is_0);
    RUN_TEST(test_crc8_of_a_bit);
    RUN_TEST(test_crc16_of_the_catalogue);
    RUN_TEST(test_crc16_of_a_frame);
    RUN_TEST(test_crc32_of_the_catalogue);
    RUN_TEST(test_the_rest_of_bytes_and_their_crc32);
    return UNITY_END();
}
