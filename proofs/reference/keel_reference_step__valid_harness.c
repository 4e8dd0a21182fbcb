// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/reference.c
// covers: keel_reference_step are_sticks deflection rounded_off
//
// Any bit pattern for the roll stick, with any curve of it, the others centred or out of range: all
// sticks go through the same functions. +0 within the dead band, else not of the other sign; no
// operation overflows or gives a NaN. That set-points are bounded and monotone is proved in
// curve.c; what the step computes, for all sticks, in keel_reference_step_harness.
#include "../common/unchanged.h"
#include "reference_proof.h"

static bool is_dead(const keel_reference_curve_t *curve, float stick)
{
    return within(stick, -curve->dead_band, curve->dead_band);
}

/* Not of the sign that the stick has not; +0, not -0, within its dead band. */
static bool follows(float setpoint, const keel_reference_curve_t *curve, float stick)
{
    if (is_dead(curve, stick)) {
        return float_same(setpoint, 0.0f);
    }
    return (stick < 0.0f) ? (setpoint <= 0.0f) : (setpoint >= 0.0f);
}

static float centred_or_bad(void)
{
    return nondet_bool() ? 0.0f : 2.0f;
}

void keel_reference_step__valid_harness(void)
{
    const keel_reference_curve_t straight = {0.125f, 1.25f, 1.0f, 0.0f};
    const keel_reference_sticks_t sticks = {nondet_float(), centred_or_bad(), centred_or_bad(),
                                            centred_or_bad()};
    keel_reference_t reference = nondet_reference();
    keel_reference_t before;
    keel_status_t status;

    reference.pitch = straight;
    reference.yaw = straight;
    reference.climb = straight;
    reference.limits = (keel_reference_limits_t){1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f};
    __CPROVER_assume(reference_valid_here(&reference));
    before = reference;

    status = keel_reference_step(&reference, &sticks);

    __CPROVER_assert((status == KEEL_OK) == sticks_here(&sticks),
                     "REF_004_ok: taken when every stick is in its range");
    if (status != KEEL_OK) {
        __CPROVER_assert(unchanged(&reference, &before, sizeof(reference)),
                         "STA_001_kept: a refusal changes nothing");
        return;
    }
    __CPROVER_assert(follows(reference.setpoints.roll_rate, &before.roll, sticks.roll),
                     "REF_007_rate: 0 within the dead band");
    __CPROVER_assert(follows(reference.setpoints.right, &before.roll, sticks.roll),
                     "REF_007_right: 0 within the dead band");
}
