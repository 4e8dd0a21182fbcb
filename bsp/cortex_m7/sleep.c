/* SPDX-License-Identifier: Apache-2.0 */
#include "cortex_m7/sleep.h"

#include "cortex_m7/core.h"

#define SCB ((keel_scb_t *)SCB_BASE)

/* SysTick (ARMv7-M Architecture Reference Manual, B3.3). */
typedef struct systick {
    volatile uint32_t CTRL;
    volatile uint32_t LOAD;
    volatile uint32_t VAL;
} systick_t;

#define SYSTICK  ((systick_t *)0xE000E010u)
#define CTRL_ON  7u /* Counts the core's clock, and its end is an exception. */
#define LOAD_MAX 0x00FFFFFFu

void keel_core_sleep_us(uint32_t us, uint32_t core_mhz)
{
    const uint32_t longest_us = LOAD_MAX / core_mhz;
    const uint32_t sleep_us = (us < longest_us) ? us : longest_us;

    if (sleep_us == 0u) {
        return;
    }
    __asm volatile("cpsid i" ::: "memory");
    SYSTICK->LOAD = (sleep_us * core_mhz) - 1u;
    SYSTICK->VAL = 0u;
    SYSTICK->CTRL = CTRL_ON;
    while (SYSTICK->VAL == 0u) {
        /* The counter takes LOAD with its next clock. */
    }
    SYSTICK->LOAD = 0u; /* It counts once: at its end it stops (B3.3.1). */
    /* What becomes pending ends a wait, masked or not (B1.5.19); other causes may, too. */
    while ((SCB->ICSR & SCB_ICSR_PENDSTSET) == 0u) {
        __asm volatile("dsb\n\twfi" ::: "memory");
    }
    SYSTICK->CTRL = 0u;
    SCB->ICSR = SCB_ICSR_PENDSTCLR;
    __asm volatile("dsb\n\tisb\n\tcpsie i" ::: "memory");
}
