/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file sdmmc.h
 * @brief Host interface for SD cards (RM0410, chapter 39).
 */
#ifndef KEEL_BSP_STM32F767_SDMMC_REGISTERS_H
#define KEEL_BSP_STM32F767_SDMMC_REGISTERS_H

#include "cortex_m7/bits.h"

typedef struct keel_sdmmc {
    volatile uint32_t POWER;
    volatile uint32_t CLKCR;
    volatile uint32_t ARG;
    volatile uint32_t CMD;
    volatile uint32_t RESPCMD;
    volatile uint32_t RESP1;
    volatile uint32_t RESP2;
    volatile uint32_t RESP3;
    volatile uint32_t RESP4;
    volatile uint32_t DTIMER;
    volatile uint32_t DLEN;
    volatile uint32_t DCTRL;
    volatile uint32_t DCOUNT;
    volatile uint32_t STA;
    volatile uint32_t ICR;
    volatile uint32_t MASK;
    volatile uint32_t reserved0[2];
    volatile uint32_t FIFOCNT;
    volatile uint32_t reserved1[13];
    volatile uint32_t FIFO;
} keel_sdmmc_t;

#define SDMMC1_BASE            0x40012C00u
#define SDMMC_POWER_RESET      0x00000000u
#define SDMMC_POWER_PWRCTRL    BITS(0u, 2u)
#define SDMMC_CLKCR_RESET      0x00000000u
#define SDMMC_CLKCR_CLKDIV     BITS(0u, 8u)
#define SDMMC_CLKCR_CLKEN      BITS(8u, 1u)
#define SDMMC_CLKCR_WIDBUS     BITS(11u, 2u)
#define SDMMC_CMD_RESET        0x00000000u
#define SDMMC_CMD_CMDINDEX     BITS(0u, 6u)
#define SDMMC_CMD_WAITRESP     BITS(6u, 2u)
#define SDMMC_CMD_CPSMEN       BITS(10u, 1u)
#define SDMMC_RESPCMD_RESPCMD  BITS(0u, 6u)
#define SDMMC_DCTRL_RESET      0x00000000u
#define SDMMC_DCTRL_DTEN       BITS(0u, 1u)
#define SDMMC_DCTRL_DTDIR      BITS(1u, 1u)
#define SDMMC_DCTRL_DBLOCKSIZE BITS(4u, 4u)
#define SDMMC_STA_RESET        0x00000000u
#define SDMMC_STA_CCRCFAIL     BITS(0u, 1u)
#define SDMMC_STA_DCRCFAIL     BITS(1u, 1u)
#define SDMMC_STA_CTIMEOUT     BITS(2u, 1u)
#define SDMMC_STA_DTIMEOUT     BITS(3u, 1u)
#define SDMMC_STA_TXUNDERR     BITS(4u, 1u)
#define SDMMC_STA_RXOVERR      BITS(5u, 1u)
#define SDMMC_STA_CMDREND      BITS(6u, 1u)
#define SDMMC_STA_CMDSENT      BITS(7u, 1u)
#define SDMMC_STA_DATAEND      BITS(8u, 1u)
#define SDMMC_STA_DBCKEND      BITS(10u, 1u)
#define SDMMC_STA_RXACT        BITS(13u, 1u)
#define SDMMC_STA_TXFIFOHE     BITS(14u, 1u)
#define SDMMC_STA_RXFIFOHF     BITS(15u, 1u)
#define SDMMC_ICR_RESET        0x00000000u
#define SDMMC_ICR_CCRCFAILC    BITS(0u, 1u)
#define SDMMC_ICR_DCRCFAILC    BITS(1u, 1u)
#define SDMMC_ICR_CTIMEOUTC    BITS(2u, 1u)
#define SDMMC_ICR_DTIMEOUTC    BITS(3u, 1u)
#define SDMMC_ICR_TXUNDERRC    BITS(4u, 1u)
#define SDMMC_ICR_RXOVERRC     BITS(5u, 1u)
#define SDMMC_ICR_CMDRENDC     BITS(6u, 1u)
#define SDMMC_ICR_CMDSENTC     BITS(7u, 1u)
#define SDMMC_ICR_DATAENDC     BITS(8u, 1u)
#define SDMMC_ICR_DBCKENDC     BITS(10u, 1u)

#endif
