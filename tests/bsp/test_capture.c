/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/stm32f767/capture.h. The test is the timer and the DMA: it writes what the
 * timer counts into the ring, and counts down. Register contents are from RM0410, 8.5 and 25.4. */
#include "keel/middleware/ppm.h"
#include "stm32f767/capture.h"
#include "unity.h"

#include <string.h>

#define STREAM   2u
#define CHANNEL  7u
#define BEGIN_US (UINT32_MAX - 1000u) /* The clock wraps in most tests. */
#define EN       0x1u

static const keel_wait_t wait = {3u, NULL, NULL};

static keel_tim_t tim;
static keel_dma_t dma;
static keel_capture_t capture;
static keel_capture_config_t config;
static uint32_t written; /* By DMA, since it was started. */
static uint32_t now_us;  /* Of the clock; the timer counts beside it, with an offset. */

static void start(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_capture_start(&capture, &config, now_us));
    written = 0u;
    tim.SR = 0xFFFFFFFFu ^ TIM_SR_CC1OF; /* Other flags mean nothing. */
}

void setUp(void)
{
    memset(&tim, 0, sizeof tim);
    memset(&dma, 0, sizeof dma);
    memset(&capture, 0x55, sizeof capture);
    now_us = BEGIN_US;
    config = (keel_capture_config_t){&tim, 216000000u, &dma, STREAM, CHANNEL, &wait};
    start();
}

void tearDown(void)
{
}

/* An edge that comes so long after the test's beginning, in us; the timer began at 54321. */
static void edge(uint32_t at_us)
{
    capture.ring[written % KEEL_CAPTURE_CAPACITY] = (uint16_t)(at_us + 54321u);
    written++;
    dma.stream[config.stream].NDTR = KEEL_CAPTURE_CAPACITY - (written % KEEL_CAPTURE_CAPACITY);
}

/* A look so long after the test's beginning, in us. */
static void look(uint32_t at_us)
{
    keel_capture_turn(&capture, BEGIN_US + at_us);
}

static void reads(uint32_t elapsed_us)
{
    uint32_t read_us = 77u;

    TEST_ASSERT_TRUE(keel_capture_read(&capture, &read_us));
    TEST_ASSERT_EQUAL_UINT32(elapsed_us, read_us);
}

static void reads_nothing(void)
{
    uint32_t read_us = 77u;

    TEST_ASSERT_FALSE(keel_capture_read(&capture, &read_us));
    TEST_ASSERT_EQUAL_UINT32(77u, read_us);
}

static void CAP_001_the_timer(void)
{
    TEST_ASSERT_EQUAL_UINT32(215u, tim.PSC);
    TEST_ASSERT_EQUAL_UINT32(65535u, tim.ARR);
    TEST_ASSERT_EQUAL_HEX32(0x000000F1u, tim.CCMR1); /* Input at its own pin, slowest filter. */
    TEST_ASSERT_EQUAL_HEX32(0x00000001u, tim.CCER);  /* Rising edges. */
    TEST_ASSERT_EQUAL_HEX32(0x00000200u, tim.DIER);  /* DMA, and no interrupt. */
    TEST_ASSERT_EQUAL_HEX32(0x00000201u, tim.CR1);   /* On; the filter by a quarter of the clock. */
    TEST_ASSERT_EQUAL_HEX32(0x00000001u, tim.EGR);
    TEST_ASSERT_EQUAL_HEX32(0u, tim.SMCR);
}

