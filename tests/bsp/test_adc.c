/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/stm32f767/adc.h with a simulated converter. Register contents are from RM0410,
 * 15.13; what counts mean is calculated by hand beside each test. */
#include "stm32f767/adc.h"
#include "unity.h"

#include <string.h>

#define CLOCK_HZ 108000000u
#define CHANNELS 19u

static keel_adc_t adc;
static keel_adc_common_t common;
static uint32_t now_us;        /* The clock; each reading takes a microsecond. */
static bool stopped;           /* The clock stands still. */
static uint32_t cr2_at_first;  /* CR2 when the clock was first read. */
static uint32_t sr_at_first;   /* SR then. */
static uint32_t readings;      /* Of the clock. */
static uint16_t at[CHANNELS];  /* What each channel counts. */
static bool endless;           /* A conversion never ends. */
static bool overrun;           /* It ends, and overran another. */
static uint32_t looks;         /* How often time passed between two looks. */
static uint32_t looks_needed;  /* After how many the conversion ends. */
static uint32_t conversions;   /* How many ended. */
static uint32_t cr2_converted; /* CR2 during the conversion. */

static uint32_t clock_us(void *context)
{
    TEST_ASSERT_EQUAL_PTR(&now_us, context);
    if (readings == 0u) {
        cr2_at_first = adc.CR2;
        sr_at_first = adc.SR;
    }
    readings++;
    now_us += stopped ? 0u : 1u;
    return now_us;
}

/* The converter between two looks: one channel is converted, and its end is told. Reading DR does
 * not clear the flag here, so a driver that forgets to is found. */
static void advance(void *context)
{
    (void)context;
    looks++;
    if (((adc.CR2 & 0x40000001u) != 0x40000001u) || endless || (looks < looks_needed)) {
        return;
    }
    cr2_converted = adc.CR2;
    adc.CR2 &= ~0x40000000u; /* The hardware takes the start back. */
    adc.DR = at[adc.SQR3];
    adc.SR |= overrun ? 0x32u : 0x12u; /* STRT, EOC; and OVR. */
    conversions++;
}

static const keel_wait_t wait = {30u, advance, NULL};
static const keel_adc_device_t device = {&adc, &common, &wait, clock_us, &now_us};

void setUp(void)
{
    memset(&adc, 0, sizeof adc);
    memset(&common, 0, sizeof common);
    now_us = 0xFFFFFFFBu; /* The clock wraps meanwhile. */
    stopped = false;
    readings = 0u;
    cr2_at_first = 77u;
    sr_at_first = 77u;
    for (uint32_t channel = 0u; channel < CHANNELS; channel++) {
        at[channel] = (uint16_t)(100u * channel + 7u);
    }
    endless = false;
    overrun = false;
    looks = 0u;
    looks_needed = 1u;
    conversions = 0u;
    cr2_converted = 0u;
}

void tearDown(void)
{
}

static void start(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_adc_start(&device, CLOCK_HZ));
    readings = 0u;
    cr2_at_first = 77u;
    sr_at_first = 77u;
}

static void ADC_001_twelve_bits_one_conversion_an_eighth_of_the_clock(void)
{
    memset(&adc, 0xFF, sizeof adc); /* Whatever a boot loader left. */
    memset(&common, 0xFF, sizeof common);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_adc_start(&device, CLOCK_HZ));
    TEST_ASSERT_EQUAL_HEX32(0u, adc.CR1);          /* RES 0, neither SCAN nor interrupts. */
    TEST_ASSERT_EQUAL_HEX32(0u, adc.SQR1);         /* L 0: one conversion. */
    TEST_ASSERT_EQUAL_HEX32(0x00000401u, adc.CR2); /* ADON, EOCS: by software, right-aligned. */
    TEST_ASSERT_EQUAL_HEX32(0u, adc.SR);
    /* ADCPRE 3 divides by 8: 13.5 MHz, of 36 at most; MULTI 0. TSVREFE, and no VBATE (bit 22). */
    TEST_ASSERT_EQUAL_HEX32(0x00830000u, common.CCR);
}

static void ADC_002_every_channel_is_sampled_for_10_us(void)
{
    start();
    /* Code 6 is 144 cycles: 144 / 13.5 MHz = 10.67 us. 110 in binary, nine and ten times:
     * 110110110 110110110 110110110 and 110 before another nine of them. */
    TEST_ASSERT_EQUAL_HEX32(0x06DB6DB6u, adc.SMPR1);
    TEST_ASSERT_EQUAL_HEX32(0x36DB6DB6u, adc.SMPR2);
}

