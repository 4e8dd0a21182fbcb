/* SPDX-License-Identifier: Apache-2.0 */
#include "clock.h"

/* CLK-001: in 64 bits, in which the later reading stands 2^32 us higher if the counter wrapped. */
uint32_t model_clock_elapsed_us(uint32_t from_us, uint32_t to_us)
{
    const uint64_t wrapped_us = (to_us < from_us) ? 0x100000000u : 0u;

    return (uint32_t)((wrapped_us + to_us) - from_us);
}

/* CLK-002 */
void model_clock_init(keel_clock_t *clock, uint32_t raw_us)
{
    clock->now_us = 0u;
    clock->raw_us = raw_us;
}

keel_status_t model_clock_advance(keel_clock_t *clock, uint32_t raw_us)
{
    const uint32_t step_us = model_clock_elapsed_us(clock->raw_us, raw_us);

    /* CLK-004: what may as well be a step backwards changes nothing. */
    if (step_us >= KEEL_CLOCK_STEP_LIMIT_US) {
        return KEEL_ERR_CLOCK;
    }
    /* CLK-003 */
    clock->now_us = clock->now_us + step_us;
    clock->raw_us = raw_us;
    return KEEL_OK;
}
