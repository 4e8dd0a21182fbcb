/* SPDX-License-Identifier: Apache-2.0 */
#include "stm32f767/sdmmc.h"

#include <stdbool.h>
#include <stddef.h>

#define IDENTIFY_HZ     400000u
#define DIVISOR_MAX     255u
#define DIVISOR_ADD     2u
#define POWER_ON        3u
#define FOUR_LINES      1u
#define ANSWER_SHORT    1u
#define ANSWER_LONG     3u
#define BLOCK_CODE      9u /* 512 bytes, as a power of two. */
#define BURST_WORDS     8u /* What half of the FIFO has room for. */
#define BURST_BYTES     32u
#define WORD_BYTES      4u
#define BYTE_BITS       8u
#define BURSTS          (KEEL_DISK_SECTOR_BYTES / BURST_BYTES)
#define HALF_A_SECOND   2u
#define SETTLE_READINGS 4u

#define FLAGS                                                                                      \
    (SDMMC_ICR_CCRCFAILC | SDMMC_ICR_DCRCFAILC | SDMMC_ICR_CTIMEOUTC | SDMMC_ICR_DTIMEOUTC |       \
     SDMMC_ICR_TXUNDERRC | SDMMC_ICR_RXOVERRC | SDMMC_ICR_CMDRENDC | SDMMC_ICR_CMDSENTC |          \
     SDMMC_ICR_DATAENDC | SDMMC_ICR_DBCKENDC)
#define COMMAND_FLAGS                                                                              \
    (SDMMC_ICR_CCRCFAILC | SDMMC_ICR_CTIMEOUTC | SDMMC_ICR_CMDRENDC | SDMMC_ICR_CMDSENTC)
#define ANSWERED (SDMMC_STA_CCRCFAIL | SDMMC_STA_CTIMEOUT | SDMMC_STA_CMDREND)
#define DATA_ERRORS                                                                                \
    (SDMMC_STA_DCRCFAIL | SDMMC_STA_DTIMEOUT | SDMMC_STA_TXUNDERR | SDMMC_STA_RXOVERR)

keel_bsp_status_t keel_sdmmc_divisor(uint32_t clock_hz, uint32_t limit_hz, uint32_t *divisor)
{
    const uint32_t by = (clock_hz / limit_hz) + (((clock_hz % limit_hz) != 0u) ? 1u : 0u);

    if (by > (DIVISOR_MAX + DIVISOR_ADD)) {
        return KEEL_BSP_ARGUMENT;
    }
    *divisor = (by > DIVISOR_ADD) ? (by - DIVISOR_ADD) : 0u;
    return KEEL_BSP_OK;
}

/* A register that goes to the card's clock takes its next write after three of that clock's periods
 * and two of the bus's (RM0410, 39.8): 82 ns at 48 and 108 MHz. A reading takes 20 ns or more. */
static void settle_registers(const keel_sdmmc_t *sdmmc)
{
    for (uint32_t i = 0u; i < SETTLE_READINGS; i++) {
        (void)sdmmc->STA;
    }
}

keel_bsp_status_t keel_sdmmc_start(keel_sdmmc_host_t *host, keel_sdmmc_t *sdmmc, uint32_t clock_hz,
                                   uint32_t limit_hz, const keel_wait_t *prompt,
                                   const keel_wait_t *patient)
{
    uint32_t identify;
    uint32_t transfer;

    if ((keel_sdmmc_divisor(clock_hz, IDENTIFY_HZ, &identify) != KEEL_BSP_OK) ||
        (keel_sdmmc_divisor(clock_hz, limit_hz, &transfer) != KEEL_BSP_OK)) {
        return KEEL_BSP_ARGUMENT;
    }
    *host = (keel_sdmmc_host_t){sdmmc,    prompt,
                                patient,  identify,
                                transfer, (clock_hz / (transfer + DIVISOR_ADD)) / HALF_A_SECOND};
    sdmmc->DCTRL = 0u;
    sdmmc->CLKCR = 0u;
    sdmmc->POWER = FIELD(SDMMC_POWER_PWRCTRL, POWER_ON);
    settle_registers(sdmmc);
    return KEEL_BSP_OK;
}