static void ADC_003_the_sensors_get_10_us(void)
{
    const uint32_t before_us = now_us;

    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_adc_start(&device, CLOCK_HZ));
    TEST_ASSERT_EQUAL_HEX32(0x00000401u, cr2_at_first); /* On before the time begins. */
    /* The clock's first reading may lie just before its next microsecond: 11 of them are 10 us. The
     * reading that begins the time moves this clock on, too. */
    TEST_ASSERT_EQUAL_UINT32(12u, now_us - before_us);
}

static void ADC_003_a_clock_that_stands_still(void)
{
    stopped = true;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, keel_adc_start(&device, CLOCK_HZ));
    TEST_ASSERT_EQUAL_UINT32(31u, readings);
}

static void starts_at(uint32_t clock_hz)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_adc_start(&device, clock_hz));
}

static void refuses_to_start_at(uint32_t clock_hz)
{
    keel_adc_t adc_before;
    keel_adc_common_t common_before;

    memset(&adc, 0x55, sizeof adc);
    memset(&common, 0x55, sizeof common);
    memcpy(&adc_before, &adc, sizeof adc);
    memcpy(&common_before, &common, sizeof common);
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_adc_start(&device, clock_hz));
    TEST_ASSERT_EQUAL_MEMORY(&adc_before, &adc, sizeof adc);
    TEST_ASSERT_EQUAL_MEMORY(&common_before, &common, sizeof common);
}

static void ADC_001_clocks_that_cannot_be_had_change_nothing(void)
{
    starts_at(4800000u); /* An eighth: 0.6 MHz, the lowest. */
    refuses_to_start_at(4799999u);
    starts_at(115200000u);           /* 144 * 8 / 115.2 MHz = 10 us. */
    refuses_to_start_at(115200001u); /* Shorter than that. */
    refuses_to_start_at(0u);
    refuses_to_start_at(216000000u);
}

static void reads(uint16_t expected, uint32_t channel)
{
    uint16_t count = 9999u;

    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_adc_read(&device, channel, &count));
    TEST_ASSERT_EQUAL_UINT16(expected, count);
}

static void ADC_004_each_channel_by_itself(void)
{
    start();
    reads(7u, 0u);
    reads(307u, 3u);
    reads(1507u, 15u);
    reads(1707u, KEEL_ADC_REFERENCE);   /* 17. */
    reads(1807u, KEEL_ADC_TEMPERATURE); /* 18. */
    reads(107u, 1u);
    TEST_ASSERT_EQUAL_UINT32(6u, conversions);
    TEST_ASSERT_EQUAL_HEX32(0x40000401u, cr2_converted); /* SWSTART, EOCS, ADON. */
}

static void ADC_004_all_of_its_twelve_bits(void)
{
    start();
    at[2] = 0x0FFFu;
    reads(4095u, 2u);
    at[2] = 0u;
    reads(0u, 2u);
}

static void ADC_005_an_end_before_is_not_this_ones(void)
{
    uint16_t count = 77u;

    start();
    reads(307u, 3u); /* Its end is still told, by this converter. */
    looks = 0u;
    looks_needed = 5u;
    reads(407u, 4u);
    TEST_ASSERT_EQUAL_UINT32(5u, looks);
    adc.SR = 0x00000022u; /* An end and an overrun that somebody left. */
    adc.DR = 1234u;
    endless = true;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, keel_adc_read(&device, 4u, &count));
    TEST_ASSERT_EQUAL_UINT16(77u, count);
}

static void ADC_005_an_overrun_before_is_not_this_ones(void)
{
    start();
    adc.SR = 0x00000020u;
    reads(507u, 5u);
}

static void ADC_006_channels_that_are_none(void)
{
    keel_adc_t before;
    uint16_t count = 77u;

    start();
    memcpy(&before, &adc, sizeof adc);
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_adc_read(&device, 16u, &count));
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_adc_read(&device, 19u, &count));
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_adc_read(&device, UINT32_MAX, &count));
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_adc_read(&device, 32u, &count)); /* 0 in 5 bits. */
    TEST_ASSERT_EQUAL_UINT16(77u, count);
    TEST_ASSERT_EQUAL_MEMORY(&before, &adc, sizeof adc);
}

