/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/stm32f767/clock_tree.h on simulated register blocks. Expected values are worked
 * out by hand from RM0410 (5.2, 5.3, 4.1.4 and 3.3.2). */
#include "stm32f767/clock_tree.h"
#include "unity.h"

#include <string.h>

#define MHZ 1000000u

static keel_rcc_t rcc;
static keel_pwr_t pwr;
static keel_flash_t flash;
static uint32_t broken_hse, broken_pll, broken_hsi, broken_switch, broken_overdrive,
    broken_regulator;
static uint32_t broken_latency;

static uint32_t stuck_switch; /* Only the switch to this source does not happen. */

static const keel_clock_registers_t registers = {&rcc, &pwr, &flash};
static const keel_oscillator_t nucleo = {8u * MHZ, true};
static const keel_oscillator_t fmuv5 = {16u * MHZ, false};

static void follow(volatile uint32_t *word, uint32_t control, uint32_t flag, uint32_t broken)
{
    if (broken == 0u) {
        *word = ((*word & control) != 0u) ? (*word | flag) : (*word & ~flag);
    }
}

/* What must hold at every moment, whatever the drivers are waiting for. */
static void check_rules(void)
{
    const bool on_pll = (rcc.CFGR & 0xCu) == 0x8u;
    const bool to_pll = (rcc.CFGR & 0x3u) == 0x2u;

    if (to_pll && !on_pll) { /* About to switch up. */
        TEST_ASSERT_EQUAL_HEX32(7u, flash.ACR & 0xFu);
        TEST_ASSERT_EQUAL_HEX32(0x30000u, pwr.CSR1 & 0x30000u);
        TEST_ASSERT_EQUAL_HEX32(0x9400u, rcc.CFGR & 0xFCF0u);
    }
    if (on_pll) { /* What clocks the core runs. */
        TEST_ASSERT_BITS_HIGH(0x03000000u, rcc.CR);
    }
    if ((rcc.CFGR & 0xCu) == 0u) {
        TEST_ASSERT_BITS_HIGH(0x1u, rcc.CR);
    }
}

/* The hardware, some cycles later. */
static void advance(void *context)
{
    (void)context;
    check_rules();
    follow(&rcc.CR, 1u << 0, 1u << 1, broken_hsi);
    follow(&rcc.CR, 1u << 16, 1u << 17, broken_hse);
    follow(&rcc.CR, 1u << 24, 1u << 25, broken_pll);
    if (broken_overdrive == 0u) {
        pwr.CSR1 |= pwr.CR1 & (1u << 16);
    }
    if (broken_regulator == 0u) {
        pwr.CSR1 |= pwr.CR1 & (1u << 17);
    }
    if ((broken_switch == 0u) || ((rcc.CFGR & 3u) != stuck_switch)) {
        rcc.CFGR = (rcc.CFGR & ~0xCu) | ((rcc.CFGR & 3u) << 2);
    }
    if (broken_latency != 0u) {
        flash.ACR &= ~8u & ~1u; /* The wait states are not taken as they were written. */
    }
}

static const keel_wait_t wait = {20u, advance, NULL};

void setUp(void)
{
    memset(&rcc, 0, sizeof rcc);
    memset(&pwr, 0, sizeof pwr);
    memset(&flash, 0, sizeof flash);
    rcc.CR = RCC_CR_RESET;
    rcc.PLLCFGR = RCC_PLLCFGR_RESET;
    rcc.AHB1ENR = RCC_AHB1ENR_RESET;
    pwr.CR1 = PWR_CR1_RESET;
    broken_hse = broken_pll = broken_hsi = broken_switch = 0u;
    broken_overdrive = broken_regulator = broken_latency = 0u;
    stuck_switch = 0u;
}

void tearDown(void)
{
}

