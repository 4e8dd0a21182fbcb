// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 15 --no-array-field-sensitivity --external-sat-solver cadical
// sources: src/flight/cascade.c src/flight/pid.c src/flight/filter.c
// sources: specs/model/cascade.c specs/model/cascade_parts.c specs/model/pid.c specs/model/filter.c
// sources: specs/model/pid_within.c
// covers: keel_cascade_velocity_step drive_tilts drive_with is_direction is_side_near near_sides
// covers: admitted_speed limit_stops_growth shared_limit keel_cascade_axis_step within_reach
// covers: asks_for is_asked_for is_flown model_cascade_velocity_step driven side_near no_more
// covers: axis_output output_of setpoint_of number_within nearest_within model_cascade_axis_step
// covers: lies_within next_to
//
// A chosen cascade at chosen places, one after another: the same as the model's. All of them are
// dealt with in keel_cascade_velocity_step_harness; wrong bodies are refuted here, and in
// keel_cascade_velocity_step__edges_harness, for where floats differ z3 finds no example.
#include "velocity_points.h"

#define POINTS 14u

/* Not flown at first; then north with a heading between the axes; each limit of the body, seen from
 * each side; near each side of the fence; near for the way of the reaction time alone, 0.5 m of the
 * 1.75 m that 1.5 m/s need; beyond it; faster than braking allows, with way enough without; no
 * number for a place and a speed; without an estimate; and, at last, no number for a direction. */
static const point_t points[POINTS] = {
    {{1.0f, 2.0f, 0.5f},
     {{3.0f, 4.0f, 5.0f}, {0.5f, 0.25f, 0.1f}, 1.0f, 0.0f, true, true},
     NONE,
     NONE,
     0u,
     KEEL_MODE_ANGLE},
    {{1.1f, 2.3f, 0.5f},
     {{3.0f, 4.0f, 5.0f}, {0.5f, 0.3f, 0.1f}, 0.6f, 0.8f, true, true},
     NONE,
     NONE,
     0u,
     KEEL_MODE_POSITION},
    {{1.2f, -2.3f, 0.7f},
     {{3.1f, 4.1f, 5.1f}, {0.4f, 0.35f, 0.2f}, 0.6f, 0.8f, true, true},
     MOST,
     LEAST,
     KEEL_MIXER_LOWERED,
     KEEL_MODE_POSITION},
    {{-1.2f, 2.3f, -0.7f},
     {{3.2f, 4.2f, 5.2f}, {0.4f, 0.4f, 0.3f}, -0.8f, 0.55f, true, true},
     LEAST,
     MOST,
     KEEL_MIXER_RAISED,
     KEEL_MODE_POSITION},
    {{1.9f, 9.3f, 9.7f},
     {{3.2f, 4.2f, 5.2f}, {0.4f, 0.4f, 0.3f}, 0.3f, -0.95f, true, true},
     MOST,
     MOST,
     KEEL_MIXER_YAW,
     KEEL_MODE_RETURN},
    {{4.0f, 4.0f, 3.0f},
     {{89.0f, 79.5f, 69.0f}, {1.5f, 0.1f, 1.5f}, 0.95f, 0.3f, true, true},
     NONE,
     NONE,
     0u,
     KEEL_MODE_POSITION},
    {{-4.0f, -4.0f, -3.0f},
     {{-89.0f, -79.5f, -69.0f}, {-1.5f, -0.1f, -1.5f}, 0.95f, 0.3f, true, true},
     NONE,
     NONE,
     0u,
     KEEL_MODE_POSITION},
    {{4.0f, -4.0f, 3.0f},
     {{88.5f, -78.5f, 68.5f}, {1.5f, -1.5f, 1.5f}, 0.95f, 0.3f, true, true},
     NONE,
     NONE,
     0u,
     KEEL_MODE_POSITION},
    {{4.0f, 4.0f, 3.0f},
     {{85.0f, 60.0f, 71.0f}, {4.25f, 7.25f, -3.0f}, 0.95f, 0.3f, true, true},
     NONE,
     NONE,
     0u,
     KEEL_MODE_POSITION},
    {{4.0f, -4.0f, 3.0f},
     {{85.0f, -60.0f, 71.0f}, {-4.25f, -7.25f, 3.0f}, 0.95f, 0.3f, true, true},
     NONE,
     MOST,
     0u,
     KEEL_MODE_POSITION},
    {{4.0f, 4.0f, 3.0f},
     {{1.0e7f, 4.0f, 5.0f}, {0.4f, 1.0e7f, 0.3f}, 0.6f, 0.8f, true, true},
     NONE,
     NONE,
     0u,
     KEEL_MODE_POSITION},
    {{4.0f, 4.0f, 3.0f},
     {{3.0f, 4.0f, 5.0f}, {0.4f, 0.4f, 0.3f}, 0.6f, 0.8f, false, true},
     NONE,
     NONE,
     0u,
     KEEL_MODE_POSITION},
    {{1.0e7f, 4.0f, 3.0f},
     {{3.0f, 4.0f, 5.0f}, {0.4f, 0.4f, 0.3f}, 0.6f, 0.8f, true, false},
     NONE,
     NONE,
     0u,
     KEEL_MODE_POSITION},
    {{4.0f, 4.0f, 3.0f},
     {{3.0f, 4.0f, 5.0f}, {0.4f, 0.4f, 0.3f}, 1.0e7f, 0.8f, true, true},
     NONE,
     NONE,
     0u,
     KEEL_MODE_POSITION},
};

void keel_cascade_velocity_step__points_harness(void)
{
    const float no_number = nondet_float();

    __CPROVER_assume(no_number != no_number);
    good_cascade();
    for (unsigned i = 0u; i < POINTS; i++) {
        keel_cascade_estimate_t estimate = points[i].estimate;

        if (estimate.forward_north > 1.0f) {
            estimate.forward_north = no_number;
        }
        lead_to(&points[i]);
        keel_cascade_velocity_step(&cascade, points[i].asked, &estimate);
        model_cascade_velocity_step(&model, points[i].asked, &estimate);

        __CPROVER_assert(cascade_same(&cascade, &model),
                         "CAS_010_points: every field is what the model says");
    }
}
