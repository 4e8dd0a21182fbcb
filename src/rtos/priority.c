/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/rtos/priority.h"

/* The value of sp * age from which eq. 3 saturates: (max - 1) * T. */
/*@ requires period_valid(period_us);
  @ assigns \nothing;
  @ ensures \result == (KEEL_PRIORITY_REALTIME - 1) * period_us;
  @*/
static uint64_t saturation(uint32_t period_us)
{
    return ((uint64_t)KEEL_PRIORITY_REALTIME - 1u) * period_us;
}

bool keel_priority_promoted(uint32_t sp, uint64_t age_us, uint32_t period_us)
{
    const uint64_t limit = saturation(period_us);

    /* The first test keeps the product of the second within 64 bits for every age. */
    return (age_us >= limit) || ((sp * age_us) >= limit);
}

/* The quotient, in 32 bits where they hold the dividend: on the target a division of 64 bits is a
 * call, of fifty instructions or more. */
/*@ requires 0 < divisor;
  @ requires dividend / divisor <= UINT32_MAX;
  @ assigns \nothing;
  @ ensures \result == dividend / divisor;
  @*/
static uint32_t quotient(uint64_t dividend, uint32_t divisor)
{
    return (dividend <= UINT32_MAX) ? ((uint32_t)dividend / divisor)
                                    : (uint32_t)(dividend / divisor);
}

uint32_t keel_priority_dynamic(uint32_t sp, uint64_t age_us, uint32_t period_us)
{
    if (keel_priority_promoted(sp, age_us, period_us)) {
        return KEEL_PRIORITY_REALTIME;
    }
    return 1u + quotient(sp * age_us, period_us);
}

uint64_t keel_priority_promotion_age_us(uint32_t sp, uint32_t period_us)
{
    return (saturation(period_us) + (sp - 1u)) / sp;
}
