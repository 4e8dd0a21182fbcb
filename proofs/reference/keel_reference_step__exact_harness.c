// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 77 --external-sat-solver cadical
// sources: src/flight/reference.c
// covers: keel_reference_step are_sticks deflection rounded_off
//
// Sticks in eighths, four curves and eight limits that are all different, in numbers whose sums and
// products are exact: what integers give. One stick at a time is away from its centre, and
// keel_reference_step__points_harness has them together. Wrong bodies are refuted here: where
// floats differ, z3 finds no example.
#include "reference_proof.h"

/* 2048 times a deflection: dead band d/8, scale and quarters e of expo. */
static int deflection_2048(int eighths, int d, int scale, int e)
{
    const int size = (eighths < 0) ? -eighths : eighths;
    const int beyond = (size > d) ? ((size - d) * scale) : 0;
    const int u = (beyond < 8) ? beyond : 8;
    const int s = u * (((4 - e) * 64) + (e * u * u));

    return (eighths < 0) ? -s : s;
}

static bool is_exactly(float value, int times_2048)
{
    return float_same(value, (float)times_2048 / 2048.0f);
}

static keel_reference_t generator(void)
{
    const keel_reference_t reference = {
        .roll = {0.5f, 2.0f, 1.0f, 0.0f},
        .pitch = {0.25f, 1.0f, 0.0f, 1.0f},
        .yaw = {0.125f, 1.0f, 0.5f, 0.5f},
        .climb = {0.375f, 2.0f, 0.75f, 0.25f},
        .limits = {2.0f, 3.0f, 5.0f, 7.0f, 1.0f, 11.0f, 13.0f, 17.0f},
        .setpoints = {9.0f, 9.0f, 9.0f, 9.0f, 9.0f, 9.0f, 9.0f, 9.0f, 9.0f},
    };

    return reference;
}

/* The set-points of one stick away from its centre. */
static void are_exact(const keel_reference_setpoints_t *setpoints, int roll, int pitch, int yaw,
                      int climb)
{
    const int s_roll = deflection_2048(roll, 4, 2, 0);
    const int s_pitch = deflection_2048(pitch, 2, 1, 4);
    const int s_yaw = deflection_2048(yaw, 1, 1, 2);
    const int s_climb = deflection_2048(climb, 3, 2, 1);

    __CPROVER_assert(is_exactly(setpoints->roll_rate, 2 * s_roll), "REF_005_roll_rate: exact");
    __CPROVER_assert(is_exactly(setpoints->pitch_rate, 3 * s_pitch), "REF_005_pitch_rate: exact");
    __CPROVER_assert(is_exactly(setpoints->yaw_rate, 5 * s_yaw), "REF_005_yaw_rate: exact");
    __CPROVER_assert(is_exactly(setpoints->heading_rate, 7 * s_yaw), "REF_005_heading_rate: exact");
    __CPROVER_assert(is_exactly(setpoints->roll, s_roll), "REF_005_roll: exact");
    __CPROVER_assert(is_exactly(setpoints->pitch, s_pitch), "REF_005_pitch: exact");
    __CPROVER_assert(is_exactly(setpoints->forward, -11 * s_pitch), "REF_005_forward: exact");
    __CPROVER_assert(is_exactly(setpoints->right, 11 * s_roll), "REF_005_right: exact");
    __CPROVER_assert(is_exactly(setpoints->climb_rate, s_climb * ((climb < 0) ? 17 : 13)),
                     "REF_005_climb_rate: exact");
}

void keel_reference_step__exact_harness(void)
{
    /* Four sticks, 19 places of each. */
    for (int i = 0; i < 76; i++) {
        const int eighths = (i / 4) - 9;
        const int at[4] = {((i % 4) == 0) ? eighths : 0, ((i % 4) == 1) ? eighths : 0,
                           ((i % 4) == 2) ? eighths : 0, ((i % 4) == 3) ? eighths : 0};
        const keel_reference_sticks_t sticks = {(float)at[0] / 8.0f, (float)at[1] / 8.0f,
                                                (float)at[2] / 8.0f, (float)at[3] / 8.0f};
        const keel_reference_t before = generator();
        keel_reference_t reference = before;
        const keel_status_t status = keel_reference_step(&reference, &sticks);

        __CPROVER_assert((status == KEEL_OK) == ((eighths >= -8) && (eighths <= 8)),
                         "REF_004_ok: taken when every stick is in its range");
        if (status == KEEL_OK) {
            are_exact(&reference.setpoints, at[0], at[1], at[2], at[3]);
        } else {
            __CPROVER_assert(reference_same(&reference, &before),
                             "STA_001_kept: a refusal changes nothing");
        }
    }
}
