/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of bsp/stm32f767/sdmmc.h with simulated registers. The FIFO is one word of them, so a
 * burst is told by its last word; the order within one is seen where the image runs. */
#include "stm32f767/sdmmc.h"
#include "unity.h"

#include <string.h>

#define BURSTS 16u /* Of a block. */

static keel_sdmmc_t sdmmc;
static keel_sdmmc_host_t host;
static keel_sd_host_t bus;
static uint32_t flags;   /* What a command's end is told with. */
static uint32_t prompts; /* Looks with either bound. */
static uint32_t patiences;
static uint32_t moved;       /* Bursts. */
static uint32_t breaks_at;   /* Before this burst the data path tells … */
static uint32_t breaks_with; /* … this, or nothing any more when it is 0. */
static uint32_t ends_with;
static uint32_t ends_late; /* And a look later with this, no longer receiving. */
static uint32_t sent[4u * BURSTS];
static bool is_writing;

/* The hardware before a look: what was cleared is gone, then what is due happens. */
static void advance(void)
{
    sdmmc.STA &= ~sdmmc.ICR;
    sdmmc.ICR = 0u;
    if ((sdmmc.CMD & SDMMC_CMD_CPSMEN) != 0u) {
        sdmmc.STA |= flags;
        sdmmc.CMD &= ~SDMMC_CMD_CPSMEN;
    } else if ((sdmmc.DCTRL & SDMMC_DCTRL_DTEN) != 0u) {
        const uint32_t bursts = sdmmc.DLEN / 32u;

        sdmmc.STA &= ~(SDMMC_STA_TXFIFOHE | SDMMC_STA_RXFIFOHF);
        if (is_writing && (moved > 0u)) {
            sent[moved - 1u] = sdmmc.FIFO;
        }
        if ((moved > 0u) && ((moved % BURSTS) == 0u) && (moved < bursts)) {
            sdmmc.STA |= SDMMC_STA_DBCKEND;
        }
        if (moved == breaks_at) {
            sdmmc.STA |= breaks_with;
        } else if (moved < bursts) {
            sdmmc.FIFO = 0x04030201u + (0x01010101u * moved);
            sdmmc.STA |= is_writing ? SDMMC_STA_TXFIFOHE : SDMMC_STA_RXFIFOHF;
            moved++;
        } else if (((sdmmc.STA & SDMMC_STA_DATAEND) != 0u) && (ends_late != 0u)) {
            sdmmc.STA = (sdmmc.STA & ~SDMMC_STA_RXACT) | ends_late;
        } else {
            sdmmc.STA |= ends_with;
        }
    } else {
        /* Nothing is due. */
    }
}

static void in_prompt(void *context)
{
    TEST_ASSERT_EQUAL_PTR(&sdmmc, context);
    prompts++;
    advance();
}

static void in_patient(void *context)
{
    TEST_ASSERT_EQUAL_PTR(&moved, context);
    patiences++;
    advance();
}

static const keel_wait_t prompt = {3u, in_prompt, (void *)&sdmmc};
static const keel_wait_t patient = {5u, in_patient, &moved};

void setUp(void)
{
    memset(&sdmmc, 0, sizeof sdmmc);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK,
                      keel_sdmmc_start(&host, &sdmmc, 48000000u, 16000000u, &prompt, &patient));
    bus = keel_sdmmc_host(&host);
    flags = SDMMC_STA_CMDREND;
    prompts = 0u;
    patiences = 0u;
    moved = 0u;
    breaks_at = UINT32_MAX;
    breaks_with = 0u;
    ends_with = SDMMC_STA_DATAEND | SDMMC_STA_DBCKEND;
    ends_late = 0u;
    is_writing = false;
    memset(sent, 0, sizeof sent);
}

void tearDown(void)
{
}

static void divisor_is(uint32_t expected, uint32_t limit_hz)
{
    uint32_t divisor = 777u;

    TEST_ASSERT_EQUAL(KEEL_BSP_OK, keel_sdmmc_divisor(48000000u, limit_hz, &divisor));
    TEST_ASSERT_EQUAL_UINT32(expected, divisor);
}

static void SDM_001_divisors(void)
{
    uint32_t divisor = 777u;

    divisor_is(118u, 400000u); /* 48 MHz / 120. */
    divisor_is(119u, 399999u);
    divisor_is(1u, 16000000u);
    divisor_is(1u, 23999999u);
    divisor_is(0u, 24000000u);
    divisor_is(0u, 50000000u);
    divisor_is(255u, 186771u); /* 48 MHz / 257 is 186770.4 Hz. */
    divisor = 777u;
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_sdmmc_divisor(48000000u, 186770u, &divisor));
    TEST_ASSERT_EQUAL_UINT32(777u, divisor);
}