static void ADC_007_a_conversion_that_does_not_end(void)
{
    uint16_t count = 77u;
    uint32_t before_us;

    start();
    before_us = now_us;
    endless = true;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, keel_adc_read(&device, 3u, &count));
    TEST_ASSERT_EQUAL_UINT16(77u, count);
    TEST_ASSERT_EQUAL_UINT32(29u, looks); /* 30 looks, with time between them. */
    /* Off and on: the start is taken back. tSTAB is 3 us, so 4 of the clock's, as above. */
    TEST_ASSERT_EQUAL_HEX32(0x00000401u, cr2_at_first);
    TEST_ASSERT_EQUAL_UINT32(5u, now_us - before_us);
    TEST_ASSERT_EQUAL_HEX32(0u, adc.SR);
    TEST_ASSERT_EQUAL_HEX32(0x00000401u, adc.CR2);
    /* The chip's sensors stay on, and the next conversion is as ever. */
    TEST_ASSERT_EQUAL_HEX32(0x00830000u, common.CCR);
    endless = false;
    reads(707u, 7u);
}

static void ADC_007_nothing_is_waited_for_without_an_end(void)
{
    uint16_t count = 77u;

    start();
    endless = true;
    stopped = true;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, keel_adc_read(&device, 3u, &count));
    TEST_ASSERT_EQUAL_UINT32(31u, readings);
}

static void ADC_008_an_overrun_is_told(void)
{
    uint16_t count = 77u;

    start();
    overrun = true;
    TEST_ASSERT_EQUAL(KEEL_BSP_BUS, keel_adc_read(&device, 3u, &count));
    TEST_ASSERT_EQUAL_UINT16(77u, count);
    TEST_ASSERT_EQUAL_HEX32(0u, sr_at_first); /* Cleared while it is off and on again. */
    TEST_ASSERT_EQUAL_HEX32(0x00000401u, cr2_at_first);
    TEST_ASSERT_EQUAL_HEX32(0x00000401u, adc.CR2);
    overrun = false;
    reads(307u, 3u);
}

/* A chip: 1.21 V is 1502 counts of 3300 mV. */
static const keel_adc_calibration_t chip = {1502u, 943u, 1186u};

static void supply_is(uint32_t expected_mv, uint16_t count)
{
    uint32_t supply_mv = 77u;

    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_adc_supply(&chip, count, &supply_mv));
    TEST_ASSERT_EQUAL_UINT32(expected_mv, supply_mv);
}

static void ADC_009_supplies(void)
{
    supply_is(3300u, 1502u); /* As when it was calibrated. */
    supply_is(3263u, 1519u); /* 4956600 / 1519 = 3263.07. */
    supply_is(3594u, 1379u); /* 4956600 / 1379 = 3594.34. */
    supply_is(3600u, 1377u); /* 4956600 / 1377 = 3599.56: up, and the highest. */
    supply_is(1700u, 2916u); /* 4956600 / 2916 = 1699.79: up, and the lowest. */
}

static void supply_refused(keel_bsp_status_t expected, uint16_t reference, uint16_t count)
{
    const keel_adc_calibration_t other = {reference, 943u, 1186u};
    uint32_t supply_mv = 77u;

    TEST_ASSERT_EQUAL(expected, keel_adc_supply(&other, count, &supply_mv));
    TEST_ASSERT_EQUAL_UINT32(77u, supply_mv);
}

static void ADC_009_halves_go_up(void)
{
    const keel_adc_calibration_t other = {1000u, 943u, 1186u};
    uint32_t supply_mv = 77u;

    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_adc_supply(&other, 960u, &supply_mv));
    TEST_ASSERT_EQUAL_UINT32(3438u, supply_mv); /* 3300000 / 960 = 3437.5. */
}

static void ADC_009_what_is_no_supply_is_refused(void)
{
    supply_refused(KEEL_BSP_RANGE, 1502u, 1376u); /* 3602.18 mV. */
    supply_refused(KEEL_BSP_RANGE, 1502u, 2917u); /* 1699.21 mV. */
    supply_refused(KEEL_BSP_RANGE, 1502u, 0u);    /* Nothing is there. */
    supply_refused(KEEL_BSP_RANGE, 1502u, 4095u);
    supply_refused(KEEL_BSP_RANGE, 1u, 4095u);
    supply_refused(KEEL_BSP_RANGE, 4095u, 1u);
}

static void ADC_009_what_is_no_count_or_calibration_is_refused(void)
{
    supply_refused(KEEL_BSP_ARGUMENT, 1502u, 4096u);
    supply_refused(KEEL_BSP_ARGUMENT, 0xFFFFu, 1502u); /* Blank. */
    supply_refused(KEEL_BSP_ARGUMENT, 4096u, 4000u);
    supply_refused(KEEL_BSP_ARGUMENT, 0u, 1502u);
    supply_refused(KEEL_BSP_ARGUMENT, 0u, 0u);
}

