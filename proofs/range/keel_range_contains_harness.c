// cbmc: --external-sat-solver cadical
// covers: keel_range_contains
//
// Every bit pattern of the value, all finite ends, in any order. The value is taken apart into its
// bits: 0x7F800000 is infinity, above it is NaN.
#include "keel/middleware/range.h"

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
    const bool number = magnitude_bits(value) <= 0x7F800000u;
    bool inside;

    __CPROVER_assume((magnitude_bits(lowest) < 0x7F800000u) &&
                     (magnitude_bits(highest) < 0x7F800000u));

    inside = keel_range_contains(value, lowest, highest);

    __CPROVER_assert(inside == (number && !(value < lowest) && !(value > highest)),
                     "RNG_001: a number lies in it unless it compares below or above");
    __CPROVER_assert(!inside || (magnitude_bits(value) < 0x7F800000u),
                     "RNG_001_finite: what lies in a range is finite");
}
