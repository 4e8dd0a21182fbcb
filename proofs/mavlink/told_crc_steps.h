/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file told_crc_steps.h
 * @brief The numbers of told_crc.h in steps, so that a frame's checksum is known before it is asked
 *        for: a frame of any length can be made a right one.
 */
#ifndef TOLD_CRC_STEPS_H
#define TOLD_CRC_STEPS_H

#include "told_crc.h"

#define FIRST 0x3A51u
#define STEP  257u /* both bytes of a checksum differ from those of the one before */

/* The checksum after so many bytes, one at least, of which the message's is one. */
static uint16_t step_after(uint32_t count)
{
    return (uint16_t)((FIRST + (STEP * (count - 1u))) & 0xFFFFu);
}

static void tell_steps(void)
{
    for (uint32_t i = 0u; i < ASKED; i++) {
        told.crc[i] = step_after(i + 1u);
    }
    asks = 0u;
    is_model = true;
}

#endif
