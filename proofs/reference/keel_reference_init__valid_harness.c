// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/reference.c
// covers: keel_reference_init are_expos is_expo are_dead_bands is_dead_band
// covers: are_stick_limits is_stick_limit curve_of
//
// Any bit pattern for the shape of the roll stick and for all limits; the other shapes are good or
// bad ones, since all go through the same functions. What is made is valid, and no operation
// overflows or gives a NaN. What the reference generator is, for every configuration, is in
// keel_reference_init_harness.
#include "../common/unchanged.h"
#include "reference_proof.h"

static keel_reference_shape_t good_or_bad(void)
{
    return (keel_reference_shape_t){nondet_bool() ? 0.125f : 0.75f, nondet_bool() ? 0.5f : -0.5f};
}

void keel_reference_init__valid_harness(void)
{
    const keel_reference_config_t any = nondet_reference_config();
    const keel_reference_config_t config = {.roll = any.roll,
                                            .pitch = good_or_bad(),
                                            .yaw = good_or_bad(),
                                            .climb = good_or_bad(),
                                            .limits = any.limits};
    keel_reference_t reference = nondet_reference();
    const keel_reference_t before = reference;
    const keel_status_t status = keel_reference_init(&reference, &config);

    if (status == KEEL_OK) {
        __CPROVER_assert(reference_valid_here(&reference),
                         "REF_002_valid: a made reference generator is valid");
        __CPROVER_assert((reference.roll.linear + reference.roll.expo) == 1.0f,
                         "REF_003_sum: at the end of the stick both parts of the curve are 1");
    } else {
        __CPROVER_assert(unchanged(&reference, &before, sizeof(reference)),
                         "STA_001_kept: a refusal changes nothing");
    }
}
