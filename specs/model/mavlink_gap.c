/* SPDX-License-Identifier: Apache-2.0 */
/* Apart, as its harness puts another look in the place of the model's. */
#include "mavlink.h"

/* MAV-010 */
keel_mavlink_look_t model_mavlink_gap(keel_mavlink_t *mavlink)
{
    const bool is_partial = (mavlink->held != 0u) && (mavlink->held < mavlink->awaited);

    if (!is_partial) {
        return model_mavlink_look(mavlink);
    }
    mavlink->count.gaps += (mavlink->count.gaps != UINT32_MAX) ? 1u : 0u; /* MAV-007 */
    model_mavlink_drop(mavlink, 1u);
    return KEEL_MAVLINK_AGAIN;
}