static void CAP_001_the_stream(void)
{
    const keel_dma_stream_t *const stream = &dma.stream[STREAM];

    TEST_ASSERT_EQUAL_HEX32((uint32_t)(uintptr_t)&tim.CCR1, stream->PAR);
    TEST_ASSERT_EQUAL_HEX32((uint32_t)(uintptr_t)&capture.ring[0], stream->M0AR);
    TEST_ASSERT_EQUAL_UINT32(KEEL_CAPTURE_CAPACITY, stream->NDTR);
    TEST_ASSERT_EQUAL_HEX32(0u, stream->FCR);
    /* Channel 7, high priority, half words at both ends, memory counts up, circular, on. */
    TEST_ASSERT_EQUAL_HEX32(0x0E022D01u, stream->CR);
    TEST_ASSERT_EQUAL_HEX32(0x003D0000u, dma.LIFCR); /* The flags of stream 2, and no others. */
    TEST_ASSERT_EQUAL_HEX32(0u, dma.HIFCR);
}

static void CAP_001_streams_of_the_upper_word(void)
{
    config.stream = 5u;
    dma.LIFCR = 0u;
    start();
    TEST_ASSERT_EQUAL_HEX32(0x00000F40u, dma.HIFCR);
    TEST_ASSERT_EQUAL_HEX32(0u, dma.LIFCR);
}

static void CAP_001_what_cannot_be_is_refused(void)
{
    const keel_capture_t before = capture;
    const keel_tim_t timer = tim;
    const keel_dma_t streams = dma;
    keel_capture_config_t bad = config;

    bad.stream = 8u;
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_capture_start(&capture, &bad, 5u));
    bad = config;
    bad.channel = 16u;
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_capture_start(&capture, &bad, 5u));
    bad = config;
    bad.timer_hz = 216500000u;
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_capture_start(&capture, &bad, 5u));
    TEST_ASSERT_EQUAL_MEMORY(&before, &capture, sizeof capture);
    TEST_ASSERT_EQUAL_MEMORY(&timer, &tim, sizeof tim);
    TEST_ASSERT_EQUAL_MEMORY(&streams, &dma, sizeof dma);
}

static void CAP_002_starting_anew_forgets(void)
{
    edge(100u);
    look(200u);
    now_us = BEGIN_US + 5000u;
    start();
    TEST_ASSERT_EQUAL_UINT32(0u, capture.count.edges);
    reads_nothing();
    edge(6000u);
    look(6500u);
    reads(1500u); /* Since that start, as the looks say: no edge was before it. */
}

static void CAP_003_edges_of_one_look(void)
{
    edge(100u);
    edge(1100u);
    edge(3600u);
    look(4000u);
    reads(4000u); /* The first has the time of the look. */
    reads(1000u);
    reads(2500u);
    reads_nothing();
    TEST_ASSERT_EQUAL_UINT32(3u, capture.count.edges);
}

/* However late a look comes, times are the timer's. */
static void CAP_003_times_do_not_depend_on_looks(void)
{
    static const uint32_t late_us[] = {0u, 1u, 3u, 700u, 18550u};

    for (uint32_t i = 0u; i < 5u; i++) {
        now_us = BEGIN_US;
        start();
        edge(50u);
        look(100u);
        reads(100u);
        edge(1550u);
        look(1550u + late_us[i]);
        reads(1500u);
    }
}

/* PPM's longest gaps are below 65 ms, but a radio that was lost comes back after any time. */
static void CAP_003_whole_wraps_of_the_timer(void)
{
    static const uint32_t gap_us[] = {1u,      800u,    32767u,  32768u,  32769u,     65535u,
                                      65536u,  65537u,  98303u,  98304u,  98305u,     131071u,
                                      131072u, 131073u, 655360u, 999999u, 3600000000u};
    static const uint32_t before_us[] = {0u, 20000u};

    for (uint32_t i = 0u; i < (sizeof gap_us / sizeof gap_us[0]); i++) {
        for (uint32_t k = 0u; k < 4u; k++) {
            const uint32_t first_us = 20000u;
            const uint32_t second_us = first_us + gap_us[i];
            uint32_t at_us = first_us + before_us[k & 1u];

            now_us = BEGIN_US;
            start();
            edge(first_us);
            look(20000u);
            if (second_us <= at_us) {
                continue; /* Both would be found at once. */
            }
            if (at_us > 20000u) { /* The first is found as late as may be, or at once; … */
                now_us = BEGIN_US;
                start();
                look(20000u);
                edge(first_us);
                look(at_us);
            }
            TEST_ASSERT_EQUAL_UINT32(1u, capture.count.edges);
            while ((at_us + 20000u) < second_us) {
                at_us += 20000u;
                look(at_us);
            }
            edge(second_us);
            at_us = second_us + (((k & 2u) != 0u) ? ((at_us + 20000u) - second_us) : 0u);
            look(at_us); /* … and so is the second. */
            TEST_ASSERT_EQUAL_UINT32(0u, capture.count.laps);
            (void)keel_capture_read(&capture, &at_us);
            reads(gap_us[i]);
        }
    }
}