static void pin_is(uint32_t expected_mv, uint16_t count, uint32_t supply_mv)
{
    uint32_t pin_mv = 77u;

    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_adc_pin(count, supply_mv, &pin_mv));
    TEST_ASSERT_EQUAL_UINT32(expected_mv, pin_mv);
}

static void ADC_010_pins(void)
{
    pin_is(0u, 0u, 3300u);
    pin_is(1650u, 2048u, 3300u); /* Half the supply. */
    pin_is(3299u, 4095u, 3300u); /* 13513500 / 4096 = 3299.19. */
    pin_is(817u, 1026u, 3263u);  /* 3347838 / 4096 = 817.34. */
    pin_is(2000u, 3138u, 2611u); /* 8193318 / 4096 = 2000.32. */
    pin_is(2u, 2u, 3072u);       /* 6144 / 4096 = 1.5: up. */
    pin_is(3599u, 4095u, 3600u); /* 14742000 / 4096 = 3599.12. */
    pin_is(1700u, 4095u, 1700u); /* 6961500 / 4096 = 1699.58. */
}

static void pin_refused(uint16_t count, uint32_t supply_mv)
{
    uint32_t pin_mv = 77u;

    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_adc_pin(count, supply_mv, &pin_mv));
    TEST_ASSERT_EQUAL_UINT32(77u, pin_mv);
}

static void ADC_010_what_no_pin_counts_is_refused(void)
{
    pin_refused(4096u, 3300u);
    pin_refused(0xFFFFu, 3300u);
    pin_refused(1000u, 1699u);
    pin_refused(1000u, 3601u);
    pin_refused(1000u, 0u);
    pin_refused(1000u, UINT32_MAX);
}

static void temperature_is(int32_t expected_cdeg, uint16_t count, uint32_t supply_mv)
{
    int32_t cdeg = 77;

    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_adc_temperature(&chip, count, supply_mv, &cdeg));
    TEST_ASSERT_EQUAL_INT32(expected_cdeg, cdeg);
}

static void ADC_011_the_calibrations_themselves(void)
{
    temperature_is(3000, 943u, 3300u);
    temperature_is(11000, 1186u, 3300u);
}

static void ADC_011_temperatures_between_and_beyond(void)
{
    temperature_is(4877, 1000u, 3300u);  /* 57 / 243 of 80 degrees are 18.765. */
    temperature_is(1584, 900u, 3300u);   /* -43 / 243: -14.156. */
    temperature_is(-1708, 800u, 3300u);  /* -143 / 243: -47.078. */
    temperature_is(12481, 1231u, 3300u); /* 288 / 243: 94.815. */
}

static void ADC_011_another_supply_is_taken_into_account(void)
{
    /* 1000 counts of 3263 mV are 988.79 of 3300 mV: 45.79 / 243 of 80 degrees are 15.074. At
     * 3300 mV it would be 48.77. */
    temperature_is(4507, 1000u, 3263u);
    /* 1100 counts of 3000 mV are those at 30 degrees and 57 more. */
    temperature_is(4877, 1100u, 3000u);
}

static void temperature_refused(keel_bsp_status_t expected, uint16_t at_30, uint16_t at_110,
                                uint16_t count, uint32_t supply_mv)
{
    const keel_adc_calibration_t other = {1502u, at_30, at_110};
    int32_t cdeg = 77;

    TEST_ASSERT_EQUAL(expected, keel_adc_temperature(&other, count, supply_mv, &cdeg));
    TEST_ASSERT_EQUAL_INT32(77, cdeg);
}

static void ADC_011_the_ends_of_the_chips_range(void)
{
    const keel_adc_calibration_t even = {1502u, 1000u, 1800u}; /* A tenth of a degree a count. */
    int32_t cdeg = 77;

    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_adc_temperature(&even, 1950u, 3300u, &cdeg));
    TEST_ASSERT_EQUAL_INT32(12500, cdeg);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_adc_temperature(&even, 300u, 3300u, &cdeg));
    TEST_ASSERT_EQUAL_INT32(-4000, cdeg);
    temperature_refused(KEEL_BSP_RANGE, 1000u, 1800u, 1951u, 3300u);
    temperature_refused(KEEL_BSP_RANGE, 1000u, 1800u, 299u, 3300u);
    temperature_refused(KEEL_BSP_RANGE, 943u, 1186u, 0u, 3300u);
    temperature_refused(KEEL_BSP_RANGE, 943u, 1186u, 4095u, 3600u);
    /* As far as the numbers go: 4095 * 3600 - 3300 over a span of one, and the other way. */
    temperature_refused(KEEL_BSP_RANGE, 1u, 2u, 4095u, 3600u);
    temperature_refused(KEEL_BSP_RANGE, 4094u, 4095u, 0u, 1700u);
}

