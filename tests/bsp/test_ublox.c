/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/devices/ublox.h with a simulated receiver. The settings' bytes are those that
 * pyubx2 builds; tests/tools/test_ublox_settings.py asks it. */
#include "devices/ublox.h"
#include "simulated/ublox.c"
#include "unity.h"

#define TARGET    115200u
#define PERIOD_MS 100u
#define STEP_US   1000u
#define BAUDS     5u
#define SECOND    1000000u

/* Two seconds at first, and for each rate what 220 bytes take (0.35 s for all of them), 0.1 s and
 * 1.2 s; and a step each time that the driver goes on. */
#define LONGEST_US 8900000u

static const uint32_t bauds[BAUDS] = {9600u, 38400u, 115200u, 57600u, 230400u};

static simulated_ublox_t gnss;
static keel_ublox_t driver;

/* All that the line took since the test began, as far as it goes. */
static uint8_t line[4096];
static uint32_t line_bytes;
static uint32_t line_refusals;

static bool send_noted(void *context, uint8_t byte)
{
    const bool is_taken = simulated_ublox_send(context, byte);

    if (is_taken && (line_bytes < sizeof line)) {
        line[line_bytes] = byte;
        line_bytes++;
    }
    line_refusals += is_taken ? 0u : 1u;
    return is_taken;
}

static keel_ublox_port_t the_port(void)
{
    return (keel_ublox_port_t){send_noted, simulated_ublox_set_baud, &gnss};
}

static void begin_with(uint32_t baud, bool knows_messages, bool knows_items)
{
    simulated_ublox_init(&gnss, baud);
    gnss.knows_messages = knows_messages;
    gnss.knows_items = knows_items;
    line_bytes = 0u;
    line_refusals = 0u;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_ublox_begin(&driver, the_port(), TARGET, PERIOD_MS));
}

/* An M8 out of its box. */
void setUp(void)
{
    begin_with(9600u, true, false);
}

void tearDown(void)
{
}

static keel_bsp_status_t step_after(uint32_t time_us)
{
    simulated_ublox_pass(&gnss, time_us);
    return keel_ublox_step(&driver, time_us, gnss.fixes);
}

static void passes(uint32_t time_us)
{
    for (uint32_t passed = 0u; passed < time_us; passed += STEP_US) {
        (void)step_after(STEP_US);
    }
}

/* Steps until a state comes, and tells how long that took. */
static uint32_t time_until(keel_ublox_state_t state, uint32_t limit_us)
{
    uint32_t passed_us = 0u;

    while ((driver.state != state) && (passed_us < limit_us)) {
        (void)step_after(STEP_US);
        passed_us += STEP_US;
    }
    TEST_ASSERT_EQUAL(state, driver.state);
    return passed_us;
}

static void is_set_up(void)
{
    TEST_ASSERT_EQUAL_UINT32(TARGET, gnss.now.baud);
    TEST_ASSERT_EQUAL_UINT32(TARGET, gnss.line_baud);
    TEST_ASSERT_EQUAL_UINT32(PERIOD_MS, gnss.now.period_ms);
    TEST_ASSERT_EQUAL_UINT32(1u, gnss.now.every);
    TEST_ASSERT_EQUAL_UINT32(8u, gnss.now.model);
    TEST_ASSERT_TRUE(gnss.now.ubx_in);
    TEST_ASSERT_TRUE(gnss.now.ubx_out);
    TEST_ASSERT_FALSE(gnss.now.nmea_out);
    TEST_ASSERT_EQUAL_UINT32(0u, gnss.cut);
}

static void UBL_001_it_begins_with_nothing_sent(void)
{
    TEST_ASSERT_EQUAL(KEEL_UBLOX_OFF, driver.state);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, driver.progress.age_us);
    TEST_ASSERT_EQUAL_UINT32(0u, driver.attempts);
    TEST_ASSERT_EQUAL_UINT32(0u, driver.rounds);
    TEST_ASSERT_EQUAL_UINT32(0u, driver.found_baud);
    TEST_ASSERT_EQUAL_UINT32(0u, driver.tried_baud);
    TEST_ASSERT_EQUAL_UINT32(0u, gnss.rates);
    TEST_ASSERT_EQUAL_UINT32(0u, line_bytes);
}

