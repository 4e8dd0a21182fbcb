/* SPDX-License-Identifier: Apache-2.0 */
/* Tests of what the start-up code has done before main(), and of the fault record. Expected values
   are the ARMv7-M Architecture Reference Manual's. */
#include "board.h"
#include "cortex_m7/core.h"
#include "cortex_m7/fault.h"
#include "cortex_m7/memory.h"
#include "cortex_m7/mpu.h"
#include "cortex_m7/startup.h"
#include "keel/rtos/scheduler.h"
#include "mps2_an500/watchdog.h"
#include "unity.h"

#include <string.h>

#define WORD(address) (*(volatile uint32_t *)(address))

#define SCB_CCR   0xE000ED14u
#define SCB_VTOR  0xE000ED08u
#define SCB_SHCSR 0xE000ED24u
#define SCB_CPACR 0xE000ED88u
#define FPCCR     0xE000EF34u
#define MPU_TYPE  0xE000ED90u
#define MPU_CTRL  0xE000ED94u
#define SYST_CSR  0xE000E010u
#define SYST_RVR  0xE000E014u
#define SYST_CVR  0xE000E018u

#define COUNTER 0x40028018u
#define BACKUP  0x60000000u

#define ITCM_END   0x4000u
#define DTCM_START 0x20000000u
#define DTCM_END   0x20020000u
#define SRAM_END   0x20080000u

static uint32_t zero;
static uint32_t value = 0x12345678u;
static uint32_t fast_zero KEEL_REALTIME_ZERO;
static uint32_t fast_value KEEL_REALTIME_DATA = 0x9ABCDEF0u;

KEEL_REALTIME_CODE __attribute__((noinline)) static uint32_t fast_function(uint32_t x)
{
    return x + fast_value;
}

void setUp(void)
{
}

void tearDown(void)
{
}

static void BRD_001_memory_is_filled(void)
{
    TEST_ASSERT_EQUAL_HEX32(0u, zero);
    TEST_ASSERT_EQUAL_HEX32(0x12345678u, value);
    TEST_ASSERT_EQUAL_HEX32(0u, fast_zero);
    TEST_ASSERT_EQUAL_HEX32(0x9ABCDEF0u, fast_value);
    TEST_ASSERT_EQUAL_HEX32(0x9ABCDEF1u, fast_function(1u));
}

static void BRD_001_memory_lies_where_it_must(void)
{
    TEST_ASSERT_LESS_THAN_HEX32(ITCM_END, (uint32_t)fast_function);
    TEST_ASSERT_LESS_THAN_HEX32(ITCM_END, (uint32_t)keel_scheduler_step);
    TEST_ASSERT_GREATER_OR_EQUAL_HEX32(DTCM_START, (uint32_t)&fast_zero);
    TEST_ASSERT_LESS_THAN_HEX32(DTCM_END, (uint32_t)&fast_zero);
    TEST_ASSERT_GREATER_OR_EQUAL_HEX32(DTCM_END, (uint32_t)&value);
    TEST_ASSERT_LESS_THAN_HEX32(SRAM_END, (uint32_t)&value);
}

static void BRD_001_stack_lies_in_dtcm(void)
{
    uint32_t local = 0u;

    TEST_ASSERT_EQUAL_HEX32(DTCM_START, (uint32_t)keel_stack_guard);
    TEST_ASSERT_GREATER_THAN_HEX32((uint32_t)keel_stack_bottom, (uint32_t)&local);
    TEST_ASSERT_LESS_THAN_HEX32((uint32_t)keel_stack_top, (uint32_t)&local);
}

static void BRD_002_fpu_stacks_lazily(void)
{
    TEST_ASSERT_BITS_HIGH(0x00F00000u, WORD(SCB_CPACR));
    TEST_ASSERT_BITS_HIGH(0xC0000000u, WORD(FPCCR));
}

static void BRD_002_fpu_rounds_as_the_host(void)
{
    volatile float tiny = 1.0e-38f;
    volatile double third = 1.0 / 3.0;
    uint32_t fpscr;

    __asm volatile("vmrs %0, fpscr" : "=r"(fpscr));
    TEST_ASSERT_EQUAL_HEX32(0u, fpscr & 0x07C00000u); /* Nearest, subnormals kept. */
    tiny = tiny / 16.0f;
    TEST_ASSERT_TRUE(tiny > 0.0f); /* Subnormal. */
    TEST_ASSERT_TRUE((third * 3.0) == 1.0);
}

static void BRD_003_faults_are_told_apart(void)
{
    TEST_ASSERT_BITS_HIGH(0x00070000u, WORD(SCB_SHCSR));
    TEST_ASSERT_BITS_HIGH(1u << 4u, WORD(SCB_CCR)); /* Division by zero traps. */
    TEST_ASSERT_EQUAL_HEX32((uint32_t)keel_vectors, WORD(SCB_VTOR));
}

