/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/devices/fm25v02.h with a simulated memory. Opcodes and identity are those of
 * the data sheet 001-84498. */
#include "devices/fm25v02.h"
#include "unity.h"

#include <string.h>

#define BYTES 32768u
#define FINE  UINT32_MAX

/* A memory on a bus, with what can go wrong. */
typedef struct simulation {
    uint8_t byte[BYTES];
    uint8_t identity[9];
    uint32_t exchanges;
    uint32_t fails_at; /* This exchange reports an error … */
    keel_bsp_status_t error;
    uint32_t short_at; /* … this one ends a byte early. */
    uint32_t power;    /* Bytes that are written until it fails. */
    bool is_enabled;
} simulation_t;

static simulation_t memory;

/* Each command ends when the memory is no longer selected: with the exchange. */
static keel_bsp_status_t exchange(void *context, const uint8_t *out, uint8_t *in, uint32_t length,
                                  uint32_t *done)
{
    const uint32_t address = (length > 2u) ? (((uint32_t)out[1] << 8) | out[2]) : 0u;

    TEST_ASSERT_EQUAL_PTR(&memory, context);
    memory.exchanges++;
    *done = 0u;
    if (memory.exchanges == memory.fails_at) {
        return memory.error;
    }
    *done = (memory.exchanges == memory.short_at) ? (length - 1u) : length;
    memset(in, 0xA5, length); /* The line floats while the memory does not drive it. */
    switch (out[0]) {
    case 0x06:
        TEST_ASSERT_EQUAL_UINT32(1u, length);
        memory.is_enabled = true;
        break;
    case 0x02:
        for (uint32_t i = 3u; (i < *done) && memory.is_enabled; i++) {
            if (memory.power > 0u) {
                memory.power -= (memory.power == FINE) ? 0u : 1u;
                memory.byte[(address + i - 3u) % BYTES] = out[i];
            }
        }
        memory.is_enabled = false;
        break;
    case 0x03:
        for (uint32_t i = 3u; i < *done; i++) {
            in[i] = memory.byte[(address + i - 3u) % BYTES];
        }
        break;
    case 0x9F:
        for (uint32_t i = 1u; i < *done; i++) {
            in[i] = memory.identity[i - 1u];
        }
        break;
    default:
        TEST_FAIL_MESSAGE("an opcode that the memory does not know");
        break;
    }
    return KEEL_BSP_OK;
}

static keel_bus_t bus = {exchange, &memory};

void setUp(void)
{
    static const uint8_t identity[9] = {0x7F, 0x7F, 0x7F, 0x7F, 0x7F, 0x7F, 0xC2, 0x22, 0x08};

    memset(&memory, 0, sizeof memory);
    memset(memory.byte, 0xEE, sizeof memory.byte);
    memcpy(memory.identity, identity, sizeof identity);
    memory.fails_at = FINE;
    memory.short_at = FINE;
    memory.power = FINE;
}

void tearDown(void)
{
}

static void FRM_001_both_memories_are_known(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_fm25v02_start(&bus));
    memory.identity[8] = 0x00u;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_fm25v02_start(&bus));
}

static void FRM_001_another_device_is_refused(void)
{
    memory.identity[7] = 0x23u; /* FM25V05: 64 KiB. */
    TEST_ASSERT_EQUAL(KEEL_BSP_ID, keel_fm25v02_start(&bus));
    memory.identity[7] = 0x22u;
    memory.identity[0] = 0x00u;
    TEST_ASSERT_EQUAL(KEEL_BSP_ID, keel_fm25v02_start(&bus));
}

static void FRM_001_a_line_that_does_not_move(void)
{
    memset(memory.identity, 0x00, sizeof memory.identity);
    TEST_ASSERT_EQUAL(KEEL_BSP_STUCK, keel_fm25v02_start(&bus));
    memset(memory.identity, 0xFF, sizeof memory.identity);
    TEST_ASSERT_EQUAL(KEEL_BSP_STUCK, keel_fm25v02_start(&bus));
}

static void FRM_001_a_bus_that_fails(void)
{
    memory.fails_at = 1u;
    memory.error = KEEL_BSP_TIMEOUT;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, keel_fm25v02_start(&bus));
    memory.short_at = 2u;
    TEST_ASSERT_EQUAL(KEEL_BSP_SHORT, keel_fm25v02_start(&bus));
}

static void FRM_002_bytes_are_read(void)
{
    uint8_t bytes[8] = {0u};

    memory.byte[0x1234] = 0x11u;
    memory.byte[0x1235] = 0x22u;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_fm25v02_read(&bus, 0x1234u, bytes, 2u));
    TEST_ASSERT_EQUAL_HEX8(0x11u, bytes[0]);
    TEST_ASSERT_EQUAL_HEX8(0x22u, bytes[1]);
    TEST_ASSERT_EQUAL_HEX8(0x00u, bytes[2]);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_fm25v02_read(&bus, BYTES - 8u, bytes, 8u));
    TEST_ASSERT_EQUAL_HEX8(0xEEu, bytes[7]);
}