static void begin_refuses(uint32_t baud, uint32_t period_ms)
{
    const keel_ublox_t before = driver;

    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_ublox_begin(&driver, the_port(), baud, period_ms));
    TEST_ASSERT_EQUAL_MEMORY(&before, &driver, sizeof before);
}

/* 100 bytes of 10 bits take 8.7 ms at 115200 baud, and 104.2 ms at 9600. */
static void UBL_001_refused_rates_and_periods(void)
{
    step_after(STEP_US);
    begin_refuses(0u, 100u);
    begin_refuses(19200u, 100u);
    begin_refuses(115201u, 100u);
    begin_refuses(115200u, 0u);
    begin_refuses(115200u, 8u);
    begin_refuses(9600u, 104u);
    begin_refuses(115200u, 1001u);
    begin_refuses(230400u, UINT32_MAX);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_ublox_begin(&driver, the_port(), 115200u, 9u));
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_ublox_begin(&driver, the_port(), 9600u, 105u));
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_ublox_begin(&driver, the_port(), 230400u, 1000u));
    for (uint32_t i = 0u; i < BAUDS; i++) {
        TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_ublox_begin(&driver, the_port(), bauds[i], 200u));
        TEST_ASSERT_EQUAL_UINT32(bauds[i], keel_ublox_baud[i]);
    }
}

static void UBL_002_two_seconds_for_a_receiver_that_comes_up(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_WAIT, step_after(0u));
    TEST_ASSERT_EQUAL(KEEL_UBLOX_LISTENING, driver.state);
    TEST_ASSERT_EQUAL_UINT32(TARGET, gnss.line_baud);
    TEST_ASSERT_EQUAL(KEEL_BSP_WAIT, keel_ublox_step(&driver, 1999999u, 0u));
    TEST_ASSERT_EQUAL_UINT32(1u, gnss.rates);
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, keel_ublox_step(&driver, 1u, 0u));
    TEST_ASSERT_EQUAL(KEEL_UBLOX_SENDING, driver.state);
    TEST_ASSERT_EQUAL_UINT32(9600u, gnss.line_baud);
    TEST_ASSERT_EQUAL_UINT32(0u, line_bytes);
    TEST_ASSERT_EQUAL_UINT32(1u, driver.progress.failures);
}

/* It was set up before, and speaks; so it is in flight, maybe. */
static void UBL_003_a_receiver_that_speaks_is_left_as_it_is(void)
{
    begin_with(TARGET, true, false);
    gnss.factory.every = 1u;
    gnss.factory.period_ms = 200u;
    simulated_ublox_power(&gnss);
    passes(10u * SECOND);
    TEST_ASSERT_EQUAL(KEEL_UBLOX_RUNNING, driver.state);
    TEST_ASSERT_EQUAL_UINT32(TARGET, driver.found_baud);
    TEST_ASSERT_EQUAL_UINT32(0u, driver.attempts);
    TEST_ASSERT_EQUAL_UINT32(0u, line_bytes);
    TEST_ASSERT_EQUAL_UINT32(1u, gnss.rates);
}

