/* SPDX-License-Identifier: Apache-2.0 */
#include "cortex_m7/reset.h"

#include "board.h"
#include "cortex_m7/core.h"

#define SCB ((keel_scb_t *)SCB_BASE)

void keel_core_reset(void)
{
    keel_board_outputs_off();
    keel_board_outputs_hold();
    __asm volatile("dsb" ::: "memory");
    SCB->AIRCR = FIELD(SCB_AIRCR_VECTKEYSTAT, SCB_AIRCR_KEY) | SCB_AIRCR_SYSRESETREQ;
    __asm volatile("dsb" ::: "memory");
    for (;;) {
    }
}
