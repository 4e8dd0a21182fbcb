// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 9 --external-sat-solver cadical
// sources: src/flight/attitude.c
// covers: keel_attitude_is_unit
//
// Chosen quaternions: units, and such as are too short or too long. All others are dealt with in
// keel_attitude_is_unit__clauses_harness; wrong bodies are refuted here, for where floats differ z3
// finds no example.
#include "attitude_clauses.h"

#define POINTS 8u

static const keel_attitude_quaternion_t chosen[POINTS] = {
    {1.0f, 0.0f, 0.0f, 0.0f},   {0.5f, -0.5f, 0.5f, -0.5f},  {0.6f, 0.0f, -0.8f, 0.0f},
    {0.0f, 0.0f, 0.0f, 0.0f},   {0.0f, 0.99f, 0.0f, 0.0f},   {0.0f, 0.0f, 1.003f, 0.0f},
    {0.75f, 0.5f, 0.5f, 0.25f}, {-0.5f, 0.25f, 0.25f, 0.5f},
};

void keel_attitude_is_unit__chosen_harness(void)
{
    for (unsigned i = 0u; i < POINTS; i++) {
        const bool is_unit = keel_attitude_is_unit(chosen[i]);

        __CPROVER_assert(!components_here(chosen[i]) || (is_unit == is_unit_here(chosen[i])),
                         "ATT_016_unit: its length says whether it is a unit");
    }
}
