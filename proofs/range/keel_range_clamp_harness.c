// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: specs/model/range.c
// covers: keel_range_clamp model_range_clamp
//
// Every bit pattern of the value and of the ends.
#include "../../specs/model/range.h"
#include "../common/same.h"

float nondet_float(void);

void keel_range_clamp_harness(void)
{
    const float value = nondet_float();
    const float lowest = nondet_float();
    const float highest = nondet_float();
    const float expected = model_range_clamp(value, lowest, highest);

    __CPROVER_assert(float_same(keel_range_clamp(value, lowest, highest), expected),
                     "RNG_002_model: as the model says");
}
