// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/reference.c
// covers: keel_reference_init are_expos is_expo are_dead_bands is_dead_band are_limits is_limit
// covers: curve_of
//
// Any configuration, any bit pattern in it: what is made is valid, and no operation overflows or
// gives a NaN. The end of a stick leads to at least 1 before it is clamped. What the reference
// generator is, is in keel_reference_init_harness.
#include "../common/unchanged.h"
#include "reference_proof.h"

void keel_reference_init__valid_harness(void)
{
    const keel_reference_config_t config = nondet_reference_config();
    keel_reference_t reference = nondet_reference();
    const keel_reference_t before = reference;
    const keel_status_t status = keel_reference_init(&reference, &config);

    if (status == KEEL_OK) {
        const keel_reference_curve_t *const curve = &reference.roll;

        __CPROVER_assert(reference_valid_here(&reference),
                         "REF_002_valid: a made reference generator is valid");
        __CPROVER_assert(((1.0f - curve->dead_band) * curve->scale) >= 1.0f,
                         "REF_003_end: the end of the stick is reached");
        __CPROVER_assert((curve->linear + curve->expo) == 1.0f,
                         "REF_003_sum: at the end of the stick both parts of the curve are 1");
    } else {
        __CPROVER_assert(unchanged(&reference, &before, sizeof(reference)),
                         "STA_001_kept: a refusal changes nothing");
    }
}
