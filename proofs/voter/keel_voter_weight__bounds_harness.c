// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --external-sat-solver cadical
// sources: src/middleware/voter.c
// covers: keel_voter_weight
#include "../common/voter_contracts.h"

void keel_voter_weight__bounds_harness(void)
{
    float agreement[SENSORS - 1u];
    const uint32_t others = nondet_u32();
    float weight;

    for (uint32_t i = 0u; i < (SENSORS - 1u); i++) {
        agreement[i] = nondet_float();
    }
    __CPROVER_assume(keel_voter_weight_may(agreement, others));

    weight = keel_voter_weight(agreement, others);

    __CPROVER_assert(weight_range(weight), "VOT_006_range: a weight lies in [0, 1]");
    __CPROVER_assert(keel_voter_weight_does(weight, agreement, others),
                     "VOT_006_null: 0 only without any agreement, 1 with full ones");
}
