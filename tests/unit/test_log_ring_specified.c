/* SPDX-License-Identifier: Apache-2.0 */
/* The log's ring beside its executable specification (specs/model): random records and reads to
 * both; what they say and what comes out must be the same. */
#include "any.h"
#include "keel/middleware/log_ring.h"
#include "unity.h"

#include <string.h>

/* The model is part of this test: the kernel that it is linked with has none. */
#include "../../specs/model/log_ring.c"

#define CALLS 6000u
#define SEED  20261125u

static keel_log_ring_t ring;
static keel_log_ring_t model;
static uint8_t record[KEEL_LOG_RING_BYTES + 1u];
static uint8_t got[KEEL_LOG_RING_BYTES + 1u];
static uint8_t expected_got[KEEL_LOG_RING_BYTES + 1u];

void setUp(void)
{
    any_from(SEED);
    memset(&ring, 0xFF, sizeof ring);
    memset(&model, 0xFF, sizeof model);
    keel_log_ring_init(&ring);
    model_log_ring_init(&model);
}

void tearDown(void)
{
}

/* Often small, at times more than ever fits. */
static uint32_t any_size(void)
{
    return one_in(16u) ? (any() % (uint32_t)sizeof record) : (any() % 600u);
}

static bool both_write(uint64_t now_us)
{
    const uint32_t size = any_size();
    bool expected;

    for (uint32_t i = 0u; i < size; i += 7u) {
        record[i] = (uint8_t)any();
    }
    expected = model_log_ring_write(&model, record, size, now_us);
    TEST_ASSERT_EQUAL(expected, keel_log_ring_write(&ring, record, size, now_us));
    return expected;
}

static void both_read(void)
{
    const uint32_t most = any_size();
    const uint32_t expected = model_log_ring_read(&model, expected_got, most);

    TEST_ASSERT_EQUAL_UINT32(expected, keel_log_ring_read(&ring, got, most));
    TEST_ASSERT_EQUAL_MEMORY(expected_got, got, sizeof got);
}

static void compare(void)
{
    TEST_ASSERT_EQUAL_UINT32(model.head, ring.head);
    TEST_ASSERT_EQUAL_UINT32(model.tail, ring.tail);
    TEST_ASSERT_EQUAL_UINT32(model.loss.records, ring.loss.records);
    TEST_ASSERT_EQUAL_UINT64(model.loss.since_us, ring.loss.since_us);
    TEST_ASSERT_EQUAL_MEMORY(model.buffer, ring.buffer, sizeof ring.buffer);
}

static bool both_tell(void)
{
    const uint32_t size = any_size();
    keel_log_ring_loss_t loss = {1u, 2u};
    keel_log_ring_loss_t expected_loss = {1u, 2u};
    const bool expected = model_log_ring_take_loss(&model, size, &expected_loss);

    TEST_ASSERT_EQUAL(expected, keel_log_ring_take_loss(&ring, size, &loss));
    TEST_ASSERT_EQUAL_UINT32(expected_loss.records, loss.records);
    TEST_ASSERT_EQUAL_UINT64(expected_loss.since_us, loss.since_us);
    return expected;
}

static void RIN_003_each_call_is_as_specified(void)
{
    uint32_t written = 0u;
    uint32_t lost = 0u;
    uint32_t told = 0u;

    for (uint32_t n = 0u; n < CALLS; n++) {
        switch (any() % 4u) {
        case 0u:
        case 1u:
            if (both_write(n)) {
                written++;
            } else {
                lost++;
            }
            break;
        case 2u:
            both_read();
            break;
        default:
            told += both_tell() ? 1u : 0u;
            break;
        }
        TEST_ASSERT_EQUAL_UINT32(model_log_ring_held(&model), keel_log_ring_held(&ring));
        compare();
    }
    TEST_ASSERT_TRUE((written > (CALLS / 8u)) && (lost > (CALLS / 50u)) && (told > 50u));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(RIN_003_each_call_is_as_specified);
    return UNITY_END();
}