static void plan_is(uint32_t source_hz, uint32_t core_hz, uint32_t m, uint32_t n, uint32_t q)
{
    keel_pll_t pll = {0u, 0u, 0u, 0u};

    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_pll_plan(source_hz, core_hz, &pll));
    TEST_ASSERT_EQUAL_UINT32(m, pll.m);
    TEST_ASSERT_EQUAL_UINT32(n, pll.n);
    TEST_ASSERT_EQUAL_UINT32(2u, pll.p);
    TEST_ASSERT_EQUAL_UINT32(q, pll.q);
}

static void CLT_001_factors(void)
{
    /* 8 / 4 = 2 MHz, * 216 = 432 MHz, / 2 = 216 MHz, / 9 = 48 MHz. */
    plan_is(8u * MHZ, 216u * MHZ, 4u, 216u, 9u);
    plan_is(16u * MHZ, 216u * MHZ, 8u, 216u, 9u);
    plan_is(4u * MHZ, 216u * MHZ, 2u, 216u, 9u);
    plan_is(26u * MHZ, 216u * MHZ, 13u, 216u, 9u);
    /* 2 * 96 = 192 MHz, / 2 = 96 MHz, / 4 = 48 MHz. */
    plan_is(8u * MHZ, 96u * MHZ, 4u, 96u, 4u);
}

static void plan_refuses(uint32_t source_hz, uint32_t core_hz)
{
    keel_pll_t pll = {1u, 2u, 3u, 4u};
    const keel_pll_t before = pll;

    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_pll_plan(source_hz, core_hz, &pll));
    TEST_ASSERT_EQUAL_MEMORY(&before, &pll, sizeof pll);
}

static void CLT_001_what_cannot_be_had_is_refused(void)
{
    plan_refuses(0u, 216u * MHZ);
    plan_refuses(2u * MHZ, 216u * MHZ);
    plan_refuses(28u * MHZ, 216u * MHZ);
    plan_refuses(25u * MHZ, 216u * MHZ);
    plan_refuses((8u * MHZ) + 1u, 216u * MHZ);
    plan_refuses(8u * MHZ, 240u * MHZ);
    plan_refuses(8u * MHZ, 72u * MHZ);
    plan_refuses(8u * MHZ, 200u * MHZ); /* No 48 MHz from 400 MHz. */
}

static void CLT_002_register_word(void)
{
    const keel_pll_t eight = {4u, 216u, 2u, 9u};
    const keel_pll_t sixteen = {8u, 216u, 2u, 9u};
    const keel_pll_t slow = {63u, 432u, 8u, 15u};

    /* Reserved 0x20000000 | Q 9 << 24 | source 1 << 22 | P 0 << 16 | N 216 << 6 | M 4. */
    TEST_ASSERT_EQUAL_HEX32(0x29403604u, keel_pll_word(&eight));
    TEST_ASSERT_EQUAL_HEX32(0x29403608u, keel_pll_word(&sixteen));
    /* Q 15, P 8 is code 3, N 432 << 6 is 0x6C00, M 63. */
    TEST_ASSERT_EQUAL_HEX32(0x2F436C3Fu, keel_pll_word(&slow));
}

static void CLT_003_wait_states(void)
{
    TEST_ASSERT_EQUAL_UINT32(7u, keel_flash_wait_states(216u * MHZ));
    TEST_ASSERT_EQUAL_UINT32(7u, keel_flash_wait_states((210u * MHZ) + 1u));
    TEST_ASSERT_EQUAL_UINT32(6u, keel_flash_wait_states(210u * MHZ));
    TEST_ASSERT_EQUAL_UINT32(1u, keel_flash_wait_states(60u * MHZ));
    TEST_ASSERT_EQUAL_UINT32(0u, keel_flash_wait_states(30u * MHZ));
}

