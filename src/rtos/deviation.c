/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/rtos/deviation.h"

/*@ assigns \nothing;
  @ ensures \result == distance(a, b);
  @*/
static uint64_t distance_us(uint64_t a, uint64_t b)
{
    return (a >= b) ? (a - b) : (b - a);
}

keel_status_t keel_deviation_add(keel_deviation_t *deviation, uint64_t start_us, uint32_t period_us)
{
    uint64_t off_us = 0u;

    if (deviation->starts == UINT32_MAX) {
        return KEEL_ERR_STATE;
    }
    if (deviation->starts > 0u) {
        off_us = distance_us(start_us - deviation->start_us, period_us);
        if (off_us > UINT32_MAX) {
            return KEEL_ERR_STATE;
        }
    }
    //@ assert square: off_us * off_us <= UINT32_MAX * UINT32_MAX;
    if (deviation->sum_us2 > (UINT64_MAX - (off_us * off_us))) {
        return KEEL_ERR_STATE;
    }
    deviation->sum_us2 += off_us * off_us;
    deviation->starts++;
    deviation->start_us = start_us;
    return KEEL_OK;
}

uint64_t keel_deviation_variance_us2(const keel_deviation_t *deviation)
{
    if (deviation->starts < 2u) {
        return 0u;
    }
    return deviation->sum_us2 / (deviation->starts - 1u);
}
