/* SPDX-License-Identifier: Apache-2.0 */
/* What is left when bytes are dropped: apart, as the proofs of decoders hold whatever that is. */
#include "framing.h"

/* FRG-006: what is left begins with the first header at count or behind it. */
void model_framing_drop(keel_framing_t *framing, uint32_t count)
{
    const keel_framing_t old = *framing;
    uint32_t first = old.held;

    for (uint32_t i = 64u; i > 0u; i--) {
        if ((i - 1u >= count) && (i - 1u < old.held) &&
            model_framing_header(&old, old.byte[i - 1u])) {
            first = i - 1u;
        }
    }
    framing->held = (uint8_t)(old.held - first);
    for (uint32_t i = 0u; i < 64u; i++) {
        if (i < framing->held) {
            framing->byte[i] = old.byte[first + i];
        }
    }
}
