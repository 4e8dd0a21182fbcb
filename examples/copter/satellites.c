/* SPDX-License-Identifier: Apache-2.0 */
/* GPS: fixes, and how the aircraft accelerates, which tells gravity from thrust (attitude.h). */
#include "copter.h"

/* Two fixes farther apart than this say nothing of the acceleration now; nor does an old one. */
#define APART_US 500000u

#define US_PER_S 1.0e6f

static bool is_fast_enough(const copter_fix_t *fix)
{
    return fix->is_valid && (fix->speed_accuracy <= copter_settings.position.speed_accuracy);
}

static void derive(copter_satellites_t *self, const copter_fix_t *before, uint64_t apart_us)
{
    const float time_s = (float)apart_us / US_PER_S;

    self->is_accelerated = is_fast_enough(before) && is_fast_enough(&self->fix) &&
                           (apart_us > 0u) && (apart_us <= APART_US);
    if (self->is_accelerated) {
        self->acceleration = (keel_attitude_vector_t){(self->fix.north - before->north) / time_s,
                                                      (self->fix.east - before->east) / time_s,
                                                      0.0f};
    }
}

void copter_gps(copter_t *copter)
{
    copter_satellites_t *const self = &copter->satellites;
    const copter_fix_t before = self->fix;
    const uint64_t apart_us = copter->scheduler.clock.now_us - self->fixed_us;

    if (copter->port->read_gps(copter->port->context, &self->fix)) {
        derive(self, &before, apart_us);
        self->fixed_us = copter->scheduler.clock.now_us;
        self->fixes++;
    } else if (apart_us > APART_US) {
        self->is_accelerated = false;
    } else {
        /* The last two still hold. */
    }
}