static void BRD_004_protection_is_on(void)
{
    TEST_ASSERT_EQUAL_HEX32(0x800u, WORD(MPU_TYPE)); /* Eight regions. */
    TEST_ASSERT_EQUAL_HEX32(5u, WORD(MPU_CTRL));     /* On, default map behind, off in faults. */
}

static void BRD_004_attributes_of_a_region(void)
{
    const keel_mpu_region_t code = {0u, 14u, KEEL_MPU_CODE};
    const keel_mpu_region_t data = {0u, 5u, KEEL_MPU_DATA};
    const keel_mpu_region_t device = {0u, 29u, KEEL_MPU_DEVICE};
    const keel_mpu_region_t guard = {0u, 10u, KEEL_MPU_NONE};

    /* XN at 28, AP at 24, TEX at 19, C, B at 17, 16, SIZE at 1, ENABLE at 0. */
    TEST_ASSERT_EQUAL_HEX32(0x050B001Bu, keel_mpu_attributes(&code));
    TEST_ASSERT_EQUAL_HEX32(0x110B0009u, keel_mpu_attributes(&data));
    TEST_ASSERT_EQUAL_HEX32(0x11010039u, keel_mpu_attributes(&device));
    TEST_ASSERT_EQUAL_HEX32(0x100B0013u, keel_mpu_attributes(&guard));
}

static void BRD_004_tables_that_cannot_be(void)
{
    const keel_mpu_region_t good[9] = {
        {0u, 5u, KEEL_MPU_CODE}, {0u, 5u, KEEL_MPU_CODE}, {0u, 5u, KEEL_MPU_CODE},
        {0u, 5u, KEEL_MPU_CODE}, {0u, 5u, KEEL_MPU_CODE}, {0u, 5u, KEEL_MPU_CODE},
        {0u, 5u, KEEL_MPU_CODE}, {0u, 5u, KEEL_MPU_CODE}, {0u, 5u, KEEL_MPU_CODE}};
    const keel_mpu_region_t small = {0u, 4u, KEEL_MPU_CODE};
    const keel_mpu_region_t large = {0u, 32u, KEEL_MPU_CODE};
    const keel_mpu_region_t crooked = {0x20u, 6u, KEEL_MPU_CODE};

    TEST_ASSERT_TRUE(keel_mpu_valid(good, 8u));
    TEST_ASSERT_FALSE(keel_mpu_valid(good, 9u));
    TEST_ASSERT_FALSE(keel_mpu_valid(&small, 1u));
    TEST_ASSERT_FALSE(keel_mpu_valid(&large, 1u));
    TEST_ASSERT_FALSE(keel_mpu_valid(&crooked, 1u));
    TEST_ASSERT_TRUE(keel_mpu_valid(keel_board_regions, keel_board_region_count));
}

/* Both count the same 25 MHz: 20 000 periods of SysTick are 800 us. */
static void BRD_005_time_base_counts_microseconds(void)
{
    uint32_t start_us;
    uint32_t elapsed_us;

    WORD(SYST_RVR) = 19999u;
    WORD(SYST_CVR) = 0u;
    WORD(SYST_CSR) = 5u; /* On, the core's clock, no interrupt. */
    while ((WORD(SYST_CSR) & 0x10000u) == 0u) {
    }
    start_us = keel_board_clock_us(NULL);
    while ((WORD(SYST_CSR) & 0x10000u) == 0u) {
    }
    elapsed_us = keel_board_clock_us(NULL) - start_us;
    WORD(SYST_CSR) = 0u;
    TEST_ASSERT_UINT32_WITHIN(2u, 800u, elapsed_us);
}

/* The counter can be set, so that nobody has to wait for 71 minutes. */
static void BRD_005_time_base_wraps(void)
{
    uint32_t start_us;

    WORD(COUNTER) = 0xFFFFFFF0u;
    start_us = keel_board_clock_us(NULL);
    while ((keel_board_clock_us(NULL) - start_us) < 100u) {
    }
    TEST_ASSERT_GREATER_OR_EQUAL_HEX32(0xFFFFFFF0u, start_us);
    TEST_ASSERT_LESS_THAN_UINT32(200u, keel_board_clock_us(NULL));
}

static void BRD_006_no_fault_after_power_on(void)
{
    TEST_ASSERT_NULL(keel_fault_last());
    TEST_ASSERT_FALSE(keel_fault_take());
}

static void BRD_006_a_record_is_whole_or_not(void)
{
    keel_fault_record_t record;
    uint8_t *const byte = (uint8_t *)&record;

    memset(&record, 0x5A, sizeof record);
    TEST_ASSERT_FALSE(keel_fault_is_whole(&record));
    keel_fault_seal(&record);
    TEST_ASSERT_TRUE(keel_fault_is_whole(&record));
    for (uint32_t i = 0u; i < sizeof record; i++) {
        byte[i] ^= 1u;
        TEST_ASSERT_FALSE(keel_fault_is_whole(&record));
        byte[i] ^= 1u;
    }
    TEST_ASSERT_TRUE(keel_fault_is_whole(&record));
}

