// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 12 --external-sat-solver cadical
// sources: src/flight/cascade.c src/flight/pid.c src/flight/filter.c
// sources: specs/model/cascade_parts.c specs/model/pid.c specs/model/filter.c
// covers: keel_cascade_check greatest_reach is_speed most_taken is_output_taken is_braking is_in_time
// covers: are_numbers model_cascade_check numbers_valid acceleration_valid output_valid reach_limit
// covers: lies_within
//
// Any bit pattern of the cascade's own numbers and of what limits the controllers' outputs; the
// rest of these is good, or their gains are not: keel_pid_init has harnesses of its own.
#include "cascade_points.h"

void keel_cascade_check__any_harness(void)
{
    static keel_cascade_config_t config;
    const uint32_t axis = nondet_uint();
    keel_status_t status;

    config = nondet_cascade_config();
    for (uint32_t i = 0u; i < AXES; i++) {
        config.pid[i].gains = (keel_pid_gains_t){nondet_bool() ? 1.0f : -1.0f, 0.5f, 0.0f, 0.0f};
        config.pid[i].rate_hz = nondet_bool() ? 1000.0f : -1.0f;
        config.pid[i].cutoff_hz = 100.0f;
    }

    status = keel_cascade_check(&config, axis);

    __CPROVER_assert(status == model_cascade_check(&config, axis),
                     "CAS_001_model: taken or refused as the model says");
    __CPROVER_assert((axis < AXES) || (status == KEEL_ERR_INPUT), "CAS_001_axis: there is none");
    if (status == KEEL_OK) {
        const keel_pid_config_t *const pid = &config.pid[axis];

        __CPROVER_assert(within(config.reach[axis], 0.0f, KEEL_CASCADE_DISTANCE_MAX) &&
                             ((axis > 7u) || (config.reach[axis] <= KEEL_CASCADE_SPEED_MAX)) &&
                             ((axis > 4u) || (config.reach[axis] <= KEEL_CASCADE_RATE_MAX)) &&
                             ((axis != 3u) || (config.reach[axis] <= KEEL_CASCADE_TILT_MAX)) &&
                             ((axis != 4u) || (config.reach[axis] <= KEEL_CASCADE_TILT_MAX)),
                         "CAS_001_reach: from 0 to the greatest");
        __CPROVER_assert(limits_here(pid), "CAS_001_limits: those of the controller are good");
        __CPROVER_assert((axis != KEEL_CASCADE_CLIMB) ||
                             ((pid->output_min >= -config.hover) && (pid->output_max <= 1.0f)),
                         "CAS_001_thrust: from 0 to 1");
        __CPROVER_assert((axis > KEEL_CASCADE_YAW_RATE) || (magnitude(pid->output_min, 1.0f) &&
                                                            magnitude(pid->output_max, 1.0f)),
                         "CAS_001_torque: what the mixer takes");
    }
}
