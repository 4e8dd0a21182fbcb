/* SPDX-License-Identifier: Apache-2.0 */
#include "common/wait.h"

#include <stddef.h>

bool keel_wait_for(const volatile uint32_t *word, uint32_t mask, uint32_t value,
                   const keel_wait_t *wait)
{
    bool reached = ((*word & mask) == value);

    for (uint32_t look = 1u; (look < wait->looks) && !reached; look++) {
        if (wait->between != NULL) {
            wait->between(wait->context);
        }
        reached = ((*word & mask) == value);
    }
    return reached;
}

bool keel_wait_us(uint32_t (*read)(void *context), void *context, uint32_t time_us, uint32_t looks)
{
    const uint32_t start_us = read(context);
    bool passed = (time_us == 0u);

    for (uint32_t look = 0u; (look < looks) && !passed; look++) {
        passed = ((read(context) - start_us) >= time_us);
    }
    return passed;
}
