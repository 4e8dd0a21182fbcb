// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 9 --external-sat-solver cadical
// sources: src/flight/reference.c specs/model/reference.c
// covers: keel_reference_step deflection rounded_off
// covers: deflected in_disc
//
// Chosen curves and sticks, where sums and products are rounded: the same as the model's. All of
// them are dealt with in keel_reference_step_harness; wrong bodies are refuted here, for where
// floats differ z3 finds no example. And odd: the opposite sticks lead to the opposite set-points,
// bit for bit but for 0, which stays +0; with both limits of the climb rate for that.
#include "../../specs/model/reference.h"
#include "reference_proof.h"

#define POINTS 8u

/* Within each dead band, just beyond, in between, at each end and in a corner; refused. */
static const keel_reference_sticks_t points[POINTS] = {
    {0.05f, -0.02f, 0.1f, -0.03f},   {0.0501f, -0.0201f, 0.1001f, -0.0301f},
    {0.37f, 0.61f, -0.83f, 0.29f},   {-0.91f, 0.43f, 0.57f, -0.71f},
    {1.0f, -1.0f, 1.0f, -1.0f},      {-1.0f, 0.9999f, -0.9999f, 1.0f},
    {0.7071f, 0.7071f, 0.3f, 0.55f}, {0.2f, 1.0001f, 0.2f, 0.2f},
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

static float opposite(float value)
{
    return (value == 0.0f) ? 0.0f : -value;
}

static bool are_opposite(const keel_reference_setpoints_t *x, const keel_reference_setpoints_t *y)
{
    return float_same(x->roll_rate, opposite(y->roll_rate)) &&
           float_same(x->pitch_rate, opposite(y->pitch_rate)) &&
           float_same(x->yaw_rate, opposite(y->yaw_rate)) &&
           float_same(x->heading_rate, opposite(y->heading_rate)) &&
           float_same(x->roll, opposite(y->roll)) && float_same(x->pitch, opposite(y->pitch)) &&
           float_same(x->forward, opposite(y->forward)) &&
           float_same(x->right, opposite(y->right)) &&
           float_same(x->climb_rate, opposite(y->climb_rate));
}

void keel_reference_step__points_harness(void)
{
    for (unsigned i = 0u; i < POINTS; i++) {
        const keel_reference_sticks_t sticks = points[i];
        const keel_reference_sticks_t mirrored = {-sticks.roll, -sticks.pitch, -sticks.yaw,
                                                  -sticks.climb};
        keel_reference_t reference = generator();
        keel_reference_t model = reference;
        keel_reference_t other = reference;
        const keel_status_t status = keel_reference_step(&reference, &sticks);

        __CPROVER_assert(status == model_reference_step(&model, &sticks),
                         "REF_004_model: taken or refused as the model says");
        __CPROVER_assert(reference_same(&reference, &model),
                         "REF_005_model: every field is what the model says");

        other.limits.climb_rate = reference.limits.descent_rate;
        other.limits.descent_rate = reference.limits.climb_rate;
        (void)model_reference_step(&other, &mirrored);
        __CPROVER_assert(are_opposite(&reference.setpoints, &other.setpoints),
                         "REF_009_odd: opposite sticks, opposite set-points");
    }
}