/* In their order, those for M9, M10 and F9 first, and the rate last of all. */
static const uint8_t settings[] = {
    /* CFG-VALSET: CFG-UART1OUTPROT-NMEA 0, CFG-UART1INPROT-UBX 1, CFG-UART1OUTPROT-UBX 1. */
    0xB5, 0x62, 0x06, 0x8A, 9, 0, 0, 1, 0, 0, 0x02, 0x00, 0x74, 0x10, 0, 0x20, 0xB7, /**/
    0xB5, 0x62, 0x06, 0x8A, 9, 0, 0, 1, 0, 0, 0x01, 0x00, 0x73, 0x10, 1, 0x1F, 0xB0, /**/
    0xB5, 0x62, 0x06, 0x8A, 9, 0, 0, 1, 0, 0, 0x01, 0x00, 0x74, 0x10, 1, 0x20, 0xB3, /**/
    /* CFG-NAVSPG-DYNMODEL 8, CFG-MSGOUT-UBX_NAV_PVT_UART1 1, CFG-RATE-MEAS 100. */
    0xB5, 0x62, 0x06, 0x8A, 9, 0, 0, 1, 0, 0, 0x21, 0x00, 0x11, 0x20, 8, 0xF4, 0x51,       /**/
    0xB5, 0x62, 0x06, 0x8A, 9, 0, 0, 1, 0, 0, 0x07, 0x00, 0x91, 0x20, 1, 0x53, 0x48,       /**/
    0xB5, 0x62, 0x06, 0x8A, 10, 0, 0, 1, 0, 0, 0x01, 0x00, 0x21, 0x30, 100, 0, 0x51, 0xB9, /**/
    /* CFG-MSG, CFG-RATE and CFG-NAV5. */
    0xB5, 0x62, 0x06, 0x01, 3, 0, 0x01, 0x07, 1, 0x13, 0x51,             /**/
    0xB5, 0x62, 0x06, 0x08, 6, 0, 100, 0, 1, 0, 1, 0, 0x7A, 0x12,        /**/
    0xB5, 0x62, 0x06, 0x24, 36, 0, 1, 0, 8, 0, 0, 0, 0, 0, 0, 0, 0, 0,   /**/
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, /**/
    0, 0x57, 0xF8,                                                       /**/
    /* CFG-UART1-BAUDRATE 115200, and CFG-PRT. */
    0xB5, 0x62, 0x06, 0x8A, 12, 0, 0, 1, 0, 0, 0x01, 0x00, 0x52, 0x40, /**/
    0x00, 0xC2, 0x01, 0x00, 0xF3, 0xA5,                                /**/
    0xB5, 0x62, 0x06, 0x00, 20, 0, 1, 0, 0, 0, 0xD0, 0x08, 0, 0,       /**/
    0x00, 0xC2, 0x01, 0x00, 1, 0, 1, 0, 0, 0, 0, 0, 0xB8, 0x42};

static void UBL_004_the_settings_byte_by_byte(void)
{
    TEST_ASSERT_EQUAL_UINT32(KEEL_UBLOX_BYTES, sizeof settings);
    TEST_ASSERT_EQUAL_UINT32(KEEL_UBLOX_BYTES, driver.size);
    (void)time_until(KEEL_UBLOX_SETTLING, 3u * SECOND);
    TEST_ASSERT_EQUAL_UINT32(sizeof settings, line_bytes);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(settings, line, sizeof settings);
}

/* One receiver does all four messages, another all seven items. */
static void UBL_004_each_generation_takes_its_own(void)
{
    (void)time_until(KEEL_UBLOX_RUNNING, LONGEST_US);
    TEST_ASSERT_EQUAL_UINT32(4u, gnss.acks);
    TEST_ASSERT_EQUAL_UINT32(7u, gnss.naks);
    begin_with(38400u, false, true);
    (void)time_until(KEEL_UBLOX_RUNNING, LONGEST_US);
    TEST_ASSERT_EQUAL_UINT32(7u, gnss.acks);
    TEST_ASSERT_EQUAL_UINT32(3u, gnss.naks); /* CFG-PRT comes at a rate that it has left. */
}

static void is_found(uint32_t baud, bool knows_messages, bool knows_items, uint32_t lag_us)
{
    uint32_t passed_us;

    begin_with(baud, knows_messages, knows_items);
    gnss.lag_us = lag_us;
    passed_us = time_until(KEEL_UBLOX_RUNNING, LONGEST_US);
    is_set_up();
    TEST_ASSERT_EQUAL_UINT32(baud, driver.found_baud);
    TEST_ASSERT_EQUAL_UINT32(0u, driver.rounds);
    TEST_ASSERT_LESS_OR_EQUAL_UINT32(LONGEST_US, passed_us);
    passes(10u * SECOND);
    TEST_ASSERT_EQUAL(KEEL_UBLOX_RUNNING, driver.state);
    TEST_ASSERT_LESS_THAN_UINT32(2u * PERIOD_MS * 1000u, driver.progress.age_us);
}

static void UBL_005_any_generation_at_any_rate(void)
{
    for (uint32_t i = 0u; i < BAUDS; i++) {
        for (uint32_t knows = 1u; knows < 4u; knows++) {
            is_found(bauds[i], (knows & 1u) != 0u, (knows & 2u) != 0u, 0u);
            is_found(bauds[i], (knows & 1u) != 0u, (knows & 2u) != 0u, 50000u);
        }
    }
}

static void UBL_005_an_m8_is_found_at_once(void)
{
    TEST_ASSERT_LESS_THAN_UINT32(2600000u, time_until(KEEL_UBLOX_RUNNING, LONGEST_US));
    TEST_ASSERT_EQUAL_UINT32(1u, driver.attempts);
}

