/* SPDX-License-Identifier: Apache-2.0 */
/* GPS. */
#include "copter.h"

void copter_gps(copter_t *copter)
{
    copter_satellites_t *const self = &copter->satellites;

    if (copter->port->read_gps(copter->port->context, &self->fix)) {
        self->fixes++;
    }
}
