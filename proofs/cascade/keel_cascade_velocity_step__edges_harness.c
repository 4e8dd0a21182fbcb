// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 12 --external-sat-solver cadical
// checks: assertions
// sources: src/flight/cascade.c src/flight/pid.c src/flight/filter.c
// sources: specs/model/cascade.c specs/model/cascade_parts.c specs/model/pid.c specs/model/filter.c
// sources: specs/model/pid_within.c
// covers: keel_cascade_velocity_step
//
// A chosen cascade where a comparison of the stage is decided by the last bit, or by one of its
// sides alone: the same as the model's. Run-time errors, and each branch, are in
// keel_cascade_velocity_step__points_harness.
#include "velocity_points.h"

#define POINTS 11u

/* What a controller takes just so, and just no more. */
#define END    KEEL_PID_INPUT_LIMIT
#define BEYOND (KEEL_PID_INPUT_LIMIT + 0.5f)

/* North with a heading between the axes; then thrust that is raised, or yaw that is less, and
 * nothing else at a limit, but a limit of the body of which exactly the share lies along north; a
 * way to the fence that is too short by 0.05 m, and ways that are just enough; asked for a zero of
 * the other sign near a side; a direction that is none, by each part; and, at last, places and
 * speeds at the ends of what a controller takes and beyond. */
static const point_t points[POINTS] = {
    {{1.1f, 2.3f, 0.5f},
     {{3.0f, 4.0f, 5.0f}, {0.5f, 0.3f, 0.1f}, 0.6f, 0.8f, true, true},
     NONE,
     NONE,
     0u,
     KEEL_MODE_POSITION},
    {{0.55f, 0.35f, 0.15f},
     {{3.0f, 4.0f, 5.0f}, {0.5f, 0.3f, 0.1f}, 0.5f, 0.85f, true, true},
     NONE,
     BOTH,
     KEEL_MIXER_RAISED,
     KEEL_MODE_POSITION},
    {{0.55f, 0.35f, 0.15f},
     {{3.0f, 4.0f, 5.0f}, {0.5f, 0.3f, 0.1f}, 0.6f, 0.8f, true, true},
     NONE,
     NONE,
     KEEL_MIXER_YAW,
     KEEL_MODE_POSITION},
    {{4.0f, 4.0f, 3.0f},
     {{88.3f, 78.25f, 68.25f}, {1.5f, 1.5f, 1.5f}, 0.95f, 0.3f, true, true},
     NONE,
     NONE,
     0u,
     KEEL_MODE_POSITION},
    {{-0.0f, -0.0f, -0.0f},
     {{89.0f, -79.5f, 69.0f}, {1.5f, -1.5f, 1.5f}, 0.95f, 0.3f, true, true},
     NONE,
     NONE,
     0u,
     KEEL_MODE_POSITION},
    {{4.0f, 4.0f, 3.0f},
     {{3.0f, 4.0f, 5.0f}, {0.4f, 0.4f, 0.3f}, 1.5f, 0.3f, true, true},
     NONE,
     NONE,
     0u,
     KEEL_MODE_POSITION},
    {{4.0f, 4.0f, 3.0f},
     {{3.0f, 4.0f, 5.0f}, {0.4f, 0.4f, 0.3f}, -1.5f, 0.3f, true, true},
     NONE,
     NONE,
     0u,
     KEEL_MODE_POSITION},
    {{4.0f, 4.0f, 3.0f},
     {{3.0f, 4.0f, 5.0f}, {0.4f, 0.4f, 0.3f}, 0.6f, 1.5f, true, true},
     NONE,
     NONE,
     0u,
     KEEL_MODE_POSITION},
    {{-4.0f, 4.0f, -3.0f},
     {{END, -END, BEYOND}, {0.4f, 0.4f, 0.3f}, 0.6f, 0.8f, true, true},
     NONE,
     NONE,
     0u,
     KEEL_MODE_POSITION},
    {{4.0f, -4.0f, 3.0f},
     {{-BEYOND, 4.0f, 5.0f}, {0.4f, END, -END}, 0.6f, 0.8f, true, true},
     NONE,
     NONE,
     0u,
     KEEL_MODE_POSITION},
    {{-4.0f, 4.0f, 3.0f},
     {{3.0f, 4.0f, 5.0f}, {BEYOND, -BEYOND, 0.3f}, 0.6f, 0.8f, true, true},
     NONE,
     NONE,
     0u,
     KEEL_MODE_POSITION},
};

void keel_cascade_velocity_step__edges_harness(void)
{
    good_cascade();
    for (unsigned i = 0u; i < POINTS; i++) {
        lead_to(&points[i]);
        keel_cascade_velocity_step(&cascade, points[i].asked, &points[i].estimate);
        model_cascade_velocity_step(&model, points[i].asked, &points[i].estimate);

        __CPROVER_assert(cascade_same(&cascade, &model),
                         "CAS_010_edges: every field is what the model says");
    }
}