static void SDM_002_start(void)
{
    TEST_ASSERT_EQUAL_HEX32(3u, sdmmc.POWER);
    TEST_ASSERT_EQUAL_HEX32(0u, sdmmc.CLKCR);
    TEST_ASSERT_EQUAL_HEX32(0u, sdmmc.MASK);
    TEST_ASSERT_EQUAL_UINT32(8000000u, host.data_timeout); /* Half a second at 16 MHz. */
}

static void SDM_002_a_rate_that_cannot_be_had_changes_nothing(void)
{
    keel_sdmmc_t registers = {0};
    keel_sdmmc_host_t untouched = {0};
    const keel_sdmmc_host_t none = {0};

    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_sdmmc_start(&untouched, &registers, 48000000u, 1000u,
                                                          &prompt, &patient));
    TEST_ASSERT_EQUAL(KEEL_BSP_ARGUMENT, keel_sdmmc_start(&untouched, &registers, 216000000u,
                                                          16000000u, &prompt, &patient));
    TEST_ASSERT_EQUAL_UINT32(0u, registers.POWER);
    TEST_ASSERT_EQUAL_MEMORY(&none, &untouched, sizeof none);
}

static void SDM_003_the_bus(void)
{
    bus.set_bus(bus.context, KEEL_SD_BUS_IDENTIFY);
    TEST_ASSERT_EQUAL_HEX32(0x00000176u, sdmmc.CLKCR); /* On, 118, one line. */
    bus.set_bus(bus.context, KEEL_SD_BUS_TRANSFER);
    TEST_ASSERT_EQUAL_HEX32(0x00000901u, sdmmc.CLKCR); /* On, 1, four lines. */
}

static uint32_t answer[4];

static keel_bsp_status_t send(uint32_t index, keel_sd_answer_t kind)
{
    const keel_sd_command_t command = {index, 0x12345678u, kind};

    for (uint32_t i = 0u; i < 4u; i++) {
        answer[i] = 0x77777777u;
    }
    sdmmc.RESP1 = 0xA1u;
    sdmmc.RESP2 = 0xA2u;
    sdmmc.RESP3 = 0xA3u;
    sdmmc.RESP4 = 0xA4u;
    sdmmc.RESPCMD = index;
    return bus.command(bus.context, &command, answer);
}

static void answer_is(uint32_t first, uint32_t second, uint32_t third, uint32_t fourth)
{
    TEST_ASSERT_EQUAL_HEX32(first, answer[0]);
    TEST_ASSERT_EQUAL_HEX32(second, answer[1]);
    TEST_ASSERT_EQUAL_HEX32(third, answer[2]);
    TEST_ASSERT_EQUAL_HEX32(fourth, answer[3]);
}

static void SDM_004_commands_and_their_answers(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, send(13u, KEEL_SD_SHORT));
    TEST_ASSERT_EQUAL_HEX32(0x12345678u, sdmmc.ARG);
    TEST_ASSERT_EQUAL_HEX32(13u | (1u << 6), sdmmc.CMD);
    answer_is(0xA1u, 0x77777777u, 0x77777777u, 0x77777777u);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, send(9u, KEEL_SD_LONG));
    TEST_ASSERT_EQUAL_HEX32(9u | (3u << 6), sdmmc.CMD);
    answer_is(0xA1u, 0xA2u, 0xA3u, 0xA4u);
    flags = SDMMC_STA_CMDSENT;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, send(0u, KEEL_SD_SILENT));
    TEST_ASSERT_EQUAL_HEX32(0u, sdmmc.CMD);
    answer_is(0x77777777u, 0x77777777u, 0x77777777u, 0x77777777u);
    flags = SDMMC_STA_CCRCFAIL; /* How an answer without a checksum is told. */
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, send(41u, KEEL_SD_PLAIN));
    answer_is(0xA1u, 0x77777777u, 0x77777777u, 0x77777777u);
}

/* The flags of the command before are not taken for this one's. */
static void SDM_004_no_answer_is_that_of_another_command(void)
{
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, send(13u, KEEL_SD_SHORT));
    flags = SDMMC_STA_CTIMEOUT;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, send(13u, KEEL_SD_SHORT));
    answer_is(0x77777777u, 0x77777777u, 0x77777777u, 0x77777777u);
}

