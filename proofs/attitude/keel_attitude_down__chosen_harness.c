// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 6 --external-sat-solver cadical
// sources: src/flight/attitude.c
// covers: keel_attitude_down axes_of
//
// Chosen quaternions: level, upside down, turned about each axis and about all. All others are
// dealt with in keel_attitude_down__clauses_harness; wrong bodies are refuted here, for where
// floats differ z3 finds no example.
#include "attitude_clauses.h"

#define POINTS 5u

static const keel_attitude_quaternion_t chosen[POINTS] = {
    {1.0f, 0.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f, 0.0f},   {0.8f, 0.0f, 0.6f, 0.0f},
    {0.6f, 0.0f, 0.0f, 0.8f}, {0.1f, -0.7f, 0.5f, -0.5f},
};

void keel_attitude_down__chosen_harness(void)
{
    for (unsigned i = 0u; i < POINTS; i++) {
        keel_attitude_t attitude = any_attitude_at_all();
        keel_attitude_vector_t down;

        attitude.quaternion = chosen[i];

        down = keel_attitude_down(&attitude);

        __CPROVER_assert(!components_here(chosen[i]) || float_same(down.z, down_here(chosen[i])),
                         "ATT_019_down: 1 less twice the squares of x and y");
    }
}