static void host_set_bus(void *context, keel_sd_bus_t bus)
{
    const keel_sdmmc_host_t *const host = context;
    const bool is_fast = (bus == KEEL_SD_BUS_TRANSFER);
    const uint32_t divisor = is_fast ? host->transfer_divisor : host->identify_divisor;

    host->sdmmc->CLKCR = FIELD(SDMMC_CLKCR_CLKDIV, divisor) | SDMMC_CLKCR_CLKEN |
                         FIELD(SDMMC_CLKCR_WIDBUS, is_fast ? FOUR_LINES : 0u);
    settle_registers(host->sdmmc);
}

/* Waits until one flag at least is set, with time before each look; the status register then, or
 * 0. */
static uint32_t wait_for_any(const keel_sdmmc_t *sdmmc, uint32_t flags, const keel_wait_t *wait)
{
    uint32_t seen = 0u;

    for (uint32_t look = 0u; (look < wait->looks) && ((seen & flags) == 0u); look++) {
        if (wait->between != NULL) {
            wait->between(wait->context);
        }
        seen = sdmmc->STA;
    }
    return ((seen & flags) != 0u) ? seen : 0u;
}

/* The command register's code of an answer: none, short or long. */
static uint32_t answer_code(keel_sd_answer_t answer)
{
    if (answer == KEEL_SD_SILENT) {
        return 0u;
    }
    return (answer == KEEL_SD_LONG) ? ANSWER_LONG : ANSWER_SHORT;
}

/* What became of a command with an answer. An answer without a checksum is told as one whose
 * checksum is wrong. */
static keel_bsp_status_t judge_answer(const keel_sdmmc_t *sdmmc, const keel_sd_command_t *command,
                                      uint32_t seen)
{
    const bool is_plain = (command->answer == KEEL_SD_PLAIN);
    const bool is_other = (command->answer == KEEL_SD_SHORT) &&
                          (keel_bits_get(sdmmc->RESPCMD, SDMMC_RESPCMD_RESPCMD) != command->index);

    if ((seen & SDMMC_STA_CMDREND) != 0u) {
        return is_other ? KEEL_BSP_BUS : KEEL_BSP_OK;
    }
    if ((seen & SDMMC_STA_CCRCFAIL) != 0u) {
        return is_plain ? KEEL_BSP_OK : KEEL_BSP_BUS;
    }
    return KEEL_BSP_TIMEOUT;
}

static keel_bsp_status_t host_command(void *context, const keel_sd_command_t *command,
                                      uint32_t *answer)
{
    const keel_sdmmc_host_t *const host = context;
    keel_sdmmc_t *const sdmmc = host->sdmmc;
    const bool is_silent = (command->answer == KEEL_SD_SILENT);
    uint32_t seen;
    keel_bsp_status_t status;

    sdmmc->ICR = COMMAND_FLAGS;
    sdmmc->ARG = command->argument;
    sdmmc->CMD = FIELD(SDMMC_CMD_CMDINDEX, command->index) |
                 FIELD(SDMMC_CMD_WAITRESP, answer_code(command->answer)) | SDMMC_CMD_CPSMEN;
    seen = wait_for_any(sdmmc, is_silent ? SDMMC_STA_CMDSENT : ANSWERED, host->prompt);
    if (is_silent) {
        return (seen != 0u) ? KEEL_BSP_OK : KEEL_BSP_TIMEOUT;
    }
    status = judge_answer(sdmmc, command, seen);
    if (status == KEEL_BSP_OK) {
        answer[0] = sdmmc->RESP1;
        if (command->answer == KEEL_SD_LONG) {
            answer[1] = sdmmc->RESP2;
            answer[2] = sdmmc->RESP3;
            answer[3] = sdmmc->RESP4;
        }
    }
    return status;
}

/* Ends whatever is on the data lines, and forgets it. */
static void end_data(keel_sdmmc_t *sdmmc)
{
    sdmmc->DCTRL = 0u;
    settle_registers(sdmmc);
    sdmmc->ICR = FLAGS;
}

static void begin_data(const keel_sdmmc_host_t *host, uint32_t blocks, uint32_t direction)
{
    keel_sdmmc_t *const sdmmc = host->sdmmc;

    end_data(sdmmc);
    sdmmc->DTIMER = host->data_timeout;
    sdmmc->DLEN = blocks * KEEL_DISK_SECTOR_BYTES;
    sdmmc->DCTRL = FIELD(SDMMC_DCTRL_DBLOCKSIZE, BLOCK_CODE) | direction | SDMMC_DCTRL_DTEN;
}

static void host_expect(void *context, uint32_t blocks)
{
    begin_data(context, blocks, SDMMC_DCTRL_DTDIR);
}

