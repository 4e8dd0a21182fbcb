// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 7 --external-sat-solver cadical
// sources: src/flight/reference.c
// covers: keel_reference_step deflection rounded_off
//
// One reference generator and chosen sticks: the contract of a step, clause by clause. All others
// are dealt with in keel_reference_step__clauses_harness and keel_reference_step__sign_harness;
// wrong bodies are refuted here, for where floats differ z3 finds no example.
#include "step_clauses.h"

#define POINTS 6u

/* Within each dead band, in between, at each end and in a corner; refused. */
static const keel_reference_sticks_t chosen[POINTS] = {
    {0.05f, -0.02f, 0.1f, -0.03f}, {0.37f, 0.61f, -0.83f, 0.29f}, {-0.91f, 0.43f, 0.57f, -0.71f},
    {1.0f, -1.0f, 1.0f, -1.0f},    {0.2f, 0.2f, 0.2f, -1.0001f},  {0.7071f, 0.7071f, 0.3f, 1.0f},
};

static keel_reference_t generator(void)
{
    const keel_reference_t reference = {
        .roll = {0.05f, 1.0526319f, 0.7f, 0.3f},
        .pitch = {0.02f, 1.0204084f, 0.45f, 0.55f},
        .yaw = {0.1f, 1.1111114f, 0.1f, 0.9f},
        .climb = {0.03f, 1.0309281f, 0.8f, 0.2f},
        .limits = {3.3f, 3.7f, 2.1f, 1.7f, 0.61f, 7.3f, 4.1f, 1.9f},
    };

    return reference;
}

static bool is_climb(const keel_reference_t *reference, const keel_reference_sticks_t *sticks)
{
    return is_asked(reference->setpoints.climb_rate,
                    (sticks->climb < 0.0f) ? reference->limits.descent_rate
                                           : reference->limits.climb_rate,
                    deflection_of(&reference->climb, sticks->climb));
}

void keel_reference_step__chosen_harness(void)
{
    for (unsigned i = 0u; i < POINTS; i++) {
        const keel_reference_sticks_t sticks = chosen[i];
        const bool taken = sticks_here(&sticks);
        keel_reference_t reference = generator();
        const keel_status_t status = keel_reference_step(&reference, &sticks);

        __CPROVER_assert(taken || (status == KEEL_ERR_INPUT),
                         "REF_004_refused: a bad stick is refused");
        __CPROVER_assert(!taken || are_rates(&reference, &sticks),
                         "REF_005_rates: a limit times the deflection");
        __CPROVER_assert(!taken || are_angles(&reference, &sticks),
                         "REF_005_angles: the tilt times what the stick across leaves");
        __CPROVER_assert(!taken || is_climb(&reference, &sticks),
                         "REF_005_climb: one limit upwards, another downwards");
    }
}