static void ADC_011_rounds_to_the_nearest(void)
{
    const keel_adc_calibration_t third = {1502u, 1000u, 1300u}; /* 26.67 hundredths a count. */
    int32_t cdeg = 77;

    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_adc_temperature(&third, 1001u, 3300u, &cdeg));
    TEST_ASSERT_EQUAL_INT32(3027, cdeg);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_adc_temperature(&third, 1002u, 3300u, &cdeg));
    TEST_ASSERT_EQUAL_INT32(3053, cdeg);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_adc_temperature(&third, 999u, 3300u, &cdeg));
    TEST_ASSERT_EQUAL_INT32(2973, cdeg);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_adc_temperature(&third, 998u, 3300u, &cdeg));
    TEST_ASSERT_EQUAL_INT32(2947, cdeg);
}

static void ADC_011_what_cannot_be_is_refused(void)
{
    temperature_refused(KEEL_BSP_ARGUMENT, 0xFFFFu, 0xFFFFu, 1000u, 3300u); /* Blank. */
    temperature_refused(KEEL_BSP_ARGUMENT, 943u, 0xFFFFu, 1000u, 3300u);
    temperature_refused(KEEL_BSP_ARGUMENT, 0xFFFFu, 1186u, 1000u, 3300u);
    temperature_refused(KEEL_BSP_ARGUMENT, 0u, 1186u, 1000u, 3300u);
    temperature_refused(KEEL_BSP_ARGUMENT, 943u, 4096u, 1000u, 3300u);
    /* Counts that would fall as it grows warm. */
    temperature_refused(KEEL_BSP_ARGUMENT, 1186u, 943u, 1000u, 3300u);
    temperature_refused(KEEL_BSP_ARGUMENT, 943u, 943u, 943u, 3300u);
    temperature_refused(KEEL_BSP_ARGUMENT, 943u, 1186u, 4096u, 3300u);
    temperature_refused(KEEL_BSP_ARGUMENT, 943u, 1186u, 1000u, 1699u);
    temperature_refused(KEEL_BSP_ARGUMENT, 943u, 1186u, 1000u, 3601u);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(ADC_001_twelve_bits_one_conversion_an_eighth_of_the_clock);
    RUN_TEST(ADC_002_every_channel_is_sampled_for_10_us);
    RUN_TEST(ADC_003_the_sensors_get_10_us);
    RUN_TEST(ADC_003_a_clock_that_stands_still);
    RUN_TEST(ADC_001_clocks_that_cannot_be_had_change_nothing);
    RUN_TEST(ADC_004_each_channel_by_itself);
    RUN_TEST(ADC_004_all_of_its_twelve_bits);
    RUN_TEST(ADC_005_an_end_before_is_not_this_ones);
    RUN_TEST(ADC_005_an_overrun_before_is_not_this_ones);
    RUN_TEST(ADC_006_channels_that_are_none);
    RUN_TEST(ADC_007_a_conversion_that_does_not_end);
    RUN_TEST(ADC_007_nothing_is_waited_for_without_an_end);
    RUN_TEST(ADC_008_an_overrun_is_told);
    RUN_TEST(ADC_009_supplies);
    RUN_TEST(ADC_009_halves_go_up);
    RUN_TEST(ADC_009_what_is_no_supply_is_refused);
    RUN_TEST(ADC_009_what_is_no_count_or_calibration_is_refused);
    RUN_TEST(ADC_010_pins);
    RUN_TEST(ADC_010_what_no_pin_counts_is_refused);
    RUN_TEST(ADC_011_the_calibrations_themselves);
    RUN_TEST(ADC_011_temperatures_between_and_beyond);
    RUN_TEST(ADC_011_another_supply_is_taken_into_account);
    RUN_TEST(ADC_011_the_ends_of_the_chips_range);
    RUN_TEST(ADC_011_rounds_to_the_nearest);
    RUN_TEST(ADC_011_what_cannot_be_is_refused);
    return UNITY_END();
}
