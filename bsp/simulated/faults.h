/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file faults.h
 * @brief What can go wrong between a driver and a simulated device.
 *
 * Exchanges are counted from 1. All 0 is a bus on which nothing goes wrong.
 */
#ifndef KEEL_BSP_SIMULATED_FAULTS_H
#define KEEL_BSP_SIMULATED_FAULTS_H

#include "common/bsp_status.h"

#include <stdbool.h>
#include <stdint.h>

/** What line says when it does what the device wants. */
#define SIMULATED_LINE_FREE 0

/** The faults of a bus, and what was exchanged. */
typedef struct simulated_faults {
    uint32_t exchanges;      /**< So many there were; may be set to 0. */
    uint32_t fails_from;     /**< From this one … */
    uint32_t fails_for;      /**< … so many fail … */
    keel_bsp_status_t error; /**< … with this. */
    uint32_t short_at;       /**< This one ends a byte early. */
    int line;                /**< What a byte is ored with (above 0), or and not (below). */
} simulated_faults_t;

/**
 * Begins an exchange.
 *
 * @param faults the faults
 * @param length the bytes that are asked for
 * @param done   the bytes that come
 * @return KEEL_BSP_OK, or the error that is due
 */
static inline keel_bsp_status_t simulated_exchange(simulated_faults_t *faults, uint32_t length,
                                                   uint32_t *done)
{
    const uint32_t at = ++faults->exchanges;
    const bool fails = (faults->fails_for > 0u) && (at >= faults->fails_from) &&
                       ((at - faults->fails_from) < faults->fails_for);

    *done = fails ? 0u : length;
    if (at == faults->short_at) {
        *done = length - 1u;
    }
    return fails ? faults->error : KEEL_BSP_OK;
}

/** What comes over the line when a device says a byte. */
static inline uint8_t simulated_line(const simulated_faults_t *faults, uint8_t byte)
{
    uint8_t comes = byte;

    if (faults->line > 0) {
        comes = (uint8_t)(byte | (unsigned)faults->line);
    } else if (faults->line < 0) {
        comes = (uint8_t)(byte & ~(unsigned)-faults->line);
    } else {
        /* As it is said. */
    }
    return comes;
}

#endif