static void SDM_005_a_command_without_an_answer(void)
{
    flags = 0u;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, send(13u, KEEL_SD_SHORT));
    TEST_ASSERT_EQUAL_UINT32(3u, prompts);
    TEST_ASSERT_EQUAL_UINT32(0u, patiences);
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, send(0u, KEEL_SD_SILENT));
    flags = SDMMC_STA_CTIMEOUT;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, send(41u, KEEL_SD_PLAIN));
}

static void SDM_005_a_damaged_answer(void)
{
    const keel_sd_command_t command = {13u, 0u, KEEL_SD_SHORT};

    flags = SDMMC_STA_CCRCFAIL;
    TEST_ASSERT_EQUAL(KEEL_BSP_BUS, send(13u, KEEL_SD_SHORT));
    TEST_ASSERT_EQUAL(KEEL_BSP_BUS, send(9u, KEEL_SD_LONG));
    answer_is(0x77777777u, 0x77777777u, 0x77777777u, 0x77777777u);
    flags = SDMMC_STA_CMDREND;
    sdmmc.RESPCMD = 12u; /* It is another command's. */
    TEST_ASSERT_EQUAL(KEEL_BSP_BUS, bus.command(bus.context, &command, answer));
}

static uint8_t bytes[4u * 512u];

static keel_bsp_status_t take(uint32_t blocks)
{
    memset(bytes, 0x77, sizeof bytes);
    bus.expect(bus.context, blocks);
    return bus.take(bus.context, bytes, blocks);
}

/* At the end the data path is off, and its flags are cleared. */
static void data_ended(void)
{
    TEST_ASSERT_EQUAL_HEX32(0u, sdmmc.DCTRL);
    TEST_ASSERT_EQUAL_HEX32(0x000005FFu, sdmmc.ICR);
}

static void SDM_006_blocks_are_taken(void)
{
    bus.expect(bus.context, 2u);
    TEST_ASSERT_EQUAL_HEX32(8000000u, sdmmc.DTIMER);
    TEST_ASSERT_EQUAL_UINT32(1024u, sdmmc.DLEN);
    TEST_ASSERT_EQUAL_HEX32(0x00000093u, sdmmc.DCTRL); /* 2^9 bytes, from the card, on. */
    memset(bytes, 0x77, sizeof bytes);
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, bus.take(bus.context, bytes, 2u));
    for (uint32_t i = 0u; i < 1024u; i++) {
        TEST_ASSERT_EQUAL_HEX8((uint8_t)((i / 32u) + (i % 4u) + 1u), bytes[i]);
    }
    TEST_ASSERT_EQUAL_HEX8(0x77u, bytes[1024]);
    data_ended();
}

static void SDM_007_blocks_that_do_not_come(void)
{
    breaks_at = 0u;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, take(1u));
    TEST_ASSERT_EQUAL_UINT32(5u, patiences); /* A card may let a read wait. */
    data_ended();
    moved = 0u;
    breaks_at = 17u;
    breaks_with = SDMMC_STA_DTIMEOUT;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, take(2u));
    data_ended();
    sdmmc.STA = 0u;
    moved = 0u;
    breaks_at = UINT32_MAX;
    ends_with = 0u;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, take(1u));
    data_ended();
}

static void takes_an_error(uint32_t at, uint32_t error)
{
    sdmmc.STA = 0u;
    moved = 0u;
    breaks_at = at;
    breaks_with = error;
    TEST_ASSERT_EQUAL(KEEL_BSP_BUS, take(2u));
    data_ended();
}

static void SDM_007_blocks_that_are_damaged(void)
{
    takes_an_error(16u, SDMMC_STA_DCRCFAIL);
    takes_an_error(0u, SDMMC_STA_RXOVERR);
    takes_an_error(32u, SDMMC_STA_DCRCFAIL);
    /* Data that are there do not hide it. */
    takes_an_error(5u, SDMMC_STA_RXFIFOHF | SDMMC_STA_RXOVERR);
    takes_an_error(32u, SDMMC_STA_DATAEND | SDMMC_STA_DCRCFAIL);
}