static void CAP_003_times_stay_at_their_end(void)
{
    edge(10u);
    look(10u);
    reads(10u);
    capture.quiet_us = UINT32_MAX - 100u;
    edge(20u);
    look(120u);
    reads(UINT32_MAX);
    capture.quiet_us = UINT32_MAX - 65536u; /* The last from which the timer's part still fits. */
    capture.last = 0u;
    capture.ring[written % KEEL_CAPTURE_CAPACITY] = 0u;
    written++;
    dma.stream[STREAM].NDTR = KEEL_CAPTURE_CAPACITY - (written % KEEL_CAPTURE_CAPACITY);
    look(120u);
    reads(UINT32_MAX - 65535u);
}

static void CAP_003_the_ring_wraps(void)
{
    look(10000u);
    edge(10000u);
    look(10000u);
    reads(10000u);
    for (uint32_t i = 1u; i < 1000u; i++) {
        edge(10000u + (i * 1500u));
        look(10000u + (i * 1500u) + (i % 7u));
        reads(1500u);
    }
    TEST_ASSERT_EQUAL_UINT32(1000u, capture.count.edges);
    TEST_ASSERT_EQUAL_UINT32(0u, capture.count.laps);
}

static void CAP_004_a_look_that_is_late(void)
{
    edge(100u);
    look(20000u); /* As late as it may be. */
    TEST_ASSERT_EQUAL_UINT32(0u, capture.count.laps);
    edge(20100u);
    look(40001u);
    TEST_ASSERT_EQUAL_UINT32(1u, capture.count.laps);
    reads_nothing(); /* The unread one, too. */
    edge(41000u);
    look(42000u);
    reads(42000u); /* All the time since the start, by the looks. */
    edge(43000u);
    look(43000u);
    reads(2000u); /* And then by the timer again. */
}

static void CAP_004_more_than_may_be_unread(void)
{
    for (uint32_t i = 0u; i < 48u; i++) {
        edge(i * 100u);
    }
    look(5000u);
    TEST_ASSERT_EQUAL_UINT32(0u, capture.count.laps);
    edge(5100u);
    look(5200u);
    TEST_ASSERT_EQUAL_UINT32(1u, capture.count.laps);
    TEST_ASSERT_EQUAL_UINT32(49u, capture.count.edges);
    reads_nothing();
    edge(6000u);
    look(6100u);
    /* 5000 and 47 times 100 were told unread, then 200 and 900 passed. */
    reads(5000u + (47u * 100u) + 200u + 900u);
}

static void CAP_005_edges_that_dma_did_not_take(void)
{
    tim.SR = TIM_SR_CC1OF;
    look(100u);
    TEST_ASSERT_EQUAL_UINT32(1u, capture.count.overruns);
    TEST_ASSERT_EQUAL_HEX32(0xFFFFFDFFu, tim.SR); /* That flag is cleared, and no other. */
    look(200u);
    TEST_ASSERT_EQUAL_UINT32(1u, capture.count.overruns);
}

