/* SPDX-License-Identifier: Apache-2.0 */
#include "deviation.h"

static uint64_t distance(uint64_t a, uint64_t b)
{
    return (a >= b) ? (a - b) : (b - a);
}

keel_status_t model_deviation_add(keel_deviation_t *deviation, uint64_t start_us,
                                  uint32_t period_us)
{
    /* DEV-001: the first start ends no period. */
    const uint64_t off_us = (deviation->starts == 0u)
                                ? 0u
                                : distance(start_us - deviation->start_us, period_us);

    /* DEV-002: neither the count, nor the square, nor the sum may overflow. */
    if ((deviation->starts == UINT32_MAX) || (off_us > UINT32_MAX) ||
        (deviation->sum_us2 > (UINT64_MAX - (off_us * off_us)))) {
        return KEEL_ERR_STATE;
    }
    /* DEV-001: eq. 15 without the root. */
    deviation->sum_us2 = deviation->sum_us2 + (off_us * off_us);
    deviation->start_us = start_us;
    deviation->starts = deviation->starts + 1u;
    return KEEL_OK;
}

/* DEV-003: of so many starts one fewer are ends of a period. */
uint64_t model_deviation_variance_us2(const keel_deviation_t *deviation)
{
    if (deviation->starts < 2u) {
        return 0u;
    }
    return deviation->sum_us2 / (deviation->starts - 1u);
}
