/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/stm32f767/pin.h. Expected register contents are from RM0410, 6.4. */
#include "stm32f767/pin.h"
#include "unity.h"

#include <string.h>

static keel_gpio_t port;
static const keel_pin_t pin0 = {&port, 0u};
static const keel_pin_t pin7 = {&port, 7u};
static const keel_pin_t pin8 = {&port, 8u};
static const keel_pin_t pin15 = {&port, 15u};

void setUp(void)
{
    memset(&port, 0, sizeof port);
}

void tearDown(void)
{
}

static void PIN_001_a_level_is_one_store(void)
{
    keel_pin_write(pin7, true);
    TEST_ASSERT_EQUAL_HEX32(0x00000080u, port.BSRR);
    keel_pin_write(pin7, false);
    TEST_ASSERT_EQUAL_HEX32(0x00800000u, port.BSRR);
    keel_pin_write(pin15, false);
    TEST_ASSERT_EQUAL_HEX32(0x80000000u, port.BSRR);
    TEST_ASSERT_EQUAL_HEX32(0u, port.ODR);
}

static void PIN_002_reads_its_own_bit(void)
{
    port.IDR = 0x00008001u;
    TEST_ASSERT_TRUE(keel_pin_read(pin0));
    TEST_ASSERT_FALSE(keel_pin_read(pin7));
    TEST_ASSERT_TRUE(keel_pin_read(pin15));
}

static void PIN_003_an_output_leaves_its_neighbours(void)
{
    port.MODER = 0xFFFFFFFFu;
    port.PUPDR = 0x55555555u;
    port.OTYPER = 0x0000FFFFu;
    keel_pin_output(pin7, KEEL_DRIVE_PUSH_PULL, true);
    TEST_ASSERT_EQUAL_HEX32(0xFFFF7FFFu, port.MODER);
    TEST_ASSERT_EQUAL_HEX32(0x55551555u, port.PUPDR);
    TEST_ASSERT_EQUAL_HEX32(0x0000FF7Fu, port.OTYPER);
    TEST_ASSERT_EQUAL_HEX32(0x00000080u, port.BSRR);
}

static void PIN_003_an_open_drain(void)
{
    keel_pin_output(pin15, KEEL_DRIVE_OPEN_DRAIN, false);
    TEST_ASSERT_EQUAL_HEX32(0x40000000u, port.MODER);
    TEST_ASSERT_EQUAL_HEX32(0x00008000u, port.OTYPER);
    TEST_ASSERT_EQUAL_HEX32(0x80000000u, port.BSRR);
}

static void PIN_004_an_input(void)
{
    port.MODER = 0xFFFFFFFFu;
    keel_pin_input(pin8, KEEL_PULL_UP);
    TEST_ASSERT_EQUAL_HEX32(0xFFFCFFFFu, port.MODER);
    TEST_ASSERT_EQUAL_HEX32(0x00010000u, port.PUPDR);
    keel_pin_input(pin8, KEEL_PULL_DOWN);
    TEST_ASSERT_EQUAL_HEX32(0x00020000u, port.PUPDR);
    keel_pin_input(pin8, KEEL_PULL_NONE);
    TEST_ASSERT_EQUAL_HEX32(0u, port.PUPDR);
}

static void PIN_005_alternate_functions_of_both_halves(void)
{
    port.AFRH = 0xFFFFFFFFu;
    port.OTYPER = 0x00000100u;
    keel_pin_alternate(pin8, 7u, KEEL_PULL_UP);
    TEST_ASSERT_EQUAL_HEX32(0xFFFFFFF7u, port.AFRH);
    TEST_ASSERT_EQUAL_HEX32(0u, port.AFRL);
    TEST_ASSERT_EQUAL_HEX32(0x00020000u, port.MODER);
    TEST_ASSERT_EQUAL_HEX32(0x00020000u, port.OSPEEDR);
    TEST_ASSERT_EQUAL_HEX32(0x00010000u, port.PUPDR);
    TEST_ASSERT_EQUAL_HEX32(0u, port.OTYPER);
    keel_pin_alternate(pin7, 5u, KEEL_PULL_NONE);
    TEST_ASSERT_EQUAL_HEX32(0x50000000u, port.AFRL);
    TEST_ASSERT_EQUAL_HEX32(0xFFFFFFF7u, port.AFRH);
    TEST_ASSERT_EQUAL_HEX32(0x00028000u, port.MODER);
}

