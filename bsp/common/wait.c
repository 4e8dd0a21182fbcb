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