/* The end of the data is told before the last checksum is known. */
static void SDM_007_the_last_checksum_is_waited_for(void)
{
    ends_with = SDMMC_STA_DATAEND | SDMMC_STA_RXACT;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, take(1u));
    data_ended();
    sdmmc.STA = 0u;
    moved = 0u;
    ends_late = SDMMC_STA_DBCKEND;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, take(1u));
    sdmmc.STA = 0u;
    moved = 0u;
    ends_late = SDMMC_STA_DCRCFAIL;
    TEST_ASSERT_EQUAL(KEEL_BSP_BUS, take(1u));
    data_ended();
}

/* A transfer whose command failed was made ready for, and never ended. */
static void SDM_007_a_transfer_that_did_not_come_about_leaves_nothing(void)
{
    bus.expect(bus.context, 2u);
    sdmmc.ICR = 0u;
    bus.expect(bus.context, 1u);
    TEST_ASSERT_EQUAL_HEX32(0x5FFu, sdmmc.ICR); /* Every flag that software clears. */
}

static keel_bsp_status_t give(uint32_t blocks)
{
    for (uint32_t i = 0u; i < sizeof bytes; i++) {
        bytes[i] = (uint8_t)((i / 32u) + (i % 32u));
    }
    is_writing = true;
    return bus.give(bus.context, bytes, blocks);
}

static void SDM_008_blocks_are_given(void)
{
    ends_with = SDMMC_STA_DBCKEND;
    TEST_ASSERT_EQUAL(KEEL_BSP_OK, give(2u));
    TEST_ASSERT_EQUAL_UINT32(1024u, sdmmc.DLEN);
    TEST_ASSERT_EQUAL_UINT32(32u, moved);
    for (uint32_t i = 0u; i < 32u; i++) { /* Bytes 28 to 31 of each, the first one lowest. */
        TEST_ASSERT_EQUAL_HEX32(0x1F1E1D1Cu + (0x01010101u * i), sent[i]);
    }
    data_ended();
}

/* That of the block before it does not count. */
static void SDM_008_the_last_blocks_own_end_is_waited_for(void)
{
    ends_with = 0u;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, give(2u));
    TEST_ASSERT_EQUAL_UINT32(32u, moved);
    data_ended();
}

static void SDM_009_a_card_that_does_not_take_them(void)
{
    breaks_at = 3u;
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, give(1u));
    TEST_ASSERT_EQUAL_UINT32(0u, patiences); /* Not in a task's time. */
    data_ended();
    moved = 0u;
    breaks_at = 17u; /* Behind a block it may be busy for long. */
    TEST_ASSERT_EQUAL(KEEL_BSP_TIMEOUT, give(2u));
    TEST_ASSERT_EQUAL_UINT32(6u, patiences); /* One for burst 16 and five for burst 17. */
    data_ended();
}

static void gives_an_error(uint32_t at, uint32_t error)
{
    sdmmc.STA = 0u;
    moved = 0u;
    breaks_at = at;
    breaks_with = error;
    TEST_ASSERT_EQUAL(KEEL_BSP_BUS, give(2u));
    data_ended();
}

static void SDM_009_blocks_that_are_refused_or_missed(void)
{
    gives_an_error(16u, SDMMC_STA_DCRCFAIL);
    gives_an_error(32u, SDMMC_STA_DCRCFAIL | SDMMC_STA_DBCKEND);
    gives_an_error(5u, SDMMC_STA_TXFIFOHE | SDMMC_STA_TXUNDERR);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(SDM_001_divisors);
    RUN_TEST(SDM_002_start);
    RUN_TEST(SDM_002_a_rate_that_cannot_be_had_changes_nothing);
    RUN_TEST(SDM_003_the_bus);
    RUN_TEST(SDM_004_commands_and_their_answers);
    RUN_TEST(SDM_004_no_answer_is_that_of_another_command);
    RUN_TEST(SDM_005_a_command_without_an_answer);
    RUN_TEST(SDM_005_a_damaged_answer);
    RUN_TEST(SDM_006_blocks_are_taken);
    RUN_TEST(SDM_007_blocks_that_do_not_come);
    RUN_TEST(SDM_007_blocks_that_are_damaged);
    RUN_TEST(SDM_007_the_last_checksum_is_waited_for);
    RUN_TEST(SDM_007_a_transfer_that_did_not_come_about_leaves_nothing);
    RUN_TEST(SDM_008_blocks_are_given);
    RUN_TEST(SDM_008_the_last_blocks_own_end_is_waited_for);
    RUN_TEST(SDM_009_a_card_that_does_not_take_them);
    RUN_TEST(SDM_009_blocks_that_are_refused_or_missed);
    return UNITY_END();
}
