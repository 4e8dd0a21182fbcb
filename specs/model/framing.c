/* SPDX-License-Identifier: Apache-2.0 */
#include "framing.h"

/* FRG-001 */
uint32_t model_framing_sum(uint32_t a, uint32_t b)
{
    const uint64_t sum = (uint64_t)a + b;

    return (sum > UINT32_MAX) ? UINT32_MAX : (uint32_t)sum;
}

/* FRG-002 */
void model_framing_begin(keel_framing_t *framing, uint32_t gap_us, const uint8_t *header)
{
    keel_framing_t begun = {.gap_us = gap_us, .quiet_us = UINT32_MAX};

    for (uint32_t i = 0u; i < 4u; i++) {
        begun.header[i] = header[i];
    }
    *framing = begun;
}

/* FRG-005 */
bool model_framing_header(const keel_framing_t *framing, uint8_t byte)
{
    bool is = false;

    for (uint32_t i = 0u; i < 4u; i++) {
        is = is || (byte == framing->header[i]);
    }
    return is;
}

/* FRG-003 */
void model_framing_pass_time(keel_framing_t *framing, uint32_t elapsed_us)
{
    framing->quiet_us = model_framing_sum(framing->quiet_us, elapsed_us);
}

/* FRG-005: behind those that are held. */
static void hold(keel_framing_t *framing, uint8_t byte)
{
    framing->byte[framing->held] = byte;
    framing->held = (uint8_t)(framing->held + 1u);
}

void model_framing_take(keel_framing_t *framing, uint8_t byte, uint32_t elapsed_us)
{
    const uint32_t silence = model_framing_sum(framing->quiet_us, elapsed_us);

    if (silence > framing->gap_us) { /* FRG-004 */
        if (framing->held != 0u) {
            framing->gaps = model_framing_sum(framing->gaps, 1u);
        }
        framing->held = 0u;
    }
    framing->quiet_us = 0u; /* FRG-003 */
    if (framing->held != 0u) {
        hold(framing, byte);
    } else if (model_framing_header(framing, byte)) {
        hold(framing, byte);
    } else {
        framing->strays = model_framing_sum(framing->strays, 1u);
    }
}