/* Its rate changes after the driver has gone on to others: it is heard between two of them. */
static void UBL_005_a_receiver_that_is_late(void)
{
    gnss.lag_us = 2u * SECOND;
    (void)time_until(KEEL_UBLOX_RUNNING, LONGEST_US);
    is_set_up();
    TEST_ASSERT_EQUAL_UINT32(2u, driver.attempts);
}

static void UBL_006_no_step_sends_many_bytes_or_goes_on_behind_a_refusal(void)
{
    (void)time_until(KEEL_UBLOX_SENDING, 3u * SECOND);
    while (driver.state == KEEL_UBLOX_SENDING) {
        const uint32_t bytes = line_bytes;
        const uint32_t refusals = line_refusals;

        (void)step_after(STEP_US);
        TEST_ASSERT_LESS_OR_EQUAL_UINT32(bytes + KEEL_UBLOX_BURST, line_bytes);
        TEST_ASSERT_LESS_OR_EQUAL_UINT32(refusals + 1u, line_refusals);
    }
    TEST_ASSERT_GREATER_THAN_UINT32(100u, line_refusals);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(settings, line, sizeof settings);
}

static bool send_any(void *context, uint8_t byte)
{
    (void)byte;
    ++*(uint32_t *)context;
    return true;
}

static void set_any(void *context, uint32_t baud)
{
    (void)context;
    (void)baud;
}

/* A line with a buffer of its own takes all that it is given. */
static void UBL_006_a_burst_is_sixteen_bytes(void)
{
    uint32_t taken = 0u;
    const keel_ublox_port_t port = {send_any, set_any, &taken};

    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_ublox_begin(&driver, port, TARGET, PERIOD_MS));
    (void)keel_ublox_step(&driver, 0u, 0u);
    (void)keel_ublox_step(&driver, 2u * SECOND, 0u);
    for (uint32_t i = 1u; i <= 13u; i++) {
        TEST_ASSERT_EQUAL(KEEL_BSP_WAIT, keel_ublox_step(&driver, 10u, 0u));
        TEST_ASSERT_EQUAL_UINT32(i * 16u, taken);
        TEST_ASSERT_EQUAL(KEEL_UBLOX_SENDING, driver.state);
    }
    TEST_ASSERT_EQUAL(KEEL_BSP_WAIT, keel_ublox_step(&driver, 10u, 0u));
    TEST_ASSERT_EQUAL_UINT32(220u, taken);
    TEST_ASSERT_EQUAL(KEEL_UBLOX_SETTLING, driver.state);
}

static void UBL_007_bytes_are_out_before_the_rate_changes(void)
{
    (void)time_until(KEEL_UBLOX_SETTLING, 3u * SECOND);
    TEST_ASSERT_GREATER_THAN_UINT32(0u, gnss.sends_us);
    TEST_ASSERT_EQUAL(KEEL_BSP_WAIT, step_after(99999u));
    TEST_ASSERT_EQUAL_UINT32(9600u, gnss.line_baud);
    TEST_ASSERT_EQUAL(KEEL_BSP_WAIT, step_after(1u));
    TEST_ASSERT_EQUAL_UINT32(TARGET, gnss.line_baud);
    TEST_ASSERT_EQUAL(KEEL_UBLOX_LISTENING, driver.state);
    TEST_ASSERT_EQUAL_UINT32(0u, gnss.cut);
}

static void UBL_008_it_listens_before_it_tries_the_next_rate(void)
{
    simulated_ublox_unplug(&gnss);
    (void)time_until(KEEL_UBLOX_SETTLING, 3u * SECOND);
    (void)time_until(KEEL_UBLOX_LISTENING, SECOND);
    TEST_ASSERT_EQUAL(KEEL_BSP_WAIT, step_after(1199999u));
    TEST_ASSERT_EQUAL_UINT32(TARGET, gnss.line_baud);
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, step_after(1u));
    TEST_ASSERT_EQUAL_UINT32(38400u, gnss.line_baud);
    TEST_ASSERT_EQUAL_UINT32(38400u, driver.tried_baud);
    TEST_ASSERT_EQUAL_UINT32(0u, driver.found_baud);
}

