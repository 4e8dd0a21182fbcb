/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ms5611_proof.h
 * @brief What the harnesses of the MS5611's formulas share: arbitrary PROMs, and when two objects
 *        are the same.
 */
#ifndef MS5611_PROOF_H
#define MS5611_PROOF_H

#include "../../specs/model/ms5611.h"

#include <stdbool.h>

uint16_t nondet_u16(void);
uint32_t nondet_u32(void);
int32_t nondet_i32(void);

static void any_words(uint16_t *word)
{
    for (uint32_t i = 0u; i < KEEL_MS5611_WORDS; i++) {
        word[i] = nondet_u16();
    }
}

static keel_ms5611_t any_ms5611(void)
{
    const keel_ms5611_t ms5611 = {nondet_u16(), nondet_u16(), nondet_u16(),
                                  nondet_u16(), nondet_u16(), nondet_u16()};

    return ms5611;
}

static keel_ms5611_sample_t any_ms5611_sample(void)
{
    const keel_ms5611_sample_t sample = {nondet_i32(), nondet_i32()};

    return sample;
}

static bool ms5611_same(const keel_ms5611_t *a, const keel_ms5611_t *b)
{
    return (a->sensitivity == b->sensitivity) && (a->offset == b->offset) &&
           (a->sensitivity_slope == b->sensitivity_slope) && (a->offset_slope == b->offset_slope) &&
           (a->reference == b->reference) && (a->temperature_slope == b->temperature_slope);
}

static bool ms5611_sample_same(const keel_ms5611_sample_t *a, const keel_ms5611_sample_t *b)
{
    return (a->pressure_pa == b->pressure_pa) && (a->temperature_cdeg == b->temperature_cdeg);
}

#endif
