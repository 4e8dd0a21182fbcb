/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file any.h
 * @brief Numbers for tests that try many: SplitMix64, the same on every machine.
 *
 * A test begins with any_from() and a seed of its own, so that it does not depend on those before.
 */
#ifndef KEEL_TESTS_UNIT_ANY_H
#define KEEL_TESTS_UNIT_ANY_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

static uint64_t any_state;

static inline void any_from(uint64_t seed)
{
    any_state = seed;
}

static inline uint64_t any_64(void)
{
    uint64_t z;

    any_state += 0x9E3779B97F4A7C15u;
    z = any_state;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

static inline uint32_t any(void)
{
    return (uint32_t)(any_64() >> 16);
}

static inline bool one_in(uint32_t chances)
{
    return (any() % chances) == 0u;
}

static inline float between(float low, float high)
{
    return low + ((high - low) * ((float)(any() & 0xFFFFFFu) / 16777216.0f));
}

static inline float any_bits(void)
{
    const uint32_t bits = any();
    float value;

    memcpy(&value, &bits, sizeof value);
    return value;
}

#endif