static void FRM_003_bytes_are_written(void)
{
    static const uint8_t bytes[8] = {1, 2, 3, 4, 5, 6, 7, 8};

    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_fm25v02_write(&bus, 0x0A0Bu, bytes, 8u));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(bytes, &memory.byte[0x0A0B], 8u);
    TEST_ASSERT_EQUAL_HEX8(0xEEu, memory.byte[0x0A0A]);
    TEST_ASSERT_EQUAL_HEX8(0xEEu, memory.byte[0x0A13]);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_fm25v02_write(&bus, BYTES - 1u, bytes, 1u));
    TEST_ASSERT_EQUAL_HEX8(1u, memory.byte[BYTES - 1u]);
    TEST_ASSERT_FALSE(memory.is_enabled);
}

static void FRM_002_FRM_003_what_is_no_piece_of_it_is_refused(void)
{
    static const struct {
        uint32_t address;
        uint32_t count;
    } wrong[5] = {{0u, 0u}, {0u, 9u}, {BYTES, 1u}, {BYTES - 7u, 8u}, {UINT32_MAX, 8u}};
    uint8_t bytes[9] = {0u};

    for (uint32_t i = 0u; i < 5u; i++) {
        TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT,
                          keel_fm25v02_read(&bus, wrong[i].address, bytes, wrong[i].count));
        TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT,
                          keel_fm25v02_write(&bus, wrong[i].address, bytes, wrong[i].count));
    }
    TEST_ASSERT_EQUAL_UINT32(0u, memory.exchanges);
}

static void FRM_002_FRM_003_a_bus_that_fails(void)
{
    uint8_t bytes[2] = {0x5Au, 0x5Au};

    memory.error = KEEL_BSP_BUS;
    memory.fails_at = 1u;
    TEST_ASSERT_EQUAL(KEEL_BSP_BUS, keel_fm25v02_read(&bus, 0u, bytes, 2u));
    memory.short_at = 2u;
    TEST_ASSERT_EQUAL(KEEL_BSP_SHORT, keel_fm25v02_read(&bus, 0u, bytes, 2u));
    TEST_ASSERT_EQUAL_HEX8(0x5Au, bytes[0]);
    memory.fails_at = 3u;
    TEST_ASSERT_EQUAL(KEEL_BSP_BUS, keel_fm25v02_write(&bus, 0u, bytes, 2u));
    TEST_ASSERT_EQUAL_UINT32(3u, memory.exchanges); /* Not enabled: nothing is written. */
    memory.fails_at = 5u;
    TEST_ASSERT_EQUAL(KEEL_BSP_BUS, keel_fm25v02_write(&bus, 0u, bytes, 2u));
    memory.short_at = 7u;
    TEST_ASSERT_EQUAL(KEEL_BSP_SHORT, keel_fm25v02_write(&bus, 0u, bytes, 2u));
}

/* Slots on it: each save is cut at each byte once; the bytes of a cut save are none or some. */
static void FRM_004_slots_survive_power_cuts(void)
{
    const keel_slots_config_t config = {
        .medium = keel_fm25v02_medium(&bus), .address = {0x100u, 0x200u}, .room = 64u};
    uint32_t saved = 0u;
    keel_slots_t slots;
    uint8_t image[64];
    uint32_t length;

    TEST_ASSERT_EQUAL(KEEL_OK, keel_slots_init(&slots, &config));
    TEST_ASSERT_EQUAL(KEEL_SLOTS_NONE, keel_slots_load(&slots, image, &length));
    for (uint32_t power = 60u; power > 0u; power--) {
        uint8_t next[40];
        keel_slots_result_t result = KEEL_SLOTS_BUSY;

        memset(next, (int)power, sizeof next);
        memory.power = power - 1u;
        TEST_ASSERT_EQUAL(KEEL_OK, keel_slots_begin(&slots, next, sizeof next));
        while (result == KEEL_SLOTS_BUSY) {
            result = keel_slots_step(&slots);
        }
        memory.power = FINE;
        saved = (result == KEEL_SLOTS_DONE) ? power : saved;
        TEST_ASSERT_EQUAL((power > 54u) ? KEEL_SLOTS_DONE : KEEL_SLOTS_VERIFY, result);
        TEST_ASSERT_EQUAL(KEEL_SLOTS_DONE, keel_slots_load(&slots, image, &length));
        TEST_ASSERT_EQUAL_UINT32(sizeof next, length);
        TEST_ASSERT_EACH_EQUAL_HEX8(saved, image, sizeof next);
    }
    memory.fails_at = memory.exchanges + 1u;
    memory.error = KEEL_BSP_BUS;
    TEST_ASSERT_EQUAL(KEEL_SLOTS_DONE, keel_slots_load(&slots, image, &length));
    TEST_ASSERT_EQUAL(KEEL_SLOT_UNREADABLE, slots.slot[0].state);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_slots_begin(&slots, image, 1u));
    memory.fails_at = memory.exchanges + 1u;
    TEST_ASSERT_EQUAL(KEEL_SLOTS_WRITE, keel_slots_step(&slots));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(FRM_001_both_memories_are_known);
    RUN_TEST(FRM_001_another_device_is_refused);
    RUN_TEST(FRM_001_a_line_that_does_not_move);
    RUN_TEST(FRM_001_a_bus_that_fails);
    RUN_TEST(FRM_002_bytes_are_read);
    RUN_TEST(FRM_003_bytes_are_written);
    RUN_TEST(FRM_002_FRM_003_what_is_no_piece_of_it_is_refused);
    RUN_TEST(FRM_002_FRM_003_a_bus_that_fails);
    RUN_TEST(FRM_004_slots_survive_power_cuts);
    return UNITY_END();
}
