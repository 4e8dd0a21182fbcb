// cbmc: --external-sat-solver cadical
// covers: keel_range_clamp
//
// Every bit pattern of the value, all finite ends in order.
#include "keel/middleware/range.h"

float nondet_float(void);

void keel_range_clamp_harness(void)
{
    const float value = nondet_float();
    const float lowest = nondet_float();
    const float highest = nondet_float();
    float result;

    __CPROVER_assume((-KEEL_RANGE_LARGEST <= lowest) && (lowest <= highest) &&
                     (highest <= KEEL_RANGE_LARGEST));

    result = keel_range_clamp(value, lowest, highest);

    __CPROVER_assert((lowest <= result) && (result <= highest), "RNG_002_range: in the range");
    if (value > highest) {
        __CPROVER_assert(result == highest, "RNG_002_above: the upper end is next to it");
    } else if (value >= lowest) {
        __CPROVER_assert(result == value, "RNG_002_within: what lies in it stays");
    } else {
        __CPROVER_assert(result == lowest, "RNG_002_below: the lower end, for NaN, too");
    }
}