static void UBL_008_rates_in_turn_for_ever(void)
{
    simulated_ublox_unplug(&gnss);
    for (uint32_t i = 1u; i <= (3u * BAUDS); i++) {
        (void)time_until(KEEL_UBLOX_SENDING, 3u * SECOND);
        TEST_ASSERT_EQUAL_UINT32(bauds[(i - 1u) % BAUDS], gnss.line_baud);
        TEST_ASSERT_EQUAL_UINT32(i, driver.attempts);
        TEST_ASSERT_EQUAL_UINT32((i - 1u) / BAUDS, driver.rounds);
        (void)time_until(KEEL_UBLOX_LISTENING, SECOND);
    }
    simulated_ublox_power(&gnss);
    (void)time_until(KEEL_UBLOX_RUNNING, LONGEST_US);
    is_set_up();
}

static void UBL_008_a_receiver_that_noise_made_deaf(void)
{
    begin_with(230400u, true, false);
    (void)time_until(KEEL_UBLOX_SETTLING, 3u * SECOND);
    TEST_ASSERT_GREATER_THAN_UINT32(100u, gnss.wrong);
    (void)time_until(KEEL_UBLOX_RUNNING, LONGEST_US);
    is_set_up();
    TEST_ASSERT_EQUAL_UINT32(5u, driver.attempts);
}

static void UBL_009_without_fixes_it_begins_anew(void)
{
    begin_with(38400u, false, true);
    (void)time_until(KEEL_UBLOX_RUNNING, LONGEST_US);
    passes(SECOND);
    gnss.now.every = 0u;
    while (driver.progress.age_us != 4999000u) {
        TEST_ASSERT_EQUAL(KEEL_BSP_OK, step_after(STEP_US));
    }
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, step_after(STEP_US));
    TEST_ASSERT_EQUAL(KEEL_UBLOX_SENDING, driver.state);
    TEST_ASSERT_EQUAL_UINT32(38400u, gnss.line_baud);
}

/* It comes back as its maker has set it, at the rate at which it was found before. */
static void UBL_009_a_receiver_that_loses_its_supply(void)
{
    begin_with(57600u, true, true);
    (void)time_until(KEEL_UBLOX_RUNNING, LONGEST_US);
    passes(SECOND);
    simulated_ublox_unplug(&gnss);
    passes(SECOND);
    simulated_ublox_power(&gnss);
    TEST_ASSERT_EQUAL_UINT32(57600u, gnss.now.baud);
    (void)time_until(KEEL_UBLOX_SENDING, 5u * SECOND);
    TEST_ASSERT_EQUAL_UINT32(5u, driver.attempts);
    TEST_ASSERT_LESS_THAN_UINT32(500000u, time_until(KEEL_UBLOX_RUNNING, LONGEST_US));
    is_set_up();
    TEST_ASSERT_EQUAL_UINT32(5u, driver.attempts);
}

/* Another receiver is plugged in. */
static void UBL_009_a_receiver_that_spoke_by_itself(void)
{
    UBL_003_a_receiver_that_speaks_is_left_as_it_is();
    simulated_ublox_init(&gnss, 9600u);
    gnss.knows_messages = true;
    (void)time_until(KEEL_UBLOX_SENDING, 6u * SECOND);
    TEST_ASSERT_EQUAL_UINT32(9600u, gnss.line_baud);
    (void)time_until(KEEL_UBLOX_RUNNING, LONGEST_US);
    TEST_ASSERT_EQUAL_UINT32(9600u, driver.found_baud);
    is_set_up();
}

/* It may be heard all the same. */
static void UBL_010_a_line_that_takes_nothing(void)
{
    gnss.is_mute = true;
    (void)time_until(KEEL_UBLOX_SENDING, 3u * SECOND);
    TEST_ASSERT_EQUAL(KEEL_BSP_WAIT, step_after(2999999u));
    TEST_ASSERT_EQUAL(KEEL_UBLOX_SENDING, driver.state);
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, step_after(1u));
    TEST_ASSERT_EQUAL(KEEL_UBLOX_SETTLING, driver.state);
    TEST_ASSERT_EQUAL_UINT32(2u, driver.progress.failures);
    TEST_ASSERT_EQUAL_UINT32(0u, line_bytes);
    (void)time_until(KEEL_UBLOX_LISTENING, SECOND);
    TEST_ASSERT_EQUAL_UINT32(TARGET, gnss.line_baud);
    gnss.now.baud = TARGET;
    gnss.now.every = 1u;
    (void)time_until(KEEL_UBLOX_RUNNING, 2u * SECOND);
}

