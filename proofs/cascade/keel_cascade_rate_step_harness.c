// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 12 --external-sat-solver cadical
// sources: src/flight/cascade.c src/flight/pid.c src/flight/filter.c specs/model/cascade.c
// replaces: keel_cascade_axis_step
// covers: keel_cascade_rate_step turn_with torque_limit is_flown asks_for
// covers: model_cascade_rate_step torque_of axis_output output_of nearest_within
//
// Any valid cascade, any bit pattern of what it is told; what an axis does is unknown
// (asked_axes.h).
#include "asked_axes.h"

void keel_cascade_rate_step_harness(void)
{
    const keel_cascade_rates_t asked = nondet_rates();
    const keel_attitude_vector_t rate = nondet_vector();
    const uint32_t gave_way = nondet_uint();

    begin_alike();
    model_cascade_rate_step(&model, asked, rate, gave_way);

    keel_cascade_rate_step(&cascade, asked, rate, gave_way);

    __CPROVER_assert(cascade_same(&cascade, &model),
                     "CAS_008_model: every field is what the model says");
    __CPROVER_assert(command_valid_here(&cascade.command), "CAS_008_command: the mixer takes it");
    __CPROVER_assert(cascade_valid_here(&cascade), "CAS_004_rate: the cascade stays valid");
}
