// cbmc: --unwind 4 --external-sat-solver cadical
// sources: src/middleware/voter.c
// covers: keel_voter_weight
#include "../common/voter_proof.h"

void keel_voter_weight_harness(void)
{
    float agreement[SENSORS - 1u];
    const uint32_t others = nondet_u32();
    bool null = true;
    float weight;

    __CPROVER_assume((1u <= others) && (others < SENSORS));
    for (uint32_t i = 0u; i < (SENSORS - 1u); i++) {
        agreement[i] = nondet_float();
        if (i < others) {
            __CPROVER_assume((agreement[i] == 0.0f) ||
                             ((0x1p-24f <= agreement[i]) && (agreement[i] <= 1.0f)));
            null = null && (agreement[i] == 0.0f);
        }
    }

    weight = keel_voter_weight(agreement, others);

    __CPROVER_assert((weight == 0.0f) || ((0x1p-26f <= weight) && (weight <= 1.0f)),
                     "VOT_006_range: a weight lies in [0, 1]");
    __CPROVER_assert((weight == 0.0f) == null, "VOT_006_null: 0 only without any agreement");
}