/* Waits for a flag of the data; errors come before it. */
static keel_bsp_status_t wait_data(const keel_sdmmc_t *sdmmc, uint32_t flag,
                                   const keel_wait_t *wait)
{
    const uint32_t seen = wait_for_any(sdmmc, flag | DATA_ERRORS, wait);

    if ((seen & DATA_ERRORS & ~SDMMC_STA_DTIMEOUT) != 0u) {
        return KEEL_BSP_BUS;
    }
    return (((seen & SDMMC_STA_DTIMEOUT) != 0u) || (seen == 0u)) ? KEEL_BSP_TIMEOUT : KEEL_BSP_OK;
}

static void take_burst(const keel_sdmmc_t *sdmmc, uint8_t *bytes)
{
    for (uint32_t i = 0u; i < BURST_WORDS; i++) {
        const uint32_t word = sdmmc->FIFO;

        for (uint32_t j = 0u; j < WORD_BYTES; j++) {
            bytes[(WORD_BYTES * i) + j] = (uint8_t)(word >> (BYTE_BITS * j));
        }
    }
}

static keel_bsp_status_t host_take(void *context, uint8_t *bytes, uint32_t blocks)
{
    const keel_sdmmc_host_t *const host = context;
    keel_bsp_status_t status = KEEL_BSP_OK;

    for (uint32_t i = 0u; (i < (blocks * BURSTS)) && (status == KEEL_BSP_OK); i++) {
        status = wait_data(host->sdmmc, SDMMC_STA_RXFIFOHF, host->patient);
        if (status == KEEL_BSP_OK) {
            take_burst(host->sdmmc, &bytes[i * BURST_BYTES]);
        }
    }
    if (status == KEEL_BSP_OK) {
        status = wait_data(host->sdmmc, SDMMC_STA_DATAEND, host->prompt);
    }
    /* The last block's checksum is known when it no longer receives. */
    if ((status == KEEL_BSP_OK) &&
        !keel_wait_for(&host->sdmmc->STA, SDMMC_STA_RXACT, 0u, host->prompt)) {
        status = KEEL_BSP_TIMEOUT;
    }
    if ((status == KEEL_BSP_OK) && ((host->sdmmc->STA & DATA_ERRORS) != 0u)) {
        status = KEEL_BSP_BUS;
    }
    end_data(host->sdmmc);
    return status;
}

static void give_burst(keel_sdmmc_t *sdmmc, const uint8_t *bytes)
{
    for (uint32_t i = 0u; i < BURST_WORDS; i++) {
        uint32_t word = 0u;

        for (uint32_t j = 0u; j < WORD_BYTES; j++) {
            word |= (uint32_t)bytes[(WORD_BYTES * i) + j] << (BYTE_BITS * j);
        }
        sdmmc->FIFO = word;
    }
}

/* The last block is with the card when it has answered that its checksum is right: at that block's
 * end. The flag of the end may be there of the block before; so it is cleared before the last words
 * go, of which most of the last block's are out, as the FIFO has room for them. What follows, the
 * card's being busy, is not waited for. */
static keel_bsp_status_t host_give(void *context, const uint8_t *bytes, uint32_t blocks)
{
    const keel_sdmmc_host_t *const host = context;
    const uint32_t bursts = blocks * BURSTS;
    keel_bsp_status_t status = KEEL_BSP_OK;

    begin_data(host, blocks, 0u);
    for (uint32_t i = 0u; (i < bursts) && (status == KEEL_BSP_OK); i++) {
        /* Behind a block a card may be busy before it takes the next. */
        status = wait_data(host->sdmmc, SDMMC_STA_TXFIFOHE,
                           (i < BURSTS) ? host->prompt : host->patient);
        if (i == (bursts - 1u)) {
            host->sdmmc->ICR = SDMMC_ICR_DBCKENDC;
        }
        if (status == KEEL_BSP_OK) {
            give_burst(host->sdmmc, &bytes[i * BURST_BYTES]);
        }
    }
    if (status == KEEL_BSP_OK) {
        status = wait_data(host->sdmmc, SDMMC_STA_DBCKEND, host->prompt);
    }
    end_data(host->sdmmc);
    return status;
}

keel_sd_host_t keel_sdmmc_host(keel_sdmmc_host_t *host)
{
    return (keel_sd_host_t){host_set_bus, host_command, host_expect, host_take, host_give, host};
}
