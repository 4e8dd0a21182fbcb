/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file core.h
 * @brief Registers of the Cortex-M7 that Keel uses (ARMv7-M Architecture Reference Manual, B3).
 *
 * Each name, offset, field and reset value is held against an independent register database by
 * tools/keel registers, which reads the names below: keel_<block>, <BLOCK>_BASE,
 * <BLOCK>_<REGISTER>_<FIELD> and <BLOCK>_<REGISTER>_RESET.
 */
#ifndef KEEL_BSP_CORTEX_M7_CORE_H
#define KEEL_BSP_CORTEX_M7_CORE_H

#include "cortex_m7/bits.h"

/** System control block. */
typedef struct keel_scb {
    volatile uint32_t CPUID;
    volatile uint32_t ICSR;
    volatile uint32_t VTOR;
    volatile uint32_t AIRCR;
    volatile uint32_t SCR;
    volatile uint32_t CCR;
    volatile uint32_t SHPR1;
    volatile uint32_t SHPR2;
    volatile uint32_t SHPR3;
    volatile uint32_t SHCSR;
    volatile uint32_t CFSR;
    volatile uint32_t HFSR;
    volatile uint32_t DFSR;
    volatile uint32_t MMFAR;
    volatile uint32_t BFAR;
    volatile uint32_t reserved0[15];
    volatile uint32_t CLIDR;
    volatile uint32_t CTR;
    volatile uint32_t CCSIDR;
    volatile uint32_t CSSELR;
    volatile uint32_t CPACR;
} keel_scb_t;

#define SCB_BASE                 0xE000ED00u
#define SCB_AIRCR_SYSRESETREQ    BITS(2u, 1u)
#define SCB_AIRCR_PRIGROUP       BITS(8u, 3u)
#define SCB_AIRCR_VECTKEYSTAT    BITS(16u, 16u)
#define SCB_AIRCR_KEY            0x05FAu /* What must be written to VECTKEYSTAT. */
#define SCB_ICSR_PENDSTCLR       BITS(25u, 1u)
#define SCB_ICSR_PENDSTSET       BITS(26u, 1u)
#define SCB_CCR_DIV_0_TRP        BITS(4u, 1u)
#define SCB_CCR_STKALIGN         BITS(9u, 1u)
#define SCB_CCR_DC               BITS(16u, 1u)
#define SCB_CCR_IC               BITS(17u, 1u)
#define SCB_SHCSR_MEMFAULTENA    BITS(16u, 1u)
#define SCB_SHCSR_BUSFAULTENA    BITS(17u, 1u)
#define SCB_SHCSR_USGFAULTENA    BITS(18u, 1u)
#define SCB_CFSR_DACCVIOL        BITS(1u, 1u)
#define SCB_CFSR_MSTKERR         BITS(4u, 1u)
#define SCB_CFSR_MMARVALID       BITS(7u, 1u)
#define SCB_CFSR_BFARVALID       BITS(15u, 1u)
#define SCB_CFSR_UNDEFINSTR      BITS(16u, 1u)
#define SCB_CFSR_DIVBYZERO       BITS(25u, 1u)
#define SCB_HFSR_FORCED          BITS(30u, 1u)
#define SCB_CCSIDR_NUMSETS       BITS(13u, 15u)
#define SCB_CCSIDR_ASSOCIATIVITY BITS(3u, 10u)
#define SCB_CPACR_CP             BITS(20u, 4u) /* CP10 and CP11: the FPU. */

/** Cache maintenance operations; write only. */
typedef struct keel_cbp {
    volatile uint32_t ICIALLU;
    volatile uint32_t reserved0;
    volatile uint32_t ICIMVAU;
    volatile uint32_t DCIMVAC;
    volatile uint32_t DCISW;
    volatile uint32_t DCCMVAU;
    volatile uint32_t DCCMVAC;
    volatile uint32_t DCCSW;
    volatile uint32_t DCCIMVAC;
    volatile uint32_t DCCISW;
} keel_cbp_t;

#define CBP_BASE      0xE000EF50u
#define CBP_DCISW_SET BITS(5u, 9u)
#define CBP_DCISW_WAY BITS(30u, 2u)

/** Memory protection unit. */
typedef struct keel_mpu {
    volatile uint32_t TYPE;
    volatile uint32_t CTRL;
    volatile uint32_t RNR;
    volatile uint32_t RBAR;
    volatile uint32_t RASR;
} keel_mpu_t;

#define MPU_BASE            0xE000ED90u
#define MPU_TYPE_RESET      0x00000800u /* Eight regions. */
#define MPU_CTRL_ENABLE     BITS(0u, 1u)
#define MPU_CTRL_HFNMIENA   BITS(1u, 1u)
#define MPU_CTRL_PRIVDEFENA BITS(2u, 1u)
#define MPU_RBAR_REGION     BITS(0u, 4u)
#define MPU_RBAR_VALID      BITS(4u, 1u)
#define MPU_RBAR_ADDR       BITS(5u, 27u)
#define MPU_RASR_ENABLE     BITS(0u, 1u)
#define MPU_RASR_SIZE       BITS(1u, 5u)
#define MPU_RASR_SRD        BITS(8u, 8u)
#define MPU_RASR_B          BITS(16u, 1u)
#define MPU_RASR_C          BITS(17u, 1u)
#define MPU_RASR_S          BITS(18u, 1u)
#define MPU_RASR_TEX        BITS(19u, 3u)
#define MPU_RASR_AP         BITS(24u, 3u)
#define MPU_RASR_XN         BITS(28u, 1u)

/** Floating-point context control. */
typedef struct keel_fpu {
    volatile uint32_t FPCCR;
    volatile uint32_t FPCAR;
} keel_fpu_t;

#define FPU_BASE        0xE000EF34u
#define FPU_FPCCR_LSPEN BITS(30u, 1u)
#define FPU_FPCCR_ASPEN BITS(31u, 1u)

#endif
