/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file load.h
 * @brief The CPU's load over a window of time (eq. 13 and 14).
 */
#ifndef KEEL_RTOS_LOAD_H
#define KEEL_RTOS_LOAD_H

#include "keel/c_declarations.h"

#include <stdint.h>

KEEL_C_BEGIN

/** A load of 100 %, in ppm, as utilisation is. */
#define KEEL_LOAD_FULL_PPM 1000000u

/** A window over which the CPU's load is measured (eq. 13 and 14). */
typedef struct keel_load {
    uint64_t start_us; /**< When the window began, in us. */
    uint64_t busy_us;  /**< The scheduler's busy time at that moment, in us. */
} keel_load_t;

/**
 * Begins a window (requirement LOD-006).
 *
 * @param load    the window
 * @param now_us  the time, in us
 * @param busy_us the time spent in tasks so far, in us
 */
void keel_load_begin(keel_load_t *load, uint64_t now_us, uint64_t busy_us);

/**
 * The CPU's load since the window began, U = 100 - I with I = 100 T_nl / T (eq. 13 and 14,
 * requirement LOD-007). All that is not spent in tasks counts as idle, the scheduler included.
 *
 * @param load    the window
 * @param now_us  the time, not before the window's start and less than 2^32 us after it
 * @param busy_us the time spent in tasks so far: what the window adds is at most its length
 * @return the load in ppm, rounded down, 0 to KEEL_LOAD_FULL_PPM; 0 for an
 *         empty window
 */
uint32_t keel_load_ppm(const keel_load_t *load, uint64_t now_us, uint64_t busy_us);

KEEL_C_END

#endif
