// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: specs/model/range.c
// covers: keel_range_contains model_range_contains
//
// Every bit pattern of the value, all finite ends, in any order. The value is taken apart into its
// bits: 0x7F800000 is infinity, above it is NaN.
#include "../../specs/model/range.h"

#include <stdint.h>

float nondet_float(void);

static uint32_t magnitude_bits(float value)
{
    union {
        float value;
        uint32_t bits;
    } both;

    both.value = value;
    return both.bits & 0x7FFFFFFFu;
}

void keel_range_contains_harness(void)
{
    const float value = nondet_float();
    const float lowest = nondet_float();
    const float highest = nondet_float();
    bool inside;

    __CPROVER_assume((magnitude_bits(lowest) < 0x7F800000u) &&
                     (magnitude_bits(highest) < 0x7F800000u));

    inside = keel_range_contains(value, lowest, highest);

    __CPROVER_assert(inside == model_range_contains(value, lowest, highest),
                     "RNG_001_model: as the model says");
    __CPROVER_assert(!inside || (magnitude_bits(value) < 0x7F800000u),
                     "RNG_001_finite: what lies in a range is finite");
}