static void CLT_004_bus_divisors(void)
{
    TEST_ASSERT_EQUAL_UINT32(4u, keel_bus_divisor(216u * MHZ, 54u * MHZ));
    TEST_ASSERT_EQUAL_UINT32(2u, keel_bus_divisor(216u * MHZ, 108u * MHZ));
    TEST_ASSERT_EQUAL_UINT32(1u, keel_bus_divisor(16u * MHZ, 54u * MHZ));
    TEST_ASSERT_EQUAL_UINT32(8u, keel_bus_divisor(216u * MHZ, 27u * MHZ));
    TEST_ASSERT_EQUAL_UINT32(16u, keel_bus_divisor(216u * MHZ, 13500000u));
}

static void CLT_005_timer_clocks(void)
{
    TEST_ASSERT_EQUAL_UINT32(108u * MHZ, keel_timer_hz(216u * MHZ, 4u));
    TEST_ASSERT_EQUAL_UINT32(216u * MHZ, keel_timer_hz(216u * MHZ, 2u));
    TEST_ASSERT_EQUAL_UINT32(16u * MHZ, keel_timer_hz(16u * MHZ, 1u));
}

static void running(const keel_oscillator_t *oscillator, uint32_t control, uint32_t pll)
{
    TEST_ASSERT_EQUAL(KEEL_CLOCK_OK, keel_clock_tree_start(&registers, oscillator, &wait));
    TEST_ASSERT_EQUAL_HEX32(control, rcc.CR);
    TEST_ASSERT_EQUAL_HEX32(pll, rcc.PLLCFGR);
    /* The core on the PLL (2, and 2 read back), buses by 1, 4 (code 5 << 10) and 2 (4 << 13). */
    TEST_ASSERT_EQUAL_HEX32(0x0000940Au, rcc.CFGR);
    /* Seven wait states, prefetch, accelerator. */
    TEST_ASSERT_EQUAL_HEX32(0x00000307u, flash.ACR);
    /* Scale 1, over-drive on and switched to. */
    TEST_ASSERT_EQUAL_HEX32(0x0003C000u, pwr.CR1);
    TEST_ASSERT_EQUAL_HEX32(0x10000000u, rcc.APB1ENR);
    /* Timers at twice their bus, serial lines on their bus. */
    TEST_ASSERT_EQUAL_HEX32(0u, rcc.DCKCFGR1);
    TEST_ASSERT_EQUAL_HEX32(0u, rcc.DCKCFGR2);
}

static void CLT_006_from_reset_with_a_clock_from_outside(void)
{
    running(&nucleo, 0x030F0083u, 0x29403604u);
}

static void CLT_006_from_reset_with_a_crystal(void)
{
    running(&fmuv5, 0x030B0083u, 0x29403608u);
}

/* As a boot loader may leave it: everything runs, from a clock from outside. */
static void leave_running(void)
{
    rcc.CR = 0x030F0083u;
    rcc.PLLCFGR = 0x2740A418u;
    rcc.CFGR = 0x0000940Au;
    pwr.CR1 = 0x0003C000u;
    pwr.CSR1 = 0x00034000u;
    flash.ACR = 0x00000307u;
    rcc.DCKCFGR1 = 0x01000000u; /* Timers at four times their bus. */
    rcc.DCKCFGR2 =
        0x18001010u; /* USART3, UART7 and SDMMC1 on the core's clock, 48 MHz of another. */
}

static void CLT_006_whatever_ran_before(void)
{
    leave_running();
    running(&fmuv5, 0x030B0083u, 0x29403608u);
    leave_running();
    running(&nucleo, 0x030F0083u, 0x29403604u);
}

static void fails(keel_clock_fault_t fault)
{
    TEST_ASSERT_EQUAL(fault, keel_clock_tree_start(&registers, &nucleo, &wait));
    TEST_ASSERT_EQUAL_HEX32(0u, rcc.CFGR & 0xFu); /* On the internal oscillator, and to stay. */
}

static void CLT_007_an_oscillator_of_no_use(void)
{
    const keel_oscillator_t odd = {25u * MHZ, false};

    TEST_ASSERT_EQUAL(KEEL_CLOCK_PLAN, keel_clock_tree_start(&registers, &odd, &wait));
    TEST_ASSERT_EQUAL_HEX32(RCC_CR_RESET, rcc.CR);
    TEST_ASSERT_EQUAL_HEX32(0u, rcc.APB1ENR);
}