static void PIN_005_an_alternate_function_is_no_open_drain(void)
{
    port.OTYPER = 0x00000001u;
    keel_pin_alternate(pin0, 1u, KEEL_PULL_NONE);
    TEST_ASSERT_EQUAL_HEX32(0u, port.OTYPER);
}

static void PIN_006_an_analogue_pin(void)
{
    port.PUPDR = 0x55555555u; /* What was pulled up would load the divider. */
    keel_pin_analogue(pin7);
    TEST_ASSERT_EQUAL_HEX32(0x0000C000u, port.MODER);
    TEST_ASSERT_EQUAL_HEX32(0x55551555u, port.PUPDR);
    port.MODER = 0x55555555u;
    keel_pin_analogue(pin0);
    TEST_ASSERT_EQUAL_HEX32(0x55555557u, port.MODER);
    TEST_ASSERT_EQUAL_HEX32(0x55551554u, port.PUPDR);
}

static void PIN_007_whose_pin(void)
{
    port.MODER = 0x8000C001u; /* Pin 15 is given, 7 analogue, 0 an output, 8 an input. */
    TEST_ASSERT_TRUE(keel_pin_is_alternate(pin15));
    TEST_ASSERT_FALSE(keel_pin_is_alternate(pin7));
    TEST_ASSERT_FALSE(keel_pin_is_alternate(pin0));
    TEST_ASSERT_FALSE(keel_pin_is_alternate(pin8));
    port.MODER = 0x7FFD3FFEu; /* Each the other way round. */
    TEST_ASSERT_FALSE(keel_pin_is_alternate(pin15));
    TEST_ASSERT_TRUE(keel_pin_is_alternate(pin0));
}

static void PIN_008_an_open_drain_of_a_peripheral(void)
{
    port.MODER = 0xFFFCFFFFu;
    port.PUPDR = 0x00030000u;
    keel_pin_alternate_open_drain(pin8, 4u, KEEL_PULL_NONE);
    TEST_ASSERT_EQUAL_HEX32(0x00000100u, port.OTYPER);
    TEST_ASSERT_EQUAL_HEX32(0x00000004u, port.AFRH);
    TEST_ASSERT_EQUAL_HEX32(0u, port.AFRL);
    TEST_ASSERT_EQUAL_HEX32(0xFFFEFFFFu, port.MODER);
    TEST_ASSERT_EQUAL_HEX32(0x00020000u, port.OSPEEDR);
    TEST_ASSERT_EQUAL_HEX32(0u, port.PUPDR);
    keel_pin_alternate_open_drain(pin7, 4u, KEEL_PULL_UP);
    TEST_ASSERT_EQUAL_HEX32(0x00000180u, port.OTYPER);
    TEST_ASSERT_EQUAL_HEX32(0x40000000u, port.AFRL);
    TEST_ASSERT_EQUAL_HEX32(0x00004000u, port.PUPDR);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(PIN_001_a_level_is_one_store);
    RUN_TEST(PIN_002_reads_its_own_bit);
    RUN_TEST(PIN_003_an_output_leaves_its_neighbours);
    RUN_TEST(PIN_003_an_open_drain);
    RUN_TEST(PIN_004_an_input);
    RUN_TEST(PIN_005_alternate_functions_of_both_halves);
    RUN_TEST(PIN_005_an_alternate_function_is_no_open_drain);
    RUN_TEST(PIN_006_an_analogue_pin);
    RUN_TEST(PIN_007_whose_pin);
    RUN_TEST(PIN_008_an_open_drain_of_a_peripheral);
    return UNITY_END();
}
