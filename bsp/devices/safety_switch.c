/* SPDX-License-Identifier: Apache-2.0 */
#include "devices/safety_switch.h"

#include "common/progress.h"

void keel_safety_switch_init(keel_safety_switch_t *self)
{
    *self = (keel_safety_switch_t){.is_safe = true, .is_pressed = true};
}

/* The first reading of another level tells nothing of the time before it. */
static void settle(keel_safety_switch_t *self, bool pressed, uint32_t counted_us)
{
    if (pressed == self->is_pressed) {
        self->differs = false;
    } else if (!self->differs) {
        self->differs = true;
        self->differs_us = 0u;
    } else {
        self->differs_us += counted_us;
        if (self->differs_us >= KEEL_SAFETY_SWITCH_SETTLE_US) {
            self->is_pressed = pressed;
            self->differs = false;
            self->held_us = 0u;
        }
    }
}

/* A step that comes late makes the hold longer, not shorter: nobody looked meanwhile. */
bool keel_safety_switch_step(keel_safety_switch_t *self, bool pressed, uint32_t elapsed_us)
{
    const uint32_t counted_us = (elapsed_us < KEEL_SAFETY_SWITCH_SETTLE_US)
                                    ? elapsed_us
                                    : KEEL_SAFETY_SWITCH_SETTLE_US;
    bool changes = false;

    self->blink_us = (self->blink_us + counted_us) % (2u * KEEL_SAFETY_SWITCH_BLINK_US);
    self->held_us = keel_progress_sum(self->held_us, counted_us);
    settle(self, pressed, counted_us);
    if (!self->is_pressed) {
        self->was_released = true;
    } else if (self->was_released && (self->held_us >= KEEL_SAFETY_SWITCH_HOLD_US)) {
        self->is_safe = !self->is_safe;
        self->was_released = false;
        changes = true;
    } else {
        /* Not for long enough, or it has changed already. */
    }
    return changes;
}

bool keel_safety_switch_is_lit(const keel_safety_switch_t *self)
{
    return !self->is_safe || (self->blink_us < KEEL_SAFETY_SWITCH_BLINK_US);
}
