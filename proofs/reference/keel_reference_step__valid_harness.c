// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/reference.c
// covers: keel_reference_step are_sticks deflection rounded_off
//
// The roll and the pitch stick, any bit patterns, with any curve of each; the others centred: they
// go through the same functions. The limits are 1, so that set-points are what the limits are
// multiplied by; keel_reference_step__limit_harness has the limits. Bounded, exactly 0 and +0
// within the dead band and nowhere else, and of the stick's sign; no operation overflows or gives a
// NaN.
#include "../common/unchanged.h"
#include "reference_proof.h"

/* +0, not -0. */
static bool is_zero(float value)
{
    return float_same(value, 0.0f);
}

static bool is_dead(const keel_reference_curve_t *curve, float stick)
{
    return within(stick, -curve->dead_band, curve->dead_band);
}

/* Bounded, and of the sign that the stick has, +0 within its dead band. */
static bool follows(float setpoint, const keel_reference_curve_t *curve, float stick)
{
    return magnitude(setpoint, 1.0f) &&
           (is_dead(curve, stick) ? is_zero(setpoint)
                                  : ((setpoint != 0.0f) && ((setpoint < 0.0f) == (stick < 0.0f))));
}

void keel_reference_step__valid_harness(void)
{
    const keel_reference_sticks_t sticks = {.roll = nondet_float(), .pitch = nondet_float()};
    keel_reference_t reference = nondet_reference();
    keel_reference_t before;
    keel_status_t status;

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
                     "REF_006_rate: bounded, and 0 within the dead band");
    __CPROVER_assert(follows(reference.setpoints.roll, &before.roll, sticks.roll),
                     "REF_006_angle: bounded, and 0 within the dead band");
    __CPROVER_assert(follows(reference.setpoints.right, &before.roll, sticks.roll),
                     "REF_006_right: bounded, and 0 within the dead band");
    __CPROVER_assert(follows(reference.setpoints.forward, &before.pitch, 0.0f - sticks.pitch),
                     "REF_006_forward: bounded, and 0 within the dead band");
}
