/* SPDX-License-Identifier: Apache-2.0 */
#include "stm32f767/target/cache.h"

#include "cortex_m7/core.h"

#define SCB          ((keel_scb_t *)SCB_BASE)
#define CBP          ((keel_cbp_t *)CBP_BASE)
#define LEVEL_1_DATA 0u /* CSSELR: the data cache of the first level. */

static void barrier(void)
{
    __asm volatile("dsb\n\tisb" ::: "memory");
}

static void invalidate_data(void)
{
    uint32_t sets;
    uint32_t ways;

    SCB->CSSELR = LEVEL_1_DATA;
    barrier();
    sets = keel_bits_get(SCB->CCSIDR, SCB_CCSIDR_NUMSETS);
    ways = keel_bits_get(SCB->CCSIDR, SCB_CCSIDR_ASSOCIATIVITY);
    for (uint32_t set = 0u; set <= sets; set++) {
        for (uint32_t way = 0u; way <= ways; way++) {
            CBP->DCISW = FIELD(CBP_DCISW_SET, set) | FIELD(CBP_DCISW_WAY, way);
        }
    }
    barrier();
}

/* A cache that a boot loader left on is not invalidated: it may hold what memory lacks. */
void keel_cache_start(void)
{
    if ((SCB->CCR & SCB_CCR_IC) == 0u) {
        CBP->ICIALLU = 0u;
        barrier();
        SCB->CCR |= SCB_CCR_IC;
        barrier();
    }
    if ((SCB->CCR & SCB_CCR_DC) == 0u) {
        invalidate_data();
        SCB->CCR |= SCB_CCR_DC;
        barrier();
    }
}
