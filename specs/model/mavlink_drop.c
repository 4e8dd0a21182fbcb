/* SPDX-License-Identifier: Apache-2.0 */
/* Apart, as the harnesses of what calls it put another in its place. */
#include "mavlink.h"

/* MAV-016: what is left begins with the first 0xFD that is not among the first bytes; those between
 * are of no frame. */
void model_mavlink_drop(keel_mavlink_t *mavlink, uint32_t count)
{
    const keel_mavlink_t old = *mavlink;
    uint32_t first = old.held;

    for (uint32_t i = 280u; i > count; i--) {
        if (((i - 1u) < old.held) && (old.bytes[i - 1u] == 0xFDu)) {
            first = i - 1u;
        }
    }
    for (uint32_t i = count; i < first; i++) {
        mavlink->count.others += (mavlink->count.others != UINT32_MAX) ? 1u : 0u; /* MAV-007 */
    }
    for (uint32_t i = 0u; (first + i) < old.held; i++) {
        mavlink->bytes[i] = old.bytes[first + i];
    }
    mavlink->held = (uint16_t)(old.held - first);
    mavlink->awaited = 10u;
}