static void CLT_007_an_internal_oscillator_that_does_not_start(void)
{
    rcc.CR = 0x01010000u;
    rcc.CFGR = 0x4u; /* The core is on the external one. */
    broken_hsi = 1u;
    TEST_ASSERT_EQUAL(KEEL_CLOCK_HSI, keel_clock_tree_start(&registers, &nucleo, &wait));
}

static void CLT_007_a_core_that_stays_on_the_pll(void)
{
    leave_running();
    broken_switch = 1u;
    stuck_switch = 0u;
    TEST_ASSERT_EQUAL(KEEL_CLOCK_TO_HSI, keel_clock_tree_start(&registers, &nucleo, &wait));
    TEST_ASSERT_BITS_HIGH(0x03000000u, rcc.CR); /* What it runs on was left alone. */
}

static void CLT_007_a_pll_that_does_not_stop(void)
{
    leave_running();
    broken_pll = 1u;
    fails(KEEL_CLOCK_PLL_STOP);
}

static void CLT_007_an_oscillator_that_does_not_stop(void)
{
    leave_running();
    broken_hse = 1u;
    fails(KEEL_CLOCK_HSE_STOP);
}

static void CLT_007_an_oscillator_that_never_becomes_ready(void)
{
    broken_hse = 1u;
    fails(KEEL_CLOCK_HSE);
    TEST_ASSERT_BITS_LOW(0x01000000u, rcc.CR); /* The PLL was not even switched on. */
}

static void CLT_007_over_drive_that_never_becomes_ready(void)
{
    broken_overdrive = 1u;
    fails(KEEL_CLOCK_OVERDRIVE);
}

static void CLT_007_a_regulator_that_does_not_follow(void)
{
    broken_regulator = 1u;
    fails(KEEL_CLOCK_OVERDRIVE_SWITCH);
}

static void CLT_007_a_pll_that_never_locks(void)
{
    broken_pll = 1u;
    fails(KEEL_CLOCK_PLL);
}

static void CLT_007_a_flash_that_does_not_take_its_wait_states(void)
{
    broken_latency = 1u;
    fails(KEEL_CLOCK_LATENCY);
}

static void CLT_007_a_core_that_does_not_change_to_the_pll(void)
{
    broken_switch = 1u;
    stuck_switch = 2u;
    fails(KEEL_CLOCK_TO_PLL);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(CLT_001_factors);
    RUN_TEST(CLT_001_what_cannot_be_had_is_refused);
    RUN_TEST(CLT_002_register_word);
    RUN_TEST(CLT_003_wait_states);
    RUN_TEST(CLT_004_bus_divisors);
    RUN_TEST(CLT_005_timer_clocks);
    RUN_TEST(CLT_006_from_reset_with_a_clock_from_outside);
    RUN_TEST(CLT_006_from_reset_with_a_crystal);
    RUN_TEST(CLT_006_whatever_ran_before);
    RUN_TEST(CLT_007_an_oscillator_of_no_use);
    RUN_TEST(CLT_007_an_internal_oscillator_that_does_not_start);
    RUN_TEST(CLT_007_a_core_that_stays_on_the_pll);
    RUN_TEST(CLT_007_a_pll_that_does_not_stop);
    RUN_TEST(CLT_007_an_oscillator_that_does_not_stop);
    RUN_TEST(CLT_007_an_oscillator_that_never_becomes_ready);
    RUN_TEST(CLT_007_over_drive_that_never_becomes_ready);
    RUN_TEST(CLT_007_a_regulator_that_does_not_follow);
    RUN_TEST(CLT_007_a_pll_that_never_locks);
    RUN_TEST(CLT_007_a_flash_that_does_not_take_its_wait_states);
    RUN_TEST(CLT_007_a_core_that_does_not_change_to_the_pll);
    return UNITY_END();
}
