/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/stm32f767/power.h. Register contents are from RM0410, 3.7.6 and 4.4. */
#include "stm32f767/power.h"
#include "unity.h"

#include <string.h>

#define DELIVERED 0xFFFFAAFDu /* OPTCR of a chip as delivered: brown-out reset off, locked. */

static keel_flash_t flash;
static keel_rcc_t rcc;
static keel_pwr_t pwr;
static bool slow;           /* The option bytes never end. */
static bool ignored;        /* The level is not taken. */
static uint32_t programmed; /* OPTCR when programming began. */

void setUp(void)
{
    memset(&flash, 0, sizeof flash);
    memset(&rcc, 0, sizeof rcc);
    memset(&pwr, 0, sizeof pwr);
    flash.OPTCR = DELIVERED;
    slow = false;
    ignored = false;
    programmed = 0u;
}

void tearDown(void)
{
}

/* The flash, some time later: what was started ends, with the option bytes as they were taken. */
static void advance(void *context)
{
    (void)context;
    if (((flash.OPTCR & 2u) != 0u) && !slow) {
        programmed = flash.OPTCR;
        flash.OPTCR = (ignored ? (flash.OPTCR | 0xCu) : flash.OPTCR) & ~2u;
    }
    flash.SR = slow ? 0x00010000u : 0u;
}

static const keel_wait_t wait = {5u, advance, NULL};

static void PWR_001_levels(void)
{
    TEST_ASSERT_EQUAL(KEEL_BROWNOUT_OFF, keel_brownout_level(&flash));
    flash.OPTCR = DELIVERED & ~0xCu;
    TEST_ASSERT_EQUAL(KEEL_BROWNOUT_2V7, keel_brownout_level(&flash));
    flash.OPTCR = (DELIVERED & ~0xCu) | 0x8u;
    TEST_ASSERT_EQUAL(KEEL_BROWNOUT_2V1, keel_brownout_level(&flash));
}

static void PWR_002_sets_the_level_and_nothing_else(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_brownout_set(&flash, KEEL_BROWNOUT_2V7, &wait));
    TEST_ASSERT_EQUAL_HEX32(0x4C5D6E7Fu, flash.OPTKEYR); /* The second key came last. */
    /* Started with all but the level as delivered, and locked again at the end. */
    TEST_ASSERT_EQUAL_HEX32(0xFFFFAAF3u, programmed);
    TEST_ASSERT_EQUAL_HEX32(0xFFFFAAF1u, flash.OPTCR);
}

static void PWR_002_a_level_that_is_set_is_not_written(void)
{
    flash.OPTCR = DELIVERED & ~0xCu;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_brownout_set(&flash, KEEL_BROWNOUT_2V7, &wait));
    TEST_ASSERT_EQUAL_HEX32(0u, flash.OPTKEYR);
    TEST_ASSERT_EQUAL_HEX32(DELIVERED & ~0xCu, flash.OPTCR);
}

static void PWR_003_a_busy_flash_is_left_alone(void)
{
    flash.SR = 0x00010000u;
    slow = true;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, keel_brownout_set(&flash, KEEL_BROWNOUT_2V7, &wait));
    TEST_ASSERT_EQUAL_HEX32(0u, flash.OPTKEYR);
    TEST_ASSERT_EQUAL_HEX32(DELIVERED, flash.OPTCR);
}

static void PWR_003_option_bytes_that_never_end(void)
{
    slow = true;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, keel_brownout_set(&flash, KEEL_BROWNOUT_2V7, &wait));
    TEST_ASSERT_BITS_HIGH(1u, flash.OPTCR); /* Locked all the same. */
}

static void PWR_003_a_level_that_is_not_taken(void)
{
    ignored = true;
    TEST_ASSERT_EQUAL(KEEL_BSP_VERIFY, keel_brownout_set(&flash, KEEL_BROWNOUT_2V7, &wait));
}

static void PWR_004_opens_the_backup_memory(void)
{
    pwr.CR1 = PWR_CR1_RESET;
    rcc.AHB1ENR = RCC_AHB1ENR_RESET;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_backup_open(&rcc, &pwr, &wait));
    TEST_ASSERT_EQUAL_HEX32(0x0000C100u, pwr.CR1);
    TEST_ASSERT_EQUAL_HEX32(0x00140000u, rcc.AHB1ENR);
    TEST_ASSERT_EQUAL_HEX32(0x10000000u, rcc.APB1ENR);
}

/* Flags by RM0410, 5.3.21, in which the figure of the reset circuit has every source pull the pin:
 * after power-on 0x0E000000, and behind each other reset PINRSTF beside its own. */
static void PWR_005_each_reset_by_its_flags(void)
{
    static const struct {
        uint32_t csr;
        keel_restart_t restart;
    } told[] = {{0x0E000000u, KEEL_RESTART_POWER},    {0x06000000u, KEEL_RESTART_BROWNOUT},
                {0x24000000u, KEEL_RESTART_WATCHDOG}, {0x44000000u, KEEL_RESTART_WATCHDOG},
                {0x14000000u, KEEL_RESTART_ASKED},    {0x04000000u, KEEL_RESTART_PIN},
                {0x00000003u, KEEL_RESTART_UNTOLD}};

    for (uint32_t i = 0u; i < (sizeof told / sizeof told[0]); i++) {
        TEST_ASSERT_EQUAL_HEX32(told[i].restart, keel_restart_of(told[i].csr));
    }
}

/* A boot loader that resets once more leaves the flags before. */
static void PWR_005_of_several_resets_the_worst(void)
{
    TEST_ASSERT_EQUAL(KEEL_RESTART_WATCHDOG, keel_restart_of(0x3E000000u));
    TEST_ASSERT_EQUAL(KEEL_RESTART_POWER, keel_restart_of(0x1E000000u));
    TEST_ASSERT_EQUAL(KEEL_RESTART_BROWNOUT, keel_restart_of(0x16000000u));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(PWR_001_levels);
    RUN_TEST(PWR_002_sets_the_level_and_nothing_else);
    RUN_TEST(PWR_002_a_level_that_is_set_is_not_written);
    RUN_TEST(PWR_003_a_busy_flash_is_left_alone);
    RUN_TEST(PWR_003_option_bytes_that_never_end);
    RUN_TEST(PWR_003_a_level_that_is_not_taken);
    RUN_TEST(PWR_004_opens_the_backup_memory);
    RUN_TEST(PWR_005_each_reset_by_its_flags);
    RUN_TEST(PWR_005_of_several_resets_the_worst);
    return UNITY_END();
}