static void CAP_005_an_error_of_the_transfer(void)
{
    keel_dma_stream_t *const stream = &dma.stream[STREAM];

    edge(100u);
    look(150u);
    edge(200u);
    dma.LISR = 0x00080000u; /* TEIF2. */
    look(250u);             /* The stream is on still: it is told to stop. */
    TEST_ASSERT_EQUAL_UINT32(0u, capture.count.transfers);
    TEST_ASSERT_EQUAL_HEX32(0u, stream->CR & EN);
    reads_nothing();
    look(300u);
    TEST_ASSERT_EQUAL_UINT32(1u, capture.count.transfers);
    TEST_ASSERT_EQUAL_HEX32(EN, stream->CR & EN);
    TEST_ASSERT_EQUAL_UINT32(KEEL_CAPTURE_CAPACITY, stream->NDTR);
    dma.LISR = 0u;
    written = 0u;
    edge(400u);
    look(500u);
    reads(500u);
}

static void CAP_005_errors_of_other_streams(void)
{
    dma.LISR = 0xFFFFFFFFu ^ 0x00080000u;
    dma.HISR = 0xFFFFFFFFu;
    edge(100u);
    look(150u);
    reads(150u);
    TEST_ASSERT_EQUAL_UINT32(0u, capture.count.transfers);
}

static void CAP_006_in_order_and_once(void)
{
    reads_nothing();
    edge(100u);
    reads_nothing(); /* No look has found it. */
    look(200u);
    reads(200u);
    reads_nothing();
}

/* Frames of eight channels by the decoder that is to be fed. */
static void CAP_007_frames_of_ppm(void)
{
    static const keel_ppm_config_t ppm_config = {100000u, 800u, 2200u, 2300u, 0x000Fu, 4u, 2u};
    keel_ppm_t ppm;
    uint32_t at_us = 0u;
    uint32_t taken = 0u;
    uint32_t looked_us = 0u;

    TEST_ASSERT_EQUAL(KEEL_OK, keel_ppm_init(&ppm, &ppm_config));
    for (uint32_t frame = 0u; frame < 5u; frame++) {
        for (uint32_t i = 0u; i < 9u; i++) {
            uint32_t elapsed_us;

            edge(at_us);
            at_us += (i < 8u) ? (1000u + (100u * i)) : 9200u; /* 20 ms in all. */
            looked_us += 2222u;
            look(at_us > looked_us ? looked_us : at_us);
            while (keel_capture_read(&capture, &elapsed_us)) {
                taken += keel_ppm_take(&ppm, elapsed_us) ? 1u : 0u;
            }
        }
    }
    TEST_ASSERT_TRUE(taken >= 2u);
    TEST_ASSERT_EQUAL_UINT8(8u, ppm.channels);
    for (uint32_t i = 0u; i < 8u; i++) {
        TEST_ASSERT_EQUAL_UINT16(1000u + (100u * i), ppm.channel[i]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(CAP_001_the_timer);
    RUN_TEST(CAP_001_the_stream);
    RUN_TEST(CAP_001_streams_of_the_upper_word);
    RUN_TEST(CAP_001_what_cannot_be_is_refused);
    RUN_TEST(CAP_002_starting_anew_forgets);
    RUN_TEST(CAP_003_edges_of_one_look);
    RUN_TEST(CAP_003_times_do_not_depend_on_looks);
    RUN_TEST(CAP_003_whole_wraps_of_the_timer);
    RUN_TEST(CAP_003_times_stay_at_their_end);
    RUN_TEST(CAP_003_the_ring_wraps);
    RUN_TEST(CAP_004_a_look_that_is_late);
    RUN_TEST(CAP_004_more_than_may_be_unread);
    RUN_TEST(CAP_005_edges_that_dma_did_not_take);
    RUN_TEST(CAP_005_an_error_of_the_transfer);
    RUN_TEST(CAP_005_errors_of_other_streams);
    RUN_TEST(CAP_006_in_order_and_once);
    RUN_TEST(CAP_007_frames_of_ppm);
    return UNITY_END();
}