/* A line that stops to take bytes half-way: they are sent from the first on again. */
static void UBL_010_settings_that_were_cut(void)
{
    (void)time_until(KEEL_UBLOX_SENDING, 3u * SECOND);
    passes(100u * STEP_US);
    gnss.is_mute = true;
    (void)time_until(KEEL_UBLOX_LISTENING, 4u * SECOND);
    TEST_ASSERT_LESS_THAN_UINT32(sizeof settings, line_bytes);
    gnss.is_mute = false;
    line_bytes = 0u;
    (void)time_until(KEEL_UBLOX_SENDING, 2u * SECOND);
    (void)time_until(KEEL_UBLOX_SETTLING, SECOND);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(settings, line, sizeof settings);
    (void)time_until(KEEL_UBLOX_RUNNING, 2u * LONGEST_US);
    is_set_up();
}

/* A fix that came at another rate than the wanted one proves nothing. */
static void UBL_011_only_fixes_at_the_wanted_rate_count(void)
{
    (void)time_until(KEEL_UBLOX_SENDING, 3u * SECOND);
    gnss.fixes++;
    (void)step_after(STEP_US);
    TEST_ASSERT_EQUAL(KEEL_UBLOX_SENDING, driver.state);
    (void)time_until(KEEL_UBLOX_SETTLING, SECOND);
    gnss.now.every = 0u;
    gnss.fixes++;
    (void)step_after(STEP_US);
    TEST_ASSERT_EQUAL(KEEL_UBLOX_SETTLING, driver.state);
    (void)time_until(KEEL_UBLOX_LISTENING, SECOND);
    TEST_ASSERT_EQUAL(KEEL_BSP_WAIT, step_after(STEP_US));
    gnss.fixes++;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, step_after(STEP_US));
    TEST_ASSERT_EQUAL(KEEL_UBLOX_RUNNING, driver.state);
    TEST_ASSERT_EQUAL_UINT32(0u, driver.progress.age_us);
}

static void UBL_011_counts_stay_at_their_end(void)
{
    simulated_ublox_unplug(&gnss);
    driver.attempts = UINT32_MAX;
    driver.rounds = UINT32_MAX;
    driver.progress.failures = UINT32_MAX;
    driver.rate = BAUDS - 1u;
    (void)time_until(KEEL_UBLOX_SENDING, 3u * SECOND);
    (void)time_until(KEEL_UBLOX_LISTENING, SECOND);
    (void)time_until(KEEL_UBLOX_SENDING, 3u * SECOND);
    TEST_ASSERT_EQUAL_UINT32(9600u, gnss.line_baud);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, driver.attempts);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, driver.rounds);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, driver.progress.failures);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(UBL_001_it_begins_with_nothing_sent);
    RUN_TEST(UBL_001_refused_rates_and_periods);
    RUN_TEST(UBL_002_two_seconds_for_a_receiver_that_comes_up);
    RUN_TEST(UBL_003_a_receiver_that_speaks_is_left_as_it_is);
    RUN_TEST(UBL_004_the_settings_byte_by_byte);
    RUN_TEST(UBL_004_each_generation_takes_its_own);
    RUN_TEST(UBL_005_any_generation_at_any_rate);
    RUN_TEST(UBL_005_an_m8_is_found_at_once);
    RUN_TEST(UBL_005_a_receiver_that_is_late);
    RUN_TEST(UBL_006_no_step_sends_many_bytes_or_goes_on_behind_a_refusal);
    RUN_TEST(UBL_006_a_burst_is_sixteen_bytes);
    RUN_TEST(UBL_007_bytes_are_out_before_the_rate_changes);
    RUN_TEST(UBL_008_it_listens_before_it_tries_the_next_rate);
    RUN_TEST(UBL_008_rates_in_turn_for_ever);
    RUN_TEST(UBL_008_a_receiver_that_noise_made_deaf);
    RUN_TEST(UBL_009_without_fixes_it_begins_anew);
    RUN_TEST(UBL_009_a_receiver_that_loses_its_supply);
    RUN_TEST(UBL_009_a_receiver_that_spoke_by_itself);
    RUN_TEST(UBL_010_a_line_that_takes_nothing);
    RUN_TEST(UBL_010_settings_that_were_cut);
    RUN_TEST(UBL_011_only_fixes_at_the_wanted_rate_count);
    RUN_TEST(UBL_011_counts_stay_at_their_end);
    return UNITY_END();
}
