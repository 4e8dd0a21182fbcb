// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 13 --external-sat-solver cadical
// sources: src/flight/cascade.c src/flight/pid.c src/flight/filter.c
// sources: specs/model/cascade_parts.c specs/model/pid.c specs/model/filter.c
// covers: keel_cascade_check greatest_reach is_speed most_taken is_output_taken is_braking
// covers: is_in_time are_numbers model_cascade_check numbers_valid acceleration_valid
// covers: output_valid reach_limit lies_within next_to
//
// Any bit pattern of the cascade's own numbers and of what limits the controllers' outputs; the
// rest of these is good, or a gain is not: keel_pid_init has harnesses of its own. One axis after
// another, so that a rate is a number to the solver.
#include "cascade_points.h"

static keel_cascade_config_t config;

/* One that is a factor is a chosen number, or none: products of any are in
 * keel_cascade_check_harness, to which both sides of a product are the same term. */
static float chosen(float one, float other)
{
    return nondet_bool() ? one : (nondet_bool() ? other : -1.0f);
}

static void any_config(void)
{
    const keel_cascade_config_t any = nondet_cascade_config();

    good_config(&config);
    config.hover = any.hover;
    config.acceleration = any.acceleration;
    config.braking = any.braking;
    for (uint32_t i = 0u; i < AXES; i++) {
        config.reach[i] = any.reach[i];
        config.pid[i].gains.kp = nondet_bool() ? 1.0f : -1.0f;
        config.pid[i].output_min = any.pid[i].output_min;
        config.pid[i].output_max = any.pid[i].output_max;
    }
    config.reach[KEEL_CASCADE_ROLL] = chosen(0.5f, 0.75f);
    config.reach[KEEL_CASCADE_PITCH] = chosen(0.625f, 0.875f);
    /* 0.01 s is one step at 100 Hz, as rounded. */
    config.reaction_s = chosen(0.25f, nondet_bool() ? 0.01f : 0.001f);
}

/* What is taken is within its ranges. */
static void taken(uint32_t axis)
{
    const keel_pid_config_t *const pid = &config.pid[axis];

    __CPROVER_assert(within(config.reach[axis], 0.0f, reach_of(axis)),
                     "CAS_001_reach: from 0 to the greatest");
    __CPROVER_assert(limits_here(pid), "CAS_001_limits: those of the controller are good");
    __CPROVER_assert((axis != KEEL_CASCADE_CLIMB) ||
                         ((pid->output_min >= -config.hover) && (pid->output_max <= 1.0f)),
                     "CAS_001_thrust: from 0 to 1");
    __CPROVER_assert((axis > KEEL_CASCADE_YAW_RATE) ||
                         (magnitude(pid->output_min, 1.0f) && magnitude(pid->output_max, 1.0f)),
                     "CAS_001_torque: what the mixer takes");
}

void keel_cascade_check__chosen_harness(void)
{
    const uint32_t none = nondet_uint();

    __CPROVER_assume(none >= AXES);
    any_config();
    for (uint32_t i = 0u; i <= AXES; i++) {
        const uint32_t axis = (i < AXES) ? i : none;
        const keel_status_t status = keel_cascade_check(&config, axis);

        __CPROVER_assert(status == model_cascade_check(&config, axis),
                         "CAS_001_model: taken or refused as the model says");
        if (i == AXES) {
            __CPROVER_assert(status == KEEL_ERR_INPUT, "CAS_001_axis: there is no such axis");
        } else if (status == KEEL_OK) {
            taken(axis);
        } else {
            /* Refused. */
        }
    }
}