/* A record as a fault leaves it, where the linker script puts it. */
static void BRD_006_safe_state_is_entered_once(void)
{
    keel_fault_record_t *const record = (keel_fault_record_t *)BACKUP;

    memset(record, 0, sizeof *record);
    record->count = 3u;
    record->fresh = 1u;
    TEST_ASSERT_FALSE(keel_fault_take()); /* Not sealed: half a record. */
    keel_fault_seal(record);
    TEST_ASSERT_TRUE(keel_fault_take());
    TEST_ASSERT_FALSE(keel_fault_take());
    TEST_ASSERT_EQUAL_PTR(record, keel_fault_last());
    TEST_ASSERT_EQUAL_UINT32(3u, keel_fault_last()->count);
    memset(record, 0, sizeof *record);
    TEST_ASSERT_NULL(keel_fault_last());
}

static void RST_001_another_start_is_allowed_once(void)
{
    TEST_ASSERT_FALSE(keel_fault_take_restart()); /* Nobody has. */
    keel_fault_allow_restart(true);
    TEST_ASSERT_TRUE(keel_fault_take_restart());
    TEST_ASSERT_FALSE(keel_fault_take_restart());
    keel_fault_allow_restart(true);
    keel_fault_allow_restart(false);
    TEST_ASSERT_FALSE(keel_fault_take_restart());
}

/* Three times its limit; a watchdog that bites ends the program. */
static void BRD_010_watchdog_is_fed(void)
{
    const uint32_t start_us = keel_board_clock_us(NULL);

    keel_watchdog_start(500u);
    while ((keel_board_clock_us(NULL) - start_us) < 1500u) {
        keel_watchdog_feed();
    }
    keel_watchdog_stop();
    TEST_ASSERT_NULL(keel_fault_last());
}

static void BRD_007_stack_use_is_seen(void)
{
    const uint32_t before_b = keel_stack_used_b();
    volatile uint8_t large[6000];

    large[0] = 1u;
    TEST_ASSERT_LESS_THAN_UINT32(6000u, before_b);
    TEST_ASSERT_GREATER_OR_EQUAL_UINT32(6000u, keel_stack_used_b() + large[0]);
}

/* A handler that ran would end the program: all of them are faults here. */
static void BRD_011_a_sleep_lasts_as_long(void)
{
    static const uint32_t lengths_us[] = {1u, 2u, 80u, 1000u, 100000u};

    for (uint32_t i = 0u; i < (sizeof lengths_us / sizeof lengths_us[0]); i++) {
        const uint32_t start_us = keel_board_clock_us(NULL);

        keel_board_sleep_us(lengths_us[i]);
        TEST_ASSERT_UINT32_WITHIN(KEEL_BOARD_WAKE_US, lengths_us[i],
                                  keel_board_clock_us(NULL) - start_us);
    }
    TEST_ASSERT_NULL(keel_fault_last());
}

static void BRD_011_no_time_is_no_sleep(void)
{
    const uint32_t start_us = keel_board_clock_us(NULL);

    keel_board_sleep_us(0u);
    TEST_ASSERT_LESS_OR_EQUAL_UINT32(1u, keel_board_clock_us(NULL) - start_us);
}

/* 2^24 - 1 turns at 25 MHz are 671088 us. */
static void BRD_011_a_sleep_is_no_longer_than_its_timer(void)
{
    const uint32_t start_us = keel_board_clock_us(NULL);

    keel_board_sleep_us(UINT32_MAX);
    TEST_ASSERT_UINT32_WITHIN(KEEL_BOARD_WAKE_US, 671088u, keel_board_clock_us(NULL) - start_us);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(BRD_001_memory_is_filled);
    RUN_TEST(BRD_001_memory_lies_where_it_must);
    RUN_TEST(BRD_001_stack_lies_in_dtcm);
    RUN_TEST(BRD_002_fpu_stacks_lazily);
    RUN_TEST(BRD_002_fpu_rounds_as_the_host);
    RUN_TEST(BRD_003_faults_are_told_apart);
    RUN_TEST(BRD_004_protection_is_on);
    RUN_TEST(BRD_004_attributes_of_a_region);
    RUN_TEST(BRD_004_tables_that_cannot_be);
    RUN_TEST(BRD_005_time_base_counts_microseconds);
    RUN_TEST(BRD_005_time_base_wraps);
    RUN_TEST(BRD_011_a_sleep_lasts_as_long);
    RUN_TEST(BRD_011_no_time_is_no_sleep);
    RUN_TEST(BRD_011_a_sleep_is_no_longer_than_its_timer);
    RUN_TEST(BRD_006_no_fault_after_power_on);
    RUN_TEST(BRD_006_a_record_is_whole_or_not);
    RUN_TEST(BRD_006_safe_state_is_entered_once);
    RUN_TEST(RST_001_another_start_is_allowed_once);
    RUN_TEST(BRD_010_watchdog_is_fed);
    RUN_TEST(BRD_007_stack_use_is_seen);
    return UNITY_END();
}
