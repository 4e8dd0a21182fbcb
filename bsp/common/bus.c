/* SPDX-License-Identifier: Apache-2.0 */
#include "common/bus.h"

#define ALL_ONES 0xFFu

keel_bsp_status_t keel_bus_transfer(const keel_bus_t *bus, const uint8_t *out, uint8_t *in,
                                    uint32_t length)
{
    uint32_t done = 0u;
    const keel_bsp_status_t status = bus->exchange(bus->context, out, in, length, &done);

    if (status != KEEL_BSP_OK) {
        return status;
    }
    return (done == length) ? KEEL_BSP_OK : KEEL_BSP_SHORT;
}

bool keel_bus_is_still(const uint8_t *byte, uint32_t length)
{
    bool same = (byte[0] == 0u) || (byte[0] == ALL_ONES);

    for (uint32_t i = 1u; i < length; i++) {
        same = same && (byte[i] == byte[0]);
    }
    return same;
}

uint32_t keel_bus_repeats(keel_repeats_t *repeats, const uint8_t *byte, uint32_t length)
{
    bool same = true;

    for (uint32_t i = 0u; i < length; i++) {
        same = same && (repeats->last[i] == byte[i]);
        repeats->last[i] = byte[i];
    }
    if (!same) {
        repeats->count = 0u;
    } else if (repeats->count < UINT32_MAX) {
        repeats->count++;
    } else {
        /* It stays at its end. */
    }
    return repeats->count;
}
